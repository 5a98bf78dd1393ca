/* References. In: a scene's options, the kind of the reference. Out: overrides with which the scene and its
 * reference are drawn, and the reference's picture, drawn once and kept. Invariant: a kept picture is of exactly
 * these bytes of the scene's files, these settings and this picture version. */
#include "trade_reference.h"

#include "base/reserve.h"
#include "paths.h"

#include <string.h>

/* A text that lives as long as the reference; NULL on failure. */
static const char *keep(struct lom_trade_reference *r, const char *text, lom_error *error)
{
    char *copy = lom_path_print(error, "%s", text);
    if (copy == NULL || !lom_reserve(&r->texts, &r->text_capacity, r->text_count + 1, sizeof *r->texts, error)) {
        lom_release(copy);
        return NULL;
    }
    r->texts[r->text_count++] = copy;
    return copy;
}

/* A list of overrides while it is made. */
struct list {
    struct lom_trade_reference *reference;
    lom_subject *subject;
    const char ***changes;
    size_t capacity;
    lom_error *error;
    bool failed;
};

static void add(struct list *list, const char *change)
{
    if (list->failed)
        return;
    list->failed = !lom_reserve(list->changes, &list->capacity, list->subject->change_count + 1, sizeof **list->changes,
                                list->error);
    const char *kept = list->failed ? NULL : keep(list->reference, change, list->error);
    list->failed |= kept == NULL;
    if (list->failed)
        return;
    (*list->changes)[list->subject->change_count++] = kept;
    list->subject->changes = *list->changes;
}

/* Adds "KEY=VALUE", unless the scene says so: an override would make the tables that it stands in. */
static void add_value(struct list *list, const lom_scene *scene, const lom_scene_key *key, const char *wanted)
{
    char value[LOM_SCENE_VALUE], text[128];
    if (strcmp(lom_print_scene_value(value, scene, key), wanted) == 0)
        return;
    snprintf(text, sizeof text, "%s=%s", key->path, wanted);
    add(list, text);
}

struct untraced {
    struct list *list;
    const lom_scene *scene;
};

static bool add_untraced(void *context, const lom_scene_key *key)
{
    const struct untraced *untraced = context;
    if (key->key->untraced != NULL)
        add_value(untraced->list, untraced->scene, key, key->key->untraced);
    return true;
}

/* Every dial that acts, at its most exact. */
static void add_finest(struct list *list, const lom_scene *scene)
{
    lom_dials dials;
    char why[LOM_DIAL_REASON], setting[LOM_SCENE_VALUE] = "";
    lom_list_dials(&dials);
    for (size_t i = 0; i < dials.count; i++) {
        const lom_dial *dial = &dials.dial[i];
        if (dial->key.key == NULL || dial->row.reference == LOM_DIAL_EQUAL || !lom_dial_acts(scene, &dial->row, why))
            continue;
        for (size_t k = 0; lom_dial_setting(dial, k, setting);)
            k++;
        add_value(list, scene, &dial->key, setting);
    }
}

/* The scene by the tracer, and its clouds by random paths. */
static void add_traced(struct list *list, const lom_scene *scene, int samples)
{
    char text[64];
    snprintf(text, sizeof text, "quality.reference.samples=%d", samples);
    add(list, "quality.water=reference");
    if (scene->cloud_count > 0 && scene->quality.clouds != LOM_CLOUDS_OFF)
        add(list, "quality.clouds=reference");
    add(list, text);
}

/* ---- preparing ---- */

static bool add_options(struct list *list, const struct lom_scene_options *options)
{
    char *settings = options->settings != NULL ? lom_path_print(list->error, "@%s", options->settings) : NULL;
    list->failed |= options->settings != NULL && settings == NULL;
    if (settings != NULL)
        add(list, settings);
    lom_release(settings);
    for (int i = 0; i < options->set.count; i++)
        add(list, options->set.items[i]);
    add(list, "output.format=rgb8");
    return !list->failed;
}

static bool check_subject(const lom_subject *subject, lom_error *error)
{
    lom_scene *scene = lom_read_scene(subject->path, subject->changes, subject->change_count, error);
    const bool drawable = scene != NULL && lom_check_frame(scene, &subject->frame, error);
    lom_free_scene(scene);
    return drawable;
}

