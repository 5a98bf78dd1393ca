/* The shaders of plates. In: a plate's corners and its picture. Out: colour times opacity, and opacity. Invariant: a
 * texel that is 0 gives 0, so the empty parts of a plate leave the picture as it is. */
#include "cloud/cloud_rays.h"

enum { WHOLE_S, WHOLE_T, WHOLE_VARYINGS };

static void vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct lom_impostor_uniforms *impostor = uniforms;
    lom_int first = (in->vertex & 3) * 3;
    lom_float3 offset = { lom_gather(&impostor->corner[0][0], first), lom_gather(&impostor->corner[0][0], first + 1),
                          lom_gather(&impostor->corner[0][0], first + 2) };
    out->position = lom_transform4(&impostor->cloud.clip_from_offset, offset);
    out->varying[OFFSET] = offset.x;
    out->varying[OFFSET + 1] = offset.y;
    out->varying[OFFSET + 2] = offset.z;
    out->varying[S] = lom_to_float(in->vertex & 1);
    out->varying[T] = lom_to_float(1 - (in->vertex >> 1));
}

/* How much of what a ray meets of the box lies before what is drawn there. */
static lom_float shown_part(const struct lom_cloud_uniforms *cloud, const lom_varyings *in)
{
    lom_float3 offset = { in->varying[OFFSET], in->varying[OFFSET + 1], in->varying[OFFSET + 2] };
    lom_float length = lom_sqrt(lom_dot3(offset, offset));
    lom_float scene = lom_scene_distance(cloud, in, length);
    struct lom_cloud_uniforms open = { .depth = NULL };
    for (int i = 0; i < 3; i++) {
        open.eye_in_box[i] = cloud->eye_in_box[i];
        open.slice_axis[i] = cloud->slice_axis[i];
        for (int k = 0; k < 3; k++)
            open.box_axis[i][k] = cloud->box_axis[i][k];
    }
    open.eye = cloud->eye;
    open.is_sliced = cloud->is_sliced;
    open.slice_from = cloud->slice_from;
    open.slice_to = cloud->slice_to;
    lom_float3 direction;
    lom_medium_rays rays = lom_cloud_rays(&open, in, &direction);
    lom_float part = lom_saturate((scene - rays.enter) / lom_max(rays.leave - rays.enter, lom_splat(1e-3f)));
    lom_float whole = lom_select(scene > length, lom_splat(1.0f), (lom_float){ 0 });
    return lom_select(rays.active, part, whole);
}

static void fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct lom_impostor_uniforms *impostor = uniforms;
    lom_float4 texel = lom_sample(impostor->plate, in->varying[S], in->varying[T], (lom_float){ 0 });
    lom_float factor = lom_splat(impostor->misting);
    const lom_mask seen = texel.w > 0.0f;
    if (impostor->cloud.depth != NULL && lom_any(seen & in->covered)) {
        lom_float part = shown_part(&impostor->cloud, in);
        if (lom_any(part < 1.0f)) {
            lom_float left = lom_max(1.0f - texel.w, lom_splat(1e-6f));
            lom_float alpha = 1.0f - lom_exp(part * lom_log(left));
            lom_float cut = lom_saturate(alpha / lom_max(texel.w, lom_splat(1e-6f)));
            factor = factor * lom_select(seen & (part < 1.0f), cut, lom_splat(1.0f));
        }
    }
    out->color[0] = (lom_float4){ texel.x * factor, texel.y * factor, texel.z * factor, texel.w * factor };
    LOM_NAME_AS(plate_age,
                lom_select(texel.w * factor > 0.0f, lom_splat(impostor->age), lom_splat(__builtin_nanf(""))));
}

static void whole_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    (void)uniforms;
    lom_float s = lom_to_float(in->vertex & 1), t = lom_to_float(in->vertex >> 1);
    out->position = (lom_float4){ 2.0f * s - 1.0f, 1.0f - 2.0f * t, { 0 }, lom_splat(1.0f) };
    out->varying[WHOLE_S] = s;
    out->varying[WHOLE_T] = t;
}

static void whole_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct lom_impostor_uniforms *impostor = uniforms;
    out->color[0] = lom_sample(impostor->plate, in->varying[WHOLE_S], in->varying[WHOLE_T], (lom_float){ 0 });
}

LOM_SHADER(lom_impostor_shader, vertex, fragment, .varyings = PICTURE_VARYINGS,
           .reads = LOM_VARYINGS(0, PICTURE_VARYINGS), .reads_position = true, .colors = 1,
           .uniforms_size = sizeof(struct lom_impostor_uniforms))
LOM_SHADER(lom_magnify_shader, whole_vertex, whole_fragment, .varyings = WHOLE_VARYINGS,
           .reads = LOM_VARYINGS(WHOLE_S, 2), .colors = 1, .uniforms_size = sizeof(struct lom_impostor_uniforms))
