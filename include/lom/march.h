/* lom/march.h - stepping rays through volumes of colour and density: front to back, with exact skipping of empty space.
 *
 * A volume spans [0, 1]^3; voxel i of n has its centre at (i + 0.5) / n; values between centres are trilinear, outside
 * the first and last centre they are the edge's (clamp to edge). Positions are evaluated at the step, start + i * step,
 * never summed, so that what is skipped changes no bit of what is not.
 */
#ifndef LOM_MARCH_H
#define LOM_MARCH_H

#include <lom/fixed.h>
#include <lom/image.h>
#include <lom/lanes.h>

LOM_API_BEGIN
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

/* ---- volumes ---- */

enum { LOM_MAX_VOLUME = 512 }; /* voxels a side */

/* A volume, stored for marching: index (z * (height + 1) + y) * (width + 1) + x names the cell between the voxels
 * x, y, z and x + 1, y + 1, z + 1 (the last voxel repeated). Made by lom_create_volume, read only. */
typedef struct lom_volume {
    int width, height, depth;
    int32_t *density; /* 2 words a cell: word z holds the corners (0, 0, z), (1, 0, z), (0, 1, z), (1, 1, z) from its
                       * lowest byte up */
    int32_t *color;   /* 1 word a voxel, the last of each axis repeated: red in the lowest byte, green, blue, density */
    uint8_t *distance; /* 1 byte a cell: Chebyshev distance, in cells and at most 255, to the nearest cell with a corner
                        * of non-zero density; 0 there */
    bool empty_border; /* no density in the outermost voxels */
} lom_volume;

/* From an RGBA8 image (alpha is the density) or an R8 one (white). NULL on failure; freed with lom_free_volume. */
lom_volume *lom_create_volume(const lom_image *image, lom_error *error);
void lom_free_volume(lom_volume *volume);

/* ---- sampling ---- */

/* Where a position lies: the index of its cell and the weights of the cell's upper corners. */
typedef struct lom_volume_place {
    lom_int index;
    lom_float x, y, z;
} lom_volume_place;

LOM_INLINE lom_float lom_volume_axis(lom_float position, int size, lom_int *cell)
{
    lom_float along = lom_clamp(position * (float)size - 0.5f, lom_splat(0.0f), lom_splat((float)(size - 1)));
    *cell = lom_bounded_to_int(along); /* in range and not negative: the floor */
    return along - lom_to_float(*cell);
}

LOM_INLINE lom_volume_place lom_find_in_cells(int width, int height, int depth, lom_float3 position)
{
    lom_volume_place place;
    lom_int x, y, z;
    place.x = lom_volume_axis(position.x, width, &x);
    place.y = lom_volume_axis(position.y, height, &y);
    place.z = lom_volume_axis(position.z, depth, &z);
    place.index = (z * (height + 1) + y) * (width + 1) + x;
    return place;
}

LOM_INLINE lom_volume_place lom_find_in_volume(const lom_volume *volume, lom_float3 position)
{
    return lom_find_in_cells(volume->width, volume->height, volume->depth, position);
}

/* The eight corners of a cell, a byte each in two words: along z, then y, then x, in units of 1/255, scaled at the end.
 * Bytes are masked where they stand: a factor of a power of two is exact, so it may be taken out after the first
 * interpolation. */
LOM_INLINE lom_float lom_mix_corners(lom_int low, lom_int high, lom_volume_place place)
{
    lom_float v00 = lom_mix(lom_to_float(low & 0xff), lom_to_float(high & 0xff), place.z);
    lom_float v10 = lom_mix(lom_to_float(low & 0xff00), lom_to_float(high & 0xff00), place.z) * 0x1p-8f;
    lom_float v01 = lom_mix(lom_to_float(low & 0xff0000), lom_to_float(high & 0xff0000), place.z) * 0x1p-16f;
    lom_float v11 =
        lom_mix(lom_to_float((lom_int)((lom_uint)low >> 24)), lom_to_float((lom_int)((lom_uint)high >> 24)), place.z);
    return lom_mix(lom_mix(v00, v01, place.y), lom_mix(v10, v11, place.y), place.x) * (1 / 255.0f);
}

