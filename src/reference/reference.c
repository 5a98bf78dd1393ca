/* Making and freeing a reference, and changing its water. In: a scene. Out: everything that rays are traced through. */
#include "reference/world.h"

static bool place_moment(lom_reference *reference, double time, lom_error *error)
{
    const lom_scene *scene = reference->source;
    reference->moment = *scene;
    reference->scene = &reference->moment;
    reference->moment.light = lom_scene_light_at(scene, time);
    reference->entities = lom_allocate(scene->entity_count, sizeof *reference->entities, error);
    reference->moment.entities = reference->entities;
    for (size_t i = 0; reference->entities != NULL && i < scene->entity_count; i++) {
        const lom_entity *entity = &scene->entities[i];
        reference->entities[i] = *entity;
        if (entity->key_count == 0)
            continue;
        lom_entity_place at = lom_scene_entity_at(entity, time);
        reference->entities[i].position = at.position;
        reference->entities[i].rotation = at.rotation;
    }
    return reference->entities != NULL;
}

lom_reference *lom_create_reference_at(const lom_scene *scene, double time, lom_error *error)
{
    lom_reference *reference = lom_allocate(1, sizeof *reference, error);
    if (reference == NULL)
        return NULL;
    lom_float_state state;
    lom_enter_float_state(&state);
    reference->source = scene;
    bool done = place_moment(reference, time, error) && lom_load_world(reference, error);
    lom_leave_float_state(&state);
    if (done)
        return reference;
    lom_free_reference(reference);
    return NULL;
}

lom_reference *lom_create_reference(const lom_scene *scene, lom_error *error)
{
    return lom_create_reference_at(scene, 0, error);
}

const lom_warnings *lom_reference_warnings(const lom_reference *reference)
{
    return &reference->warnings;
}

void lom_free_reference(lom_reference *reference)
{
    if (reference == NULL)
        return;
    for (size_t i = 0; i < reference->picture_count; i++) {
        lom_free_picture(&reference->pictures[i].picture);
        lom_release(reference->pictures[i].path);
    }
    lom_free_ray_clouds(reference);
    lom_free_picture(&reference->sky);
    lom_free_ray_triangles(&reference->opaque);
    lom_release(reference->pictures);
    lom_release(reference->layers);
    lom_release(reference->materials);
    lom_release(reference->triangles);
    lom_release(reference->corners);
    lom_release(reference->points);
    lom_release(reference->entities);
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
    return true;
}
