/* Proves: distances of a volume are the Chebyshev distances that brute force finds; samples agree with trilinear
 * interpolation in double; skipping empty space changes no byte of any ray; what lanes read by shared rows is what they
 * gather. */
#include "check.h"

#include "march/near_cells.h"

static uint32_t random_below(uint32_t *state, uint32_t limit)
{
    *state += 1;
    return (uint32_t)(lom_random_bits(2026, *state) % limit);
}

static float random_between(uint32_t *state, float low, float high)
{
    return low + (high - low) * (float)random_below(state, 1u << 20) / (float)(1 << 20);
}

/* A few blobs in an otherwise empty volume; now and then density on the border. */
static lom_image *random_image(uint32_t *state, int width, int height, int depth)
{
    lom_image *image = lom_create_image(width, height, depth, LOM_FORMAT_RGBA8, NULL);
    int blobs = (int)random_below(state, 4);
    for (int b = 0; b < blobs; b++) {
        int cx = (int)random_below(state, (uint32_t)width), cy = (int)random_below(state, (uint32_t)height);
        int cz = (int)random_below(state, (uint32_t)depth), r = 1 + (int)random_below(state, 4);
        for (int i = 0; i < width * height * depth; i++) {
            int x = i % width - cx, y = i / width % height - cy, z = i / (width * height) - cz;
            if (x * x + y * y + z * z < r * r)
                for (int k = 0; k < 4; k++)
                    image->pixels[4 * i + k] = (uint8_t)random_below(state, 256);
        }
    }
    return image;
}

static int density(const lom_image *image, int x, int y, int z)
{
    x = x < image->width ? x : image->width - 1;
    y = y < image->height ? y : image->height - 1;
    z = z < image->depth ? z : image->depth - 1;
    return ((const uint8_t *)lom_image_pixel(image, x, y, z))[3];
}

static int cell_holds(const lom_image *image, int x, int y, int z)
{
    int any = 0;
    for (int i = 0; i < 8; i++)
        any |= density(image, x + (i & 1), y + (i >> 1 & 1), z + (i >> 2));
    return any != 0;
}

static int brute_distance(const lom_image *image, int cx, int cy, int cz)
{
    int best = 255;
    for (int z = 0; z <= image->depth; z++)
        for (int y = 0; y <= image->height; y++)
            for (int x = 0; x <= image->width; x++) {
                int dx = abs(x - cx), dy = abs(y - cy), dz = abs(z - cz);
                int d = dx > dy ? dx : dy;
                d = dz > d ? dz : d;
                if (d < best && cell_holds(image, x, y, z))
                    best = d;
            }
    return best;
}

static void test_distances_are_chebyshev(void)
{
    uint32_t state = 1;
    for (int round = 0; round < 6; round++) {
        int w = 1 + (int)random_below(&state, 12), h = 1 + (int)random_below(&state, 12);
        int d = 1 + (int)random_below(&state, 12);
        lom_image *image = random_image(&state, w, h, d);
        lom_volume *volume = lom_create_volume(image, NULL);
        for (int z = 0; z <= d; z++)
            for (int y = 0; y <= h; y++)
                for (int x = 0; x <= w; x++) {
                    int got = volume->distance[(z * (h + 1) + y) * (w + 1) + x];
                    CHECK(got == brute_distance(image, x, y, z), "%d at %d %d %d of %dx%dx%d", got, x, y, z, w, h, d);
                }
        lom_free_volume(volume);
        lom_free_image(image);
    }
}

