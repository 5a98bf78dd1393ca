/* Foam on the surface of water, over lanes: what broke (wave_lanes.h), and a band along the shore by the depth of the
 * water. In: a point of the surface, what lies behind it. Out: how much of it foam covers, and the light of that. */
#ifndef LOM_WATER_FOAM_COVER_H
#define LOM_WATER_FOAM_COVER_H

#include "base/numbers.h"
#include "water/facets.h"

/* Where the picture shows what the fragment hides. */
LOM_INLINE lom_float2 lom_own_place(const struct lom_picture_uniform *picture, const struct lom_surface_point *p)
{
    return (lom_float2){ p->x * picture->scale[0] + picture->shift[0], p->y * picture->scale[1] + picture->shift[1] };
}

/* The depths of the water that a pixel shows, straight down: the middle one and by how much they differ. */
struct lom_depths {
    lom_float middle, range;
};

/* The depth of a plane is linear in the window, so between texels it is that of the bed; where the four texels are not
 * of one piece, the nearest. */
LOM_INLINE struct lom_depths lom_water_depths(const struct lom_surface_uniforms *u, const struct lom_surface_point *p,
                                              const struct lom_footprint *f)
{
    const struct lom_picture_uniform *picture = &u->behind;
    const float width = (float)lom_texture_width(picture->depth), height = (float)lom_texture_height(picture->depth);
    lom_float2 own = lom_own_place(picture, p);
    lom_float4 z = lom_sample_gather(picture->depth, own.x, own.y, 0);
    lom_float x = own.x * width - 0.5f, y = own.y * height - 0.5f;
    lom_float s = x - lom_floor(x), t = y - lom_floor(y);
    lom_float least = lom_min(lom_min(z.x, z.y), lom_min(z.z, z.w)),
              most = lom_max(lom_max(z.x, z.y), lom_max(z.z, z.w));
    lom_mask whole = most < 1.2f * least;
    s = lom_select(whole, s, lom_select(s < 0.5f, (lom_float){ 0 }, lom_splat(1.0f)));
    t = lom_select(whole, t, lom_select(t < 0.5f, (lom_float){ 0 }, lom_splat(1.0f)));
    lom_float above = z.w + (z.z - z.w) * s, below = z.x + (z.y - z.x) * s;
    lom_float left = z.w + (z.x - z.w) * t, right = z.z + (z.y - z.z) * t;
    const struct lom_eye_uniform *eye = &u->eye;
    lom_float beyond = lom_depth_reach(eye, above + (below - above) * t);
    lom_float across = lom_depth_reach(eye, right) - lom_depth_reach(eye, left);
    lom_float down = lom_depth_reach(eye, below) - lom_depth_reach(eye, above);
    const float *row = picture->clip_from_offset.m[eye->parallel ? 2 : 3];
    const float reach = eye->parallel ? -eye->depth_reach : 1;
    across = across * (picture->scale[0] * width) - reach * (f->ax * row[0] + f->az * row[2]) * (beyond / p->w);
    down = down * (picture->scale[1] * height) - reach * (f->bx * row[0] + f->bz * row[2]) * (beyond / p->w);
    lom_float straight = -p->path.y / p->w; /* metres down a metre of reach */
    lom_float range = (lom_abs(across) + lom_abs(down)) * lom_abs(straight);
    return (struct lom_depths){ (beyond - p->w) * straight, lom_select(whole, range, (lom_float){ 0 }) };
}

LOM_INLINE lom_float lom_foam_through(lom_float cover, lom_float grain)
{
    return lom_smoothstep(lom_splat(0.0f), lom_splat(0.45f), lom_min(cover, lom_splat(1.2f)) - 1.0f + grain);
}

/* The mean of what foam covers over the depths of a pixel: of a shore that is less than a pixel wide its share. */
LOM_INLINE lom_float lom_shore_foam(const struct lom_foam_uniform *foam, struct lom_depths depths, lom_mask shore,
                                    lom_float cover, lom_float grain)
{
    const float edge = foam->shore_depth;
    const int places = 4;
    lom_float range = lom_max(depths.range, lom_splat(1e-3f * edge));
    lom_float low = lom_max(depths.middle - 0.5f * range, lom_splat(-edge));
    lom_float high = lom_min(depths.middle + 0.5f * range, lom_splat(edge));
    lom_float within = lom_max(high - low, (lom_float){ 0 }), sum = { 0 };
    for (int i = 0; i < places; i++) {
        lom_float depth = low + within * (((float)i + 0.5f) / (float)places);
        lom_float band = lom_saturate(1.0f - lom_abs(depth) / edge);
        lom_float lines = 0.5f + 0.5f * lom_sin(12.0f * band - (float)lom_two_pi * foam->move);
        sum = sum + lom_foam_through(cover + band * band * (0.55f + 0.45f * lines), grain);
    }
    lom_float share = lom_select(shore, within / range, (lom_float){ 0 });
    return lom_foam_through(cover, grain) * (1.0f - share) + sum * (share * (1.0f / (float)places));
}

/* Of two grains that are evenly spread over 0..1 and independent of each other their mean by share b of the second,
 * made even again by its own distribution: with a = 1 - b and b <= a it is z^2 / 2ab below b, (z - b / 2) / a up to a,
 * and the same from above. So a pattern whose phases take turns never pulses. */
