/* Another scene for a renderer, key by key: over the scenes of key_bases.h each key that one of them uses gets another
 * value by lom_change_scene and the old one again. The frames are those of renderers that were created for the scenes,
 * byte for byte, after the scene of before was freed. The cases come from the table of keys; a key that no row of
 * src/render/key_parts.c names fails. One other value is tried, and several with LOM_EXHAUSTIVE=1. */
#include "check.h"
#include "change_bases.h"
#include "key_walk.h"
#include "render/rooms.h"
#include "scene/scene_keys.h"
#include "small_scene.h"

#include <lom/lom.h>

#ifdef __GLIBC__
#include <malloc.h>
#endif

enum { FRAMES = 2 };
/* The first frames that a renderer draws of its scene, of the next one, of one after a change. */
enum { AT_FIRST = 1, AFTERWARDS = 3 };

static bool exhaustive(void)
{
    return getenv("LOM_EXHAUSTIVE") != NULL;
}

/* ---- pictures ---- */

struct pictures {
    bool drawn;
    uint64_t hash[FRAMES];
};

/* Frames from `first` on. */
static struct pictures draw(lom_renderer *renderer, int first)
{
    struct pictures p = { .drawn = renderer != NULL };
    for (int i = 0; p.drawn && i < FRAMES; i++) {
        const lom_frame_desc desc = { .width = 16, .height = 9, .frame = first + i };
        lom_frame frame;
        p.drawn = lom_render_frame(renderer, &desc, &frame, NULL);
        p.hash[i] = p.drawn ? lom_hash_image(frame.image) : 0;
        lom_free_image(frame.image);
    }
    return p;
}

static bool are_same(const struct pictures *a, const struct pictures *b)
{
    return a->drawn == b->drawn && memcmp(a->hash, b->hash, sizeof a->hash) == 0;
}

static lom_scene *decode(const char *text, const char *override)
{
    return lom_decode_scene(text, strlen(text), small_path("scene.toml"), &override, override != NULL, NULL);
}

static lom_renderer *create(const lom_scene *scene)
{
    return scene != NULL ? lom_create_renderer(scene, &(lom_device_desc){ .threads = 1, .lanes = 4 }, NULL) : NULL;
}

/* ---- one case ---- */

struct cases {
    const struct base *base;
    const char *text;
    struct pictures first, after, twice; /* of the scene as it is */
    int count, others, not ;             /* whose pictures are others than the scene's; that cannot be loaded */
    int kinds[4];                        /* by lom_change */
};

/* The textures that are shared are called by names of their own. */
static void check_labels(const lom_renderer *renderer)
{
    for (size_t i = 0; i < renderer->textures.count; i++)
        CHECK(lom_texture_label(renderer->textures.items[i].texture) == renderer->textures.items[i].path, "a label");
}

/* Gives a renderer the next scene and frees the one before, whose memory is then filled with other bytes; its frames from
 * `first` on are to be the expected ones, or where the next scene cannot be loaded those of the scene as it is. */
static void change(struct cases *cases, lom_renderer *renderer, lom_scene **scene, lom_scene *next,
                   const char *override, int first, const struct pictures *expected)
{
    lom_change done = LOM_CHANGE_NONE;
    lom_error error = { 0 };
    bool changed = lom_change_scene(renderer, next, &done, &error);
    CHECK(changed || error.code != LOM_OK, "%s, %s: failed without a word", cases->base->name, override);
    CHECK(changed == (expected->drawn || error.code == LOM_OK), "%s, %s: %s", cases->base->name, override, error.text);
    lom_free_scene(changed ? *scene : next);
    *scene = changed ? next : *scene;
    cases->not += !changed;
    cases->kinds[done] += changed;
    check_labels(renderer);
    struct pictures p = draw(renderer, first);
    if (!changed)
        expected = first == AFTERWARDS ? &cases->after : &cases->twice;
    CHECK(are_same(&p, expected), "%s, %s: %s %d (%s): %016llx %016llx instead of %016llx %016llx", cases->base->name,
          override, changed ? "change" : "failure", (int)done, lom_renderer_loaded(renderer),
          (unsigned long long)p.hash[0], (unsigned long long)p.hash[1], (unsigned long long)expected->hash[0],
          (unsigned long long)expected->hash[1]);
}

