/* The waves of a frame, before the scene is drawn. In: a frame. Out: its waves, and whether the eye is below them.
 * Invariant: of a sea no more is made than the picture can show. */
#include "render/frame_water.h"

bool lom_has_waves(const struct frame *f)
{
    const lom_water_params *water = &f->scene->water;
    return water->given != 0 && water->enabled && f->scene->quality.water >= LOM_WATER_NORMAL_MAP;
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
    if (f->scene->quality.water != LOM_WATER_NORMAL_MAP)
        level += f->sea != WAVES_BOUNDED ? lom_wave_height(f->renderer, &f->waves, eye->x, eye->z)
                                         : (double)f->waves.highest;
    return eye->y < level;
}

bool lom_place_frame_waves(struct frame *f, lom_error *error)
{
    f->sea = WAVES_PLACED;
    return lom_place_waves(f->renderer, &f->waves, f->time, error);
}

bool lom_fill_frame_waves(struct frame *f, lom_error *error)
{
    const lom_sea *sea = f->renderer->sea;
    int calm = 0, count = sea == NULL ? 0 : lom_describe_sea(sea)->cascade_count;
    for (int i = 0; i < count; i++)
        calm += lom_view_cascade(sea, i).waves == 0;
    if (sea != NULL && calm < count)
        lom_add_step(f, "waves", true, "%d of %d cascades are advanced; %d have no waves", count - calm, count, calm);
    else if (sea != NULL)
        lom_add_step(f, "waves", false, "none of %d cascades has waves", count);
    f->sea = WAVES_FILLED;
    return lom_fill_sea(f->renderer, &f->waves, f->time, error);
}

void lom_report_trochoids(struct frame *f, const char *why)
{
    const lom_water_waves *waves = &f->scene->water.waves;
    lom_trochoid trochoids[LOM_MAX_WAVES];
    lom_trochoid_report report;
    int count = waves->kind == LOM_WAVES_GERSTNER ? lom_make_trochoids(waves, trochoids, &report, NULL) : 0;
    if (count <= 0)
        return;
    if (why != NULL)
        lom_add_step(f, "waves", false, "%s", why);
    else if (report.limited > 0)
        lom_add_step(f, "waves", true,
                     "%d trochoids; their steepness is %.3f, not %.3f: %d are held back, so that none can loop", count,
                     report.steepness, report.asked, report.limited);
    else
        lom_add_step(f, "waves", true, "%d trochoids; their steepness is %.3f, and crests would loop above 1", count,
                     report.steepness);
}

void lom_report_shallow(struct frame *f, const char *why)
{
    const struct lom_shallow_waves *waves = &f->renderer->shallow;
    if (waves->state.first == NULL)
        return;
    if (f->sea == WAVES_BOUNDED)
        lom_add_step(f, "shallow", false, "%s: no step of it is run", why);
    else
        lom_add_step(f, "shallow", true,
                     "%lld steps from the beginning, %llu of them for this frame; %d of %d cells are wet",
                     (long long)lom_view_shallow(waves->state.now).steps,
                     (unsigned long long)(waves->state.run - f->shallow_run), waves->wet,
                     waves->state.columns * waves->state.rows);
}

static void report_surf(struct frame *f)
{
    const struct lom_surf_map *map = &f->renderer->surf;
    const lom_water_surf *surf = &f->scene->surf;
    if (map->cells != NULL && map->breaking_depth > 0)
        lom_add_step(f, "surf", true, "waves of %g m and %g s rise to %.2f m and break from %.2f m of water on",
                     surf->height, surf->period, map->highest, map->breaking_depth);
    else if (map->cells != NULL)
        lom_add_step(f, "surf", true, "waves of %g m and %g s rise to %.2f m; none breaks", surf->height, surf->period,
                     map->highest);
}

/* An eye that is above all that waves could be needs the sea where it is drawn, if it is. */
bool lom_prepare_sea_stage(struct frame *f, lom_error *error)
{
    if (!lom_has_waves(f))
        return true;
    report_surf(f);
    lom_bound_waves(f->renderer, &f->waves, f->time);
    if ((f->renderer->sea != NULL || f->renderer->shallow.state.first != NULL) && !is_below(f))
        return true;
    if (!lom_place_frame_waves(f, error))
        return false;
    f->below = is_below(f);
    if (f->below && !lom_fill_frame_waves(f, error))
        return false;
    return !f->below || lom_draw_caustics(f, error);
}
