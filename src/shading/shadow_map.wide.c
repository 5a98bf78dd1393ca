/* Shadows of entities and of what stands before lamps. In: maps of the depth that a light sees, places of surfaces. Out:
 * the share of the light that comes to a place. */
#include "shading/lamp.h"
#include "shading/sun_shadow.h"

/* What share of a map's texels around a place has something nearer to the light than it, and what share has not. */
struct kernel {
    lom_float dark, open;
};

/* 3 x 3 texels, weighted by the quadratic B-spline (Reeves, Salesin, Cook 1987, with a smooth kernel), so that edges move
 * by less than a texel. */
LOM_INLINE struct kernel compare_texels(const lom_texture *map, float size, float texel, lom_float s, lom_float t,
                                        lom_float depth)
{
    lom_float x = s * size, y = t * size, column = lom_floor(x), row = lom_floor(y);
    lom_float dx = x - column - 0.5f, dy = y - row - 0.5f;
    lom_float across[3] = { 0.5f * (0.5f - dx) * (0.5f - dx), 0.75f - dx * dx, 0.5f * (0.5f + dx) * (0.5f + dx) };
    lom_float down[3] = { 0.5f * (0.5f - dy) * (0.5f - dy), 0.75f - dy * dy, 0.5f * (0.5f + dy) * (0.5f + dy) };
    struct kernel sum = { { 0 }, { 0 } };
    for (int j = 0; j < 3; j++)
        for (int i = 0; i < 3; i++) {
            lom_float at_s = (column + ((float)i - 0.5f)) * texel;
            lom_float at_t = (row + ((float)j - 0.5f)) * texel;
            lom_float nearest = lom_sample_depth(map, at_s, at_t), weight = across[i] * down[j];
            lom_mask dark = (nearest > depth) & (nearest > 0.0f);
            sum.dark = sum.dark + lom_select(dark, weight, (lom_float){ 0 });
            sum.open = sum.open + lom_select(dark, (lom_float){ 0 }, weight);
        }
    return sum;
}

static lom_float map_light(const struct lom_shadow_map_uniform *shadow, lom_float3 place)
{
    lom_float one = lom_splat(1.0f);
    lom_float s = lom_transform_row(shadow->s, place), t = lom_transform_row(shadow->t, place);
    lom_float depth = lom_transform_row(shadow->depth, place);
    if (!lom_any((s > 0.0f) & (s < 1.0f) & (t > 0.0f) & (t < 1.0f) & (depth < 1.0f)))
        return one;
    return one - compare_texels(shadow->map, shadow->size, shadow->texel, s, t, depth).dark;
}

/* A place counts where the kernel of 1.5 texels around it lies in the map; the share of a cascade falls from 1 to 0 over the
 * last sixteenth of the map's side before that. */
static const float kept = 2.0f, overlap = 1.0f / 16.0f;

static lom_float3 moved_place(const struct lom_shadow_map_uniform *map, lom_float3 offset, lom_float3 normal)
{
    return lom_add3(offset, lom_scale3(normal, lom_splat(map->offset)));
}

/* Which cascade, counted from 1 and mixed where two are, is for records. */
static lom_float cascade_light(const struct lom_sun_shadow_uniform *sun, lom_float3 offset, lom_float3 normal)
{
    struct kernel sum = { { 0 }, { 0 } };
    lom_float rest = lom_splat(1.0f), cascade = { 0 };
    for (int i = 0; i < sun->count && lom_any(rest > 0.0f); i++) {
        const struct lom_shadow_map_uniform *map = &sun->map[i];
        lom_float3 place = moved_place(map, offset, normal);
        lom_float s = lom_transform_row(map->s, place), t = lom_transform_row(map->t, place), weight = rest;
        if (i + 1 < sun->count) {
            lom_float border = lom_min(lom_min(s, 1.0f - s), lom_min(t, 1.0f - t));
            weight = rest * lom_saturate((border - kept * map->texel) / overlap);
        }
        cascade = cascade + weight * (float)(i + 1);
        rest = rest - weight;
        struct kernel part = { { 0 }, lom_splat(1.0f) };
        if (lom_any((weight > 0.0f) & (s > 0.0f) & (s < 1.0f) & (t > 0.0f) & (t < 1.0f)))
            part = compare_texels(map->map, map->size, map->texel, s, t, lom_transform_row(map->depth, place));
        sum.dark = sum.dark + weight * part.dark;
        sum.open = sum.open + weight * part.open;
    }
    LOM_NAME_VALUE(cascade);
    return lom_select(sum.dark > 0.0f, sum.open, lom_splat(1.0f));
}

