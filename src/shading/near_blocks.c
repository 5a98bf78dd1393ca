/* Blocks of a picture or a map: their own greatest depths, then those about them. Compiled for speed. */
#include "shading/near_blocks.h"

#include "base/reserve.h"
#include "image/texture.h"
#include "pipeline/share_work.h"

#include <string.h>

enum { SOME = 8 }; /* rows of blocks about which a worker looks at a time */

struct work {
    struct lom_near_blocks *blocks;
    const lom_texture *color, *depth;
};

/* The first texel of a block along an axis; of the one behind the last the size. */
static int first_texel(int block, int count, int size)
{
    return (int)((int64_t)block * size / count);
}

/* The greatest of depths that are not below 0, as their bits are. */
static int32_t greatest_bits(const void *texels, int count, int32_t most)
{
    const char *from = texels;
    for (int i = 0; i < count; i++) {
        int32_t bits;
        memcpy(&bits, from + (size_t)i * sizeof bits, sizeof bits);
        most = bits > most ? bits : most;
    }
    return most;
}

static bool has_bits(const void *texels, size_t words)
{
    const char *from = texels;
    uint32_t all = 0;
    for (size_t i = 0; i < words; i++) {
        uint32_t bits;
        memcpy(&bits, from + i * sizeof bits, sizeof bits);
        all |= bits;
    }
    return all != 0;
}

/* Colour is looked at where there is no depth, up to the first row that has some. */
static float look_at_block(const struct work *work, int column, int row)
{
    const struct lom_near_blocks *blocks = work->blocks;
    const int width = lom_texture_width(work->depth), height = lom_texture_height(work->depth);
    const int x = first_texel(column, blocks->columns, width);
    const int count = first_texel(column + 1, blocks->columns, width) - x;
    const int first = first_texel(row, blocks->rows, height), end = first_texel(row + 1, blocks->rows, height);
    int32_t most = 0;
    for (int y = first; y < end; y++)
        most = greatest_bits(lom_texel(work->depth, 0, x, y, 0), count, most);
    float depth;
    memcpy(&depth, &most, sizeof depth);
    if (depth > lom_only_color || work->color == NULL)
        return depth;
    const size_t words = lom_texel_size(work->color) / sizeof(uint32_t) * (size_t)count;
    for (int y = first; y < end; y++)
        if (has_bits(lom_texel(work->color, 0, x, y, 0), words))
            return lom_only_color;
    return depth;
}

static void look_at_rows(void *context, size_t first, size_t end)
{
    const struct work *work = context;
    struct lom_near_blocks *blocks = work->blocks;
    for (int row = (int)first; row < (int)end; row++)
        for (int column = 0; column < blocks->columns; column++)
            blocks->own[row * blocks->columns + column] = look_at_block(work, column, row);
}

static float greatest_around(const struct lom_near_blocks *blocks, int column, int row)
{
    float most = 0;
    for (int y = row > 0 ? row - 1 : 0; y <= row + 1 && y < blocks->rows; y++)
        for (int x = column > 0 ? column - 1 : 0; x <= column + 1 && x < blocks->columns; x++) {
            const float own = blocks->own[y * blocks->columns + x];
            most = own > most ? own : most;
        }
    return most;
}

static void look_around(void *context, size_t first, size_t end)
{
    const struct work *work = context;
    struct lom_near_blocks *blocks = work->blocks;
    for (int row = (int)first; row < (int)end; row++)
        for (int column = 0; column < blocks->columns; column++)
            blocks->around[row * blocks->columns + column] = greatest_around(blocks, column, row);
}

static int count_blocks(int texels, int edge)
{
    return texels < edge ? 1 : texels / edge;
}

bool lom_fill_near_blocks(struct lom_near_blocks *blocks, lom_device *device, const lom_texture *color,
                          const lom_texture *depth, int edge, lom_error *error)
{
    const int columns = count_blocks(lom_texture_width(depth), edge);
    const int rows = count_blocks(lom_texture_height(depth), edge);
    const size_t count = (size_t)columns * (size_t)rows;
    if (!lom_reserve(&blocks->memory, &blocks->capacity, 2 * count, sizeof *blocks->memory, error))
        return false;
    blocks->columns = columns;
    blocks->rows = rows;
    blocks->own = blocks->memory;
    blocks->around = blocks->memory + count;
    struct work work = { blocks, color, depth };
    lom_share_work(device, (size_t)rows, 1, look_at_rows, &work);
    lom_share_work(device, (size_t)rows, SOME, look_around, &work);
    return true;
}

void lom_free_near_blocks(struct lom_near_blocks *blocks)
{
    lom_release(blocks->memory);
    *blocks = (struct lom_near_blocks){ .columns = 0 };
}
