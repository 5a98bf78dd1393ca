/* A liquid's light, over lanes. In: its surface as triangles, the scene behind it with depth. Out: what it mirrors,
 * what comes through it, and what its own matter sends back.
 *
 * How far a ray goes through it is the sum of the distances of the surfaces that turn their backs less that of those
 * that face the eye, each at most the distance of what stands there: exact for any closed surface, in any order
 * (screen-space refraction after C. Wyman, An approximate image-space approach for interactive refraction, 2005; of
 * liquids W. van der Laan, S. Green, M. Sainz, Screen space fluid rendering with curvature flow, 2009).
 *
 * Invariant: pixels are looked up by their numbers in the whole picture. */
#include "render/fluid/shaders.h"
#include "shading/phong.h"
#include "water/surface_radiance.h"

enum { OFFSET = 0, NORMAL = 3, LENGTH_VARYINGS = 3, VARYINGS = 6 };
static const float far_away = 0x1p60f; /* of what is not there */

/* ---- the scene behind ---- */

static void square_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    (void)uniforms;
    lom_float s = lom_to_float(in->vertex & 1), t = lom_to_float(in->vertex >> 1);
    out->position = (lom_float4){ 2.0f * s - 1.0f, 1.0f - 2.0f * t, { 0 }, lom_splat(1.0f) };
}

static void copy_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct lom_fluid_uniforms *u = uniforms;
    lom_int x = lom_to_int(in->x) - u->origin[0], y = lom_to_int(in->y) - u->origin[1];
    lom_float4 color = lom_fetch(u->color, x, y, 0);
    lom_float reach = lom_depth_reach(&u->view.eye, lom_fetch(u->depth, x, y, 0).x);
    out->color[0] = (lom_float4){ color.x, color.y, color.z, reach };
}

/* ---- how far rays go through it ---- */

static lom_float3 transform(lom_vertex *out, const lom_attributes *in, const struct lom_fluid_uniforms *u)
{
    lom_float3 place = { in->attribute[0].x, in->attribute[0].y, in->attribute[0].z };
    lom_float3 offset = lom_add3(place, lom_uniform3(u->shift));
    out->position = lom_transform4(&u->view.clip_from_offset, offset);
    out->varying[OFFSET] = offset.x;
    out->varying[OFFSET + 1] = offset.y;
    out->varying[OFFSET + 2] = offset.z;
    return offset;
}

static void length_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    transform(out, in, uniforms);
}

/* A place as its ray sees it. */
struct seen {
    lom_float3 offset, path; /* less the eye; from where its ray starts */
    lom_float distance, reach;
};

static struct seen look_at(const struct lom_fluid_uniforms *u, const lom_varyings *in)
{
    struct seen s;
    s.offset = (lom_float3){ in->varying[OFFSET], in->varying[OFFSET + 1], in->varying[OFFSET + 2] };
    s.path = lom_eye_path(&u->view.eye, s.offset);
    s.distance = lom_sqrt(lom_dot3(s.path, s.path));
    s.reach = lom_place_reach(&u->view.eye, s.offset, in->w);
    return s;
}

/* How far along the ray to a place all counts that lies before the clip plane, in parts of the way to the place: less than
 * 1 where the ray has left it, more where it comes to it behind the place. */
static lom_float find_kept(const struct lom_fluid_uniforms *u, const struct seen *s)
{
    lom_float at = lom_transform_row(u->view.plane, s->offset);
    lom_float start = at - lom_dot3(lom_uniform3(u->view.plane), s->path), change = start - at;
    lom_float way = start / lom_select(change == 0.0f, lom_splat(1.0f), change);
    way = lom_select((change == 0.0f) | (way < 0.0f), (lom_float){ 0 }, way);
    return lom_select(at < 0.0f, way, lom_splat(1.0f));
}

static void length_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct lom_fluid_uniforms *u = uniforms;
    struct seen s = look_at(u, in);
    lom_float stands = lom_depth_reach(&u->view.eye, in->target_depth);
    lom_float length = u->side * (s.distance * lom_min(stands / s.reach, find_kept(u, &s)));
    out->color[0] = (lom_float4){ length, length, length, length };
}

/* ---- its light ---- */

static void vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct lom_fluid_uniforms *u = uniforms;
    out->distance[0] = lom_transform_row(u->view.plane, transform(out, in, u));
    out->varying[NORMAL] = in->attribute[1].x;
    out->varying[NORMAL + 1] = in->attribute[1].y;
    out->varying[NORMAL + 2] = in->attribute[1].z;
}

static lom_float4 fetch(const struct lom_fluid_uniforms *u, lom_int x, lom_int y)
{
    lom_int left = lom_splat_int(u->first[0]), top = lom_splat_int(u->first[1]);
    lom_int right = lom_splat_int(u->last[0]), bottom = lom_splat_int(u->last[1]);
    x = lom_select_int(x < left, left, lom_select_int(x > right, right, x));
    y = lom_select_int(y < top, top, lom_select_int(y > bottom, bottom, y));
    return lom_fetch(u->scene, x - u->origin[0], y - u->origin[1], 0);
}

/* The scene at a place of the picture, in pixels: the mean of the four texels around it of those that stand behind the
 * surface; all of which count where none does. Where the picture has no sky, what the ray meets in it. */
