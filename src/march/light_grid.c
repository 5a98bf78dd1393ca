/* The grid of light. In: a density, the sun's direction. Out: for each voxel how much of the sun, the sky and the
 * ground it sees. Invariant: the sweep's arithmetic is the same at every width; sky and ground do not depend on the
 * sun. */
#include "base/numbers.h"
#include "march/light_grid.h"

#include "base/own_float_state.h"
#include "base/reserve.h"
#include "lanes/variants.h"
#include "march/cells.h"

#include <string.h>

#define DECLARE(name, variant) lom_slice_sweep lom_sweep_slice_##variant;
#define ENTRY(name, variant)   [LOM_SLOT_##variant] = lom_sweep_slice_##variant,
LOM_EACH_VARIANT(DECLARE, )
static lom_slice_sweep *const sweeps[LOM_VARIANTS] = { LOM_EACH_VARIANT(ENTRY, ) };

void lom_free_light_grid(lom_light_grid *grid)
{
    if (grid == NULL)
        return;
    lom_release(grid->density);
    lom_release(grid->light);
    lom_release(grid);
}

/* ---- making ---- */

/* Of voxel x of a row. */
static double density_at(lom_format format, const void *row, int x)
{
    if (format == LOM_FORMAT_R8)
        return ((const uint8_t *)row)[x] / 255.0;
    if (format == LOM_FORMAT_R16)
        return ((const uint16_t *)row)[x] / 65535.0;
    float value = ((const float *)row)[x];
    return value >= 0x1p-126f ? value < 1 ? value : 1 : 0;
}

static double erode(const float eroded[256], double density)
{
    int below = lom_int_of(density * 255);
    below = below < 254 ? below : 254;
    return eroded[below] + ((double)eroded[below + 1] - eroded[below]) * (density * 255 - below);
}

/* The voxels of the image that voxel i of n covers: at least one, since n <= size. */
static void find_span(int i, int n, int size, int *first, int *last)
{
    *first = (int)((int64_t)i * size / n);
    *last = (int)((int64_t)(i + 1) * size / n);
}

/* The sum of what voxels x0 to x1 - 1 of a row are eroded to; most hold nothing. */
static double sum_voxels(lom_format format, const void *row, int x0, int x1, const float eroded[256], double sum)
{
    for (int x = x0; x < x1; x++) {
        const double density = density_at(format, row, x);
        sum += density == 0 ? (double)eroded[0] : erode(eroded, density);
    }
    return sum;
}

/* A row of the grid. */
static void average_row(uint16_t *to, const lom_light_grid *grid, const lom_image *image, const float eroded[256],
                        int y, int z)
{
    int x0, x1, y0, y1, z0, z1;
    find_span(z, grid->depth, image->depth, &z0, &z1);
    find_span(y, grid->height, image->height, &y0, &y1);
    const size_t pitch = (size_t)image->width * lom_format_size(image->format), slice = pitch * (size_t)image->height;
    const uint8_t *const first = lom_image_pixel(image, 0, y0, z0);
    for (int x = 0; x < grid->width; x++) {
        find_span(x, grid->width, image->width, &x0, &x1);
        double sum = 0;
        for (int k = 0; k < z1 - z0; k++)
            for (int j = 0; j < y1 - y0; j++)
                sum = sum_voxels(image->format, first + (size_t)k * slice + (size_t)j * pitch, x0, x1, eroded, sum);
        double mean = sum / ((double)(x1 - x0) * (y1 - y0) * (z1 - z0));
        to[x] = (uint16_t)lom_count_of(mean * 65535 + 0.5, 65535);
    }
}

static void average_density(lom_light_grid *grid, const lom_image *image, const float eroded[256])
{
    for (int z = 0; z < grid->depth; z++)
        for (int y = 0; y < grid->height; y++)
            average_row(grid->density + ((size_t)z * (size_t)grid->height + (size_t)y) * (size_t)grid->width, grid,
                        image, eroded, y, z);
}

static int scaled(int size, double scale)
{
    int result = lom_int_of(size * scale + 0.5);
    return result < 1 ? 1 : result;
}

