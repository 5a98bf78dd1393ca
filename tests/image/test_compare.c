/* Proves the comparison of pictures: counts, places and deltas of known differences; PSNR, SSIM and FLIP against closed
 * forms and against oracles written here with libm and without any separation, ring or table. */
#include "check.h"

#include <lom/image.h>

#include "image/compare.h"

#include <math.h>

/* ---- pictures ---- */

static lom_image *create(int width, int height, lom_format format)
{
    lom_error error = { 0 };
    lom_image *image = lom_create_image(width, height, 1, format, &error);
    if (image == NULL) {
        printf("FAIL setup: %s; repeat: tests/image/test_compare\n", error.text);
        exit(1);
    }
    return image;
}

static lom_image *fill(int width, int height, lom_format format, int value)
{
    lom_image *image = create(width, height, format);
    memset(image->pixels, value, lom_image_size(image));
    return image;
}

/* Blocks of random colours with a few random pixels: flat parts, edges and points. */
static lom_image *scatter(int width, int height, lom_format format, uint64_t key)
{
    lom_image *image = create(width, height, format);
    size_t pixel = lom_format_size(format);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            bool alone = lom_random_uniform(key, (uint64_t)(y * width + x)) < 0.1;
            uint64_t place = alone ? (uint64_t)(y * width + x + 5000) : (uint64_t)(y / 7 * 100 + x / 5 + 100000);
            for (size_t i = 0; i < pixel; i++)
                ((uint8_t *)lom_image_pixel(image, x, y, 0))[i] =
                    (uint8_t)(lom_random_bits(key, place) >> (8 * (i % 8)));
        }
    return image;
}

static lom_comparison compare(const lom_image *a, const lom_image *b)
{
    lom_comparison result;
    lom_error error = { 0 };
    CHECK(lom_compare_images(a, b, &result, &error), "%s", error.text);
    return result;
}

static double ssim(const lom_image *a, const lom_image *b)
{
    double value = NAN;
    lom_error error = { 0 };
    CHECK(lom_compare_ssim(a, b, &value, &error), "%s", error.text);
    return value;
}

static double flip(const lom_image *a, const lom_image *b)
{
    double value = NAN;
    lom_error error = { 0 };
    CHECK(lom_compare_flip(a, b, &value, &error), "%s", error.text);
    return value;
}

static void free_both(lom_image *a, lom_image *b)
{
    lom_free_image(a);
    lom_free_image(b);
}

/* ---- exact ---- */

static void identical_pictures(void)
{
    static const lom_format formats[] = { LOM_FORMAT_R8,         LOM_FORMAT_RGB8,   LOM_FORMAT_RGBA8,
                                          LOM_FORMAT_RGBA8_SRGB, LOM_FORMAT_RGB16,  LOM_FORMAT_RG16,
                                          LOM_FORMAT_RGBA16F,    LOM_FORMAT_RGB32F, LOM_FORMAT_DEPTH24 };
    static const int sizes[][2] = { { 1, 1 }, { 3, 40 }, { 40, 3 }, { 10, 10 }, { 11, 11 }, { 37, 29 } };
    for (size_t f = 0; f < sizeof formats / sizeof formats[0]; f++)
        for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; s++) {
            lom_image *a = scatter(sizes[s][0], sizes[s][1], formats[f], 1);
            lom_image *b = scatter(sizes[s][0], sizes[s][1], formats[f], 1);
            lom_comparison c = compare(a, b);
            CHECK(c.same_size && c.identical && c.pixels == 0 && c.max_delta == 0 && c.rmse == 0, "format %d",
                  (int)formats[f]);
            CHECK(isinf(c.psnr) && c.psnr > 0 && c.box[2] == 0 && c.box[3] == 0, "format %d", (int)formats[f]);
            CHECK(ssim(a, b) == 1, "format %d: %.17g", (int)formats[f], ssim(a, b));
            CHECK(flip(a, b) == 0, "format %d: %.17g", (int)formats[f], flip(a, b));
            free_both(a, b);
        }
}

