/* How far the farthest is that a picture shows from each of its rows of blocks down, so that a shader need not look at every texel
 * below a place. In: depth. Out: for each row of blocks the least depth in it, in the one above and in all below.
 *
 * Invariant: no texel that is below a place, or less than `edge` texels or the height of a block above it, is farther than what
 * stands for the place's row; where that is 0, one of them shows nothing. */
#ifndef LOM_SHADING_FAR_ROWS_H
#define LOM_SHADING_FAR_ROWS_H

#include <lom/pipeline.h>

struct lom_far_rows {
    int rows;
    float *own, *below; /* least depths, of a row and from the one above down: parts of one array */
    float *memory;
    size_t capacity;
};

/* For what shaders look up. */
struct lom_far_uniform {
    const float *below; /* NULL: it is not known */
    int rows;
};

/* Fills rows (zeros at first) of `edge` texels or more, or of the whole where that is smaller; memory is kept. False without
 * memory. */
bool lom_fill_far_rows(struct lom_far_rows *rows, lom_device *device, const lom_texture *depth, int edge,
                       lom_error *error);
void lom_free_far_rows(struct lom_far_rows *rows);

/* The least depth from the rows of places in the picture down. */
LOM_INLINE lom_float lom_farthest_below(const struct lom_far_uniform *far, lom_float t)
{
    lom_int row = lom_bounded_to_int(lom_saturate(t) * (float)far->rows);
    return lom_gather(far->below, lom_min_int(row, lom_splat_int(far->rows - 1)));
}

#endif
