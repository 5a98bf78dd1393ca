/* What the water models of a frame share. */
#ifndef LOM_RENDER_WATER_PASSES_H
#define LOM_RENDER_WATER_PASSES_H

#include "render/frame.h"
#include "water/water_models.h"

extern const struct lom_window lom_whole_view;

/* The stages of the water that is looked at (water.h has them of all). */
bool lom_prepare_water(struct frame *f, lom_error *error);
bool lom_draw_lake(struct frame *f, lom_error *error);
bool lom_find_surface(struct frame *f, lom_error *error);
bool lom_draw_surface(struct frame *f, lom_error *error);
/* Sets f->water to the smallest rectangle of frame pixels in which the renderer's mask is not 0; width 0: there
 * is none. */
void lom_find_water(struct frame *f);
/* The part of a picture of the scene (scaled to width x height) that lookups from the visible water can reach: `reach`
 * parts of the picture away, and a texel of filtering. The whole picture when quality.scissor is off. */
lom_rect lom_water_reach(const struct frame *f, const struct lom_window *window, double reach, int width, int height);
/* Draws the scene into a picture of its own; `is_shown`: the frame shows the same scene, so that what lies inside the
 * view's plane there need not be drawn again. */
bool lom_draw_picture(struct frame *f, lom_step *step, lom_texture *color, lom_texture *depth,
                      const struct lom_scene_view *view, const float clear[4], lom_rect scissor, bool is_shown,
                      lom_error *error);
/* Makes the caustics of f->waves and points f->view at them; or says in the plan why there are none. */
bool lom_draw_caustics(struct frame *f, lom_error *error);
/* Adds "left out" to the plan for every pass of the water, for this reason. True. */
bool lom_skip_water(struct frame *f, const char *reason);
/* Draws the surface over the finished scene, where water is seen: a step of the plan with this text. */
bool lom_draw_over_scene(struct frame *f, const char *text, const lom_draw_desc *surface, lom_error *error);

/* frame_waves.c: whether the scene's water has waves; of a sea its places, then the rest of it, with a step of the
 * plan. False: the error says why. */
bool lom_has_waves(const struct frame *f);
bool lom_place_frame_waves(struct frame *f, lom_error *error);
bool lom_fill_frame_waves(struct frame *f, lom_error *error);
/* The plan's steps of the waves that report at this stage; with a reason, why no water is drawn. */
void lom_report_frame_waves(struct frame *f, enum lom_wave_stage stage, const char *why);

#endif