static void finds_known_differences(void)
{
    lom_image *a = scatter(50, 40, LOM_FORMAT_RGBA8, 2), *b = scatter(50, 40, LOM_FORMAT_RGBA8, 2);
    uint8_t *early = lom_image_pixel(b, 7, 5, 0), *late = lom_image_pixel(b, 30, 20, 0);
    uint8_t *same = lom_image_pixel(a, 7, 5, 0);
    same[0] = 100, early[0] = 103; /* red by 3 */
    uint8_t *other = lom_image_pixel(a, 30, 20, 0);
    other[3] = 10, late[3] = 210; /* alpha by 200 */
    other[1] = 50, late[1] = 46;  /* green by 4 */
    lom_comparison c = compare(a, b);
    CHECK(!c.identical && c.pixels == 2, "%zu", c.pixels);
    CHECK(c.max_delta == 200 && c.max_at[0] == 30 && c.max_at[1] == 20 && c.max_at[2] == 0 && c.max_channel == 3);
    CHECK(c.box[0] == 7 && c.box[1] == 5 && c.box[2] == 24 && c.box[3] == 16, "%d %d %d %d", c.box[0], c.box[1],
          c.box[2], c.box[3]);
    double rmse = sqrt((9.0 + 16.0) / (50 * 40 * 3)); /* alpha does not count */
    CHECK(fabs(c.rmse - rmse) < 1e-15, "%.17g", c.rmse);
    CHECK(fabs(c.psnr - 20 * log10(255 / rmse)) < 1e-12, "%.17g", c.psnr);
    lom_image *picture = lom_compare_picture(a, b, NULL);
    const uint8_t *red = lom_image_pixel(picture, 7, 5, 0), *alpha = lom_image_pixel(picture, 30, 20, 0);
    CHECK(red[0] == (int)(64 + 191 * sqrt(3 / 255.0) + 0.5) && red[1] == 0 && red[2] == 0, "%d", red[0]);
    CHECK(alpha[0] == alpha[1] && alpha[1] == alpha[2] && alpha[0] == (int)(64 + 191 * sqrt(200 / 255.0) + 0.5));
    size_t lit = 0;
    for (size_t i = 0; i < lom_image_size(picture); i += 3)
        lit += (picture->pixels[i] | picture->pixels[i + 1] | picture->pixels[i + 2]) != 0;
    CHECK(lit == 2, "%zu", lit);
    lom_free_image(picture);
    free_both(a, b);
}

static void meets_in_the_wider_format(void)
{
    lom_image *gray = create(16, 16, LOM_FORMAT_R8), *rgba16 = create(16, 16, LOM_FORMAT_RGBA16);
    lom_image *single = create(16, 16, LOM_FORMAT_RGB32F), *half = create(16, 16, LOM_FORMAT_R16F);
    for (int i = 0; i < 256; i++) {
        gray->pixels[i] = (uint8_t)i;
        uint16_t wide[4] = { (uint16_t)(257 * i), (uint16_t)(257 * i), (uint16_t)(257 * i), 65535 };
        memcpy(rgba16->pixels + 8 * i, wide, sizeof wide);
        float value = (float)(i / 255.0), three[3] = { value, value, value };
        memcpy(single->pixels + 12 * i, three, sizeof three);
    }
    CHECK(compare(gray, rgba16).identical && compare(gray, rgba16).bits == 16 && compare(gray, rgba16).channels == 4);
    CHECK(compare(rgba16, gray).identical && compare(gray, single).identical && compare(gray, single).is_float);
    CHECK(compare(rgba16, single).identical, "n / 255 and 257 n / 65535 are the same number");
    rgba16->pixels[8 * 200] ^= 1;
    lom_comparison c = compare(gray, rgba16);
    CHECK(c.pixels == 1 && (c.max_delta == 1 || c.max_delta == 256), "%g", c.max_delta);
    memset(gray->pixels, 0, 256);
    const uint16_t halves[3] = { 0x3c00, 0xc000, 0x0001 }; /* 1, -2, 2^-24 */
    memcpy(half->pixels, halves, sizeof halves);
    c = compare(gray, half);
    CHECK(c.pixels == 3 && c.max_delta == 2 && c.max_at[0] == 1, "%zu %g", c.pixels, c.max_delta);
    CHECK(fabs(c.rmse - sqrt((1 + 4 + 0x1p-48) / 256)) < 1e-15, "%.17g", c.rmse);
    lom_image *depth24 = create(16, 16, LOM_FORMAT_DEPTH24), *depth16 = create(16, 16, LOM_FORMAT_DEPTH16);
    memset(depth24->pixels, 255, lom_image_size(depth24));
    memset(depth16->pixels, 255, lom_image_size(depth16));
    c = compare(depth24, depth16);
    CHECK(c.identical && c.is_float, "24 and 16 bits: %g", c.max_delta);
    depth16->pixels[0] = 254;
    c = compare(depth24, depth16);
    CHECK(c.pixels == 1 && fabs(c.max_delta - (depth16->pixels[1] == 255 ? 1 : 256) / 65535.0) < 0x1p-22, "%g",
          c.max_delta);
    lom_image *none = create(16, 16, LOM_FORMAT_DEPTH16);
    lom_error error = { 0 };
    none->format = LOM_FORMAT_NONE;
    CHECK(!lom_compare_images(none, depth16, &c, &error) && error.code == LOM_ERROR_USAGE, "%s", error.text);
    CHECK(lom_convert_image(none, LOM_FORMAT_R8, &error) == NULL && lom_compare_picture(gray, none, NULL) == NULL,
          "no format");
    none->format = LOM_FORMAT_DEPTH16;
    free_both(depth24, depth16);
    lom_free_image(none);
    lom_free_image(single);
    lom_free_image(half);
    free_both(gray, rgba16);
}

