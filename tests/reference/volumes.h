/* Volumes for tests of the reference, from a function of the place. */
#ifndef LOM_TESTS_REFERENCE_VOLUMES_H
#define LOM_TESTS_REFERENCE_VOLUMES_H

#include "reference/volume.h"

struct volume_of {
    int size[3];
    lom_vec3 low, high;
    double extinction, albedo;
    lom_reference_phase phase;
    const lom_image *detail;
    double detail_strength, detail_size;
    double (*at)(double x, double y, double z); /* the density at a centre, 0..1 over the box; NULL: 1 */
};

static inline lom_reference_volume *make_volume(const struct volume_of *v)
{
    lom_image *image = lom_create_image(v->size[0], v->size[1], v->size[2], LOM_FORMAT_R32F, NULL);
    for (int z = 0; z < v->size[2]; z++)
        for (int y = 0; y < v->size[1]; y++)
            for (int x = 0; x < v->size[0]; x++) {
                float *voxel = lom_image_pixel(image, x, y, z);
                *voxel = v->at == NULL
                             ? 1
                             : (float)v->at((x + 0.5) / v->size[0], (y + 0.5) / v->size[1], (z + 0.5) / v->size[2]);
            }
    lom_reference_volume *volume =
        lom_create_reference_volume(&(lom_reference_volume_desc){ .density = image,
                                                                  .low = v->low,
                                                                  .high = v->high,
                                                                  .extinction = v->extinction,
                                                                  .detail = v->detail,
                                                                  .detail_strength = v->detail_strength,
                                                                  .detail_size = v->detail_size,
                                                                  .albedo = { v->albedo, v->albedo, v->albedo },
                                                                  .phase = v->phase },
                                    NULL);
    lom_free_image(image);
    return volume;
}

#endif
