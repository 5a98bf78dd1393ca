/* The shaders of surfaces by shading frequency. Compiled for speed. */
#include "render/surface.h"

#include <lom/scene.h>

extern const lom_shader lom_entity_phong, lom_entity_gouraud, lom_entity_flat;
extern const lom_shader lom_terrain_phong, lom_terrain_gouraud, lom_terrain_flat;

const lom_shader *lom_entity_shader(int shading)
{
    static const lom_shader *const shaders[] = { [LOM_SHADING_PHONG] = &lom_entity_phong,
                                                 [LOM_SHADING_GOURAUD] = &lom_entity_gouraud,
                                                 [LOM_SHADING_FLAT] = &lom_entity_flat };
    return shaders[shading];
}

const lom_shader *lom_terrain_shader(int shading)
{
    static const lom_shader *const shaders[] = { [LOM_SHADING_PHONG] = &lom_terrain_phong,
                                                 [LOM_SHADING_GOURAUD] = &lom_terrain_gouraud,
                                                 [LOM_SHADING_FLAT] = &lom_terrain_flat };
    return shaders[shading];
}