static void special_floats(void)
{
    static const struct {
        float a, b;
        double delta;
    } cases[] = {
        { 0.0f, -0.0f, 0 },   { NAN, NAN, 0 },           { INFINITY, INFINITY, 0 },         { NAN, 1, INFINITY },
        { 1, NAN, INFINITY }, { INFINITY, 1, INFINITY }, { INFINITY, -INFINITY, INFINITY }, { -2.5f, 1, 3.5 },
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        lom_image *a = create(12, 12, LOM_FORMAT_R32F), *b = create(12, 12, LOM_FORMAT_R32F);
        memcpy(a->pixels, &cases[i].a, sizeof(float));
        memcpy(b->pixels, &cases[i].b, sizeof(float));
        lom_comparison c = compare(a, b);
        CHECK(c.max_delta == cases[i].delta && c.identical == (cases[i].delta == 0), "case %zu: %g", i, c.max_delta);
        CHECK(isfinite(ssim(a, b)) && isfinite(flip(a, b)), "case %zu", i);
        free_both(a, b);
    }
}

static void sizes_that_differ(void)
{
    lom_image *a = create(4, 5, LOM_FORMAT_R8), *b = create(5, 4, LOM_FORMAT_R8);
    CHECK(!compare(a, b).same_size && !compare(a, b).identical);
    double value;
    lom_error error = { 0 };
    CHECK(!lom_compare_ssim(a, b, &value, &error) && strstr(error.text, "4 x 5") != NULL, "%s", error.text);
    size_t pixels;
    CHECK(!lom_compare_flip(a, b, &value, NULL) && !lom_count_differing_pixels(a, b, 0, &pixels, NULL));
    free_both(a, b);
}

/* Laid upon one another at the top left: 4 x 5 x 1 and 5 x 4 x 2 have 4 x 4 x 1 in common. */
static void picture_of_different_sizes(void)
{
    lom_image *a = fill(4, 5, LOM_FORMAT_R8, 9), *b = lom_create_image(5, 4, 2, LOM_FORMAT_RGB8, NULL);
    memset(b->pixels, 9, lom_image_size(b));
    ((uint8_t *)lom_image_pixel(b, 3, 2, 0))[1] = 200;
    lom_image *picture = lom_compare_picture(a, b, NULL);
    CHECK(picture != NULL && picture->width == 5 && picture->height == 5 && picture->depth == 2);
    for (int z = 0; z < 2; z++)
        for (int y = 0; y < 5; y++)
            for (int x = 0; x < 5; x++) {
                bool common = x < 4 && y < 4 && z < 1, differs = x == 3 && y == 2;
                for (int c = 0; c < 3; c++) {
                    int expected = !common ? 32 : differs && c == 1 ? (int)(64 + 191 * sqrt(191 / 255.0) + 0.5) : 0;
                    int got = ((const uint8_t *)lom_image_pixel(picture, x, y, z))[c];
                    CHECK(got == expected, "%d,%d,%d channel %d: %d instead of %d", x, y, z, c, got, expected);
                }
            }
    lom_free_image(picture);
    free_both(a, b);
}

