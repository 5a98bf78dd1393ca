/* lom/render.h - from a scene to pictures: the plan (which passes, and why) and running it, frame after frame.
 *
 * Steps of use, in order: lom_read_scene (lom/scene.h); lom_create_renderer, which loads what the scene names;
 * lom_render_frame for each frame, whose picture is freed with lom_free_image; lom_free_renderer, lom_free_scene.
 * Between frames lom_change_scene goes on with another scene.
 */
#ifndef LOM_RENDER_H
#define LOM_RENDER_H

#include <lom/pipeline.h>
#include <lom/scene.h>

LOM_API_BEGIN

typedef struct lom_renderer lom_renderer;

/* Loads everything the scene names and makes ready to draw it. The scene is not copied: it outlives the renderer, or its
 * lom_change_scene. NULL on failure. Freed with lom_free_renderer. The zero device descriptor is a good one. */
lom_renderer *lom_create_renderer(const lom_scene *scene, const lom_device_desc *device, lom_error *error);
void lom_free_renderer(lom_renderer *renderer); /* NULL is allowed */

/* ---- another scene ---- */

/* What lom_change_scene did. */
typedef enum lom_change {
    LOM_CHANGE_NONE,  /* nothing: no key differs */
    LOM_CHANGE_FRAME, /* nothing was loaded: all keys that differ are looked up in each frame */
    LOM_CHANGE_PART,  /* some of what the scene names was loaded again: lom_renderer_loaded */
    LOM_CHANGE_ALL    /* everything was */
} lom_change;

/* Makes the renderer draw `scene` from the next frame on, and loads only what the keys that differ from those of its
 * scene are loaded for. Frames then have the bytes that they have with a renderer that was created for the scene; a run
 * of impostors begins anew, unless nothing differs but the camera, key frames of entities and the sun's way: then a
 * frame goes on with it that says so (`continues`). As lom_create_renderer's it is not copied and outlives the renderer
 * or its next change; that of before is not looked at any more, and may be freed. Files that keep their names are taken
 * as unchanged: a renderer whose files have been written must be created again. *change (may be NULL) says what was done,
 * LOM_CHANGE_NONE on failure. False on failure: a file that cannot be read, memory, or what lom_create_renderer refuses;
 * the renderer goes on drawing the scene of before, with the same bytes. While parts are loaded anew, the old ones are
 * kept in memory. */
bool lom_change_scene(lom_renderer *renderer, const lom_scene *scene, lom_change *change, lom_error *error);
/* What the last successful lom_change_scene loaded, as "clouds, waves"; empty when that was nothing, or everything. It
 * belongs to the renderer. */
const char *lom_renderer_loaded(const lom_renderer *renderer);

/* Called by the thread that draws, before each pass that runs and at last before the "output": its name as in the plan,
 * and the share (0..1) of the frame's stages that are done, which never falls. False abandons the frame: what is left
 * of it is not drawn, lom_render_frame fails with LOM_ERROR_ABANDONED, and the renderer is as good as before (a run of
 * impostors begins anew). */
typedef bool lom_frame_progress(void *context, const char *pass, double done);

/* The bytes of a pixel in the caller's memory. */
typedef enum lom_pixel_order {
    LOM_ORDER_OUTPUT = 0, /* the scene's output format: 3 samples of 8, 16 or 32 bits */
    LOM_ORDER_RGBX,       /* 8 bits each, x is 255: for output.format "rgb8" alone */
    LOM_ORDER_BGRX        /* likewise */
} lom_pixel_order;

typedef struct lom_frame_desc {
    int width, height; /* of the whole frame, of one view too; 0: the scene's */
    const char *view;  /* NULL: the picture with all its views; LOM_MAIN_VIEW: without them; a name: that view alone, as
                          large as its rectangle of the frame, of which the crop is then a part */
    int frame;         /* its time is frame / fps seconds */
    bool has_time;     /* its time is `time` seconds, within +-1e9, instead */
    bool continues;    /* a run goes on from the frame before of the same size, whatever its number was */
    double time;
    const lom_camera_view *camera; /* the eye, instead of the scene's at that time; NULL: the scene's. Views keep their
                                      own */
    void *pixels;                  /* the crop's rows are written here, instead of to a new image; NULL: an image */
    size_t pitch;                  /* bytes from a row to the next */
    lom_pixel_order order;         /* of them */
    lom_rect crop;                 /* the part that is drawn and returned; width 0: all of it */
    double memory;                 /* GiB that its targets may take; 0: what the machine has */
    lom_frame_progress *progress;  /* NULL: nobody looks */
    void *progress_context;
} lom_frame_desc;

