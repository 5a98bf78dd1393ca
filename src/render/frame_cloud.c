/* The clouds of a frame. In: the frame whose scene and water are drawn. Out: clouds over them, the farthest first, each
 * marched up to what the depth holds. Invariant: a cloud that is out of view, or hidden, changes no byte. */
#include "render/frame.h"

#include "cloud/cloud_draw.h"

#include <string.h>

static struct lom_cloud_view cloud_view(const struct frame *f, const struct lom_scene_view *view, int height)
{
    return (struct lom_cloud_view){ .projection = view->projection,
                                    .view = view->view,
                                    .eye = view->eye,
                                    .near_plane = f->camera.near_plane,
                                    .mirrored = view->mirrored,
                                    .pixel_angle = 2 / (view->projection.m[1][1] * height),
                                    .light = lom_scene_light(f->scene) };
}

bool lom_prepare_clouds(struct frame *f, lom_error *error)
{
    const lom_vec3 direction = f->scene->light.direction;
    const double to_light[3] = { -direction.x, -direction.y, -direction.z };
    int swept = 0;
    if (f->renderer->clouds == NULL)
        return true;
    if (!lom_light_clouds(f->renderer->clouds, to_light, &swept, error))
        return false;
    if (swept != 0)
        lom_add_step(f, "cloud light", true, "%d grids of light swept from the sun through %zu clouds", swept,
                     f->renderer->clouds->count);
    else
        lom_add_step(f, "cloud light", false, "neither the sun nor a cloud has moved");
    return true;
}

size_t lom_draw_clouds(struct frame *f, const struct lom_scene_view *view, lom_pass_desc pass, lom_texture *depth,
                       lom_error *error)
{
    lom_renderer *r = f->renderer;
    size_t *order = lom_allocate(r->clouds->count, sizeof *order, error);
    if (order == NULL)
        return 0;
    int height = pass.frame_height != 0 ? pass.frame_height : lom_texture_height(pass.color[0]);
    struct lom_cloud_view seen = cloud_view(f, view, height);
    seen.depth = depth;
    seen.origin_x = pass.origin_x;
    seen.origin_y = pass.origin_y;
    size_t count = lom_order_clouds(r->clouds, &seen, order);
    pass.depth = NULL;
    pass.color_load[0] = LOM_LOAD_KEEP;
    if (count != 0) {
        lom_begin_pass(r->device, &pass);
        for (size_t i = 0; i < count; i++)
            lom_draw_placed_cloud(r->device, r->clouds, &r->clouds->clouds[order[i]], &seen);
        lom_end_pass(r->device);
    }
    lom_release(order);
    return count;
}

bool lom_draw_cloud_stage(struct frame *f, lom_error *error)
{
    lom_renderer *r = f->renderer;
    if (r->clouds == NULL) {
        lom_add_step(f, "clouds", false, "%s",
                     f->scene->quality.clouds == LOM_CLOUDS_OFF && f->scene->cloud_count != 0
                         ? "quality.clouds is off"
                         : "the scene has no cloud");
        return true;
    }
    size_t count = lom_draw_clouds(f, &f->view, lom_frame_pass(f, r->color), r->depth, error);
    lom_step *step = lom_add_step(f, "clouds", count != 0, "%zu of %zu clouds are in view%s", count, r->clouds->count,
                                  count != 0 ? "; each is marched, the farthest first" : "");
    step->width = f->crop.width;
    step->height = f->crop.height;
    return lom_device_error(r->device)->code == LOM_OK;
}
