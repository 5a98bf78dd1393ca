/* The 3 x 3 texels of a depth map about places. In: three columns and three rows of texture coordinates. Out: the nearest
 * texel at each of their nine crossings.
 *
 * Invariant: what is found at (s[i], t[j]) is what lom_sample_depth finds there, bit for bit. */
#ifndef LOM_SHADING_DEPTH_SQUARE_H
#define LOM_SHADING_DEPTH_SQUARE_H

#include "image/nearest_depth.h"

struct lom_depth_square {
    lom_float at[3][3]; /* row, column */
};

/* Records name every texel that the definition looks up, which is lom_sample_depth. */
#ifdef LOM_RECORD
enum { LOM_LOADS_SQUARES = false };
#else
enum { LOM_LOADS_SQUARES = true };
#endif

LOM_INLINE struct lom_depth_square lom_defined_depth_square(const lom_texture *map, const lom_float s[3],
                                                            const lom_float t[3])
{
    struct lom_depth_square square;
    for (int j = 0; j < 3; j++)
        for (int i = 0; i < 3; i++)
            square.at[j][i] = lom_sample_depth(map, s[i], t[j]);
    return square;
}

LOM_INLINE bool lom_has_nearest_square(const lom_texture *map)
{
    return LOM_LOADS_SQUARES && sample_is_nearest_depth(map);
}

/* One texel, where it is looked up: what lom_sample_depth finds. */
LOM_INLINE lom_float lom_find_depth(const lom_texture *map, lom_float s, lom_float t)
{
    return lom_has_nearest_square(map) ? sample_nearest_depth(map, s, t) : lom_sample_depth(map, s, t);
}

/* Three neighbours of a row are one load a lane, and the texel behind them, which is at most the apron's. */
LOM_INLINE struct lom_depth_square lom_find_depth_square(const lom_texture *map, const lom_float s[3],
                                                         const lom_float t[3])
{
    if (!lom_has_nearest_square(map))
        return lom_defined_depth_square(map, s, t);
    const sample_place place = sample_place_of_level(map, 0);
    lom_int column[3];
    for (int i = 0; i < 3; i++)
        column[i] = sample_nearest_of_axis(s[i], place.width, map->sampler.wrap_s);
    const bool together =
        lom_all((column[1] == column[0] + 1) & (column[2] == column[0] + 2) & (column[2] <= map->level[0].width));
    struct lom_depth_square square;
    for (int j = 0; j < 3; j++) {
        const lom_int below = sample_nearest_of_axis(t[j], place.height, map->sampler.wrap_t);
        const lom_int row = place.offset + below * place.pitch;
        if (together) {
            const lom_float4 four = lom_gather_rows(map->texels, row + column[0]);
            square.at[j][0] = four.x + 0.0f;
            square.at[j][1] = four.y + 0.0f;
            square.at[j][2] = four.z + 0.0f;
        } else {
            for (int i = 0; i < 3; i++)
                square.at[j][i] = lom_gather(map->texels, row + column[i]) + 0.0f;
        }
    }
    return square;
}

#endif
