/* Every key of the scene file at the ends of its range, at the least numbers that it may have (those below 2^-100 are 0),
 * and just inside: the result is a picture of finite numbers, or a sentence that names the key; never a crash, a report of
 * a sanitizer, or a frame that takes seconds. The cases come from the table of keys, over small scenes that use them; a key
 * that no scene draws fails. Each case is a process of its own. Of the values of a key, three are tried, and all with
 * LOM_EXHAUSTIVE=1, one element of an array at a time, too. */
#include "check.h"
#include "key_bases.h"
#include "key_walk.h"
#include "sanitized.h"
#include "scene/scene_keys.h"
#include "small_scene.h"

#include <lom/scene.h>

#include <float.h>
#include <math.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>

#ifdef SANITIZED
const char *__asan_default_options(void);
const char *__asan_default_options(void)
{
    return "allocator_may_return_null=1:max_allocation_size_mb=2048:detect_leaks=0";
}
#endif

enum { MOST_SECONDS = 6, MOST_MEMORY = 2000000000 };

/* ---- one case ---- */

/* What the process of a case says of it. */
struct answer {
    bool drawn, finite;
    lom_code code;
    uint64_t hash;
    char text[496];
};

static struct answer *answer; /* shared with the processes */

static void draw(const char *text, const char *override, int frame)
{
    lom_error error = { 0 };
    lom_frame picture = { .image = NULL };
    lom_scene *scene = lom_decode_scene(text, strlen(text), small_path("scene.toml"), &override, 1, &error);
    lom_renderer *renderer =
        scene != NULL ? lom_create_renderer(scene, &(lom_device_desc){ .threads = 1, .lanes = 4 }, &error) : NULL;
    answer->drawn =
        renderer != NULL &&
        lom_render_frame(renderer, &(lom_frame_desc){ .width = 16, .height = 9, .frame = frame }, &picture, &error);
    answer->finite = true;
    if (answer->drawn) {
        answer->hash = lom_hash_image(picture.image);
        const float *sample = (const float *)(const void *)picture.image->pixels;
        for (size_t i = 0;
             picture.image->format == LOM_FORMAT_RGB32F && i < lom_image_size(picture.image) / sizeof *sample; i++)
            answer->finite &= isfinite(sample[i]) != 0;
    }
    answer->code = error.code;
    memcpy(answer->text, error.text, sizeof answer->text);
    lom_free_image(picture.image);
    lom_free_renderer(renderer);
    lom_free_scene(scene);
}

/* The last name of a path, without the index of an element. */
static const char *last_name(const char *path)
{
    const char *dot = strrchr(path, '.');
    return dot != NULL ? dot + 1 : path;
}

/* Draws in a process of its own; whether the result is one of the two that are allowed. */
static bool run(const struct base *base, const char *text, const char *path, const char *value, int frame)
{
    char override[256];
    snprintf(override, sizeof override, "%s=%s", path, value);
    memset(answer, 0, sizeof *answer);
    fflush(stdout);
    pid_t child = fork();
    if (child == 0) {
        const char *seconds = getenv("LOM_MOST_SECONDS");
        rlim_t most = seconds != NULL ? (rlim_t)atoi(seconds) : MOST_SECONDS;
        setrlimit(RLIMIT_CPU, &(struct rlimit){ most, most });
#ifndef SANITIZED
        setrlimit(RLIMIT_AS, &(struct rlimit){ MOST_MEMORY, MOST_MEMORY });
#endif
        draw(text, override, frame);
        _exit(0);
    }
    int status = -1;
    waitpid(child, &status, 0);
    bool named = answer->drawn || strstr(answer->text, last_name(path)) != NULL;
    bool good = status == 0 && named && answer->finite && (answer->code == LOM_OK) == answer->drawn;
    CHECK(good, "%s, frame %d, --set %s: status 0x%x, %s%s%s", base->name, frame, override, status,
          answer->drawn ? "drawn" : "not drawn", answer->finite ? "" : ", not finite",
          answer->text[0] != 0 ? answer->text : "");
    return good;
}

