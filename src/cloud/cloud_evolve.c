/* Clouds whose shapes change. In: fields of tiling noise, a time. Out: the noise that eats into them, and how far it
 * eats into each. Invariant: a closed form of the time; the noise has the same mean and variance at every time. */
#include "base/numbers.h"
#include "cloud/cloud_draw.h"
#include "cloud/detail_noise.h"

enum { STEPS = 256 }; /* of a crossfade: finer ones change less than a step of 8 bits */

double lom_cloud_phase_at(const lom_clouds *params, double time)
{
    if (!(params->evolve > 0))
        return 0;
    static const double most = 0x1p44; /* below it a double holds a phase in whole steps; beyond, shapes stand still */
    double phase = lom_double_floor(time / params->evolve * STEPS) / STEPS;
    return phase > -most ? phase < most ? phase : most : -most;
}

static double mean_of(const lom_image *noise)
{
    uint64_t sum = 0;
    for (size_t i = 0; i < lom_image_size(noise); i++)
        sum += noise->pixels[i];
    return (double)sum / (double)lom_image_size(noise);
}

/* Independent fields a and b with means m and n: m + (a - m) cos + (b - n) sin has the mean m and the variance of one
 * field at every angle; both weights are positive within the quarter turn, so that hollows stay hollows. */
static void mix_fields(const lom_image *a, const lom_image *b, double part, lom_image *out)
{
    double c = lom_double_cos(lom_two_pi / 4 * part), s = lom_double_sin(lom_two_pi / 4 * part);
    double m = mean_of(a), n = mean_of(b);
    for (size_t i = 0; i < lom_image_size(out); i++) {
        double value = m + (a->pixels[i] - m) * c + (b->pixels[i] - n) * s + 0.5;
        out->pixels[i] = (uint8_t)lom_count_of(value > 0 ? value < 255 ? value : 255 : 0, 255);
    }
}

/* Each cloud swells and shrinks in a phase of its own. */
static void swell(struct lom_cloud_set *set, double time)
{
    for (size_t i = 0; i < set->count; i++) {
        struct lom_placed_cloud *placed = &set->clouds[i];
        double turns = time / (2 * set->params->evolve) + lom_random_uniform(19, i);
        turns -= lom_double_floor(turns);
        double detail = placed->cloud->detail * (1 - set->params->swell * lom_double_sin(lom_two_pi * turns));
        placed->detail = detail < 0.95 ? detail : 0.95;
    }
}

bool lom_evolve_clouds(struct lom_cloud_set *set, double time, lom_error *error)
{
    if (!(set->params->evolve > 0))
        return true;
    double phase = lom_cloud_phase_at(set->params, time);
    swell(set, phase * set->params->evolve);
    if (set->phase == phase)
        return true;
    double whole = lom_double_floor(phase), turn = lom_double_floor(whole / LOM_DETAIL_FIELDS);
    int from = (int)lom_count_of(whole - turn * LOM_DETAIL_FIELDS, LOM_DETAIL_FIELDS - 1);
    lom_image *mixed = lom_create_image(LOM_DETAIL_SIZE, LOM_DETAIL_SIZE, LOM_DETAIL_SIZE, LOM_FORMAT_R8, error);
    if (mixed != NULL)
        mix_fields(set->fields[from], set->fields[(from + 1) % LOM_DETAIL_FIELDS], phase - whole, mixed);
    lom_detail *detail = mixed != NULL ? lom_create_detail(mixed, error) : NULL;
    lom_free_image(mixed);
    if (detail == NULL)
        return false;
    lom_free_detail(set->detail);
    set->detail = detail;
    set->phase = phase;
    return true;
}
