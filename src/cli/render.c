/* `lom render`. In: a scene; out: pictures, hashes, statistics. With --watch it goes on, drawing again whenever the
 * scene or a file it names changes, also after an error in them. */
#include "commands.h"
#include "frame_output.h"
#include "frame_stats.h"
#include "one_colour.h"
#include "picture_kinds.h"
#include "progress.h"
#include "scene_options.h"
#include "shard.h"
#include "show_pass.h"
#include "watch.h"

#include <lom/lom.h>

#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

struct values {
    struct lom_scene_options scene;
    const char *output, *stats, *format, *show;
    lom_option_integers frame, frames, shard;
    bool hash, watch, check, resume, quiet;
};

static const lom_option options[] = {
    { "output", 'o', LOM_OPTION_TEXT, offsetof(struct values, output), "OUT", 0, 0,
      "the picture; %04d in its name is the frame's number, %% one %; - is stdout" },
    { "frame", 0, LOM_OPTION_INTEGER, offsetof(struct values, frame), "N", 0, 1e9,
      "the frame to draw, 0 when not given" },
    { "frames", 0, LOM_OPTION_INTEGER, offsetof(struct values, frames), "A:B|all", 0, 1e9,
      "draw frames A to B, both included, or all of the scene" },
    LOM_SCENE_OPTIONS(struct values),
    { "hash", 0, LOM_OPTION_FLAG, offsetof(struct values, hash), NULL, 0, 0, "print \"HASH  frame N\" for each frame" },
    { "shard", 0, LOM_OPTION_INTEGER, offsetof(struct values, shard), "I/N", 1, 1e6,
      "draw the I-th of N shares of the frames, a part that lom join reads" },
    { "resume", 0, LOM_OPTION_FLAG, offsetof(struct values, resume), NULL, 0, 0,
      "with --shard: nothing is drawn where the part is whole already" },
    { "stats", 0, LOM_OPTION_TEXT, offsetof(struct values, stats), "FILE", 0, 0,
      "write a JSON line a frame with its passes, work and time; - is stdout" },
    { "show", 0, LOM_OPTION_TEXT, offsetof(struct values, show), "PASS", 0, 0,
      "the picture of a pass instead: raw numbers as .pfm, .npy and .nrrd, else for eyes" },
    { "watch", 0, LOM_OPTION_FLAG, offsetof(struct values, watch), NULL, 0, 0,
      "draw again whenever the scene or one of its files changes" },
    { "check", 0, LOM_OPTION_FLAG, offsetof(struct values, check), NULL, 0, 0,
      "refuse (exit 1) a picture that is one single colour or held NaN" },
    { "format", 0, LOM_OPTION_CHOICE, offsetof(struct values, format), NULL, 0, 0,
      "the kind of picture, whatever the name ends in" },
    { "quiet", 'q', LOM_OPTION_FLAG, offsetof(struct values, quiet), NULL, 0, 0, "no progress bar" },
};

static const lom_command_line line = {
    .name = "render",
    .arguments = "SCENE -o OUT",
    .summary = "draw a scene",
    .choice = lom_frame_choice,
    .details = "The kind of OUT is its ending or --format. -o may be left out with --hash or --stats.\n"
               "Other videos are made of y4m: lom render SCENE --frames all -o - --format y4m | ffmpeg -i - OUT.mp4\n"
               "Any frame alone has the bytes that it has in a run, unless quality.impostors is on.",
    .options = options,
    .option_count = sizeof options / sizeof options[0],
    .minimum_arguments = 1,
    .maximum_arguments = 1,
    .print_more = lom_print_shown_passes,
};

/* What is open while frames are drawn. */
struct run {
    const struct values *values;
    struct lom_watched *watched; /* NULL: draws once */
    lom_scene *scene;
    lom_renderer *renderer;
    struct lom_frame_output output;
    lom_writer *stats;
    bool rejected;
};

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* One single colour, or a number that is none. */
static bool is_suspicious(const lom_image *image)
{
    if (lom_is_one_colour(image))
        return true;
    if (!lom_describe_format(image->format)->is_float)
        return false;
    const float *samples = (const float *)(const void *)image->pixels;
    for (size_t i = 0; i < lom_image_size(image) / sizeof(float); i++)
        if (samples[i] != samples[i])
            return true;
    return false;
}

