/* Time for extreme scenes: every number of the scene file at the ends of its range and, where it may be, a denormal, over
 * small scenes that use it. A frame takes at most 2.5 times as long as that of the scene as it is, for what the number asks for:
 * of one that asks for more (steps, cells, drops) by declared work. What seems to take longer is drawn again beside the
 * clean one. And few instructions meet denormals. Each case is a process of its own; LOM_SCENE=NAME tries one scene. */
#include "drawn_time.h"
#include "render/change_bases.h"
#include "render/key_walk.h"
#include "sanitized.h"

#include <float.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>

enum { MOST_SECONDS = 20, MOST_MEMORY = 2000000000, AGAIN = 21 };

/* What the process of a case says of it. */
struct answer {
    bool drawn;
    double least, clean;
    uint64_t work, denormals;
};

static struct answer *answer; /* shared with the processes */

struct cases {
    const struct base *base;
    char text[4096];
    struct answer clean;
    int count, drawn;
    double worst;
    char worst_of[256];
};

/* Alone, or beside the clean scene in turn. */
static void draw_case(const char *text, const char *override, bool in_turn)
{
    struct drawn d[2];
    if (!open_drawn(&d[0], text, override))
        return;
    if (in_turn && open_drawn(&d[1], text, NULL)) {
        for (int i = 0; i < 2 * AGAIN; i++)
            draw_next(&d[i % 2]);
        answer->clean = d[1].least;
    }
    *answer = (struct answer){ true, d[0].least, answer->clean, d[0].work, d[0].denormals };
}

static void run_case(const char *text, const char *override, bool in_turn)
{
    memset(answer, 0, sizeof *answer);
    fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
        setrlimit(RLIMIT_CPU, &(struct rlimit){ MOST_SECONDS, MOST_SECONDS });
        setrlimit(RLIMIT_AS, &(struct rlimit){ MOST_MEMORY, MOST_MEMORY });
        draw_case(text, override, in_turn);
        _exit(0);
    }
    int status = -1;
    waitpid(child, &status, 0);
    CHECK(status == 0, "%s: status 0x%x", override != NULL ? override : "the scene", status);
}

/* Numbers that ask for more than work is declared of: what more of them is, is no poison. Their least is tried. */
static const char *const asks_for_more[] = {
    "cloud.0.voxels",                                         /* 512^3 of them take a minute to make */
    "clouds.count",                                           /* clouds, each with a draw of its own */
    "shallow.cells",                                          /* a million, which no cache holds */
    "spray.0.count",                                          /* a million, which are moved one by one */
    "water.waves.count",      "water.optics.caustics_texels", /* maps, of which the texels are more */
    "quality.entity_shadows", "quality.lamp_shadows",
};

static bool may_be_greatest(const char *path)
{
    for (size_t i = 0; i < sizeof asks_for_more / sizeof *asks_for_more; i++)
        if (strcmp(asks_for_more[i], path) == 0)
            return false;
    return true;
}

/* How many times as long as the work that it asks for lets expect. */
static double slowness(const struct answer *it, double clean, uint64_t clean_work)
{
    const double more = (double)it->work / (double)clean_work;
    return it->least / clean / (more > 1 ? more : 1);
}

static void try_value(struct cases *cases, const char *path, const lom_key *key, double x)
{
    char override[256];
    int length = snprintf(override, sizeof override, "%s=%s", path, key->count < 2 ? "" : "[");
    for (int i = 0; i < (key->count < 2 ? 1 : key->count); i++)
        length += snprintf(override + length, sizeof override - (size_t)length, "%s%.17g", i == 0 ? "" : ", ", x);
    if (key->count >= 2)
        snprintf(override + length, sizeof override - (size_t)length, "]");
    cases->count++;
    run_case(cases->text, override, false);
    if (!answer->drawn)
        return;
    cases->drawn++;
    double slow = slowness(answer, cases->clean.least, cases->clean.work);
    if (slow > most) {
        run_case(cases->text, override, true);
        slow = slowness(answer, answer->clean, cases->clean.work);
        CHECK(slow <= most, "%s, --set %s: %g times as long", cases->base->name, override, slow);
        printf("    %s: %.2f, work %.2f\n", override, slow, (double)answer->work / (double)cases->clean.work);
    }
    const struct drawn d = { .work = answer->work, .denormals = answer->denormals };
    check_denormals(&d, cases->clean.work, cases->base->name, override);
    if (slow > cases->worst) {
        cases->worst = slow;
        memcpy(cases->worst_of, override, sizeof override);
    }
}

static void try_key(void *context, const char *path, const lom_key *key, const void *member)
{
    struct cases *cases = context;
    if (member == NULL || !is_tried(cases->base->keys, path) ||
        (key->type != LOM_KEY_NUMBER && key->type != LOM_KEY_INTEGER && key->type != LOM_KEY_COLOR))
        return;
    const bool any = key->minimum == 0 && key->maximum == 0;
    const double low = any ? -1e30 : key->minimum, high = any ? 1e30 : key->maximum;
    if ((key->flags & LOM_KEY_ABOVE) == 0)
        try_value(cases, path, key, low);
    if (may_be_greatest(path))
        try_value(cases, path, key, high);
    if (key->type != LOM_KEY_INTEGER && low < 1e-41 && high > 1e-41)
        try_value(cases, path, key, 1e-41);
}

static void try_base(const struct base *base)
{
    struct cases cases = { .base = base };
    char path[LONGEST_PATH];
    lom_error error = { 0 };
    snprintf(cases.text, sizeof cases.text, "%s%s", head, base->text);
    lom_scene *scene = lom_decode_scene(cases.text, strlen(cases.text), small_path("scene.toml"), NULL, 0, &error);
    run_case(cases.text, NULL, false);
    cases.clean = *answer;
    CHECK(scene != NULL && answer->drawn, "%s: %s", base->name, error.text);
    if (scene != NULL && answer->drawn)
        walk_keys(&lom_scene_keys, path, 0, scene, try_key, &cases);
    lom_free_scene(scene);
    printf("  %-18s %4d cases, %4d drawn, %.2f of the time at most: %s\n", base->name, cases.count, cases.drawn,
           cases.worst, cases.worst_of);
}

static void try_bases(const struct base *of, size_t count)
{
    const char *only = getenv("LOM_SCENE");
    for (size_t i = 0; i < count; i++)
        if (strstr(of[i].text, "reference") == NULL && (only == NULL || strcmp(only, of[i].name) == 0))
            try_base(&of[i]);
}

static void every_number_at_the_ends_of_its_range(void)
{
    try_bases(bases, sizeof bases / sizeof *bases);
    try_bases(more_bases, sizeof more_bases / sizeof *more_bases);
}

int main(int argc, char **argv)
{
#ifdef SANITIZED
    printf("SKIP a sanitizer watches: time says nothing\n");
    return 0;
#endif
    if (!make_small_scene())
        return 1;
    answer = mmap(NULL, sizeof *answer, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (answer == MAP_FAILED)
        return 1;
    RUN(every_number_at_the_ends_of_its_range);
    remove_small_scene();
    return check_result();
}
