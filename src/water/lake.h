/* The planar lake (spec, part A): its surface as a draw over the finished scene. */
#ifndef LOM_WATER_LAKE_H
#define LOM_WATER_LAKE_H

#include "shading/light.h"

#include <lom/geometry.h>
#include <lom/water.h>

struct lom_lake_uniforms {
    struct lom_matrix_uniform clip_from_world;
    struct lom_light_uniform light;
    float eye[3], level;
    float pixel[2]; /* 1 / size of the whole frame */
    float tile;     /* 1 / metres of one repetition of the maps */
    float move;     /* repetitions the maps have moved, in [0, 1) */
    float near_plane;
    float flow_strength, normal_up, reflectivity, fresnel_power;
    float shininess, specular_strength, tint_amount, shore_depth, opacity;
    float color[3], tint_color[3];
    float quad[4]; /* x, z of the quad's corner and its extent */
    const lom_texture *reflection, *refraction, *refraction_depth, *normal_map, *flow_map;
    /* the steps that are switched on */
    bool has_reflection, has_refraction, has_projection, has_flow, has_normals, has_fresnel, has_specular, has_tint,
        has_soft_shore;
};

/* The colour of the surface, its mere presence (one channel, 1), and its tint alone. */
extern const lom_shader lom_lake_shader, lom_lake_mask_shader, lom_lake_tinted_shader;

/* What a pass of the lake needs besides its parameters. */
typedef struct lom_lake_view {
    lom_mat4 clip_from_world;
    lom_vec3 eye;
    double near_plane, time;
    int frame_width, frame_height;
    struct lom_light_uniform light;
    const lom_texture *reflection, *refraction, *refraction_depth, *normal_map, *flow_map;
} lom_lake_view;

/* Draws the quad with one of the three shaders: depth tested, blended over the scene by its alpha. */
void lom_draw_lake(lom_device *device, const lom_shader *shader, const lom_water_params *water,
                   const lom_lake_view *view);

#endif