/* The kept picture's name. Files are those that the scene names; what they name in turn is not looked at. */
static bool name_cache(struct lom_trade_reference *r, const char *folder, lom_error *error)
{
    const lom_frame_desc *f = &r->drawn.frame;
    char facts[200];
    lom_scene *scene = lom_read_scene(r->drawn.path, r->drawn.changes, r->drawn.change_count, error);
    if (scene == NULL)
        return false;
    snprintf(facts, sizeof facts, "%d %dx%d %d %d,%d,%d,%d %s", LOM_PICTURE_VERSION, f->width, f->height, f->frame,
             f->crop.x, f->crop.y, f->crop.width, f->crop.height, f->view != NULL ? f->view : "");
    uint64_t hash = lom_hash_bytes(LOM_HASH_START, facts, strlen(facts));
    for (size_t i = 0; i < r->drawn.change_count; i++)
        hash = lom_hash_bytes(hash, r->drawn.changes[i], strlen(r->drawn.changes[i]) + 1);
    size_t count;
    const char *const *files = lom_scene_files(scene, &count);
    bool done = true;
    for (size_t i = 0; done && i < count; i++) {
        lom_bytes bytes = lom_read_file(files[i], (size_t)1 << 30, error);
        done = bytes.data != NULL;
        if (done)
            hash = lom_hash_bytes(hash, bytes.data, bytes.size);
        lom_release(bytes.data);
    }
    lom_free_scene(scene);
    r->folder = strlen(folder);
    if (done)
        r->cache = lom_path_print(error, "%s/reference-%016llx.png", folder, (unsigned long long)hash);
    return done && r->cache != NULL;
}

static bool has_size_of(const lom_image *picture, const lom_frame_desc *frame)
{
    const int width = frame->crop.width > 0 ? frame->crop.width : frame->width;
    const int height = frame->crop.width > 0 ? frame->crop.height : frame->height;
    return picture->width == width && picture->height == height;
}

/* A picture from a file as it is compared; NULL on failure. */
static lom_image *read_picture(const char *path, const lom_frame_desc *frame, lom_error *error)
{
    lom_image *read = lom_read_image(path, error);
    if (read != NULL && !has_size_of(read, frame)) {
        lom_fail(error, LOM_ERROR_USAGE, "%s: the reference has %dx%d pixels, which are not those of the frame.", path,
                 read->width, read->height);
        lom_free_image(read);
        return NULL;
    }
    lom_image *shown = read != NULL ? lom_convert_image(read, LOM_FORMAT_RGB8, error) : NULL;
    lom_free_image(read);
    return shown;
}

/* The lists of overrides, for a reference that is drawn or is a file. */
static bool fill_lists(struct lom_trade_reference *r, bool traced, bool rendered,
                       const struct lom_scene_options *options, int samples, lom_error *error)
{
    struct list whole = { r, &r->whole, &r->changes[0], 0, error, false };
    struct list subject = { r, &r->subject, &r->changes[1], 0, error, false };
    struct list drawn = { r, &r->drawn, &r->changes[2], 0, error, false };
    if (!add_options(&whole, options) || !add_options(&subject, options) || !add_options(&drawn, options))
        return false;
    lom_scene *scene = lom_read_scene(r->whole.path, r->whole.changes, r->whole.change_count, error);
    if (scene == NULL)
        return false;
    if (traced) {
        lom_visit_scene_keys(add_untraced, &(struct untraced){ &subject, scene });
        lom_visit_scene_keys(add_untraced, &(struct untraced){ &drawn, scene });
        add_traced(&drawn, scene, samples);
    }
    if (rendered)
        add_finest(&drawn, scene);
    lom_free_scene(scene);
    return !subject.failed && !drawn.failed;
}

bool lom_prepare_trade_reference(struct lom_trade_reference *r, const char *kind, const char *folder,
                                 const struct lom_scene_options *options, const lom_subject *subject, int samples,
                                 lom_error *error)
{
    const bool traced = kind == NULL || strcmp(kind, "traced") == 0,
               rendered = !traced && strcmp(kind, "rendered") == 0;
    *r = (struct lom_trade_reference){ .subject = *subject, .whole = *subject, .drawn = *subject };
    r->name = traced ? "the tracer" : rendered ? "the finest settings" : kind;
    r->samples = traced ? samples : 0;
    if (!fill_lists(r, traced, rendered, options, samples, error) || !check_subject(&r->subject, error) ||
        !check_subject(&r->drawn, error))
        return false;
    if (traced || rendered)
        return folder == NULL || name_cache(r, folder, error);
    r->picture = read_picture(kind, &subject->frame, error);
    return r->picture != NULL;
}

bool lom_find_trade_reference(struct lom_trade_reference *r, lom_error *error)
{
    const lom_choices none = { .count = 0 };
    lom_drawer drawer = { .scene = NULL };
    lom_error unread = { .code = LOM_OK };
    if (r->picture == NULL && r->cache != NULL)
        r->picture = read_picture(r->cache, &r->drawn.frame, &unread);
    if (r->picture != NULL)
        return true;
    if (lom_set_drawer(&drawer, &r->drawn, &none, error))
        r->picture = lom_draw_subject(&drawer, &r->drawn, error);
    lom_end_drawer(&drawer);
    return r->picture != NULL && (r->cache == NULL || (lom_make_folders(r->cache, r->folder, error) &&
                                                       lom_write_image(r->cache, "png", r->picture, error)));
}

void lom_end_trade_reference(struct lom_trade_reference *r)
{
    for (size_t i = 0; i < r->text_count; i++)
        lom_release(r->texts[i]);
    lom_release(r->texts);
    for (int i = 0; i < 3; i++)
        lom_release(r->changes[i]);
    lom_release(r->cache);
    lom_free_image(r->picture);
}
