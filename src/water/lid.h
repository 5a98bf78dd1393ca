/* A level rectangle under a surface of water that hides all that is opaque below: depth alone. */
#ifndef LOM_WATER_LID_H
#define LOM_WATER_LID_H

#include <lom/geometry.h>
#include <lom/pipeline.h>

/* A strip of four vertices. */
struct lom_lid_uniforms {
    struct lom_matrix_uniform clip_from_offset;
    float low[2], high[2]; /* x and z of two corners less the eye */
    float level;           /* likewise */
};

extern const lom_shader lom_lid_shader;

#endif
