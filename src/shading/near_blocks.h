/* How near the nearest is that a picture or a map shows in and about each of its blocks, so that a shader need not look at
 * every texel about a place where nothing can be near. In: depth, and what colour a picture has with it. Out: for each block the
 * greatest depth in it and in its neighbours.
 *
 * Invariant: no texel that is less than `edge` texels, or the size of a block, from a place is nearer than what stands for the
 * place's block; where that is 0, all of them have neither colour nor depth, in any level of the picture. */
#ifndef LOM_SHADING_NEAR_BLOCKS_H
#define LOM_SHADING_NEAR_BLOCKS_H

#include <lom/pipeline.h>

/* Of nothing but colour, which no depth of a place is as small as. */
static const float lom_only_color = 0x1p-126f;

struct lom_near_blocks {
    int columns, rows;
    float *own, *around; /* greatest depths, of blocks and with their neighbours: parts of one array */
    float *memory;
    size_t capacity;
};

/* For what shaders look up. */
struct lom_near_uniform {
    const float *around; /* NULL: it is not known */
    int columns, rows;
};

/* Fills blocks (zeros at first) of `edge` texels or more, or of the whole where that is smaller; color: NULL, there is none;
 * memory is kept. False without memory. */
bool lom_fill_near_blocks(struct lom_near_blocks *blocks, lom_device *device, const lom_texture *color,
                          const lom_texture *depth, int edge, lom_error *error);
void lom_free_near_blocks(struct lom_near_blocks *blocks);

/* The greatest depth about places in the picture. */
LOM_INLINE lom_float lom_nearest_around(const struct lom_near_uniform *near, lom_float s, lom_float t)
{
    lom_int column = lom_bounded_to_int(lom_saturate(s) * (float)near->columns);
    lom_int row = lom_bounded_to_int(lom_saturate(t) * (float)near->rows);
    column = lom_min_int(column, lom_splat_int(near->columns - 1));
    row = lom_min_int(row, lom_splat_int(near->rows - 1));
    return lom_gather(near->around, row * near->columns + column);
}

#endif