/* Every sample by hand, in numbers that are not those of the code under test. */
static void counts_as_a_plain_loop_does(void)
{
    static const lom_format formats[] = { LOM_FORMAT_R8,  LOM_FORMAT_RG8,   LOM_FORMAT_RGB8,   LOM_FORMAT_RGBA8,
                                          LOM_FORMAT_R16, LOM_FORMAT_RGB16, LOM_FORMAT_RGBA16, LOM_FORMAT_R32F };
    for (size_t f = 0; f < sizeof formats / sizeof formats[0]; f++) {
        lom_image *a = scatter(41, 37, formats[f], 5), *b = scatter(41, 37, formats[f], 5);
        const lom_format_info *info = lom_describe_format(formats[f]);
        for (size_t i = 0; i < lom_image_size(b); i += 97) /* no exponent of a float */
            b->pixels[i - i % 4] ^= (uint8_t)(i % 251);
        double tolerance = info->is_float ? 1e-3 : info->bits == 8 ? 64 : 200;
        size_t pixels = 0, above = 0;
        double largest = 0;
        for (int y = 0; y < 37; y++)
            for (int x = 0; x < 41; x++) {
                double most = 0;
                for (int c = 0; c < info->channels; c++) {
                    const uint8_t *p = lom_image_pixel(a, x, y, 0), *q = lom_image_pixel(b, x, y, 0);
                    float single[2];
                    memcpy(&single[0], p, 4 * (size_t)info->is_float);
                    memcpy(&single[1], q, 4 * (size_t)info->is_float);
                    uint16_t wide[2];
                    memcpy(&wide[0], p + 2 * c, 2 * (size_t)(info->bits == 16));
                    memcpy(&wide[1], q + 2 * c, 2 * (size_t)(info->bits == 16));
                    double d = info->is_float    ? fabs((double)single[0] - (double)single[1])
                               : info->bits == 8 ? abs(p[c] - q[c])
                                                 : abs(wide[0] - wide[1]);
                    most = isfinite(d) ? fmax(most, d) : most; /* noise may be NaN, in both the same */
                }
                pixels += most > 0;
                above += most > tolerance;
                largest = fmax(largest, most);
            }
        lom_comparison c = compare(a, b);
        size_t counted = 99999;
        CHECK(lom_count_differing_pixels(a, b, tolerance, &counted, NULL) && counted == above, "format %d: %zu not %zu",
              (int)formats[f], counted, above);
        CHECK(c.pixels == pixels && c.max_delta == largest && pixels > 10, "format %d: %zu %zu, %g %g", (int)formats[f],
              c.pixels, pixels, c.max_delta, largest);
        CHECK(lom_count_differing_pixels(a, b, 0, &counted, NULL) && counted == pixels, "format %d", (int)formats[f]);
        CHECK(lom_count_differing_pixels(a, b, largest, &counted, NULL) && counted == 0, "format %d", (int)formats[f]);
        free_both(a, b);
    }
}

/* Pictures of several bands and slices, of which many rows are equal: every number of workers, the same bits. */
static void same_bits_on_any_threads(void)
{
    lom_image *a = lom_create_image(33, 150, 2, LOM_FORMAT_RGB8, NULL),
              *b = lom_create_image(33, 150, 2, LOM_FORMAT_RGB8, NULL);
    for (size_t i = 0; i < lom_image_size(a); i++) {
        a->pixels[i] = (uint8_t)lom_random_bits(1, i);
        int y = (int)(i / 99 % 150);
        b->pixels[i] =
            (uint8_t)(a->pixels[i] + (y == 40 || y == 61 || y == 100 || y > 130 ? lom_random_bits(2, i) % 9 : 0));
    }
    lom_comparison exact[5] = { { 0 } };
    double values[5][2];
    for (int i = 0; i < 5; i++) {
        lom_pool *pool = lom_create_pool(1 + i * i, NULL);
        CHECK(lom_compare_images_on(pool, a, b, &exact[i], NULL) &&
              lom_compare_ssim_on(pool, a, b, &values[i][0], NULL) &&
              lom_compare_flip_on(pool, a, b, &values[i][1], NULL));
        CHECK(exact[i].pixels == exact[0].pixels && exact[i].rmse == exact[0].rmse && exact[i].psnr == exact[0].psnr &&
                  memcmp(exact[i].box, exact[0].box, sizeof exact[i].box) == 0 &&
                  memcmp(exact[i].max_at, exact[0].max_at, sizeof exact[i].max_at) == 0,
              "%d workers", 1 + i * i);
        CHECK(values[i][0] == values[0][0] && values[i][1] == values[0][1], "%d workers: %.17g %.17g, not %.17g %.17g",
              1 + i * i, values[i][0], values[i][1], values[0][0], values[0][1]);
        lom_free_pool(pool);
    }
    CHECK(exact[0].box[1] == 40 && exact[0].box[3] == 110, "%d %d", exact[0].box[1], exact[0].box[3]);
    free_both(a, b);
}

