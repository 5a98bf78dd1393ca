/* Proves that no pixel depends on the packet, the worker, the tile or the crop that it is drawn in, by scenes made of
 * numbers (numbered_scene.h), drawn with each number of lanes that runs here, by one worker and by three. All are the same
 * bytes, and crops at odd places are those of the whole. LOM_CASE=n draws scene n alone, every way, and shows it.
 * LOM_EXHAUSTIVE=1 draws every way too and goes on for LOM_SECONDS (60), from scene LOM_FIRST on. */
#include "check.h"
#include "lanes/variants.h"
#include "numbered_scene.h"
#include "sanitized.h"

#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>

enum {
    CASES = 40,
    MOST_SECONDS = 20, /* of the processor for a case; what takes longer is left out */
    FEW_SECONDS = 2,   /* of the few cases that are always tried, two other ways each */
    MOST_MEMORY = 2000000000
};

/* ---- drawing ---- */

struct way {
    int lanes;
    bool plain;
    int threads, tile;
};
static const struct way ways[] = {
    { 4, false, 1, 64 },  { 4, false, 3, 16 }, { 8, false, 1, 64 }, { 16, false, 1, 64 },
    { 16, false, 3, 32 }, { 8, true, 1, 16 },  { 16, true, 3, 64 },
};
enum { WAYS = sizeof ways / sizeof *ways };

/* What the process of a case says of it. */
struct answer {
    bool refused, differs;
    char text[900];
};

/* The whole picture, and the part; false: no scene, or no frame of it. */
static bool draw(const struct recipe *r, const struct way *way, lom_rect crop, lom_image *pictures[2], lom_error *error)
{
    const lom_device_desc device = {
        .threads = way->threads, .lanes = way->lanes, .plain = way->plain, .tile = way->tile
    };
    const lom_rect crops[2] = { { 0, 0, r->width, r->height }, crop };
    lom_scene *scene = decode(r, error);
    lom_renderer *renderer = scene != NULL ? lom_create_renderer(scene, &device, error) : NULL;
    bool drawn = renderer != NULL;
    for (int i = 0; i < 2 && drawn; i++) {
        const lom_frame_desc desc = { .width = r->width, .height = r->height, .frame = r->frame, .crop = crops[i] };
        lom_frame frame = { .image = NULL };
        drawn = lom_render_frame(renderer, &desc, &frame, error);
        pictures[i] = frame.image;
    }
    lom_free_renderer(renderer);
    lom_free_scene(scene);
    return drawn;
}

static void compare(struct answer *answer, const lom_image *whole, const lom_image *part, lom_rect crop,
                    const struct way *way)
{
    const size_t size = lom_format_size(whole->format);
    for (int y = 0; y < part->height; y++)
        for (int x = 0; x < part->width; x++) {
            const void *a = lom_image_pixel(whole, crop.x + x, crop.y + y, 0), *b = lom_image_pixel(part, x, y, 0);
            float light[2][3] = { { 0 } };
            if (memcmp(a, b, size) == 0 || answer->differs)
                continue;
            answer->differs = true;
            memcpy(light[0], a, size < sizeof light[0] ? size : sizeof light[0]);
            memcpy(light[1], b, size < sizeof light[1] ? size : sizeof light[1]);
            snprintf(answer->text, sizeof answer->text,
                     "%d %slanes, %d threads, tiles of %d, crop %d,%d,%d,%d: pixel %d, %d is %.9g %.9g %.9g, not %.9g "
                     "%.9g %.9g",
                     way->lanes, way->plain ? "plain " : "", way->threads, way->tile, crop.x, crop.y, crop.width,
                     crop.height, crop.x + x, crop.y + y, (double)light[1][0], (double)light[1][1], (double)light[1][2],
                     (double)light[0][0], (double)light[0][1], (double)light[0][2]);
        }
}

static lom_rect odd_crop(const struct recipe *r, uint64_t i)
{
    const int x = (int)(lom_random_bits(r->crops, 4 * i) % (uint64_t)(r->width - 1)) | 1;
    const int y = (int)(lom_random_bits(r->crops, 4 * i + 1) % (uint64_t)(r->height - 1));
    return (lom_rect){ x < r->width ? x : r->width - 1, y,
                       1 + (int)(lom_random_bits(r->crops, 4 * i + 2) % (uint64_t)(r->width - x)),
                       1 + (int)(lom_random_bits(r->crops, 4 * i + 3) % (uint64_t)(r->height - y)) };
}

static void free_both(lom_image *pictures[2])
{
    lom_free_image(pictures[0]);
    lom_free_image(pictures[1]);
}

/* One way and `tries` of the others, which are all of them in turn. */
static void draw_many_ways(const struct recipe *r, int tries, struct answer *answer)
{
    lom_error error;
    const lom_rect all = { 0, 0, r->width, r->height };
    lom_image *first[2] = { NULL }, *other[2];
    answer->refused = !draw(r, &ways[0], odd_crop(r, 0), first, &error);
    if (answer->refused)
        snprintf(answer->text, sizeof answer->text, "%s", error.text);
    else
        compare(answer, first[0], first[1], odd_crop(r, 0), &ways[0]);
    for (int i = 0; i < tries && !answer->refused && !answer->differs; i++) {
        const int number = 1 + (int)((r->number + (uint64_t)i * 4) % (WAYS - 1));
        const struct way *way = &ways[tries == WAYS - 1 ? i + 1 : number];
        const lom_rect crop = odd_crop(r, (uint64_t)i + 1);
        memset(other, 0, sizeof other);
        if (lom_find_variant(way->lanes, way->plain) < 0)
            continue;
        if (draw(r, way, crop, other, &error)) {
            compare(answer, first[0], other[0], all, way);
            compare(answer, first[0], other[1], crop, way);
        } else {
            answer->differs = true;
            snprintf(answer->text, sizeof answer->text, "%d lanes refuse: %s", way->lanes, error.text);
        }
        free_both(other);
    }
    free_both(first);
}

