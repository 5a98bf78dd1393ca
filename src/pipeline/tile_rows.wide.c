/* Rows of pixels between attachments and tile memory, which holds blocks of 2x2 pixels. In: a rectangle of a tile. Out:
 * the same rectangle of an attachment, two rows a step and every word read and written once; and the reverse.
 * Invariant: a word's value does not depend on how many go at a time, or past which caches. */
#include <lom/lanes.h>

#include "pipeline/rows_ahead.h"
#include "pipeline/variants.h"

/* Two pixels side by side; rows of attachments are aligned to a pixel. */
typedef uint64_t __attribute__((may_alias, aligned(4))) pair;

/* The words as the attachment holds them: depth as a fraction of its largest number, channels that it lacks as 0 and a
 * missing alpha as 1. */
LOM_INLINE lom_int finish(const struct lom_rectangle *r, lom_int words, bool divides)
{
    return divides ? lom_as_int(lom_as_float(words) / r->divisor) : (words & r->keep) | r->set;
}

LOM_INLINE void put(const struct lom_rectangle *r, uint32_t *to, lom_int words)
{
    if (r->streams)
        lom_stream_int((int32_t *)to, words);
    else
        lom_store_int((int32_t *)to, words);
}

/* Past the caches no store waits. */
LOM_INLINE void fetch_row(const struct lom_rectangle *r, int y)
{
    if (!r->streams)
        lom_fetch_row(r, 1, y);
}

/* One row, of which `from` is the block of the pixel `first`; that pixel may be a block's second. */
static void store_row(const struct lom_rectangle *r, const uint32_t *from, int first, uint32_t *to, int count)
{
    for (int x = 0; x < count; x++) {
        int in = (first & 1) + x;
        lom_int word = lom_splat_int((int32_t)from[2 * in - (in & 1)]);
        to[x] = (uint32_t)finish(r, word, r->divisor != 0)[0];
    }
}

LOM_INLINE void store_two_rows(const struct lom_rectangle *r, const uint32_t *from, uint32_t *upper, bool divides)
{
    uint32_t *lower = upper + r->pitch;
    int x = 0;
    for (; x + LOM_LANES <= r->width; x += LOM_LANES) {
        lom_int a, b;
        lom_split_pairs((const int32_t *)from + 2 * x, &a, &b);
        put(r, upper + x, finish(r, a, divides));
        put(r, lower + x, finish(r, b, divides));
    }
    store_row(r, from + 2 * x, 0, upper + x, r->width - x);
    store_row(r, from + 2 * x + 2, 0, lower + x, r->width - x);
}

void LOM_WIDE(lom_store_rectangle)(const struct lom_rectangle *rectangle, const uint32_t *memory)
{
    const struct lom_rectangle copy = *rectangle, *r = &copy; /* which no store of a word may change */
    for (int y = 0; y < r->height;) {
        int row = r->y + y;
        const uint32_t *from = memory + (size_t)(row >> 1) * 2 * (size_t)r->edge + (size_t)(r->x >> 1) * 4;
        uint32_t *to = r->texels + (size_t)y * r->pitch;
        if (((r->x | row) & 1) != 0 || y + 1 == r->height) {
            store_row(r, from + (row & 1) * 2, r->x, to, r->width);
            y++;
            continue;
        }
        fetch_row(r, y + ROWS_AHEAD);
        fetch_row(r, y + ROWS_AHEAD + 1);
        if (r->divisor != 0)
            store_two_rows(r, from, to, true);
        else
            store_two_rows(r, from, to, false);
        y += 2;
    }
    if (r->streams)
        lom_end_streams();
}

void LOM_WIDE(lom_fill_rectangle)(const struct lom_rectangle *r, uint32_t value)
{
    lom_int word = finish(r, lom_splat_int((int32_t)value), r->divisor != 0);
    for (int y = 0; y < r->height; y++) {
        uint32_t *row = r->texels + (size_t)y * r->pitch;
        int x = 0;
        fetch_row(r, y + ROWS_AHEAD);
        for (; x + LOM_LANES <= r->width; x += LOM_LANES)
            put(r, row + x, word);
        for (; x < r->width; x++)
            row[x] = (uint32_t)word[0];
    }
    if (r->streams)
        lom_end_streams();
}

void LOM_WIDE(lom_fill_words)(uint32_t *to, uint32_t value, size_t count)
{
    for (size_t i = 0; i < count; i += LOM_LANES)
        lom_store_int((int32_t *)to + i, lom_splat_int((int32_t)value));
}

void LOM_WIDE(lom_join_rows)(const uint32_t *restrict upper, const uint32_t *restrict lower, size_t blocks,
                             uint32_t *restrict to)
{
    const pair *a = (const pair *)upper, *b = (const pair *)lower;
    pair *out = (pair *)to;
    for (size_t i = 0; i < blocks; i++) {
        out[2 * i] = a[i];
        out[2 * i + 1] = b[i];
    }
}
