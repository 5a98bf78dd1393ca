/* Proves: the march in fixed point is, bit for bit in every lane, what its definition gives a ray and a number at a time,
 * whether a packet lies in one cell, in two, in more, within the volume or beyond it, and in large volumes; every one of
 * these occurs. */
#include "check.h"

#include <math.h>

#include "march/fixed_volume.h"

static double uniform(uint64_t i, double low, double high)
{
    return low + (high - low) * lom_random_uniform(47, i);
}

static lom_image *make_image(const int size[3])
{
    lom_image *image = lom_create_image(size[0], size[1], size[2], LOM_FORMAT_RGBA8, NULL);
    for (int i = 0; i < 4 * size[0] * size[1] * size[2]; i++)
        image->pixels[i] = (uint8_t)(i % 4 == 3 && i / 4 % 3 == 0 ? 0 : lom_random_bits(9, (uint64_t)i));
    return image;
}

/* ---- a ray and a number at a time ---- */

static int mix(int a, int b, int weight)
{
    return a + (int)floor(((double)(b - a) * weight + 16384) / 32768);
}

/* A channel at a place of whole parts from the first voxel. */
static int filter(const lom_image *image, const int place[3], int bits, int channel)
{
    int cell[3], weight[3], v[8];
    for (int i = 0; i < 3; i++) {
        cell[i] = place[i] >> bits;
        weight[i] = (place[i] & ((1 << bits) - 1)) << (15 - bits);
    }
    for (int i = 0; i < 8; i++) {
        int x = cell[0] + (i & 1), y = cell[1] + (i >> 1 & 1), z = cell[2] + (i >> 2);
        x = x < image->width ? x : image->width - 1;
        y = y < image->height ? y : image->height - 1;
        z = z < image->depth ? z : image->depth - 1;
        v[i] = 128 * ((const uint8_t *)lom_image_pixel(image, x, y, z))[channel];
    }
    for (int i = 0; i < 4; i++)
        v[i] = mix(v[i], v[4 + i], weight[2]);
    return mix(mix(v[0], v[1], weight[0]), mix(v[2], v[3], weight[0]), weight[1]);
}

static int whole(float place, int size, int bits)
{
    const float first = 8388608, last = first + (float)(size - 1) * (float)(1 << bits);
    float cut = place > first ? place : first;
    return (int)((cut < last ? cut : last) - first);
}

static void define(const lom_image *image, const lom_march_desc *desc, const float start[3], const float step[3],
                   float out[4])
{
    const int size[3] = { image->width, image->height, image->depth };
    const int bits = size[0] > 256 || size[1] > 256 || size[2] > 256 ? 14 : 15;
    const float absorption = desc->absorption / 32640.0f, shade = desc->shade / 32640.0f;
    float sum[4] = { 0 };
    for (int n = 0; n < desc->steps && !(sum[3] > desc->opaque); n++) {
        int at[3], over[3];
        for (int i = 0; i < 3; i++) {
            const float parts = (float)(1 << bits), scale = (float)size[i] * parts;
            const float from = start[i] * scale + (8388608 - 0.5f * parts), along = step[i] * scale;
            const float place = from + along * (float)n;
            at[i] = whole(place, size[i], bits);
            over[i] = whole(place + (float)round((double)desc->light_offset[i] * (double)scale), size[i], bits);
        }
        float seen = (1.0f - sum[3]) * ((float)filter(image, at, bits, 3) * absorption);
        float light = seen * (1.0f - shade * (float)filter(image, over, bits, 3));
        for (int c = 0; c < 3; c++)
            sum[c] += light * (float)filter(image, at, bits, c);
        sum[3] += seen;
    }
    for (int c = 0; c < 4; c++)
        out[c] = c < 3 ? sum[c] * (1 / 32640.0f) : sum[3];
}

/* ---- packets ---- */

/* Lanes up to `width` apart; some not active, some not numbers or beyond all. */
static lom_march_rays random_rays(uint64_t seed, float width)
{
    float start[3][LOM_LANES], step[3][LOM_LANES];
    for (uint64_t k = 0; k < 3; k++) {
        float from = (float)uniform(seed + k, -0.2, 1.2), along = (float)uniform(seed + 3 + k, -0.03, 0.03);
        for (uint64_t i = 0; i < LOM_LANES; i++) {
            start[k][i] = from + width * (float)uniform(seed + 10 + 64 * k + i, -1, 1);
            step[k][i] = along + width * 0.01f * (float)uniform(seed + 42 + 64 * k + i, -1, 1);
        }
    }
    if (seed / 1000 % 8 == 5)
        start[seed / 1000 % 3][1] = __builtin_nanf("");
    if (seed / 1000 % 8 == 6)
        step[seed / 1000 % 3][2] = seed / 1000 % 16 == 6 ? 1e30f : -__builtin_inff();
    return (lom_march_rays){ { lom_load(start[0]), lom_load(start[1]), lom_load(start[2]) },
                             { lom_load(step[0]), lom_load(step[1]), lom_load(step[2]) },
                             lom_mask_of_bits((uint32_t)lom_random_bits(77, seed) | (seed % 3 == 0 ? 0xffffu : 0)) };
}

