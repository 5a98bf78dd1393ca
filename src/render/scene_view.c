/* The scene itself in a pass. In: how the pass looks at it. Out: draws of terrain blocks, entities and sky; what lies
 * outside the view or wholly behind the clip plane is left out, which changes no pixel. Compiled for speed. */
#include "base/numbers.h"
#include "render/renderer.h"
#include "scene/scene_light.h"

struct lom_light_uniform lom_scene_light(const lom_scene *scene)
{
    const lom_light *light = &scene->light;
    const lom_vec3 to_light = lom_to_light(light);
    struct lom_light_uniform u = { .to_light = { (float)to_light.x, (float)to_light.y, (float)to_light.z } };
    for (int i = 0; i < 3; i++) {
        u.color[i] = (float)(light->color[i] * light->intensity);
        u.ambient[i] = (float)light->ambient[i];
        u.ground[i] = (float)light->ground[i];
    }
    return u;
}

/* The antiderivative of the haze's profile (shading/haze.h). */
static double haze_integral(const lom_haze *haze, double y)
{
    double above = y > haze->base ? y - haze->base : 0;
    return y <= haze->base ? y - haze->base : -haze->height * lom_double_expm1(-above / haze->height);
}

struct lom_haze_uniform lom_scene_haze(const lom_scene *scene, double eye_height, bool mirrored)
{
    const lom_haze *haze = &scene->haze;
    struct lom_haze_uniform u = { .glow_exponent = (float)haze->glow_exponent,
                                  .base = (float)(haze->base - eye_height) };
    if (!haze->present)
        return u;
    for (int i = 0; i < 3; i++) {
        u.density[i] = (float)haze->density[i];
        u.color[i] = (float)haze->color[i];
        u.glow[i] = (float)haze->glow[i];
        u.on |= u.density[i] > 0;
    }
    u.mirrored = mirrored;
    u.mirror = (float)(scene->water.level - eye_height);
    u.gray = u.density[0] == u.density[1] && u.density[1] == u.density[2];
    if (haze->height > 0) {
        double mirror = scene->water.level;
        u.height = (float)haze->height;
        u.inverse_height = (float)(1 / haze->height);
        u.start = (float)(mirrored ? 2 * haze_integral(haze, mirror) - haze_integral(haze, 2 * mirror - eye_height)
                                   : haze_integral(haze, eye_height));
    }
    return u;
}

/* The row of a matrix for offsets that is `row` for places. */
void lom_center_row(float out[4], const double row[4], lom_vec3 eye)
{
    for (int i = 0; i < 3; i++)
        out[i] = (float)row[i];
    out[3] = (float)(row[3] + row[0] * eye.x + row[1] * eye.y + row[2] * eye.z);
}

struct lom_light_uniform lom_renderer_light(const lom_renderer *renderer, lom_vec3 eye)
{
    struct lom_light_uniform u = lom_scene_light(renderer->scene);
    lom_set_lamps(&u, renderer, eye);
    lom_set_ground_light(&u, renderer, eye);
    lom_set_cloud_light(&u, renderer, eye);
    return u;
}

lom_vec3 lom_middle_on_level(const struct lom_scene_view *view, double level)
{
    const lom_vec3 along = lom_find_view_rays(&view->projection, &view->view).along;
    double way = lom_magnitude(along.y) > 1e-3 ? (level - view->eye.y) / along.y : 0;
    return lom_vec3_add(view->eye, lom_vec3_scale(along, way > 0 ? way : 0));
}

lom_mat4 lom_clip_from_offset(const lom_mat4 *projection, const lom_mat4 *view)
{
    lom_mat4 turned = *view;
    for (int i = 0; i < 3; i++)
        turned.m[i][3] = 0;
    return lom_multiply(projection, &turned);
}

lom_visibility lom_plane_visibility(const struct lom_culler *culler, const lom_box *box)
{
    const double *plane = culler->plane;
    const lom_vec3 eye = culler->eye;
    const double low[3] = { box->low.x, box->low.y, box->low.z }, high[3] = { box->high.x, box->high.y, box->high.z };
    const double from[3] = { eye.x, eye.y, eye.z };
    double value = plane[3];
    for (int i = 0; i < 3; i++)
        value += plane[i] * from[i];
    double highest = value, lowest = value, size = lom_magnitude(value);
    for (int i = 0; i < 3; i++) {
        const bool up = plane[i] > 0;
        const double most = plane[i] * ((up ? high[i] : low[i]) - from[i]);
        highest += most;
        lowest += plane[i] * ((up ? low[i] : high[i]) - from[i]);
        size += lom_magnitude(most);
    }
    return highest < -0x1p-20 * size ? LOM_OUTSIDE : lowest >= 0 ? LOM_INSIDE : LOM_CROSSING;
}

bool lom_is_visible(const struct lom_culler *culler, const lom_box *box)
{
    return lom_box_visibility(&culler->frustum, *box) != LOM_OUTSIDE &&
           lom_plane_visibility(culler, box) != LOM_OUTSIDE;
}

