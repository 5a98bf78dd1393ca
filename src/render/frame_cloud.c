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

enum { SHADOW_SIZE = 512 };            /* texels a side of the ground's shadow map */
static const double lowest_sun = 0.03; /* sine of its elevation, below which shadows run out of every map */

/* What can be shadowed: x and z of the terrain and the water, and how high it reaches; false when there is neither. */
static bool find_ground(const lom_scene *scene, double extent[4], double *low, double *high)
{
    const lom_terrain *t = &scene->terrain;
    const lom_water_params *w = &scene->water;
    bool any = false;
    *low = 1e300;
    *high = -1e300;
    extent[0] = extent[2] = 1e300;
    extent[1] = extent[3] = -1e300;
    for (int i = 0; i < 2; i++) {
        bool is_there = i == 0 ? t->present : w->present && w->enabled;
        if (!is_there)
            continue;
        any = true;
        for (int a = 0; a < 2; a++) {
            double middle = i == 0 ? 0 : w->position[a], half = (i == 0 ? t->size[a] : w->size[a]) / 2;
            extent[2 * a] = middle - half < extent[2 * a] ? middle - half : extent[2 * a];
            extent[2 * a + 1] = middle + half > extent[2 * a + 1] ? middle + half : extent[2 * a + 1];
        }
        double bottom = i == 0 ? t->base : w->level, top = i == 0 ? t->base + t->height : w->level;
        *low = bottom < *low ? bottom : *low;
        *high = top > *high ? top : *high;
    }
    return any;
}

/* The part of the ground's plane y = low that light on its way to the ground meets and a cloud's shadow does too. */
static bool find_plane(const struct frame *f, const double to_light[3], double plane[4], double *y)
{
    const struct lom_cloud_set *set = f->renderer->clouds;
    double ground[4], clouds[4] = { 1e300, -1e300, 1e300, -1e300 }, high;
    if (!find_ground(f->scene, ground, y, &high))
        return false;
    lom_box slab = { { ground[0], *y, ground[2] }, { ground[1], high, ground[3] } };
    lom_shadow_extent(slab, *y, to_light, ground);
    for (size_t i = 0; i < set->count; i++) {
        double one[4];
        lom_shadow_extent(lom_cloud_bounds(&set->clouds[i]), *y, to_light, one);
        for (int k = 0; k < 4; k++)
            clouds[k] = (k & 1 ? one[k] > clouds[k] : one[k] < clouds[k]) ? one[k] : clouds[k];
    }
    for (int a = 0; a < 2; a++) {
        double from = ground[2 * a] > clouds[2 * a] ? ground[2 * a] : clouds[2 * a];
        double to = ground[2 * a + 1] < clouds[2 * a + 1] ? ground[2 * a + 1] : clouds[2 * a + 1];
        double margin = (to - from) * 2 / SHADOW_SIZE; /* the border's texels stay clear */
        plane[a] = from - margin;
        plane[2 + a] = to - from + 2 * margin;
        if (!(to > from))
            return false;
    }
    return true;
}

static bool make_shadow_map(lom_renderer *r)
{
    if (r->ground_shadow.texture == NULL)
        r->ground_shadow.texture =
            lom_make_texture(r->device, &(lom_texture_desc){ .width = SHADOW_SIZE,
                                                             .height = SHADOW_SIZE,
                                                             .format = LOM_FORMAT_R32F,
                                                             .sampler = { .wrap_s = LOM_WRAP_BORDER,
                                                                          .wrap_t = LOM_WRAP_BORDER,
                                                                          .border = { 1, 1, 1, 1 } } });
    return r->ground_shadow.texture != NULL;
}

/* Coordinates of a place: down the light to the plane, then over the map. */
static void set_rows(struct lom_ground_shadow *shadow, const double plane[4], double y, const double to_light[3])
{
    for (int a = 0; a < 2; a++) {
        double *row = a == 0 ? shadow->s : shadow->t;
        double slope = to_light[2 * a] / to_light[1];
        row[0] = a == 0 ? 1 / plane[2] : 0;
        row[1] = -slope / plane[2 + a];
        row[2] = a == 1 ? 1 / plane[3] : 0;
        row[3] = (slope * y - plane[a]) / plane[2 + a];
    }
}

static uint64_t hash_places(const struct lom_cloud_set *set, const double plane[4], const double to_light[3])
{
    uint64_t hash = lom_hash_bytes(LOM_HASH_START, to_light, 3 * sizeof *to_light);
    hash = lom_hash_bytes(hash, plane, 4 * sizeof *plane);
    for (size_t i = 0; i < set->count; i++)
        hash = lom_hash_bytes(hash, &set->clouds[i].middle, sizeof set->clouds[i].middle);
    return hash;
}