static double reference(const lom_image *image, const double p[3], int channel)
{
    const int size[3] = { image->width, image->height, image->depth };
    int cell[3];
    double weight[3], sum = 0;
    for (int k = 0; k < 3; k++) {
        double along = p[k] * size[k] - 0.5;
        along = along > 0 ? along : 0;
        along = along < size[k] - 1 ? along : size[k] - 1;
        cell[k] = (int)along;
        weight[k] = along - cell[k];
    }
    for (int i = 0; i < 8; i++) {
        int at[3];
        double w = 1;
        for (int k = 0; k < 3; k++) {
            at[k] = cell[k] + (i >> k & 1);
            at[k] = at[k] < size[k] ? at[k] : size[k] - 1;
            w *= i >> k & 1 ? weight[k] : 1 - weight[k];
        }
        sum += w * ((const uint8_t *)lom_image_pixel(image, at[0], at[1], at[2]))[channel];
    }
    return sum / 255;
}

static void test_samples_agree_with_double(void)
{
    uint32_t state = 77;
    lom_image *image = random_image(&state, 9, 5, 7);
    for (int i = 0; i < 9 * 5 * 7 * 4; i++)
        image->pixels[i] = (uint8_t)random_below(&state, 256);
    lom_volume *volume = lom_create_volume(image, NULL);
    for (int round = 0; round < 500; round++) {
        float p[3][LOM_LANES], got[4][LOM_LANES];
        for (int i = 0; i < 3 * LOM_LANES; i++)
            p[i / LOM_LANES][i % LOM_LANES] = random_between(&state, -0.25f, 1.25f);
        lom_volume_place place =
            lom_find_in_volume(volume, (lom_float3){ lom_load(p[0]), lom_load(p[1]), lom_load(p[2]) });
        lom_float3 color = lom_sample_volume_color(volume, place);
        lom_store(got[0], color.x);
        lom_store(got[1], color.y);
        lom_store(got[2], color.z);
        lom_store(got[3], lom_sample_density(volume, place));
        for (int i = 0; i < LOM_LANES; i++)
            for (int k = 0; k < 4; k++) {
                double want = reference(image, (double[3]){ p[0][i], p[1][i], p[2][i] }, k);
                double error = got[k][i] - want;
                CHECK(error < 4e-6 && error > -4e-6, "channel %d: %.9g for %.9g", k, got[k][i], want);
                CHECK(got[k][i] >= 0 && got[k][i] <= 1, "%.9g is outside [0, 1]", got[k][i]);
            }
    }
    lom_free_volume(volume);
    lom_free_image(image);
}

static lom_march_rays random_rays(uint32_t *state, float width)
{
    float start[3][LOM_LANES], step[3][LOM_LANES];
    for (int k = 0; k < 3; k++) {
        float from = random_between(state, -0.3f, 1.3f), along = random_between(state, -0.03f, 0.03f);
        for (int i = 0; i < LOM_LANES; i++) {
            start[k][i] = from + width * random_between(state, -1, 1);
            step[k][i] = along + width * 0.03f * random_between(state, -1, 1);
        }
    }
    return (lom_march_rays){ { lom_load(start[0]), lom_load(start[1]), lom_load(start[2]) },
                             { lom_load(step[0]), lom_load(step[1]), lom_load(step[2]) },
                             lom_mask_of_bits(random_below(state, 1u << LOM_LANES)) };
}

static void test_skipping_changes_no_byte(void)
{
    uint32_t state = 5;
    lom_march_count count = { 0 };
    for (int round = 0; round < 60; round++) {
        lom_image *image = random_image(&state, 1 + (int)random_below(&state, 40), 1 + (int)random_below(&state, 40),
                                        1 + (int)random_below(&state, 40));
        lom_volume *volume = lom_create_volume(image, NULL);
        lom_march_desc desc = { .volume = volume,
                                .steps = 1 + (int)random_below(&state, 150),
                                .absorption = random_between(&state, 0.05f, 1),
                                .light_offset = { 0.02f, 0.07f, 0.01f },
                                .shade = 0.6f,
                                .opaque = random_between(&state, 0.3f, 1),
                                .filtering = round % 2 == 0 ? LOM_FILTERING_FLOAT : LOM_FILTERING_FIXED };
        for (int i = 0; i < 100; i++) {
            lom_march_rays rays = random_rays(&state, i % 3 == 0 ? 0.2f : i % 3 == 1 ? 0.01f : 0);
            lom_float4 walked, skipped;
            desc.walk = true;
            LOM_WIDE(lom_march_volume)(&walked, &rays, &desc, NULL);
            desc.walk = false;
            LOM_WIDE(lom_march_volume)(&skipped, &rays, &desc, &count);
            CHECK(memcmp(&walked, &skipped, sizeof walked) == 0, "round %d, rays %d", round, i);
        }
        lom_free_volume(volume);
        lom_free_image(image);
    }
    CHECK(count.sampled * 2 < count.walked, "%llu of %llu steps sampled", (unsigned long long)count.sampled,
          (unsigned long long)count.walked);
}

