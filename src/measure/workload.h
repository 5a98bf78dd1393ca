/* What a workload holds once it is set up; shared by the files of this folder. */
#ifndef LOM_MEASURE_WORKLOAD_H
#define LOM_MEASURE_WORKLOAD_H

#include "measure/peer_scatter.h"

#include "waves/fft.h"

#include <lom/march.h>
#include "measure/measure.h"

/* What has to be made for a workload. */
enum {
    LOM_NEEDS_TORUS = 1,
    LOM_NEEDS_CUBE = 2,
    LOM_NEEDS_GROUND = 4, /* terrain, its textures, the sky */
    LOM_NEEDS_LAKE = 8,   /* the water's plane, its textures, targets of two more passes */
    LOM_NEEDS_CLOUD = 16,
    LOM_NEEDS_BOXES = 32,
    LOM_NEEDS_ALBEDO = 64
};

enum { LOM_MAIN = 0, LOM_REFLECTION, LOM_REFRACTION, LOM_TARGETS };

typedef struct lom_workload_view {
    float eye[3], target[3]; /* metres */
    float light[3];          /* towards it, of any length */
    float near_plane, far_plane;
} lom_workload_view;

typedef struct lom_workload_kind {
    const char *name, *summary;
    void (*draw)(lom_workload *workload, lom_device *device);
    const lom_workload_view *view; /* NULL: drawn in window coordinates */
    unsigned needs;
    lom_peer_scatter *scatter;            /* NULL: none */
    lom_image *(*card)(lom_error *error); /* its texture; NULL: none */
    bool show_depth;                      /* the picture is of the depth */
    bool skip;                            /* marches over empty space */
    const struct lom_workload_task *task; /* NULL: a picture */
    int size;                             /* of the task: values a side */
} lom_workload_kind;

/* What is timed where it is no picture. */
typedef struct lom_workload_task {
    bool (*make)(lom_workload *workload, lom_error *error);
    bool (*prepare)(lom_workload *workload, lom_device *device, lom_error *error); /* before a frame; may be NULL */
    lom_image *(*picture)(const lom_workload *workload, lom_error *error);
} lom_workload_task;

struct lom_workload {
    const lom_workload_kind *kind;
    int width, height, samples;
    lom_filtering filtering, march; /* of textures; of the cloud */
    lom_texture *color[LOM_TARGETS], *depth[LOM_TARGETS];
    lom_peer_mesh torus, cube, terrain, water, scattered;
    lom_peer_box *boxes;
    lom_texture *albedo, *normals, *sky, *dudv, *ripples, *card;
    lom_volume *cloud;
    lom_peer_matrix to_clip, mirrored_to_clip;
    float light[3];               /* unit length */
    lom_fft *fft;                 /* made for the first device that needs it */
    float *numbers[2], *plane[2]; /* real and imaginary parts, as given and as transformed */
    lom_light_grid *grid;
    lom_error error; /* of a frame that uses no device */
};

/* Frames of the kinds, in workload_draw.c. */
void lom_draw_clear(lom_workload *workload, lom_device *device);
void lom_draw_fill(lom_workload *workload, lom_device *device);
void lom_draw_blend(lom_workload *workload, lom_device *device);
void lom_draw_depth(lom_workload *workload, lom_device *device);
void lom_draw_mesh(lom_workload *workload, lom_device *device);
void lom_draw_terrain(lom_workload *workload, lom_device *device);
void lom_draw_water(lom_workload *workload, lom_device *device);
void lom_draw_water_once(lom_workload *workload, lom_device *device); /* the same picture */
void lom_draw_cloud(lom_workload *workload, lom_device *device);
void lom_draw_fft(lom_workload *workload, lom_device *device);
void lom_draw_light(lom_workload *workload, lom_device *device);
/* workload_draw_scatter.c */
void lom_draw_sprites(lom_workload *workload, lom_device *device);
void lom_draw_foliage(lom_workload *workload, lom_device *device);
void lom_draw_gradients(lom_workload *workload, lom_device *device);
void lom_draw_boxes(lom_workload *workload, lom_device *device);
void lom_draw_textured(lom_workload *workload, lom_device *device);
/* What both have in common: a pass over a target, cleared to the colour and the depth 1; all triangles of a mesh, back
 * faces left out, with its first 1..3 of position, normal and uv; source alpha over the target. */
void lom_begin_workload_pass(lom_workload *workload, lom_device *device, int target, float r, float g, float b);
lom_draw_desc lom_workload_mesh_draw(const lom_shader *shader, const lom_peer_mesh *mesh, int attributes,
                                     const void *uniforms);
extern const lom_blend lom_straight_alpha;
/* What goes before a frame and is no part of its time, and the frame. */
bool lom_prepare_workload(lom_workload *workload, lom_device *device, lom_error *error);
bool lom_draw_prepared(lom_workload *workload, lom_device *device, lom_error *error);
/* workload_fft.c: real parts as red, imaginary ones as blue. */
extern const lom_workload_task lom_fft_task;
/* workload_light.c: the slices of the grid side by side, the sun's share as gray. */
extern const lom_workload_task lom_light_task;
/* The depth of the main target as gray, into its colour. */
void lom_show_depth(lom_workload *workload, lom_device *device);

#endif
