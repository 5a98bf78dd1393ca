/* What a frame may show of the world. In: its view and its water. Out: frusta outside of which nothing is shown. Invariant:
 * they follow from the whole frame, not from a crop. */
#include "render/seen.h"

#include "base/numbers.h"
#include "render/frame.h"
#include "water/water_models.h"

bool lom_may_show_water(const struct frame *f)
{
    const lom_water_params *w = &f->scene->water;
    if (!w->present || !w->enabled || lom_water_models[f->scene->quality.water].has_waves)
        return w->present && w->enabled;
    lom_box box = { { w->position[0] - w->size[0] / 2, w->level, w->position[1] - w->size[1] / 2 },
                    { w->position[0] + w->size[0] / 2, w->level, w->position[1] + w->size[1] / 2 } };
    lom_mat4 clip_from_world = lom_multiply(&f->view.projection, &f->view.view);
    lom_frustum frustum = lom_view_frustum(&clip_from_world, false);
    return lom_box_visibility(&frustum, box) != LOM_OUTSIDE;
}

struct lom_seen lom_find_seen(const struct frame *f)
{
    const lom_water_params *water = &f->scene->water;
    lom_mat4 clip_from_world = lom_multiply(&f->view.projection, &f->view.view);
    struct lom_seen seen = { 1, { lom_view_frustum(&clip_from_world, false) } };
    if (lom_may_show_water(f) || (water->present && water->enabled && f->scene->other_water_count != 0)) {
        lom_mat4 mirror = lom_mirror((lom_vec3){ 0, 1, 0 }, water->level);
        clip_from_world = lom_multiply(&clip_from_world, &mirror);
        seen.frustum[seen.count++] = lom_view_frustum(&clip_from_world, false);
    }
    return seen;
}

bool lom_may_show(const struct lom_seen *seen, lom_box box)
{
    for (int i = 0; i < seen->count; i++)
        if (lom_box_visibility(&seen->frustum[i], box) != LOM_OUTSIDE)
            return true;
    return false;
}

double lom_distance_to_box(lom_vec3 p, lom_box box)
{
    double x = lom_larger(lom_larger(box.low.x - p.x, p.x - box.high.x), 0);
    double y = lom_larger(lom_larger(box.low.y - p.y, p.y - box.high.y), 0);
    double z = lom_larger(lom_larger(box.low.z - p.z, p.z - box.high.z), 0);
    return lom_double_sqrt(x * x + y * y + z * z);
}
