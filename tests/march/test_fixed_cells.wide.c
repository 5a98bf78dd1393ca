/* Volumes, media, noise and light in fixed point: every lane is, bit for bit, what integers give a number at a time; it
 * is within the stated bound of the float filter and between the corners; the two ways to a density are the same. */
#include "check.h"

#include <math.h>

#include "march/fixed_cells.h"

enum { SIZE = 9, CELLS = (SIZE + 1) * (SIZE + 1) * (SIZE + 1) };

static double uniform(uint64_t i)
{
    return lom_random_uniform(31, i);
}

/* ---- numbers one at a time ---- */

static int mix(int a, int b, int weight)
{
    return a + (int)floor(((double)(b - a) * weight + 16384) / 32768);
}

static int weight_of(float w)
{
    return (int)nearbyint((double)w * 32768);
}

/* Eight numbers v[4 z + 2 y + x], mixed along z and then in the order of the axes named (0: x, 1: y). */
static int define(const int v[8], const float w[3], int then)
{
    int x = weight_of(w[0]), y = weight_of(w[1]), z = weight_of(w[2]), row[4];
    for (int i = 0; i < 4; i++)
        row[i] = mix(v[i], v[4 + i], z);
    return then == 0 ? mix(mix(row[0], row[1], x), mix(row[2], row[3], x), y)
                     : mix(mix(row[0], row[2], y), mix(row[1], row[3], y), x);
}

/* ---- what is filtered ---- */

/* Cells of SIZE^3 voxels of 32 random bits, the last of each axis repeated. */
static uint32_t voxel(int x, int y, int z)
{
    x = x < SIZE ? x : SIZE - 1;
    y = y < SIZE ? y : SIZE - 1;
    z = z < SIZE ? z : SIZE - 1;
    uint32_t bits = (uint32_t)lom_random_bits(17, (uint64_t)((z * SIZE + y) * SIZE + x));
    return bits % 5 == 0 ? 0xffffffff : bits % 7 == 0 ? 0 : bits;
}

static const struct {
    const char *name;
    int shift, bits, then; /* of the number in a voxel's word, and how it is mixed */
} numbers[] = { { "density", 24, 8, 0 },
                { "red", 0, 8, 0 },
                { "green", 8, 8, 0 },
                { "blue", 16, 8, 0 },
                { "density with colour", 24, 8, 0 },
                { "medium", 0, 16, 1 },
                { "sun", 0, 16, 1 },
                { "sky", 16, 8, 1 },
                { "ground", 24, 8, 1 },
                { "noise", 24, 8, 0 } };
enum { NUMBERS = sizeof numbers / sizeof *numbers };

struct all {
    lom_volume volume;
    lom_medium medium;
    lom_light_grid light;
    lom_detail detail;
};

static struct all make_all(void)
{
    struct all all = { { .width = SIZE, .height = SIZE, .depth = SIZE },
                       { .width = SIZE, .height = SIZE, .depth = SIZE },
                       { .width = SIZE, .height = SIZE, .depth = SIZE },
                       { .size = SIZE } };
    all.volume.color = calloc(CELLS + 8, 4);
    all.volume.density = calloc(CELLS + 8, 8);
    all.medium.density = calloc(CELLS + 8, 4);
    all.light.light = calloc(CELLS + 8, 4);
    for (int z = 0; z <= SIZE; z++)
        for (int y = 0; y <= SIZE; y++)
            for (int x = 0; x <= SIZE; x++) {
                size_t at = (size_t)((z * (SIZE + 1) + y) * (SIZE + 1) + x);
                uint32_t word = voxel(x, y, z);
                memcpy(&all.volume.color[at], &word, 4);
                memcpy(&all.light.light[at], &word, 4);
                for (int k = 0; k < 2; k++) {
                    word = voxel(x, y, z + k) >> 24 | (voxel(x + 1, y, z + k) >> 24) << 8 |
                           (voxel(x, y + 1, z + k) >> 24) << 16 | (voxel(x + 1, y + 1, z + k) >> 24) << 24;
                    memcpy(&all.volume.density[2 * at + (size_t)k], &word, 4);
                }
                word = (voxel(x, y, z) & 0xffff) | voxel(x, y, z + 1) << 16;
                memcpy(&all.medium.density[at], &word, 4);
            }
    return all;
}

static void free_all(struct all *all)
{
    free(all->volume.color);
    free(all->volume.density);
    free(all->medium.density);
    free(all->light.light);
}

static void sample_fixed(const struct all *all, lom_float3 p, lom_float out[NUMBERS])
{
    struct fixed_place at = fix_place(lom_find_in_volume(&all->volume, p));
    lom_int low, high;
    lom_gather_pairs(all->volume.density, at.index + at.index, &low, &high);
    out[0] = out[9] = fixed_corners(low, high, &at);
    lom_float3 color = fixed_volume_all(&all->volume, &at, &out[4]);
    out[1] = color.x;
    out[2] = color.y;
    out[3] = color.z;
    out[5] = fixed_medium(&all->medium, &at);
    lom_light_sample light = fixed_light(&all->light, p);
    out[6] = light.sun;
    out[7] = light.sky;
    out[8] = light.ground;
}

