/* Adding up the light that lands on the bed. In: landing places. Out: a texture of light. Invariant: sums of integers.
 */
#include "water/caustics.h"
#include "image/texture.h"

#include <string.h>

static const double unit = 65536;

/* The quadratic B-spline about a place: the weights of the texel it is in and of both neighbours. */
static void spline(double place, double weight[3])
{
    weight[0] = 0.5 * (1 - place) * (1 - place);
    weight[2] = 0.5 * place * place;
    weight[1] = 1 - weight[0] - weight[2];
}

/* To the rows first .. end - 1. */
static void add_photon(uint64_t *sum, int size, int first, int end, double x, double y, double light)
{
    double fx = lom_double_floor(x), fy = lom_double_floor(y), wx[3], wy[3];
    if (!(fx >= -1) || !(fx <= size) || !(fy >= first - 1) || !(fy <= end) || !(light > 0))
        return;
    spline(x - fx, wx);
    spline(y - fy, wy);
    for (int j = 0; j < 3; j++)
        for (int i = 0; i < 3; i++) {
            int column = lom_int_of(fx) + i - 1, row = lom_int_of(fy) + j - 1;
            if (column >= 0 && column < size && row >= first && row < end)
                sum[(size_t)row * (size_t)size + (size_t)column] +=
                    (uint64_t)lom_int64_of(light * wx[i] * wy[j] * unit + 0.5);
        }
}

bool lom_make_gathered_light(struct lom_gathered_light *light, int size, lom_error *error)
{
    size_t texels = (size_t)size * (size_t)size;
    light->size = size;
    light->texel = lom_allocate(texels, sizeof *light->texel, error);
    light->sum = lom_allocate(texels, sizeof *light->sum, error);
    return light->texel != NULL && light->sum != NULL;
}

void lom_free_gathered_light(struct lom_gathered_light *light)
{
    lom_release(light->texel);
    lom_release(light->sum);
}

void lom_gather_photons(struct lom_gathered_light *light, const lom_texture *photons, int first, int end)
{
    const int size = light->size;
    const size_t begin = (size_t)first * (size_t)size, texels = (size_t)(end - first) * (size_t)size;
    memset(light->sum + begin, 0, texels * sizeof *light->sum);
    for (int y = 0; y < size; y++) {
        const float(*photon)[4] = lom_texel(photons, 0, 0, y, 0);
        for (int x = 0; x < size; x++)
            add_photon(light->sum, size, first, end, (double)photon[x][0], (double)photon[x][1], (double)photon[x][2]);
    }
    for (size_t i = begin; i < begin + texels; i++)
        light->texel[i] = (float)((double)light->sum[i] / unit);
}
