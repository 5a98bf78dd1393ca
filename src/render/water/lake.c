/* The planar lake of a frame. In: the frame whose opaque scene is drawn. Out: the water over it.
 *
 *   visibility (where is water?) -> reflection, refraction (only there) -> water over the scene
 *
 * Invariant: a pass that is left out, or cut by a scissor, changes no byte of the picture. */
#include "render/seen.h"
#include "render/water/passes.h"
#include "water/lake.h"

static lom_lake_view lake_view(const struct frame *f)
{
    const lom_renderer *r = f->renderer;
    lom_mat4 clip_from_offset = lom_clip_from_offset(&f->view.projection, &f->view.view);
    return (lom_lake_view){ .clip_from_offset = lom_round_matrix(&clip_from_offset),
                            .eye = f->view.eye,
                            .rays = lom_find_eye(&f->view.projection, &f->view.view, 0),
                            .time = f->time,
                            .frame_width = f->width,
                            .frame_height = f->height,
                            .light = lom_renderer_light(r, f->view.eye),
                            .entity_shadow = lom_sun_shadow_of(r, f->view.eye),
                            .normal_map = r->water->normal_map,
                            .flow_map = r->water->flow_map };
}

static bool draw_visibility(struct frame *f)
{
    lom_renderer *r = f->renderer;
    lom_lake_view v = lake_view(f);
    lom_step *step = lom_add_step(f, "visibility", true, "which pixels show the water's surface");
    step->width = f->crop.width;
    step->height = f->crop.height;
    lom_pass_desc pass = lom_frame_pass(f, r->targets.of[LOM_TARGET_MASK]);
    pass.depth_load = LOM_LOAD_KEEP;
    pass.label = "visibility";
    struct lom_lake_uniforms uniforms;
    const lom_draw_desc draw = lom_lake_draw(&lom_lake_mask_shader, &f->scene->water, &v, &uniforms);
    if (!lom_draw_pass(r->device, &pass, &draw, 1))
        return false;
    lom_find_water(f);
    return true;
}

/* A picture of the scene in the water's colour, where lookups from the visible water can reach. */
static bool draw_picture(struct frame *f, lom_step *step, lom_texture *color, lom_texture *depth,
                         const struct lom_scene_view *view, lom_error *error)
{
    const lom_water_params *water = &f->scene->water;
    int width = lom_texture_width(color), height = lom_texture_height(color);
    float clear[4] = { (float)water->color[0], (float)water->color[1], (float)water->color[2], 1 };
    lom_rect all = { 0, 0, width, height };
    double reach = water->flow ? water->flow_strength : 0;
    return lom_draw_picture(f, step, color, depth, view, clear,
                            water->projection ? lom_water_reach(f, &lom_whole_view, reach, width, height) : all,
                            !view->mirrored, error);
}

/* Step 1: the view times a mirror in the plane; nothing below the plane (less the offset). */
static bool draw_reflection(struct frame *f, lom_error *error)
{
    const lom_water_params *water = &f->scene->water;
    struct lom_scene_view view = f->view;
    lom_mat4 mirror = lom_mirror((lom_vec3){ 0, 1, 0 }, water->level);
    if (!water->reflection) {
        lom_add_step(f, "reflection", false, "water.reflection is off");
        return true;
    }
    view.view = lom_multiply(&f->view.view, &mirror);
    view.eye.y = 2 * water->level - f->view.eye.y;
    view.mirrored = true;
    view.pixels = f->scene->quality.reflection_scale;
    view.plane[0] = view.plane[2] = 0;
    view.plane[1] = 1;
    view.plane[3] = water->clip_offset - water->level;
    lom_step *step = lom_add_step(f, "reflection", true,
                                  "terrain, entities, liquids and sky above the water, mirrored in its plane");
    return draw_picture(f, step, f->renderer->targets.of[LOM_TARGET_REFLECTION],
                        f->renderer->targets.of[LOM_TARGET_REFLECTION_DEPTH], &view, error);
}

/* Step 2: the scene below the plane (plus the offset), with its depth. */
static bool draw_refraction(struct frame *f, lom_error *error)
{
    const lom_water_params *water = &f->scene->water;
    struct lom_scene_view view = f->view;
    if (!water->refraction && !water->soft_shore && !water->specular) {
        lom_add_step(f, "refraction", false, "water.refraction and everything that reads its depth are off");
        return true;
    }
    view.plane[0] = view.plane[2] = 0;
    view.pixels = f->scene->quality.refraction_scale;
    view.plane[1] = -1;
    view.plane[3] = water->level + water->clip_offset;
    view.sky = false;
    lom_step *step =
        lom_add_step(f, "refraction", true, "terrain, entities and liquids below the water, with their depth");
    return draw_picture(f, step, f->renderer->targets.of[LOM_TARGET_REFRACTION],
                        f->renderer->targets.of[LOM_TARGET_REFRACTION_DEPTH], &view, error);
}

/* The surface by the shader of its model. */
static bool draw_quad(struct frame *f, const lom_lake_view *view, lom_error *error)
{
    const struct lom_water_model_row *model = &lom_water_models[f->scene->quality.water];
    struct lom_lake_uniforms uniforms;
    const lom_draw_desc draw = lom_lake_draw(model->shader, &f->scene->water, view, &uniforms);
    return lom_draw_over_scene(f, model->text, &draw, error);
}

static bool draw_surface(struct frame *f, lom_error *error)
{
    lom_renderer *r = f->renderer;
    const lom_water_params *water = &f->scene->water;
    lom_lake_view view = lake_view(f);
    bool below = water->refraction || water->soft_shore || water->specular;
    view.reflection = water->reflection ? r->targets.of[LOM_TARGET_REFLECTION] : NULL;
    view.refraction = below ? r->targets.of[LOM_TARGET_REFRACTION] : NULL;
    view.refraction_depth = below ? r->targets.of[LOM_TARGET_REFRACTION_DEPTH] : NULL;
    return draw_quad(f, &view, error);
}

/* The cheapest model: a blended quad of one colour. */
static bool draw_tinted(struct frame *f, lom_error *error)
{
    lom_lake_view view = lake_view(f);
    lom_add_step(f, "reflection", false, "tinted water reflects nothing");
    lom_add_step(f, "refraction", false, "tinted water is blended over the scene");
    return draw_quad(f, &view, error);
}

bool lom_draw_lake(struct frame *f, lom_error *error)
{
    const lom_water_params *water = &f->scene->water;
    const struct lom_water_model_row *model = &lom_water_models[f->scene->quality.water];
    if (!water->present)
        return lom_skip_water(f, "the scene has no water");
    if (!water->enabled)
        return lom_skip_water(f, "water.enabled is false");
    if (model->has_waves)
        return true;
    if (!lom_may_show_water(f))
        return lom_skip_water(f, "the water's quad is outside the view");
    if (!model->is_looked_up)
        return draw_tinted(f, error);
    if (!draw_visibility(f))
        return false;
    if (f->water.width == 0)
        return lom_skip_water(f, "the scene hides all of the water");
    return draw_reflection(f, error) && draw_refraction(f, error) && draw_surface(f, error);
}
