/* The shaders of terrain: a base texture and layers painted over it by height and slope, with Phong's reflection at
 * three shading frequencies. A layer that no fragment of a packet shows is not sampled. */
#include "render/ground/shaders.h"
#include "shading/phong.h"

enum { OFFSET = 0, VARYINGS = 3, TEXTURED = 3, HIGHLIGHT = 6, LIT_VARYINGS = 9 };

/* What the texture of vertices says of a place. */
struct ground {
    lom_float3 normal;
    lom_float slope; /* radians */
    lom_float sky;   /* the visible share of it */
};

/* Vertices are places over the terrain's base. What the eye's float leaves of it is taken away last: near the eye the
 * first difference is exact (Sterbenz 1974), so terrain of any size is as sharp as a small one. */
static lom_float3 transform(lom_vertex *out, const lom_attributes *in, const struct lom_terrain_uniforms *terrain)
{
    lom_float3 place = { in->attribute[0].x, in->attribute[0].y, in->attribute[0].z };
    lom_float3 offset = lom_sub3(lom_sub3(place, lom_uniform3(terrain->eye)), lom_uniform3(terrain->eye_rest));
    LOM_NAME_VALUE(offset);
    out->position = lom_transform4(&terrain->view.clip_from_offset, offset);
    out->distance[0] = lom_transform_row(terrain->view.plane, offset);
    out->varying[OFFSET] = offset.x;
    out->varying[OFFSET + 1] = offset.y;
    out->varying[OFFSET + 2] = offset.z;
    return offset;
}

static struct ground look_up(const struct lom_terrain_uniforms *terrain, lom_float3 offset, lom_float lod)
{
    lom_float4 texel =
        lom_sample(terrain->vertex_texture, offset.x * terrain->vertex_scale[0] + terrain->vertex_shift[0],
                   offset.z * terrain->vertex_scale[1] + terrain->vertex_shift[1], lod);
    struct ground g = { .normal = lom_normalize3((lom_float3){ texel.x, texel.y, texel.z }), .sky = texel.w };
    g.slope = lom_acos(lom_clamp(g.normal.y, lom_splat(-1.0f), lom_splat(1.0f)));
    return g;
}

static void vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    transform(out, in, uniforms);
}

static void lit_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct lom_terrain_uniforms *terrain = uniforms;
    lom_float3 offset = transform(out, in, terrain);
    struct ground g = look_up(terrain, offset, (lom_float){ 0 });
    struct lom_lit lit = lom_phong_light(&terrain->view, &terrain->material, offset, g.normal, g.sky);
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

static struct ground look_up_fragment(const struct lom_terrain_uniforms *terrain, const lom_varyings *in)
{
    const float *scale = terrain->vertex_scale;
    lom_float lod =
        lom_lod_of(terrain->vertex_texture, lom_dx(in, OFFSET) * scale[0], lom_dx(in, OFFSET + 2) * scale[1],
                   lom_dy(in, OFFSET) * scale[0], lom_dy(in, OFFSET + 2) * scale[1]);
    return look_up(terrain, load3(in, OFFSET), lod);
}

/* A map as it lies on a side: from above x runs right and z down. */
static lom_float4 sample_side(const struct lom_laid_uniform *laid, const lom_varyings *in, int side)
{
    const float *scale = laid->scale[side], *shift = laid->shift[side];
    int s = side == LOM_SIDE_X ? OFFSET + 2 : OFFSET, t = side == LOM_SIDE_ABOVE ? OFFSET + 2 : OFFSET + 1;
    return lom_sample_gradient(laid->map, in->varying[s] * scale[0] + shift[0], in->varying[t] * scale[1] + shift[1],
                               lom_dx(in, s) * scale[0], lom_dx(in, t) * scale[1], lom_dy(in, s) * scale[0],
                               lom_dy(in, t) * scale[1]);
}

/* From the three sides, mixed by how much the surface faces each: the squares of the normal's components, of which
 * those below a fifth count nothing. So nearly every packet takes one or two samples, and no wall is stretched. */
static lom_float4 sample_sides(const struct lom_laid_uniform *laid, const lom_varyings *in, lom_float3 normal)
{
    lom_float3 square = lom_mul3(normal, normal);
    lom_float share[3] = { lom_max(square.x - 0.2f, (lom_float){ 0 }), lom_max(square.y - 0.2f, (lom_float){ 0 }),
                           lom_max(square.z - 0.2f, (lom_float){ 0 }) };
    lom_float inverse = 1.0f / (share[0] + share[1] + share[2]);
    lom_float4 sum = { { 0 }, { 0 }, { 0 }, { 0 } };
    for (int side = 0; side < LOM_SIDES; side++) {
        if (!lom_any(share[side] > 0.0f))
            continue;
        lom_float4 texel = sample_side(laid, in, side);
        lom_float weight = share[side] * inverse;
        sum.x += texel.x * weight;
        sum.y += texel.y * weight;
        sum.z += texel.z * weight;
    }
    return sum;
}

/* 1 inside [from, to], falling to 0 over `blend` outside it, linearly. */
LOM_INLINE lom_float range_weight(lom_float x, float from, float to, float blend)
{
    float inverse = 1.0f / blend;
    return lom_saturate(1.0f + (x - from) * inverse) * lom_saturate(1.0f + (to - x) * inverse);
}