/* Density in [0, 1]. */
LOM_INLINE lom_float lom_sample_density(const lom_volume *volume, lom_volume_place place)
{
    lom_int low, high;
    lom_gather_pairs(volume->density, place.index + place.index, &low, &high);
    return lom_mix_corners(low, high, place);
}

/* One channel of the eight corners, c[4 z + 2 y + x], by mask; in units of the mask's lowest bit. */
LOM_INLINE lom_float lom_volume_channel(const lom_int c[8], int32_t mask, lom_volume_place place)
{
    lom_float row[4];
    for (int i = 0; i < 4; i++)
        row[i] = lom_mix(lom_to_float(c[i] & mask), lom_to_float(c[4 + i] & mask), place.z);
    return lom_mix(lom_mix(row[0], row[2], place.y), lom_mix(row[1], row[3], place.y), place.x);
}

LOM_INLINE void lom_load_volume_corners(const lom_volume *volume, lom_volume_place place, lom_int corner[8])
{
    int pitch = volume->width + 1, slice = pitch * (volume->height + 1);
    for (int i = 0; i < 8; i += 2)
        lom_gather_pairs(volume->color + (i >> 1 & 1) * pitch + (i >> 2) * slice, place.index, &corner[i],
                         &corner[i + 1]);
}

/* Density and colour at once: the density by the operations of lom_sample_density (a byte that is masked where it
 * stands differs from one that is shifted down by an exact factor), so the same bits. */
LOM_INLINE lom_float3 lom_sample_volume_all(const lom_volume *volume, lom_volume_place place, lom_float *density)
{
    lom_int corner[8], high[8];
    lom_load_volume_corners(volume, place, corner);
    for (int i = 0; i < 8; i++)
        high[i] = (lom_int)((lom_uint)corner[i] >> 24);
    *density = lom_volume_channel(high, 0xff, place) * (1 / 255.0f);
    lom_float3 color = { lom_volume_channel(corner, 0xff, place) * (1 / 255.0f),
                         lom_volume_channel(corner, 0xff00, place) * (0x1p-8f / 255.0f),
                         lom_volume_channel(corner, 0xff0000, place) * (0x1p-16f / 255.0f) };
    return color;
}

/* Colour in [0, 1], in the same order. */
LOM_INLINE lom_float3 lom_sample_volume_color(const lom_volume *volume, lom_volume_place place)
{
    lom_int corner[8];
    lom_load_volume_corners(volume, place, corner);
    lom_float3 color = { lom_volume_channel(corner, 0xff, place) * (1 / 255.0f),
                         lom_volume_channel(corner, 0xff00, place) * (0x1p-8f / 255.0f),
                         lom_volume_channel(corner, 0xff0000, place) * (0x1p-16f / 255.0f) };
    return color;
}

/* ---- marching ---- */

typedef struct lom_march_desc {
    const lom_volume *volume;
    int steps;               /* samples a ray, 1..65536 */
    float absorption;        /* a sample's opacity is density * absorption */
    float light_offset[3];   /* from a sample to the place whose density shades it, in volume units */
    float shade;             /* how much: the colour is multiplied by 1 - shade * density there */
    float opaque;            /* a ray stops when its opacity is above this, not negative */
    bool walk;               /* evaluate every step; skipping empty space gives the same bytes */
    lom_filtering filtering; /* of densities and colours; places and sums are float */
} lom_march_desc;

typedef struct lom_march_rays {
    lom_float3 start, step; /* sample i is at start + i * step, in volume units */
    lom_mask active;        /* the other lanes give 0 */
} lom_march_rays;

/* Samples evaluated (a packet's step counts once) of those that walking would have. */
typedef struct lom_march_count {
    uint64_t walked, sampled;
} lom_march_count;

/* Opacity and colour (already multiplied by it), front to back: with v = (1 - alpha) density absorption, colour +=
 * v c (1 - shade d), alpha += v (Porter and Duff 1984, "over"). count may be NULL and is added to. */
