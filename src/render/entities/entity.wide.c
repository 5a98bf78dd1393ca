/* The shaders of entities: textured meshes with Phong's reflection, at three shading frequencies; and the depth alone,
 * as the sun sees them. */
#include "render/entities/shaders.h"
#include "shading/phong.h"

enum { OFFSET = 0, NORMAL = 3, UV = 6, COLOR = 8, VARYINGS = 11, TEXTURED = 8, HIGHLIGHT = 11, LIT_VARYINGS = 14 };

struct corner {
    lom_float3 offset, normal;
};

static struct corner transform(lom_vertex *out, const lom_attributes *in, const struct lom_entity_uniforms *entity)
{
    lom_float3 model = { in->attribute[0].x, in->attribute[0].y, in->attribute[0].z };
    struct corner c = { lom_transform3(&entity->offset_from_model, model),
                        lom_rotate3(&entity->normal_from_model,
                                    (lom_float3){ in->attribute[1].x, in->attribute[1].y, in->attribute[1].z }) };
    LOM_NAME_AS(offset, c.offset);
    LOM_NAME_AS(normal, c.normal);
    out->position = lom_transform4(&entity->clip_from_model, model);
    out->distance[0] = lom_transform_row(entity->view.plane, c.offset);
    out->varying[OFFSET] = c.offset.x;
    out->varying[OFFSET + 1] = c.offset.y;
    out->varying[OFFSET + 2] = c.offset.z;
    LOM_NAME_AS(s, in->attribute[2].x);
    LOM_NAME_AS(t, in->attribute[2].y);
    out->varying[UV] = in->attribute[2].x;
    out->varying[UV + 1] = in->attribute[2].y;
    return c;
}

static void vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    struct corner c = transform(out, in, uniforms);
    out->varying[NORMAL] = c.normal.x;
    out->varying[NORMAL + 1] = c.normal.y;
    out->varying[NORMAL + 2] = c.normal.z;
    LOM_NAME_AS(tint, in->attribute[3]);
    out->varying[COLOR] = in->attribute[3].x;
    out->varying[COLOR + 1] = in->attribute[3].y;
    out->varying[COLOR + 2] = in->attribute[3].z;
}

static void store3(lom_float *varying, lom_float3 v)
{
    varying[0] = v.x;
    varying[1] = v.y;
    varying[2] = v.z;
}

static void lit_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct lom_entity_uniforms *entity = uniforms;
    struct corner c = transform(out, in, entity);
    struct lom_lit lit =
        lom_phong_light(&entity->view, &entity->material, c.offset, lom_normalize3(c.normal), lom_splat(1.0f));
    lom_float3 color = { in->attribute[3].x, in->attribute[3].y, in->attribute[3].z };
    store3(out->varying + TEXTURED, lom_mul3(lit.textured, color));
    store3(out->varying + HIGHLIGHT, lit.highlight);
}

LOM_INLINE lom_float3 load3(const lom_varyings *in, int v)
{
    return (lom_float3){ in->varying[v], in->varying[v + 1], in->varying[v + 2] };
}

/* White where there is no map. */
static lom_float4 look_up_texel(const lom_texture *map, const lom_varyings *in)
{
    if (map == NULL)
        return (lom_float4){ lom_splat(1), lom_splat(1), lom_splat(1), lom_splat(1) };
    return lom_sample_gradient(map, in->varying[UV], in->varying[UV + 1], lom_dx(in, UV), lom_dx(in, UV + 1),
                               lom_dy(in, UV), lom_dy(in, UV + 1));
}

static lom_float3 look_up(const lom_texture *map, const lom_varyings *in)
{
    lom_float4 texel = look_up_texel(map, in);
    return (lom_float3){ texel.x, texel.y, texel.z };
}

static void finish(lom_fragment *out, const lom_varyings *in, const struct lom_entity_uniforms *entity,
                   lom_float3 textured, lom_float3 highlight)
{
    const struct lom_material_uniform *m = &entity->material;
    if (m->specular_map != NULL)
        highlight = lom_mul3(highlight, look_up(m->specular_map, in));
    const lom_float4 texel = look_up_texel(m->texture, in);
    lom_float3 skin = { texel.x, texel.y, texel.z }, color = lom_add3(lom_mul3(textured, skin), highlight);
    LOM_NAME_VALUE(textured);
    LOM_NAME_VALUE(highlight);
    LOM_NAME_AS(albedo, skin);
    if (m->emits) {
        lom_float3 emitted = lom_mul3(lom_uniform3(m->emissive), look_up(m->emissive_map, in));
        LOM_NAME_VALUE(emitted);
        color = lom_add3(color, emitted);
    }
    LOM_NAME_VALUE(color);
    lom_finish_opaque(out, &entity->view, load3(in, OFFSET), color);
    if (entity->cuts)
        out->color[0].w = texel.w;
}