/* The bar, and how many frames are before this one. */
struct moving {
    struct lom_progress bar;
    int before;
};

static bool move_bar(void *context, const char *pass, double done)
{
    const struct moving *moving = context;
    lom_show_progress(&moving->bar, moving->before + done, pass);
    return true;
}

static bool draw_frame(struct run *run, int number, struct moving *moving, lom_error *error)
{
    const struct values *v = run->values;
    lom_frame_desc desc = lom_frame_of_options(&v->scene, number);
    if (v->show != NULL && desc.view == NULL)
        desc.view = LOM_MAIN_VIEW;
    desc.progress = move_bar;
    desc.progress_context = moving;
    lom_frame frame;
    double start = seconds();
    if (!lom_render_frame(run->renderer, &desc, &frame, error))
        return false;
    double elapsed = seconds() - start;
    if (v->show != NULL && !lom_take_shown_pass(run->renderer, &desc, v->show, lom_shows_numbers(v->output, v->format),
                                                &frame.image, error))
        return false;
    if (v->check && is_suspicious(frame.image)) {
        fprintf(stderr, "lom: frame %d is one single colour, or held a number that is none.\n", number);
        run->rejected = true;
    }
    bool done = lom_write_frame(&run->output, frame.image, number, error);
    if (done && v->hash)
        printf("%016llx  frame %d\n", (unsigned long long)lom_hash_image(frame.image), number);
    if (done && run->stats != NULL)
        done = lom_append_stats(run->stats, run->renderer, &frame, number, elapsed, error);
    lom_free_image(frame.image);
    return done;
}

/* The frames that were asked for, *first to *last. */
static void find_frames(const struct run *run, int *first, int *last)
{
    const struct values *v = run->values;
    *first = *last = (int)lom_given_or(&v->frame, 0);
    if (v->frames.given) {
        *first = v->frames.is_word ? 0 : (int)v->frames.value[0];
        *last = v->frames.is_word ? run->scene->output.frames - 1 : (int)v->frames.value[1];
    }
}

/* The share of --shard. */
static struct lom_shard find_shard(const struct run *run)
{
    const struct values *v = run->values;
    struct lom_shard shard = { .pattern = v->output,
                               .resume = v->resume,
                               .quiet = v->quiet,
                               .shard = (int)v->shard.value[0],
                               .shards = (int)v->shard.value[1],
                               .options = &v->scene };
    find_frames(run, &shard.first, &shard.last);
    return shard;
}

static bool draw_frames(struct run *run, lom_error *error)
{
    const struct values *v = run->values;
    int first, last;
    find_frames(run, &first, &last);
    struct moving moving = { lom_begin_progress("lom render", last - first + 1, v->quiet), 0 };
    bool done = true;
    for (int n = first; done && n <= last; n++) {
        moving.before = n - first;
        done = draw_frame(run, n, &moving, error);
    }
    lom_end_progress(&moving.bar);
    return lom_end_frame_output(&run->output, done, error) && done;
}

/* What can be refused before the scene's files are read and anything is drawn. */
static bool check_run(const struct run *run, lom_error *error)
{
    const struct values *v = run->values;
    int first, last;
    find_frames(run, &first, &last);
    if (last < first)
        return lom_fail(error, LOM_ERROR_USAGE, "--frames %d:%d ends before it begins.", first, last);
    lom_frame_desc desc = lom_frame_of_options(&v->scene, first);
    lom_output_format format = v->show == NULL                           ? (lom_output_format)run->scene->output.format
                               : lom_shows_numbers(v->output, v->format) ? LOM_OUTPUT_RGB32F
                                                                         : LOM_OUTPUT_RGB8;
    if (v->shard.given) {
        struct lom_shard shard = find_shard(run);
        return lom_check_shard(&shard, run->scene, error);
    }
    return (v->show == NULL || lom_check_shown_pass(v->show, error)) && lom_check_frame(run->scene, &desc, error) &&
           lom_check_frame_output(&run->output, format, last - first + 1, error);
}

