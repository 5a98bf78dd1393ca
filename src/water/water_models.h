/* The models of water by name: what each shows, and with which shader. */
#ifndef LOM_WATER_WATER_MODELS_H
#define LOM_WATER_WATER_MODELS_H

#include <lom/pipeline.h>
#include <lom/water.h>

/* What rays meet. */
typedef enum lom_surface_form {
    LOM_SURFACE_QUAD, /* two triangles at the level */
    LOM_SURFACE_MESH, /* the waves as a mesh whose density follows the screen */
    LOM_SURFACE_RAYS  /* the waves, by a ray for each pixel */
} lom_surface_form;

struct lom_water_model_row {
    bool has_waves;    /* the waves of the scene show; without, the surface is a plane */
    bool is_looked_up; /* so are pictures of the scene above and below it */
    bool bends;        /* light is bent at the surface by Snell's law */
    bool is_traced;    /* the reference draws the whole frame */
    lom_surface_form form;
    const lom_shader *shader; /* of the surface; NULL: it has none of its own */
    const char *text;         /* of the plan's step that draws it */
};
/* By lom_water_model. */
extern const struct lom_water_model_row lom_water_models[];

#endif