LOM_INLINE struct lom_lit light_up(const lom_varyings *in, const struct lom_entity_uniforms *entity, lom_float3 normal)
{
    const struct lom_material_uniform *m = &entity->material;
    struct lom_lit lit;
    if (m->gloss_map != NULL) {
        lom_float3 offset = load3(in, OFFSET);
        lom_float sky = lom_splat(1.0f), exponent = m->shininess * look_up(m->gloss_map, in).x;
        LOM_WIDE(lom_phong_light_lanes)(&entity->view, m, &offset, &normal, &sky, &exponent, &lit);
    } else {
        lit = lom_phong_light(&entity->view, m, load3(in, OFFSET), normal, lom_splat(1.0f));
    }
    return lit;
}

static void shade(lom_fragment *out, const lom_varyings *in, const struct lom_entity_uniforms *entity,
                  lom_float3 normal)
{
    struct lom_lit lit = light_up(in, entity, normal);
    finish(out, in, entity, lom_mul3(lit.textured, load3(in, COLOR)), lit.highlight);
}

/* The normal of a normal map over the interpolated one. The triangle's tangents are d offset / d s and d offset / d t,
 * solved for from what both change by along x and y of the screen; each is made upright to the normal, and of unit length.
 * The map's green points up the picture, against t. Where the texture has no area, the normal stays. */
static lom_float3 perturb(const lom_varyings *in, const lom_texture *map, lom_float3 normal)
{
    lom_float3 px = { lom_dx(in, OFFSET), lom_dx(in, OFFSET + 1), lom_dx(in, OFFSET + 2) };
    lom_float3 py = { lom_dy(in, OFFSET), lom_dy(in, OFFSET + 1), lom_dy(in, OFFSET + 2) };
    lom_float sx = lom_dx(in, UV), tx = lom_dx(in, UV + 1), sy = lom_dy(in, UV), ty = lom_dy(in, UV + 1);
    lom_float area = sx * ty - tx * sy;
    lom_float sign = lom_select(area < 0.0f, lom_splat(-1.0f), lom_splat(1.0f));
    lom_float3 along_s = lom_scale3(lom_sub3(lom_scale3(px, ty), lom_scale3(py, tx)), sign);
    lom_float3 along_t = lom_scale3(lom_sub3(lom_scale3(py, sx), lom_scale3(px, sy)), sign);
    along_s = lom_normalize3(lom_sub3(along_s, lom_scale3(normal, lom_dot3(normal, along_s))));
    along_t = lom_normalize3(lom_sub3(along_t, lom_scale3(normal, lom_dot3(normal, along_t))));
    lom_float3 texel = look_up(map, in);
    lom_float right = texel.x * 2.0f - 1.0f, up = texel.y * 2.0f - 1.0f, off = texel.z * 2.0f - 1.0f;
    lom_float3 bent = lom_sub3(lom_add3(lom_scale3(normal, off), lom_scale3(along_s, right)), lom_scale3(along_t, up));
    bent = lom_normalize3(bent);
    lom_mask flat = area == 0.0f;
    return (lom_float3){ lom_select(flat, normal.x, bent.x), lom_select(flat, normal.y, bent.y),
                         lom_select(flat, normal.z, bent.z) };
}

static void bumped_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct lom_entity_uniforms *entity = uniforms;
    shade(out, in, entity, perturb(in, entity->material.normal_map, lom_normalize3(load3(in, NORMAL))));
}

static void phong_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    shade(out, in, uniforms, lom_normalize3(load3(in, NORMAL)));
}

static void flat_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    shade(out, in, uniforms, lom_face_normal(in, OFFSET, load3(in, NORMAL)));
}

static void gouraud_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    finish(out, in, uniforms, load3(in, TEXTURED), load3(in, HIGHLIGHT));
}

LOM_SHADER(lom_entity_phong, vertex, phong_fragment, .attributes = 4, .varyings = VARYINGS, .clip_distances = 1,
           .reads = LOM_VARYINGS(0, VARYINGS), .differentiates = LOM_VARYINGS(UV, 2), .colors = 1,
           .uniforms_size = sizeof(struct lom_entity_uniforms))
LOM_SHADER(lom_entity_bumped, vertex, bumped_fragment, .attributes = 4, .varyings = VARYINGS, .clip_distances = 1,
           .reads = LOM_VARYINGS(0, VARYINGS), .differentiates = LOM_VARYINGS(UV, 2) | LOM_VARYINGS(OFFSET, 3),
           .colors = 1, .uniforms_size = sizeof(struct lom_entity_uniforms))
