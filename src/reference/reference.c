/* Making and freeing a reference, and changing its water. In: a scene. Out: everything that rays are traced through. */
#include "reference/reference.h"

/* One of each of the scene's other waters, for rays that are traced without a frame. */
static bool make_others(lom_reference *reference, lom_error *error)
{
    const size_t count = reference->scene->other_water_count;
    if (count == 0)
        return true;
    reference->own_others = lom_allocate(count, sizeof *reference->own_others, error);
    for (size_t i = 1; reference->own_others != NULL && i <= count; i++)
        lom_set_other_water(&reference->own_others[i - 1], reference, i);
    reference->others = reference->own_others;
    reference->other_count = reference->own_others != NULL ? count : 0;
    return reference->own_others != NULL;
}

static lom_reference *create(struct lom_world *world, bool owns_world, lom_error *error)
{
    lom_reference *reference = lom_allocate(1, sizeof *reference, error);
    if (reference == NULL) {
        if (owns_world)
            lom_free_world(world);
        return NULL;
    }
    lom_float_state state;
    lom_enter_float_state(&state);
    reference->world = world;
    reference->owns_world = owns_world;
    reference->scene = world->scene;
    bool done = lom_load_reference(reference, error) && lom_place_reference(reference, 0, error) &&
                make_others(reference, error);
    lom_leave_float_state(&state);
    if (done)
        return reference;
    lom_free_reference(reference);
    return NULL;
}

lom_reference *lom_create_reference_of(struct lom_world *world, lom_error *error)
{
    return create(world, false, error);
}

lom_reference *lom_create_reference(const lom_scene *scene, lom_error *error)
{
    struct lom_world *world = lom_create_world(scene, NULL, error);
    return world == NULL ? NULL : create(world, true, error);
}

const lom_warnings *lom_reference_warnings(const lom_reference *reference)
{
    return &reference->world->warnings;
}

void lom_free_reference(lom_reference *reference)
{
    if (reference == NULL)
        return;
    lom_free_placed(reference);
    lom_free_ray_clouds(reference);
    lom_free_image(reference->sky_faces);
    lom_release(reference->own_others);
    lom_release(reference->pictures);
    lom_release(reference->layers);
    lom_release(reference->materials);
    if (reference->owns_world)
        lom_free_world(reference->world);
    lom_release(reference);
}

lom_reference_water lom_get_reference_water(const lom_reference *reference)
{
    return reference->water;
}

static bool is_finite(double x)
{
    return x - x == 0;
}

bool lom_set_reference_water(lom_reference *reference, const lom_reference_water *w, lom_error *error)
{
    bool good = w->index > 0 && is_finite(w->index) && w->lowest <= w->highest && is_finite(w->highest - w->lowest) &&
                w->roughness >= 0 && is_finite(w->roughness) &&
                (w->height == NULL || (w->step > 0 && is_finite(w->step)));
    for (int i = 0; i < 2; i++)
        good = good && is_finite(w->high[i] - w->low[i]);
    for (int i = 0; i < 3; i++)
        good = good && w->absorption[i] >= 0 && is_finite(w->absorption[i]) && is_finite(w->color[i]);
    if (!good)
        return lom_fail(error, LOM_ERROR_USAGE,
                        "The reference's water needs finite numbers, an index and a step above 0, and no negative "
                        "absorption.");
    reference->water = *w;
    reference->own_water = true;
    reference->other_count = 0;
    return true;
}
