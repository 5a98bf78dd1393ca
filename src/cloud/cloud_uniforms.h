/* What the shaders of a cloud get. */
#ifndef LOM_CLOUD_CLOUD_UNIFORMS_H
#define LOM_CLOUD_CLOUD_UNIFORMS_H

#include "shading/eye.h"
#include "shading/light.h"

#include <lom/cloud.h>

struct lom_cloud_uniforms {
    struct lom_matrix_uniform clip_from_offset; /* of a place less the eye */
    float corner[8][3];                         /* of the box, less the eye */
    float eye_in_box[3];                        /* in parts of the box */
    float box_axis[3][3];                       /* rows: parts of the box along axis i a metre */
    struct lom_eye_uniform eye;
    float origin[2];
    const lom_texture *depth;                  /* NULL: nothing hides it */
    const float *jitter;                       /* NULL: none */
    bool is_sliced;                            /* only what lies between two planes is seen */
    float slice_axis[3], slice_from, slice_to; /* metres along a unit vector from the eye */
    lom_medium_desc march;
    lom_transfer_desc transfer; /* its function NULL: none */
    /* light */
    float to_light[3], sun[3], sky[3], ground[3]; /* radiance where a place sees all of it */
    int phase;                                    /* lom_cloud_phase */
    float forward, backward, blend;
    float silver, silver_cosine;
    float haze_color[3], haze_rate; /* 1/m; 0: none */
    /* the earlier models */
    const lom_volume *original; /* lit in advance, or white */
    bool is_fixed;              /* filtered in fixed point */
    float light_in_box[3];      /* parts of the box a metre towards the light */
    float unit;                 /* the reference's units a metre */
    bool is_real_time;
    const lom_texture *picture; /* of the billboard */
    float right[3], up[3];      /* half the billboard, metres; of many, unit vectors */
    const float *sprites;       /* as in cloud_sprites.h */
    float sprite_depth;
    const lom_texture *shape, *fine, *gradient; /* of a sheet; its noise is the picture */
    float deepest, eaten;                       /* optical depth; the share of it that follows the noise */
    float noise_scale[2];                       /* what noise is multiplied by to be 1 on average; and fine noise */
    float fine_repeats[2];                      /* of fine noise along the sheet's sides */
    float way_of_light;                         /* to the sheet's middle, in parts of its optical depth from above */
};

/* A plate with a cloud's picture. */
struct lom_impostor_uniforms {
    struct lom_cloud_uniforms cloud; /* its place, the depth and the slice */
    float corner[4][3];              /* of the plate, less the eye: lower left, lower right, upper left, upper right */
    const lom_texture *plate;
    float misting; /* factor on opacity and colour */
    float age;     /* frames since it was made; for records */
};

/* A cloud's shadow on the plane of the ground's shadow map. */
struct lom_cloud_shadow_uniforms {
    float plane[4];                   /* x, z of the map's corner and its extent, metres */
    float quad[4];                    /* the part of the map that the cloud can shadow: s, t of its corner and extent */
    float start[3], by_x[3], by_z[3]; /* in the box: of the corner, and a metre along x and z of the plane */
    float along[3];                   /* in the box, a metre towards the light */
    int steps;
    lom_medium_desc march;
    const lom_transfer_function *transfer; /* NULL: none */
};

struct lom_placed_cloud;
struct lom_cloud_view;
/* cloud_draw.c: where the cloud is, how it is looked at, and what hides it. */
void lom_set_cloud_place(struct lom_cloud_uniforms *u, const struct lom_placed_cloud *placed,
                         const struct lom_cloud_view *view);

extern const lom_shader lom_cloud_original_shader, lom_cloud_picture_shader, lom_cloud_sprite_shader,
    lom_cloud_sheet_shader;
extern const lom_shader lom_cloud_shader, lom_cloud_transfer_shader, lom_cloud_shadow_shader;
extern const lom_shader lom_impostor_shader, lom_magnify_shader;

#endif