/* FLIP does not look at rows that see equal rows alone: its mean is what it is for pictures that differ in form and not
 * in light, where it looks at all. */
static void skips_only_what_is_equal(void)
{
    lom_image *a = scatter(20, 90, LOM_FORMAT_RGB8, 3), *b = scatter(20, 90, LOM_FORMAT_RGB8, 3);
    lom_image *wide = create(20, 90, LOM_FORMAT_RGB16);
    for (int y = 30; y < 33; y++)
        memset(lom_image_pixel(b, 0, y, 0), 200, 60);
    memset(lom_image_pixel(b, 0, 89, 0), 10, 60);
    for (size_t i = 0; i < lom_image_size(b); i++) {
        uint16_t sample = (uint16_t)(257 * b->pixels[i]);
        memcpy(wide->pixels + 2 * i, &sample, sizeof sample);
    }
    CHECK(compare(b, wide).identical && flip(a, b) > 0.001 && fabs(flip(a, b) - flip(a, wide)) < 1e-12, "%.17g %.17g",
          flip(a, b), flip(a, wide));
    lom_free_image(wide);
    free_both(a, b);
}

/* ---- closed forms ---- */

static void psnr_of_offsets(void)
{
    for (int offset = 1; offset < 256; offset += 18) {
        lom_image *a = fill(13, 17, LOM_FORMAT_RGB8, 0), *b = fill(13, 17, LOM_FORMAT_RGB8, offset);
        lom_comparison c = compare(a, b);
        CHECK(c.rmse == offset && fabs(c.psnr - 20 * log10(255.0 / offset)) < 1e-12, "%d: %.17g", offset, c.psnr);
        free_both(a, b);
    }
}

/* Without variance only the means count: (2 a b + C1) / (a^2 + b^2 + C1). */
static void ssim_of_constants(void)
{
    for (int a = 0; a < 256; a += 51)
        for (int b = 0; b < 256; b += 17) {
            lom_image *pa = fill(20, 15, LOM_FORMAT_RGB8, a), *pb = fill(20, 15, LOM_FORMAT_RGB8, b);
            double x = a / 255.0, y = b / 255.0;
            double expected = (2 * x * y + 1e-4) / (x * x + y * y + 1e-4);
            CHECK(fabs(ssim(pa, pb) - expected) < 1e-9, "%d %d: %.17g %.17g", a, b, ssim(pa, pb), expected);
            free_both(pa, pb);
        }
}

/* ---- oracles ---- */

static double luma(const lom_image *image, int x, int y)
{
    const uint8_t *p = lom_image_pixel(image, x, y, 0);
    return (0.299 * p[0] + 0.587 * p[1] + 0.114 * p[2]) / 255;
}

static double naive_ssim(const lom_image *a, const lom_image *b)
{
    double sum = 0;
    for (int y = 5; y < a->height - 5; y++)
        for (int x = 5; x < a->width - 5; x++) {
            double weights = 0, ma = 0, mb = 0, va = 0, vb = 0, cov = 0;
            for (int pass = 0; pass < 2; pass++)
                for (int j = -5; j <= 5; j++)
                    for (int i = -5; i <= 5; i++) {
                        double w = exp(-(i * i + j * j) / 4.5), p = luma(a, x + i, y + j), q = luma(b, x + i, y + j);
                        if (pass == 0) {
                            weights += w, ma += w * p, mb += w * q;
                        } else {
                            va += w * (p - ma / weights) * (p - ma / weights);
                            vb += w * (q - mb / weights) * (q - mb / weights);
                            cov += w * (p - ma / weights) * (q - mb / weights);
                        }
                    }
            ma /= weights, mb /= weights, va /= weights, vb /= weights, cov /= weights;
            sum += (2 * ma * mb + 1e-4) * (2 * cov + 9e-4) / ((ma * ma + mb * mb + 1e-4) * (va + vb + 9e-4));
        }
    return sum / ((a->width - 10) * (a->height - 10));
}

