/* Drops as the pipeline draws them: a sprite each, which faces the eye. */
#ifndef LOM_SPRAY_SPRAY_H
#define LOM_SPRAY_SPRAY_H

#include "shading/haze.h"

#include <lom/geometry.h>
#include <lom/particles.h>

/* A drop in view: floats, so that lanes can gather them. */
struct lom_sprite {
    float middle[3]; /* less the eye */
    float along[3];  /* half of it along its way on the screen, metres */
    float across[3]; /* and across */
    float color[3];
    float opacity;
    float soft; /* metres */
    float sun;  /* radiance that the sun's light makes, in parts of a white surface's that faces it */
};
enum { LOM_SPRITE_FLOATS = sizeof(struct lom_sprite) / sizeof(float) };

struct lom_spray_uniforms {
    struct lom_matrix_uniform clip_from_offset; /* of a place less the eye */
    struct lom_light_uniform light;
    struct lom_haze_uniform haze;
    float near_plane;
    const float *sprites; /* of struct lom_sprite */
};

/* The same picture for two passes: what the drops add, laid over the frame. */
struct lom_spray_layer_uniforms {
    float origin[2];
    const lom_texture *layer;
};

/* How the frame looks at drops. */
struct lom_spray_view {
    lom_mat4 projection, view; /* a symmetric perspective without end */
    lom_vec3 eye;
    double near_plane;
    int width, height; /* of the whole frame, pixels */
    double to_light[3];
};

/* What can be drawn: the first `count` sprites, their depths, and in low and high the part of the screen that they
 * reach, in normalised device coordinates. */
struct lom_sprites {
    struct lom_sprite *sprite;
    float *depth; /* metres along the view axis */
    size_t count;
    double low[2], high[2];
};

/* Adds those of particles[0 .. count - 1] that the frame shows; there is room for them. */
void lom_add_sprites(struct lom_sprites *sprites, const lom_spray *spray, const struct lom_spray_view *view,
                     const lom_particle *particles, size_t count);

extern const lom_shader lom_spray_shader, lom_spray_layer_shader;

#endif
