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
    struct lom_eye_uniform eye;
    const float *sprites; /* of struct lom_sprite */
};

/* The same picture for two passes: what the drops add, laid over the frame. */
struct lom_spray_layer_uniforms {
    float origin[2];
    const lom_texture *layer;
};

/* How the frame looks at drops. */
struct lom_spray_view {
    lom_mat4 projection, view; /* a symmetric perspective without end, or parallel rays */
    lom_view_rays rays;        /* of both */
    lom_vec3 eye;
    double near_plane;
    int width, height; /* of the whole frame, pixels */
    double to_light[3];
};

/* How many of some sprites are seen, and in low and high the part of the screen that these reach, in normalised device
 * coordinates; of none, low is 1 and high -1. */
struct lom_sprite_reach {
    size_t seen;
    double low[2], high[2];
};

/* Whether an emitter and a time are within their ranges; false with a sentence. */
bool lom_check_emitter(const lom_emitter *emitter, double time, lom_error *error);
/* lom_place_particles of the numbers first .. end - 1, of an emitter that was checked. */
void lom_place_range(const lom_emitter *emitter, double time, size_t first, size_t end, lom_particle *particles);

/* A sprite for each of particles[0 .. count - 1] that the frame shows, and its depth, metres along the view axis; where
 * it does not, depth is 0 and the sprite as it was. */
struct lom_sprite_reach lom_make_sprites(const lom_spray *spray, const struct lom_spray_view *view,
                                         const lom_particle *particles, size_t count, struct lom_sprite *sprites,
                                         float *depth);
/* What both reach. */
struct lom_sprite_reach lom_join_reaches(struct lom_sprite_reach a, struct lom_sprite_reach b);

/* ---- drops that bounce (spray.bounce): bounce.wide.c ---- */

/* Floats of a drop between two steps, less `from` of the emitter. */
enum { LOM_BOUNCE_PLACE, LOM_BOUNCE_LEFT = 3, LOM_BOUNCE_VELOCITY, LOM_BOUNCE_FLOATS = 7 }; /* LEFT: of its age, s */
#define LOM_BOUNCE_STEP (1.0f / 64)                                                         /* s */

struct lom_bounce_uniforms {
    float step, drag, bounce, wind[3];
    const float *heights; /* of terrain, columns + 1 a row; NULL: there is none, the ground is level */
    int columns, rows;
    float corner[2], scale[2]; /* column = (x - corner[0]) scale[0], row = (z - corner[1]) scale[1] */
    float level;               /* of the ground without terrain; what heights count from */
};

/* The particles at the births of their lives at a time, as lom_place_range; share, alpha and life are those of the time. */
void lom_birth_range(const lom_emitter *emitter, double time, size_t first, size_t end, lom_particle *particles);

extern const lom_shader lom_bounce_shader; /* a step: attributes and varyings are the floats */

extern const lom_shader lom_spray_shader, lom_spray_layer_shader;

#endif