/* ---- the cases of a key ---- */

struct cases {
    const struct base *base;
    const char *text;
    int count, drawn;
    uint64_t hash; /* of all answers: the same on every machine */
};

static void try(struct cases *cases, const char *path, const char *value)
{
    cases->count++;
    run(cases->base, cases->text, path, value, 1);
    cases->drawn += answer->drawn;
    cases->hash = lom_hash_bytes(cases->hash, &answer->hash, sizeof answer->hash);
}

/* The value alone, or as every element of an array; with `kept`, those of the scene stay but one. */
static void try_number(struct cases *cases, const char *path, const lom_key *key, double x, const double *kept,
                       int only)
{
    char value[200];
    int length = 0;
    if (key->count < 2) {
        snprintf(value, sizeof value, "%.17g", x);
    } else {
        for (int i = 0; i < key->count; i++)
            length += snprintf(value + length, sizeof value - (size_t)length, "%s%.17g", i == 0 ? "[" : ", ",
                               kept == NULL || i == only ? x : kept[i]);
        snprintf(value + length, sizeof value - (size_t)length, "]");
    }
    try(cases, path, value);
}

static bool exhaustive(void)
{
    return getenv("LOM_EXHAUSTIVE") != NULL;
}

/* Whose greatest value is allowed, and takes a minute: a volume of 512^3, 65536 rays a pixel. */
static bool takes_long(const char *path)
{
    return strcmp(path, "cloud.0.voxels") == 0 || strcmp(path, "quality.reference.samples") == 0;
}

static void try_numbers(struct cases *cases, const char *path, const lom_key *key, const void *member)
{
    bool any = key->minimum == 0 && key->maximum == 0, integer = key->type == LOM_KEY_INTEGER;
    double low = any ? -DBL_MAX : key->minimum, high = any ? DBL_MAX : key->maximum;
    double in = integer ? low + 1 : nextafter(low, high), below = integer ? high - 1 : nextafter(high, low);
    double values[16] = { low, high, integer || low > 0 ? in : 1e-30, in, below };
    int count = exhaustive() ? 5 : 3;
    static const double tiny[] = { 0, 5e-324, 1e-46, 1e-18, -1e-300, -1e-46, -1e-18 };
    for (int i = 0; i < 7 && !integer && exhaustive(); i++)
        if (tiny[i] > low && tiny[i] < high)
            values[count++] = tiny[i];
    for (int i = (key->flags & LOM_KEY_ABOVE) != 0; i < count; i++)
        if (values[i] < high / 2 || !takes_long(path))
            try_number(cases, path, key, values[i], NULL, 0);
    if (key->type != LOM_KEY_NUMBER || key->count < 2 || !exhaustive())
        return;
    double kept[3] = { 0 };
    memcpy(kept, member, (size_t)key->count * sizeof *kept);
    for (int i = 0; i < key->count;
         i++) { /* one at a time: the shape of a needle, a plate, a point at the end of the world */
        try_number(cases, path, key, high, kept, i);
        try_number(cases, path, key, low < 0 ? low : 1e-46, kept, i);
    }
}

static void try_key(struct cases *cases, const char *path, const lom_key *key, const void *member)
{
    int before = cases->drawn;
    char value[64];
    switch (key->type) {
    case LOM_KEY_BOOL:
        try(cases, path, "false");
        try(cases, path, "true");
        break;
    case LOM_KEY_CHOICE:
        for (int i = 0; key->choices[i] != NULL; i++) {
            snprintf(value, sizeof value, "\"%s\"", key->choices[i]);
            try(cases, path, value);
        }
        break;
    default:
        try_numbers(cases, path, key, member);
    }
    CHECK(cases->drawn > before, "%s: no value of %s gives a picture", cases->base->name, path);
}