static struct lom_caustics_uniform caustics_uniform(const struct lom_caustics *caustics, lom_vec3 eye)
{
    if (caustics->map == NULL)
        return (struct lom_caustics_uniform){ .map = NULL };
    return (struct lom_caustics_uniform){ .map = caustics->map,
                                          .corner = { (float)(caustics->corner[0] - eye.x),
                                                      (float)(caustics->corner[1] - eye.z) },
                                          .scale = (float)(1 / caustics->size),
                                          .level = (float)(caustics->level - eye.y),
                                          .strength = (float)caustics->strength,
                                          .fade = (float)(1 / caustics->fade),
                                          .lod_scale = (float)caustics->lod_scale };
}

static struct lom_reflection_uniform reflection_uniform(const lom_quality *quality)
{
    static const int models[] = { [LOM_REFLECTION_PHONG] = LOM_MODEL_PHONG,
                                  [LOM_REFLECTION_BLINN_PHONG] = LOM_MODEL_BLINN_PHONG,
                                  [LOM_REFLECTION_TOON] = LOM_MODEL_TOON };
    struct lom_reflection_uniform u = { .model = models[quality->reflection] };
    for (int i = 0; i < LOM_TONES; i++) {
        u.threshold[i] = (float)quality->toon_thresholds[i];
        u.tone[i] = (float)quality->toon_tones[i];
    }
    return u;
}

struct lom_sun_shadow_uniform lom_sun_shadow_of(const lom_renderer *renderer, lom_vec3 eye)
{
    struct lom_sun_shadow_uniform u = lom_entity_shadow_uniform(&renderer->entities, eye);
    lom_set_fluid_shadow(&u, renderer, eye);
    return u;
}

struct lom_view_uniform lom_view_uniform_of(const lom_renderer *renderer, const struct lom_scene_view *view)
{
    lom_mat4 clip_from_offset = lom_clip_from_offset(&view->projection, &view->view);
    struct lom_view_uniform u = { .clip_from_offset = lom_round_matrix(&clip_from_offset),
                                  .eye = lom_find_eye(&view->projection, &view->view, 0),
                                  .light = lom_renderer_light(renderer, view->eye),
                                  .haze = lom_scene_haze(renderer->scene, view->eye.y, view->mirrored),
                                  .reflection = reflection_uniform(&renderer->scene->quality),
                                  .caustics = caustics_uniform(&view->caustics, view->eye) };
    u.entity_shadow = lom_sun_shadow_of(renderer, view->eye);
    lom_center_row(u.plane, view->plane, view->eye);
    return u;
}

struct lom_window lom_window_of(const lom_rect *part, int width, int height)
{
    const int first[2] = { part->x, height - part->y - part->height }, count[2] = { part->width, part->height };
    const int size[2] = { width, height };
    struct lom_window window;
    for (int i = 0; i < 2; i++) {
        window.low[i] = 2.0 * (first[i] - 1) / size[i] - 1;
        window.high[i] = 2.0 * (first[i] + count[i] + 1) / size[i] - 1;
    }
    return window;
}

lom_mat4 lom_zoom_to(const struct lom_window *window, const lom_mat4 *projection)
{
    lom_mat4 zoom = lom_identity();
    for (int i = 0; i < 2; i++) {
        zoom.m[i][i] = 2 / (window->high[i] - window->low[i]);
        zoom.m[i][3] = -(window->high[i] + window->low[i]) / (window->high[i] - window->low[i]);
    }
    return lom_multiply(&zoom, projection);
}

struct lom_culler lom_culler_of(const struct lom_scene_view *view, const struct lom_window *window)
{
    lom_mat4 projection = window != NULL ? lom_zoom_to(window, &view->projection) : view->projection;
    lom_mat4 clip_from_world = lom_multiply(&projection, &view->view);
    return (struct lom_culler){ lom_view_frustum(&clip_from_world, false), view->plane, view->eye };
}

void lom_draw_scene(lom_renderer *renderer, const struct lom_scene_view *view)
{
    struct lom_view_uniform uniform = lom_view_uniform_of(renderer, view);
    struct lom_culler culler = lom_culler_of(view, view->window);
    lom_draw_ground(renderer, view, &culler, &uniform);
    lom_draw_entities(renderer, view, &culler, &uniform);
    if (view->sky)
        lom_draw_sky(renderer, view, &uniform.light);
}

size_t lom_draw_transparent_scene(lom_renderer *renderer, const struct lom_scene_view *view)
{
    struct lom_view_uniform uniform = lom_view_uniform_of(renderer, view);
    struct lom_culler culler = lom_culler_of(view, view->window);
    return lom_draw_transparent_entities(renderer, view, &culler, &uniform);
}

bool lom_shows_transparent(const lom_renderer *renderer, const struct lom_scene_view *view)
{
    struct lom_culler culler = lom_culler_of(view, NULL);
    return lom_count_transparent_entities(renderer, &culler) != 0;
}

bool lom_shows_scene(const lom_renderer *renderer, const struct lom_scene_view *view)
{
    struct lom_culler culler = lom_culler_of(view, NULL);
    return lom_shows_ground(&renderer->ground, &culler) || lom_shows_entities(renderer, &culler) ||
           lom_shows_fluids(renderer, &culler);
}

bool lom_shows_terrain(const lom_renderer *renderer, const struct lom_scene_view *view)
{
    struct lom_culler culler = lom_culler_of(view, NULL);
    return lom_shows_ground(&renderer->ground, &culler);
}
