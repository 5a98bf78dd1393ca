/* Two rows of pixels at a time between attachments and tile memory, which holds blocks of 2x2 pixels. In and out: whole
 * blocks. Invariant: words are moved as they are. */
#include "pipeline/stages.h"

/* Two pixels side by side; rows of attachments are aligned to a pixel. */
typedef uint64_t __attribute__((may_alias, aligned(4))) pair;

void LOM_WIDE(lom_split_rows)(const uint32_t *restrict from, size_t blocks, uint32_t *restrict upper,
                              uint32_t *restrict lower)
{
    const pair *in = (const pair *)from;
    pair *a = (pair *)upper, *b = (pair *)lower;
    for (size_t i = 0; i < blocks; i++) {
        a[i] = in[2 * i];
        b[i] = in[2 * i + 1];
    }
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

void LOM_WIDE(lom_divide_row)(float *row, size_t count, float divisor)
{
    for (size_t i = 0; i < count; i++)
        row[i] /= divisor;
}