/* The weight w of a layer over what lies below it, with the brightness b and the mean brightness m: where it fades, it
 * gains 4 w (1 - w) grain (1 - b / m), so 0 and 1 stay. */
LOM_INLINE lom_float ragged(const struct lom_layer_uniform *layer, lom_float weight, lom_float3 below)
{
    lom_float gain = layer->grain_offset - layer->grain * (0.2126f * below.x + 0.7152f * below.y + 0.0722f * below.z);
    return lom_saturate(weight + 4.0f * weight * (1.0f - weight) * gain);
}

static lom_float3 albedo(const struct lom_terrain_uniforms *terrain, const lom_varyings *in, const struct ground *g)
{
    lom_float3 color = lom_splat3(1, 1, 1);
    if (terrain->base.map != NULL) {
        lom_float4 texel = sample_side(&terrain->base, in, LOM_SIDE_ABOVE);
        color = (lom_float3){ texel.x, texel.y, texel.z };
    }
    for (int i = 0; i < terrain->layer_count; i++) {
        const struct lom_layer_uniform *layer = &terrain->layer[i];
        lom_float weight = range_weight(in->varying[OFFSET + 1], layer->from_height, layer->to_height, layer->blend) *
                           range_weight(g->slope, layer->from_slope, layer->to_slope, layer->slope_blend);
        if (!lom_any(weight > 0.0f))
            continue;
        if (layer->grain != 0)
            weight = ragged(layer, weight, color);
        lom_float4 texel = layer->triplanar ? sample_sides(&layer->laid, in, g->normal)
                                            : sample_side(&layer->laid, in, LOM_SIDE_ABOVE);
        color = lom_mix3(color, (lom_float3){ texel.x, texel.y, texel.z }, weight);
    }
    if (terrain->detail.map != NULL) {
        lom_float4 detail = sample_side(&terrain->detail, in, LOM_SIDE_ABOVE);
        color = lom_mul3(color, (lom_float3){ 2.0f * detail.x, 2.0f * detail.y, 2.0f * detail.z });
    }
    return color;
}

/* The normal map's z points up the surface, its x and y along the ground's x and z. */
static lom_float3 perturb(const struct lom_terrain_uniforms *terrain, const lom_varyings *in, lom_float3 normal)
{
    if (terrain->normals.map == NULL)
        return normal;
    lom_float4 texel = sample_side(&terrain->normals, in, LOM_SIDE_ABOVE);
    lom_float3 bump = { texel.x * 2.0f - 1.0f, { 0 }, texel.y * 2.0f - 1.0f };
    return lom_normalize3(lom_add3(lom_scale3(normal, texel.z * 2.0f - 1.0f), bump));
}

static void finish(lom_fragment *out, const lom_varyings *in, const struct lom_terrain_uniforms *terrain,
                   struct lom_lit lit, const struct ground *g)
{
    lom_float3 ground = albedo(terrain, in, g), color = lom_add3(lom_mul3(lit.textured, ground), lit.highlight);
    LOM_NAME_AS(highlight, lit.highlight);
    LOM_NAME_AS(albedo, ground);
    LOM_NAME_VALUE(color);
    lom_finish_opaque(out, &terrain->view, load3(in, OFFSET), color);
}

static void phong_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct lom_terrain_uniforms *terrain = uniforms;
    struct ground g = look_up_fragment(terrain, in);
    lom_float3 normal = perturb(terrain, in, g.normal);
    finish(out, in, terrain, lom_phong_light(&terrain->view, &terrain->material, load3(in, OFFSET), normal, g.sky), &g);
}

static void flat_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct lom_terrain_uniforms *terrain = uniforms;
    struct ground g = look_up_fragment(terrain, in);
    lom_float3 normal = lom_face_normal(in, OFFSET, g.normal);
    finish(out, in, terrain, lom_phong_light(&terrain->view, &terrain->material, load3(in, OFFSET), normal, g.sky), &g);
}

static void gouraud_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct lom_terrain_uniforms *terrain = uniforms;
    struct ground g = look_up_fragment(terrain, in);
    finish(out, in, terrain, (struct lom_lit){ load3(in, TEXTURED), load3(in, HIGHLIGHT) }, &g);
}

LOM_SHADER(lom_terrain_phong, vertex, phong_fragment, .attributes = 1, .varyings = VARYINGS, .clip_distances = 1,
           .reads = LOM_VARYINGS(OFFSET, 3), .differentiates = LOM_VARYINGS(OFFSET, 3), .colors = 1,
           .uniforms_size = sizeof(struct lom_terrain_uniforms))
LOM_SHADER(lom_terrain_flat, vertex, flat_fragment, .attributes = 1, .varyings = VARYINGS, .clip_distances = 1,
           .reads = LOM_VARYINGS(OFFSET, 3), .differentiates = LOM_VARYINGS(OFFSET, 3), .colors = 1,
           .uniforms_size = sizeof(struct lom_terrain_uniforms))
LOM_SHADER(lom_terrain_gouraud, lit_vertex, gouraud_fragment, .attributes = 1, .varyings = LIT_VARYINGS,
           .clip_distances = 1, .reads = LOM_VARYINGS(0, LIT_VARYINGS), .differentiates = LOM_VARYINGS(OFFSET, 3),
           .colors = 1, .uniforms_size = sizeof(struct lom_terrain_uniforms))
