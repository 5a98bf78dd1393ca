/* Between the stages 6 and 7: where triangles end (lom/pipeline.h, "edges"). In: a packet of fragments, what their weights
 * change by a pixel. Out: tile->reach, which the output stage stores beside their colours.
 *
 * A weight l that changes by -u a pixel is 0 after d = l / u pixels, and d / (1 + d) = l / (l + u): one division, and no
 * distance is too long for it.
 *
 * Invariant: a fragment's numbers follow from its own weights and triangle, whichever packet it is in. */
#include "pipeline/mark_edges.h"
#include "pipeline/window.h"

#include <lom/lanes_mathematics.h>

enum { FORWARD, BACKWARD, DIRECTIONS }; /* right and left, or down and up */

/* The lesser of what is there and of where l ends, in lanes of mask; l changes by `step` a pixel forward. */
LOM_INLINE void approach(lom_float reach[DIRECTIONS], lom_float l, lom_float step, lom_mask mask)
{
    const lom_float end = lom_max(l, (lom_float){ 0 }) / (lom_max(l, (lom_float){ 0 }) + lom_abs(step));
    for (int i = 0; i < DIRECTIONS; i++) {
        const lom_mask ends = mask & (i == FORWARD ? step < 0.0f : step > 0.0f);
        reach[i] = lom_select(ends, lom_min(reach[i], end), reach[i]);
    }
}

struct planes { /* the three weights, along x and y */
    const lom_float *l;
    lom_float step[2][3];
};

/* The sums of clip distances that cut triangle `i` of the packet: where they change their sign it ends. */
static void approach_distances(const struct lom_tile *tile, const struct lom_packet *packet, int i,
                               const struct planes *planes, lom_float reach[2][DIRECTIONS])
{
    const lom_primitive *p = &tile->chunk->primitives[packet->triangle[i]];
    const lom_mask mask = packet->triangles == 1 ? lom_splat_int(-1) : packet->which == i;
    const lom_float *l = planes->l;
    for (uint32_t clip = p->state >> TRIANGLE_CLIP; clip != 0; clip &= clip - 1) {
        float d[3];
        LOM_WIDE(lom_scale_distances)(tile->chunk, p, tile->draw->distance_offset + __builtin_ctz(clip), d);
        for (int axis = 0; axis < 2; axis++) {
            const lom_float *step = planes->step[axis];
            approach(reach[axis], l[0] * d[0] + l[1] * d[1] + l[2] * d[2],
                     step[0] * d[0] + step[1] * d[1] + step[2] * d[2], mask);
        }
    }
}

static void store(struct lom_tile *tile, lom_float reach[2][DIRECTIONS])
{
    for (int axis = 0; axis < 2; axis++)
        for (int i = 0; i < DIRECTIONS; i++)
            lom_store(tile->reach[axis * DIRECTIONS + i], reach[axis][i]);
}

void LOM_WIDE(lom_mark_no_edges)(struct lom_tile *tile)
{
    const lom_float none = lom_splat(1.0f);
    store(tile, (lom_float[2][DIRECTIONS]){ { none, none }, { none, none } });
}

void LOM_WIDE(lom_mark_edges)(struct lom_tile *tile, const struct lom_packet *packet, const lom_float4 *step,
                              bool is_cut)
{
    const lom_float one = lom_splat(1.0f);
    const struct planes planes = {
        packet->l, { { -(step->x + step->z), step->x, step->z }, { -(step->y + step->w), step->y, step->w } }
    };
    lom_float reach[2][DIRECTIONS] = { { one, one }, { one, one } };
    for (int axis = 0; axis < 2; axis++)
        for (int k = 0; k < 3; k++)
            approach(reach[axis], packet->l[k], planes.step[axis][k], lom_splat_int(-1));
    for (int i = 0; i < packet->triangles && is_cut; i++)
        approach_distances(tile, packet, i, &planes, reach);
    store(tile, reach);
}