LOM_SHADER(lom_entity_flat, vertex, flat_fragment, .attributes = 4, .varyings = VARYINGS, .clip_distances = 1,
           .reads = LOM_VARYINGS(0, VARYINGS), .differentiates = LOM_VARYINGS(UV, 2) | LOM_VARYINGS(OFFSET, 3),
           .colors = 1, .uniforms_size = sizeof(struct lom_entity_uniforms))
LOM_SHADER(lom_entity_gouraud, lit_vertex, gouraud_fragment, .attributes = 4, .varyings = LIT_VARYINGS,
           .clip_distances = 1, .reads = LOM_VARYINGS(TEXTURED, 6) | LOM_VARYINGS(UV, 2) | LOM_VARYINGS(OFFSET, 3),
           .differentiates = LOM_VARYINGS(UV, 2), .colors = 1, .uniforms_size = sizeof(struct lom_entity_uniforms))

static void point_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct lom_entity_uniforms *entity = uniforms;
    vertex(out, in, uniforms);
    out->point_size = lom_splat(entity->point_size);
}

LOM_SHADER(lom_entity_point, point_vertex, phong_fragment, .attributes = 4, .varyings = VARYINGS, .clip_distances = 1,
           .reads = LOM_VARYINGS(0, VARYINGS), .differentiates = LOM_VARYINGS(UV, 2), .colors = 1,
           .uniforms_size = sizeof(struct lom_entity_uniforms))
LOM_SHADER(lom_entity_disc, point_vertex, phong_fragment, .attributes = 4, .varyings = VARYINGS, .clip_distances = 1,
           .reads = LOM_VARYINGS(0, VARYINGS), .differentiates = LOM_VARYINGS(UV, 2), .colors = 1, .round = true,
           .uniforms_size = sizeof(struct lom_entity_uniforms))

/* ---- what is transparent ---- */

/* Both sides of a face are its front. */
static lom_float3 turn_to_eye(const struct lom_view_uniform *view, lom_float3 normal, lom_float3 offset)
{
    lom_mask away = lom_dot3(normal, lom_to_eye(&view->eye, offset)) < 0.0f;
    return lom_scale3(normal, lom_select(away, lom_splat(-1.0f), lom_splat(1.0f)));
}

static void transparent_lit_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct lom_entity_uniforms *entity = uniforms;
    struct corner c = transform(out, in, entity);
    struct lom_lit lit =
        lom_phong_light(&entity->view, &entity->material, c.offset,
                        turn_to_eye(&entity->view, lom_normalize3(c.normal), c.offset), lom_splat(1.0f));
    lom_float3 color = { in->attribute[3].x, in->attribute[3].y, in->attribute[3].z };
    store3(out->varying + TEXTURED, lom_mul3(lit.textured, color));
    store3(out->varying + HIGHLIGHT, lit.highlight);
}

/* How much of the surface there is, by the map of its opacity. */
static lom_float find_presence(const struct lom_entity_uniforms *entity, const lom_varyings *in)
{
    const struct lom_material_uniform *m = &entity->material;
    if (m->opacity_map == NULL)
        return lom_splat(1.0f);
    lom_float4 texel = lom_sample_gradient(m->opacity_map, in->varying[UV], in->varying[UV + 1], lom_dx(in, UV),
                                           lom_dx(in, UV + 1), lom_dy(in, UV), lom_dy(in, UV + 1));
    return m->opacity_is_in_alpha ? texel.w : texel.x;
}

/* To lie over what is behind it: its light times its opacity a, but for the highlight, which clear glass has whole; behind
 * air that lets T c + S of a light c through, that is T (a textured + highlight) + a S. */
static void finish_transparent(lom_fragment *out, const lom_varyings *in, const struct lom_entity_uniforms *entity,
                               lom_float3 textured, lom_float3 highlight)
{
    const struct lom_view_uniform *view = &entity->view;
    const struct lom_material_uniform *m = &entity->material;
    lom_float presence = find_presence(entity, in), opacity = presence * m->opacity;
    lom_float3 offset = load3(in, OFFSET), skin = look_up(m->texture, in);
    if (m->specular_map != NULL)
        highlight = lom_mul3(highlight, look_up(m->specular_map, in));
    lom_float3 whole = highlight;
    if (m->emits)
        whole = lom_add3(whole, lom_mul3(lom_uniform3(m->emissive), look_up(m->emissive_map, in)));
    lom_float3 color = lom_add3(lom_scale3(lom_mul3(textured, skin), opacity), lom_scale3(whole, presence));
    LOM_NAME_VALUE(textured);
    LOM_NAME_VALUE(highlight);
    LOM_NAME_AS(albedo, skin);
    LOM_NAME_VALUE(opacity);
    LOM_NAME_VALUE(color);
    lom_float3 seen = lom_apply_haze(&view->haze, &view->eye, view->light.to_light, offset, color);
    lom_float3 air = lom_apply_haze(&view->haze, &view->eye, view->light.to_light, offset, lom_splat3(0, 0, 0));
    seen = lom_sub3(seen, lom_scale3(air, 1.0f - opacity));
    out->color[0] = (lom_float4){ seen.x, seen.y, seen.z, opacity };
}

