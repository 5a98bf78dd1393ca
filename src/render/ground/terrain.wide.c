/* The shaders of terrain: a base texture and layers painted over it by height and slope, with Phong's reflection at
 * three shading frequencies. Of a packet no layer is sampled that none of its fragments shows, and nothing below a
 * layer that covers all of them. */
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
static lom_float3 transform(lom_vertex *out, lom_float3 place, const struct lom_terrain_uniforms *terrain)
{
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

LOM_INLINE lom_float3 place_of(const lom_attributes *in)
{
    return (lom_float3){ in->attribute[0].x, in->attribute[0].y, in->attribute[0].z };
}

static void vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    transform(out, place_of(in), uniforms);
}

static void light_vertex(lom_vertex *out, lom_float3 place, const struct lom_terrain_uniforms *terrain)
{
    lom_float3 offset = transform(out, place, terrain);
    struct ground g = look_up(terrain, offset, (lom_float){ 0 });
    struct lom_lit lit = lom_phong_light(&terrain->view, &terrain->material, offset, g.normal, g.sky);
    out->varying[TEXTURED] = lit.textured.x;
    out->varying[TEXTURED + 1] = lit.textured.y;
    out->varying[TEXTURED + 2] = lit.textured.z;
    out->varying[HIGHLIGHT] = lit.highlight.x;
    out->varying[HIGHLIGHT + 1] = lit.highlight.y;
    out->varying[HIGHLIGHT + 2] = lit.highlight.z;
}

static void lit_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    light_vertex(out, place_of(in), uniforms);
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
    lom_float inverse = 1.0f / lom_max(share[0] + share[1] + share[2], lom_splat(0x1p-20f)); /* of no normal, 0 */
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

/* How much of each fragment a layer covers. Heights are looked at first: most layers of a packet are out of their
 * range. */
static lom_float layer_weight(const struct lom_layer_uniform *layer, lom_float height, lom_float slope)
{
    lom_float weight = range_weight(height, layer->from_height, layer->to_height, layer->blend);
    if (!lom_any(weight > 0.0f))
        return weight;
    return weight * range_weight(slope, layer->from_slope, layer->to_slope, layer->slope_blend);
}

static lom_float3 sample_layer(const struct lom_layer_uniform *layer, const lom_varyings *in, lom_float3 normal)
{
    lom_float4 texel =
        layer->triplanar ? sample_sides(&layer->laid, in, normal) : sample_side(&layer->laid, in, LOM_SIDE_ABOVE);
    return (lom_float3){ texel.x, texel.y, texel.z };
}

static lom_float3 sample_base(const struct lom_terrain_uniforms *terrain, const lom_varyings *in)
{
    if (terrain->base.map == NULL)
        return lom_splat3(1, 1, 1);
    lom_float4 texel = sample_side(&terrain->base, in, LOM_SIDE_ABOVE);
    return (lom_float3){ texel.x, texel.y, texel.z };
}

/* `above` itself where its share is 1, `below` where it is 0. */
LOM_INLINE lom_float3 lay_over(lom_float3 below, lom_float3 above, lom_float share)
{
    lom_float3 mixed = lom_mix3(below, above, share);
    lom_mask seen = share<1.0f, covers = share> 0.0f;
    return (lom_float3){ lom_select(covers, lom_select(seen, mixed.x, above.x), below.x),
                         lom_select(covers, lom_select(seen, mixed.y, above.y), below.y),
                         lom_select(covers, lom_select(seen, mixed.z, above.z), below.z) };
}

/* Where a layer's weight is 1 it is the colour, exactly. So what lies below a layer that covers the whole packet is not
 * sampled, and changes no byte. */
static lom_float3 layered(const struct lom_terrain_uniforms *terrain, const lom_varyings *in, const struct ground *g)
{
    lom_float weight[LOM_MAX_TERRAIN_LAYERS];
    lom_float3 color;
    int first = 0;
    for (int i = 0; i < terrain->layer_count; i++) {
        weight[i] = layer_weight(&terrain->layer[i], in->varying[OFFSET + 1], g->slope);
        first = lom_any(weight[i] < 1.0f) ? first : i + 1;
    }
    color = first > 0 ? sample_layer(&terrain->layer[first - 1], in, g->normal) : sample_base(terrain, in);
    for (int i = first; i < terrain->layer_count; i++) {
        const struct lom_layer_uniform *layer = &terrain->layer[i];
        if (!lom_any(weight[i] > 0.0f))
            continue;
        lom_float share = layer->grain != 0 ? ragged(layer, weight[i], color) : weight[i];
        lom_float3 above = sample_layer(layer, in, g->normal);
        color = lay_over(color, above, share);
    }
    return color;
}