LOM_INLINE lom_float lom_even_mix(lom_float first, lom_float second, lom_float share)
{
    lom_float z = lom_mix(first, second, share), less = lom_min(share, 1.0f - share), more = 1.0f - less;
    lom_float inner = lom_max(2.0f * less * more, lom_splat(1e-6f)), rest = 1.0f - z;
    lom_float even = (z - 0.5f * less) / more;
    even = lom_select(z < less, z * z / inner, even);
    return lom_select(z > more, 1.0f - rest * rest / inner, even);
}

/* The pattern where the water was that is at the point now. */
LOM_INLINE lom_float lom_foam_grain(const struct lom_foam_uniform *foam, const struct lom_surface_point *p,
                                    lom_float way_x, lom_float way_z, const struct lom_footprint *f)
{
    lom_float s = (p->offset.x - way_x) * foam->inverse_tile + foam->shift[0];
    lom_float t = (p->offset.z - way_z) * foam->inverse_tile + foam->shift[1];
    return lom_sample(foam->pattern, s, t, lom_wave_lod(foam->pattern, f, foam->inverse_tile)).x;
}

/* How much of the point foam covers: what broke, and the shore, through a pattern. */
LOM_INLINE lom_float lom_foam_cover(const struct lom_surface_uniforms *u, const struct lom_surface_point *p,
                                    const struct lom_footprint *f)
{
    const struct lom_foam_uniform *foam = &u->foam;
    lom_float cover = p->slopes.foam * foam->amount;
    bool has_shore = foam->shore_depth > 0 && u->behind.depth != NULL && u->side > 0;
    lom_mask shore = { 0 };
    struct lom_depths depths = { { 0 }, { 0 } };
    if (has_shore) {
        depths = lom_water_depths(u, p, f);
        shore = lom_abs(depths.middle) < foam->shore_depth + 0.5f * depths.range;
    }
    const lom_mask some = (cover > 0.0f) | shore;
    if (!lom_any(some))
        return (lom_float){ 0 };
    lom_float grain = lom_foam_grain(foam, p, p->slopes.drift_x, p->slopes.drift_z, f);
    if (lom_any(p->slopes.again > 0.0f))
        grain = lom_even_mix(grain, lom_foam_grain(foam, p, p->slopes.again_x, p->slopes.again_z, f), p->slopes.again);
    if (!lom_any(shore))
        return lom_select(some, lom_foam_through(cover, grain), (lom_float){ 0 });
    return lom_select(some, lom_shore_foam(foam, depths, shore, cover, grain), (lom_float){ 0 });
}

LOM_INLINE lom_float3 lom_lamps_on_foam(const struct lom_surface_uniforms *u, const struct lom_surface_point *p)
{
    lom_float3 light = { { 0 }, { 0 }, { 0 } }, to_lamp;
    lom_float share;
    struct lom_lamp_walk walk = lom_walk_lamps(&u->light, p->offset, lom_splat3(0, 0, 0));
    for (const struct lom_lamp_uniform *lamp = lom_next_lamp(&walk); lamp != NULL; lamp = lom_next_lamp(&walk)) {
        if (!lom_lamp_share(&walk, lamp, &to_lamp, &share))
            continue;
        lom_float lambert = lom_max(lom_dot3(p->normal, to_lamp), (lom_float){ 0 }) * share;
        light = lom_add3(light, lom_add3(lom_scale3(lom_uniform3(lamp->ambient), share),
                                         lom_scale3(lom_uniform3(lamp->diffuse), lambert)));
    }
    return light;
}

/* Foam is a heap that scatters light through: where a lip has been thrown ahead and the sheet is folded, the side that
 * looks down has the light of the one above it. Over the edge of a lip that is the normal turned up, (x, -y, z), which
 * goes on from one side to the other without a jump; where the sheet lies back under itself it is the opposite normal,
 * which has its part from where the sheet stands upright to 20 degrees beyond that. So there is neither a dark flap nor a
 * line along the fold. */
LOM_INLINE lom_float lom_lambert_on_foam(const struct lom_light_uniform *light, lom_float3 normal)
{
    lom_float3 up = { normal.x, lom_abs(normal.y), normal.z };
    lom_float lambert = lom_lambert(light, up);
    if (!lom_any(normal.y < 0.0f))
        return lambert;
    lom_float opposite = lom_lambert(light, (lom_float3){ -normal.x, up.y, -normal.z });
    lom_float part = 1.0f - lom_smoothstep(lom_splat(-0.35f), lom_splat(0.0f), normal.y);
    return lom_mix(lambert, lom_max(lambert, opposite), part);
}

LOM_INLINE lom_float3 lom_foam_radiance(const struct lom_surface_uniforms *u, const struct lom_surface_point *p)
{
    lom_float lambert = lom_lambert_on_foam(&u->light, p->normal) * lom_light_share(&u->light, p->offset);
    lambert = lom_open_water_share(&u->entity_shadow, p->offset, lambert);
    lom_float3 light = lom_add3(lom_uniform3(u->light.ambient), lom_scale3(lom_uniform3(u->light.color), lambert));
    if (u->light.lamps != NULL)
        light = lom_add3(light, lom_lamps_on_foam(u, p));
    return lom_scale3(light, lom_splat(0.8f));
}

#endif