static void shade_transparent(lom_fragment *out, const lom_varyings *in, const struct lom_entity_uniforms *entity,
                              lom_float3 normal)
{
    struct lom_lit lit = light_up(in, entity, normal);
    finish_transparent(out, in, entity, lom_mul3(lit.textured, load3(in, COLOR)), lit.highlight);
}

static void transparent_phong_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct lom_entity_uniforms *entity = uniforms;
    lom_float3 normal = lom_normalize3(load3(in, NORMAL));
    shade_transparent(out, in, entity, turn_to_eye(&entity->view, normal, load3(in, OFFSET)));
}

static void transparent_bumped_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct lom_entity_uniforms *entity = uniforms;
    lom_float3 normal = turn_to_eye(&entity->view, lom_normalize3(load3(in, NORMAL)), load3(in, OFFSET));
    shade_transparent(out, in, entity, perturb(in, entity->material.normal_map, normal));
}

static void transparent_flat_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct lom_entity_uniforms *entity = uniforms;
    lom_float3 normal = lom_face_normal(in, OFFSET, load3(in, NORMAL));
    shade_transparent(out, in, entity, turn_to_eye(&entity->view, normal, load3(in, OFFSET)));
}

static void transparent_gouraud_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    finish_transparent(out, in, uniforms, load3(in, TEXTURED), load3(in, HIGHLIGHT));
}

LOM_SHADER(lom_transparent_phong, vertex, transparent_phong_fragment, .attributes = 4, .varyings = VARYINGS,
           .clip_distances = 1, .reads = LOM_VARYINGS(0, VARYINGS), .differentiates = LOM_VARYINGS(UV, 2), .colors = 1,
           .uniforms_size = sizeof(struct lom_entity_uniforms))
LOM_SHADER(lom_transparent_bumped, vertex, transparent_bumped_fragment, .attributes = 4, .varyings = VARYINGS,
           .clip_distances = 1, .reads = LOM_VARYINGS(0, VARYINGS),
           .differentiates = LOM_VARYINGS(UV, 2) | LOM_VARYINGS(OFFSET, 3), .colors = 1,
           .uniforms_size = sizeof(struct lom_entity_uniforms))
LOM_SHADER(lom_transparent_flat, vertex, transparent_flat_fragment, .attributes = 4, .varyings = VARYINGS,
           .clip_distances = 1, .reads = LOM_VARYINGS(0, VARYINGS),
           .differentiates = LOM_VARYINGS(UV, 2) | LOM_VARYINGS(OFFSET, 3), .colors = 1,
           .uniforms_size = sizeof(struct lom_entity_uniforms))
LOM_SHADER(lom_transparent_gouraud, transparent_lit_vertex, transparent_gouraud_fragment, .attributes = 4,
           .varyings = LIT_VARYINGS, .clip_distances = 1,
           .reads = LOM_VARYINGS(TEXTURED, 6) | LOM_VARYINGS(UV, 2) | LOM_VARYINGS(OFFSET, 3),
           .differentiates = LOM_VARYINGS(UV, 2), .colors = 1, .uniforms_size = sizeof(struct lom_entity_uniforms))

static void caster_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct lom_caster_uniforms *caster = uniforms;
    lom_float3 model = { in->attribute[0].x, in->attribute[0].y, in->attribute[0].z };
    out->position = lom_transform4(&caster->clip_from_model, model);
}

LOM_DEPTH_SHADER(lom_caster_shader, caster_vertex, .attributes = 1, .uniforms_size = sizeof(struct lom_caster_uniforms))

static void cut_caster_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct lom_cut_caster_uniforms *caster = uniforms;
    lom_float3 model = { in->attribute[0].x, in->attribute[0].y, in->attribute[0].z };
    out->position = lom_transform4(&caster->clip_from_model, model);
    out->varying[0] = in->attribute[2].x;
    out->varying[1] = in->attribute[2].y;
}

static void cut_caster_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct lom_cut_caster_uniforms *caster = uniforms;
    lom_float4 texel = lom_sample_gradient(caster->texture, in->varying[0], in->varying[1], lom_dx(in, 0),
                                           lom_dx(in, 1), lom_dy(in, 0), lom_dy(in, 1));
    out->discard = texel.w < 0.5f;
}

LOM_SHADER(lom_cut_caster_shader, cut_caster_vertex, cut_caster_fragment, .attributes = 3, .varyings = 2,
           .reads = LOM_VARYINGS(0, 2), .differentiates = LOM_VARYINGS(0, 2), .discards = true,
           .uniforms_size = sizeof(struct lom_cut_caster_uniforms))