lom_light_grid *lom_create_light_grid(const lom_image *density, double scale, const float eroded[256], lom_error *error)
{
    LOM_OWN_FLOAT_STATE;
    if (density == NULL || !(scale > 0 && scale <= 1) || density->width > LOM_MAX_VOLUME ||
        density->height > LOM_MAX_VOLUME || density->depth > LOM_MAX_VOLUME) {
        lom_fail(error, LOM_ERROR_USAGE, "A grid of light is made from a volume of at most %d voxels a side.",
                 LOM_MAX_VOLUME);
        return NULL;
    }
    lom_light_grid *grid = lom_allocate(1, sizeof *grid, error);
    if (grid == NULL)
        return NULL;
    *grid = (lom_light_grid){ .width = scaled(density->width, scale),
                              .height = scaled(density->height, scale),
                              .depth = scaled(density->depth, scale) };
    size_t cells = cell_index(grid->width, grid->height, 0, 0, grid->depth + 1);
    size_t voxels = (size_t)grid->width * (size_t)grid->height * (size_t)grid->depth;
    grid->density = lom_allocate(voxels + LOM_SLAB, sizeof *grid->density, error); /* blocks of slabs read beyond */
    grid->light = lom_allocate_bare(cells, sizeof *grid->light, error);
    if (grid->density == NULL || grid->light == NULL) {
        lom_free_light_grid(grid);
        return NULL;
    }
    average_density(grid, density, eroded);
    memset(grid->light, 0xff, cells * sizeof *grid->light);
    return grid;
}

/* The last voxel of each axis once more, for the corners of the last cells. */
static void repeat_borders(lom_light_grid *g)
{
    for (int z = 0; z <= g->depth; z++)
        for (int y = 0; y <= g->height; y++) {
            int from_z = lom_smaller_int(z, g->depth - 1), from_y = lom_smaller_int(y, g->height - 1);
            int32_t *row = g->light + cell_index(g->width, g->height, 0, y, z);
            if (from_z != z || from_y != y)
                memcpy(row, g->light + cell_index(g->width, g->height, 0, from_y, from_z),
                       (size_t)g->width * sizeof *row);
            row[g->width] = row[g->width - 1];
        }
}

/* ---- the sun ---- */

/* The sweep: slices across `axis`, of which x and y of a slice are the axes across[0] and across[1]; per slice away
 * from the light a ray moves by shear[] voxels. */
struct sweep {
    int size[3], axis, across[2];
    bool from_high;
    double shear[2], thickness;
    int rays[2];
    int slab;     /* slices swept from a transposed copy; 1: from where they are */
    size_t pitch; /* of the rows in a slab */
};

static void plan_sweep(const lom_light_grid *g, const lom_light_desc *desc, struct sweep *s)
{
    *s = (struct sweep){ .size = { g->width, g->height, g->depth } };
    double along[3]; /* voxels a metre towards the light */
    for (int i = 0; i < 3; i++)
        along[i] = (double)desc->to_light[i] * s->size[i] / (double)desc->size[i];
    for (int i = 1; i < 3; i++)
        if (lom_magnitude(along[i]) > lom_magnitude(along[s->axis]))
            s->axis = i;
    s->across[0] = s->axis == 0 ? 1 : 0;
    s->across[1] = s->axis == 2 ? 1 : 2;
    s->from_high = along[s->axis] > 0;
    s->thickness = 1 / lom_magnitude(along[s->axis]);
    s->slab = s->axis == 0 ? LOM_SLAB : 1;
    s->pitch = lom_slab_pitch(s->size[s->across[0]]);
    for (int i = 0; i < 2; i++) {
        s->shear[i] = -along[s->across[i]] * s->thickness;
        s->rays[i] = s->size[s->across[i]] + lom_int_of(lom_magnitude(s->shear[i]) * (s->size[s->axis] - 1)) + 3;
    }
}

/* Ray u lies at voxel u - offset in slice k, counted from the light. */
static double offset_of(const struct sweep *s, int i, int k)
{
    return s->shear[i] >= 0 ? 1 + s->shear[i] * (s->size[s->axis] - 1 - k) : 1 - s->shear[i] * k;
}

