/* The shaders of the classical models. In: billboards from far to near and their picture; or four pictures that are laid
 * over one another. Out: colour times opacity, and opacity. Invariant: a billboard faces the eye's plane; its light is
 * that of its middle. What a sheet takes of the light behind it is the same from all sides. */
#include "cloud/cloud_phases.h"
#include "cloud/cloud_rays.h"
#include "cloud/cloud_sprites.h"
#include "march/medium_steps.h"

enum { RED = PICTURE_VARYINGS, SPRITE_VARYINGS = RED + 3 };
enum { FINE_S = PICTURE_VARYINGS, FINE_T, SHEET_VARYINGS };

static lom_float part_of(const struct lom_cloud_uniforms *cloud, lom_int sprite, int part)
{
    return lom_gather(cloud->sprites, sprite * LOM_SPRITE_FLOATS + part);
}

/* What the middle of a billboard scatters towards the eye. */
static lom_float3 sprite_light(const struct lom_cloud_uniforms *cloud, lom_int sprite, lom_float3 offset)
{
    lom_float3 p = { part_of(cloud, sprite, LOM_SPRITE_IN_BOX), part_of(cloud, sprite, LOM_SPRITE_IN_BOX + 1),
                     part_of(cloud, sprite, LOM_SPRITE_IN_BOX + 2) };
    lom_medium_rays rays = { .active = lom_splat_int(-1) };
    lom_set_cloud_phase(cloud, &rays, lom_scale3(lom_to_eye(&cloud->eye, offset), lom_splat(-1.0f)));
    lom_light_sample light = share_surroundings(lom_sample_light(cloud->march.light, p));
    lom_float3 color = lom_scale3(lom_uniform3(cloud->sun), sun_share(&cloud->march, &rays, light.sun));
    color = lom_add3(color, lom_scale3(lom_uniform3(cloud->sky), light.sky));
    return lom_add3(color, lom_scale3(lom_uniform3(cloud->ground), light.ground));
}

/* Six vertices a billboard: lower left, lower right, upper left, upper left, lower right, upper right. */
static void sprite_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct lom_cloud_uniforms *cloud = uniforms;
    lom_int sprite = lom_to_int(lom_floor((lom_to_float(in->vertex) + 0.5f) * (1 / 6.0f)));
    lom_int corner = in->vertex - sprite * 6;
    lom_mask right = (corner == 1) | (corner >= 4), above = (corner == 2) | (corner == 3) | (corner == 5);
    lom_float s = lom_select(right, lom_splat(1.0f), (lom_float){ 0 });
    lom_float t = lom_select(above, (lom_float){ 0 }, lom_splat(1.0f));
    lom_float x = 2.0f * s - 1.0f, y = 1.0f - 2.0f * t, half = part_of(cloud, sprite, LOM_SPRITE_HALF);
    lom_float c = part_of(cloud, sprite, LOM_SPRITE_COSINE), d = part_of(cloud, sprite, LOM_SPRITE_SINE);
    lom_float across = (c * x - d * y) * half; /* one that is only mirrored stands upright */
    lom_float up = lom_select(d == 0.0f, y, d * x + c * y) * half;
    lom_float3 middle = { part_of(cloud, sprite, LOM_SPRITE_X) + cloud->corner[0][0],
                          part_of(cloud, sprite, LOM_SPRITE_X + 1) + cloud->corner[0][1],
                          part_of(cloud, sprite, LOM_SPRITE_X + 2) + cloud->corner[0][2] };
    lom_float3 offset = lom_add3(
        middle, lom_add3(lom_scale3(lom_uniform3(cloud->right), across), lom_scale3(lom_uniform3(cloud->up), up)));
    out->position = lom_transform4(&cloud->clip_from_offset, offset);
    lom_float3 color = sprite_light(cloud, sprite, middle);
    const lom_float varying[SPRITE_VARYINGS] = { offset.x, offset.y, offset.z, s, t, color.x, color.y, color.z };
    for (int i = 0; i < SPRITE_VARYINGS; i++)
        out->varying[i] = varying[i];
}

/* How far a fragment is, and 0 where something is drawn before it. */
static lom_float length_of(const struct lom_cloud_uniforms *cloud, const lom_varyings *in, lom_float *alpha)
{
    lom_float3 offset = { in->varying[OFFSET], in->varying[OFFSET + 1], in->varying[OFFSET + 2] };
    offset = lom_eye_path(&cloud->eye, offset);
    lom_float length = lom_sqrt(lom_dot3(offset, offset));
    if (cloud->depth != NULL)
        *alpha = lom_as_float(lom_as_int(*alpha) & (length < lom_scene_distance(cloud, in, length)));
    return length;
}