enum { TWICE = AFTERWARDS + FRAMES };

/* The scene becomes one with this value, and again itself; a renderer that was made for the value is given the scene. False
 * when the scene may not have this value. */
static bool try(struct cases *cases, const char *path, const char *value)
{
    char override[256];
    snprintf(override, sizeof override, "%s=%s", path, value);
    lom_scene *next = decode(cases->text, override);
    if (next == NULL)
        return false;
    lom_scene *scene = decode(cases->text, NULL), *other = decode(cases->text, override);
    lom_renderer *renderer = create(scene), *fresh = create(other);
    struct pictures first = draw(renderer, AT_FIRST), expected = draw(fresh, AFTERWARDS);
    CHECK(are_same(&first, &cases->first), "%s is drawn otherwise", cases->base->name);
    cases->count++;
    cases->others += !are_same(&expected, &cases->after);
    change(cases, renderer, &scene, next, override, AFTERWARDS, &expected);
    change(cases, renderer, &scene, decode(cases->text, NULL), override, TWICE, &cases->twice);
    if (expected.drawn)
        change(cases, fresh, &other, decode(cases->text, NULL), override, TWICE, &cases->twice);
    lom_free_renderer(renderer);
    lom_free_renderer(fresh);
    lom_free_scene(scene);
    lom_free_scene(other);
    return true;
}

/* ---- other values ---- */

static bool try_number(struct cases *cases, const char *path, const lom_key *key, const double *now)
{
    static const struct {
        double factor, more;
    } steps[] = { { 1.5, 0 }, { 0.5, 0 }, { 1, 1 }, { 1, 0.125 }, { 1, -1 } };
    bool tried = false;
    for (size_t s = 0; s < sizeof steps / sizeof *steps && (!tried || exhaustive()); s++) {
        char value[200];
        int count = key->count > 1 ? key->count : 1, length = 0;
        bool differs = false;
        for (int i = 0; i < count; i++) {
            double in_file = key->type == LOM_KEY_ANGLE ? now[i] * 180 / 3.14159265358979323846 : now[i];
            double other = in_file * steps[s].factor + steps[s].more;
            differs |= other != in_file;
            length += snprintf(value + length, sizeof value - (size_t)length, "%s%.6g", i > 0 ? ", " : "[", other);
        }
        snprintf(value + length, sizeof value - (size_t)length, "]");
        if (count == 1)
            value[strlen(value) - 1] = 0;
        if (differs)
            tried |= try(cases, path, count == 1 ? value + 1 : value);
    }
    return tried;
}

static bool try_integer(struct cases *cases, const char *path, int now)
{
    const int others[] = { now + 1, now - 1, now * 2, now / 2, 64 };
    bool tried = false;
    for (size_t i = 0; i < sizeof others / sizeof *others && (!tried || exhaustive()); i++) {
        char value[32];
        snprintf(value, sizeof value, "%d", others[i]);
        tried |= others[i] != now && try(cases, path, value);
    }
    return tried;
}

static bool try_choice(struct cases *cases, const char *path, const lom_key *key, int now)
{
    bool tried = false;
    for (int i = 0; key->choices[i] != NULL && (!tried || exhaustive()); i++) {
        char value[64];
        snprintf(value, sizeof value, "\"%s\"", key->choices[i]);
        tried |= i != now && try(cases, path, value);
    }
    return tried;
}

static bool ends_with(const char *text, const char *end)
{
    size_t length = strlen(text), less = strlen(end);
    return less <= length && strcmp(text + length - less, end) == 0 && (less > 0 || length == 0);
}

