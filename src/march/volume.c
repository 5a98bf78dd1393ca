/* Volumes for marching. In: an image of colour and density; out: cells with their eight corners side by side, and how
 * far each cell is from the nearest one that holds anything. Invariant: a distance is exact or capped at 255, so a
 * cell nearer than it to this one is empty. */
#include "base/numbers.h"
#include "base/own_float_state.h"
#include "march/cells.h"

#include <string.h>

void lom_free_volume(lom_volume *volume)
{
    if (volume == NULL)
        return;
    lom_release(volume->density);
    lom_release(volume->color);
    lom_release(volume->distance);
    lom_release(volume);
}

static size_t place(const lom_volume *volume, int x, int y, int z)
{
    return cell_index(volume->width, volume->height, x, y, z);
}

static uint32_t voxel(const lom_image *image, int x, int y, int z)
{
    const uint8_t *p = lom_image_pixel(image, lom_smaller_int(x, image->width - 1),
                                       lom_smaller_int(y, image->height - 1), lom_smaller_int(z, image->depth - 1));
    if (image->format == LOM_FORMAT_R8)
        return (uint32_t)p[0] << 24 | 0xffffff;
    return (uint32_t)p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

static void store_colors(lom_volume *volume, const lom_image *image)
{
    volume->empty_border = true;
    for (int z = 0; z <= volume->depth; z++)
        for (int y = 0; y <= volume->height; y++)
            for (int x = 0; x <= volume->width; x++) {
                uint32_t value = voxel(image, x, y, z);
                bool border = x == 0 || y == 0 || z == 0 || x >= volume->width - 1 || y >= volume->height - 1 ||
                              z >= volume->depth - 1;
                memcpy(&volume->color[place(volume, x, y, z)], &value, sizeof value);
                if (border && value >> 24 != 0)
                    volume->empty_border = false;
            }
}

static uint32_t density_at(const lom_volume *volume, int x, int y, int z)
{
    size_t at = place(volume, lom_smaller_int(x, volume->width), lom_smaller_int(y, volume->height),
                      lom_smaller_int(z, volume->depth));
    return (uint32_t)volume->color[at] >> 24;
}

static void store_densities(lom_volume *volume)
{
    for (int z = 0; z <= volume->depth; z++)
        for (int y = 0; y <= volume->height; y++)
            for (int x = 0; x <= volume->width; x++) {
                size_t cell = place(volume, x, y, z);
                uint32_t any = 0;
                for (int k = 0; k < 2; k++) {
                    uint32_t word = density_at(volume, x, y, z + k) | density_at(volume, x + 1, y, z + k) << 8 |
                                    density_at(volume, x, y + 1, z + k) << 16 |
                                    density_at(volume, x + 1, y + 1, z + k) << 24;
                    memcpy(&volume->density[2 * cell + (size_t)k], &word, sizeof word);
                    any |= word;
                }
                volume->distance[cell] = any != 0 ? 0 : 255;
            }
}

lom_volume *lom_create_volume(const lom_image *image, lom_error *error)
{
    LOM_OWN_FLOAT_STATE;
    if (image == NULL || (image->format != LOM_FORMAT_RGBA8 && image->format != LOM_FORMAT_R8)) {
        lom_fail(error, LOM_ERROR_USAGE, "A volume is made from an RGBA8 or R8 image.");
        return NULL;
    }
    if (image->width > LOM_MAX_VOLUME || image->height > LOM_MAX_VOLUME || image->depth > LOM_MAX_VOLUME) {
        lom_fail(error, LOM_ERROR_LIMIT, "A volume of %d x %d x %d voxels is larger than the limit of %d a side.",
                 image->width, image->height, image->depth, LOM_MAX_VOLUME);
        return NULL;
    }
    lom_volume *volume = lom_allocate(1, sizeof *volume, error);
    if (volume == NULL)
        return NULL;
    *volume = (lom_volume){ .width = image->width, .height = image->height, .depth = image->depth };
    size_t cells = place(volume, image->width, image->height, image->depth) + 1;
    volume->density = lom_allocate(cells, 2 * sizeof *volume->density, error);
    volume->color = lom_allocate(cells, sizeof *volume->color, error);
    volume->distance = lom_allocate(cells, 1, error);
    if (volume->density == NULL || volume->color == NULL || volume->distance == NULL) {
        lom_free_volume(volume);
        return NULL;
    }
    store_colors(volume, image);
    store_densities(volume);
    lom_spread_distances(volume->distance, volume->width, volume->height, volume->depth);
    return volume;
}
