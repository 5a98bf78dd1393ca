/* Adding up the light that lands on the bed. In: landing places. Out: a texture of light. Invariant: sums of integers.
 */
#include "water/caustics.h"

static const double unit = 65536;

/* The quadratic B-spline about a place: the weights of the texel it is in and of both neighbours. */
static void spline(double place, double weight[3])
{
    weight[0] = 0.5 * (1 - place) * (1 - place);
    weight[2] = 0.5 * place * place;
    weight[1] = 1 - weight[0] - weight[2];
}

static void add_photon(uint64_t *sum, int size, double x, double y, double light)
{
    double fx = lom_double_floor(x), fy = lom_double_floor(y), wx[3], wy[3];
    if (!(fx >= -1) || !(fx <= size) || !(fy >= -1) || !(fy <= size) || !(light > 0))
        return;
    spline(x - fx, wx);
    spline(y - fy, wy);
    for (int j = 0; j < 3; j++)
        for (int i = 0; i < 3; i++) {
            int column = lom_int_of(fx) + i - 1, row = lom_int_of(fy) + j - 1;
            if (column >= 0 && column < size && row >= 0 && row < size)
                sum[(size_t)row * (size_t)size + (size_t)column] +=
                    (uint64_t)lom_int64_of(light * wx[i] * wy[j] * unit + 0.5);
        }
}

lom_image *lom_gather_photons(const lom_image *photons, lom_error *error)
{
    int size = photons->width;
    uint64_t *sum = lom_allocate((size_t)size * (size_t)size, sizeof *sum, error);
    lom_image *light = sum != NULL ? lom_create_image(size, size, 1, LOM_FORMAT_R32F, error) : NULL;
    for (int y = 0; light != NULL && y < size; y++)
        for (int x = 0; x < size; x++) {
            const float *photon = lom_image_pixel(photons, x, y, 0);
            add_photon(sum, size, (double)photon[0], (double)photon[1], (double)photon[2]);
        }
    for (int y = 0; light != NULL && y < size; y++)
        for (int x = 0; x < size; x++) {
            float *texel = lom_image_pixel(light, x, y, 0);
            *texel = (float)((double)sum[(size_t)y * (size_t)size + (size_t)x] / unit);
        }
    lom_release(sum);
    return light;
}