static void ssim_against_the_definition(void)
{
    for (uint64_t key = 10; key < 14; key++) {
        lom_image *a = scatter(31, 26, LOM_FORMAT_RGB8, key), *b = scatter(31, 26, LOM_FORMAT_RGB8, key + 100);
        if (key % 2 == 0) /* near each other */
            for (size_t i = 0; i < lom_image_size(a); i++)
                b->pixels[i] = (uint8_t)((7 * a->pixels[i] + b->pixels[i]) / 8);
        double got = ssim(a, b), expected = naive_ssim(a, b);
        CHECK(fabs(got - expected) < 1e-12, "key %d: %.17g %.17g", (int)key, got, expected);
        CHECK(got == ssim(b, a));
        free_both(a, b);
    }
}

static double decode(double v)
{
    return v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
}

/* The published 7-digit form of the sRGB matrix, so the oracle shares no constant with the code under test. */
static const double matrix[3][3] = { { 0.41238656, 0.35759149, 0.18045049 },
                                     { 0.21263682, 0.71518298, 0.07218020 },
                                     { 0.01933062, 0.11919716, 0.95037259 } };

static void opponent_of(const double rgb[3], double out[3])
{
    double t[3];
    for (int i = 0; i < 3; i++)
        t[i] = (matrix[i][0] * rgb[0] + matrix[i][1] * rgb[1] + matrix[i][2] * rgb[2]) /
               (matrix[i][0] + matrix[i][1] + matrix[i][2]);
    out[0] = 116 * t[1] - 16, out[1] = 500 * (t[0] - t[1]), out[2] = 200 * (t[1] - t[2]);
}

static double lab_curve(double t)
{
    return t > 216.0 / 24389 ? cbrt(t) : t * 841 / 108 + 4.0 / 29;
}

/* Cramer's rule on the matrix, clamp, then L*a*b* times 0.01 L. */
static void hunt_of(const double opponent[3], double lab[3])
{
    double y = (opponent[0] + 16) / 116, xyz[3] = { opponent[1] / 500 + y, y, y - opponent[2] / 200 }, rgb[3], t[3];
    for (int i = 0; i < 3; i++)
        xyz[i] *= matrix[i][0] + matrix[i][1] + matrix[i][2];
    double det = 0;
    for (int column = -1; column < 3; column++) {
        double m[3][3];
        memcpy(m, matrix, sizeof m);
        for (int i = 0; i < 3 && column >= 0; i++)
            m[i][column] = xyz[i];
        double d = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                   m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                   m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
        if (column < 0)
            det = d;
        else
            rgb[column] = fmin(fmax(d / det, 0), 1);
    }
    opponent_of(rgb, t);
    double fy = lab_curve((t[0] + 16) / 116);
    double fx = lab_curve(t[1] / 500 + (t[0] + 16) / 116), fz = lab_curve((t[0] + 16) / 116 - t[2] / 200);
    lab[0] = 116 * fy - 16;
    lab[1] = 0.01 * lab[0] * 500 * (fx - fy);
    lab[2] = 0.01 * lab[0] * 200 * (fy - fz);
}

static double hyab(const double p[3], const double q[3])
{
    return pow(fabs(p[0] - q[0]) + hypot(p[1] - q[1], p[2] - q[2]), 0.7);
}

static double largest_distance(void)
{
    double green[3], blue[3], o[3];
    opponent_of((const double[3]){ 0, 1, 0 }, o);
    hunt_of(o, green);
    opponent_of((const double[3]){ 0, 0, 1 }, o);
    hunt_of(o, blue);
    return hyab(green, blue);
}

/* The sRGB opponent colour at (x, y), the border repeated. */
static void opponent_at(const lom_image *image, int x, int y, double out[3])
{
    x = x < 0 ? 0 : x >= image->width ? image->width - 1 : x;
    y = y < 0 ? 0 : y >= image->height ? image->height - 1 : y;
    const uint8_t *p = lom_image_pixel(image, x, y, 0);
    opponent_of((const double[3]){ decode(p[0] / 255.0), decode(p[1] / 255.0), decode(p[2] / 255.0) }, out);
}

static double contrast_weight(int channel, int i, int j)
{
    static const double a[3][2] = { { 1, 0 }, { 1, 0 }, { 34.1, 13.5 } };
    static const double b[3][2] = { { 0.0047, 1e-5 }, { 0.0053, 1e-5 }, { 0.04, 0.025 } };
    double d2 = (i * i + j * j) / (67.0 * 67.0), sum = 0;
    for (int k = 0; k < 2; k++)
        sum += a[channel][k] * sqrt(M_PI / b[channel][k]) * exp(-M_PI * M_PI * d2 / b[channel][k]);
    return sum;
}

