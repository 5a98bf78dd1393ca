/* One way to draw a scene, measured: how wrong its picture is, and its time in pairs with another way. */
#ifndef LOM_MEASURE_TRIAL_H
#define LOM_MEASURE_TRIAL_H

#include "measure/dials.h"

#include <lom/render.h>

/* What is measured: a scene, a frame, a device. */
typedef struct lom_subject {
    const char *path;
    const char *const *changes; /* overrides of the scene, as lom_read_scene takes them */
    size_t change_count;
    lom_frame_desc frame; /* its number, size, view and crop */
    lom_device_desc device;
    bool of_processors; /* times are those of the processors, of all threads together; else of the clock */
} lom_subject;

/* Dials, and what they are set to. */
enum { LOM_MAX_CHOICES = 48 };
typedef struct lom_choice {
    const lom_dial *dial;
    char setting[LOM_SCENE_VALUE];
} lom_choice;
typedef struct lom_choices {
    int count; /* 0: everything as the scene says */
    lom_choice choice[LOM_MAX_CHOICES];
} lom_choices;

/* A renderer that draws a subject one way after another. Zero at first; ended by lom_end_drawer. */
typedef struct lom_drawer {
    lom_scene *scene;
    lom_renderer *renderer;
    lom_device_desc device;
    int parts; /* crops each way that a frame is drawn in; 0: 1 */
} lom_drawer;

/* Makes it draw the subject this way; false on failure: a setting that the scene refuses. It draws what it drew
 * before, then. */
bool lom_set_drawer(lom_drawer *drawer, const lom_subject *subject, const lom_choices *choices, lom_error *error);
/* Whether it was the setting's fault, which the scene or the build refuses: other ways may be drawn. What fails for want
 * of memory, a file or a thread fails for all. */
bool lom_is_refusal(const lom_error *error);
void lom_end_drawer(lom_drawer *drawer);
/* The picture of the subject's frame, after the frames before it where plates of clouds depend on them. NULL on
 * failure; freed with lom_free_image. */
lom_image *lom_draw_subject(const lom_drawer *drawer, const lom_subject *subject, lom_error *error);

/* How far a picture is from another of its size. */
typedef struct lom_picture_error {
    double psnr; /* decibels; infinite for equal pictures */
    double ssim, flip;
    double max_delta; /* steps of 255 */
    size_t pixels;    /* that differ */
} lom_picture_error;
bool lom_measure_error(const lom_image *reference, const lom_image *picture, lom_picture_error *out, lom_error *error);

/* Times of a way over those of another, frame by frame in turn, over the frames that follow the subject's. */
typedef struct lom_pair_time {
    double ms, other_ms;     /* median milliseconds of a frame of both */
    double ratio, low, high; /* ms / other_ms: median and quartiles of the pairs */
} lom_pair_time;
enum { LOM_MAX_PAIRS = 999 };
/* pairs: 1..LOM_MAX_PAIRS. Each way draws one frame before that is not counted. */
bool lom_time_pairs(const lom_drawer *drawer, const lom_drawer *other, const lom_subject *subject, int pairs,
                    lom_pair_time *out, lom_error *error);

#endif
