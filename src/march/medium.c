/* Media for marching. In: densities of 8 or 16 bits or floats. Out: cells, each with the voxel behind its own, how empty
 * each is, and how sharply the density bends. Invariant: no corner of a cell holds more than its emptiness says. */
#include "base/numbers.h"
#include "base/own_float_state.h"
#include "base/reserve.h"
#include "base/cpu.h"
#include "march/cells.h"

#include <string.h>

void lom_free_medium(lom_medium *medium)
{
    if (medium == NULL)
        return;
    lom_release(medium->density);
    lom_release(medium->emptiness);
    lom_release(medium);
}

/* ---- rows of voxels ---- */

enum { MOST_ROW = LOM_MAX_VOLUME + 2 };

/* Row y of slice z, or the last one of each, as 16 bits; the last voxel twice more. */
static void read_row(uint16_t row[MOST_ROW], const lom_image *image, int y, int z)
{
    const int width = image->width;
    const void *from = lom_image_pixel(image, 0, lom_smaller_int(y > 0 ? y : 0, image->height - 1),
                                       lom_smaller_int(z > 0 ? z : 0, image->depth - 1));
    if (image->format == LOM_FORMAT_R16)
        memcpy(row, from, (size_t)width * sizeof *row);
    else if (image->format == LOM_FORMAT_R8)
        for (int x = 0; x < width; x++)
            row[x] = (uint16_t)(257u * ((const uint8_t *)from)[x]);
    else
        for (int x = 0; x < width; x++) {
            const float value = ((const float *)from)[x];
            row[x] = (uint16_t)lom_count_of((value >= 0x1p-126f ? value < 1 ? value : 1 : 0) * 65535.0f + 0.5f, 65535);
        }
    row[width] = row[width + 1] = row[width - 1];
}

/* The words of the cells of a row. */
static void store_row(int32_t *to, const lom_image *image, int y, int z)
{
    uint16_t low[MOST_ROW], high[MOST_ROW];
    read_row(low, image, y, z);
    read_row(high, image, y, z + 1);
    for (int x = 0; x <= image->width; x++)
        to[x] = (int32_t)((uint32_t)low[x] | (uint32_t)high[x] << 16);
}

/* ---- emptiness ---- */

static uint16_t larger(uint16_t a, uint16_t b)
{
    return a > b ? a : b;
}

/* The largest of the eight corners of each cell of a row. */
static void find_most(uint16_t most[MOST_ROW], const lom_image *image, int y, int z)
{
    uint16_t row[MOST_ROW];
    memset(most, 0, MOST_ROW * sizeof *most);
    for (int i = 0; i < 4; i++) {
        read_row(row, image, y + (i & 1), z + (i >> 1));
        for (int x = 0; x <= image->width + 1; x++)
            most[x] = larger(most[x], row[x]);
    }
    for (int x = 0; x <= image->width; x++)
        most[x] = larger(most[x], most[x + 1]);
}

/* Of a cell that holds at most `most` of 65535, above 0: levels of 2^10 of them, rounded up. */
static uint8_t level_of(uint16_t most)
{
    const int levels = (most + 1023) >> 10;
    return (uint8_t)(levels < LOM_CELL_EMPTY ? LOM_CELL_EMPTY - levels : 0);
}

static void find_emptiness(lom_medium *m, const lom_image *image)
{
    uint16_t most[MOST_ROW];
    for (int z = 0; z <= m->depth; z++)
        for (int y = 0; y <= m->height; y++) {
            uint8_t *row = m->emptiness + cell_index(m->width, m->height, 0, y, z);
            find_most(most, image, y, z);
            for (int x = 0; x <= m->width; x++)
                row[x] = most[x] != 0 ? 0 : 255;
        }
    lom_spread_distances(m->emptiness, m->width, m->height, m->depth);
    for (int z = 0; z <= m->depth; z++)
        for (int y = 0; y <= m->height; y++) {
            uint8_t *row = m->emptiness + cell_index(m->width, m->height, 0, y, z);
            find_most(most, image, y, z);
            for (int x = 0; x <= m->width; x++) {
                const int away = row[x] < 240 ? row[x] + LOM_CELL_EMPTY - 1 : 255;
                row[x] = row[x] != 0 ? (uint8_t)away : level_of(most[x]);
            }
        }
    m->emptiness[cell_index(m->width, m->height, 0, 0, m->depth + 1)] = 255;
}

/* ---- how sharply it bends ---- */

/* Voxels of a row and of rows about it; each has a voxel before its first, which is the same. */
struct rows_about {
    uint16_t here[1 + MOST_ROW], above[1 + MOST_ROW], below[1 + MOST_ROW], nearer[1 + MOST_ROW], farther[1 + MOST_ROW],
        across[1 + MOST_ROW];
};

static void read_rows_about(struct rows_about *r, const lom_image *image, int y, int z)
{
    read_row(r->here + 1, image, y, z);
    r->here[0] = r->here[1];
    read_row(r->above + 1, image, y - 1, z);
    read_row(r->below + 1, image, y + 1, z);
    read_row(r->nearer + 1, image, y, z - 1);
    read_row(r->farther + 1, image, y, z + 1);
    read_row(r->across + 1, image, y + 1, z + 1);
}

static int larger_magnitude(int most, int of)
{
    of = of < 0 ? -of : of;
    return of > most ? of : most;
}

/* Along a unit line d, |f''| within a cell is at most 2 (|dx dy| + |dy dz| + |dz dx|) <= 2 times the largest mixed
 * difference; the jumps of f' at the cells' faces are, a voxel of length, at most dx^2 + dy^2 + dz^2 = 1 times the
 * largest second difference along an axis. */
static float find_bend(const lom_image *image)
{
    struct rows_about r;
    int mixed = 0, along = 0;
    for (int z = 0; z < image->depth; z++)
        for (int y = 0; y < image->height; y++) {
            read_rows_about(&r, image, y, z);
            for (int x = 1; x <= image->width; x++) {
                const int here = r.here[x], right = here - r.here[x + 1];
                mixed = larger_magnitude(mixed, right - r.below[x] + r.below[x + 1]);
                mixed = larger_magnitude(mixed, right - r.farther[x] + r.farther[x + 1]);
                mixed = larger_magnitude(mixed, here - r.below[x] - r.farther[x] + r.across[x]);
                along = larger_magnitude(along, r.here[x - 1] - 2 * here + r.here[x + 1]);
                along = larger_magnitude(along, r.above[x] - 2 * here + r.below[x]);
                along = larger_magnitude(along, r.nearer[x] - 2 * here + r.farther[x]);
            }
        }
    return (float)((along + 2.0 * mixed) / 65535.0);
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
    size_t slice = cell_index(image->width, image->height, 0, 0, 1), depth = (size_t)image->depth;
    medium->density = lom_allocate_bare(slice * depth, sizeof *medium->density, error);
    medium->emptiness = lom_allocate_bare(slice * (depth + 1) + 1, 1, error);
    if (medium->density == NULL || medium->emptiness == NULL) {
        lom_free_medium(medium);
        return NULL;
    }
    for (int z = 0; z < image->depth; z++)
        for (int y = 0; y <= image->height; y++)
            store_row(medium->density + cell_index(image->width, image->height, 0, y, z), image, y, z);
    find_emptiness(medium, image);
    medium->bend = find_bend(image);
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