struct perceived {
    double lab[3], edge, point;
};

static struct perceived perceive(const lom_image *image, int x, int y)
{
    double sums[3] = { 0 }, weights[3] = { 0 };
    for (int j = -10; j <= 10; j++)
        for (int i = -10; i <= 10; i++) {
            double o[3];
            opponent_at(image, x + i, y + j, o);
            for (int c = 0; c < 3; c++) {
                double w = contrast_weight(c, i, j);
                sums[c] += w * o[c];
                weights[c] += w;
            }
        }
    struct perceived result;
    hunt_of((const double[3]){ sums[0] / weights[0], sums[1] / weights[1], sums[2] / weights[2] }, result.lab);
    double deviation = 0.5 * 0.082 * 67, features[2][2] = { { 0 } };
    for (int kind = 0; kind < 2; kind++)
        for (int direction = 0; direction < 2; direction++) {
            double plus = 0, minus = 0, positive = 0, negative = 0;
            for (int j = -9; j <= 9; j++)
                for (int i = -9; i <= 9; i++) {
                    double o[3], d = direction == 0 ? i : j;
                    opponent_at(image, x + i, y + j, o);
                    double g = exp(-(i * i + j * j) / (2 * deviation * deviation));
                    double w = kind == 0 ? -d * g : (d * d / (deviation * deviation) - 1) * g;
                    double luminance = (o[0] + 16) / 116;
                    *(w > 0 ? &plus : &minus) += w;
                    *(w > 0 ? &positive : &negative) += w * luminance;
                }
            features[kind][direction] = positive / plus - negative / minus;
        }
    result.edge = hypot(features[0][0], features[0][1]);
    result.point = hypot(features[1][0], features[1][1]);
    return result;
}

static double redistribute(double distance)
{
    double largest = largest_distance(), knee = 0.4 * largest;
    return distance < knee ? 0.95 * distance / knee : 0.95 + 0.05 * (distance - knee) / (largest - knee);
}

static double naive_flip(const lom_image *a, const lom_image *b)
{
    double sum = 0;
    for (int y = 0; y < a->height; y++)
        for (int x = 0; x < a->width; x++) {
            struct perceived p = perceive(a, x, y), q = perceive(b, x, y);
            double color = redistribute(hyab(p.lab, q.lab));
            double feature = fmax(fabs(p.edge - q.edge), fabs(p.point - q.point));
            sum += pow(color, 1 - sqrt(feature / sqrt(2)));
        }
    return sum / (a->width * a->height);
}

static void flip_against_the_definition(void)
{
    static const int sizes[][2] = { { 33, 25 }, { 5, 40 }, { 1, 1 }, { 23, 3 } };
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++)
        for (int near = 0; near < 2; near++) {
            lom_image *a = scatter(sizes[i][0], sizes[i][1], LOM_FORMAT_RGB8, 20 + i);
            lom_image *b = scatter(sizes[i][0], sizes[i][1], LOM_FORMAT_RGB8, 40 + i);
            for (size_t k = 0; k < lom_image_size(a) && near; k++)
                b->pixels[k] = (uint8_t)((15 * a->pixels[k] + b->pixels[k]) / 16);
            double got = flip(a, b), expected = naive_flip(a, b);
            CHECK(fabs(got - expected) < 1e-6, "%d x %d: %.12g %.12g", a->width, a->height, got, expected);
            CHECK(got > 0 && got <= 1 && got == flip(b, a), "swapped");
            free_both(a, b);
        }
}

/* Constant pictures have no features, and filters that sum to 1 leave them: black against white differs by L* = 100
 * alone, 100^0.7 = 25.1189, beyond the knee. The largest distance, of green and blue, is 41.28 (section 4.3 of the
 * paper by hand: L* 87.74 and 32.30). */
static void flip_of_black_and_white(void)
{
    CHECK(fabs(largest_distance() - 41.28) < 0.01, "%.6f", largest_distance());
    double expected = 0.95 + 0.05 * (pow(100, 0.7) - 0.4 * largest_distance()) / (0.6 * largest_distance());
    static const lom_format formats[] = { LOM_FORMAT_RGB8, LOM_FORMAT_R16, LOM_FORMAT_RGBA8, LOM_FORMAT_R8_SRGB };
    for (size_t i = 0; i < sizeof formats / sizeof formats[0]; i++) {
        lom_image *black = fill(30, 20, formats[i], 0), *white = fill(30, 20, formats[i], 255);
        CHECK(fabs(flip(black, white) - expected) < 1e-6, "%.9f %.9f", flip(black, white), expected);
        free_both(black, white);
    }
    CHECK(expected > 0.96 && expected < 0.98, "%.6f", expected);
}

