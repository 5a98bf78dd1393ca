/* The shaders of the earlier models: the reference work's fixed steps (docs/clouds.md, Marching), and a flat picture.
 * In: the box's back faces, or a square that faces the eye. Out: colour times opacity, and opacity. */
#include "cloud/cloud_rays.h"
#include "march/fixed_cells.h"

enum { STEPS = 100 };
static const float step_length = 0.0154f, most_cloud = 70; /* of the unit cube; of the reference's units */
static const float most_opacity = 0.9f;                    /* where a ray stops */

/* dynamicLight: the length of the way from a place to the box's face towards the light: of the six planes the nearest
 * one that lies ahead. */
static lom_float light_length(const struct lom_cloud_uniforms *cloud, lom_float3 p)
{
    const lom_float at[3] = { p.x, p.y, p.z };
    lom_float nearest = lom_splat(3e38f);
    for (int i = 0; i < 3; i++) {
        float along = cloud->light_in_box[i];
        if (along == 0)
            continue;
        lom_float first = -at[i] / along, second = (1.0f - at[i]) / along;
        nearest = lom_select((first > 0.0f) & (first < nearest), first, nearest);
        nearest = lom_select((second > 0.0f) & (second < nearest), second, nearest);
    }
    return lom_min(nearest * cloud->unit, lom_splat(most_cloud));
}

static lom_float dynamic_light(const struct lom_cloud_uniforms *cloud, lom_float3 p, lom_float value, lom_float before)
{
    lom_float light = 1.0f - light_length(cloud, p) * (1 / most_cloud);
    lom_float lit = value * lom_select(light > value - 0.1f, 1.5f + light, 0.3f + light);
    return lom_select(before < 0.1f, lit * 0.8f, lit);
}

static lom_mask is_inside(lom_float x)
{
    return (x >= 0.02f) & (x <= 0.98f);
}

static lom_float sample_gray(const struct lom_cloud_uniforms *cloud, lom_float3 p, lom_float *density)
{
    lom_volume_place place = lom_find_in_volume(cloud->original, p);
    if (!cloud->is_fixed)
        return lom_sample_volume_all(cloud->original, place, density).x;
    struct fixed_place at = fix_place(place);
    return fixed_volume_all(cloud->original, &at, density).x;
}

/* Grays are averaged by what is left to the stop, or the mean would jump where one ray stops before the white of empty
 * voxels and its neighbour does not. */
static void original_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct lom_cloud_uniforms *cloud = uniforms;
    lom_float3 direction;
    lom_medium_rays rays = lom_cloud_rays(cloud, in, &direction);
    /* in the unit cube: a step is 0.0154 there, whatever the box's sides */
    lom_float stretch = lom_sqrt(lom_dot3(rays.along, rays.along));
    lom_float step = step_length / lom_max(stretch, lom_splat(1e-20f));
    lom_float color = { 0 }, alpha = { 0 }, samples = { 0 }, before = { 0 };
    lom_mask alive = rays.active;
    for (int i = 0; i < STEPS && lom_any(alive); i++) {
        lom_float at = rays.enter + step * (float)i;
        alive &= at < rays.leave;
        lom_float3 p = lom_add3(rays.start, lom_scale3(rays.along, at));
        lom_mask counts = alive & is_inside(p.x) & is_inside(p.y) & is_inside(p.z);
        if (!lom_any(counts))
            continue;
        lom_float density, gray = sample_gray(cloud, p, &density);
        if (cloud->is_real_time)
            gray = dynamic_light(cloud, p, gray, before);
        lom_float weight =
            lom_as_float(lom_as_int(lom_max(1.0f - alpha * (1 / most_opacity), (lom_float){ 0 })) & counts);
        color += gray * weight;
        samples += weight;
        alpha += lom_as_float(lom_as_int(density * (5 / 100.0f)) & counts);
        before = lom_select(counts, density, before);
        alive &= ~(alpha > most_opacity);
    }
    lom_float gray = lom_saturate(color / lom_max(samples, lom_splat(1e-6f))), opacity = lom_saturate(alpha);
    lom_float3 seen = lom_scale3(lom_uniform3(cloud->sun), gray * opacity);
    out->color[0] = (lom_float4){ seen.x, seen.y, seen.z, opacity };
}

static void picture_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct lom_cloud_uniforms *cloud = uniforms;
    lom_float3 offset = { in->varying[OFFSET], in->varying[OFFSET + 1], in->varying[OFFSET + 2] };
    offset = lom_eye_path(&cloud->eye, offset);
    lom_float length = lom_sqrt(lom_dot3(offset, offset));
    lom_float4 texel = lom_sample(cloud->picture, in->varying[S], in->varying[T], lom_lod(cloud->picture, in, S, T));
    lom_mask seen = lom_splat_int(-1);
    if (cloud->depth != NULL)
        seen = length < lom_scene_distance(cloud, in, length);
    lom_float alpha = lom_as_float(lom_as_int(texel.w) & seen);
    lom_float3 color = lom_scale3(lom_uniform3(cloud->sun), texel.x * alpha);
    color = lom_cloud_haze(cloud, color, alpha, length);
    out->color[0] = (lom_float4){ color.x, color.y, color.z, alpha };
}

LOM_SHADER(lom_cloud_original_shader, lom_cloud_vertex, original_fragment, .varyings = RAY_VARYINGS,
           .reads = LOM_VARYINGS(OFFSET, 3), .reads_position = true, .colors = 1,
           .uniforms_size = sizeof(struct lom_cloud_uniforms))
LOM_SHADER(lom_cloud_picture_shader, lom_cloud_picture_vertex, picture_fragment, .varyings = PICTURE_VARYINGS,
           .reads = LOM_VARYINGS(0, PICTURE_VARYINGS), .differentiates = 1u << S | 1u << T, .reads_position = true,
           .colors = 1, .uniforms_size = sizeof(struct lom_cloud_uniforms))