void LOM_WIDE(lom_march_volume)(lom_float4 *out, const lom_march_rays *rays, const lom_march_desc *desc,
                                lom_march_count *count);

/* ---- media: densities of 16 bits, marched by optical depth ---- */

/* Emptiness of a cell that holds something is below this. */
enum { LOM_CELL_EMPTY = 16 };

/* A density, stored for marching like a volume (index as there): a word a cell, voxel (x, y, z) in its low 16 bits and
 * (x, y, z + 1) in its high ones. Made by lom_create_medium, read only. */
typedef struct lom_medium {
    int width, height, depth;
    int32_t *density;
    /* 1 byte a cell, and 255 behind the last: e < LOM_CELL_EMPTY where it holds something, nowhere more than (16 - e) / 64
     * unless e is 0; else e - 15 is its Chebyshev distance, in cells and at most 240, to the nearest that does */
    uint8_t *emptiness;
    bool gathers; /* read by this processor's gathers, which are faster than loads; the same numbers */
    float bend;   /* largest second difference along an axis and twice the largest mixed one, in densities */
} lom_medium;

/* From one channel of 8 or 16 bits or floats (clamped to [0, 1]). NULL on failure; freed with lom_free_medium. */
lom_medium *lom_create_medium(const lom_image *density, lom_error *error);
void lom_free_medium(lom_medium *medium);

/* Density in [0, 1], of a cell's words: those of x and x + 1, at y and at y + 1. */
LOM_INLINE lom_float lom_mix_medium(const lom_int upper[2], const lom_int lower[2], lom_volume_place place)
{
    lom_float v[4];
    for (int i = 0; i < 4; i++) {
        const lom_int word = i < 2 ? upper[i] : lower[i - 2];
        v[i] = lom_mix(lom_to_float(word & 0xffff), lom_to_float((lom_int)((lom_uint)word >> 16)), place.z);
    }
    return lom_mix(lom_mix(v[0], v[2], place.y), lom_mix(v[1], v[3], place.y), place.x) * (1 / 65535.0f);
}

LOM_INLINE lom_float lom_sample_medium(const lom_medium *medium, lom_volume_place place)
{
    lom_int upper[2], lower[2];
    lom_gather_pairs(medium->density, place.index, &upper[0], &upper[1]);
    lom_gather_pairs(medium->density + medium->width + 1, place.index, &lower[0], &lower[1]);
    return lom_mix_medium(upper, lower, place);
}

/* The step, in metres, at which the midpoint rule's error of the integral of the density along any line through the
 * medium is at most `error` times the line's length: with f the density along the line, that error is at most step^2 /
 * 8 times the total variation of f' (the composite midpoint rule). In a cell f'' is bounded by twice the largest mixed
 * second difference, and where the line crosses from cell to cell f' jumps by at most the second difference there: so
 * the variation is at most bend / voxel^2 a metre. size: of the box, metres. */
float lom_medium_step(const lom_medium *medium, const float size[3], float error);

/* Tiling noise of 2^n voxels a side, the eight corners of each cell in 8 bytes. */
typedef struct lom_detail {
    int size;
    int32_t *corners;
    float mean; /* of all voxels, in [0, 1] */
} lom_detail;

/* From an R8 cube whose side is a power of two, at most 256. NULL on failure; freed with lom_free_detail. */
lom_detail *lom_create_detail(const lom_image *noise, lom_error *error);
void lom_free_detail(lom_detail *detail);

/* The cell of a place in repetitions of the tile, within +-2^20 of 0. */
LOM_INLINE lom_volume_place lom_find_in_detail(const lom_detail *detail, lom_float3 at)
{
    lom_float size = lom_splat((float)detail->size);
    int mask = detail->size - 1;
    lom_float3 p = { at.x * size, at.y * size, at.z * size };
    lom_float3 below = { lom_floor(p.x), lom_floor(p.y), lom_floor(p.z) };
    lom_int index = ((lom_to_int(below.z) & mask) * detail->size + (lom_to_int(below.y) & mask)) * detail->size +
                    (lom_to_int(below.x) & mask);
    lom_volume_place place = { index, p.x - below.x, p.y - below.y, p.z - below.z };
    return place;
}

