/* A frame while it is drawn: what its stages share. A stage is one function of a room, named in the table of frame.c;
 * it draws into the frame's targets and adds a step to the plan for each pass that it runs or leaves out. */
#ifndef LOM_RENDER_FRAME_H
#define LOM_RENDER_FRAME_H

#include "render/plan.h"
#include "render/renderer.h"

/* What a frame knows of a water while it is not looked at. */
struct frame_water {
    lom_rect seen;
    struct lom_waves_uniform waves;
    enum lom_waves_known known;
    struct lom_caustics caustics;
    bool below;
};

struct frame {
    lom_renderer *renderer;
    const lom_scene *scene;
    int width, height;             /* of the whole frame */
    lom_rect crop;                 /* the part of it that is drawn: what the targets color, depth and mask hold */
    lom_rect asked;                /* the part of that which is asked for, from its corner */
    int number;                    /* of the frame */
    double time;                   /* seconds */
    const lom_picture_view *shown; /* of the scene's views; NULL: the picture of [camera] */
    lom_camera_view camera;
    struct lom_scene_view view;     /* the camera's, with the sky and no clip plane */
    bool parallel;                  /* the camera's rays are */
    bool smooths;                   /* edges, after the scene and its water are drawn: lom_smooth_frame */
    enum lom_target target;         /* where what is drawn now goes: the picture, or what is smoothed to be it */
    lom_rect water;                 /* where a surface of water is seen, in frame pixels; width 0: nowhere */
    struct lom_waves_uniform waves; /* of water with waves, at this time */
    enum lom_waves_known known;     /* how much `waves` has of them: what was needed */
    uint64_t wave_steps;            /* lom_wave_steps before this frame */
    bool below;                     /* the eye is under water with waves */
    struct frame_water turns[1 + LOM_MAX_OTHER_WATERS]; /* of the waters that are not looked at, */
    size_t turned, home; /* the one that is, and the one that is where none is drawn: that over the eye, or the first */
    size_t water_order[1 + LOM_MAX_OTHER_WATERS]; /* the farthest first */
    bool names_water;                             /* steps of the plan say whose they are */
    bool shows_water;                             /* a surface is drawn over the scene, */
    size_t divided_by;                            /* of this number the first one, */
    double divided_at;                            /* at this level */
    lom_plan *plan;
    const lom_frame_desc *desc;
    double done; /* the share of the stages behind this one */
    bool abandoned;
    lom_impostor_counters *impostors;
    lom_spray_counters *spray;
};

/* frame_size.c: sets width, height and crop by the description and the scene, or says why they cannot be. */
bool lom_find_frame_sizes(struct frame *f, lom_error *error);

/* The bytes of a pixel of a frame in the caller's memory. */
size_t lom_pixel_bytes(const lom_scene *scene, lom_pixel_order order);

/* frame.c: draws one view, or the picture of [camera] alone, and adds its steps, work and times to *out. */
bool lom_draw_part(lom_renderer *renderer, const lom_frame_desc *desc, lom_frame *out, lom_error *error);
/* views.c: draws the picture and all its views into one. */
bool lom_draw_views(lom_renderer *renderer, const lom_frame_desc *desc, lom_frame *out, lom_error *error);
bool lom_has_views(const lom_scene *scene, const lom_frame_desc *desc);
/* The view that a description names; false when there is none. */
bool lom_find_view(const lom_scene *scene, const char *name, const lom_picture_view **view, lom_error *error);

/* A pass over the drawn part of the frame: this colour target and the frame's depth, both cleared unless the caller
 * asks to keep them. */
lom_pass_desc lom_frame_pass(const struct frame *f, lom_texture *color);

/* The frame's view of what is on one side of the level of the water that is drawn first: the eye's (1) or the other one
 * (-1); all of it where none is drawn. */
struct lom_scene_view lom_view_of_side(const struct frame *f, double side);

/* edges.c: grows a range of pixels on both sides within 0..size; by how many before it. */
int lom_grow_range(int *from, int *count, int size, int margin);
/* The same file: grows the drawn part by what smoothing looks at, where edges are smoothed; the stage that smooths the frame's. */
void lom_begin_edges(struct frame *f);
bool lom_smooth_frame(struct frame *f, lom_error *error);
/* The same of the pass of what water mirrors, which draws its sharp picture; and from that the one in `color`, within the
 * scissor, which the pass is of then. */
void lom_begin_smooth_picture(struct frame *f, lom_pass_desc *pass);
bool lom_smooth_picture(struct frame *f, lom_pass_desc *pass, lom_texture *color, lom_rect scissor);

/* A pass of these draws alone. */
bool lom_draw_pass(lom_device *device, const lom_pass_desc *pass, const lom_draw_desc *draws, size_t count);

/* A frame that the reference draws instead of the stages: linear RGB32F of the crop, NULL on failure. */
lom_image *lom_draw_reference(struct frame *f, lom_error *error);

#endif
