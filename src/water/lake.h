/* The planar lake: its surface as a draw over the finished scene. */
#ifndef LOM_WATER_LAKE_H
#define LOM_WATER_LAKE_H

#include "shading/eye.h"
#include "shading/light.h"
#include "shading/sun_shadow.h"

#include <lom/geometry.h>
#include <lom/water.h>

struct lom_lake_uniforms {
    struct lom_matrix_uniform clip_from_offset;
    struct lom_light_uniform light;
    struct lom_sun_shadow_uniform entity_shadow;
    float level;    /* metres over the eye */
    float pixel[2]; /* 1 / size of the whole frame */
    float tile;     /* 1 / metres of one repetition of the maps */
    float shift[2]; /* their coordinates at the eye, less whole repetitions */
    float move;     /* repetitions the maps have moved, in [0, 1) */
    struct lom_eye_uniform eye;
    float flow_strength, normal_up, reflectivity, fresnel_power;
    float shininess, specular_strength, tint_amount, shore_depth, opacity;
    float inverse_clear; /* 1 / metres of water from which lookups are displaced and highlights seen in full */
    float color[3], tint_color[3];
    float quad[4]; /* x, z of the quad's corner less the eye, and its extent */
    const lom_texture *reflection, *refraction, *refraction_depth, *normal_map, *flow_map;
    /* the steps that are switched on */
    bool has_reflection, has_refraction, has_projection, has_flow, has_normals, has_fresnel, has_specular, has_tint,
        has_soft_shore;
};

/* The colour of the surface, its mere presence (one channel, 1), and its tint alone. */
extern const lom_shader lom_lake_shader, lom_lake_mask_shader, lom_lake_tinted_shader;

/* What a pass of the lake needs besides its parameters. */
typedef struct lom_lake_view {
    struct lom_matrix_uniform clip_from_offset;
    lom_vec3 eye;
    struct lom_eye_uniform rays;
    double time;
    int frame_width, frame_height;
    struct lom_light_uniform light;
    struct lom_sun_shadow_uniform entity_shadow;
    const lom_texture *reflection, *refraction, *refraction_depth, *normal_map, *flow_map;
} lom_lake_view;

/* A draw of the quad with one of the three shaders, depth tested, blended over the scene by its alpha; and its uniforms,
 * which must last as long. */
lom_draw_desc lom_lake_draw(const lom_shader *shader, const lom_water_params *water, const lom_lake_view *view,
                            struct lom_lake_uniforms *uniforms);

#endif
