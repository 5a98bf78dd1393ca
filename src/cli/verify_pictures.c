/* What is kept of golden pictures. In: a picture and what became of it. Out: files of --output and --cache, pictures of
 * the page. Invariant: a picture is taken for the expected one only if its hash is the expected hash, wherever it comes
 * from: a file of the cache, or what the pinned version of lom draws. */
#include "verify.h"

#include "paths.h"
#include "processes.h"

#include "image/data_uri.h"

#include <string.h>

static const char *ending(const lom_image *image)
{
    return lom_describe_format(image->format)->is_float ? "pfm" : "png";
}

/* The name ends in `what`; NULL on failure. */
static char *write_picture(const struct lom_verifier *verifier, const struct lom_golden *golden, const lom_image *image,
                           const char *what, lom_error *error)
{
    char *path = lom_path_print(error, "%s/%d-%s%s.%s", verifier->values->output, golden->number,
                                lom_path_file(golden->scene), what, ending(image));
    if (path != NULL && lom_make_folders(path, 0, error) && lom_write_image(path, NULL, image, error))
        return path;
    lom_release(path);
    return NULL;
}

/* ---- the cache: files that are named for the hash of their picture, which is looked at before they are trusted ---- */

/* The picture of this hash, of the format of `like`; NULL where the cache has none. *path is its file, NULL when memory
 * runs out. */
static lom_image *find_cached(const struct lom_verifier *verifier, uint64_t hash, const lom_image *like, char **path,
                              lom_error *error)
{
    *path = lom_path_print(error, "%s/%016llx.%s", verifier->values->cache, (unsigned long long)hash, ending(like));
    lom_image *image = *path != NULL ? lom_read_image(*path, NULL) : NULL;
    if (image != NULL && lom_reinterpret_image(image, like->format, NULL) && lom_hash_image(image) == hash)
        return image;
    lom_free_image(image);
    return NULL;
}

/* Keeps a picture, unless it is there. */
static bool keep_picture(const struct lom_verifier *verifier, const lom_image *image, uint64_t hash, lom_error *error)
{
    char *path;
    lom_image *cached = find_cached(verifier, hash, image, &path, error);
    bool done = cached != NULL ||
                (path != NULL && lom_make_folders(path, 0, error) && lom_write_image(path, NULL, image, error));
    lom_free_image(cached);
    lom_release(path);
    return done;
}

/* ---- the pinned version: another program, which draws the line again ---- */

enum { MOST_WORDS = 2 * LOM_OPTION_LIST_MAX + 16, WORD_LETTERS = 64 };

/* A command line while it is put together. */
struct words {
    char *items[MOST_WORDS];
    int count;
    char size[WORD_LETTERS], frame[WORD_LETTERS], crop[WORD_LETTERS];
};

static void add_words(struct words *words, const char *first, const char *second)
{
    words->items[words->count++] = (char *)(uintptr_t)first; /* execvp takes them so and changes none */
    words->items[words->count++] = (char *)(uintptr_t)second;
}

static void fill_words(struct words *words, const struct lom_verifier *verifier, const struct lom_golden *golden,
                       const char *kind)
{
    const struct lom_scene_options *o = &golden->options;
    long long frame = golden->frame.given ? golden->frame.value[0] : 0;
    words->items[words->count++] = verifier->manifest->pinned;
    add_words(words, "render", verifier->path);
    snprintf(words->frame, WORD_LETTERS, "%lld", frame);
    add_words(words, "--frame", words->frame);
    snprintf(words->size, WORD_LETTERS, "%lldx%lld", (long long)o->size.value[0], (long long)o->size.value[1]);
    if (o->size.given)
        add_words(words, "--size", words->size);
    snprintf(words->crop, WORD_LETTERS, "%lld,%lld,%lld,%lld", (long long)o->crop.value[0], (long long)o->crop.value[1],
             (long long)o->crop.value[2], (long long)o->crop.value[3]);
    if (o->crop.given)
        add_words(words, "--crop", words->crop);
    for (int i = 0; i < o->set.count; i++)
        add_words(words, "--set", o->set.items[i]);
    add_words(words, "--format", kind);
    add_words(words, "-o", "-");
    words->items[words->count++] = (char *)(uintptr_t) "--quiet";
    words->items[words->count] = NULL;
}

