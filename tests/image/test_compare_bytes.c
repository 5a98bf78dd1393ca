/* Proves that pictures of bytes are compared as any others are: what whole numbers find in a row is, bit for bit, what the
 * plain loop over doubles finds of the same samples beside an alpha that is opaque in both. */
#include "check.h"

#include <lom/image.h>

static lom_image *create(int width, int height, lom_format format)
{
    lom_image *image = lom_create_image(width, height, 1, format, NULL);
    if (image == NULL) {
        printf("FAIL setup: no memory; repeat: tests/image/test_compare_bytes\n");
        exit(1);
    }
    return image;
}

/* Mostly equal, so that rows, edges of differences and first places of the largest are of every kind. */
static void scatter(lom_image *a, lom_image *b, uint64_t key, int most)
{
    for (size_t i = 0; i < lom_image_size(a); i++) {
        uint64_t bits = lom_random_bits(key, i);
        a->pixels[i] = (uint8_t)bits;
        int delta = (bits >> 8 & 31) == 0 ? (int)(bits >> 16 & 255) % (most + 1) : 0;
        b->pixels[i] = (uint8_t)(a->pixels[i] + delta > 255 ? a->pixels[i] - delta : a->pixels[i] + delta);
    }
}

/* The same samples and an opaque alpha: with it, two formats meet, and nothing is compared as bytes. */
static lom_image *with_alpha(const lom_image *image)
{
    int channels = lom_describe_format(image->format)->channels;
    lom_image *wide = create(image->width, image->height, channels == 1 ? LOM_FORMAT_RG8 : LOM_FORMAT_RGBA8);
    for (int y = 0; y < image->height; y++)
        for (int x = 0; x < image->width; x++) {
            uint8_t *to = lom_image_pixel(wide, x, y, 0);
            memcpy(to, lom_image_pixel(image, x, y, 0), (size_t)channels);
            to[channels] = 255;
        }
    return wide;
}

static void check_same(const lom_comparison *a, const lom_comparison *b, const char *what)
{
    CHECK(a->identical == b->identical && a->pixels == b->pixels, "%s: %zu, %zu", what, a->pixels, b->pixels);
    CHECK(a->max_delta == b->max_delta && a->max_channel == b->max_channel && a->rmse == b->rmse && a->psnr == b->psnr,
          "%s: %g %g", what, a->max_delta, b->max_delta);
    CHECK(memcmp(a->box, b->box, sizeof a->box) == 0 && memcmp(a->max_at, b->max_at, sizeof a->max_at) == 0, "%s",
          what);
}

static void bytes_are_compared_as_doubles_are(void)
{
    static const lom_format formats[] = { LOM_FORMAT_R8, LOM_FORMAT_RGB8 };
    static const int sizes[][2] = { { 1, 1 }, { 17, 9 }, { 64, 40 }, { 30000, 2 } }, mosts[] = { 1, 3, 255 };
    for (size_t i = 0; i < 2 * 4 * 3; i++) {
        const int *size = sizes[i / 2 % 4];
        lom_image *a = create(size[0], size[1], formats[i % 2]), *b = create(size[0], size[1], formats[i % 2]);
        char what[64];
        snprintf(what, sizeof what, "case %zu: %d x %d", i, size[0], size[1]);
        scatter(a, b, i, mosts[i / 8]);
        lom_image *wide = with_alpha(a);
        lom_comparison bytes, doubles;
        CHECK(lom_compare_images(a, b, &bytes, NULL) && lom_compare_images(wide, b, &doubles, NULL));
        check_same(&bytes, &doubles, what);
        static const double tolerances[] = { 0, 0.5, 1, 2.99, 3, 254, 255, 1e30 };
        for (size_t t = 0; t < sizeof tolerances / sizeof tolerances[0]; t++) {
            size_t above = 0, plain = 1;
            CHECK(lom_count_differing_pixels(a, b, tolerances[t], &above, NULL) &&
                      lom_count_differing_pixels(wide, b, tolerances[t], &plain, NULL) && above == plain,
                  "%s: %zu and %zu differ by more than %g", what, above, plain, tolerances[t]);
        }
        lom_free_image(wide);
        lom_free_image(a);
        lom_free_image(b);
    }
}

/* Alpha counts in all but the squares: two channels and four, against a loop. */
static void alpha_is_no_colour(void)
{
    static const lom_format formats[] = { LOM_FORMAT_RG8, LOM_FORMAT_RGBA8, LOM_FORMAT_RGBA8_SRGB };
    for (size_t f = 0; f < 3; f++) {
        lom_image *a = create(50, 30, formats[f]), *b = create(50, 30, formats[f]);
        int channels = lom_describe_format(formats[f])->channels;
        scatter(a, b, 100 + f, 200);
        double squares = 0;
        size_t pixels = 0;
        for (int i = 0; i < 50 * 30; i++) {
            bool differs = false;
            for (int c = 0; c < channels; c++) {
                int delta = a->pixels[i * channels + c] - b->pixels[i * channels + c];
                squares += c < channels - 1 ? delta * delta : 0;
                differs |= delta != 0;
            }
            pixels += differs;
        }
        lom_comparison c;
        CHECK(lom_compare_images(a, b, &c, NULL) && c.pixels == pixels, "%zu, %zu", c.pixels, pixels);
        CHECK(c.rmse == __builtin_sqrt(squares / (50.0 * 30 * (channels - 1))), "%.17g", c.rmse);
        lom_free_image(a);
        lom_free_image(b);
    }
}

int main(int argc, char **argv)
{
    RUN(bytes_are_compared_as_doubles_are);
    RUN(alpha_is_no_colour);
    return check_result();
}