static bool try_text(struct cases *cases, const char *path, const lom_key *key, const char *const *now)
{
    static const char *const others[] = { "color.png",     "layer.ppm",  "box",   "cumulus_humilis", "other.obj",
                                          "strong breeze", "sky_%s.png", "other", "normal.png",      "" };
    bool tried = false;
    for (size_t i = 0; i < sizeof others / sizeof *others && (!tried || exhaustive()); i++) {
        char value[400];
        snprintf(value, sizeof value, "\"%s\"", others[i]);
        if (key->count > 1)
            snprintf(value, sizeof value, "[\"%s\", \"%s\", \"%s\", \"%s\", \"%s\", \"%s\"]", others[i], others[i],
                     others[i], others[i], others[i], others[i]);
        tried |= (*now == NULL ? others[i][0] != 0 : !ends_with(*now, others[i])) && try(cases, path, value);
    }
    return tried;
}

static bool try_key(struct cases *cases, const char *path, const lom_key *key, const void *member)
{
    switch (key->type) {
    case LOM_KEY_BOOL:
        return try(cases, path, *(const bool *)member ? "false" : "true");
    case LOM_KEY_INTEGER:
        return try_integer(cases, path, *(const int *)member);
    case LOM_KEY_CHOICE:
        return try_choice(cases, path, key, *(const int *)member);
    case LOM_KEY_STRING:
    case LOM_KEY_FILE:
        return try_text(cases, path, key, member);
    default:
        return try_number(cases, path, key, member);
    }
}

/* ---- all keys ---- */

/* Every key and every table: its path, `element` after the name of an array, and its place in the scene, NULL where the
 * scene has no such element. path: that of the table, `length` bytes. */
static void walk(const lom_key_table *table, const char *element, char path[LONGEST_PATH], size_t length,
                 const void *at, visit_key *visit, void *context)
{
    for (int i = 0; i < table->key_count; i++) {
        const lom_key *key = &table->keys[i];
        const char *member = at != NULL ? (const char *)at + key->offset : NULL;
        const bool is_array = key->type == LOM_KEY_TABLES;
        size_t longer = length + (size_t)snprintf(path + length, LONGEST_PATH - length, "%s%s%s", length > 0 ? "." : "",
                                                  key->name, is_array ? element : "");
        size_t there = 0;
        if (is_array && at != NULL) {
            memcpy(&there, (const char *)at + key->length_offset, sizeof there);
            memcpy(&member, (const char *)at + key->offset, sizeof member);
        }
        visit(context, path, key, is_array && there == 0 ? NULL : member);
        if (key->table != NULL)
            walk(key->table, element, path, longer, is_array && there == 0 ? NULL : member, visit, context);
        path[length] = 0;
    }
}

static void expect_one_row(void *context, const char *path, const lom_key *key, const void *member)
{
    (void)context, (void)key, (void)member;
    unsigned parts;
    int rows = lom_find_key_parts(path, &parts);
    CHECK(rows == 1, "%d rows of src/render/key_parts.c say what %s is loaded for", rows, path);
}

static void every_key_is_classified(void)
{
    char path[LONGEST_PATH] = "";
    unsigned parts;
    walk(&lom_scene_keys, "", path, 0, NULL, expect_one_row, NULL);
    CHECK(lom_find_key_parts("wtaer.level", &parts) == 0 && parts == LOM_PARTS_ALL, "an unknown key loads everything");
    CHECK(lom_find_key_parts("cloudy", &parts) == 0 && lom_find_key_parts("camera.key.time", &parts) == 1 && parts == 0,
          "names end where they end");
}

struct search {
    const char *name;
    size_t length;
    bool found;
};

static void look_for_name(void *context, const char *path, const lom_key *key, const void *member)
{
    (void)key, (void)member;
    struct search *s = context;
    s->found |= strlen(path) == s->length && memcmp(path, s->name, s->length) == 0;
}

