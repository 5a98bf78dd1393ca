/* The waters of a scene, each at its level. In: the stages of one water. Out: the same of all, the farthest first.
 *
 * A ray that goes down meets the higher of two levels first, one that goes up the lower: of two waters the one whose level
 * is farther from the eye's is behind the other wherever both are on a ray. No other water is in the pictures that a
 * surface looks up: what it mirrors goes up from its level, where a higher water is met from below, and what it lets
 * through goes down, where a lower one lies under its bed. An eye under water sees no other.
 *
 * Invariant: a scene with one water is drawn as if there were no others. */
#include "base/numbers.h"
#include "render/water/passes.h"

static void look_at(lom_renderer *r, size_t number)
{
    r->water = &r->waters[number];
    r->moment.scene.water = *lom_water_of(r->world->scene, number);
}

/* ---- loading ---- */

static bool load(lom_renderer *r, lom_error *error)
{
    return lom_load_water_maps(r, error) && lom_load_foam(r, error) && lom_load_bed(r, error) &&
           lom_load_waves(r, error);
}

bool lom_load_other_waters(lom_renderer *renderer, lom_error *error)
{
    bool done = true;
    for (size_t i = 1; done && i <= renderer->scene->other_water_count; i++) {
        look_at(renderer, i);
        done = load(renderer, error);
    }
    look_at(renderer, 0);
    return done;
}

void lom_free_other_waters(lom_renderer *renderer)
{
    for (size_t i = 1; i <= LOM_MAX_OTHER_WATERS; i++) {
        renderer->water = &renderer->waters[i];
        lom_free_waves(renderer);
        lom_free_bed(renderer);
        lom_free_foam(renderer);
        lom_free_water_maps(renderer);
    }
    renderer->water = renderer->waters;
}

/* ---- a frame ---- */

bool lom_water_shows_sun(const struct frame *f, size_t number, lom_box *where)
{
    const lom_water_params *water = lom_water_of(f->scene, number);
    const struct lom_water_model_row *model = &lom_water_models[f->scene->quality.water];
    const struct lom_drawn_water *drawn = &f->renderer->waters[number];
    const bool shines =
        model->has_waves ? water->optics.glitter > 0 || drawn->foam != NULL : model->is_looked_up && water->specular;
    struct lom_waves_uniform waves = { .lowest = 0 };
    if (!water->present || !water->enabled || !shines)
        return false;
    if (model->has_waves && drawn->waves != NULL)
        lom_bound_waves(drawn->waves, &waves, f->view.eye, f->time);
    const double low = water->level + (double)waves.lowest, high = water->level + (double)waves.highest;
    const double *middle = water->position, *size = water->size;
    *where = (lom_box){ { middle[0] - size[0] / 2, low, middle[1] - size[1] / 2 },
                        { middle[0] + size[0] / 2, high, middle[1] + size[1] / 2 } };
    return true;
}

void lom_turn_to_water(struct frame *f, size_t number)
{
    if (number == f->turned)
        return;
    f->turns[f->turned] = (struct frame_water){ f->water, f->waves, f->known, f->view.caustics, f->below };
    look_at(f->renderer, number);
    const struct frame_water *at = &f->turns[number];
    f->water = at->seen;
    f->waves = at->waves;
    f->known = at->known;
    f->view.caustics = at->caustics;
    f->below = at->below;
    f->turned = number;
}

static double away(const struct frame *f, size_t number)
{
    return lom_magnitude(lom_water_of(f->scene, number)->level - f->view.eye.y);
}

/* By insertion: equally far ones stay in the scene's order. */
static void order_waters(struct frame *f)
{
    for (size_t i = 0; i <= f->scene->other_water_count; i++) {
        size_t at = i;
        for (; at > 0 && away(f, f->water_order[at - 1]) < away(f, i); at--)
            f->water_order[at] = f->water_order[at - 1];
        f->water_order[at] = i;
    }
}

static bool each_water(struct frame *f, bool (*run)(struct frame *f, lom_error *error), lom_error *error)
{
    const size_t count = f->scene->other_water_count + 1;
    bool done = true;
    f->names_water = count > 1;
    for (size_t i = 0; done && i < count; i++) {
        lom_turn_to_water(f, f->water_order[i]);
        done = run(f, error);
    }
    f->names_water = false;
    lom_turn_to_water(f, f->home);
    return done;
}

static bool prepare(struct frame *f, lom_error *error)
{
    const bool done = lom_prepare_water(f, error);
    f->home = f->below ? f->turned : f->home;
    return done;
}

bool lom_prepare_waters(struct frame *f, lom_error *error)
{
    order_waters(f);
    for (size_t i = 0; i <= LOM_MAX_OTHER_WATERS; i++)
        f->renderer->waters[i].mirrored = UINT64_MAX;
    return each_water(f, prepare, error);
}

/* Whether the eye is under another water than the one that is looked at. */
static bool is_out_of_sight(const struct frame *f)
{
    return f->turned != f->home && (f->turns[f->home].below);
}

static bool draw_lake(struct frame *f, lom_error *error)
{
    return is_out_of_sight(f) ? lom_skip_water(f, "the eye is under another water") : lom_draw_lake(f, error);
}

static bool find_surface(struct frame *f, lom_error *error)
{
    return is_out_of_sight(f) || lom_find_surface(f, error);
}

static bool draw_surface(struct frame *f, lom_error *error)
{
    return is_out_of_sight(f) || lom_draw_surface(f, error);
}

bool lom_draw_lakes(struct frame *f, lom_error *error)
{
    return each_water(f, draw_lake, error);
}

bool lom_find_surfaces(struct frame *f, lom_error *error)
{
    return each_water(f, find_surface, error);
}

bool lom_draw_surfaces(struct frame *f, lom_error *error)
{
    return each_water(f, draw_surface, error);
}
