/* Lamps for the shaders of every model layer: which of them may reach a place, and what of a lamp's light comes there.
 *
 * A lamp's light ends at its reach, so the ground is divided into square tiles with a list each of the lamps that may
 * reach something over it (J. Persson, Practical Clustered Shading, SIGGRAPH 2013, has such lists for boxes of the
 * view's; those of the world serve vertices, mirrored views and water as well). Invariant: a lamp that a list leaves out
 * would add 0, and each list is in the order of the lamps, so lists change no bit of a sum. */
#ifndef LOM_SHADING_LAMP_H
#define LOM_SHADING_LAMP_H

#include "shading/lamp_shadow.h"
#include "shading/light.h"

struct lom_lamp_uniform {
    float place[3];     /* less the eye of the frame, metres; at infinity: the unit vector to it */
    float direction[3]; /* unit: the middle of its cone */
    float ambient[3], diffuse[3], specular[3];
    float attenuation[3];                  /* constant, linear, quadratic */
    float reach, square_reach;             /* metres, and squared; huge: no end */
    float inverse_fade;                    /* 1 / the metres before its reach over which it fades */
    float cosine_cutoff, inverse_softness; /* of the cone's edge; 1 / the cosines over which light begins */
    float exponent;
    bool infinite, spot;
    const struct lom_lamp_shadow_uniform *shadow; /* NULL: nothing keeps its light off */
    const char *name;                             /* of its term, in records: the scene's, or its number */
    char number[16];
    char shadow_name[64]; /* in records, of what its shadow leaves of its light */
};

/* Tile (column, row) is number row columns + column; behind the last one are the lamps that have no end. */
struct lom_lamps_uniform {
    const struct lom_lamp_uniform *lamps;
    float corner[2], inverse_side; /* of the tiles, less the eye of the frame; 1 / metres */
    int columns, rows;
    const uint32_t *first; /* of each list, and the end of the last one */
    const uint16_t *list;
};

/* What a lamp's attenuation is divided by, at least: at no distance its light is more than a million times its colour. */
#define LOM_LEAST_ATTENUATION 1e-6f

/* The lamps that may reach the places of a packet, one after the other, in those lanes whose tile has it. */
struct lom_lamp_walk {
    const struct lom_lamps_uniform *all;
    lom_float3 place;  /* less the eye of the frame */
    lom_float3 normal; /* of the surface there; 0: it throws no shadow on itself */
    lom_int tile;
    lom_mask left, now; /* lanes whose lists come later; whose list this is */
    uint32_t next, end;
};

LOM_INLINE struct lom_lamp_walk lom_walk_lamps(const struct lom_light_uniform *light, lom_float3 offset,
                                               lom_float3 normal)
{
    const struct lom_lamps_uniform *all = light->lamps;
    struct lom_lamp_walk walk = { .all = all,
                                  .normal = normal,
                                  .place = lom_add3(offset, lom_uniform3(light->lamp_shift)) };
    const float columns = (float)all->columns, rows = (float)all->rows;
    lom_float column = lom_floor((walk.place.x - all->corner[0]) * all->inverse_side);
    lom_float row = lom_floor((walk.place.z - all->corner[1]) * all->inverse_side);
    lom_mask inside = (column >= 0.0f) & (column < columns) & (row >= 0.0f) & (row < rows);
    walk.tile = lom_to_int(lom_select(inside, row * columns + column, lom_splat(columns * rows)));
    walk.left = lom_splat(0.0f) == 0.0f;
    return walk;
}

/* How many lamps the lists of the places have, for records: code in their variant alone. */
LOM_INLINE lom_float lom_listed_lamps(const struct lom_lamp_walk *walk)
{
    lom_float count = { 0 };
    for (int i = 0; i < LOM_LANES; i++)
        count[i] = (float)(walk->all->first[walk->tile[i] + 1] - walk->all->first[walk->tile[i]]);
    return count;
}