/* ---- all keys ---- */

static void walk_all(const lom_scene *scene, visit_key *visit, void *context)
{
    char path[LONGEST_PATH];
    walk_keys(&lom_scene_keys, path, 0, scene, visit, context);
}

static void try_if_named(void *context, const char *path, const lom_key *key, const void *member)
{
    struct cases *cases = context;
    if (member != NULL && is_tried(cases->base->keys, path))
        try_key(cases, path, key, member);
}

static void try_base(const struct base *base)
{
    char text[4000];
    lom_error error = { 0 };
    snprintf(text, sizeof text, "%s%s", head, base->text);
    lom_scene *scene = lom_decode_scene(text, strlen(text), small_path("scene.toml"), NULL, 0, &error);
    CHECK(scene != NULL, "%s: %s", base->name, error.text);
    struct cases cases = { .base = base, .text = text, .hash = LOM_HASH_START };
    if (scene != NULL)
        walk_all(scene, try_if_named, &cases);
    printf("  %s: %d cases, %d drawn, %016llx\n", base->name, cases.count, cases.drawn, (unsigned long long)cases.hash);
    lom_free_scene(scene);
}

static void expect_a_base(void *context, const char *path, const lom_key *key, const void *member)
{
    (void)context, (void)key, (void)member;
    bool tried = false;
    for (size_t i = 0; i < sizeof bases / sizeof *bases; i++)
        tried |= is_tried(bases[i].keys, path);
    CHECK(tried, "no scene tries %s", path);
}

static void every_key_is_tried(void)
{
    walk_all(NULL, expect_a_base, NULL);
}

/* Cases that once overwrote the heap on one processor, or crashed on all. */
static void sizes_and_times_too_small(void)
{
    static const struct {
        const char *base, *path, *value;
        int frame;
        bool drawn;
    } cases[] = {
        { "clouds", "cloud.0.size", "1e-300", 0, false },
        { "clouds", "cloud.0.size", "1e-46", 0, false },
        { "clouds", "cloud.0.size", "1e-6", 0, true },
        { "clouds", "cloud.0.size", "[1e-6, 1e6, 1e-6]", 0, true },
        { "evolve", "clouds.evolve", "1e-300", 1, true },
        { "evolve", "clouds.evolve", "1e-18", 1, true },
        { "evolve", "clouds.evolve", "1e-9", 1000000000, true },
        { "evolve", "output.fps", "1e-300", 1, false },
        { "sea", "output.fps", "1e-300", 1, false },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (size_t j = 0; j < sizeof bases / sizeof *bases; j++)
            if (strcmp(bases[j].name, cases[i].base) == 0) {
                char text[4000];
                snprintf(text, sizeof text, "%s%s", head, bases[j].text);
                run(&bases[j], text, cases[i].path, cases[i].value, cases[i].frame);
                CHECK(answer->drawn == cases[i].drawn, "%s = %s: %s", cases[i].path, cases[i].value, answer->text);
            }
}

int main(int argc, char **argv)
{
    if (!make_small_scene())
        return 1;
    answer = mmap(NULL, sizeof *answer, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (answer == MAP_FAILED)
        return 1;
    RUN(every_key_is_tried);
    RUN(sizes_and_times_too_small);
    for (size_t i = 0; i < sizeof bases / sizeof *bases; i++)
        if (check_selected(argc, argv, bases[i].name)) {
            check_failures = 0;
            try_base(&bases[i]);
            if (check_failures != 0)
                check_failed_tests++;
            printf("%s keys_of_%s%s%s %s\n", check_failures != 0 ? "FAIL" : "PASS", bases[i].name,
                   check_failures != 0 ? "; repeat: " : "", check_failures != 0 ? argv[0] : "",
                   check_failures != 0 ? bases[i].name : "");
        }
    remove_small_scene();
    return check_result();
}
