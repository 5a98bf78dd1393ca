/* `lom verify`. In: a manifest of golden pictures. Out: what became of each, by hashes; new hashes in the manifest with
 * --approve. Invariant: no expected picture is needed; a picture is that of `lom render` with the line's options,
 * whatever was drawn before it; the manifest changes in the fields of approved hashes alone, and not after an error. */
#include "verify.h"

#include "commands.h"
#include "one_colour.h"
#include "paths.h"
#include "report.h"

#include "lanes/variants.h"

#include <string.h>

struct values {
    const char *junit, *output, *cache;
    lom_option_integers threads, line;
    bool twice, approve, quiet;
};

static const lom_option options[] = {
    { "approve", 0, LOM_OPTION_FLAG, offsetof(struct values, approve), NULL, 0, 0,
      "write the hashes of what was drawn into the manifest, and nothing else" },
    { "line", 0, LOM_OPTION_INTEGER, offsetof(struct values, line), "N", 1, 1e9,
      "only the picture of this line of the manifest" },
    { "twice", 0, LOM_OPTION_FLAG, offsetof(struct values, twice), NULL, 0, 0,
      "draw each again by other threads and lanes, which must give the same" },
    { "output", 'o', LOM_OPTION_TEXT, offsetof(struct values, output), "DIR", 0, 0,
      "write the pictures that fail, as DIR/LINE-SCENE.png (floats: .pfm)" },
    { "cache", 0, LOM_OPTION_TEXT, offsetof(struct values, cache), "DIR", 0, 0,
      "keep right pictures as DIR/HASH.png, to stand beside those that fail in --output" },
    { "junit", 0, LOM_OPTION_TEXT, offsetof(struct values, junit), "FILE", 0, 0,
      "write JUnit's XML, with the pictures of --output attached" },
    { "threads", 0, LOM_OPTION_INTEGER, offsetof(struct values, threads), "N", 1, 256,
      "workers; as many as the machine allows when not given; changes no byte" },
    { "quiet", 'q', LOM_OPTION_FLAG, offsetof(struct values, quiet), NULL, 0, 0, "say nothing of those that are ok" },
};

static const lom_command_line line = {
    .name = "verify",
    .arguments = "MANIFEST",
    .summary = "draw the golden pictures of a project and compare them with their hashes",
    .details =
        "A line of MANIFEST: HASH SCENE, then --size, --frame, --crop, --set as of lom render, and flat where one\n"
        "single colour is right; - is the hash of a picture that nobody has approved; # begins a comment. The\n"
        "first line may be \"lom VERSION picture N\". Scenes are named from the manifest's folder. See\n"
        "docs/golden-tests.md. Exit status 0 when all are right, 1 when one is not, 2 when one could not be drawn.",
    .options = options,
    .option_count = sizeof options / sizeof options[0],
    .minimum_arguments = 1,
    .maximum_arguments = 1,
};

/* What is open while pictures are drawn: a scene, which the renderers look at. */
struct run {
    const struct values *values;
    struct lom_manifest manifest;
    lom_scene *scene;
    char *path;                 /* of the scene */
    lom_renderer *renderer[2];  /* the second is --twice's */
    struct lom_report cases;    /* of --junit, without what stands around them */
    struct lom_report approved; /* the manifest as it is to be, up to `copied` of the old one */
    size_t copied;
    int totals[LOM_VERIFIED_COUNT];
};

/* ---- drawing ---- */

static void drop_scene(struct run *run)
{
    for (int i = 0; i < 2; i++) {
        lom_free_renderer(run->renderer[i]);
        run->renderer[i] = NULL;
    }
    lom_free_scene(run->scene);
    lom_release(run->path);
    run->scene = NULL;
    run->path = NULL;
}