static void sprite_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct lom_cloud_uniforms *cloud = uniforms;
    lom_float4 texel = lom_sample(cloud->picture, in->varying[S], in->varying[T], lom_lod(cloud->picture, in, S, T));
    lom_float alpha = -lom_expm1(-(texel.w * cloud->sprite_depth));
    lom_float length = length_of(cloud, in, &alpha), shown = texel.x * alpha;
    lom_float3 color = { in->varying[RED] * shown, in->varying[RED + 1] * shown, in->varying[RED + 2] * shown };
    color = lom_cloud_haze(cloud, color, alpha, length);
    out->color[0] = (lom_float4){ color.x, color.y, color.z, alpha };
}

LOM_SHADER(lom_cloud_sprite_shader, sprite_vertex, sprite_fragment, .varyings = SPRITE_VARYINGS,
           .reads = LOM_VARYINGS(0, SPRITE_VARYINGS), .differentiates = 1u << S | 1u << T, .reads_position = true,
           .colors = 1, .uniforms_size = sizeof(struct lom_cloud_uniforms))

static void sheet_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct lom_cloud_uniforms *cloud = uniforms;
    lom_cloud_picture_vertex(out, in, uniforms);
    out->varying[FINE_S] = out->varying[S] * cloud->fine_repeats[0];
    out->varying[FINE_T] = out->varying[T] * cloud->fine_repeats[1];
}

/* What a place sends towards the eye, d of optical depth before it: (s, t) of the gradient are the sine of half the angle
 * to the light, and d / (d + 4). */
static lom_float3 sheet_light(const struct lom_cloud_uniforms *cloud, lom_float3 direction, lom_float depth)
{
    lom_float mu = lom_dot3(direction, lom_uniform3(cloud->to_light));
    lom_float s = lom_sqrt(lom_max(0.5f - 0.5f * mu, (lom_float){ 0 })), d = depth * cloud->way_of_light;
    lom_float4 share = lom_sample(cloud->gradient, s, d / (d + 4.0f), (lom_float){ 0 });
    lom_float3 color = lom_scale3(lom_uniform3(cloud->sun), share.x);
    color = lom_add3(color, lom_scale3(lom_uniform3(cloud->sky), share.y));
    return lom_add3(color, lom_scale3(lom_uniform3(cloud->ground), share.z));
}

static void sheet_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct lom_cloud_uniforms *cloud = uniforms;
    const lom_float s = in->varying[S], t = in->varying[T], u = in->varying[FINE_S], v = in->varying[FINE_T];
    lom_float noise = lom_sample(cloud->picture, s, t, lom_lod(cloud->picture, in, S, T)).x * cloud->noise_scale[0];
    noise *= lom_sample(cloud->fine, u, v, lom_lod(cloud->fine, in, FINE_S, FINE_T)).x * cloud->noise_scale[1];
    lom_float depth = lom_sample(cloud->shape, s, t, lom_lod(cloud->shape, in, S, T)).x * cloud->deepest;
    depth *= 1.0f + (noise - 1.0f) * cloud->eaten;
    lom_float alpha = -lom_expm1(-depth), length = length_of(cloud, in, &alpha);
    lom_float3 offset = lom_eye_path(
        &cloud->eye, (lom_float3){ in->varying[OFFSET], in->varying[OFFSET + 1], in->varying[OFFSET + 2] });
    lom_float3 direction = lom_scale3(offset, 1.0f / lom_max(length, lom_splat(1e-20f)));
    lom_float3 color = lom_cloud_haze(cloud, lom_scale3(sheet_light(cloud, direction, depth), alpha), alpha, length);
    out->color[0] = (lom_float4){ color.x, color.y, color.z, alpha };
}

LOM_SHADER(lom_cloud_sheet_shader, sheet_vertex, sheet_fragment, .varyings = SHEET_VARYINGS,
           .reads = LOM_VARYINGS(0, SHEET_VARYINGS), .differentiates = 1u << S | 1u << T | 1u << FINE_S | 1u << FINE_T,
           .reads_position = true, .colors = 1, .uniforms_size = sizeof(struct lom_cloud_uniforms))