static bool open_stats(struct run *run, lom_error *error)
{
    const char *path = run->values->stats;
    run->stats = path != NULL ? lom_open_writer(path, error) : NULL;
    return path == NULL || run->stats != NULL;
}

static bool close_stats(struct run *run, bool keep, lom_error *error)
{
    lom_writer *stats = run->stats;
    run->stats = NULL;
    if (stats != NULL && keep)
        return lom_close_writer(stats, error);
    lom_abandon_writer(stats);
    return true;
}

/* Of a scene with many frames one is drawn unless more are asked for, which surprises those who have just made it move.
 */
static void hint_at_frames(const struct run *run)
{
    const struct values *v = run->values;
    int frames = run->scene->output.frames;
    if (frames > 1 && v->output != NULL && !v->frame.given && !v->frames.given && !v->quiet && !v->watch)
        fprintf(stderr, "lom: frame 0 of the scene's %d is drawn; --frames all draws them all, --frame N another.\n",
                frames);
}

/* ---- drawing ---- */

/* What is open of a scene, whose renderer looks at it. */
static void drop_scene(struct run *run)
{
    lom_free_renderer(run->renderer);
    lom_free_scene(run->scene);
    run->renderer = NULL;
    run->scene = NULL;
}

/* Gives the run's scene a renderer: another one, or that of the scene before, which is freed. */
static bool provide_renderer(struct run *run, lom_scene *before, lom_error *error)
{
    static const char *const loaded[] = { [LOM_CHANGE_NONE] = "no key is another",
                                          [LOM_CHANGE_FRAME] = "nothing has to be loaded again",
                                          [LOM_CHANGE_PART] = "loaded again: ",
                                          [LOM_CHANGE_ALL] = "everything is loaded again" };
    const struct values *v = run->values;
    lom_device_desc device = lom_device_of_options(&v->scene);
    lom_change change = LOM_CHANGE_ALL;
    bool is_kept = run->renderer != NULL, done = check_run(run, error);
    if (done && !is_kept)
        run->renderer = lom_create_renderer(run->scene, &device, error);
    done = done && run->renderer != NULL && (!is_kept || lom_change_scene(run->renderer, run->scene, &change, error));
    if (!done) { /* it still looks at the scene before */
        lom_free_renderer(run->renderer);
        run->renderer = NULL;
    }
    lom_free_scene(before);
    if (done && !v->quiet && change >= LOM_CHANGE_PART)
        lom_tell_warnings(lom_renderer_warning(run->renderer), lom_renderer_warning_count(run->renderer));
    if (done && is_kept)
        fprintf(stderr, "lom: %s%s\n", loaded[change],
                change == LOM_CHANGE_PART ? lom_renderer_loaded(run->renderer) : "");
    return done;
}

/* What is drawn already is not loaded. */
static bool render_shard(struct run *run, const char *path, lom_error *error)
{
    struct lom_shard shard = find_shard(run);
    bool found = false, done = check_run(run, error) && lom_find_part(&shard, run->scene, path, &found, error);
    if (done && !found)
        done = provide_renderer(run, NULL, error) && lom_draw_shard(&shard, run->scene, path, run->renderer, error);
    return done;
}