static lom_float3 detailed(const struct lom_terrain_uniforms *terrain, const lom_varyings *in, const struct ground *g)
{
    lom_float3 color = layered(terrain, in, g);
    if (terrain->detail.map != NULL) {
        lom_float4 detail = sample_side(&terrain->detail, in, LOM_SIDE_ABOVE);
        color = lom_mul3(color, (lom_float3){ 2.0f * detail.x, 2.0f * detail.y, 2.0f * detail.z });
    }
    return color;
}

/* How much of a fragment's colour is the composed picture's: all from its level of detail on, none half a level before.
 * On a slope a texel from above covers more of the surface, by 1 / cosine. */
static lom_float composed_share(const struct lom_terrain_uniforms *terrain, const lom_varyings *in,
                                const struct ground *g)
{
    const float *scale = terrain->composed.scale[LOM_SIDE_ABOVE];
    lom_float lod = lom_lod_of(terrain->composed.map, lom_dx(in, OFFSET) * scale[0], lom_dx(in, OFFSET + 2) * scale[1],
                               lom_dy(in, OFFSET) * scale[0], lom_dy(in, OFFSET + 2) * scale[1]);
    lod = lod + lom_log2(lom_max(g->normal.y, lom_splat(0x1p-6f)));
    return lom_saturate(1.0f + 2.0f * (lod - terrain->composed_level));
}