/* The next lamp; NULL behind the last one. */
LOM_INLINE const struct lom_lamp_uniform *lom_next_lamp(struct lom_lamp_walk *walk)
{
    while (walk->next == walk->end) {
        const uint32_t lanes = lom_bits(walk->left);
        if (lanes == 0)
            return NULL;
        const int tile = walk->tile[__builtin_ctz(lanes)];
        walk->now = walk->left & (walk->tile == tile);
        walk->left = walk->left & ~walk->now;
        walk->next = walk->all->first[tile];
        walk->end = walk->all->first[tile + 1];
    }
    return &walk->all->lamps[walk->all->list[walk->next++]];
}

/* 1 up to the last quarter of a lamp's reach, from there to 0 with a slope of 0 at both ends. */
LOM_INLINE lom_float lom_lamp_fade(const struct lom_lamp_uniform *lamp, lom_float distance)
{
    lom_float t = lom_saturate((lamp->reach - distance) * lamp->inverse_fade);
    return t * t * (3.0f - 2.0f * t);
}

/* max(-L.D, 0)^exponent within the cone, beginning at its edge; 0 outside. */
LOM_INLINE lom_float lom_lamp_cone(const struct lom_lamp_uniform *lamp, lom_float3 to_lamp)
{
    lom_float cosine = -lom_dot3(to_lamp, lom_uniform3(lamp->direction));
    lom_float edge = lom_saturate((cosine - lamp->cosine_cutoff) * lamp->inverse_softness);
    lom_mask inside = (cosine >= lamp->cosine_cutoff) & (edge > 0.0f);
    if (lamp->exponent != 0)
        edge = edge * lom_pow(lom_max(cosine, (lom_float){ 0 }), lom_splat(lamp->exponent));
    return lom_select(inside, edge, (lom_float){ 0 });
}

/* The share of a lamp's colours that would come to the places of the walk if nothing stood between, in its lanes, and the
 * unit vector there from where. False: nothing comes. */
LOM_INLINE bool lom_open_lamp_share(const struct lom_lamp_walk *walk, const struct lom_lamp_uniform *lamp,
                                    lom_float3 *to_lamp, lom_float *share)
{
    *share = lom_select(walk->now, lom_splat(1.0f), (lom_float){ 0 });
    *to_lamp = lom_uniform3(lamp->place);
    if (lamp->infinite)
        return true;
    lom_float3 way = lom_sub3(*to_lamp, walk->place);
    lom_float square = lom_dot3(way, way);
    if (!lom_any(walk->now & (square < lamp->square_reach)))
        return false;
    lom_float distance = lom_sqrt(square);
    *to_lamp = lom_scale3(way, lom_select(distance > 0.0f, 1.0f / distance, (lom_float){ 0 }));
    const float *k = lamp->attenuation;
    lom_float divisor = lom_max(k[0] + distance * (k[1] + distance * k[2]), lom_splat(LOM_LEAST_ATTENUATION));
    *share = *share * lom_lamp_fade(lamp, distance) / divisor;
    if (lamp->spot)
        *share = *share * lom_lamp_cone(lamp, *to_lamp);
    return lom_any(*share > 0.0f);
}

/* The same with the lamp's shadow. */
LOM_INLINE bool lom_lamp_share(const struct lom_lamp_walk *walk, const struct lom_lamp_uniform *lamp,
                               lom_float3 *to_lamp, lom_float *share)
{
    if (!lom_open_lamp_share(walk, lamp, to_lamp, share))
        return false;
    if (lamp->shadow == NULL)
        return true;
    const lom_float open = *share;
    LOM_WIDE(lom_shade_lamp)(lamp->shadow, &walk->place, &walk->normal, share);
    LOM_NAME_BY(lamp->shadow_name, lom_select(open > 0.0f, *share / open, (lom_float){ 0 }));
    return lom_any(*share > 0.0f);
}

#endif
