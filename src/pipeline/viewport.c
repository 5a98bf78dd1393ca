/* Where a draw is laid on the frame. In: the viewports, depth ranges and scissors that passes and draws name. Out:
 * those of each draw, resolved. Invariant: a pixel that a draw may change lies in the attachments, its viewport and
 * both scissors; numbers in its chunks are from the corner of its own viewport. */
#include "pipeline/device.h"

lom_rect lom_intersect_rects(lom_rect a, lom_rect b)
{
    int64_t x0 = a.x > b.x ? a.x : b.x, y0 = a.y > b.y ? a.y : b.y;
    int64_t ax = (int64_t)a.x + a.width, bx = (int64_t)b.x + b.width;
    int64_t ay = (int64_t)a.y + a.height, by = (int64_t)b.y + b.height;
    int64_t x1 = ax < bx ? ax : bx, y1 = ay < by ? ay : by;
    return (lom_rect){ (int)x0, (int)y0, x1 > x0 ? (int)(x1 - x0) : 0, y1 > y0 ? (int)(y1 - y0) : 0 };
}

bool lom_check_viewport(lom_device *device, const lom_rect *v, float min_depth, float max_depth)
{
    if (!(min_depth >= 0 && min_depth <= 1 && max_depth >= 0 && max_depth <= 1))
        return lom_fail(&device->error, LOM_ERROR_USAGE, "A depth range lies within 0 to 1.");
    if (v->width < 1 || v->height < 1 || v->width > LOM_MAX_SIZE || v->height > LOM_MAX_SIZE || v->x < -LOM_MAX_SIZE ||
        v->y < -LOM_MAX_SIZE || v->x > LOM_MAX_SIZE || v->y > LOM_MAX_SIZE)
        return lom_fail(&device->error, LOM_ERROR_USAGE, "A viewport of %dx%d at %d,%d is out of range.", v->width,
                        v->height, v->x, v->y);
    return true;
}

bool lom_check_draw_viewport(lom_device *device, const lom_draw_desc *desc)
{
    return lom_check_viewport(device, desc->viewport.width == 0 ? &device->pass.desc.viewport : &desc->viewport,
                              desc->min_depth, desc->max_depth);
}

void lom_derive_viewport(const struct lom_pass *pass, struct lom_draw *draw)
{
    lom_draw_desc *desc = &draw->desc;
    if (desc->viewport.width == 0)
        desc->viewport = pass->desc.viewport;
    if (desc->min_depth == 0 && desc->max_depth == 0) {
        desc->min_depth = pass->desc.min_depth;
        desc->max_depth = pass->desc.max_depth;
    }
    draw->scissor = desc->scissor.width == 0 ? pass->scissor : lom_intersect_rects(desc->scissor, pass->scissor);
    draw->scissor = lom_intersect_rects(draw->scissor, desc->viewport);
}
