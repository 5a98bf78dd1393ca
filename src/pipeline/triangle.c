/* Between the stages 4 and 5: what a tile's stages need of one triangle, found from its vertices. Those that are drawn
 * together are found by lanes (cover.wide.c).
 *
 * Invariant: as in setup.wide.c, all is exact but what is rounded once: 1 / area from the rounded area. */
#include "pipeline/stages.h"

void lom_find_triangle(const struct lom_chunk *chunk, const lom_primitive *primitive, lom_triangle *t)
{
    const lom_rect *viewport = &chunk->draw->desc.viewport;
    int32_t v[3][2];
    float depth[3];
    if (chunk->draw->lines) {
        lom_find_line(chunk, primitive, t);
        return;
    }
    for (int k = 0; k < 3; k++) {
        const float *row = chunk->rows + primitive->row[k];
        memcpy(v[k], row, sizeof v[k]);
        depth[k] = row[2];
    }
    int64_t ux = v[1][0] - v[0][0], uy = v[1][1] - v[0][1], vx = v[2][0] - v[0][0], vy = v[2][1] - v[0][1];
    int64_t area = ux * vy - uy * vx, sign = area < 0 ? -1 : 1;
    const int64_t dx[2] = { sign * vy, -sign * uy }, dy[2] = { -sign * vx, sign * ux }; /* over SUBPIXELS */
    *t = (lom_triangle){ .primitive = *primitive,
                         .step_x1 = (float)dx[0] * SUBPIXELS,
                         .step_y1 = (float)dy[0] * SUBPIXELS,
                         .step_x2 = (float)dx[1] * SUBPIXELS,
                         .step_y2 = (float)dy[1] * SUBPIXELS,
                         .inverse_area = 1.0f / (float)(sign * area),
                         .depth = { depth[0], depth[1] - depth[0], depth[2] - depth[0] } };
    if (lom_kind_of(primitive) == TRIANGLE_LARGE)
        return;
    struct lom_bounds b = lom_bounds_of(primitive);
    int64_t px = (int64_t)((b.left & ~1) - viewport->x) * SUBPIXELS + SUBPIXELS / 2;
    int64_t py = (int64_t)((b.top & ~1) - viewport->y) * SUBPIXELS + SUBPIXELS / 2;
    t->area = (int32_t)(sign * area);
    for (int i = 0; i < 2; i++) /* both edges have vertex 0 */
        t->start[i] = (int32_t)(dx[i] * (px - v[0][0]) + dy[i] * (py - v[0][1]));
}