static void sample_float(const struct all *all, lom_float3 p, lom_float out[NUMBERS])
{
    lom_volume_place at = lom_find_in_volume(&all->volume, p);
    out[0] = out[9] = lom_sample_density(&all->volume, at);
    lom_float3 color = lom_sample_volume_all(&all->volume, at, &out[4]);
    out[1] = color.x;
    out[2] = color.y;
    out[3] = color.z;
    out[5] = lom_sample_medium(&all->medium, at);
    lom_light_sample light = lom_sample_light(&all->light, p);
    out[6] = light.sun;
    out[7] = light.sky;
    out[8] = light.ground;
}

static float float_at(const lom_float *x, int i)
{
    return (*x)[i];
}

static void check_lane(int n, const int cell[3], const float w[3], float fixed, float in_float)
{
    int v[8], low = 32767, high = 0;
    for (int i = 0; i < 8; i++) {
        uint32_t word = voxel(cell[0] + (i & 1), cell[1] + (i >> 1 & 1), cell[2] + (i >> 2)) >> numbers[n].shift;
        v[i] = numbers[n].bits == 8 ? (int)(word & 255) * 128 : (int)(word & 0xffff) / 2;
        low = v[i] < low ? v[i] : low;
        high = v[i] > high ? v[i] : high;
    }
    float unit = numbers[n].bits == 8 ? 1 / 32640.0f : 1 / 32767.0f, want = (float)define(v, w, numbers[n].then) * unit;
    double off = fabs((double)fixed - (double)in_float),
           most = 3 * 0x1p-15 + 0x1p-20 + (numbers[n].bits == 16 ? 0x1p-16 : 0);
    CHECK(fixed == want, "%s at %d %d %d + %g %g %g: %.9g, not %.9g", numbers[n].name, cell[0], cell[1], cell[2],
          (double)w[0], (double)w[1], (double)w[2], (double)fixed, (double)want);
    CHECK(fixed >= (float)low * unit && fixed <= (float)high * unit, "%s: %.9g", numbers[n].name, (double)fixed);
    CHECK(off <= most, "%s: %g from float", numbers[n].name, off);
}

static void every_number_is_the_definition_and_near_float(void)
{
    struct all all = make_all();
    for (uint64_t round = 0; round < 8000 / LOM_LANES; round++) {
        lom_float3 p = { 0 };
        for (int i = 0; i < LOM_LANES; i++) {
            uint64_t at = (round * LOM_LANES + (uint64_t)i) * 3;
            p.x[i] = round % 4 == 0 ? (float)(int)(uniform(at) * 36) / 36 : (float)(uniform(at) * 1.4 - 0.2);
            p.y[i] = (float)(uniform(at + 1) * 1.4 - 0.2);
            p.z[i] = round % 9 == 0 ? __builtin_nanf("") : (float)(uniform(at + 2) * 1.4 - 0.2);
        }
        lom_float fixed[NUMBERS], in_float[NUMBERS];
        sample_fixed(&all, p, fixed);
        sample_float(&all, p, in_float);
        lom_volume_place place = lom_find_in_volume(&all.volume, p);
        for (int i = 0; i < LOM_LANES; i++) {
            int index = place.index[i],
                cell[3] = { index % (SIZE + 1), index / (SIZE + 1) % (SIZE + 1), index / (SIZE + 1) / (SIZE + 1) };
            float w[3] = { place.x[i], place.y[i], place.z[i] };
            for (int n = 0; n < NUMBERS; n++)
                check_lane(n, cell, w, float_at(&fixed[n], i), float_at(&in_float[n], i));
        }
    }
    free_all(&all);
}

static void noise_is_found_where_it_is_in_float(void)
{
    lom_image *image = lom_create_image(8, 8, 8, LOM_FORMAT_R8, NULL);
    for (int i = 0; i < 512; i++)
        image->pixels[i] = (uint8_t)lom_random_bits(3, (uint64_t)i);
    lom_detail *detail = lom_create_detail(image, NULL);
    for (uint64_t round = 0; round < 2000 / LOM_LANES; round++) {
        lom_float3 p = { 0 };
        for (int i = 0; i < LOM_LANES; i++) {
            p.x[i] = (float)(uniform(round * 48 + (uint64_t)i) * 6 - 3);
            p.y[i] = (float)(uniform(round * 48 + (uint64_t)i + 16) * 6 - 3);
            p.z[i] = (float)(uniform(round * 48 + (uint64_t)i + 32) * 6 - 3);
        }
        lom_float off = lom_abs(fixed_detail(detail, p) - lom_sample_detail(detail, p));
        CHECK(lom_all(off <= (float)(3 * 0x1p-15 + 0x1p-20)), "round %d", (int)round);
    }
    lom_free_detail(detail);
    lom_free_image(image);
}

int main(int argc, char **argv)
{
    RUN(every_number_is_the_definition_and_near_float);
    RUN(noise_is_found_where_it_is_in_float);
    return check_result();
}
