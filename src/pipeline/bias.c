/* Depth bias (polygon offset). In: a draw and one of its triangles. Out: what is added to its depths: m slope + r
 * constant, limited (OpenGL 4.6, 14.6.5; include/lom/pipeline.h). Invariant: finite factors give a finite offset, and a
 * triangle of one depth gets no slope whatever the factor. */
#include "pipeline/stages.h"

/* The larger of |dz/dx| and |dz/dy|, a pixel. The plane through the three snapped vertices: with u = v1 - v0 and
 * v = v2 - v0, dz/dx = (zu vy - zv uy) / (ux vy - vx uy). Positions are below 2^24, so products are exact in double. */
static double steepest_slope(const float *const row[3])
{
    int32_t v[3][2];
    for (int k = 0; k < 3; k++)
        memcpy(v[k], row[k], sizeof v[k]);
    double ux = v[1][0] - v[0][0], uy = v[1][1] - v[0][1], vx = v[2][0] - v[0][0], vy = v[2][1] - v[0][1];
    double zu = (double)row[1][2] - row[0][2], zv = (double)row[2][2] - row[0][2];
    double area = ux * vy - vx * uy; /* not 0: set-up dropped those */
    double dx = __builtin_fabs((zu * vy - zv * uy) / area), dy = __builtin_fabs((zv * ux - zu * vx) / area);
    return (dx > dy ? dx : dy) * SUBPIXELS;
}

/* r: the attachment's step; for floats that of the largest depth, 2^(exponent - 23). */
static double resolution(const struct lom_pass *pass, const float *const row[3])
{
    if (pass->depth_scale != 0)
        return 1 / pass->depth_scale;
    float largest = 0;
    for (int k = 0; k < 3; k++)
        largest = row[k][2] > largest ? row[k][2] : largest;
    uint32_t bits;
    memcpy(&bits, &largest, sizeof bits);
    uint64_t exponent = bits >> 23 == 0 ? 1 : bits >> 23; /* denormals step as the smallest normal does */
    uint64_t step = (exponent + 1023 - 127 - 23) << 52;
    double r;
    memcpy(&r, &step, sizeof r);
    return r;
}

double lom_depth_offset(const struct lom_pass *pass, const struct lom_chunk *chunk, const lom_primitive *p)
{
    const lom_draw_desc *desc = &chunk->draw->desc;
    const float *const row[3] = { chunk->rows + p->row[0], chunk->rows + p->row[1], chunk->rows + p->row[2] };
    double offset = steepest_slope(row) * desc->depth_bias_slope + resolution(pass, row) * desc->depth_bias;
    double limit = desc->depth_bias_clamp;
    if (limit > 0 && offset > limit)
        return limit;
    if (limit < 0 && offset < limit)
        return limit;
    return offset;
}