static void every_row_names_keys(void)
{
    for (size_t i = 0; i < lom_key_row_count; i++)
        for (const char *name = lom_key_rows[i].names; *name != 0;) {
            char path[LONGEST_PATH] = "";
            size_t length = strcspn(name, " ");
            bool all = length > 2 && name[length - 1] == '*';
            struct search s = { name, all ? length - 2 : length, false };
            walk(&lom_scene_keys, "", path, 0, NULL, look_for_name, &s);
            CHECK(s.found, "no key or table is called %.*s", (int)length, name);
            name += length + (name[length] == ' ');
        }
}

static void try_if_named(void *context, const char *path, const lom_key *key, const void *member)
{
    struct cases *cases = context;
    if (member == NULL || key->table != NULL || !is_tried(cases->base->keys, path))
        return;
    int before = cases->others;
    bool tried = try_key(cases, path, key, member);
    if (!tried || (exhaustive() && cases->others == before))
        printf("  %s: %s %s\n", cases->base->name, path, tried ? "changes no byte" : "has no other value");
}

static struct pictures draw_fresh(const lom_scene *scene, int first)
{
    lom_renderer *renderer = create(scene);
    struct pictures p = draw(renderer, first);
    lom_free_renderer(renderer);
    return p;
}

static void try_base(const struct base *base)
{
    char text[4000], path[LONGEST_PATH] = "";
    snprintf(text, sizeof text, "%s%s", head, base->text);
    lom_scene *scene = decode(text, NULL);
    struct cases cases = { .base = base, .text = text, .first = draw_fresh(scene, AT_FIRST) };
    cases.after = draw_fresh(scene, AFTERWARDS);
    cases.twice = draw_fresh(scene, TWICE);
    CHECK(cases.twice.drawn, "%s is not drawn", base->name);
    walk(&lom_scene_keys, ".0", path, 0, scene, try_if_named, &cases);
    printf("  %s: %d values, %d of them with other pictures; %d changes by frames, %d in part, %d in all, %d refused\n",
           base->name, cases.count, cases.others, cases.kinds[LOM_CHANGE_FRAME], cases.kinds[LOM_CHANGE_PART],
           cases.kinds[LOM_CHANGE_ALL], cases.not );
    lom_free_scene(scene);
}

static void try_bases(const struct base *of, size_t count, int argc, char **argv)
{
    for (size_t i = 0; i < count; i++)
        if (check_selected(argc, argv, of[i].name)) {
            check_failures = 0;
            try_base(&of[i]);
            if (check_failures != 0)
                check_failed_tests++;
            printf("%s changes_of_%s%s%s %s\n", check_failures != 0 ? "FAIL" : "PASS", of[i].name,
                   check_failures != 0 ? "; repeat: " : "", check_failures != 0 ? argv[0] : "",
                   check_failures != 0 ? of[i].name : "");
            fflush(stdout);
        }
}

/* Files that the small scene has not: another sky, a volume. */
static bool make_other_files(void)
{
    static const char *const faces[] = { "right", "left", "top", "bottom", "front", "back" };
    lom_error error = { 0 };
    bool made = true;
    for (int i = 0; made && i < 6; i++) {
        char name[32];
        snprintf(name, sizeof name, "other_%s.png", faces[i]);
        made = small_picture(name, 7, LOM_FORMAT_RGB8, &error);
    }
    lom_image *volume = lom_make_cloud(&(lom_cloud_desc){ "cumulus_fractus", 6, 6, 6, 3 }, &error);
    made = made && volume != NULL && lom_write_image(small_path("cloud.nrrd"), NULL, volume, &error);
    lom_free_image(volume);
    if (!made)
        printf("FAIL other_files: %s\n", error.text);
    return made;
}

int main(int argc, char **argv)
{
#ifdef __GLIBC__
    mallopt(M_PERTURB, 0xA5); /* freed memory is filled, so what still points into a scene reads other values */
#endif
    if (!make_small_scene() || !make_other_files())
        return 1;
    RUN(every_key_is_classified);
    RUN(every_row_names_keys);
    try_bases(bases, sizeof bases / sizeof *bases, argc, argv);
    try_bases(more_bases, sizeof more_bases / sizeof *more_bases, argc, argv);
    remove_small_scene();
    return check_result();
}