enum { ONE, TWO, MANY, WITHIN, BEYOND, KINDS };

static void count_kinds(const lom_march_rays *rays, const lom_march_desc *desc, int kinds[KINDS])
{
    const struct fixed_rays f = fix_rays(rays, desc);
    struct plan plan;
    for (int i = 0; i < desc->steps; i += LOM_LANES) {
        plan_cells(&f, i, &plan);
        for (int k = 0; k < LOM_LANES; k++) {
            int across = plan.at.across[k];
            kinds[across == 0 ? ONE : across == 1 || across == 2 || across == 4 ? TWO : MANY]++;
            kinds[plan.within[k] != 0 ? WITHIN : BEYOND]++;
        }
    }
}

static void check_packet(const lom_image *image, const lom_march_rays *rays, const lom_march_desc *desc)
{
    lom_float4 got;
    float start[3][LOM_LANES], step[3][LOM_LANES], lanes[4][LOM_LANES];
    LOM_WIDE(lom_march_volume)(&got, rays, desc, NULL);
    const lom_float from[3] = { rays->start.x, rays->start.y, rays->start.z };
    const lom_float along[3] = { rays->step.x, rays->step.y, rays->step.z };
    const lom_float channel[4] = { got.x, got.y, got.z, got.w };
    for (int k = 0; k < 4; k++)
        lom_store(lanes[k], channel[k]);
    for (int k = 0; k < 3; k++) {
        lom_store(start[k], from[k]);
        lom_store(step[k], along[k]);
    }
    for (int i = 0; i < LOM_LANES; i++) {
        float want[4] = { 0 };
        if ((lom_bits(rays->active) >> i & 1) != 0)
            define(image, desc, (float[3]){ start[0][i], start[1][i], start[2][i] },
                   (float[3]){ step[0][i], step[1][i], step[2][i] }, want);
        for (int c = 0; c < 4; c++)
            CHECK(memcmp(&want[c], &lanes[c][i], sizeof want[c]) == 0,
                  "%d x %d x %d, lane %d, channel %d: %.9g, not %.9g", image->width, image->height, image->depth, i, c,
                  (double)lanes[c][i], (double)want[c]);
    }
}

static void every_ray_is_the_definition(void)
{
    static const int sizes[][3] = { { 16, 16, 16 }, { 23, 9, 31 }, { 1, 1, 1 },   { 2, 5, 3 },
                                    { 64, 3, 4 },   { 256, 2, 3 }, { 257, 3, 2 }, { 3, 2, 512 } };
    int kinds[KINDS] = { 0 };
    for (uint64_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        lom_image *image = make_image(sizes[s]);
        lom_volume *volume = lom_create_volume(image, NULL);
        for (uint64_t round = 0; round < 48; round++) {
            static const float widths[] = { 0, 0.002f, 0.03f, 0.3f };
            const uint64_t seed = (s * 48 + round) * 1000;
            const double far = round % 5 == 0 ? 3 : 0.1;
            const lom_march_desc desc = { .volume = volume,
                                          .steps = 1 + (int)uniform(seed + 900, 0, 60),
                                          .absorption = (float)uniform(seed + 901, 0, 0.3),
                                          .light_offset = { (float)uniform(seed + 902, -far, far),
                                                            (float)uniform(seed + 903, -far, far),
                                                            (float)uniform(seed + 904, -far, far) },
                                          .shade = 0.6f,
                                          .opaque = 0.9f,
                                          .walk = round % 2 == 0,
                                          .filtering = LOM_FILTERING_FIXED };
            const lom_march_rays rays = random_rays(seed, widths[round / 2 % 4]);
            check_packet(image, &rays, &desc);
            count_kinds(&rays, &desc, kinds);
        }
        lom_free_volume(volume);
        lom_free_image(image);
    }
    for (int i = 0; i < KINDS; i++)
        CHECK(kinds[i] > 200, "kind %d: %d steps", i, kinds[i]);
}

int main(int argc, char **argv)
{
    RUN(every_ray_is_the_definition);
    return check_result();
}