static void test_extreme_rays_are_safe(void)
{
    static const float extremes[] = { 0, -1, 1e30f, -1e30f, 3e38f, 1e-40f, 0.5f };
    uint32_t state = 9;
    lom_image *image = random_image(&state, 8, 8, 8);
    lom_volume *volume = lom_create_volume(image, NULL);
    lom_march_desc desc = { .volume = volume, .steps = 50, .absorption = 0.5f, .opaque = 0.9f };
    for (int i = 0; i < 7 * 7; i++) {
        lom_float start = lom_splat(extremes[i % 7]), step = lom_splat(extremes[i / 7]);
        if (i % 3 == 0)
            start[i % LOM_LANES] = __builtin_nanf("");
        lom_march_rays rays = { { start, start, start }, { step, step, step }, lom_splat_int(-1) };
        lom_float4 walked, skipped;
        desc.walk = true;
        LOM_WIDE(lom_march_volume)(&walked, &rays, &desc, NULL);
        desc.walk = false;
        LOM_WIDE(lom_march_volume)(&skipped, &rays, &desc, NULL);
        CHECK(memcmp(&walked, &skipped, sizeof walked) == 0, "case %d", i);
    }
    lom_free_volume(volume);
    lom_free_image(image);
}

/* One channel is the density of white. */
static void test_gray_is_the_density_of_white(void)
{
    lom_image *image = lom_create_image(2, 2, 2, LOM_FORMAT_R8, NULL);
    for (int value = 0; value < 256; value += 51) {
        memset(image->pixels, value, 8);
        lom_volume *volume = lom_create_volume(image, NULL);
        lom_volume_place place = lom_find_in_volume(volume, lom_splat3(0.5f, 0.5f, 0.5f));
        lom_float3 color = lom_sample_volume_color(volume, place);
        CHECK(color.x[0] == 1 && color.y[0] == 1 && color.z[0] == 1, "%d: %g", value, (double)color.x[0]);
        float off = lom_sample_density(volume, place)[0] - (float)value / 255;
        CHECK(off < 1e-6f && off > -1e-6f, "%d: off by %g", value, (double)off);
        lom_free_volume(volume);
    }
    lom_free_image(image);
}

static bool same_words(lom_int a, lom_int b)
{
    return lom_all(a == b);
}

/* Lanes around a place of the volume or of its surroundings, `spread` cells apart at most. */
static struct spot random_spot(uint32_t *state, const lom_volume *volume, float spread)
{
    float at[3][LOM_LANES], middle[3];
    const int size[3] = { volume->width, volume->height, volume->depth };
    for (int axis = 0; axis < 3; axis++) {
        middle[axis] = random_between(state, -0.1f, 1.1f);
        for (int i = 0; i < LOM_LANES; i++)
            at[axis][i] = middle[axis] + random_between(state, -0.5f, 0.5f) * spread / (float)size[axis];
    }
    return find_spot(volume, (lom_float3){ lom_load(at[0]), lom_load(at[1]), lom_load(at[2]) });
}

