/* Media for marching. In: densities of 8 or 16 bits or floats. Out: cells with the four corners of a slice side by
 * side, how far each cell is from one that holds anything, and how sharply the density bends. Invariant: a cell of
 * distance above 0 has eight corners of density 0. */
#include "base/numbers.h"
#include "base/own_float_state.h"
#include "base/cpu.h"
#include "march/cells.h"

#include <string.h>

void lom_free_medium(lom_medium *medium)
{
    if (medium == NULL)
        return;
    lom_release(medium->density);
    lom_release(medium->distance);
    lom_release(medium);
}

/* Voxel x of a row, or the last one. */
static uint32_t value_at(const lom_image *image, const void *row, int x)
{
    x = lom_smaller_int(x, image->width - 1);
    if (image->format == LOM_FORMAT_R8)
        return 257u * ((const uint8_t *)row)[x];
    if (image->format == LOM_FORMAT_R16)
        return ((const uint16_t *)row)[x];
    float value = ((const float *)row)[x];
    return (uint32_t)lom_count_of((value >= 0x1p-126f ? value < 1 ? value : 1 : 0) * 65535.0f + 0.5f, 65535);
}

/* Words k = 0, 1 of the cells of a row, from the voxels of rows y + k. */
static void store_row(int32_t *to, const lom_image *image, int y, int z)
{
    for (int k = 0; k < 2; k++) {
        const void *row =
            lom_image_pixel(image, 0, lom_smaller_int(y + k, image->height - 1), lom_smaller_int(z, image->depth - 1));
        uint32_t value = value_at(image, row, 0);
        for (int x = 0; x <= image->width; x++) {
            uint32_t next = value_at(image, row, x + 1), word = value | next << 16;
            memcpy(&to[2 * x + k], &word, sizeof word);
            value = next;
        }
    }
}

static void store_corners(lom_medium *m, const lom_image *image)
{
    for (int z = 0; z <= m->depth; z++)
        for (int y = 0; y <= m->height; y++)
            store_row(m->density + 2 * cell_index(m->width, m->height, 0, y, z), image, y, z);
    size_t slice = cell_index(m->width, m->height, 0, 0, 1), cells = slice * (size_t)(m->depth + 1);
    for (size_t cell = 0; cell < cells; cell++) {
        size_t next = cell + slice < cells ? cell + slice : cell;
        int32_t any = m->density[2 * cell] | m->density[2 * cell + 1] | m->density[2 * next] | m->density[2 * next + 1];
        m->distance[cell] = any != 0 ? 0 : 255;
    }
}

/* The corner (0, 0) of a cell, and (1, 0); of word 1 (0, 1) and (1, 1). */
static int low(int32_t word)
{
    return word & 0xffff;
}

static int high(int32_t word)
{
    return (int)((uint32_t)word >> 16);
}

/* The largest mixed second difference of a cell: over two of its axes, at any of its corners. */
static int mixed_difference(const int32_t *near, const int32_t *far)
{
    int most = lom_magnitude_int(low(near[0]) - high(near[0]) - low(near[1]) + high(near[1]));
    int other = lom_magnitude_int(low(near[0]) - high(near[0]) - low(far[0]) + high(far[0]));
    most = other > most ? other : most;
    other = lom_magnitude_int(low(near[0]) - low(near[1]) - low(far[0]) + low(far[1]));
    return other > most ? other : most;
}

/* Along a unit line d, |f''| within a cell is at most 2 (|dx dy| + |dy dz| + |dz dx|) <= 2 times the largest mixed
 * difference; the jumps of f' at the cells' faces are, a voxel of length, at most dx^2 + dy^2 + dz^2 = 1 times the
 * largest second difference along an axis. */
static float find_bend(const lom_medium *m)
{
    const size_t stride[3] = { 1, cell_index(m->width, m->height, 0, 1, 0), cell_index(m->width, m->height, 0, 0, 1) };
    int most_mixed = 0, most_along = 0;
    for (int z = 0; z < m->depth; z++)
        for (int y = 0; y < m->height; y++)
            for (int x = 0; x < m->width; x++) {
                const int at[3] = { x, y, z };
                const int32_t *cell = m->density + 2 * cell_index(m->width, m->height, x, y, z);
                int mixed = mixed_difference(cell, cell + 2 * stride[2]);
                most_mixed = mixed > most_mixed ? mixed : most_mixed;
                for (int a = 0; a < 3; a++) {
                    int before = at[a] > 0 ? low(cell[-2 * (ptrdiff_t)stride[a]]) : low(cell[0]);
                    int along = lom_magnitude_int(before - 2 * low(cell[0]) + low(cell[2 * stride[a]]));
                    most_along = along > most_along ? along : most_along;
                }
            }
    return (float)((most_along + 2.0 * most_mixed) / 65535.0);
}

