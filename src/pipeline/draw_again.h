/* Draws of a pass that differ in their triangles and in their base vertex alone: checked once, then a call each. */
#ifndef LOM_PIPELINE_DRAW_AGAIN_H
#define LOM_PIPELINE_DRAW_AGAIN_H

#include <lom/pipeline.h>

/* A draw of the pass that has begun. */
struct lom_held_draw {
    bool is_held;
    int corners;             /* indices of a primitive */
    uint32_t draw, uniforms; /* of the device's */
    size_t first;            /* its first index */
};

/* Checks a descriptor of a list of triangles or patches by indices, and copies its uniforms, without drawing anything yet:
 * its first and count are those of all that will be. Where the pass has a draw that differs in its uniforms alone, that is held,
 * so that calls of both can share chunks. False where it is not held: the pass is recorded, the draw is of
 * another kind, or the device holds an error. */
bool lom_hold_draw(lom_device *device, const lom_draw_desc *desc, struct lom_held_draw *held);
/* Draws as the held descriptor says, but for `count` indices from `first` on, a whole number of primitives behind the first
 * of all, and with the `base_vertex` of this one; what is not held by lom_draw. Patches are numbered (lom/stages.h) as those
 * of the held descriptor. */
void lom_draw_held(lom_device *device, const struct lom_held_draw *held, const lom_draw_desc *desc);

#endif