/* After a failure the run has no scene, unless none could be read. */
static bool render_once(struct run *run, const char *path, lom_error *error)
{
    const struct values *v = run->values;
    lom_scene *before = run->scene, *scene = lom_open_scene(path, &v->scene, error);
    if (scene == NULL)
        return false;
    if (run->watched != NULL)
        lom_watch_scene(run->watched, scene);
    run->scene = scene;
    run->output = (struct lom_frame_output){ v->output, v->format, scene->output.fps, NULL };
    if (v->shard.given)
        return render_shard(run, path, error);
    bool done = provide_renderer(run, before, error);
    if (done)
        hint_at_frames(run);
    done = done && open_stats(run, error) && draw_frames(run, error);
    done = close_stats(run, done, error) && done;
    if (!done)
        drop_scene(run);
    return done;
}

/* After an error in the scene the files of the last good one are watched, since the new ones are not known. A renderer is
 * kept while the scene file alone is written. */
static void render_again_and_again(struct run *run, const char *path)
{
    struct lom_watched *watched = run->watched;
    lom_watch_file(watched, path);
    for (;;) {
        lom_error error = { .code = LOM_OK };
        if (lom_look_at_watched(watched))
            drop_scene(run);
        if (!render_once(run, path, &error))
            lom_complain_error(&error);
        else
            fprintf(stderr, "lom: drawn; waiting for a change (ctrl-C ends)\n");
        fflush(stdout);
        while (!lom_has_changed(watched))
            nanosleep(&(struct timespec){ .tv_nsec = 50000000 }, NULL);
    }
}

/* Two outputs into one would spoil both. Two into one device do no harm. */
static bool check_names(const struct values *v)
{
    bool picture = v->output != NULL && strcmp(v->output, "-") == 0;
    bool stats = v->stats != NULL && strcmp(v->stats, "-") == 0;
    struct stat status;
    if (picture && (stats || v->hash))
        return lom_complain("render: -o - writes to standard output, and %s does too.",
                            stats ? "--stats -" : "--hash") == 0;
    if (v->output == NULL || v->stats == NULL || stats || strcmp(v->output, v->stats) != 0)
        return true;
    return (stat(v->stats, &status) == 0 && !S_ISREG(status.st_mode)) ||
           lom_complain("render: --output and --stats are both %s.", v->stats) == 0;
}

/* A part holds pieces, which are no whole frames; it is for machines that work alone. */
static bool check_shard_options(const struct values *v)
{
    const struct {
        bool given;
        const char *name;
    } others[] = { { v->hash, "--hash (lom join has it)" },
                   { v->watch, "--watch" },
                   { v->check, "--check" },
                   { v->show != NULL, "--show" },
                   { v->stats != NULL, "--stats" },
                   { v->format != NULL, "--format (lom join has it)" },
                   { v->scene.view != NULL, "--view" } };
    for (size_t i = 0; i < sizeof others / sizeof others[0] && v->shard.given; i++)
        if (others[i].given)
            return lom_complain("render: --shard excludes %s.", others[i].name) == LOM_EXIT_DONE;
    return v->shard.given || !v->resume || lom_complain("render: --resume is of --shard.") == LOM_EXIT_DONE;
}

int lom_command_render(int argc, char **argv)
{
    struct values values = { .output = NULL };
    lom_arguments arguments;
    int status;
    if (!lom_parse_options(&line, argc, argv, &values, &arguments, &status))
        return status;
    if (values.output == NULL && !values.hash && values.stats == NULL && !values.check)
        return lom_complain("render needs -o OUT, or --hash, --stats or --check.");
    if (!check_names(&values))
        return LOM_EXIT_FAILED;
    if (values.frame.given && values.frames.given)
        return lom_complain("--frame and --frames exclude one another.");
    if (!check_shard_options(&values))
        return LOM_EXIT_FAILED;
    struct lom_watched watched = { .count = 0 };
    struct run run = { .values = &values, .watched = values.watch ? &watched : NULL };
    if (values.watch)
        render_again_and_again(&run, arguments.items[0]);
    lom_error error = { .code = LOM_OK };
    bool done = render_once(&run, arguments.items[0], &error);
    drop_scene(&run);
    if (!done)
        return lom_complain_error(&error);
    return run.rejected ? LOM_EXIT_DIFFERS : LOM_EXIT_DONE;
}
