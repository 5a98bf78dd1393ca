/* Shadows of entities, of what stands before lamps, and of liquids. In: maps of what a light sees, places of surfaces.
 * Out: the share of the light that comes to a place. */
#include "shading/depth_square.h"
#include "shading/lamp.h"
#include "shading/sun_shadow.h"

#include <string.h>

/* The 3 x 3 texels around a place, the middle one's column and row, weighted by the quadratic B-spline (Reeves, Salesin,
 * Cook 1987, with a smooth kernel), so that edges move by less than a texel. */
struct spline {
    lom_float column, row, across[3], down[3];
};

LOM_INLINE struct spline spline_at(float size, lom_float s, lom_float t)
{
    lom_float x = s * size, y = t * size, column = lom_floor(x), row = lom_floor(y);
    lom_float dx = x - column - 0.5f, dy = y - row - 0.5f;
    return (struct spline){ column,
                            row,
                            { 0.5f * (0.5f - dx) * (0.5f - dx), 0.75f - dx * dx, 0.5f * (0.5f + dx) * (0.5f + dx) },
                            { 0.5f * (0.5f - dy) * (0.5f - dy), 0.75f - dy * dy, 0.5f * (0.5f + dy) * (0.5f + dy) } };
}

/* Whether nothing about the places is nearer to the light than they are, by the map's blocks where it has them. */
LOM_INLINE bool is_open(const struct lom_near_uniform *near, lom_float s, lom_float t, lom_float depth)
{
    return LOM_LOADS_SQUARES && near != NULL && near->around != NULL &&
           lom_all(lom_nearest_around(near, s, t) <= depth);
}

/* What share of a map's texels around a place has something nearer to the light than it, and what share has not. */
struct kernel {
    lom_float dark, open;
};

LOM_INLINE struct kernel compare_texels(const lom_texture *map, const struct lom_near_uniform *near, float size,
                                        float texel, lom_float s, lom_float t, lom_float depth)
{
    const struct spline k = spline_at(size, s, t);
    struct kernel sum = { { 0 }, { 0 } };
    lom_float at_s[3], at_t[3];
    for (int i = 0; i < 3; i++) {
        at_s[i] = (k.column + ((float)i - 0.5f)) * texel;
        at_t[i] = (k.row + ((float)i - 0.5f)) * texel;
    }
    struct lom_depth_square square;
    if (is_open(near, s, t, depth))
        memset(&square, 0, sizeof square);
    else
        square = lom_find_depth_square(map, at_s, at_t);
    for (int j = 0; j < 3; j++)
        for (int i = 0; i < 3; i++) {
            lom_float nearest = square.at[j][i], weight = k.across[i] * k.down[j];
            lom_mask dark = (nearest > depth) & (nearest > 0.0f);
            sum.dark = sum.dark + lom_select(dark, weight, (lom_float){ 0 });
            sum.open = sum.open + lom_select(dark, (lom_float){ 0 }, weight);
        }
    return sum;
}

static lom_float share_behind(const struct kernel *sum, lom_float negative_depth, lom_mask shaded)
{
    lom_float through = lom_exp(lom_min(negative_depth, (lom_float){ 0 }));
    return lom_select(shaded, sum->open + sum->dark * through, lom_splat(1.0f));
}

/* What the texels around a place let through of a light: of those whose liquid is nearer to it than the place the mean
 * optical depth counts. */
static lom_float3 look_through(const lom_texture *map, float size, lom_float s, lom_float t, lom_float depth)
{
    const struct spline k = spline_at(size, s, t);
    const lom_float low = lom_splat(-2.0f), high = lom_splat(size + 2.0f);
    const lom_int column = lom_to_int(lom_min(lom_max(k.column, low), high));
    const lom_int row = lom_to_int(lom_min(lom_max(k.row, low), high));
    lom_float3 depths = lom_splat3(0, 0, 0);
    struct kernel sum = { { 0 }, { 0 } };
    for (int j = 0; j < 3; j++)
        for (int i = 0; i < 3; i++) {
            const lom_float4 texel = lom_fetch(map, column + (i - 1), row + (j - 1), 0);
            const lom_mask behind = (texel.w > depth) & (texel.w > 0.0f);
            const lom_float weight = k.across[i] * k.down[j];
            const lom_float dark = lom_select(behind, weight, (lom_float){ 0 });
            depths = lom_add3(depths, lom_scale3((lom_float3){ texel.x, texel.y, texel.z }, dark));
            sum.dark = sum.dark + dark;
            sum.open = sum.open + lom_select(behind, (lom_float){ 0 }, weight);
        }
    const lom_mask shaded = sum.dark > 0.0f;
    depths = lom_scale3(depths, -1.0f / lom_select(shaded, sum.dark, lom_splat(1.0f)));
    return (lom_float3){ share_behind(&sum, depths.x, shaded), share_behind(&sum, depths.y, shaded),
                         share_behind(&sum, depths.z, shaded) };
}

