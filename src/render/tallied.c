/* Frames that are tallied. In: a renderer, a frame, one of its targets. Out: the frame, to the same bytes as ever,
 * and tallies of that target. Invariant: the target is there before the frame is drawn. */
#include "render/tallied.h"

#include "pipeline/check_device.h"
#include "render/frame.h"

bool lom_draw_tallied(lom_renderer *r, const lom_frame_desc *desc, lom_tally_desc tally, enum lom_target target,
                      lom_frame *frame, lom_error *error)
{
    lom_frame_desc own = *desc;
    struct frame f = { .renderer = r, .scene = r->scene, .desc = &own };
    own.pixels = NULL;
    own.view = own.view != NULL ? own.view : LOM_MAIN_VIEW;
    if (r->reference != NULL)
        return lom_fail(error, LOM_ERROR_USAGE,
                        "This scene's picture is traced by the reference, which has no passes: look at it with another "
                        "model, like --set quality.water=planar and --set quality.clouds=lit.");
    if (!lom_find_frame_sizes(&f, error) || !lom_make_targets(r, f.width, f.height, f.crop.width, f.crop.height, error))
        return false;
    tally.target = r->targets.of[target];
    if (tally.target == NULL)
        return lom_render_frame(r, &own, frame, error);
    if (!lom_tally_target(r->device, &tally))
        return lom_check_device(r->device, error);
    return lom_render_frame(r, &own, frame, error);
}
