/* Measuring one way to draw a scene. In: a subject, dials with their settings. Out: its picture, the errors of that,
 * times. Invariant: a picture here is that of `lom render` with the same overrides; the clock runs over whole frames
 * alone, and both ways of a pair meet the same load of the machine. */
#include "measure/trial.h"

#include "measure/median.h"

#include <string.h>
#include <time.h>

enum { RUN = 8 }; /* frames before one that depends on them */

/* ---- drawing ---- */

static bool has_changed_device(const lom_device_desc *a, const lom_device_desc *b)
{
    return a->threads != b->threads || a->lanes != b->lanes || a->tile != b->tile;
}

/* The scene of this way, and how the program draws it. */
static lom_scene *read_subject(const lom_subject *subject, const lom_choices *choices, lom_device_desc *device,
                               int *parts, lom_error *error)
{
    char texts[LOM_MAX_CHOICES][128];
    const char **changes = lom_allocate(subject->change_count + LOM_MAX_CHOICES, sizeof *changes, error);
    size_t count = 0;
    if (changes == NULL)
        return NULL;
    for (; count < subject->change_count; count++)
        changes[count] = subject->changes[count];
    for (int i = 0; i < choices->count; i++) {
        const lom_choice *choice = &choices->choice[i];
        double number = 0;
        if (choice->dial->key.key != NULL) {
            lom_print_dial_override(texts[i], choice->dial, choice->setting);
            changes[count++] = texts[i];
        } else if (lom_parse_double(choice->setting, strlen(choice->setting), &number)) {
            choice->dial->set(device, parts, lom_int_of(number));
        }
    }
    lom_scene *scene = lom_read_scene(subject->path, changes, count, error);
    lom_release(changes);
    return scene;
}

bool lom_set_drawer(lom_drawer *drawer, const lom_subject *subject, const lom_choices *choices, lom_error *error)
{
    lom_device_desc device = subject->device;
    int parts = 1;
    lom_scene *scene = read_subject(subject, choices, &device, &parts, error);
    if (scene == NULL)
        return false;
    lom_renderer *renderer = drawer->renderer;
    bool done = true;
    if (renderer == NULL || has_changed_device(&device, &drawer->device)) {
        renderer = lom_create_renderer(scene, &device, error);
        done = renderer != NULL;
    } else {
        done = lom_change_scene(renderer, scene, NULL, error);
    }
    if (!done) {
        lom_free_scene(scene);
        return false;
    }
    if (renderer != drawer->renderer)
        lom_free_renderer(drawer->renderer);
    lom_free_scene(drawer->scene);
    *drawer = (lom_drawer){ scene, renderer, device, parts };
    return true;
}

bool lom_is_refusal(const lom_error *error)
{
    return error->code != LOM_ERROR_MEMORY && error->code != LOM_ERROR_FILE && error->code != LOM_ERROR_THREAD;
}

void lom_end_drawer(lom_drawer *drawer)
{
    lom_free_renderer(drawer->renderer);
    lom_free_scene(drawer->scene);
    *drawer = (lom_drawer){ .scene = NULL };
}

static lom_rect part_of(lom_rect whole, int parts, int column, int row)
{
    const int left = whole.width * column / parts, right = whole.width * (column + 1) / parts;
    const int top = whole.height * row / parts, bottom = whole.height * (row + 1) / parts;
    return (lom_rect){ whole.x + left, whole.y + top, right - left, bottom - top };
}

static void put_part(lom_image *joined, const lom_image *part, int x, int y)
{
    const size_t pixel = lom_format_size(part->format);
    for (int row = 0; row < part->height; row++)
        memcpy(lom_image_pixel(joined, x, y + row, 0), lom_image_pixel(part, 0, row, 0), (size_t)part->width * pixel);
}

/* The frame crop by crop. */
static lom_image *draw_parts(const lom_drawer *drawer, const lom_frame_desc *desc, lom_error *error)
{
    const lom_output *output = &drawer->scene->output;
    lom_rect whole = desc->crop;
    if (whole.width == 0)
        whole = (lom_rect){ 0, 0, desc->width > 0 ? desc->width : output->width,
                            desc->height > 0 ? desc->height : output->height };
    lom_image *joined = NULL;
    bool done = true;
    for (int i = 0; done && i < drawer->parts * drawer->parts; i++) {
        lom_frame_desc own = *desc;
        lom_frame frame;
        own.crop = part_of(whole, drawer->parts, i % drawer->parts, i / drawer->parts);
        if (own.crop.width == 0 || own.crop.height == 0)
            continue;
        done = lom_render_frame(drawer->renderer, &own, &frame, error);
        if (done && joined == NULL)
            joined = lom_create_image(whole.width, whole.height, 1, frame.image->format, error);
        done = done && joined != NULL;
        if (done)
            put_part(joined, frame.image, own.crop.x - whole.x, own.crop.y - whole.y);
        lom_free_image(frame.image);
    }
    if (done)
        return joined;
    lom_free_image(joined);
    return NULL;
}