/* The noise there. */
LOM_INLINE lom_float lom_sample_detail(const lom_detail *detail, lom_float3 at)
{
    lom_volume_place place = lom_find_in_detail(detail, at);
    lom_int low, high;
    lom_gather_pairs(detail->corners, place.index + place.index, &low, &high);
    return lom_mix_corners(low, high, place);
}

/* ---- light: how much of the sun, the sky and the ground each place sees ---- */

/* A grid over the same box as a medium, of its own resolution. A word a voxel (the last of each axis repeated): in the
 * low 16 bits exp(-optical depth towards the sun / LOM_LIGHT_DEPTH), then 8 bits of the sky and 8 of the ground. */
typedef struct lom_light_grid {
    int width, height, depth;
    uint16_t *density; /* plain, x first: what the light is swept through */
    int32_t *light;
} lom_light_grid;

/* Averages a density (as lom_create_medium takes) into a grid of scale times its voxels along each axis (0 < scale <=
 * 1); eroded[i] replaces the density i / 255 (what marching will make of it on average). The sky and the ground are
 * those of lom_sweep_sky with no extinction: 1. NULL on failure. */
lom_light_grid *lom_create_light_grid(const lom_image *density, double scale, const float eroded[256],
                                      lom_error *error);
void lom_free_light_grid(lom_light_grid *grid);

typedef struct lom_light_desc {
    float size[3];     /* of the box, metres */
    float extinction;  /* 1/m at density 1 */
    float to_light[3]; /* unit vector in the box's axes */
    float forward; /* Harris's multiple forward scattering: share of a voxel's optical depth that stays in the beam */
    /* optical depth between where a ray to the light leaves the box, in parts of the box, and the light; NULL: 0 */
    float (*beyond)(void *context, const float exit[3]);
    void *context;
} lom_light_desc;

/* Fills the sun's share, in time proportional to the voxels: the volume is cut into slices across the axis the light is
 * steepest to; rays are sheared so that each passes every slice at the same fraction of a voxel, and optical depth is
 * carried along them from slice to slice. False when memory runs out. */
bool lom_sweep_sun(lom_light_grid *grid, const lom_light_desc *desc, lom_error *error);

/* Takes the sun's share, once it is swept, from what lies below a height over each place of the box, which stands
 * upright: the height of the shadow of something else that stands there, in parts of the box. At the height half of the
 * light is left, half of `edge` below it none, half of it above it all, linearly; the shares that a voxel keeps are
 * those of its middle. */
void lom_shade_light_grid(lom_light_grid *grid, double (*height)(const void *context, double x, double z),
                          const void *context, double edge);

/* Fills the shares of sky and ground: with t the optical depth straight up or down, what diffuse light a layer of
 * droplets lets through that absorb nothing, 1 / (1 + 3/4 (1 - g) t) with g = 0.85 (two-stream, Bohren 1987). */
void lom_sweep_sky(lom_light_grid *grid, const float size[3], float extinction);

/* What the sun's share is the exponential of a part of: light is told from none to an optical depth of 700, and the
 * first four octaves of a march are powers of it. */
enum { LOM_LIGHT_DEPTH = 64 };

typedef struct lom_light_sample {
    lom_float sun; /* exp(-optical depth / LOM_LIGHT_DEPTH) */
    lom_float sky, ground;
} lom_light_sample;

/* Of the eight words of a cell, c[4 z + 2 y + x]. */
LOM_INLINE lom_light_sample lom_mix_light(const lom_int c[8], lom_volume_place place)
{
    lom_int high[8];
    for (int i = 0; i < 8; i++)
        high[i] = (lom_int)((lom_uint)c[i] >> 24);
    lom_light_sample light = { lom_volume_channel(c, 0xffff, place) * (1 / 65535.0f),
                               lom_volume_channel(c, 0xff0000, place) * (0x1p-16f / 255.0f),
                               lom_volume_channel(high, 0xff, place) * (1 / 255.0f) };
    return light;
}

