/* Proves what a host may do with its own threads and processes: two renderers in two threads draw what one draws; a
 * child that is forked draws the same bytes with the thread it has, frees what it was given, and never waits for
 * threads that are not there; workers and callers do with the 128 KiB of stack that some systems give a thread. */
#include "check.h"
#include "small_scene.h"

#include <pthread.h>
#include <signal.h>
#include <sys/wait.h>

static const char more[] = "[clouds]\nshadows = true\n[[cloud]]\nkind = 'cumulus_mediocris'\nsize = [30, 12, 20]\n"
                           "position = [-5, 10, -20]\nvoxels = [8, 6, 8]\n[quality]\nterrain_shadows = true\n";
static const char *const models[] = { "quality.water='planar'", "quality.water='displaced'", "quality.water='marched'",
                                      "quality.water='reference'" };
enum { MODELS = 4, THREADS = 3 };
static uint64_t expected[MODELS];

static lom_renderer *open_model(lom_scene **scene, int model, int threads, lom_error *error)
{
    *scene = lom_read_scene(small_path("host.toml"), &models[model], 1, error);
    return *scene == NULL
               ? NULL
               : lom_create_renderer(*scene, &(lom_device_desc){ .threads = threads, .tile = 16, .chunk = 16 }, error);
}

/* 0 after a failure. */
static uint64_t draw(lom_renderer *renderer, lom_error *error)
{
    lom_frame frame;
    uint64_t hash =
        renderer != NULL && lom_render_frame(renderer, NULL, &frame, error) ? lom_hash_image(frame.image) : 0;
    if (renderer != NULL)
        lom_free_image(frame.image);
    return hash;
}

static uint64_t draw_model(int model, int threads, lom_error *error)
{
    lom_scene *scene;
    lom_renderer *renderer = open_model(&scene, model, threads, error);
    uint64_t hash = draw(renderer, error);
    lom_free_renderer(renderer);
    lom_free_scene(scene);
    return hash;
}

/* ---- threads of the host ---- */

struct drawing {
    int model, threads;
    uint64_t hash;
    lom_error error;
};

static void *draw_in_thread(void *context)
{
    struct drawing *d = context;
    d->hash = draw_model(d->model, d->threads, &d->error);
    return NULL;
}

static void two_devices_in_two_threads(void)
{
    for (int model = 0; model < MODELS; model++) {
        struct drawing both[2] = { { .model = model, .threads = THREADS }, { .model = model, .threads = 2 } };
        pthread_t thread[2];
        for (int i = 0; i < 2; i++)
            CHECK(pthread_create(&thread[i], NULL, draw_in_thread, &both[i]) == 0, "no thread");
        for (int i = 0; i < 2; i++) {
            pthread_join(thread[i], NULL);
            CHECK(both[i].hash == expected[model], "%s: another picture; %s", models[model], both[i].error.text);
        }
    }
}

/* ---- stacks ---- */

/* The caller has what musl gives a thread; with the workers asking for what they need, nothing else is small. */
static void a_caller_with_a_small_stack(void)
{
    for (int model = 0; model < MODELS; model++) {
        struct drawing drawing = { .model = model, .threads = THREADS };
        pthread_attr_t attributes;
        pthread_t thread;
        pthread_attr_init(&attributes);
        CHECK(pthread_attr_setstacksize(&attributes, 128 << 10) == 0, "no stack of 128 KiB");
        CHECK(pthread_create(&thread, &attributes, draw_in_thread, &drawing) == 0, "no thread");
        pthread_join(thread, NULL);
        pthread_attr_destroy(&attributes);
        CHECK(drawing.hash == expected[model], "%s: another picture; %s", models[model], drawing.error.text);
    }
}

/* New threads have 128 KiB unless they ask for more. */
static void workers_where_stacks_are_small(void)
{
#ifdef __GLIBC__
    pthread_attr_t small, usual;
    CHECK(pthread_getattr_default_np(&usual) == 0 && pthread_attr_init(&small) == 0, "no attributes");
    CHECK(pthread_attr_setstacksize(&small, 128 << 10) == 0 && pthread_setattr_default_np(&small) == 0, "no 128 KiB");
    for (int model = 0; model < MODELS; model++) {
        lom_error error = { 0 };
        uint64_t hash = draw_model(model, THREADS, &error);
        CHECK(hash == expected[model], "%s: another picture; %s", models[model], error.text);
    }
    pthread_setattr_default_np(&usual);
    pthread_attr_destroy(&small);
    pthread_attr_destroy(&usual);
#endif
}

/* ---- forks ---- */

enum { CHILD_SECONDS = 60 };

/* How a child ends that draws with the parent's renderer and frees it: 0, 1 without a picture, 2 with another. */
static int draw_in_child(lom_renderer *renderer, uint64_t whole)
{
    fflush(stdout);
    pid_t child = fork();
    if (child == 0) {
        alarm(CHILD_SECONDS);
        lom_error error = { 0 };
        uint64_t hash = draw(renderer, &error);
        lom_free_renderer(renderer);
        _exit(hash == whole ? 0 : hash == 0 ? 1 : 2);
    }
    int status = -1;
    waitpid(child, &status, 0);
    return status;
}

/* ThreadSanitizer ends a child of several threads that starts another, as the reference does for each frame. */
#if defined __SANITIZE_THREAD__
#define ENDS_CHILDREN 1
#elif defined __has_feature
#if __has_feature(thread_sanitizer)
#define ENDS_CHILDREN 1
#endif
#endif

static bool is_skipped(int model)
{
#ifdef ENDS_CHILDREN
    if (strstr(models[model], "reference") != NULL) {
        printf("SKIP a_forked_child_draws_and_frees, %s: ThreadSanitizer lets no forked child start threads\n",
               models[model]);
        return true;
    }
#endif
    (void)model;
    return false;
}

static void a_forked_child_draws_and_frees(void)
{
    for (int model = 0; model < MODELS; model++) {
        if (is_skipped(model))
            continue;
        lom_error error = { 0 };
        lom_scene *scene;
        lom_renderer *renderer = open_model(&scene, model, THREADS, &error);
        int before = draw_in_child(renderer, expected[model]);
        CHECK(before == 0, "%s: a child before the first frame ends with %d (%d: it waited without end)", models[model],
              before, SIGALRM);
        CHECK(draw(renderer, &error) == expected[model], "%s: the parent draws another; %s", models[model], error.text);
        int after = draw_in_child(renderer, expected[model]);
        CHECK(after == 0, "%s: a child after it ends with %d (%d: it waited without end)", models[model], after,
              SIGALRM);
        CHECK(draw(renderer, &error) == expected[model], "%s: after the child the parent draws another; %s",
              models[model], error.text);
        lom_free_renderer(renderer);
        lom_free_scene(scene);
    }
}

static bool prepare(void)
{
    char text[4000];
    lom_error error = { 0 };
    if (!make_small_scene())
        return false;
    snprintf(text, sizeof text, "%s%s", small_scene, more);
    bool done = small_text("host.toml", text, &error);
    for (int model = 0; done && model < MODELS; model++) {
        expected[model] = draw_model(model, 1, &error);
        done = expected[model] != 0;
    }
    if (!done)
        printf("FAIL test_host: %s\n", error.text);
    return done;
}

int main(int argc, char **argv)
{
    bool ready = prepare();
    if (ready) {
        RUN(two_devices_in_two_threads);
        RUN(a_caller_with_a_small_stack);
        RUN(workers_where_stacks_are_small);
        RUN(a_forked_child_draws_and_frees);
    }
    remove_small_scene();
    return ready ? check_result() : 1;
}