/* What the pinned version draws; NULL where there is none, or it draws another picture than the expected one. */
static lom_image *draw_pinned(const struct lom_verifier *verifier, const struct lom_golden *golden,
                              const lom_image *like)
{
    enum { SECONDS = 600, STANDARD_OUTPUT = 1, BESIDE_PIXELS = 1 << 16 };
    const lom_bounds bounds = { .descriptor = STANDARD_OUTPUT,
                                .seconds = SECONDS,
                                .bytes = 2 * lom_image_size(like) + BESIDE_PIXELS };
    if (verifier->manifest->pinned == NULL)
        return NULL;
    struct words words = { .count = 0 };
    fill_words(&words, verifier, golden, ending(like));
    unsigned char *bytes = lom_allocate(bounds.bytes, 1, NULL);
    size_t size = 0;
    lom_ending how;
    bool done = bytes != NULL && lom_run_process(words.items, &bounds, bytes, &size, &how, NULL) &&
                how.how == LOM_ENDED && how.number == 0;
    lom_image *image = done ? lom_decode_image(bytes, size, verifier->manifest->pinned, NULL) : NULL;
    lom_release(bytes);
    if (image != NULL && lom_reinterpret_image(image, like->format, NULL) && lom_hash_image(image) == golden->expected)
        return image;
    lom_free_image(image);
    return NULL;
}

/* The picture that was expected instead of `image`: of the cache, or drawn again, and then in the cache. *expected is NULL
 * where it cannot be had; false on failure. */
static bool find_expected(const struct lom_verifier *verifier, const struct lom_golden *golden, const lom_image *image,
                          lom_image **expected, lom_error *error)
{
    bool has_cache = verifier->values->cache != NULL, done = true;
    *expected = NULL;
    if (has_cache) {
        char *path;
        *expected = find_cached(verifier, golden->expected, image, &path, error);
        done = path != NULL;
        lom_release(path);
    }
    if (*expected != NULL || !done)
        return done;
    *expected = draw_pinned(verifier, golden, image);
    return *expected == NULL || !has_cache || keep_picture(verifier, *expected, golden->expected, error);
}

/* ---- all of it ---- */

static bool show(struct lom_outcome *o, int which, const lom_image *image)
{
    o->shown[which] = lom_encode_shown_image(image, &o->error);
    return o->shown[which].data != NULL;
}

/* The picture, the one that it is compared with, where they differ. */
static bool show_pictures(const lom_image *image, const lom_image *other, struct lom_outcome *o)
{
    if (!show(o, LOM_SHOWN_ACTUAL, image) || other == NULL)
        return o->shown[LOM_SHOWN_ACTUAL].data != NULL;
    lom_image *difference = lom_compare_picture(other, image, &o->error);
    bool done = difference != NULL && show(o, LOM_SHOWN_EXPECTED, other) && show(o, LOM_SHOWN_DIFFERENCE, difference);
    lom_free_image(difference);
    return done;
}

/* The picture, and beside it the other one under a name that ends in `what`. */
static bool write_pictures(const struct lom_verifier *verifier, const struct lom_golden *golden, const lom_image *image,
                           const lom_image *other, const char *what, struct lom_outcome *o)
{
    o->picture = write_picture(verifier, golden, image, "", &o->error);
    if (o->picture == NULL || other == NULL)
        return o->picture != NULL;
    char *beside = write_picture(verifier, golden, other, what, &o->error);
    lom_release(beside);
    return beside != NULL;
}

bool lom_keep_pictures(const struct lom_verifier *verifier, const struct lom_golden *golden, const lom_image *image,
                       const lom_image *again, struct lom_outcome *o)
{
    const struct lom_verify_values *v = verifier->values;
    bool done = true, is_unsteady = o->how == LOM_VERIFIED_UNSTEADY;
    if (o->how == LOM_VERIFIED_OK || o->how == LOM_VERIFIED_APPROVED)
        return v->cache == NULL || keep_picture(verifier, image, o->got, &o->error);
    if (v->output == NULL && v->page == NULL)
        return true;
    lom_image *expected = NULL;
    if (o->how == LOM_VERIFIED_DIFFERS)
        done = find_expected(verifier, golden, image, &expected, &o->error);
    const lom_image *other = is_unsteady ? again : expected;
    if (done && v->output != NULL)
        done = write_pictures(verifier, golden, image, other, is_unsteady ? ".again" : ".expected", o);
    if (done && v->page != NULL)
        done = show_pictures(image, other, o);
    lom_free_image(expected);
    return done;
}