/* The devices must have nothing in common: another number of threads, another width where two are built. */
static lom_device_desc other_device(const lom_renderer *renderer)
{
    lom_device_desc first = lom_describe_device(lom_renderer_device(renderer));
    lom_device_desc other = { .threads = first.threads == 1 ? 3 : 1, .lanes = first.lanes };
    for (int lanes = 4; lanes <= 16; lanes *= 2)
        if (lanes != first.lanes && lom_find_variant(lanes, false) >= 0)
            other.lanes = lanes;
    return other;
}

/* Renderers for run->scene. */
static bool create_renderers(struct run *run, lom_error *error)
{
    const struct values *v = run->values;
    lom_device_desc device = { .threads = v->threads.given ? (int)v->threads.value[0] : 0 };
    run->renderer[0] = lom_create_renderer(run->scene, &device, error);
    if (run->renderer[0] == NULL)
        return false;
    lom_tell_warnings(lom_renderer_warning(run->renderer[0]), lom_renderer_warning_count(run->renderer[0]));
    device = other_device(run->renderer[0]);
    run->renderer[1] = v->twice ? lom_create_renderer(run->scene, &device, error) : NULL;
    return !v->twice || run->renderer[1] != NULL;
}

/* The renderers go on with another scene from the same file; not where plates of clouds depend on frames before. */
static bool change_renderers(struct run *run, lom_scene *scene, lom_error *error)
{
    bool done = true;
    for (int i = 0; i < 2 && done; i++)
        done = run->renderer[i] == NULL || lom_change_scene(run->renderer[i], scene, NULL, error);
    if (!done) {
        drop_scene(run);
        lom_free_scene(scene);
        return false;
    }
    lom_free_scene(run->scene);
    run->scene = scene;
    return true;
}

static bool provide_scene(struct run *run, const struct lom_golden *golden, const lom_frame_desc *desc,
                          lom_error *error)
{
    bool is_absolute = golden->scene[0] == '/';
    char *path =
        lom_path_print(error, "%.*s%s", is_absolute ? 0 : run->manifest.folder, run->manifest.path, golden->scene);
    lom_scene *scene = path != NULL ? lom_open_scene(path, &golden->options, error) : NULL;
    if (scene == NULL || !lom_check_frame(scene, desc, error)) {
        lom_free_scene(scene);
        lom_release(path);
        return false;
    }
    if (run->path != NULL && strcmp(run->path, path) == 0 && run->scene->quality.impostors == LOM_IMPOSTORS_OFF &&
        scene->quality.impostors == LOM_IMPOSTORS_OFF) {
        lom_release(path);
        return change_renderers(run, scene, error);
    }
    drop_scene(run);
    run->scene = scene;
    run->path = path;
    bool done = create_renderers(run, error);
    if (!done)
        drop_scene(run);
    return done;
}

/* ---- one picture ---- */

static const char *ending(const lom_image *image)
{
    return lom_describe_format(image->format)->is_float ? "pfm" : "png";
}

/* The name ends in `what`; NULL on failure. */
static char *write_picture(const struct run *run, const struct lom_golden *golden, const lom_image *image,
                           const char *what, lom_error *error)
{
    char *path = lom_path_print(error, "%s/%d-%s%s.%s", run->values->output, golden->number,
                                lom_path_file(golden->scene), what, ending(image));
    if (path != NULL && lom_make_folders(path, 0, error) && lom_write_image(path, NULL, image, error))
        return path;
    lom_release(path);
    return NULL;
}

/* ---- the cache: files that are named for the hash of their picture, which is looked at before they are trusted ---- */

/* The picture of this hash, of the format of `like`; NULL where the cache has none. *path is its file, NULL when memory
 * runs out. */
static lom_image *find_cached(const struct run *run, uint64_t hash, const lom_image *like, char **path,
                              lom_error *error)
{
    *path = lom_path_print(error, "%s/%016llx.%s", run->values->cache, (unsigned long long)hash, ending(like));
    lom_image *image = *path != NULL ? lom_read_image(*path, NULL) : NULL;
    if (image != NULL && lom_reinterpret_image(image, like->format, NULL) && lom_hash_image(image) == hash)
        return image;
    lom_free_image(image);
    return NULL;
}

