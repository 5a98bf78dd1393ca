/* Stage 5 of 7, its end: covered pixels of one triangle in a window. In: coverage and weights. Out: the fragments that
 * user clip distances and the early depth test leave, to the queue or the fragment stage.
 *
 * Invariant: depths are rounded to what the attachment holds before they are compared. */
#include "pipeline/record.h"
#include "pipeline/sample_tests.h"

#include <lom/lanes_mathematics.h>

enum { ALL_LANES = (1 << LOM_LANES) - 1 };

/* No product with a weight overflows, and none that could decide alone vanishes. */
void LOM_WIDE(lom_scale_distances)(const struct lom_chunk *chunk, const lom_primitive *p, int offset, float d[3])
{
    double product[3], largest = 0, scale;
    for (int k = 0; k < 3; k++) {
        const float *row = chunk->rows + p->row[k];
        product[k] = (double)row[offset] * row[ROW_HEADER - 1]; /* exact */
        double size = product[k] < 0 ? -product[k] : product[k];
        largest = size > largest ? size : largest;
    }
    uint64_t bits;
    memcpy(&bits, &largest, sizeof bits);
    bits = (UINT64_C(2046) - (bits >> 52)) << 52; /* 2^-exponent */
    memcpy(&scale, &bits, sizeof scale);
    for (int k = 0; k < 3; k++)
        d[k] = (float)(product[k] * scale);
}

/* Where a triangle crosses a user clip distance the sign of sum(l d / w) decides; it is odd in d, so d and -d share the
 * pixels exactly. Where the sum is 0 the sign of its gradient decides, as the top-left rule does for edges; the steps
 * of the edge functions add up to 0. */
void LOM_WIDE(lom_test_distances)(const struct lom_tile *tile, const lom_triangle *t, const lom_float l[3],
                                  lom_mask *inside)
{
    double x1 = t->step_x1, y1 = t->step_y1, x2 = t->step_x2, y2 = t->step_y2;
    for (uint32_t clip = t->primitive.state >> TRIANGLE_CLIP; clip != 0; clip &= clip - 1) {
        float d[3];
        LOM_WIDE(lom_scale_distances)(tile->chunk, &t->primitive, tile->draw->distance_offset + __builtin_ctz(clip), d);
        lom_float sum = l[0] * d[0] + l[1] * d[1] + l[2] * d[2];
        double gx = -(x1 + x2) * d[0] + x1 * d[1] + x2 * d[2], gy = -(y1 + y2) * d[0] + y1 * d[1] + y2 * d[2];
        bool keeps_zero = gx > 0 || (gx == 0 && gy >= 0);
        *inside &= keeps_zero ? sum >= 0.0f : sum > 0.0f;
    }
}

/* The depth with the draw's bias, rounded once to what the attachment holds. Not inlined: few draws have one. */
__attribute__((noinline)) void LOM_WIDE(lom_offset_depth)(const struct lom_tile *tile, const lom_triangle *t,
                                                          lom_float *z)
{
    double scale = tile->pass->depth_scale;
    lom_double one = lom_splat_double(1),
               sum = lom_widen(*z) + lom_depth_offset(tile->pass, tile->chunk, &t->primitive);
    sum = lom_select_double(sum > 0.0, lom_select_double(sum < 1.0, sum, one), one - 1.0);
    if (scale != 0)
        sum = ((sum * scale + LOM_NEAREST) - LOM_NEAREST) / scale;
    *z = lom_narrow(sum);
}

void LOM_WIDE(lom_emit)(struct lom_tile *tile, const struct part *at, const lom_mask *mask, const lom_float l[3],
                        bool alone)
{
    const struct lom_draw *draw = tile->draw;
    const lom_triangle *t = at->triangle;
    lom_mask covered = *mask;
    lom_float z = { 0 };
    if (t->primitive.state >> TRIANGLE_CLIP != 0)
        LOM_WIDE(lom_test_distances)(tile, t, l, &covered);
    if (tile->depth != NULL || draw->queues_depth)
        z = interpolate_depth(&at->depth, l);
    if (draw->biased) {
        lom_float moved = z;
        LOM_WIDE(lom_offset_depth)(tile, t, &moved);
        z = moved;
    }
    LOM_RECORD_HOOK(lom_record_covered, tile, at, mask, &covered, l, &z);
    if (tile->tests_early)
        covered = lom_test_depth(tile, at->base + tile->offset[at->part * LOM_LANES], covered, z);
    else if (tile->tests_all)
        LOM_WIDE(lom_test_part)(tile, at, &covered, &z);
    LOM_RECORD_HOOK(lom_record_tested, tile, at, &covered);
    uint32_t bits = lom_bits(covered);
    if (bits == 0)
        return;
    tile->fragments += lom_count_bits(bits);
    if (tile->rejects_early) {
        covered = lom_test_depth(tile, at->base + tile->offset[at->part * LOM_LANES], covered, z);
        bits = lom_bits(covered);
        if (bits == 0)
            return;
    }
    if (draw->desc.shader->fragment[draw->variant] == NULL)
        return;
    if (!draw->constant && bits == ALL_LANES && (alone || tile->queue.count == 0)) {
        LOM_WIDE(lom_shade_part)(tile, at, l, &z);
        return;
    }
    struct lom_fragments f;
    f.triangle = lom_splat_int(at->number);
    f.pixel = lom_load_int(tile->offset + at->part * LOM_LANES) + at->base;
    f.covered = covered;
    f.depth = z;
    for (int k = 0; k < 3; k++)
        f.l[k] = l[k];
    LOM_WIDE(lom_deliver)(tile, &f, alone);
}
