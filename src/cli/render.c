/* `lom render`. In: a scene; out: pictures, hashes, statistics. With --watch it goes on, drawing again whenever the
 * scene or a file it names changes, also after an error in them. */
#include "commands.h"
#include "json.h"
#include "progress.h"
#include "scene_options.h"

#include <lom/lom.h>

#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

struct values {
    struct lom_scene_options scene;
    const char *output, *stats, *format;
    lom_option_integers frame, frames;
    bool hash, watch, check, quiet;
};

static const lom_option options[] = {
    { "output", 'o', LOM_OPTION_TEXT, offsetof(struct values, output), "OUT", 0, 0,
      "the picture; %04d stands for the number of the frame, - is stdout" },
    { "frame", 0, LOM_OPTION_INTEGER, offsetof(struct values, frame), "N", 0, 1e9,
      "the frame to draw, 0 when not given" },
    { "frames", 0, LOM_OPTION_INTEGER, offsetof(struct values, frames), "A:B", 0, 1e9,
      "draw frames A to B, both included" },
    LOM_SCENE_OPTIONS(struct values),
    { "hash", 0, LOM_OPTION_FLAG, offsetof(struct values, hash), NULL, 0, 0, "print \"HASH  frame N\" for each frame" },
    { "stats", 0, LOM_OPTION_TEXT, offsetof(struct values, stats), "FILE", 0, 0,
      "write a JSON line a frame with its passes, work and time; - is stdout" },
    { "watch", 0, LOM_OPTION_FLAG, offsetof(struct values, watch), NULL, 0, 0,
      "draw again whenever the scene or one of its files changes" },
    { "check", 0, LOM_OPTION_FLAG, offsetof(struct values, check), NULL, 0, 0,
      "refuse (exit 1) a picture that is one single colour or held NaN" },
    { "format", 0, LOM_OPTION_CHOICE, offsetof(struct values, format), "png|ppm|pgm|pam|pfm|y4m", 0, 0,
      "the kind of picture, whatever the name ends in" },
    { "quiet", 'q', LOM_OPTION_FLAG, offsetof(struct values, quiet), NULL, 0, 0, "no progress bar" },
};

static const lom_command_line line = {
    .name = "render",
    .arguments = "SCENE -o OUT",
    .summary = "draw a scene",
    .details = "OUT is png, ppm, pgm, pam, pfm or y4m by its ending. -o may be left out with --hash or --stats.\n"
               "Any frame alone has the bytes that it has in a run, unless quality.impostors is on.",
    .options = options,
    .option_count = sizeof options / sizeof options[0],
    .minimum_arguments = 1,
    .maximum_arguments = 1,
};

/* What is open while frames are drawn. */
struct run {
    const struct values *values;
    lom_scene *scene;
    lom_renderer *renderer;
    FILE *video; /* of y4m, until the run ends */
    char video_path[4096];
    FILE *stats;
    bool rejected;
};

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* OUT with its %d or %0Nd replaced by the frame's number; false when it is too long or has another %. */
static bool name_frame(char *name, size_t room, const char *pattern, int frame, lom_error *error)
{
    const char *mark = strchr(pattern, '%');
    int digits = 0, length;
    if (mark == NULL) {
        length = snprintf(name, room, "%s", pattern);
    } else {
        const char *end = mark + 1;
        while (*end >= '0' && *end <= '9' && digits < 100)
            digits = digits * 10 + (*end++ - '0');
        if (*end != 'd' || strchr(end, '%') != NULL || digits > 20)
            return lom_fail(error, LOM_ERROR_USAGE, "%s: the frame's number is written as %%d or %%04d, once.",
                            pattern);
        length = snprintf(name, room, "%.*s%0*d%s", (int)(mark - pattern), pattern, digits, frame, end + 1);
    }
    if (length < 0 || (size_t)length >= room)
        return lom_fail(error, LOM_ERROR_USAGE, "%s: the name is too long.", pattern);
    return true;
}

static bool is_video(const struct values *v)
{
    if (v->format != NULL)
        return strcmp(v->format, "y4m") == 0;
    size_t length = v->output == NULL ? 0 : strlen(v->output);
    return length > 4 && strcmp(v->output + length - 4, ".y4m") == 0;
}

