/* `lom cost`. In: a scene, a run of its frames. Out: how many frames a core draws in an hour. Invariant: a few frames are
 * drawn, spread over the run; what a frame between two of them costs follows from the declared work of these, and what
 * this machine takes for a unit of it from their processor time. Work is counted where `lom tune` counts it. */
#include "commands.h"
#include "json.h"
#include "scene_options.h"

#include "measure/work.h"

#include <time.h>

struct values {
    struct lom_scene_options scene;
    lom_option_integers frames, draw;
    bool json;
};

enum { DRAWN = 5, MOST_DRAWN = 1000 };

static const lom_option options[] = {
    { "frames", 0, LOM_OPTION_INTEGER, offsetof(struct values, frames), "A:B|all", 0, 1e9,
      "the run: frames A to B, both included; all of the scene when not given" },
    { "draw", 0, LOM_OPTION_INTEGER, offsetof(struct values, draw), "K", 1, MOST_DRAWN,
      "how many of them are drawn, 5 when not given" },
    LOM_SCENE_OPTIONS(struct values),
    { "json", 0, LOM_OPTION_FLAG, offsetof(struct values, json), NULL, 0, 0, "one JSON object" },
};

static const lom_command_line line = {
    .name = "cost",
    .arguments = "SCENE",
    .summary = "say how many frames of a run a core draws in an hour",
    .details =
        "Draws a few frames by one thread (--threads: by more), each as in a run, and again to count their work,\n"
        "which is the same number on every machine. See docs/many-machines.md.",
    .options = options,
    .option_count = sizeof options / sizeof options[0],
    .minimum_arguments = 1,
    .maximum_arguments = 1,
};

/* A frame that was drawn. */
struct drawn {
    int number;
    double drawn;   /* the work of what was done here */
    double work;    /* of what a run does for it: steps of simulations from the frame before alone */
    double seconds; /* of processor time, here */
};

struct estimate {
    int first, last, count;
    double loading; /* seconds */
    struct drawn drawn[MOST_DRAWN];
    /* What follows. */
    double unit;    /* seconds this machine takes for one of declared work */
    double seconds; /* of all frames */
};

