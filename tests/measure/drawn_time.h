/* A small scene that is drawn again and again: how long a frame takes, what work it declares, how many instructions meet
 * denormals. */
#ifndef LOM_TESTS_DRAWN_TIME_H
#define LOM_TESTS_DRAWN_TIME_H

#include "check.h"
#include "denormals.h"
#include "measure/work.h"
#include "processor_time.h"
#include "small_scene.h"

#include <math.h>

enum { WIDTH = 48, HEIGHT = 27, FRAMES = 3 };
static const double most = 2.5;

struct drawn {
    lom_scene *scene;
    lom_renderer *renderer;
    int next; /* frame */
    double least;
    uint64_t work, denormals;
    lom_error error;
};

static const lom_frame_desc small = { .width = WIDTH, .height = HEIGHT };

static inline bool draw_next(struct drawn *d)
{
    lom_frame frame = { .image = NULL };
    lom_frame_desc desc = small;
    desc.frame = d->next++;
    const double start = processor_seconds();
    const bool done = lom_render_frame(d->renderer, &desc, &frame, &d->error);
    const double taken = processor_seconds() - start;
    lom_free_image(frame.image);
    d->least = taken < d->least ? taken : d->least;
    return done;
}

static inline bool count_all(struct drawn *d)
{
    lom_declared_work work;
    lom_frame_desc desc = small;
    desc.frame = d->next++;
    if (!lom_count_work(d->renderer, d->scene, &desc, &work, &d->error))
        return false;
    d->work = lom_weigh_work(&work);
#ifdef LOM_COUNTS_DENORMALS
    const double least = d->least;
    denormals_met = 0;
    count_denormals(true);
    const bool done = draw_next(d);
    count_denormals(false);
    d->denormals = denormals_met;
    d->least = least;
    return done;
#else
    return true;
#endif
}

/* The second frame is the first that is timed: a first one makes what the others keep. */
static inline bool open_drawn(struct drawn *d, const char *text, const char *override)
{
    *d = (struct drawn){ .least = INFINITY };
    d->scene = lom_decode_scene(text, strlen(text), small_path("scene.toml"), &override, override != NULL, &d->error);
    if (d->scene != NULL)
        d->renderer = lom_create_renderer(d->scene, &(lom_device_desc){ .threads = 1, .lanes = 4 }, &d->error);
    if (d->renderer == NULL || !draw_next(d))
        return false;
    d->least = INFINITY;
    for (int i = 0; i < FRAMES; i++)
        draw_next(d);
    return count_all(d);
}

static inline void close_drawn(struct drawn *d)
{
    lom_free_renderer(d->renderer);
    lom_free_scene(d->scene);
}

/* A denormal costs 150 cycles, 50 ns, where it costs anything: of the work, in nanoseconds, that is a part. */
static inline void check_denormals(const struct drawn *d, uint64_t clean_work, const char *what, const char *name)
{
    const double share = 50 * (double)d->denormals / (double)(d->work > clean_work ? d->work : clean_work);
    CHECK(share <= most - 1, "%s in %s: %llu denormals, %g of the work", name, what, (unsigned long long)d->denormals,
          share);
}

#endif