/* Keeps a picture, unless it is there. */
static bool keep_picture(const struct run *run, const lom_image *image, uint64_t hash, lom_error *error)
{
    char *path;
    lom_image *cached = find_cached(run, hash, image, &path, error);
    bool done = cached != NULL ||
                (path != NULL && lom_make_folders(path, 0, error) && lom_write_image(path, NULL, image, error));
    lom_free_image(cached);
    lom_release(path);
    return done;
}

/* Writes the picture that was expected instead of `image`, where the cache has it. */
static bool write_expected(const struct run *run, const struct lom_golden *golden, const lom_image *image,
                           lom_error *error)
{
    char *path, *expected = NULL;
    lom_image *cached = find_cached(run, golden->expected, image, &path, error);
    bool done = path != NULL;
    if (cached != NULL) {
        expected = write_picture(run, golden, cached, ".expected", error);
        done = expected != NULL;
    }
    lom_free_image(cached);
    lom_release(expected);
    lom_release(path);
    return done;
}

/* Writes what --output and --cache ask for. */
static bool write_pictures(const struct run *run, const struct lom_golden *golden, lom_frame frames[2],
                           struct lom_outcome *o)
{
    const struct values *v = run->values;
    if (o->how == LOM_VERIFIED_OK || o->how == LOM_VERIFIED_APPROVED)
        return v->cache == NULL || keep_picture(run, frames[0].image, o->got, &o->error);
    if (v->output == NULL)
        return true;
    o->picture = write_picture(run, golden, frames[0].image, "", &o->error);
    if (o->picture != NULL && o->how == LOM_VERIFIED_UNSTEADY) {
        char *again = write_picture(run, golden, frames[1].image, ".again", &o->error);
        lom_release(again);
        return again != NULL;
    }
    return o->picture != NULL && (v->cache == NULL || o->how != LOM_VERIFIED_DIFFERS ||
                                  write_expected(run, golden, frames[0].image, &o->error));
}

static lom_verified judge(const struct run *run, const struct lom_golden *golden, const lom_image *image,
                          const struct lom_outcome *o)
{
    if (run->values->twice && o->again != o->got)
        return LOM_VERIFIED_UNSTEADY;
    if (lom_is_one_colour(image) && !golden->may_be_flat)
        return LOM_VERIFIED_FLAT;
    if (golden->is_approved && o->got == o->expected)
        return LOM_VERIFIED_OK;
    if (run->values->approve)
        return LOM_VERIFIED_APPROVED;
    return golden->is_approved ? LOM_VERIFIED_DIFFERS : LOM_VERIFIED_NEW;
}

static bool verify_picture(struct run *run, const struct lom_golden *golden, struct lom_outcome *o)
{
    int number = golden->frame.given ? (int)golden->frame.value[0] : 0;
    lom_frame_desc desc = lom_frame_of_options(&golden->options, number);
    lom_frame frames[2] = { { .image = NULL }, { .image = NULL } };
    bool done = provide_scene(run, golden, &desc, &o->error);
    for (int i = 0; i < 2 && done; i++)
        done = run->renderer[i] == NULL || lom_render_frame(run->renderer[i], &desc, &frames[i], &o->error);
    if (done) {
        o->got = lom_hash_image(frames[0].image);
        o->again = frames[1].image != NULL ? lom_hash_image(frames[1].image) : 0;
        o->how = judge(run, golden, frames[0].image, o);
        done = write_pictures(run, golden, frames, o);
    }
    lom_free_image(frames[0].image);
    lom_free_image(frames[1].image);
    return done;
}

/* ---- all of them ---- */

static void copy_manifest(struct run *run, size_t end)
{
    fwrite(run->manifest.file.data + run->copied, 1, end - run->copied, run->approved.out);
    run->copied = end;
}