/* ---- all cases ---- */

static struct answer *answer; /* shared with the processes */

struct sums {
    int drawn, refused, long_ones;
};

static bool tries_all(void)
{
    return getenv("LOM_EXHAUSTIVE") != NULL || getenv("LOM_CASE") != NULL;
}

static void try_case(uint64_t number, const char *program, bool shows, struct sums *sums)
{
    static struct recipe recipe;
    make_recipe(&recipe, number);
    if (shows)
        show(&recipe);
    memset(answer, 0, sizeof *answer);
    fflush(stdout);
    pid_t child = fork();
    if (child == 0) {
        const rlim_t most = tries_all() ? MOST_SECONDS : FEW_SECONDS;
        setrlimit(RLIMIT_CPU, &(struct rlimit){ most, most });
#ifndef SANITIZED
        setrlimit(RLIMIT_AS, &(struct rlimit){ MOST_MEMORY, MOST_MEMORY });
#endif
        draw_many_ways(&recipe, tries_all() ? WAYS - 1 : 2, answer);
        _exit(0);
    }
    int status = -1;
    waitpid(child, &status, 0);
    const bool late = WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL);
    CHECK((late || status == 0) && !answer->differs, "case %llu (%s), status 0x%x: %s; repeat: LOM_CASE=%llu %s",
          (unsigned long long)number, recipe.name, status, answer->text, (unsigned long long)number, program);
    sums->long_ones += late;
    sums->refused += answer->refused;
    sums->drawn += !late && !answer->refused;
    if (shows && answer->refused)
        printf("%s\n", answer->text);
}

/* A part of one of the small scenes, with an entity more or a setting, is that of the whole. */
static void expect_part(const struct recipe *kind, const char *part, lom_rect crop)
{
    static struct recipe r;
    lom_error error;
    lom_image *pictures[2] = { NULL };
    r = *kind;
    for (size_t i = 0; i < ALL_BASES; i++)
        if (strcmp(numbered_base(i)->name, r.name) == 0)
            snprintf(r.text, sizeof r.text, "%s%s%s", head, numbered_base(i)->text, part);
    memset(answer, 0, sizeof *answer);
    CHECK(draw(&r, &ways[0], crop, pictures, &error), "%s", error.text);
    if (pictures[1] != NULL)
        compare(answer, pictures[0], pictures[1], crop, &ways[0]);
    CHECK(!answer->differs, "%s: %s", r.name, answer->text);
    free_both(pictures);
}

/* The near plane of a picture so wide reaches far below the eye, and cuts the upper face of the slab in which waves are: where
 * the water may be seen was found without it. */
static void wide_pictures_show_all_of_the_water(void)
{
    const struct recipe carried = {
        .name = "carried", .width = 45, .height = 19, .frame = 1, .items = { "camera.field_of_view=179" }, .count = 1
    };
    expect_part(&carried, "", (lom_rect){ 27, 3, 3, 9 });
}

/* Where triangles are cut whose corners are 1e30 m away, rounding decides: the picture below the water is drawn, not copied
 * where the frame shows it. */
static void what_reaches_too_far_is_not_copied(void)
{
    const struct recipe lake = { .name = "lake", .width = 45, .height = 24, .frame = 3 };
    expect_part(&lake, parts[0], (lom_rect){ 21, 17, 8, 7 });
}

static uint64_t number_of(const char *name, uint64_t otherwise)
{
    const char *text = getenv(name);
    return text != NULL ? strtoull(text, NULL, 10) : otherwise;
}

static const char *program;

static void every_way_draws_the_same(void)
{
    const bool exhaustive = getenv("LOM_EXHAUSTIVE") != NULL, one = getenv("LOM_CASE") != NULL;
    const uint64_t first = one ? number_of("LOM_CASE", 0) : number_of("LOM_FIRST", 0);
    const time_t end = time(NULL) + (time_t)number_of("LOM_SECONDS", 60);
    struct sums sums = { 0 };
    uint64_t number = first;
    do {
        try_case(number++, program, one, &sums);
        if (exhaustive && number % 64 == 0)
            fflush(stdout);
    } while (!one && (exhaustive ? time(NULL) < end : number < first + CASES));
    printf("  cases %llu to %llu: %d drawn, %d refused, %d took too long\n", (unsigned long long)first,
           (unsigned long long)number - 1, sums.drawn, sums.refused, sums.long_ones);
    CHECK(one || 2 * sums.drawn >= (int)(number - first), "most are drawn");
}

int main(int argc, char **argv)
{
    lom_error error = { 0 };
    if (!make_small_scene() || !small_text("wild.obj", wild_obj, &error))
        return 1;
    program = argv[0];
    answer = mmap(NULL, sizeof *answer, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (answer == MAP_FAILED)
        return 1;
    RUN(wide_pictures_show_all_of_the_water);
    RUN(what_reaches_too_far_is_not_copied);
    RUN(every_way_draws_the_same);
    remove_small_scene();
    return check_result();
}