/* ---- the plan ---- */

enum { LOM_MAX_STEPS = 160, LOM_MAX_STEP_TEXT = 240 };

/* One pass, or one that was left out. */
typedef struct lom_step {
    char name[24]; /* "scene", "visibility", "reflection", "refraction", "water", "reference" */
    int view;      /* 0: of the picture; else 1 + the number of the scene's view that it draws */
    bool runs;
    char text[LOM_MAX_STEP_TEXT]; /* what it draws from what into what; or why it was left out */
    int width, height;            /* of its target */
    lom_rect scissor;             /* the part of it that is drawn; width 0: all of it */
} lom_step;

typedef struct lom_plan {
    int count;
    lom_step step[LOM_MAX_STEPS];
} lom_plan;

/* The pixels of a frame of this size that a view has. */
lom_rect lom_view_rectangle(const lom_picture_view *view, int width, int height);
/* The view that shows at a pixel of a frame of this size: the last visible one that holds it; NULL: the picture. */
const lom_picture_view *lom_view_at(const lom_scene *scene, int width, int height, int x, int y);

/* ---- a frame ---- */

/* What became of the clouds' impostors, over all pictures of a frame (the frame itself, the water's mirror). */
typedef struct lom_impostor_counters {
    int plates;    /* shown */
    int refreshed; /* of them made anew */
    int reused;    /* of them shown again */
    int split;     /* of them in two parts, around the aircraft in the cloud */
    int skipped;   /* clouds too small to be seen */
    int culled;    /* clouds outside the view */
} lom_impostor_counters;

/* What became of the drops of [[spray]]. */
typedef struct lom_spray_counters {
    uint64_t moved; /* of emitters that may be in view */
    uint64_t drawn; /* of them in view, and not clear */
} lom_spray_counters;

/* The time of a stage of a frame. */
enum { LOM_MAX_STAGES = 20 };
typedef struct lom_stage_time {
    const char *name;
    double milliseconds; /* by the clock: this and the next are all that differs here from run to run */
    double alone;        /* of these, those in which at most one of the device's workers ran */
} lom_stage_time;

typedef struct lom_frame {
    lom_image *image;      /* the picture, in the scene's output format; freed with lom_free_image; NULL when it was
                              written to the caller's pixels */
    lom_plan plan;         /* what was done for it */
    lom_counters counters; /* work of this frame */
    lom_impostor_counters impostors;
    lom_spray_counters spray;
    uint64_t shallow_steps;               /* of shallow water, run for this frame */
    uint64_t fluid_steps;                 /* of liquids of particles, likewise */
    lom_stage_time stage[LOM_MAX_STAGES]; /* in their order; name NULL behind the last */
} lom_frame;

/* Whether a frame of the scene lies within the limits (docs/limits.md); false with the reason. lom_render_frame asks
 * the same before it draws; a program can ask before it loads. */
bool lom_check_frame(const lom_scene *scene, const lom_frame_desc *desc, lom_error *error);

/* Draws one frame; any frame alone gives the bytes that it has in a run, unless quality.impostors is on: then a plate
 * depends on the frames of the run before. A run goes on when the frame is the one after the last frame that this
 * renderer drew, at the same size, or says so (`continues`); else every cloud is drawn afresh. The targets of two sizes
 * are kept: going back and forth between them allocates nothing. False on failure (image is then NULL). */
bool lom_render_frame(lom_renderer *renderer, const lom_frame_desc *desc, lom_frame *frame, lom_error *error);

/* Empty, or sentences about what was passed over while loading, such as a material file that is not there or a mesh's
 * texture that cannot be read; each ended by a newline. */
const char *lom_renderer_warning(const lom_renderer *renderer);
/* How many there are: more than those sentences when not all of them found room. */
size_t lom_renderer_warning_count(const lom_renderer *renderer);
/* The device that draws, for its descriptor and counters. */
const lom_device *lom_renderer_device(const lom_renderer *renderer);

LOM_API_END

#endif
