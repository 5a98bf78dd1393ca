/* The site of a scene's waves. In: the scene, its bed. Out: what the waves are made from. */
#include "base/numbers.h"
#include "scene/scene_water.h"

/* An entity's -z is ahead, turned by its yaw from +x towards -z. */
static void follow(const void *context, size_t followed, double time, double place[2], double *heading)
{
    const lom_scene *scene = context;
    lom_entity_place at = lom_scene_entity_at(&scene->entities[followed - 1], time);
    place[0] = at.position.x;
    place[1] = at.position.z;
    *heading = -lom_pi / 2 - at.rotation.y;
}

const lom_water_params *lom_water_of(const lom_scene *scene, size_t number)
{
    return number == 0 ? &scene->water : &scene->other_waters[number - 1];
}

bool lom_has_water(const lom_scene *scene)
{
    for (size_t i = 0; i <= scene->other_water_count; i++)
        if (lom_water_of(scene, i)->present && lom_water_of(scene, i)->enabled)
            return true;
    return false;
}

struct lom_wave_site lom_scene_wave_site(const lom_scene *scene, size_t number, const struct lom_bed *bed)
{
    static const lom_water_surf no_surf;
    static const lom_shallow_water not_shallow;
    const lom_water_params *water = lom_water_of(scene, number);
    const bool is_first = number == 0;
    const lom_water_surf *surf = is_first ? &scene->surf : &no_surf;
    const lom_shallow_water *shallow = is_first ? &scene->shallow : &not_shallow;
    const size_t wake_count = is_first ? scene->wake_count : 0;
    return (struct lom_wave_site){ .waves = &water->waves,
                                   .foam = &water->foam,
                                   .surf = surf,
                                   .shallow = shallow,
                                   .wakes = scene->wakes,
                                   .wake_count = wake_count,
                                   .level = water->level,
                                   .middle = { water->position[0], water->position[1] },
                                   .size = { water->size[0], water->size[1] },
                                   .tile = water->tile,
                                   .ripple_up = water->normal_up,
                                   .is_rippled = water->normals && water->waves.kind == LOM_WAVES_NONE &&
                                                 !(surf->height > 0) && !shallow->present,
                                   .ripple_speed = water->flow_speed,
                                   .bed = *bed,
                                   .follow = follow,
                                   .scene = scene };
}