static void verify_golden(struct run *run, const struct lom_golden *golden)
{
    struct lom_outcome outcome = { .expected = golden->expected };
    if (!verify_picture(run, golden, &outcome))
        outcome.how = LOM_VERIFIED_ERROR;
    run->totals[outcome.how]++;
    if (outcome.how == LOM_VERIFIED_APPROVED) {
        copy_manifest(run, golden->hash_at);
        fprintf(run->approved.out, "%016llx", (unsigned long long)outcome.got);
        run->copied += golden->hash_size;
    }
    if (run->cases.out != NULL)
        lom_report_golden_junit(run->cases.out, &run->manifest, golden, &outcome);
    if (!run->values->quiet || outcome.how != LOM_VERIFIED_OK)
        lom_report_golden(stdout, &run->manifest, golden, &outcome);
    fflush(stdout);
    lom_release(outcome.picture);
}

/* The suite stands before its cases and says how many there are. */
static bool write_junit(struct run *run)
{
    struct lom_report whole = { .path = run->cases.path };
    if (run->cases.out == NULL)
        return true;
    if (fflush(run->cases.out) != 0)
        return lom_complain("no memory is left.") == LOM_EXIT_DONE;
    bool done = lom_open_report(&whole);
    if (done) {
        lom_begin_junit(whole.out);
        lom_begin_golden_junit(whole.out, &run->manifest, run->totals);
        fwrite(run->cases.text, 1, run->cases.size, whole.out);
        fputs("  </testsuite>\n", whole.out);
        lom_end_junit(whole.out);
        done = lom_write_report(&whole);
    }
    lom_drop_report(&whole);
    return done;
}

static int verify_all(struct run *run)
{
    const struct values *v = run->values;
    struct lom_manifest_place place = { .at = 0 };
    struct lom_golden golden;
    int seen = 0;
    while (lom_next_golden(&run->manifest, &place, &golden, NULL))
        if (!v->line.given || v->line.value[0] == golden.number) {
            verify_golden(run, &golden);
            seen++;
        }
    if (seen == 0)
        return lom_complain("%s:%d: there is no picture on this line.", run->manifest.path, (int)v->line.value[0]);
    const int *totals = run->totals;
    lom_report_totals(stdout, totals);
    bool done = write_junit(run);
    if (totals[LOM_VERIFIED_APPROVED] > 0 && totals[LOM_VERIFIED_ERROR] == 0 && done) {
        copy_manifest(run, run->manifest.file.size);
        done = lom_write_report(&run->approved);
    } else if (totals[LOM_VERIFIED_APPROVED] > 0)
        lom_complain("%s is left as it was.", run->manifest.path);
    if (!done || totals[LOM_VERIFIED_ERROR] > 0)
        return LOM_EXIT_FAILED;
    return seen == totals[LOM_VERIFIED_OK] + totals[LOM_VERIFIED_APPROVED] ? LOM_EXIT_DONE : LOM_EXIT_DIFFERS;
}

int lom_command_verify(int argc, char **argv)
{
    struct values values = { .junit = NULL };
    lom_arguments arguments;
    lom_error error = { .code = LOM_OK };
    int status;
    if (!lom_parse_options(&line, argc, argv, &values, &arguments, &status))
        return status;
    const char *path = arguments.items[0];
    if (values.approve && strcmp(path, "-") == 0)
        return lom_complain("verify: --approve writes into the manifest, which must be a file.");
    if (values.junit != NULL && strcmp(path, values.junit) == 0)
        return lom_complain("verify: the manifest and --junit are both %s.", path);
    struct run run = { .values = &values,
                       .cases = { .path = values.junit },
                       .approved = { .path = values.approve ? path : NULL } };
    status = LOM_EXIT_FAILED;
    if (!lom_open_manifest(path, &run.manifest, &error))
        lom_complain_error(&error);
    else if (lom_open_report(&run.cases) && lom_open_report(&run.approved))
        status = verify_all(&run);
    drop_scene(&run);
    lom_drop_report(&run.cases);
    lom_drop_report(&run.approved);
    lom_close_manifest(&run.manifest);
    return status;
}