static double processor_seconds(void)
{
    struct timespec now;
#ifdef CLOCK_PROCESS_CPUTIME_ID
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
#else
    clock_gettime(CLOCK_MONOTONIC, &now);
#endif
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Spread evenly, the first and the last among them. */
static int number_of(const struct estimate *e, int index)
{
    if (e->count == 1)
        return e->first;
    return e->first + (int)((int64_t)(e->last - e->first) * index / (e->count - 1));
}

/* ---- the frames ---- */

static bool time_frame(struct drawn *drawn, lom_renderer *renderer, const lom_frame_desc *desc, lom_error *error)
{
    lom_frame frame;
    const double start = processor_seconds();
    const bool done = lom_render_frame(renderer, desc, &frame, error);
    drawn->seconds = processor_seconds() - start;
    lom_free_image(frame.image);
    return done;
}

/* What is simulated from the frame drawn before on is shared by the frames between. */
static bool count_frame(struct drawn *drawn, lom_renderer *renderer, const lom_scene *scene, const lom_frame_desc *desc,
                        int frames, lom_error *error)
{
    lom_declared_work work;
    if (!lom_count_work(renderer, scene, desc, &work, error))
        return false;
    drawn->drawn = (double)lom_weigh_work(&work);
    work.count[LOM_WORK_SHALLOW] /= (uint64_t)frames;
    work.count[LOM_WORK_PARTICLES] /= (uint64_t)frames;
    drawn->work = (double)lom_weigh_work(&work);
    return true;
}

/* A frame that is the first of its renderer touches memory and fills what later frames find: it is drawn before any that
 * counts, and what it takes beyond that is loading. */
static bool draw_frames(struct estimate *e, const struct values *v, const lom_scene *scene, lom_renderer *renderer,
                        bool timed, lom_error *error)
{
    bool done = true;
    for (int i = -1; i < e->count && done; i++) {
        struct drawn *drawn = &e->drawn[i < 0 ? 0 : i];
        const double before = i == 0 ? drawn->seconds : 0; /* of the same frame, the first time */
        lom_frame_desc desc = lom_frame_of_options(&v->scene, number_of(e, i < 0 ? 0 : i));
        desc.continues = true;
        drawn->number = desc.frame;
        done = timed ? time_frame(drawn, renderer, &desc, error)
                     : count_frame(drawn, renderer, scene, &desc, i > 0 ? desc.frame - drawn[-1].number : 1, error);
        if (timed)
            e->loading += before > drawn->seconds ? before - drawn->seconds : 0;
    }
    return done;
}

/* Work is linear between two frames that were drawn. */
static void conclude(struct estimate *e)
{
    double work = 0, seconds = 0, total = e->drawn[e->count - 1].work;
    for (int i = 0; i < e->count; i++) {
        work += e->drawn[i].drawn;
        seconds += e->drawn[i].seconds;
    }
    for (int i = 0; i + 1 < e->count; i++) {
        double between = e->drawn[i + 1].number - e->drawn[i].number; /* with the first of the two */
        total += between * e->drawn[i].work + (between - 1) / 2 * (e->drawn[i + 1].work - e->drawn[i].work);
    }
    e->unit = seconds / work;
    e->seconds = total * e->unit;
}

static void print_json(const struct estimate *e)
{
    double frames = (double)(e->last - e->first) + 1;
    lom_json json = lom_json_begin(stdout);
    lom_json_number(&json, "frames", frames);
    lom_json_number(&json, "loading_seconds", e->loading);
    lom_json_number(&json, "seconds", e->seconds);
    lom_json_number(&json, "frames_per_core_hour", 3600 * frames / e->seconds);
    lom_json_number(&json, "work_per_second", 1 / e->unit);
    lom_json_nest(&json, "drawn", '[');
    for (int i = 0; i < e->count; i++) {
        lom_json_nest(&json, NULL, '{');
        lom_json_integer(&json, "frame", e->drawn[i].number);
        lom_json_number(&json, "work", e->drawn[i].work);
        lom_json_number(&json, "seconds", e->drawn[i].seconds);
        lom_json_unnest(&json, '}');
    }
    lom_json_unnest(&json, ']');
    lom_json_end(&json);
}

static void print_table(const struct estimate *e)
{
    double frames = (double)(e->last - e->first) + 1;
    printf("%8s %18s %14s\n", "frame", "million of work", "processor ms");
    for (int i = 0; i < e->count; i++)
        printf("%8d %18.2f %14.2f\n", e->drawn[i].number, 1e-6 * e->drawn[i].work, 1e3 * e->drawn[i].seconds);
    printf("loading a share    %.3g s\n", e->loading);
    printf("a million of work  %.3g ms here\n", 1e9 * e->unit);
    printf("a frame            %.4g ms\n", 1e3 * e->seconds / frames);
    printf("a core-hour        %.4g frames\n", 3600 * frames / e->seconds);
    printf("the run            %.4g core-hours, %.0f frames\n", e->seconds / 3600, frames);
}

static bool find_run(struct estimate *e, const struct values *v, const lom_scene *scene, lom_error *error)
{
    bool is_all = !v->frames.given || v->frames.is_word;
    e->first = is_all ? 0 : (int)v->frames.value[0];
    e->last = is_all ? scene->output.frames - 1 : (int)v->frames.value[1];
    if (e->last < e->first)
        return lom_fail(error, LOM_ERROR_USAGE, "--frames %d:%d ends before it begins.", e->first, e->last);
    int asked = v->draw.given ? (int)v->draw.value[0] : DRAWN;
    e->count = asked <= e->last - e->first ? asked : e->last - e->first + 1;
    return true;
}

static bool estimate_run(struct estimate *e, const struct values *v, const char *path, lom_error *error)
{
    double start = processor_seconds();
    lom_scene *scene = lom_open_scene(path, &v->scene, error);
    if (scene == NULL)
        return false;
    lom_device_desc device = lom_device_of_options(&v->scene);
    device.threads = device.threads > 0 ? device.threads : 1;
    lom_frame_desc desc = lom_frame_of_options(&v->scene, 0);
    bool done = find_run(e, v, scene, error) && lom_check_frame(scene, &desc, error);
    for (int timed = 1; timed >= 0 && done; timed--) {
        const lom_device_desc counting = lom_counting_device();
        lom_renderer *renderer = lom_create_renderer(scene, timed ? &device : &counting, error);
        if (timed)
            e->loading = processor_seconds() - start;
        done = renderer != NULL && draw_frames(e, v, scene, renderer, timed, error);
        lom_free_renderer(renderer);
    }
    if (done)
        conclude(e);
    lom_free_scene(scene);
    return done;
}

int lom_command_cost(int argc, char **argv)
{
    struct values values = { .json = false };
    lom_arguments arguments;
    lom_error error = { .code = LOM_OK };
    int status;
    if (!lom_parse_options(&line, argc, argv, &values, &arguments, &status))
        return status;
    struct estimate *estimate = lom_allocate(1, sizeof *estimate, &error);
    bool done = estimate != NULL && estimate_run(estimate, &values, arguments.items[0], &error);
    if (done && values.json)
        print_json(estimate);
    else if (done)
        print_table(estimate);
    lom_release(estimate);
    return done ? LOM_EXIT_DONE : lom_complain_error(&error);
}
