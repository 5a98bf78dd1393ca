/* Texels of four floats between attachments and tile memory, which holds four planes of blocks of 2x2 pixels. In: a
 * rectangle of a tile. Out: the same rectangle of an attachment, two rows a step; and the reverse. Invariant: words are
 * moved, never rounded, and a texel does not depend on how many go at a time. */
#include <lom/lanes.h>

#include "pipeline/rows_ahead.h"
#include "pipeline/variants.h"

static size_t plane_of(const struct lom_rectangle *r)
{
    return (size_t)r->edge * (size_t)r->edge;
}

/* Where the first pixel's block of row y of the rectangle lies, or of both rows that share it. */
static size_t block_of(const struct lom_rectangle *r, int y)
{
    return (size_t)((r->y + y) >> 1) * 2 * (size_t)r->edge + (size_t)(r->x >> 1) * 4;
}

static bool begins_blocks(const struct lom_rectangle *r, int y)
{
    return ((r->x | (r->y + y)) & 1) == 0 && y + 1 < r->height;
}

/* One row, of which `from` is the block of the pixel `first`; that pixel may be a block's second. Channels that the
 * format lacks are stored as 0, a missing alpha as 1. */
static void store_row(const struct lom_rectangle *r, int channels, const float *from, int first, float *to, int count)
{
    for (int x = 0; x < count; x++) {
        const int in = (first & 1) + x;
        const float *word = from + 2 * in - (in & 1);
        for (int c = 0; c < 4; c++)
            to[4 * x + c] = c < channels ? word[(size_t)c * plane_of(r)] : c == 3 ? 1.0f : 0.0f;
    }
}

LOM_INLINE void store_two_rows(const struct lom_rectangle *r, int channels, const float *from, float *upper)
{
    const lom_int at = lom_lane_index() * 4;
    float *lower = upper + r->pitch;
    lom_float a[4] = { { 0 }, { 0 }, { 0 }, lom_splat(1.0f) }, b[4] = { { 0 }, { 0 }, { 0 }, lom_splat(1.0f) };
    int x = 0;
    for (; x + LOM_LANES <= r->width; x += LOM_LANES) {
        for (int c = 0; c < channels; c++) {
            lom_int even, odd;
            lom_split_pairs((const int32_t *)(const void *)(from + (size_t)c * plane_of(r)) + 2 * x, &even, &odd);
            a[c] = lom_as_float(even);
            b[c] = lom_as_float(odd);
        }
        lom_scatter_rows(upper + 4 * x, at, (lom_float4){ a[0], a[1], a[2], a[3] });
        lom_scatter_rows(lower + 4 * x, at, (lom_float4){ b[0], b[1], b[2], b[3] });
    }
    store_row(r, channels, from + 2 * x, 0, upper + 4 * x, r->width - x);
    store_row(r, channels, from + 2 * x + 2, 0, lower + 4 * x, r->width - x);
}

void LOM_WIDE(lom_store_texels)(const struct lom_rectangle *r, int channels, const float *planes)
{
    for (int y = 0; y < r->height;) {
        const float *from = planes + block_of(r, y);
        float *to = (float *)(void *)(r->texels + (size_t)y * r->pitch);
        if (!begins_blocks(r, y)) {
            store_row(r, channels, from + ((r->y + y) & 1) * 2, r->x, to, r->width);
            y++;
            continue;
        }
        lom_fetch_row(r, 4, y + ROWS_AHEAD);
        lom_fetch_row(r, 4, y + ROWS_AHEAD + 1);
        if (channels == 4)
            store_two_rows(r, 4, from, to);
        else
            store_two_rows(r, channels, from, to);
        y += 2;
    }
}

static void load_row(const struct lom_rectangle *r, const float *from, float *to, int first, int count)
{
    for (int x = 0; x < count; x++) {
        const int in = (first & 1) + x;
        for (int c = 0; c < 4; c++)
            to[(size_t)c * plane_of(r) + (size_t)(2 * in - (in & 1))] = from[4 * x + c];
    }
}

static void load_two_rows(const struct lom_rectangle *r, const float *upper, float *to)
{
    const lom_int at = lom_lane_index() * 4;
    const float *lower = upper + r->pitch;
    int x = 0;
    for (; x + LOM_LANES <= r->width; x += LOM_LANES) {
        const lom_float4 a = lom_gather_rows(upper + 4 * x, at), b = lom_gather_rows(lower + 4 * x, at);
        const lom_float above[4] = { a.x, a.y, a.z, a.w }, below[4] = { b.x, b.y, b.z, b.w };
        for (int c = 0; c < 4; c++) {
            uint32_t rows[2][LOM_LANES];
            lom_store_int((int32_t *)rows[0], lom_as_int(above[c]));
            lom_store_int((int32_t *)rows[1], lom_as_int(below[c]));
            LOM_WIDE(lom_join_rows)
            (rows[0], rows[1], LOM_LANES / 2, (uint32_t *)(void *)(to + (size_t)c * plane_of(r) + 2 * x));
        }
    }
    load_row(r, upper + 4 * x, to + 2 * x, 0, r->width - x);
    load_row(r, lower + 4 * x, to + 2 * x + 2, 0, r->width - x);
}

void LOM_WIDE(lom_load_texels)(const struct lom_rectangle *r, float *planes)
{
    for (int y = 0; y < r->height;) {
        float *to = planes + block_of(r, y);
        const float *from = (const float *)(const void *)(r->texels + (size_t)y * r->pitch);
        if (begins_blocks(r, y)) {
            load_two_rows(r, from, to);
            y += 2;
            continue;
        }
        load_row(r, from, to + ((r->y + y) & 1) * 2, r->x, r->width);
        y++;
    }
}

void LOM_WIDE(lom_fill_texels)(const struct lom_rectangle *r, const float texel[4])
{
    const lom_float texels = lom_gather(texel, lom_lane_index() & 3);
    for (int y = 0; y < r->height; y++) {
        float *row = (float *)(void *)(r->texels + (size_t)y * r->pitch);
        int i = 0;
        lom_fetch_row(r, 4, y + ROWS_AHEAD);
        for (; i + LOM_LANES <= 4 * r->width; i += LOM_LANES)
            lom_store(row + i, texels);
        for (; i < 4 * r->width; i++)
            row[i] = texel[i & 3];
    }
}