static bool draw_ground_shadow(struct frame *f, const double to_light[3])
{
    lom_renderer *r = f->renderer;
    struct lom_ground_shadow *shadow = &r->ground_shadow;
    double plane[4], y;
    shadow->falls = false;
    if (!f->scene->clouds.shadows || to_light[1] < lowest_sun || !find_plane(f, to_light, plane, &y)) {
        lom_add_step(f, "cloud shadow", false, "%s",
                     !f->scene->clouds.shadows ? "clouds.shadows is off"
                                               : "no cloud's shadow falls on ground or water");
        return true;
    }
    if (!make_shadow_map(r))
        return false;
    shadow->falls = true;
    set_rows(shadow, plane, y, to_light);
    uint64_t hash = hash_places(r->clouds, plane, to_light);
    if (shadow->made_for == hash) {
        lom_add_step(f, "cloud shadow", false, "neither the sun nor a cloud has moved");
        return true;
    }
    lom_step *step = lom_add_step(f, "cloud shadow", true, "what clouds let through of the sun, over %.0f x %.0f m",
                                  plane[2], plane[3]);
    step->width = step->height = SHADOW_SIZE;
    lom_begin_pass(r->device, &(lom_pass_desc){ .color = { shadow->texture }, .clear_color = { { 1, 1, 1, 1 } } });
    for (size_t i = 0; i < r->clouds->count; i++)
        lom_draw_cloud_shadow(r->device, r->clouds, &r->clouds->clouds[i], plane, y, to_light);
    if (!lom_end_pass(r->device))
        return false;
    shadow->made_for = hash;
    return true;
}

bool lom_prepare_clouds(struct frame *f, lom_error *error)
{
    const lom_vec3 direction = f->scene->light.direction;
    const double to_light[3] = { -direction.x, -direction.y, -direction.z };
    int swept = 0;
    if (f->renderer->clouds == NULL)
        return true;
    lom_move_clouds(f->renderer->clouds, f->time);
    if (!lom_evolve_clouds(f->renderer->clouds, f->time, error) || !lom_begin_impostors(f, error))
        return false;
    if (f->scene->quality.impostors != LOM_IMPOSTORS_OFF)
        return draw_ground_shadow(f, to_light); /* plates light their clouds when they are made */
    if (!lom_light_clouds(f->renderer->clouds, to_light, &swept, error))
        return false;
    if (swept != 0)
        lom_add_step(f, "cloud light", true, "%d grids of light swept from the sun through %zu clouds", swept,
                     f->renderer->clouds->count);
    else
        lom_add_step(f, "cloud light", false, "neither the sun nor a cloud has moved");
    return draw_ground_shadow(f, to_light);
}

bool lom_draw_clouds(struct frame *f, const struct lom_scene_view *view, lom_pass_desc pass, lom_texture *depth,
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
    if (f->scene->quality.impostors != LOM_IMPOSTORS_OFF)
        return lom_draw_impostors(f, view, &seen, &pass, count, error);
    size_t *order = lom_allocate(r->clouds->count, sizeof *order, error);
    if (order == NULL)
        return false;
    *count = lom_order_clouds(r->clouds, &seen, f->scene->quality.impostor.culling, order);
    if (*count != 0) {
        lom_begin_pass(r->device, &pass);
        for (size_t i = 0; i < *count; i++)
            lom_draw_placed_cloud(r->device, r->clouds, &r->clouds->clouds[order[i]], &seen);
        lom_end_pass(r->device);
    }
    lom_release(order);
    return lom_check_device(r->device, error);
}

static lom_step *add_cloud_step(struct frame *f, size_t count, const lom_impostor_counters *before)
{
    const lom_impostor_counters *now = f->impostors;
    size_t all = f->renderer->clouds->count;
    if (count == 0)
        return lom_add_step(f, "clouds", false, "none of %zu clouds is in view", all);
    if (f->scene->quality.impostors == LOM_IMPOSTORS_OFF)
        return lom_add_step(f, "clouds", true, "%zu of %zu clouds are in view; each is marched, the farthest first",
                            count, all);
    const char *split = now->split != before->split ? "; one is cut in two around the aircraft" : "";
    if (!f->renderer->impostors.continues)
        return lom_add_step(f, "clouds", true,
                            "%zu of %zu clouds are in view; no frame of a run before this one: each is drawn afresh on "
                            "its plate%s",
                            count, all, split);
    return lom_add_step(f, "clouds", true,
                        "%zu of %zu clouds are in view; %d plates made anew, %d shown again, %d grids of light swept%s",
                        count, all, now->refreshed - before->refreshed, now->reused - before->reused,
                        f->renderer->impostors.swept, split);
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
    lom_impostor_counters before = *f->impostors;
    size_t count;
    if (!lom_draw_clouds(f, &f->view, lom_frame_pass(f, r->color), r->depth, &count, error))
        return false;
    lom_step *step = add_cloud_step(f, count, &before);
    if (count != 0)
        add_capped(r->clouds, step);
    step->width = f->crop.width;
    step->height = f->crop.height;
    return true;
}