static lom_float3 look_behind(const struct lom_fluid_uniforms *u, lom_float x, lom_float y, lom_float reach,
                              lom_float3 ray)
{
    lom_float3 sky = lom_splat3(0, 0, 0);
    if (u->sky_is_behind)
        sky = lom_sky_radiance(&u->sky, ray, (lom_float){ 0 });
    lom_float left = lom_floor(x - 0.5f), top = lom_floor(y - 0.5f), s = x - 0.5f - left, t = y - 0.5f - top;
    lom_int column = lom_to_int(left), row = lom_to_int(top);
    lom_float3 sum = lom_splat3(0, 0, 0);
    lom_float weights = { 0 };
    for (int i = 0; i < 4; i++) {
        lom_float4 texel = fetch(u, column + (i & 1), row + (i >> 1));
        lom_float weight = ((i & 1) ? s : 1.0f - s) * ((i >> 1) ? t : 1.0f - t);
        weight = lom_select(texel.w > reach, weight, weight * 1e-6f);
        lom_float3 color = { texel.x, texel.y, texel.z };
        if (u->sky_is_behind)
            color = lom_mix3(color, sky, lom_select(texel.w > far_away, lom_splat(1.0f), (lom_float){ 0 }));
        sum = lom_add3(sum, lom_scale3(color, weight));
        weights = weights + weight;
    }
    return lom_scale3(sum, 1.0f / lom_max(weights, lom_splat(1e-12f)));
}

/* Where the frame shows the place that a bent ray comes to, at most `reach` pixels from that of the surface. */
static lom_float3 look_along(const struct lom_fluid_uniforms *u, const lom_varyings *in, const struct seen *s,
                             lom_float3 bent, lom_float length)
{
    lom_float4 c = lom_transform4(&u->view.clip_from_offset, lom_add3(s->offset, lom_scale3(bent, length)));
    lom_float half = 0.5f / lom_max(c.w, lom_splat(1e-6f));
    lom_float x = (0.5f + c.x * half) * u->size[0] - in->x, y = (0.5f - c.y * half) * u->size[1] - in->y;
    lom_float far = lom_sqrt(x * x + y * y),
              share = lom_min(u->reach / lom_max(far, lom_splat(1e-6f)), lom_splat(1.0f));
    lom_float to_x = in->x + x * share, to_y = in->y + y * share;
    return look_behind(u, to_x, to_y, s->reach, bent);
}

static void fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct lom_fluid_uniforms *u = uniforms;
    struct seen s = look_at(u, in);
    lom_float3 normal =
        lom_normalize3((lom_float3){ in->varying[NORMAL], in->varying[NORMAL + 1], in->varying[NORMAL + 2] });
    lom_float3 d = lom_scale3(s.path, 1.0f / lom_max(s.distance, lom_splat(1e-30f)));
    /* What is seen faces the eye. */
    lom_float turn = lom_max(0.08f + lom_dot3(normal, d), (lom_float){ 0 });
    normal = lom_normalize3(lom_sub3(normal, lom_scale3(d, turn)));
    lom_int column = lom_to_int(in->x) - u->origin[0], row = lom_to_int(in->y) - u->origin[1];
    lom_float length = lom_max(lom_fetch(u->length, column, row, 0).x, (lom_float){ 0 });
    lom_float cosine = lom_saturate(-lom_dot3(normal, d));
    lom_float share = lom_fresnel_exact(cosine, lom_splat(u->eta));
    lom_float3 bent = d, mirrored = lom_reflect3(d, normal);
    lom_refract3(d, normal, lom_splat(u->eta), &bent);
    lom_float3 through = lom_transmittance(u->absorption, length);
    lom_float3 one = lom_splat3(1, 1, 1);
    struct lom_lit lit = lom_phong_light(&u->view, &u->body, s.offset, normal, lom_splat(1.0f));
    lom_float3 transmitted = lom_add3(lom_mul3(look_along(u, in, &s, bent, length), through),
                                      lom_mul3(lit.textured, lom_sub3(one, through)));
    /* A ray that is mirrored down meets the liquid or its basin, whose light is taken to be what is seen here. */
    lom_float up = lom_saturate(0.5f + 4.0f * mirrored.y);
    lom_float3 above = { mirrored.x, lom_max(mirrored.y, lom_splat(1e-3f)), mirrored.z };
    lom_float3 sky = lom_sky_radiance(&u->sky, lom_normalize3(above), (lom_float){ 0 });
    lom_float3 reflected = lom_mix3(transmitted, sky, up);
    lom_float3 color = lom_add3(lom_mix3(transmitted, reflected, share), lit.highlight);
    LOM_NAME_VALUE(normal);
    LOM_NAME_VALUE(length);
    LOM_NAME_VALUE(transmitted);
    LOM_NAME_VALUE(reflected);
    LOM_NAME_AS(reflected_share, share);
    lom_finish_opaque(out, &u->view, s.offset, color);
}

LOM_SHADER(lom_fluid_copy_shader, square_vertex, copy_fragment, .reads_position = true, .colors = 1,
           .uniforms_size = sizeof(struct lom_fluid_uniforms))
LOM_SHADER(lom_fluid_length_shader, length_vertex, length_fragment, .attributes = 1, .varyings = LENGTH_VARYINGS,
           .reads = LOM_VARYINGS(0, LENGTH_VARYINGS), .reads_position = true, .colors = 1, .reads_depth = true,
           .uniforms_size = sizeof(struct lom_fluid_uniforms))
LOM_SHADER(lom_fluid_shader, vertex, fragment, .attributes = 2, .varyings = VARYINGS, .clip_distances = 1,
           .reads = LOM_VARYINGS(0, VARYINGS), .reads_position = true, .colors = 1,
           .uniforms_size = sizeof(struct lom_fluid_uniforms))
