/* The workload that is a grid of light. In: a cumulus; out: how much of the sun each of its voxels sees, and a picture
 * of it. Invariant: every frame sweeps the same grid towards the same sun, one that makes the slices lie across x, the
 * axis along which voxels are neighbours: what costs most. */
#include "workload.h"

#include <lom/cloud.h>

static bool make_light(lom_workload *w, lom_error *error)
{
    const lom_cloud_desc desc = { "cumulus_mediocris", w->width, w->width, w->width, 1 };
    float kept[256];
    for (int i = 0; i < 256; i++)
        kept[i] = (float)i / 255;
    lom_image *density = lom_make_cloud(&desc, error);
    w->grid = density != NULL ? lom_create_light_grid(density, 1, kept, error) : NULL;
    lom_free_image(density);
    return w->grid != NULL;
}

void lom_draw_light(lom_workload *w, lom_device *device)
{
    (void)device;
    const lom_light_desc desc = { .size = { 1600, 1000, 1500 },
                                  .extinction = 0.05f,
                                  .to_light = { 0.8479983f, 0.42399915f, 0.31799936f } };
    lom_sweep_sun(w->grid, &desc, &w->error);
}

enum { ACROSS = 16 };

static lom_image *light_picture(const lom_workload *w, lom_error *error)
{
    int n = w->width;
    lom_image *picture = lom_create_image(ACROSS * n, (n + ACROSS - 1) / ACROSS * n, 1, LOM_FORMAT_RGBA8, error);
    for (int z = 0; picture != NULL && z < n; z++)
        for (int y = 0; y < n; y++)
            for (int x = 0; x < n; x++) {
                size_t at = ((size_t)z * (size_t)(n + 1) + (size_t)y) * (size_t)(n + 1) + (size_t)x;
                uint8_t *pixel = lom_image_pixel(picture, z % ACROSS * n + x, z / ACROSS * n + n - 1 - y, 0);
                pixel[0] = pixel[1] = pixel[2] = (uint8_t)((w->grid->light[at] & 0xffff) / 257);
                pixel[3] = 255;
            }
    return picture;
}

const lom_workload_task lom_light_task = { make_light, NULL, light_picture };