static lom_float3 albedo(const struct lom_terrain_uniforms *terrain, const lom_varyings *in, const struct ground *g)
{
    if (terrain->composed.map == NULL)
        return detailed(terrain, in, g);
    lom_float share = composed_share(terrain, in, g);
    lom_float3 color = { { 0 }, { 0 }, { 0 } };
    if (lom_any(share < 1.0f))
        color = detailed(terrain, in, g);
    if (!lom_any(share > 0.0f))
        return color;
    lom_float4 texel = sample_side(&terrain->composed, in, LOM_SIDE_ABOVE);
    return lay_over(color, (lom_float3){ texel.x, texel.y, texel.z }, share);
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

static void albedo_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct lom_terrain_uniforms *terrain = uniforms;
    struct ground g = look_up_fragment(terrain, in);
    lom_float3 color = albedo(terrain, in, &g);
    out->color[0] = (lom_float4){ color.x, color.y, color.z, lom_splat(1.0f) };
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
LOM_SHADER(lom_terrain_albedo, vertex, albedo_fragment, .attributes = 1, .varyings = VARYINGS, .clip_distances = 1,
           .reads = LOM_VARYINGS(OFFSET, 3), .differentiates = LOM_VARYINGS(OFFSET, 3), .colors = 1,
           .uniforms_size = sizeof(struct lom_terrain_uniforms))

/* ---- patches ---- */

/* Column, row, height and error of a knot, as they are. */
static void knot(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    (void)uniforms;
    out->position = in->attribute[0];
}

LOM_INLINE lom_float3 place_at(const struct lom_cut_uniform *cut, lom_float column, lom_float row, lom_float height)
{
    return (lom_float3){ column * cut->step[0] + cut->corner[0], height, row * cut->step[1] + cut->corner[1] };
}

/* Segments of the edge between two knots: with n of them it is off by about 1 / n of what a whole edge is (terrain is rough:
 * of something smooth it would be 1 / n^2), which at its nearest place may be seen as much as is allowed. The same from
 * either end. */
static lom_float level_of(const struct lom_cut_uniform *cut, const lom_vertex *a, const lom_vertex *b)
{
    lom_float3 p = place_at(cut, a->position.x, a->position.y, a->position.z);
    lom_float3 q = place_at(cut, b->position.x, b->position.y, b->position.z);
    lom_float3 middle = lom_scale3(lom_add3(p, q), lom_splat(0.5f));
    lom_float3 along = lom_sub3(q, p), off = lom_sub3(middle, lom_uniform3(cut->eye));
    lom_float half = lom_sqrt(lom_dot3(along, along)) * 0.5f;
    lom_float away = lom_max(lom_sqrt(lom_dot3(off, off)) - half, lom_splat(1e-3f));
    if (cut->parallel)
        away = lom_splat(1);
    return lom_max(lom_max(a->position.w, b->position.w) * cut->scale / away, lom_splat(1));
}

static void cut_patch(lom_levels *out, const lom_patch *in, const void *uniforms)
{
    const struct lom_cut_uniform *cut = &((const struct lom_terrain_uniforms *)uniforms)->cut;
    for (int i = 0; i < 4; i++)
        out->outer[i] = level_of(cut, &in->point[(i + 3) % 4], &in->point[i]);
    out->inner[0] = lom_max(out->outer[1], out->outer[3]);
    out->inner[1] = lom_max(out->outer[0], out->outer[2]);
}

LOM_INLINE lom_float height_of(const struct lom_cut_uniform *cut, lom_int column, lom_int row)
{
    return lom_gather(cut->heights, row * (cut->columns + 1) + column);
}

/* On the map's triangles, a b c and d c b of each quad: a function of column and row alone, so neighbours agree. */
static lom_float3 place_on_map(const lom_domain_point *in, const struct lom_cut_uniform *cut)
{
    const lom_vertex *p = in->patch.point;
    lom_float column = p[0].position.x + in->u * (p[1].position.x - p[0].position.x);
    lom_float row = p[0].position.y + in->v * (p[3].position.y - p[0].position.y);
    lom_int i = lom_min_int(lom_to_int(column), lom_splat_int(cut->columns - 1));
    lom_int j = lom_min_int(lom_to_int(row), lom_splat_int(cut->rows - 1));
    lom_float s = column - lom_to_float(i), t = row - lom_to_float(j);
    lom_float a = height_of(cut, i, j), b = height_of(cut, i + 1, j);
    lom_float c = height_of(cut, i, j + 1), d = height_of(cut, i + 1, j + 1);
    lom_float upper = a + s * (b - a) + t * (c - a), lower = d + (1.0f - s) * (c - d) + (1.0f - t) * (b - d);
    return place_at(cut, column, row, lom_select(s + t <= 1.0f, upper, lower));
}

static void evaluate(lom_vertex *out, const lom_domain_point *in, const void *uniforms)
{
    const struct lom_terrain_uniforms *terrain = uniforms;
    transform(out, place_on_map(in, &terrain->cut), terrain);
}

static void evaluate_lit(lom_vertex *out, const lom_domain_point *in, const void *uniforms)
{
    const struct lom_terrain_uniforms *terrain = uniforms;
    light_vertex(out, place_on_map(in, &terrain->cut), terrain);
}

LOM_TESSELLATION(lom_terrain_patches, cut_patch, evaluate, .domain = LOM_DOMAIN_QUADS,
                 .spacing = LOM_SPACING_FRACTIONAL_EVEN, .most = LOM_GROUND_PATCH)
LOM_TESSELLATION(lom_terrain_lit_patches, cut_patch, evaluate_lit, .domain = LOM_DOMAIN_QUADS,
                 .spacing = LOM_SPACING_FRACTIONAL_EVEN, .most = LOM_GROUND_PATCH)
LOM_SHADER(lom_terrain_cut_phong, knot, phong_fragment, .attributes = 1, .varyings = VARYINGS, .clip_distances = 1,
           .reads = LOM_VARYINGS(OFFSET, 3), .differentiates = LOM_VARYINGS(OFFSET, 3), .colors = 1,
           .uniforms_size = sizeof(struct lom_terrain_uniforms))
LOM_SHADER(lom_terrain_cut_flat, knot, flat_fragment, .attributes = 1, .varyings = VARYINGS, .clip_distances = 1,
           .reads = LOM_VARYINGS(OFFSET, 3), .differentiates = LOM_VARYINGS(OFFSET, 3), .colors = 1,
           .uniforms_size = sizeof(struct lom_terrain_uniforms))
LOM_SHADER(lom_terrain_cut_gouraud, knot, gouraud_fragment, .attributes = 1, .varyings = LIT_VARYINGS,
           .clip_distances = 1, .reads = LOM_VARYINGS(0, LIT_VARYINGS), .differentiates = LOM_VARYINGS(OFFSET, 3),
           .colors = 1, .uniforms_size = sizeof(struct lom_terrain_uniforms))