lom_medium *lom_create_medium(const lom_image *image, lom_error *error)
{
    LOM_OWN_FLOAT_STATE;
    if (image == NULL ||
        (image->format != LOM_FORMAT_R8 && image->format != LOM_FORMAT_R16 && image->format != LOM_FORMAT_R32F)) {
        lom_fail(error, LOM_ERROR_USAGE, "A medium is made from one channel of 8 or 16 bits or floats.");
        return NULL;
    }
    if (image->width > LOM_MAX_VOLUME || image->height > LOM_MAX_VOLUME || image->depth > LOM_MAX_VOLUME) {
        lom_fail(error, LOM_ERROR_LIMIT, "A volume of %d x %d x %d voxels is larger than the limit of %d a side.",
                 image->width, image->height, image->depth, LOM_MAX_VOLUME);
        return NULL;
    }
    lom_medium *medium = lom_allocate(1, sizeof *medium, error);
    if (medium == NULL)
        return NULL;
    *medium = (lom_medium){
        .width = image->width, .height = image->height, .depth = image->depth, .gathers = lom_has_fast_gathers()
    };
    size_t cells = cell_index(image->width, image->height, 0, 0, image->depth + 1);
    medium->density = lom_allocate(cells, 2 * sizeof *medium->density, error);
    medium->distance = lom_allocate(cells, 1, error);
    if (medium->density == NULL || medium->distance == NULL) {
        lom_free_medium(medium);
        return NULL;
    }
    store_corners(medium, image);
    lom_spread_distances(medium->distance, image->width, image->height, image->depth);
    medium->bend = find_bend(medium);
    return medium;
}

float lom_medium_step(const lom_medium *medium, const float size[3], float error)
{
    const int voxels[3] = { medium->width, medium->height, medium->depth };
    double finest = 1e30;
    for (int i = 0; i < 3; i++)
        finest = (double)size[i] / voxels[i] < finest ? (double)size[i] / voxels[i] : finest;
    double bend = medium->bend > 1e-6 ? medium->bend : 1e-6;
    return (float)(finest * lom_double_sqrt(8 * (double)error / bend));
}

/* ---- tiling noise ---- */

void lom_free_detail(lom_detail *detail)
{
    if (detail == NULL)
        return;
    lom_release(detail->corners);
    lom_release(detail);
}

lom_detail *lom_create_detail(const lom_image *noise, lom_error *error)
{
    LOM_OWN_FLOAT_STATE;
    int n = noise != NULL ? noise->width : 0;
    if (n < 1 || n > 256 || (n & (n - 1)) != 0 || noise->height != n || noise->depth != n ||
        noise->format != LOM_FORMAT_R8) {
        lom_fail(error, LOM_ERROR_USAGE, "Tiling noise is an R8 cube whose side is a power of two, at most 256.");
        return NULL;
    }
    lom_detail *detail = lom_allocate(1, sizeof *detail, error);
    if (detail == NULL)
        return NULL;
    detail->size = n;
    size_t voxels = lom_image_size(noise);
    detail->corners = lom_allocate(voxels, 2 * sizeof *detail->corners, error);
    if (detail->corners == NULL) {
        lom_free_detail(detail);
        return NULL;
    }
    uint64_t sum = 0;
    size_t side = (size_t)n, last = side - 1; /* a power of two: places wrap by its bits */
    for (size_t i = 0; i < voxels; i++) {
        size_t x = i & last, y = i / side & last, z = i / (side * side);
        sum += noise->pixels[i];
        for (size_t k = 0; k < 2; k++) {
            const uint8_t *slice = noise->pixels + ((z + k) & last) * side * side;
            const uint8_t *row = slice + y * side, *next = slice + ((y + 1) & last) * side;
            size_t right = (x + 1) & last;
            detail->corners[2 * i + k] =
                (uint32_t)row[x] | (uint32_t)row[right] << 8 | (uint32_t)next[x] << 16 | (uint32_t)next[right] << 24;
        }
    }
    detail->mean = (float)((double)sum / (255.0 * (double)voxels));
    return detail;
}
