/* The reference work's lighting in advance (formula: lom/cloud.h). In: densities and the way to the light. Out: gray
 * and density. Invariant: densities are read and grays written to another volume, so that no voxel's light depends on
 * their order. */
#include <lom/cloud.h>

#include "base/own_float_state.h"

static int byte_of(const lom_image *density, int x, int y, int z)
{
    const void *p = lom_image_pixel(density, x, y, z);
    if (density->format == LOM_FORMAT_R8)
        return *(const uint8_t *)p;
    if (density->format == LOM_FORMAT_R16)
        return (*(const uint16_t *)p * 255 + 32767) / 65535;
    float value = *(const float *)p;
    return lom_int_of((value > 0 ? value < 1 ? value : 1 : 0) * 255.0f + 0.5f);
}

/* Towards the light from the middle of a voxel, a voxel of the longest side at a time. */
static double gray_of(const lom_image *density, const int voxel[3], const double step[3], double lighter,
                      double dark_light)
{
    const int size[3] = { density->width, density->height, density->depth };
    double sum = 0, count = 0;
    for (int k = 1;; k++) {
        int at[3];
        for (int i = 0; i < 3; i++) {
            double place = voxel[i] + 0.5 + k * step[i];
            if (!(place >= 0 && place < size[i]))
                return count == 0 || sum / count < 100 ? 255 : 255 - sum / count;
            at[i] = lom_int_of(place);
        }
        sum += byte_of(density, at[0], at[1], at[2]) * lighter;
        count++;
        if (sum > 250) {
            double mean = sum / (count * dark_light);
            return mean < 100 ? 255 : mean < 255 ? 255 - mean : 0;
        }
    }
}

lom_image *lom_light_cloud_in_advance(const lom_image *density, const double to_light[3], double lighter,
                                      double dark_light, lom_error *error)
{
    LOM_OWN_FLOAT_STATE;
    lom_image *lit = lom_create_image(density->width, density->height, density->depth, LOM_FORMAT_RGBA8, error);
    double length = lom_double_sqrt(to_light[0] * to_light[0] + to_light[1] * to_light[1] + to_light[2] * to_light[2]);
    double step[3];
    for (int i = 0; i < 3; i++)
        step[i] = length > 0 ? to_light[i] / length : i == 1;
    for (int z = 0; lit != NULL && z < lit->depth; z++)
        for (int y = 0; y < lit->height; y++)
            for (int x = 0; x < lit->width; x++) {
                const int voxel[3] = { x, y, z };
                uint8_t *to = lom_image_pixel(lit, x, y, z);
                to[3] = (uint8_t)byte_of(density, x, y, z);
                to[0] = to[1] = to[2] = 255;
                if (to[3] != 0 && lighter > 0) /* nothing met weighs anything: white */
                    to[0] = to[1] = to[2] =
                        (uint8_t)lom_count_of(gray_of(density, voxel, step, lighter, dark_light) + 0.5, 255);
            }
    return lit;
}
