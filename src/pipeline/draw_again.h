/* Draws of a pass that differ in their triangles alone: checked once, then a call each. */
#ifndef LOM_PIPELINE_DRAW_AGAIN_H
#define LOM_PIPELINE_DRAW_AGAIN_H

#include <lom/pipeline.h>

/* A draw of the pass that has begun. */
struct lom_held_draw {
    bool is_held;
    uint32_t draw, uniforms; /* of the device's */
    size_t first;            /* index of its first triangle */
};

/* Checks a descriptor of a list of triangles by indices, and copies its uniforms, without drawing anything yet: its first
 * and count are those of all triangles that will be. False where each draw is to be made by lom_draw: the pass is recorded,
 * the draw is of another kind, or the device holds an error. */
bool lom_hold_draw(lom_device *device, const lom_draw_desc *desc, struct lom_held_draw *held);
/* Draws the triangles of `count` indices from `first` on, a multiple of 3 behind the first of all. */
void lom_draw_held(lom_device *device, const struct lom_held_draw *held, size_t first, size_t count);

#endif
