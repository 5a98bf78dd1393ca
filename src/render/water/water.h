/* Water as it is drawn. */
#ifndef LOM_RENDER_WATER_WATER_H
#define LOM_RENDER_WATER_WATER_H

#include "water/caustics.h"
#include "water/surface.h"
#include "waves/wave_field.h"

#include <lom/render.h>

struct frame;

struct lom_drawn_water {
    lom_texture *normal_map, *flow_map;
    lom_texture *foam; /* its pattern, or NULL */
    lom_texture *bed;  /* heights of the terrain, a texel a vertex, for caustics; or NULL */

    struct lom_wave_site site;    /* to far: of the waves (rooms.c) */
    struct lom_wave_field *waves; /* or NULL */
    struct lom_polar_mesh polar;  /* of displaced water */
    struct lom_near_blocks near;  /* of the picture of what is above it, made by frames */
    struct lom_far_rows far;      /* of the picture of what is below it, likewise */

    lom_texture *photons, *caustics; /* made by frames */
    struct lom_gathered_light light; /* what becomes of the photons */

    uint64_t
        mirrored; /* of a frame that is watched: the first pass of what it mirrors; UINT64_MAX: it mirrors nothing */
};

/* Its maps; the pattern of its foam; its bed; its waves, which may carry the maps. */
bool lom_load_water_maps(lom_renderer *renderer, lom_error *error);
bool lom_load_foam(lom_renderer *renderer, lom_error *error);
bool lom_load_bed(lom_renderer *renderer, lom_error *error);
bool lom_load_waves(lom_renderer *renderer, lom_error *error);
void lom_free_water_maps(lom_renderer *renderer);
void lom_free_foam(lom_renderer *renderer);
void lom_free_bed(lom_renderer *renderer);
void lom_free_waves(lom_renderer *renderer);
/* The targets of caustics are made anew by the next frame. */
void lom_drop_caustics(lom_renderer *renderer);
/* The waves of the renderer's world, which now has another scene with the same waves. */
void lom_follow_water(lom_renderer *renderer);

/* Whether a scene has the one or the other to load. */
bool lom_shows_waves(const lom_scene *scene);
bool lom_shows_foam(const lom_scene *scene);
bool lom_shows_caustics(const lom_scene *scene);

/* Whether the scene's pass leaves out what water will cover; and its depth into that pass, which has begun. */
bool lom_hides_below(const struct frame *f);
void lom_draw_lid(const struct frame *f);
/* waters.c: the scene's waters, each in turn, the farthest first. Looks at one of them: its keys are those of
 * f->scene->water, and what the frame knows of it is in f. */
void lom_turn_to_water(struct frame *f, size_t number);
/* Makes their waves, and what they do to the light on what is drawn after them. */
bool lom_prepare_waters(struct frame *f, lom_error *error);
/* Draw tinted or planar water over the scene; or find where the scene leaves water with waves to be seen, and draw it
 * there. */
bool lom_draw_lakes(struct frame *f, lom_error *error);
bool lom_find_surfaces(struct frame *f, lom_error *error);
bool lom_draw_surfaces(struct frame *f, lom_error *error);
/* Whether a water of the scene shows the sun's light, as glints or on foam, so that a shadow can be seen on it; and where
 * its surface may be. */
bool lom_water_shows_sun(const struct frame *f, size_t number, lom_box *where);
/* All that waters beside the first load and free. */
bool lom_load_other_waters(lom_renderer *renderer, lom_error *error);
void lom_free_other_waters(lom_renderer *renderer);

#endif
