/* Liquids as they are drawn: each with its particles as far as they have been run, and its surface; and what they take
 * of the light behind them. */
#ifndef LOM_RENDER_FLUID_FLUID_H
#define LOM_RENDER_FLUID_FLUID_H

#include "render/scene_view.h"
#include "render/sun_view.h"
#include "world/liquid.h"

struct frame;
enum lom_target;

struct lom_drawn_fluid {
    struct lom_liquid liquid;
    bool ready; /* run to the frame's time */
};

/* What liquids take of the sunlight behind them (shading/liquid_shadow.h). */
struct lom_fluid_shadow {
    lom_texture *map;
    bool falls; /* on something, in this frame */
    struct lom_sun_map at;
};

struct lom_drawn_fluids {
    struct lom_drawn_fluid *items; /* by the scene's number */
    size_t count;
    uint64_t run; /* steps, all together */
    struct lom_fluid_shadow shadow;
};

/* A light as liquids are drawn from it. */
struct lom_fluid_light {
    lom_mat4 clip_from_world;
    bool parallel;
    double along[4]; /* parallel: the way that light has come to a place (x, y, z, 1), metres from anywhere */
    lom_vec3 from;   /* else: where it comes from */
};

bool lom_load_fluids(lom_renderer *renderer, lom_error *error);
void lom_free_fluids(lom_renderer *renderer);
/* Liquids that are drawn; 0 where quality.fluid is off. */
size_t lom_count_fluids(const lom_scene *scene);
/* The basin. */
lom_box lom_fluid_box(const lom_fluid_params *params);
/* Whether one of them would be drawn. */
bool lom_shows_fluids(const lom_renderer *renderer, const struct lom_culler *culler);
/* Pixels of a picture of this height that a bent ray may be off. */
int lom_fluid_reach(int height);

/* Runs a liquid to the frame's time and makes its surface, once a frame, with a step of the plan. */
bool lom_ready_fluid(struct frame *f, size_t number, lom_error *error);

/* A stage: none is ready yet; then the map of what they take of the sunlight, where that may be seen. */
bool lom_prepare_fluids(struct frame *f, lom_error *error);
void lom_drop_fluid_shadow(lom_renderer *renderer);
/* Adds it to the shadows of the sun, for places less the eye. */
void lom_set_fluid_shadow(struct lom_sun_shadow_uniform *u, const lom_renderer *renderer, lom_vec3 eye);
/* A map of size x size texels to draw such shadows in; and a liquid that is ready, drawn into it. */
lom_texture *lom_make_fluid_map(lom_device *device, int size);
bool lom_draw_fluid_map(lom_renderer *renderer, lom_texture *map, const bool *casts,
                        const struct lom_fluid_light *light);

/* A stage: draws them over what is opaque, on this side of the frame's water; and what of them lies beyond it. */
bool lom_draw_fluids(struct frame *f, lom_error *error);
bool lom_draw_fluids_beyond(struct frame *f, lom_error *error);
/* Draws them over a picture that `pass` has drawn, of the same view, with its depth. The targets are of its size: for
 * what is behind a liquid, and for lengths of rays through it. */
bool lom_draw_fluids_over(struct frame *f, const struct lom_scene_view *view, const lom_pass_desc *pass,
                          enum lom_target behind, enum lom_target length, lom_error *error);

#endif