/* A video grows beside its final name and is renamed when it is whole. */
static bool append_to_video(struct run *run, lom_bytes part, lom_error *error)
{
    bool done = part.data != NULL && fwrite(part.data, 1, part.size, run->video) == part.size;
    if (part.data != NULL && !done)
        lom_fail(error, LOM_ERROR_FILE, "%s: not everything could be written.", run->values->output);
    lom_release(part.data);
    return done;
}

static bool open_video(struct run *run, const lom_image *image, lom_error *error)
{
    const char *path = run->values->output;
    if (strcmp(path, "-") == 0) {
        run->video = stdout;
    } else {
        int length = snprintf(run->video_path, sizeof run->video_path, "%s.part", path);
        run->video = length > 0 && (size_t)length < sizeof run->video_path ? fopen(run->video_path, "wb") : NULL;
    }
    if (run->video == NULL)
        return lom_fail(error, LOM_ERROR_FILE, "%s: the file cannot be written.", path);
    int rate = (int)(run->scene->output.fps * 1000 + 0.5);
    return append_to_video(run, lom_encode_y4m_header(image->width, image->height, rate, 1000, error), error);
}

static bool close_video(struct run *run, bool keep, lom_error *error)
{
    if (run->video == NULL || run->video == stdout)
        return true;
    bool whole = fflush(run->video) == 0 && fsync(fileno(run->video)) == 0;
    whole = fclose(run->video) == 0 && whole;
    run->video = NULL;
    if (keep && whole && rename(run->video_path, run->values->output) == 0)
        return true;
    remove(run->video_path);
    return !keep || lom_fail(error, LOM_ERROR_FILE, "%s: not everything could be written.", run->values->output);
}

static bool write_frame(struct run *run, const lom_image *image, int frame, lom_error *error)
{
    const struct values *v = run->values;
    char name[4096];
    if (v->output == NULL)
        return true;
    if (is_video(v))
        return (run->video != NULL || open_video(run, image, error)) &&
               append_to_video(run, lom_encode_y4m_frame(image, error), error);
    if (!name_frame(name, sizeof name, v->output, frame, error))
        return false;
    const char *kind = v->format == NULL && strcmp(name, "-") == 0 ? "png" : v->format;
    return lom_write_image(name, kind, image, error);
}

static void print_stats(const struct run *run, const lom_frame *frame, int number, double elapsed)
{
    const lom_counters *c = &frame->counters;
    lom_device_desc device = lom_describe_device(lom_renderer_device(run->renderer));
    const struct {
        const char *name;
        uint64_t value;
    } facts[] = { { "threads", (uint64_t)device.threads },
                  { "lanes", (uint64_t)device.lanes },
                  { "passes", c->passes },
                  { "draws", c->draws },
                  { "vertices", c->vertices },
                  { "triangles", c->triangles },
                  { "triangles_clipped", c->triangles_clipped },
                  { "triangles_binned", c->triangles_binned },
                  { "fragments", c->fragments },
                  { "packets", c->packets },
                  { "tiles", c->tiles },
                  { "transforms", c->transforms },
                  { "impostors_shown", (uint64_t)frame->impostors.plates },
                  { "impostors_refreshed", (uint64_t)frame->impostors.refreshed },
                  { "impostors_reused", (uint64_t)frame->impostors.reused },
                  { "impostors_split", (uint64_t)frame->impostors.split },
                  { "impostors_skipped", (uint64_t)frame->impostors.skipped },
                  { "clouds_culled", (uint64_t)frame->impostors.culled },
                  { "shallow_steps", frame->shallow_steps },
                  { "drops_moved", frame->spray.moved },
                  { "drops_drawn", frame->spray.drawn } };
    char ran[LOM_MAX_STEPS * 25] = "";
    size_t length = 0;
    lom_json json = lom_json_begin(run->stats);
    lom_json_integer(&json, "frame", number);
    lom_json_number(&json, "ms", elapsed * 1e3);
    for (size_t i = 0; i < sizeof facts / sizeof facts[0]; i++)
        lom_json_integer(&json, facts[i].name, (int64_t)facts[i].value);
    for (int i = 0; i < frame->plan.count; i++)
        if (frame->plan.step[i].runs)
            length += (size_t)snprintf(ran + length, sizeof ran - length, "%s%s", length > 0 ? " " : "",
                                       frame->plan.step[i].name);
    for (int i = 0; i < LOM_MAX_STAGES && frame->stage[i].name != NULL; i++) {
        char name[48];
        snprintf(name, sizeof name, "ms_%s", frame->stage[i].name);
        lom_json_number(&json, name, frame->stage[i].milliseconds);
    }
    lom_json_text(&json, "ran", ran);
    lom_json_end(&json);
}