/* Floats are linear light: the same light in both forms is the same picture to SSIM and FLIP, nearly. */
static void floats_are_linear_light(void)
{
    lom_image *a = scatter(30, 30, LOM_FORMAT_RGB8, 60), *b = scatter(30, 30, LOM_FORMAT_RGB8, 61);
    lom_image *fa = create(30, 30, LOM_FORMAT_RGB32F), *fb = create(30, 30, LOM_FORMAT_RGB32F);
    for (size_t i = 0; i < lom_image_size(a); i++) {
        float va = (float)decode(a->pixels[i] / 255.0), vb = (float)decode(b->pixels[i] / 255.0);
        memcpy(fa->pixels + 4 * i, &va, sizeof va);
        memcpy(fb->pixels + 4 * i, &vb, sizeof vb);
    }
    CHECK(fabs(flip(a, b) - flip(fa, fb)) < 1e-6 && fabs(ssim(a, b) - ssim(fa, fb)) < 1e-6);
    lom_reinterpret_image(a, LOM_FORMAT_RGB8_SRGB, NULL);
    CHECK(compare(a, fa).max_delta < 1e-7 && flip(a, fa) < 1e-6, "%g %g", compare(a, fa).max_delta, flip(a, fa));
    free_both(a, b);
    free_both(fa, fb);
}

/* More of a difference gives more FLIP and less SSIM. */
static void grows_with_the_difference(void)
{
    lom_image *a = scatter(40, 30, LOM_FORMAT_RGB8, 70), *noise = scatter(40, 30, LOM_FORMAT_RGB8, 71);
    lom_image *b = create(40, 30, LOM_FORMAT_RGB8);
    double last_flip = 0, last_ssim = 1;
    for (int share = 2; share <= 16; share += 2) {
        for (size_t i = 0; i < lom_image_size(a); i++)
            b->pixels[i] = (uint8_t)(((16 - share) * a->pixels[i] + share * noise->pixels[i]) / 16);
        double f = flip(a, b), s = ssim(a, b);
        CHECK(f > last_flip && s < last_ssim, "share %d: flip %g ssim %g", share, f, s);
        last_flip = f;
        last_ssim = s;
    }
    lom_free_image(noise);
    free_both(a, b);
}

static void slices_count_alike(void)
{
    lom_image *flat = scatter(20, 20, LOM_FORMAT_RGB8, 80), *other = scatter(20, 20, LOM_FORMAT_RGB8, 81);
    lom_image *a = lom_create_image(20, 20, 2, LOM_FORMAT_RGB8, NULL),
              *b = lom_create_image(20, 20, 2, LOM_FORMAT_RGB8, NULL);
    size_t size = lom_image_size(flat);
    memcpy(a->pixels, flat->pixels, size);
    memcpy(b->pixels, flat->pixels, size);
    memcpy(a->pixels + size, flat->pixels, size);
    memcpy(b->pixels + size, other->pixels, size);
    lom_comparison whole = compare(a, b), part = compare(flat, other);
    CHECK(whole.pixels == part.pixels && whole.max_at[2] == 1 && fabs(whole.rmse * sqrt(2) - part.rmse) < 1e-12);
    CHECK(fabs(ssim(a, b) - (1 + ssim(flat, other)) / 2) < 1e-15 && fabs(flip(a, b) - flip(flat, other) / 2) < 1e-15);
    free_both(flat, other);
    free_both(a, b);
}

int main(int argc, char **argv)
{
    RUN(identical_pictures);
    RUN(finds_known_differences);
    RUN(meets_in_the_wider_format);
    RUN(special_floats);
    RUN(sizes_that_differ);
    RUN(picture_of_different_sizes);
    RUN(counts_as_a_plain_loop_does);
    RUN(same_bits_on_any_threads);
    RUN(skips_only_what_is_equal);
    RUN(psnr_of_offsets);
    RUN(ssim_of_constants);
    RUN(ssim_against_the_definition);
    RUN(flip_against_the_definition);
    RUN(flip_of_black_and_white);
    RUN(floats_are_linear_light);
    RUN(grows_with_the_difference);
    RUN(slices_count_alike);
    return check_result();
}
