#include "shading/far_rows.h"

#include "base/reserve.h"
#include "image/texture.h"
#include "pipeline/share_work.h"

#include <string.h>

struct work {
    struct lom_far_rows *rows;
    const lom_texture *depth;
};

/* The first texel of a row of blocks; of the one behind the last the height. */
static int first_texel(const struct work *work, size_t row)
{
    return (int)((int64_t)row * lom_texture_height(work->depth) / work->rows->rows);
}

/* The least of depths that are not below 0, as their bits are. */
static uint32_t least_bits(const void *texels, size_t count, uint32_t least)
{
    const char *from = texels;
    for (size_t i = 0; i < count; i++) {
        uint32_t bits;
        memcpy(&bits, from + i * sizeof bits, sizeof bits);
        least = bits < least ? bits : least;
    }
    return least;
}

static void look_at_rows(void *context, size_t first, size_t end)
{
    const struct work *work = context;
    for (size_t row = first; row < end; row++) {
        uint32_t least = UINT32_MAX;
        for (int y = first_texel(work, row); y < first_texel(work, row + 1); y++)
            least = least_bits(lom_texel(work->depth, 0, 0, y, 0), (size_t)lom_texture_width(work->depth), least);
        memcpy(&work->rows->own[row], &least, sizeof least);
    }
}

bool lom_fill_far_rows(struct lom_far_rows *rows, lom_device *device, const lom_texture *depth, int edge,
                       lom_error *error)
{
    const int height = lom_texture_height(depth), count = height < edge ? 1 : height / edge;
    if (!lom_reserve(&rows->memory, &rows->capacity, 2 * (size_t)count, sizeof *rows->memory, error))
        return false;
    rows->rows = count;
    rows->own = rows->memory;
    rows->below = rows->memory + count;
    struct work work = { rows, depth };
    lom_share_work(device, (size_t)count, 1, look_at_rows, &work);
    float least = rows->own[count - 1];
    for (int row = count - 1; row >= 0; row--) {
        const float above = rows->own[row > 0 ? row - 1 : 0];
        least = above < least ? above : least;
        rows->below[row] = least;
    }
    return true;
}

void lom_free_far_rows(struct lom_far_rows *rows)
{
    lom_release(rows->memory);
    *rows = (struct lom_far_rows){ .rows = 0 };
}
