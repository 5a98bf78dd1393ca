/* Where one worker of a frame is alone, by processor time: right on a busy machine, too, where the clock of `--stats`
 * counts what other programs took. In: scenes, sizes. Out: a row each of what the caller took outside of what workers
 * share, of a frame of so many workers the share, and the stages of which most of it is; the frame with the least share.
 *
 * The linker leads the two doors of the pool here (-Wl,--wrap), and the look at the clock with which a stage ends. Each
 * look costs a call of the system, whose time is measured and taken off. What is not seen: that of a shared section one
 * worker did all, since on a busy machine that says nothing. */
#include "base/threads.h"
#include "pipeline/device.h"

#include <lom/lom.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { MAX_WORKERS = 256, MAX_LOOKS = LOM_MAX_STAGES + 2, SHOWN = 3 };

static struct {
    double since;              /* the caller's seconds when it was alone last */
    double alone, shared;      /* of this frame: seconds of the caller outside, and of all inside, of the pool's runs */
    double at_look[MAX_LOOKS]; /* `alone` at the looks at the clock: stage i lies between i and i + 1 */
    int looks, runs;
    double look;                /* seconds that a look takes */
    double worker[MAX_WORKERS]; /* in the run */
    lom_work *work;
    void *context;
} measured;

static double own_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

static void end_alone(void)
{
    const double now = own_seconds();
    measured.alone += now - measured.since - measured.look;
    measured.since = now;
}

static void work(void *context, int worker)
{
    const double start = own_seconds();
    (void)context;
    measured.work(measured.context, worker);
    measured.worker[worker] += own_seconds() - start - measured.look;
}

void __real_lom_run_pool(lom_pool *pool, lom_work *what, void *context);
void __real_lom_offer_work(lom_pool *pool, lom_work *what, void *context);
double __real_lom_device_shared_seconds(const lom_device *device);
void __wrap_lom_run_pool(lom_pool *pool, lom_work *what, void *context);
void __wrap_lom_offer_work(lom_pool *pool, lom_work *what, void *context);
double __wrap_lom_device_shared_seconds(const lom_device *device);

static void run(void (*door)(lom_pool *, lom_work *, void *), lom_pool *pool, lom_work *what, void *context)
{
    end_alone();
    measured.work = what;
    measured.context = context;
    memset(measured.worker, 0, sizeof measured.worker);
    door(pool, work, NULL);
    for (int i = 0; i < MAX_WORKERS; i++)
        measured.shared += measured.worker[i];
    measured.runs++;
    measured.since = own_seconds();
}

void __wrap_lom_run_pool(lom_pool *pool, lom_work *what, void *context)
{
    run(__real_lom_run_pool, pool, what, context);
}

void __wrap_lom_offer_work(lom_pool *pool, lom_work *what, void *context)
{
    run(__real_lom_offer_work, pool, what, context);
}

double __wrap_lom_device_shared_seconds(const lom_device *device)
{
    end_alone();
    if (measured.looks < MAX_LOOKS)
        measured.at_look[measured.looks++] = measured.alone;
    return __real_lom_device_shared_seconds(device);
}

static void begin_frame(void)
{
    measured.alone = measured.shared = 0;
    measured.looks = measured.runs = 0;
    measured.since = own_seconds();
}

static void time_looks(void)
{
    enum { LOOKS = 20000 };
    const double start = own_seconds();
    for (int i = 0; i < LOOKS; i++)
        measured.since = own_seconds();
    measured.look = (measured.since - start) / LOOKS;
}

struct result {
    double alone, shared; /* seconds */
    int runs;
    double stage[LOM_MAX_STAGES];
    const char *name[LOM_MAX_STAGES];
};

/* A look begins the stages, one ends each, and two lie around the output, which is the last. */
static struct result take_result(const lom_frame *frame)
{
    struct result r = { measured.alone, measured.shared, measured.runs, { 0 }, { NULL } };
    int stages = 0;
    while (stages < LOM_MAX_STAGES && frame->stage[stages].name != NULL)
        stages++;
    for (int i = 0; i < stages && measured.looks == stages + 2; i++) {
        const int end = i + 1 < stages ? i + 1 : i + 2;
        r.stage[i] = measured.at_look[end] - measured.at_look[end - 1];
        r.name[i] = frame->stage[i].name;
    }
    return r;
}

static double share_of(const struct result *r, int workers)
{
    return r->alone / (r->alone + r->shared / workers);
}

static void print_row(const char *path, int width, int height, struct result *r, int workers)
{
    const char *name = strrchr(path, '/') != NULL ? strrchr(path, '/') + 1 : path;
    printf("| %.*s | %dx%d | %.1f | %.2f | %.1f %% | %d |", (int)strcspn(name, "."), name, width, height,
           (r->alone + r->shared) * 1e3, r->alone * 1e3, 100 * share_of(r, workers), r->runs);
    for (int k = 0; k < SHOWN; k++) {
        int most = 0;
        for (int i = 1; i < LOM_MAX_STAGES; i++)
            most = r->stage[i] > r->stage[most] ? i : most;
        if (r->name[most] == NULL || r->stage[most] < 0.04 * r->alone)
            break;
        printf("%s %s %.2f", k == 0 ? "" : ",", r->name[most], r->stage[most] * 1e3);
        r->stage[most] = 0;
    }
    printf(" |\n");
    fflush(stdout);
}

static bool measure(const char *path, int width, int height, int threads, int frames, lom_error *error)
{
    lom_scene *scene = lom_read_scene(path, NULL, 0, error);
    lom_renderer *renderer =
        scene != NULL ? lom_create_renderer(scene, &(lom_device_desc){ .threads = threads }, error) : NULL;
    struct result least = { .alone = 1e300 };
    bool done = renderer != NULL;
    for (int i = 0; done && i < frames; i++) {
        lom_frame frame;
        begin_frame();
        done = lom_render_frame(renderer, &(lom_frame_desc){ .width = width, .height = height, .frame = i }, &frame,
                                error);
        end_alone();
        const struct result r = done ? take_result(&frame) : least;
        if (i > 0 && (least.alone > 1e299 || share_of(&r, threads) < share_of(&least, threads)))
            least = r;
        if (done)
            lom_free_image(frame.image);
    }
    if (done)
        print_row(path, width, height, &least, threads);
    lom_free_renderer(renderer);
    lom_free_scene(scene);
    return done;
}

int main(int argc, char **argv)
{
    int width = 0, height = 0, threads = 0, frames = 0;
    char x = 0;
    if (argc < 5 || sscanf(argv[1], "%d%c%d", &width, &x, &height) != 3 || (threads = atoi(argv[2])) < 1 ||
        threads > MAX_WORKERS || (frames = atoi(argv[3])) < 2) {
        fprintf(stderr, "serial WxH THREADS FRAMES SCENE...\n");
        return 2;
    }
    time_looks();
    printf("| scene | size | processor time, ms | alone, ms | share | runs | most of it, ms "
           "|\n|---|---|---|---|---|---|---|\n");
    for (int i = 4; i < argc; i++) {
        lom_error error = { .code = LOM_OK };
        if (!measure(argv[i], width, height, threads, frames, &error))
            fprintf(stderr, "%s\n", error.text);
    }
    return 0;
}