/* One single colour, or a number that is none. */
static bool is_suspicious(const lom_image *image)
{
    size_t size = lom_format_size(image->format), count = lom_image_size(image) / size;
    bool same = true;
    for (size_t i = 1; i < count && same; i++)
        same = memcmp(image->pixels, image->pixels + i * size, size) == 0;
    if (same && count > 1)
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

static void move_bar(void *context, const char *pass, double done)
{
    const struct moving *moving = context;
    lom_show_progress(&moving->bar, moving->before + done, pass);
}

static bool draw_frame(struct run *run, int number, struct moving *moving, lom_error *error)
{
    const struct values *v = run->values;
    lom_frame_desc desc = lom_frame_of_options(&v->scene, number);
    desc.progress = move_bar;
    desc.progress_context = moving;
    lom_frame frame;
    double start = seconds();
    if (!lom_render_frame(run->renderer, &desc, &frame, error))
        return false;
    double elapsed = seconds() - start;
    if (v->check && is_suspicious(frame.image)) {
        fprintf(stderr, "lom: frame %d is one single colour, or held a number that is none.\n", number);
        run->rejected = true;
    }
    bool done = write_frame(run, frame.image, number, error);
    if (done && v->hash)
        printf("%016llx  frame %d\n", (unsigned long long)lom_hash_image(frame.image), number);
    if (done && run->stats != NULL)
        print_stats(run, &frame, number, elapsed);
    lom_free_image(frame.image);
    return done;
}

static bool draw_frames(struct run *run, lom_error *error)
{
    const struct values *v = run->values;
    int first = v->frame.given ? (int)v->frame.value[0] : 0, last = first;
    if (v->frames.given) {
        first = (int)v->frames.value[0];
        last = (int)v->frames.value[1];
    }
    if (last < first)
        return lom_fail(error, LOM_ERROR_USAGE, "--frames %d:%d ends before it begins.", first, last);
    if (last > first && v->output != NULL && !is_video(v) && strchr(v->output, '%') == NULL)
        return lom_fail(error, LOM_ERROR_USAGE, "%s: several frames need a %%04d in the name, or y4m.", v->output);
    struct moving moving = { lom_begin_progress("lom render", last - first + 1, v->quiet), 0 };
    bool done = true;
    for (int n = first; done && n <= last; n++) {
        moving.before = n - first;
        done = draw_frame(run, n, &moving, error);
    }
    lom_end_progress(&moving.bar);
    return close_video(run, done, error) && done;
}

static bool open_stats(struct run *run, lom_error *error)
{
    const char *path = run->values->stats;
    if (path == NULL)
        return true;
    run->stats = strcmp(path, "-") == 0 ? stdout : fopen(path, "w");
    return run->stats != NULL || lom_fail(error, LOM_ERROR_FILE, "%s: the file cannot be written.", path);
}

static bool close_stats(struct run *run, lom_error *error)
{
    if (run->stats == NULL || run->stats == stdout)
        return true;
    bool failed = ferror(run->stats) != 0;
    failed |= fclose(run->stats) != 0;
    return !failed || lom_fail(error, LOM_ERROR_FILE, "%s: not everything could be written.", run->values->stats);
}

/* Draws once; the scene stays open for --watch to see which files it names. */
static bool render_once(struct run *run, const char *path, lom_error *error)
{
    const struct values *v = run->values;
    lom_device_desc device = lom_device_of_options(&v->scene);
    run->scene = lom_open_scene(path, &v->scene, error);
    if (run->scene == NULL)
        return false;
    run->renderer = lom_create_renderer(run->scene, &device, error);
    if (run->renderer != NULL && !v->quiet)
        lom_tell_warnings(lom_renderer_warning(run->renderer), lom_renderer_warning_count(run->renderer));
    bool done = run->renderer != NULL && open_stats(run, error) && draw_frames(run, error);
    return close_stats(run, error) && done;
}

static void close_run(struct run *run)
{
    lom_free_renderer(run->renderer);
    lom_free_scene(run->scene);
    *run = (struct run){ .values = run->values };
}

/* ---- watching ---- */

enum { MAX_WATCHED = 4096 };

struct watched {
    size_t count;
    char *path[MAX_WATCHED];
};

static void watch_file(struct watched *w, const char *path)
{
    size_t size = strlen(path) + 1;
    char *copy = w->count < MAX_WATCHED ? lom_allocate(size, 1, NULL) : NULL;
    if (copy != NULL)
        w->path[w->count++] = memcpy(copy, path, size);
}

static void forget(struct watched *w)
{
    for (size_t i = 0; i < w->count; i++)
        lom_release(w->path[i]);
    w->count = 0;
}

/* A number that changes when one of the files is written, replaced, removed or comes back. */
static uint64_t fingerprint(const struct watched *w)
{
    uint64_t hash = LOM_HASH_START;
    for (size_t i = 0; i < w->count; i++) {
        struct stat s;
        int64_t facts[4] = { -1, -1, -1, -1 };
        if (stat(w->path[i], &s) == 0) {
            facts[0] = (int64_t)s.st_mtim.tv_sec;
            facts[1] = (int64_t)s.st_mtim.tv_nsec;
            facts[2] = (int64_t)s.st_size;
            facts[3] = (int64_t)s.st_ino;
        }
        hash = lom_hash_bytes(hash, facts, sizeof facts);
    }
    return hash;
}

/* The files that an OBJ names: its materials and their pictures. */
static void watch_mesh(struct watched *w, const char *path)
{
    lom_bytes paths = lom_list_obj_files(path, NULL);
    for (size_t at = 0; at < paths.size; at += strlen((const char *)paths.data + at) + 1)
        watch_file(w, (const char *)paths.data + at);
    lom_release(paths.data);
}

static bool is_mesh(const lom_scene *scene, const char *path)
{
    for (size_t i = 0; i < scene->entity_count; i++)
        if (scene->entities[i].mesh != NULL && strcmp(scene->entities[i].mesh, path) == 0)
            return true;
    return false;
}

/* After an error the files of the last good scene are watched as well, since the new ones are not known. */
static void watch_scene(struct watched *w, const struct run *run, const char *path)
{
    size_t count = 0;
    const char *const *files = run->scene == NULL ? NULL : lom_scene_files(run->scene, &count);
    if (files == NULL) {
        if (w->count == 0)
            watch_file(w, path);
        return;
    }
    forget(w);
    for (size_t i = 0; i < count; i++) {
        watch_file(w, files[i]);
        if (is_mesh(run->scene, files[i]))
            watch_mesh(w, files[i]);
    }
}

static void watch(struct run *run, const char *path)
{
    struct watched watched = { .count = 0 };
    for (;;) {
        lom_error error = { .code = LOM_OK };
        uint64_t before = fingerprint(&watched);
        if (!render_once(run, path, &error))
            lom_complain_error(&error);
        else
            fprintf(stderr, "lom: drawn; waiting for a change (ctrl-C ends)\n");
        fflush(stdout);
        size_t had = watched.count;
        watch_scene(&watched, run, path);
        if (had == 0 || run->scene != NULL)
            before = fingerprint(&watched);
        close_run(run);
        while (fingerprint(&watched) == before)
            nanosleep(&(struct timespec){ .tv_nsec = 50000000 }, NULL);
    }
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
    if (values.frame.given && values.frames.given)
        return lom_complain("--frame and --frames exclude one another.");
    struct run run = { .values = &values };
    if (values.watch)
        watch(&run, arguments.items[0]);
    lom_error error = { .code = LOM_OK };
    bool done = render_once(&run, arguments.items[0], &error);
    bool rejected = run.rejected;
    close_run(&run);
    if (!done)
        return lom_complain_error(&error);
    return rejected ? LOM_EXIT_DIFFERS : LOM_EXIT_DONE;
}
