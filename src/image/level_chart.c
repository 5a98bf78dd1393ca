/* The chart of levels. In: a size. Out: a DDS file: its header, then levels of blocks of one colour each. */
#include "level_chart.h"

#include "bytes.h"

#include <string.h>

enum { HEADER = 128, BLOCK = 8, HUES = 8 };
enum { CAPS_HEIGHT_WIDTH_FORMAT_LEVELS = 0x21007, CODED = 4, TEXTURE_WITH_LEVELS = 0x401008 };

/* Blocks a side of a level of so many texels a side. */
static int blocks_of(int size)
{
    return size > 4 ? size / 4 : 1;
}

static void write_header(uint8_t *file, int size, int levels)
{
    memcpy(file, "DDS ", 4);
    store_32_little(file + 4, 124);
    store_32_little(file + 8, CAPS_HEIGHT_WIDTH_FORMAT_LEVELS);
    store_32_little(file + 12, (uint32_t)size);
    store_32_little(file + 16, (uint32_t)size);
    store_32_little(file + 28, (uint32_t)levels);
    store_32_little(file + 76, 32);
    store_32_little(file + 80, CODED);
    memcpy(file + 84, "DXT1", 4);
    store_32_little(file + 108, TEXTURE_WITH_LEVELS);
}

/* Both end points are the colour, 5 6 5 bits; every index is 0. */
static uint8_t *write_block(uint8_t *to, int level, bool bright)
{
    static const uint16_t hues[HUES][2] = { { 0x6b6d, 0xc638 }, { 0x8000, 0xf986 }, { 0x8a20, 0xfcc8 },
                                            { 0x8420, 0xffea }, { 0x0400, 0x57ea }, { 0x0410, 0x67ff },
                                            { 0x0010, 0x52bf }, { 0x6010, 0xd2bf } };
    uint32_t color = hues[level % HUES][bright];
    store_32_little(to, color | color << 16);
    store_32_little(to + 4, 0);
    return to + BLOCK;
}

lom_bytes lom_make_level_chart(int size, lom_error *error)
{
    size_t blocks = 0;
    int levels = 0;
    if (size < 4 || size > 4096 || (size & (size - 1)) != 0) {
        lom_fail(error, LOM_ERROR_USAGE, "A chart of levels has a power of two from 4 to 4096 texels a side, not %d.",
                 size);
        return (lom_bytes){ 0 };
    }
    for (int side = size; side > 0; side /= 2, levels++)
        blocks += (size_t)blocks_of(side) * (size_t)blocks_of(side);
    lom_bytes file = { lom_allocate(HEADER + BLOCK * blocks, 1, error), HEADER + BLOCK * blocks };
    if (file.data == NULL)
        return (lom_bytes){ 0 };
    write_header(file.data, size, levels);
    uint8_t *to = file.data + HEADER;
    for (int level = 0; level < levels; level++)
        for (int i = 0, side = blocks_of(size >> level); i < side * side; i++)
            to = write_block(to, level, (i / side + i) % 2 == 0);
    return file;
}
