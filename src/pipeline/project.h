/* From clip space to snapped window positions: the numbers that the vertex stage (in lanes) and the clip stage (one
 * vertex at a time) share. */
#ifndef LOM_PIPELINE_PROJECT_H
#define LOM_PIPELINE_PROJECT_H

#include "pipeline/stages.h"

#define LOM_SMALLEST_W       1e-30f /* a smaller w is clipped, so that nothing divides by zero */
#define LOM_LARGEST_DISTANCE 1e30f  /* clip distances are clamped to it */

/* |x| <= guard.x w keeps a vertex within GUARD_PIXELS of the viewport's centre. */
struct lom_guard {
    float x, y;
};

static inline struct lom_guard lom_guard_of(const lom_rect *viewport)
{
    return (struct lom_guard){ 2.0f * GUARD_PIXELS / (float)viewport->width,
                               2.0f * GUARD_PIXELS / (float)viewport->height };
}

/* units = clip / w * scale + offset, relative to the viewport's origin; y points down. Depth into min_depth..max_depth.
 */
struct lom_projection {
    float x_scale, x_offset, y_scale, y_offset, z_scale, z_offset, z_low, z_high;
};

static inline struct lom_projection lom_projection_of(const struct lom_pass *pass, const struct lom_draw *draw)
{
    const lom_rect *viewport = &draw->desc.viewport;
    float low = draw->desc.min_depth, high = draw->desc.max_depth;
    bool centred = pass->desc.clip_range == LOM_CLIP_MINUS_W_TO_W;
    float half_w = (float)viewport->width * (SUBPIXELS / 2);
    float half_h = (float)viewport->height * (SUBPIXELS / 2);
    return (struct lom_projection){ .x_scale = half_w,
                                    .x_offset = half_w,
                                    .y_scale = -half_h,
                                    .y_offset = half_h,
                                    .z_scale = centred ? (high - low) * 0.5f : high - low,
                                    .z_offset = centred ? (high + low) * 0.5f : low,
                                    .z_low = low < high ? low : high,
                                    .z_high = low < high ? high : low };
}

#endif