static lom_image *draw_number(const lom_drawer *drawer, const lom_frame_desc *desc, int number, lom_error *error)
{
    lom_frame frame = { .image = NULL };
    lom_frame_desc own = *desc;
    own.frame = number;
    if (drawer->parts > 1)
        return draw_parts(drawer, &own, error);
    return lom_render_frame(drawer->renderer, &own, &frame, error) ? frame.image : NULL;
}

lom_image *lom_draw_subject(const lom_drawer *drawer, const lom_subject *subject, lom_error *error)
{
    const int last = subject->frame.frame;
    int first = last;
    if (drawer->scene->quality.impostors != LOM_IMPOSTORS_OFF)
        first = last > RUN ? last - RUN : 0;
    for (int number = first; number < last; number++) {
        lom_image *before = draw_number(drawer, &subject->frame, number, error);
        if (before == NULL)
            return NULL;
        lom_free_image(before);
    }
    lom_image *picture = draw_number(drawer, &subject->frame, last, error);
    /* As files have it, which do not say that their numbers are sRGB's. */
    if (picture != NULL && picture->format == LOM_FORMAT_RGB8_SRGB)
        lom_reinterpret_image(picture, LOM_FORMAT_RGB8, error);
    return picture;
}

/* ---- errors ---- */

bool lom_measure_error(const lom_image *reference, const lom_image *picture, lom_picture_error *out, lom_error *error)
{
    lom_comparison comparison;
    if (!lom_compare_images(reference, picture, &comparison, error))
        return false;
    if (!comparison.same_size)
        return lom_fail(error, LOM_ERROR_USAGE, "The reference has %dx%d pixels, the picture %dx%d.", reference->width,
                        reference->height, picture->width, picture->height);
    *out =
        (lom_picture_error){ .psnr = comparison.psnr, .max_delta = comparison.max_delta, .pixels = comparison.pixels };
    return lom_compare_ssim(reference, picture, &out->ssim, error) &&
           lom_compare_flip(reference, picture, &out->flip, error);
}

/* ---- times ---- */

static double now_ms(const lom_subject *subject)
{
    struct timespec t;
    clock_gettime(subject->of_processors ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e3 + (double)t.tv_nsec * 1e-6;
}

static bool time_frame(const lom_drawer *drawer, const lom_subject *subject, int number, double *ms, lom_error *error)
{
    const double start = now_ms(subject);
    lom_image *picture = draw_number(drawer, &subject->frame, number, error);
    *ms = now_ms(subject) - start;
    lom_free_image(picture);
    return picture != NULL;
}

/* Who comes first changes from pair to pair. */
static bool time_pair(const lom_drawer *const drawers[2], const lom_subject *subject, int pair, double ms[2],
                      lom_error *error)
{
    const int first = pair & 1;
    const int number = subject->frame.frame + pair;
    return time_frame(drawers[first], subject, number, &ms[first], error) &&
           time_frame(drawers[1 - first], subject, number, &ms[1 - first], error);
}

bool lom_time_pairs(const lom_drawer *drawer, const lom_drawer *other, const lom_subject *subject, int pairs,
                    lom_pair_time *out, lom_error *error)
{
    const lom_drawer *const drawers[2] = { drawer, other };
    double *times = lom_allocate((size_t)pairs * 3, sizeof *times, error), ms[2];
    if (times == NULL)
        return false;
    double *mine = times, *its = times + pairs, *ratios = its + pairs;
    bool done = time_pair(drawers, subject, 0, ms, error);
    for (int i = 0; done && i < pairs; i++) {
        done = time_pair(drawers, subject, i + 1, ms, error);
        mine[i] = ms[0];
        its[i] = ms[1];
        ratios[i] = ms[0] / ms[1];
    }
    if (done) {
        *out = (lom_pair_time){ .ms = lom_median(mine, pairs), .other_ms = lom_median(its, pairs) };
        out->ratio = lom_median(ratios, pairs);
        out->low = ratios[pairs / 4];
        out->high = ratios[pairs - 1 - pairs / 4];
    }
    lom_release(times);
    return done;
}
