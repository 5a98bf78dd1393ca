/* Shadows of entities. In: maps of the depth that the sun sees, places of surfaces. Out: the share of the sunlight that
 * comes to a place. */
#include "shading/phong.h"

/* The share of a map's texels around a place that have nothing nearer to the sun: 3 x 3 of them, weighted by the
 * quadratic B-spline (Reeves, Salesin, Cook 1987, with a smooth kernel), so that edges move by less than a texel. */
static lom_float map_light(const struct lom_shadow_map_uniform *shadow, lom_float3 place)
{
    lom_float one = lom_splat(1.0f);
    lom_float s = lom_transform_row(shadow->s, place), t = lom_transform_row(shadow->t, place);
    lom_float depth = lom_transform_row(shadow->depth, place);
    if (!lom_any((s > 0.0f) & (s < 1.0f) & (t > 0.0f) & (t < 1.0f) & (depth < 1.0f)))
        return one;
    lom_float x = s * shadow->size, y = t * shadow->size, column = lom_floor(x), row = lom_floor(y);
    lom_float dx = x - column - 0.5f, dy = y - row - 0.5f, shade = { 0 };
    lom_float across[3] = { 0.5f * (0.5f - dx) * (0.5f - dx), 0.75f - dx * dx, 0.5f * (0.5f + dx) * (0.5f + dx) };
    lom_float down[3] = { 0.5f * (0.5f - dy) * (0.5f - dy), 0.75f - dy * dy, 0.5f * (0.5f + dy) * (0.5f + dy) };
    for (int j = 0; j < 3; j++)
        for (int i = 0; i < 3; i++) {
            lom_float at_s = (column + ((float)i - 0.5f)) * shadow->texel;
            lom_float at_t = (row + ((float)j - 0.5f)) * shadow->texel;
            lom_float nearest = lom_sample_depth(shadow->map, at_s, at_t);
            lom_mask dark = (nearest > depth) & (nearest > 0.0f);
            shade = shade + lom_select(dark, across[i] * down[j], (lom_float){ 0 });
        }
    return one - shade;
}

void LOM_WIDE(lom_entity_light)(const struct lom_view_uniform *view, const lom_float3 *offset, const lom_float3 *normal,
                                lom_float *share)
{
    *share = lom_splat(1.0f);
    for (int i = 0; i < LOM_ENTITY_SHADOWS; i++) {
        const struct lom_shadow_map_uniform *shadow = &view->entity_shadow[i];
        if (shadow->map != NULL)
            *share = *share * map_light(shadow, lom_add3(*offset, lom_scale3(*normal, lom_splat(shadow->offset))));
    }
}
