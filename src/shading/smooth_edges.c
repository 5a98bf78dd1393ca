/* The filter of edges as a draw. In: the three textures that a pass has left. Out: a square in the pass at hand. */
#include "shading/smooth_edges.h"
#include "pipeline/check_device.h"
#include "pipeline/device.h"
#include "pipeline/record.h"
#include "shading/square.h"

static bool check_filter(lom_device *device, const lom_edge_filter *filter)
{
    const lom_texture *of[] = { filter->color, filter->edges, filter->depth };
    for (int i = 0; i < 3; i++)
        if (of[i] == NULL || of[i]->level[0].width != of[0]->level[0].width ||
            of[i]->level[0].height != of[0]->level[0].height)
            return lom_fail(&device->error, LOM_ERROR_USAGE,
                            "Edges are smoothed by a picture, its edges and its depths, all of one size.");
    return true;
}

void lom_smooth_edges(lom_device *device, const lom_edge_filter *filter)
{
    static const lom_blend none = { .enabled = false };
    if (!lom_check_device(device, NULL) || !check_filter(device, filter))
        return;
    const struct lom_smooth_uniforms uniforms = {
        { (float)filter->origin_x, (float)filter->origin_y }, filter->color, filter->edges, filter->depth
    };
    lom_record_filter(device, filter->color);
    lom_draw_square(device, &lom_smooth_shader, &uniforms, &none);
}