static lom_float map_light(const struct lom_shadow_map_uniform *shadow, lom_float3 place)
{
    lom_float one = lom_splat(1.0f);
    lom_float s = lom_transform_row(shadow->s, place), t = lom_transform_row(shadow->t, place);
    lom_float depth = lom_transform_row(shadow->depth, place);
    const lom_mask inside = (s > 0.0f) & (s < 1.0f) & (t > 0.0f) & (t < 1.0f) & (depth < 1.0f);
    if (!lom_any(inside) || is_open(&shadow->near, s, t, depth))
        return one;
    const struct kernel k = compare_texels(shadow->map, NULL, shadow->size, shadow->texel, s, t, depth);
    return lom_select(inside, one - k.dark, one); /* beside the map its border's texels say nothing */
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
        const lom_mask inside = (weight > 0.0f) & (s > 0.0f) & (s < 1.0f) & (t > 0.0f) & (t < 1.0f);
        struct kernel part = { { 0 }, lom_splat(1.0f) };
        if (lom_any(inside)) {
            const struct kernel k =
                compare_texels(map->map, &map->near, map->size, map->texel, s, t, lom_transform_row(map->depth, place));
            part = (struct kernel){ lom_select(inside, k.dark, part.dark), lom_select(inside, k.open, part.open) };
        }
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

void LOM_WIDE(lom_liquid_light)(const struct lom_liquid_map_uniform *liquid, const lom_float3 *offset,
                                const lom_float3 *normal, lom_float3 *share)
{
    lom_float3 place = lom_add3(*offset, lom_scale3(*normal, lom_splat(liquid->offset)));
    lom_float s = lom_transform_row(liquid->s, place), t = lom_transform_row(liquid->t, place);
    lom_float depth = lom_transform_row(liquid->depth, place);
    lom_mask seen = (s > 0.0f) & (s < 1.0f) & (t > 0.0f) & (t < 1.0f) & (depth < 1.0f);
    *share = lom_splat3(1, 1, 1);
    if (lom_any(seen)) {
        const lom_float3 through = look_through(liquid->map, liquid->size, s, t, depth);
        *share = (lom_float3){ lom_select(seen, through.x, share->x), lom_select(seen, through.y, share->y),
                               lom_select(seen, through.z, share->z) };
    }
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

/* Texture coordinates on a face, and depth, of the lanes whose place it sees. */
struct seen_by_face {
    lom_float s, t, depth;
};

static struct seen_by_face look_from(const struct lom_lamp_shadow_uniform *shadow,
                                     const struct lom_lamp_face_uniform *face, lom_float3 way, lom_float depth,
                                     lom_mask mine)
{
    lom_float inverse = lom_select(mine, 1.0f / depth, (lom_float){ 0 });
    return (struct seen_by_face){ 0.5f + shadow->scale * lom_dot3(way, lom_uniform3(face->right)) * inverse,
                                  0.5f - shadow->scale * lom_dot3(way, lom_uniform3(face->up)) * inverse,
                                  shadow->from * inverse };
}

/* A place behind the lamp has nothing before it. */
static lom_float face_light(const struct lom_lamp_shadow_uniform *shadow, const struct lom_lamp_face_uniform *face,
                            lom_float3 way, lom_float depth, lom_mask mine)
{
    const struct seen_by_face at = look_from(shadow, face, way, depth, mine);
    struct kernel k = compare_texels(face->map, NULL, shadow->size, shadow->texel, at.s, at.t, at.depth);
    return lom_select(mine & (k.dark > 0.0f), k.open, lom_splat(1.0f));
}

/* Places moved off their surface, less the lamp, and their depths. */
struct before_lamp {
    lom_float3 way;
    lom_float depth;
};

static struct before_lamp move_off(const struct lom_lamp_shadow_uniform *shadow, lom_float3 place, lom_float3 normal)
{
    lom_float3 way = lom_sub3(place, lom_uniform3(shadow->place));
    lom_float depth = depth_before(shadow, way);
    lom_float moved = depth * (shadow->lift + shadow->lean * lean_of(shadow, way, depth, normal));
    way = lom_add3(way, lom_scale3(normal, moved));
    return (struct before_lamp){ way, depth_before(shadow, way) };
}

void LOM_WIDE(lom_shade_lamp)(const struct lom_lamp_shadow_uniform *shadow, const lom_float3 *place,
                              const lom_float3 *normal, lom_float *share)
{
    const struct before_lamp at = move_off(shadow, *place, *normal);
    lom_mask left = (*share > 0.0f) & (at.depth > 0.0f);
    for (int i = 0; i < shadow->count && lom_any(left); i++) {
        const struct lom_lamp_face_uniform *face = &shadow->face[i];
        lom_mask mine = left & (lom_dot3(at.way, lom_uniform3(face->forward)) == at.depth);
        left = left & ~mine;
        if (face->map != NULL && lom_any(mine))
            *share = *share * face_light(shadow, face, at.way, at.depth, mine);
    }
}

void LOM_WIDE(lom_liquid_lamp)(const struct lom_lamp_shadow_uniform *shadow, const lom_float3 *place,
                               const lom_float3 *normal, lom_float3 *share)
{
    const struct before_lamp at = move_off(shadow, *place, *normal);
    lom_mask left = at.depth > 0.0f;
    const lom_float one = lom_splat(1.0f);
    *share = lom_splat3(1, 1, 1);
    for (int i = 0; i < shadow->count && lom_any(left); i++) {
        const struct lom_lamp_face_uniform *face = &shadow->face[i];
        lom_mask mine = left & (lom_dot3(at.way, lom_uniform3(face->forward)) == at.depth);
        left = left & ~mine;
        if (face->liquid == NULL || !lom_any(mine))
            continue;
        const struct seen_by_face seen = look_from(shadow, face, at.way, at.depth, mine);
        const lom_float3 through = look_through(face->liquid, shadow->size, seen.s, seen.t, seen.depth);
        *share = lom_mul3(*share, (lom_float3){ lom_select(mine, through.x, one), lom_select(mine, through.y, one),
                                                lom_select(mine, through.z, one) });
    }
}