LOM_INLINE lom_light_sample lom_sample_light(const lom_light_grid *grid, lom_float3 position)
{
    lom_volume_place place = lom_find_in_cells(grid->width, grid->height, grid->depth, position);
    lom_int corner[8];
    int pitch = grid->width + 1, slice = pitch * (grid->height + 1);
    for (int i = 0; i < 8; i += 2)
        lom_gather_pairs(grid->light + (i >> 1 & 1) * pitch + (i >> 2) * slice, place.index, &corner[i],
                         &corner[i + 1]);
    return lom_mix_light(corner, place);
}

/* ---- marching a medium ---- */

enum { LOM_MAX_OCTAVES = 8 };

typedef struct lom_medium_desc {
    const lom_medium *medium;
    const lom_light_grid *light;   /* NULL: all places see all of the sun, the sky and the ground */
    const lom_detail *detail;      /* NULL: none */
    float detail_strength;         /* 0..1 */
    float detail_scale[3];         /* repetitions along each axis of the box */
    float detail_near, detail_far; /* metres: the noise fades into its mean between */
    float extinction;              /* 1/m at density 1 */
    float step;                    /* metres, above 0 */
    float stop;                    /* a ray ends when its transmittance is below this, at most 1 */
    int most_steps;                /* a ray longer than this many steps takes longer ones; 1..65536 */
    int octaves;                   /* 1..LOM_MAX_OCTAVES */
    float weight[LOM_MAX_OCTAVES];
    bool walk;               /* evaluate every step; skipping empty space gives the same bytes */
    lom_filtering filtering; /* of densities, noise and light; places and sums are float */
} lom_medium_desc;

typedef struct lom_medium_rays {
    lom_float3 start, along; /* in parts of the box, at distance 0 and a metre */
    lom_float enter, leave;  /* metres, enter >= 0 */
    lom_float shift;         /* of the first step's end, in steps, ]0, 1] */
    lom_float phase;         /* of light that is scattered once */
    lom_mask active;
} lom_medium_rays;

typedef struct lom_medium_result {
    lom_float sun, sky, ground; /* times albedo and each light's radiance: what comes towards the eye */
    lom_float transmittance;
    lom_float distance; /* metres to what is seen, on average by its share; 0 where nothing is */
} lom_medium_result;

/* Radiance along rays through a medium, front to back. Step i covers [enter + (i - 1 + shift) step, enter + (i + shift)
 * step], cut to [enter, leave]; its middle is sampled, and within it the medium counts as uniform: with t its optical
 * depth, 1 - exp(-t) of what lies there is seen and exp(-t) of what lies behind (the exponential integrator; exact
 * where the medium is uniform). The sun's share is sum over octaves k of weight_k exp(-T / 4^k), T the optical depth
 * towards it, the first of them times the phase (after Wrenninge, Kulla, Lundqvist: Oz, 2013). Sky and ground have
 * shares of 1 together: with A and B the grid's, A / (A + B) and B / (A + B), which is what a layer of droplets that
 * absorb nothing has from its two sides (two-stream: linear in the optical depth). What an ended ray leaves out is at most `stop` times the
 * largest radiance of a place, since the shares of all that is behind sum up to the transmittance. count may be NULL.
 */
void LOM_WIDE(lom_march_medium)(lom_medium_result *out, const lom_medium_rays *rays, const lom_medium_desc *desc,
                                lom_march_count *count);

/* Optical depth of a medium between two distances along rays, by the midpoint rule with `steps` steps; of what is empty
 * none is evaluated unless desc->walk says so, which gives the same bytes. */
void LOM_WIDE(lom_medium_depth)(lom_float *depth, const lom_medium_rays *rays, const lom_medium_desc *desc, int steps);

/* Where rays cross the unit box: the distances between which they are inside, enter >= 0; lanes that miss it are
 * cleared in active. A component of `along` below 2^-126 divides nothing: such a ray is inside between the two
 * faces or not (the upper face excluded, so that two boxes share a face without a gap or doubling). A ray of which all
 * three are goes nowhere and misses. */
void LOM_WIDE(lom_cross_box)(lom_medium_rays *rays);

#pragma GCC diagnostic pop
LOM_API_END

#endif
