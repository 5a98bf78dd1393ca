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

bool lom_is_still(const lom_scene *scene)
{
    return scene->water.waves.kind == LOM_WAVES_NONE && !(scene->surf.height > 0) && !scene->shallow.present;
}

struct lom_wave_site lom_scene_wave_site(const lom_scene *scene, const struct lom_bed *bed)
{
    const lom_water_params *water = &scene->water;
    return (struct lom_wave_site){ .waves = &water->waves,
                                   .foam = &water->foam,
                                   .surf = &scene->surf,
                                   .shallow = &scene->shallow,
                                   .level = water->level,
                                   .middle = { water->position[0], water->position[1] },
                                   .size = { water->size[0], water->size[1] },
                                   .tile = water->tile,
                                   .ripple_up = water->normal_up,
                                   .is_rippled = water->normals && lom_is_still(scene),
                                   .ripple_speed = water->flow_speed,
                                   .bed = *bed,
                                   .follow = follow,
                                   .scene = scene };
}
