/* The view from under water: two blended triangles over the frame. */
#ifndef LOM_WATER_UNDERWATER_H
#define LOM_WATER_UNDERWATER_H

#include "water/surface.h"

struct lom_underwater_uniforms {
    struct lom_medium_uniform medium;
    struct lom_eye_uniform eye;
    float ray[3][3], pixel[2];
    const lom_texture *depth; /* of the part of the frame at origin */
    float origin[2], crop_pixel[2];
    float depth_of_eye, highest; /* metres below the surface at rest; of the waves over it */
    bool multiplies;             /* the share that remains; else what is added */
};

extern const lom_shader lom_underwater_shader;

#endif
