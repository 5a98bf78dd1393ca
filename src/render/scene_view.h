/* The scene as a pass sees it: what is in view, the light and the air there, and all that is drawn of it. */
#ifndef LOM_RENDER_SCENE_VIEW_H
#define LOM_RENDER_SCENE_VIEW_H

#include "shading/view_uniform.h"

#include <lom/render.h>

/* The light that the water's waves focus on what is below its level, over a square of x and z. */
struct lom_caustics {
    const lom_texture *map; /* NULL: none */
    double corner[2], size, level;
    double strength, fade; /* metres below the level over which they appear */
    double lod_scale;      /* texels of the map a pixel covers, per metre of distance */
};

/* What draws are of, in records. */
enum { LOM_OBJECT_TERRAIN = 1, LOM_OBJECT_WATER = 2, LOM_OBJECT_FLUID = 3, LOM_OBJECT_ENTITY = 16 };

/* A part of a view, in normalised device coordinates: left and bottom, right and top. */
struct lom_window {
    double low[2], high[2];
};

/* How a pass looks at the scene. */
struct lom_scene_view {
    lom_mat4 projection, view;
    const struct lom_window *window; /* what lies outside of it need not be drawn; NULL: all of the view is */
    lom_vec3 eye;
    double plane[4]; /* only what has plane . (p, 1) >= 0; (0, 0, 0, 1): everything */
    bool mirrored;   /* front faces are clockwise */
    bool sky;
    double
        pixels; /* of the pass, a pixel of the picture: what the widths of lines and the sizes of points are scaled by */
    struct lom_caustics caustics;
};

/* What a pass can show of a box. */
struct lom_culler {
    lom_frustum frustum;
    const double *plane; /* of the view */
    lom_vec3 eye;
};
/* window: the part of the view that is drawn; NULL: all of it. */
struct lom_culler lom_culler_of(const struct lom_scene_view *view, const struct lom_window *window);
/* Where a box lies to the clip plane, seen from the eye: behind it by more than floats round, or wholly before it; whether any
 * of it may be in view. */
lom_visibility lom_plane_visibility(const struct lom_culler *culler, const lom_box *box);
bool lom_is_visible(const struct lom_culler *culler, const lom_box *box);

/* What a picture of width x height shows in a part of its pixels, and a pixel around it. */
struct lom_window lom_window_of(const lom_rect *part, int width, int height);
/* Clip coordinates in which the window is what -1..1 was. */
lom_mat4 lom_zoom_to(const struct lom_window *window, const lom_mat4 *projection);
/* Draws terrain, what is opaque of entities, and sky into the pass that has begun; what is outside the view and its window
 * or behind the plane costs nothing. */
void lom_draw_scene(lom_renderer *renderer, const struct lom_scene_view *view);
/* Draws what is transparent of it into a pass that has the rest; of how many entities. Whether it would draw any. */
size_t lom_draw_transparent_scene(lom_renderer *renderer, const struct lom_scene_view *view);
bool lom_shows_transparent(const lom_renderer *renderer, const struct lom_scene_view *view);
/* Whether any of it but the sky would be drawn; whether any of the terrain would. */
bool lom_shows_scene(const lom_renderer *renderer, const struct lom_scene_view *view);
bool lom_shows_terrain(const lom_renderer *renderer, const struct lom_scene_view *view);

/* What every draw of a pass that looks so at the scene shares. */
struct lom_view_uniform lom_view_uniform_of(const lom_renderer *renderer, const struct lom_scene_view *view);

/* What keeps the sun off of places less the eye: entities and liquids. */
struct lom_sun_shadow_uniform lom_sun_shadow_of(const lom_renderer *renderer, lom_vec3 eye);

struct lom_light_uniform lom_scene_light(const lom_scene *scene);
/* The same for places less the eye, with the shadows of clouds and terrain that the frame has made. */
struct lom_light_uniform lom_renderer_light(const lom_renderer *renderer, lom_vec3 eye);
/* The haze for places less an eye at this height; mirrored: the eye below the water's plane from which its reflection
 * is drawn. */
struct lom_haze_uniform lom_scene_haze(const lom_scene *scene, double eye_height, bool mirrored);
/* From places less the eye to clip space: the view's rotation alone, since it takes the eye to 0. */
lom_mat4 lom_clip_from_offset(const lom_mat4 *projection, const lom_mat4 *view);
/* Of parallel rays: where the one through the picture's middle meets a height; where it starts when it goes the other
 * way, or runs along it. */
lom_vec3 lom_middle_on_level(const struct lom_scene_view *view, double level);
/* The row of a matrix for offsets that is `row` for places. */
void lom_center_row(float out[4], const double row[4], lom_vec3 eye);

#endif
