/* The sun of a scene. */
#ifndef LOM_SCENE_SCENE_LIGHT_H
#define LOM_SCENE_SCENE_LIGHT_H

#include <lom/scene.h>

/* Unit vector from the scene to the sun: against the way its light travels. */
static inline lom_vec3 lom_to_light(const lom_light *light)
{
    return (lom_vec3){ -light->direction.x, -light->direction.y, -light->direction.z };
}

#endif
