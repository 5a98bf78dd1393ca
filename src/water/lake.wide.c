/* The planar lake's shaders (docs/scene.md, [water]: steps 3 to 9). In: fragments of the quad, the reflection and refraction of
 * the scene, the normal and flow maps. Out: the surface's colour; its alpha fades at the shore. */
#include "water/lake.h"

#include "shading/lamp.h"

#include <lom/notes.h>

enum { X, Y, Z, VARYINGS };

static void vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct lom_lake_uniforms *lake = uniforms;
    lom_float u = lom_to_float(in->vertex & 1), v = lom_to_float(in->vertex >> 1);
    lom_float3 offset = { lake->quad[0] + u * lake->quad[2], lom_splat(lake->level),
                          lake->quad[1] + v * lake->quad[3] };
    LOM_NAME_VALUE(offset);
    out->position = lom_transform4(&lake->clip_from_offset, offset);
    out->varying[X] = offset.x;
    out->varying[Y] = offset.y;
    out->varying[Z] = offset.z;
}

static const float endless = 1e30f; /* metres */

struct surface {
    lom_float s, t;    /* where the pictures are looked up */
    lom_float depth;   /* metres of water below */
    lom_float3 normal; /* unit length */
    lom_float offset_s, offset_t;
};

/* Depth of the water straight down, from the refraction's depth picture: with reversed infinite depth near / z is the
 * distance along the view axis, and the point below lies on the fragment's own ray. Where nothing is seen below, z is
 * 0, and the water has no end. */
static lom_float water_depth(const struct lom_lake_uniforms *lake, const lom_varyings *in)
{
    lom_float stored = lom_sample_depth(lake->refraction_depth, in->x * lake->pixel[0], in->y * lake->pixel[1]);
    if (!lake->eye.parallel) {
        lom_float beyond = lake->eye.near_plane / (stored * in->w) - 1.0f;
        return lom_select(stored > 0.0f, lom_max(-in->varying[Y] * beyond, (lom_float){ 0 }), lom_splat(endless));
    }
    lom_float3 offset = { in->varying[X], in->varying[Y], in->varying[Z] };
    lom_float further = lom_depth_reach(&lake->eye, stored) - lom_place_reach(&lake->eye, offset, in->w);
    lom_float depth = lom_max(further * -lake->eye.along[1], (lom_float){ 0 });
    return lom_select(stored > 0.0f, depth, lom_splat(endless));
}

/* Steps 4 and 5: the flow map, read where it has drifted to, displaces the maps' coordinates and the lookups, by
 * 2 c - a, where black texels, whose alpha is 0, add nothing; the normal map has y and z swapped because the surface faces up, and its up component is scaled (3 in the reference). */
static void perturb(const struct lom_lake_uniforms *lake, const lom_varyings *in, struct surface *w)
{
    lom_float u = in->varying[X] * lake->tile + lake->shift[0], v = in->varying[Z] * lake->tile + lake->shift[1];
    lom_float ux = lom_dx(in, X) * lake->tile, vx = lom_dx(in, Z) * lake->tile;
    lom_float uy = lom_dy(in, X) * lake->tile, vy = lom_dy(in, Z) * lake->tile;
    w->offset_s = w->offset_t = (lom_float){ 0 };
    if (lake->has_flow) {
        lom_float lod = lom_lod_of(lake->flow_map, ux, vx, uy, vy);
        lom_float4 drift = lom_sample(lake->flow_map, u + lake->move, v, lod);
        u = u + drift.x * 0.1f;
        v = v + (drift.y * 0.1f + lake->move);
        lom_float4 flow = lom_sample(lake->flow_map, u, v, lod);
        w->offset_s = (flow.x * 2.0f - flow.w) * lake->flow_strength;
        w->offset_t = (flow.y * 2.0f - flow.w) * lake->flow_strength;
    }
    w->normal = lom_splat3(0, 1, 0);
    if (lake->has_normals) {
        lom_float4 texel = lom_sample(lake->normal_map, u, v, lom_lod_of(lake->normal_map, ux, vx, uy, vy));
        w->normal =
            lom_normalize3((lom_float3){ texel.x * 2.0f - 1.0f, texel.z * lake->normal_up, texel.y * 2.0f - 1.0f });
    }
}

/* Step 3, and the displacement: less where the water is shallow, so that the shore does not swim. */
static void place_lookups(const struct lom_lake_uniforms *lake, const lom_varyings *in, struct surface *w)
{
    if (lake->has_projection) {
        w->s = in->x * lake->pixel[0];
        w->t = in->y * lake->pixel[1];
    } else {
        w->s = (in->varying[X] - lake->quad[0]) / lake->quad[2];
        w->t = (in->varying[Z] - lake->quad[1]) / lake->quad[3];
    }
    lom_float fade = lom_saturate(w->depth * lake->inverse_clear);
    w->s = lom_clamp(w->s + w->offset_s * fade, (lom_float){ 0 }, lom_splat(1.0f));
    w->t = lom_clamp(w->t + w->offset_t * fade, (lom_float){ 0 }, lom_splat(1.0f));
}

static lom_float3 look_up(const lom_texture *picture, bool on, const struct surface *w, const float color[3])
{
    if (!on)
        return lom_uniform3(color);
    lom_float4 texel = lom_sample(picture, w->s, w->t, (lom_float){ 0 });
    return (lom_float3){ texel.x, texel.y, texel.z };
}