void LOM_WIDE(lom_entity_light)(const struct lom_sun_shadow_uniform *sun, const lom_float3 *offset,
                                const lom_float3 *normal, lom_float *share)
{
    if (sun->cascaded) {
        *share = cascade_light(sun, *offset, *normal);
        return;
    }
    *share = lom_splat(1.0f);
    for (int i = 0; i < sun->count; i++)
        *share = *share * map_light(&sun->map[i], moved_place(&sun->map[i], *offset, *normal));
}

static lom_float largest(lom_float3 v)
{
    return lom_max(lom_max(lom_abs(v.x), lom_abs(v.y)), lom_abs(v.z));
}

/* The depth of a place less the lamp: its own along the one face, or along the nearest axis of the world. */
static lom_float depth_before(const struct lom_lamp_shadow_uniform *shadow, lom_float3 way)
{
    return shadow->count == 1 ? lom_dot3(way, lom_uniform3(shadow->face[0].forward)) : largest(way);
}

/* |n . right| + |n . up| of the face that sees a place of this depth; the largest one of those that may after it is moved:
 * by at most depth (lift + sqrt(2) lean), which is as much off the depth as it is more along another axis. */
static lom_float lean_of(const struct lom_lamp_shadow_uniform *shadow, lom_float3 way, lom_float depth, lom_float3 n)
{
    if (shadow->count == 1)
        return lom_abs(lom_dot3(n, lom_uniform3(shadow->face[0].right))) +
               lom_abs(lom_dot3(n, lom_uniform3(shadow->face[0].up)));
    lom_float3 size = { lom_abs(n.x), lom_abs(n.y), lom_abs(n.z) };
    lom_float least = depth * (1.0f - 2.0f * shadow->lift - 3.0f * shadow->lean);
    lom_float along = lom_select(lom_abs(way.x) >= least, size.x, lom_splat(1.0f));
    along = lom_min(along, lom_select(lom_abs(way.y) >= least, size.y, lom_splat(1.0f)));
    along = lom_min(along, lom_select(lom_abs(way.z) >= least, size.z, lom_splat(1.0f)));
    return size.x + size.y + size.z - along;
}

/* A place behind the lamp has nothing before it. */
static lom_float face_light(const struct lom_lamp_shadow_uniform *shadow, const struct lom_lamp_face_uniform *face,
                            lom_float3 way, lom_float depth, lom_mask mine)
{
    lom_float inverse = lom_select(mine, 1.0f / depth, (lom_float){ 0 });
    lom_float s = 0.5f + shadow->scale * lom_dot3(way, lom_uniform3(face->right)) * inverse;
    lom_float t = 0.5f - shadow->scale * lom_dot3(way, lom_uniform3(face->up)) * inverse;
    struct kernel k = compare_texels(face->map, shadow->size, shadow->texel, s, t, shadow->from * inverse);
    return lom_select(mine & (k.dark > 0.0f), k.open, lom_splat(1.0f));
}

void LOM_WIDE(lom_shade_lamp)(const struct lom_lamp_shadow_uniform *shadow, const lom_float3 *place,
                              const lom_float3 *normal, lom_float *share)
{
    lom_float3 way = lom_sub3(*place, lom_uniform3(shadow->place));
    lom_float depth = depth_before(shadow, way);
    lom_float moved = depth * (shadow->lift + shadow->lean * lean_of(shadow, way, depth, *normal));
    way = lom_add3(way, lom_scale3(*normal, moved));
    depth = depth_before(shadow, way);
    lom_mask left = (*share > 0.0f) & (depth > 0.0f);
    for (int i = 0; i < shadow->count && lom_any(left); i++) {
        const struct lom_lamp_face_uniform *face = &shadow->face[i];
        lom_mask mine = left & (lom_dot3(way, lom_uniform3(face->forward)) == depth);
        left = left & ~mine;
        if (face->map != NULL && lom_any(mine))
            *share = *share * face_light(shadow, face, way, depth, mine);
    }
}