/* Where ray (u, v) enters the box; false when it passes it by. */
static bool find_entry(const struct sweep *s, int u, int v, float entry[3])
{
    double at[3], step[3], from = 0, to = 1e30;
    const int ray[2] = { u, v };
    int n = s->size[s->axis];
    at[s->axis] = s->from_high ? 1 : 0;
    step[s->axis] = (s->from_high ? -1.0 : 1.0) / n;
    for (int i = 0; i < 2; i++) {
        int axis = s->across[i], size = s->size[axis];
        at[axis] = (ray[i] - offset_of(s, i, 0) + 0.5 - 0.5 * s->shear[i]) / size; /* half a slice before the first */
        step[axis] = s->shear[i] / size;
    }
    for (int i = 0; i < 3; i++) {
        if (step[i] == 0) {
            if (at[i] < 0 || at[i] > 1)
                return false;
            continue;
        }
        double first = ((step[i] > 0 ? 0 : 1) - at[i]) / step[i], last = ((step[i] > 0 ? 1 : 0) - at[i]) / step[i];
        from = first > from ? first : from;
        to = last < to ? last : to;
    }
    for (int i = 0; i < 3; i++)
        entry[i] = (float)(at[i] + step[i] * from);
    return from < to;
}

static void start_rays(const struct sweep *s, const lom_light_desc *desc, float *carried)
{
    size_t pitch = lom_ray_pitch(s->rays[0]);
    for (int v = 0; v < s->rays[1] && desc->beyond != NULL; v++)
        for (int u = 0; u < s->rays[0]; u++) {
            float entry[3];
            if (find_entry(s, u, v, entry))
                carried[(size_t)v * pitch + (size_t)u] = desc->beyond(desc->context, entry);
        }
}

static void split_offset(double offset, int *whole, float *part)
{
    *whole = -lom_int_of(lom_double_floor(-offset));
    *part = (float)(*whole - offset);
}

/* Slice `at` where it is: its rows of voxels, and of light. */
static const uint16_t *find_voxels(const lom_light_grid *g, const struct sweep *s, int at, size_t *pitch)
{
    size_t row = (size_t)g->width, whole = row * (size_t)g->height;
    *pitch = s->axis == 1 ? whole : row;
    return g->density + (size_t)at * (s->axis == 1 ? row : whole);
}

static void write_slice(lom_light_grid *g, const struct sweep *s, int at, const uint16_t *shares)
{
    int rows = s->size[s->across[1]];
    for (int row = 0; row < rows; row++) {
        int y = s->axis == 1 ? at : row, z = s->axis == 1 ? row : at;
        lom_write_shares(g->light + cell_index(g->width, g->height, 0, y, z), shares + (size_t)row * s->pitch,
                         g->width);
    }
}

/* The scratch of a sweep. */
struct buffers {
    float *rows, *carried;
    uint16_t *voxels, *shares; /* of a slab */
};

static bool allocate_buffers(const struct sweep *s, struct buffers *b, lom_error *error)
{
    size_t slab = s->pitch * (size_t)s->size[s->across[1]] * (size_t)s->slab;
    b->rows = lom_allocate(4 * lom_row_pitch(s->size[s->across[0]]), sizeof *b->rows, error);
    b->carried = lom_allocate(lom_ray_pitch(s->rays[0]) * (size_t)(s->rays[1] + 1), sizeof *b->carried, error);
    b->shares = lom_allocate(slab, sizeof *b->shares, error);
    b->voxels = s->slab > 1 ? lom_allocate(slab, sizeof *b->voxels, error) : NULL;
    return b->rows != NULL && b->carried != NULL && b->shares != NULL && (s->slab == 1 || b->voxels != NULL);
}

static void free_buffers(struct buffers *b)
{
    lom_release(b->rows);
    lom_release(b->carried);
    lom_release(b->shares);
    lom_release(b->voxels);
}

/* `count` slices from slice k on, counted from the light. */
static void sweep_slab(lom_slice_sweep *sweep, lom_light_grid *grid, const struct sweep *s, struct lom_slice *slice,
                       const struct buffers *b, int k, int count)
{
    int first = s->from_high ? s->size[s->axis] - k - count : k;
    size_t size = s->pitch * (size_t)slice->height;
    if (s->slab > 1)
        lom_read_slab(grid, first, count, b->voxels);
    else
        slice->voxels = find_voxels(grid, s, first, &slice->voxel_pitch);
    for (int i = 0; i < count; i++) {
        size_t at = (size_t)(s->from_high ? count - 1 - i : i);
        split_offset(offset_of(s, 0, k + i), &slice->whole_x, &slice->part_x);
        split_offset(offset_of(s, 1, k + i), &slice->whole_y, &slice->part_y);
        slice->shares = b->shares + at * size;
        if (s->slab > 1)
            slice->voxels = b->voxels + at * size;
        sweep(slice);
    }
    if (s->slab > 1)
        lom_write_slab(grid, first, count, b->shares);
    else
        write_slice(grid, s, first, b->shares);
}

