/* Texels of a packet whose pixels are a window (pipeline/window.h), as those of large triangles are: rows of memory, in place
 * of an index a lane. In: a texture of four bytes a texel. Out: the texels' words.
 *
 * Invariant: what is loaded is what lom_fetch looks up there. */
#ifndef LOM_SHADING_WINDOW_TEXELS_H
#define LOM_SHADING_WINDOW_TEXELS_H

#include "image/texture.h"
#include "lanes/fours.h"
#include "pipeline/window.h"

#include <string.h>

/* Records name every texel that the definition looks up, which is lom_fetch. */
#ifdef LOM_RECORD
enum { LOM_LOADS_WINDOWS = false };
#else
enum { LOM_LOADS_WINDOWS = true };
#endif

/* Whether the pixels are a window, or the first part of one, in its order of lanes, and `around` texels about it exist. */
LOM_INLINE bool lom_is_window(const lom_texture *texture, lom_int x, lom_int y, int around)
{
    const int width = texture->level[0].width, height = texture->level[0].height;
    if (!LOM_LOADS_WINDOWS || x[0] < around || y[0] < around || x[0] > width - 4 - around || y[0] > height - 4 - around)
        return false;
    return lom_all((x == lane_x(0) + x[0]) & (y == lane_y(0) + y[0]));
}

/* The texels of level 0 of the window whose first pixel is (x, y). */
LOM_INLINE lom_int lom_window_words(const lom_texture *texture, int x, int y)
{
    const lom_level *level = &texture->level[0];
    const int32_t *first = texture->texels;
    first += level->offset + (size_t)y * level->pitch + (size_t)x;
#if LOM_LANES == 4
    return (lom_int){ first[0], first[1], first[level->pitch], first[level->pitch + 1] };
#else
    const int32_t *row[LOM_LANES / 4];
    for (int i = 0; i < LOM_LANES / 4; i++)
        row[i] = first + (size_t)i * level->pitch;
    return lom_as_int(lom_permute(lom_as_float(lom_load_fours(row)), lane_y(0) * 4 + lane_x(0)));
#endif
}

#endif