/* Step 6: mix(reflection, refraction, dot(to_camera, normal)), the factor raised to fresnel_power. */
static lom_float transmitted_share(const struct lom_lake_uniforms *lake, lom_float3 to_eye, lom_float3 normal)
{
    if (!lake->has_fresnel)
        return lom_splat(0.5f);
    lom_float cosine = lom_saturate(lom_dot3(to_eye, normal));
    lom_float factor = lake->fresnel_power == 1.0f ? cosine : lom_pow(cosine, lom_splat(lake->fresnel_power));
    return 1.0f - lake->reflectivity * (1.0f - factor);
}

/* Step 7 of each lamp: light times max(R.E, 0)^shininess. */
static lom_float3 lamp_highlights(const struct lom_lake_uniforms *lake, lom_float3 offset, lom_float3 normal,
                                  lom_float3 to_eye)
{
    lom_float3 light = lom_splat3(0, 0, 0), to_lamp;
    lom_float share;
    struct lom_lamp_walk walk = lom_walk_lamps(&lake->light, offset, lom_splat3(0, 0, 0));
    lom_float lamps = lom_listed_lamps(&walk);
    LOM_NAME_VALUE(lamps);
    for (const struct lom_lamp_uniform *lamp = lom_next_lamp(&walk); lamp != NULL; lamp = lom_next_lamp(&walk)) {
        if (!lom_lamp_share(&walk, lamp, &to_lamp, &share))
            continue;
        share = share * lom_phong_highlight(normal, to_lamp, to_eye, lom_splat(lake->shininess));
        light = lom_add3(light, lom_scale3(lom_uniform3(lamp->specular), share));
        LOM_NAME_BY(lamp->name, share);
    }
    return light;
}

static void fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct lom_lake_uniforms *lake = uniforms;
    lom_float3 offset = { in->varying[X], in->varying[Y], in->varying[Z] };
    lom_float3 to_eye = lom_to_eye(&lake->eye, offset);
    struct surface w = { .depth = lom_splat(endless) };
    if (lake->refraction_depth != NULL)
        w.depth = water_depth(lake, in);
    perturb(lake, in, &w);
    place_lookups(lake, in, &w);
    LOM_NAME_AS(water_depth, w.depth);
    LOM_NAME_AS(normal, w.normal);
    LOM_NAME_AS(s, w.s);
    LOM_NAME_AS(t, w.t);
    lom_float3 reflection = look_up(lake->reflection, lake->has_reflection, &w, lake->color);
    lom_float3 refraction = look_up(lake->refraction, lake->has_refraction, &w, lake->color);
    lom_float transmitted = transmitted_share(lake, to_eye, w.normal);
    LOM_NAME_VALUE(reflection);
    LOM_NAME_VALUE(refraction);
    LOM_NAME_VALUE(transmitted);
    lom_float3 color = lom_mix3(reflection, refraction, transmitted);
    if (lake->has_tint)
        color = lom_mix3(color, lom_uniform3(lake->tint_color), lom_splat(lake->tint_amount));
    if (lake->has_specular) {
        lom_float highlight =
            lom_phong_specular(&lake->light, w.normal, to_eye, lake->shininess) * lom_light_share(&lake->light, offset);
        highlight = lom_open_water_share(&lake->entity_shadow, offset, highlight);
        highlight = highlight * lake->specular_strength * lom_saturate(w.depth * lake->inverse_clear);
        LOM_NAME_VALUE(highlight);
        color = lom_add3(color, lom_scale3(lom_uniform3(lake->light.color), highlight));
        if (lake->light.lamps != NULL) {
            lom_float part = lake->specular_strength * lom_saturate(w.depth * lake->inverse_clear);
            color = lom_add3(color, lom_scale3(lamp_highlights(lake, offset, w.normal, to_eye), part));
        }
    }
    LOM_NAME_VALUE(color);
    lom_float alpha = lake->has_soft_shore ? lom_saturate(w.depth / lake->shore_depth) : lom_splat(1.0f);
    out->color[0] = (lom_float4){ color.x, color.y, color.z, alpha };
}

static void mask_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)in;
    (void)uniforms;
    out->color[0] = (lom_float4){ lom_splat(1.0f), lom_splat(1.0f), lom_splat(1.0f), lom_splat(1.0f) };
}

static void tinted_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct lom_lake_uniforms *lake = uniforms;
    (void)in;
    out->color[0] = (lom_float4){ lom_splat(lake->tint_color[0]), lom_splat(lake->tint_color[1]),
                                  lom_splat(lake->tint_color[2]), lom_splat(lake->opacity) };
}

LOM_SHADER(lom_lake_shader, vertex, fragment, .varyings = VARYINGS, .reads = LOM_VARYINGS(X, 3),
           .differentiates = 1u << X | 1u << Z, .reads_position = true, .colors = 1,
           .uniforms_size = sizeof(struct lom_lake_uniforms))
LOM_SHADER(lom_lake_mask_shader, vertex, mask_fragment, .varyings = VARYINGS, .colors = 1,
           .uniforms_size = sizeof(struct lom_lake_uniforms))
LOM_SHADER(lom_lake_tinted_shader, vertex, tinted_fragment, .varyings = VARYINGS, .colors = 1,
           .uniforms_size = sizeof(struct lom_lake_uniforms))