bool lom_sweep_sun_by(lom_slice_sweep *sweep, lom_light_grid *grid, const lom_light_desc *desc, lom_error *error)
{
    struct sweep s;
    struct buffers buffers;
    plan_sweep(grid, desc, &s);
    bool done = allocate_buffers(&s, &buffers, error);
    if (done) {
        struct lom_slice slice = { .width = s.size[s.across[0]],
                                   .height = s.size[s.across[1]],
                                   .rays_across = s.rays[0],
                                   .scale = (float)((double)desc->extinction * s.thickness / 65535),
                                   .forward = desc->forward,
                                   .rows = buffers.rows,
                                   .carried = buffers.carried,
                                   .voxel_pitch = s.pitch,
                                   .share_pitch = s.pitch };
        start_rays(&s, desc, buffers.carried);
        for (int k = 0, n = s.size[s.axis]; k < n; k += s.slab)
            sweep_slab(sweep, grid, &s, &slice, &buffers, k, lom_smaller_int(s.slab, n - k));
        repeat_borders(grid);
    }
    free_buffers(&buffers);
    return done;
}

bool lom_sweep_sun(lom_light_grid *grid, const lom_light_desc *desc, lom_error *error)
{
    LOM_OWN_FLOAT_STATE;
    return lom_sweep_sun_by(sweeps[lom_widest_variant(false)], grid, desc, error);
}

/* ---- what else keeps the sun off ---- */

/* The grid holds exp(-depth / 16), so a share of the light counts as its sixteenth root. */
static double sixteenth_root(double x)
{
    return lom_double_sqrt(lom_double_sqrt(lom_double_sqrt(lom_double_sqrt(x))));
}

static void shade_column(lom_light_grid *g, int x, int z, double height, double edge)
{
    for (int y = 0; y < g->height; y++) {
        const double over = (y + 0.5) / g->height - height, share = over / edge + 0.5;
        if (share >= 1)
            return;
        int32_t *light = &g->light[cell_index(g->width, g->height, x, y, z)];
        const double kept = share > 0 ? (*light & 0xffff) * sixteenth_root(share) : 0;
        *light = (*light & ~0xffff) | (int32_t)lom_count_of(kept + 0.5, 65535);
    }
}

void lom_shade_light_grid(lom_light_grid *g, double (*height)(const void *context, double x, double z),
                          const void *context, double edge)
{
    LOM_OWN_FLOAT_STATE;
    for (int z = 0; z < g->depth; z++)
        for (int x = 0; x < g->width; x++)
            shade_column(g, x, z, height(context, (x + 0.5) / g->width, (z + 0.5) / g->depth), edge);
    repeat_borders(g);
}

/* ---- sky and ground ---- */

/* 3/4 (1 - 0.85) */
static const double diffuse_share = 0.1125;

static uint32_t diffuse_byte(double depth)
{
    return (uint32_t)lom_count_of(255 / (1 + diffuse_share * depth) + 0.5, 255);
}

void lom_sweep_sky(lom_light_grid *g, const float size[3], float extinction)
{
    LOM_OWN_FLOAT_STATE;
    double scale = (double)extinction * (double)size[1] / g->height / 65535;
    size_t row = (size_t)g->width;
    for (int z = 0; z < g->depth; z++)
        for (int x = 0; x < g->width; x++) {
            const uint16_t *column = g->density + (size_t)z * row * (size_t)g->height + (size_t)x;
            double total = 0, below = 0;
            for (int y = 0; y < g->height; y++)
                total += column[(size_t)y * row] * scale;
            for (int y = 0; y < g->height; y++) {
                double here = column[(size_t)y * row] * scale;
                int32_t *light = &g->light[cell_index(g->width, g->height, x, y, z)];
                uint32_t word = ((uint32_t)*light & 0xffff) | diffuse_byte(total - below - 0.5 * here) << 16 |
                                diffuse_byte(below + 0.5 * here) << 24;
                memcpy(light, &word, sizeof word);
                below += here;
            }
        }
    repeat_borders(g);
}