/* At 16 lanes rows are shared, and by nearly all packets of half a cell; memory ends behind the last voxel. */
static void test_shared_rows_hold_what_is_gathered(void)
{
    static const int sizes[][3] = { { 1, 1, 1 }, { 2, 1, 3 }, { 3, 2, 2 }, { 4, 3, 2 }, { 9, 7, 5 }, { 17, 12, 20 } };
    static const float spreads[] = { 0.0f, 0.5f, 1.0f, 1.9f, 4.0f };
    uint32_t state = 12;
    for (size_t n = 0; n < sizeof sizes / sizeof *sizes; n++) {
        lom_image *image = lom_create_image(sizes[n][0], sizes[n][1], sizes[n][2], LOM_FORMAT_RGBA8, NULL);
        for (int i = 0; i < sizes[n][0] * sizes[n][1] * sizes[n][2] * 4; i++)
            image->pixels[i] = (uint8_t)random_below(&state, 256);
        lom_volume *volume = lom_create_volume(image, NULL);
        int shared = 0;
        for (int round = 0; round < 2000; round++) {
            struct spot spot = random_spot(&state, volume, spreads[round % 5]);
            lom_int low[2], high[2], got[8], want[8];
            load_densities(volume, &spot, &low[0], &high[0]);
            lom_gather_pairs(volume->density, spot.place.index + spot.place.index, &low[1], &high[1]);
            CHECK(same_words(low[0], low[1]) && same_words(high[0], high[1]), "densities, round %d", round);
            load_corners(volume, &spot, got);
            lom_load_volume_corners(volume, spot.place, want);
            for (int i = 0; i < 8; i++)
                CHECK(same_words(got[i], want[i]), "size %zu, corner %d, round %d", n, i, round);
            struct share share = find_share(&spot, first_of_two(spot.x), first_of_two(spot.y), first_of_two(spot.z), 2);
            shared += share.holds && round % 5 == 1;
        }
        CHECK(shared >= 390, "%d of 400 packets of half a cell are shared", shared);
        lom_free_volume(volume);
        lom_free_image(image);
    }
}

static void test_spots_are_places(void)
{
    uint32_t state = 4;
    lom_image *image = random_image(&state, 9, 5, 7);
    lom_volume *volume = lom_create_volume(image, NULL);
    for (int round = 0; round < 200; round++) {
        float at[3][LOM_LANES];
        for (int i = 0; i < 3 * LOM_LANES; i++)
            at[i / LOM_LANES][i % LOM_LANES] = random_between(&state, -0.25f, 1.25f);
        lom_float3 p = { lom_load(at[0]), lom_load(at[1]), lom_load(at[2]) };
        struct spot spot = find_spot(volume, p);
        lom_volume_place place = lom_find_in_volume(volume, p);
        CHECK(same_words(spot.place.index, place.index), "round %d", round);
        CHECK(same_words(lom_as_int(spot.place.x), lom_as_int(place.x)) &&
                  same_words(lom_as_int(spot.place.y), lom_as_int(place.y)) &&
                  same_words(lom_as_int(spot.place.z), lom_as_int(place.z)),
              "round %d", round);
    }
    lom_free_volume(volume);
    lom_free_image(image);
}

static void test_bad_images_are_refused(void)
{
    lom_error error = { 0 };
    CHECK(lom_create_volume(NULL, &error) == NULL && error.code == LOM_ERROR_USAGE, "%s", error.text);
    lom_image *image = lom_create_image(LOM_MAX_VOLUME + 1, 1, 1, LOM_FORMAT_R8, NULL);
    error.code = LOM_OK;
    CHECK(lom_create_volume(image, &error) == NULL && error.code == LOM_ERROR_LIMIT, "%s", error.text);
    lom_free_image(image);
    lom_free_volume(NULL);
}

int main(int argc, char **argv)
{
    RUN(test_distances_are_chebyshev);
    RUN(test_samples_agree_with_double);
    RUN(test_skipping_changes_no_byte);
    RUN(test_extreme_rays_are_safe);
    RUN(test_gray_is_the_density_of_white);
    RUN(test_spots_are_places);
    RUN(test_shared_rows_hold_what_is_gathered);
    RUN(test_bad_images_are_refused);
    return check_result();
}
