/* The clouds of a frame. In: the frame whose scene and water are drawn. Out: clouds over them, the farthest first, each
 * marched up to what the depth holds. Invariant: a cloud that is out of view, or hidden, changes no byte. */
#include "pipeline/check_device.h"
#include "render/frame.h"

#include "cloud/cloud_draw.h"

#include <stdio.h>
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
    const lom_vec3 sun = f->renderer->moment.to_light;
    const double to_light[3] = { sun.x, sun.y, sun.z };
    int swept = 0;
    if (f->renderer->clouds.set == NULL)
        return true;
    lom_move_clouds(f->renderer->clouds.set, f->time);
    lom_shade_clouds(f);
    if (!lom_evolve_clouds(f->renderer->clouds.set, f->time, error) || !lom_begin_impostors(f, error))
        return false;
    if (lom_has_plates(f))
        return lom_draw_cloud_shadows(f, to_light); /* plates light their clouds when they are made */
    if (!lom_light_clouds(f->renderer->clouds.set, to_light, f->renderer->device, &swept, error))
        return false;
    if (swept != 0)
        lom_add_step(f, "cloud light", true,
                     "%d grids of light swept from the sun through %zu clouds, %zu of them in the shadow of terrain",
                     swept, f->renderer->clouds.set->count, f->renderer->clouds.set->shaded);
    else
        lom_add_step(f, "cloud light", false, "neither the sun nor a cloud has moved");
    return lom_draw_cloud_shadows(f, to_light);
}

bool lom_draw_clouds_over(struct frame *f, const struct lom_scene_view *view, lom_pass_desc pass, lom_texture *depth,
                          size_t *count, lom_error *error)
{
    lom_renderer *r = f->renderer;
    int height = pass.frame_height != 0 ? pass.frame_height : lom_texture_height(pass.color[0]);
    struct lom_cloud_view seen = cloud_view(f, view, height);
    seen.depth = depth;
    seen.origin_x = pass.origin_x;
    seen.origin_y = pass.origin_y;
    pass.depth = NULL;
    pass.color_load[0] = LOM_LOAD_KEEP;
    pass.label = "clouds";
    if (lom_has_plates(f))
        return lom_draw_impostors(f, view, &seen, &pass, count, error);
    size_t *order = r->clouds.set->order;
    *count = lom_order_clouds(r->clouds.set, &seen, f->scene->quality.impostor.culling, order);
    if (*count != 0) {
        lom_begin_pass(r->device, &pass);
        for (size_t i = 0; i < *count; i++)
            lom_draw_placed_cloud(r->device, r->clouds.set, &r->clouds.set->clouds[order[i]], &seen);
        lom_end_pass(r->device);
    }
    return lom_check_device(r->device, error);
}

static lom_step *add_cloud_step(struct frame *f, size_t count, const lom_impostor_counters *before)
{
    const lom_impostor_counters *now = f->impostors;
    size_t all = f->renderer->clouds.set->count;
    if (count == 0)
        return lom_add_step(f, "clouds", false, "none of %zu clouds is in view", all);
    if (!lom_has_plates(f))
        return lom_add_step(
            f, "clouds", true, "%zu of %zu clouds are in view; each is marched, the farthest first%s", count, all,
            f->scene->quality.impostors != LOM_IMPOSTORS_OFF ? "; plates are for neither parallel rays nor views" : "");
    const char *split = now->split != before->split ? "; one is cut in two around the aircraft" : "";
    if (!f->renderer->clouds.impostors.continues)
        return lom_add_step(f, "clouds", true,
                            "%zu of %zu clouds are in view; no frame of a run before this one: each is drawn afresh on "
                            "its plate%s",
                            count, all, split);
    return lom_add_step(f, "clouds", true,
                        "%zu of %zu clouds are in view; %d plates made anew, %d shown again, %d grids of light swept%s",
                        count, all, now->refreshed - before->refreshed, now->reused - before->reused,
                        f->renderer->clouds.impostors.swept, split);
}

/* A bound that is not kept is said, never passed over. */
static void add_capped(const struct lom_cloud_set *set, lom_step *step)
{
    int steps;
    size_t count = lom_count_capped_clouds(set, &steps), length = strlen(step->text);
    if (count != 0)
        snprintf(step->text + length, sizeof step->text - length,
                 "; %zu of all would take more than %d steps to keep quality.cloud_error: theirs are longer", count,
                 steps);
}

bool lom_draw_clouds(struct frame *f, lom_error *error)
{
    lom_renderer *r = f->renderer;
    if (r->clouds.set == NULL) {
        lom_add_step(f, "clouds", false, "%s",
                     f->scene->quality.clouds == LOM_CLOUDS_OFF && f->scene->cloud_count != 0
                         ? "quality.clouds is off"
                         : "the scene has no cloud");
        return true;
    }
    lom_impostor_counters before = *f->impostors;
    size_t count;
    if (!lom_draw_clouds_over(f, &f->view, lom_frame_pass(f, r->targets.of[f->target]), r->targets.of[LOM_TARGET_DEPTH],
                              &count, error))
        return false;
    lom_step *step = add_cloud_step(f, count, &before);
    if (count != 0)
        add_capped(r->clouds.set, step);
    step->width = f->crop.width;
    step->height = f->crop.height;
    return true;
}
