/* The shadows of clouds, before the scene is drawn. In: the clouds in their places, the sun. Out: a map of what they let
 * through of the sun to the ground and the water. Invariant: it follows from the whole scene. */
#include "render/frame.h"

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
    const struct lom_cloud_set *set = f->renderer->clouds.set;
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
    if (r->clouds.ground_shadow.texture == NULL)
        r->clouds.ground_shadow.texture =
            lom_make_texture(r->device, &(lom_texture_desc){ .width = SHADOW_SIZE,
                                                             .height = SHADOW_SIZE,
                                                             .label = "cloud shadow",
                                                             .format = LOM_FORMAT_R32F,
                                                             .sampler = { .wrap_s = LOM_WRAP_BORDER,
                                                                          .wrap_t = LOM_WRAP_BORDER,
                                                                          .border = { 1, 1, 1, 1 } } });
    return r->clouds.ground_shadow.texture != NULL;
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

/* All of which the map follows that is not the same in every frame: the sun, the plane, the noise that eats into clouds. */
static uint64_t hash_places(const struct lom_cloud_set *set, const double plane[4], const double to_light[3])
{
    uint64_t hash = lom_hash_bytes(LOM_HASH_START, to_light, 3 * sizeof *to_light);
    hash = lom_hash_bytes(hash, plane, 4 * sizeof *plane);
    hash = lom_hash_bytes(hash, &set->phase, sizeof set->phase);
    for (size_t i = 0; i < set->count; i++)
        hash = lom_hash_bytes(hash, &set->clouds[i].middle, sizeof set->clouds[i].middle);
    return hash;
}

bool lom_draw_cloud_shadows(struct frame *f, const double to_light[3])
{
    lom_renderer *r = f->renderer;
    struct lom_ground_shadow *shadow = &r->clouds.ground_shadow;
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
    uint64_t hash = hash_places(r->clouds.set, plane, to_light);
    if (shadow->made_for == hash) {
        lom_add_step(f, "cloud shadow", false, "neither the sun nor a cloud has moved or changed");
        return true;
    }
    lom_step *step = lom_add_step(f, "cloud shadow", true, "what clouds let through of the sun, over %.0f x %.0f m",
                                  plane[2], plane[3]);
    step->width = step->height = SHADOW_SIZE;
    lom_begin_pass(
        r->device,
        &(lom_pass_desc){ .color = { shadow->texture }, .clear_color = { { 1, 1, 1, 1 } }, .label = "cloud shadow" });
    for (size_t i = 0; i < r->clouds.set->count; i++)
        lom_draw_cloud_shadow(r->device, r->clouds.set, &r->clouds.set->clouds[i], plane, y, to_light);
    if (!lom_end_pass(r->device))
        return false;
    shadow->made_for = hash;
    return true;
}

void lom_set_cloud_light(struct lom_light_uniform *light, const lom_renderer *renderer, lom_vec3 eye)
{
    const struct lom_ground_shadow *shadow = &renderer->clouds.ground_shadow;
    if (!shadow->falls)
        return;
    light->shadow = shadow->texture;
    light->shadow_strength = (float)renderer->scene->clouds.shadow_strength;
    lom_center_row(light->shadow_s, shadow->s, eye);
    lom_center_row(light->shadow_t, shadow->t, eye);
}
