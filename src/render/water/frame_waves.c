/* The waves of a frame, before the scene is drawn. In: a frame. Out: its waves, and whether the eye is below them.
 * Invariant: of a sea no more is made than the picture can show. */
#include "render/water/passes.h"

bool lom_has_waves(const struct frame *f)
{
    const lom_water_params *water = &f->scene->water;
    return water->present && water->enabled && lom_water_models[f->scene->quality.water].has_waves;
}

/* Whether the eye is below the surface, where it is over or under the quad; a sea that has no places may be anywhere
 * within its bounds. */
static bool is_below(const struct frame *f)
{
    const lom_water_params *water = &f->scene->water;
    const lom_vec3 *eye = &f->view.eye;
    double x = eye->x - water->position[0], z = eye->z - water->position[1], level = water->level;
    if ((x < 0 ? -x : x) > water->size[0] / 2 || (z < 0 ? -z : z) > water->size[1] / 2)
        return false;
    if (lom_water_models[f->scene->quality.water].form != LOM_SURFACE_QUAD)
        level += f->known != LOM_WAVES_BOUNDED ? lom_wave_height(f->renderer->water->waves, &f->waves, eye->x, eye->z)
                                               : (double)f->waves.highest;
    return eye->y < level;
}

/* Only a mesh can overturn: what has one height over each place shows waves that spill. */
static void keep_upright(struct frame *f)
{
    if (lom_water_models[f->scene->quality.water].form != LOM_SURFACE_MESH)
        f->waves.surf.curls[0] = f->waves.surf.curls[1] = NULL;
}

bool lom_place_frame_waves(struct frame *f, lom_error *error)
{
    f->known = LOM_WAVES_PLACED;
    if (!lom_place_waves(f->renderer->water->waves, &f->waves, f->view.eye, f->time, error))
        return false;
    keep_upright(f);
    return true;
}

void lom_report_frame_waves(struct frame *f, enum lom_wave_stage stage, const char *why)
{
    const struct lom_wave_moment moment = { f->known, f->wave_steps, why };
    struct lom_wave_report report;
    const char *step;
    for (int kind = 0; lom_report_waves(f->renderer->water->waves, kind, stage, &moment, &step, &report); kind++)
        if (report.says)
            lom_add_step(f, step, report.runs, "%s", report.text);
}

bool lom_fill_frame_waves(struct frame *f, lom_error *error)
{
    lom_report_frame_waves(f, LOM_WAVES_AT_FILLING, NULL);
    f->known = LOM_WAVES_FILLED;
    return lom_fill_waves(f->renderer->water->waves, &f->waves, f->time, error);
}

/* An eye that is above all that waves could be needs them where they are drawn, if they are. */
bool lom_prepare_water(struct frame *f, lom_error *error)
{
    if (!lom_has_waves(f))
        return true;
    lom_report_frame_waves(f, LOM_WAVES_AT_FIRST, NULL);
    lom_bound_waves(f->renderer->water->waves, &f->waves, f->view.eye, f->time);
    keep_upright(f);
    if (lom_waves_advance(f->renderer->water->waves) && !is_below(f))
        return true;
    if (!lom_place_frame_waves(f, error))
        return false;
    f->below = is_below(f);
    if (f->below && !lom_fill_frame_waves(f, error))
        return false;
    return !f->below || lom_draw_caustics(f, error);
}
