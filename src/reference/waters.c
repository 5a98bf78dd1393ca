/* Several waters for rays. In: a reference with the first. Out: one for each of the others, which shares all the rest.
 * Invariant: with one water nothing here is asked. */
#include "reference/reference.h"

void lom_set_other_water(lom_reference *other, const lom_reference *reference, size_t number)
{
    const struct lom_ray_water *water = &reference->other_waters[number - 1];
    *other = *reference;
    other->scene = &other->moment.scene;
    other->moment.scene.water = reference->scene->other_waters[number - 1];
    other->water = water->at;
    other->normal_map = water->normal_map;
    other->flow_map = water->flow_map;
    other->waves = NULL;
    other->own_water = false;
    other->others = NULL;
    other->other_count = 0;
    other->number = number;
    lom_light_reference(other);
}

const lom_reference *lom_reference_with(const lom_reference *reference, size_t number)
{
    return number == 0 ? reference : &reference->others[number - 1];
}

const lom_reference *lom_reference_around(const lom_reference *reference, lom_vec3 place, double time)
{
    for (size_t i = 1; i <= reference->other_count; i++)
        if (lom_water_above(lom_reference_with(reference, i), place, time) > 0)
            return lom_reference_with(reference, i);
    return reference;
}

const lom_reference *lom_cross_waters(const lom_reference *reference, const struct lom_ray *ray, double time,
                                      const lom_reference *inside, double low, double high,
                                      struct lom_crossing *crossing)
{
    if (inside != NULL)
        return lom_cross_water(inside, ray, time, true, low, high, crossing) ? inside : NULL;
    const lom_reference *met = NULL;
    for (size_t i = 0; i <= reference->other_count; i++) {
        const lom_reference *one = lom_reference_with(reference, i);
        if (lom_cross_water(one, ray, time, false, low, met != NULL ? crossing->t : high, crossing))
            met = one;
    }
    return met;
}
