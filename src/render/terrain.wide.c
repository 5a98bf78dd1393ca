/* The shaders of terrain: a base texture and layers painted over it by height and slope, with Phong's reflection at
 * three shading frequencies. A layer that no fragment of a packet shows is not sampled. */
#include "render/light.h"

enum { WORLD = 0, NORMAL = 3, SLOPE = 6, TEXTURED = 7, HIGHLIGHT = 10 };

static lom_float3 transform(lom_vertex *out, const lom_attributes *in, const struct lom_terrain_uniforms *terrain)
{
    lom_float3 world = { in->attribute[0].x, in->attribute[0].y, in->attribute[0].z };
    out->position = lom_transform4(&terrain->view.clip_from_world, world);
    out->distance[0] = lom_transform_row(terrain->view.plane, world);
    out->varying[WORLD] = world.x;
    out->varying[WORLD + 1] = world.y;
    out->varying[WORLD + 2] = world.z;
    out->varying[NORMAL] = in->attribute[1].x;
    out->varying[NORMAL + 1] = in->attribute[1].y;
    out->varying[NORMAL + 2] = in->attribute[1].z;
    out->varying[SLOPE] = lom_acos(lom_clamp(in->attribute[1].y, lom_splat(-1.0f), lom_splat(1.0f)));
    return world;
}

static void vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    transform(out, in, uniforms);
}

static void lit_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct lom_terrain_uniforms *terrain = uniforms;
    lom_float3 world = transform(out, in, terrain);
    lom_float3 normal = { in->attribute[1].x, in->attribute[1].y, in->attribute[1].z };
    struct lom_lit lit = lom_light_surface(&terrain->view, &terrain->material, world, normal);
    out->varying[TEXTURED] = lit.textured.x;
    out->varying[TEXTURED + 1] = lit.textured.y;
    out->varying[TEXTURED + 2] = lit.textured.z;
    out->varying[HIGHLIGHT] = lit.highlight.x;
    out->varying[HIGHLIGHT + 1] = lit.highlight.y;
    out->varying[HIGHLIGHT + 2] = lit.highlight.z;
}

LOM_INLINE lom_float3 load3(const lom_varyings *in, int v)
{
    return (lom_float3){ in->varying[v], in->varying[v + 1], in->varying[v + 2] };
}

/* A map laid over x and z, scale repetitions a metre. */
static lom_float4 sample_ground(const lom_texture *map, const lom_varyings *in, const float scale[2])
{
    lom_float lod = lom_lod_of(map, lom_dx(in, WORLD) * scale[0], lom_dx(in, WORLD + 2) * scale[1],
                               lom_dy(in, WORLD) * scale[0], lom_dy(in, WORLD + 2) * scale[1]);
    return lom_sample(map, in->varying[WORLD] * scale[0], in->varying[WORLD + 2] * scale[1], lod);
}

/* 1 inside [from, to], falling to 0 over `blend` outside it, linearly. */
LOM_INLINE lom_float range_weight(lom_float x, float from, float to, float blend)
{
    float inverse = 1.0f / blend;
    return lom_saturate(1.0f + (x - from) * inverse) * lom_saturate(1.0f + (to - x) * inverse);
}

static lom_float3 albedo(const struct lom_terrain_uniforms *terrain, const lom_varyings *in)
{
    lom_float3 color = lom_splat3(1, 1, 1);
    if (terrain->material.texture != NULL) {
        lom_float4 texel = sample_ground(terrain->material.texture, in, terrain->scale);
        color = (lom_float3){ texel.x, texel.y, texel.z };
    }
    for (int i = 0; i < terrain->layer_count; i++) {
        const struct lom_layer_uniform *layer = &terrain->layer[i];
        lom_float weight = range_weight(in->varying[WORLD + 1], layer->from_height, layer->to_height, layer->blend) *
                           range_weight(in->varying[SLOPE], layer->from_slope, layer->to_slope, layer->slope_blend);
        if (!lom_any(weight > 0.0f))
            continue;
        lom_float4 texel = sample_ground(layer->map, in, layer->scale);
        color = lom_mix3(color, (lom_float3){ texel.x, texel.y, texel.z }, weight);
    }
    if (terrain->detail_map != NULL) {
        lom_float4 detail = sample_ground(terrain->detail_map, in, terrain->detail_scale);
        color = lom_mul3(color, (lom_float3){ 2.0f * detail.x, 2.0f * detail.y, 2.0f * detail.z });
    }
    return color;
}

/* The normal map's z points up the surface, its x and y along the ground's x and z. */
static lom_float3 perturb(const struct lom_terrain_uniforms *terrain, const lom_varyings *in, lom_float3 normal)
{
    if (terrain->normal_map == NULL)
        return normal;
    lom_float4 texel = sample_ground(terrain->normal_map, in, terrain->detail_scale);
    lom_float3 bump = { texel.x * 2.0f - 1.0f, { 0 }, texel.y * 2.0f - 1.0f };
    return lom_normalize3(lom_add3(lom_scale3(normal, texel.z * 2.0f - 1.0f), bump));
}

static void finish(lom_fragment *out, lom_float3 textured, lom_float3 highlight, lom_float3 texel)
{
    lom_float3 color = lom_add3(lom_mul3(textured, texel), highlight);
    out->color[0] = (lom_float4){ color.x, color.y, color.z, lom_splat(1.0f) };
}

static void shade(lom_fragment *out, const lom_varyings *in, const struct lom_terrain_uniforms *terrain,
                  lom_float3 normal)
{
    struct lom_lit lit = lom_light_surface(&terrain->view, &terrain->material, load3(in, WORLD), normal);
    finish(out, lit.textured, lit.highlight, albedo(terrain, in));
}

static void phong_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    shade(out, in, uniforms, perturb(uniforms, in, lom_normalize3(load3(in, NORMAL))));
}

static void flat_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    shade(out, in, uniforms, lom_face_normal(in, WORLD, load3(in, NORMAL)));
}

static void gouraud_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    finish(out, load3(in, TEXTURED), load3(in, HIGHLIGHT), albedo(uniforms, in));
}

LOM_SHADER(lom_terrain_phong, vertex, phong_fragment, .attributes = 2, .varyings = 7, .clip_distances = 1,
           .reads = 0x7f, .differentiates = 5 << WORLD, .colors = 1,
           .uniforms_size = sizeof(struct lom_terrain_uniforms))
LOM_SHADER(lom_terrain_flat, vertex, flat_fragment, .attributes = 2, .varyings = 7, .clip_distances = 1, .reads = 0x7f,
           .differentiates = 7 << WORLD, .colors = 1, .uniforms_size = sizeof(struct lom_terrain_uniforms))
LOM_SHADER(lom_terrain_gouraud, lit_vertex, gouraud_fragment, .attributes = 2, .varyings = 13, .clip_distances = 1,
           .reads = 0x1fc7, .differentiates = 5 << WORLD, .colors = 1,
           .uniforms_size = sizeof(struct lom_terrain_uniforms))
