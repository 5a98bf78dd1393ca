/* The table of the models of water. A new model is one row. */
#include "water/water_models.h"

#include "water/lake.h"
#include "water/surface.h"

const struct lom_water_model_row lom_water_models[] = {
    [LOM_WATER_DISPLACED] = { .has_waves = true,
                              .is_looked_up = true,
                              .bends = true,
                              .form = LOM_SURFACE_MESH,
                              .shader = &lom_surface_displaced_shader,
                              .text = "waves as a mesh, opaque: what is seen through them is part of it" },
    [LOM_WATER_TINTED] = { .shader = &lom_lake_tinted_shader, .text = "a quad of one colour, blended over the scene" },
    [LOM_WATER_PLANAR] = { .is_looked_up = true,
                           .shader = &lom_lake_shader,
                           .text = "the surface over the scene, from the pictures above and below it" },
    [LOM_WATER_NORMAL_MAP] = { .has_waves = true,
                               .is_looked_up = true,
                               .shader = &lom_surface_flat_shader,
                               .text = "waves as normals on two triangles, opaque: what is seen through them is part "
                                       "of it" },
    [LOM_WATER_MARCHED] = { .has_waves = true,
                            .is_looked_up = true,
                            .bends = true,
                            .form = LOM_SURFACE_RAYS,
                            .shader = &lom_surface_marched_shader,
                            .text = "waves met by a ray for each pixel, opaque: what is seen through them is part of "
                                    "it" },
    [LOM_WATER_REFERENCE] = { .has_waves = true, .bends = true, .is_traced = true },
};
