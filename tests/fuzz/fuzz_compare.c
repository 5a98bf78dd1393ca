/* Two small pictures of any formats and sizes, and any bytes in them: what the comparison must say whatever they hold.
 * Swapped it says the same, a picture equals itself, a count above a larger tolerance is no larger, and the picture of
 * the differences is black where, and only where, the samples are equal. */
#include <lom/image.h>

#include "bytes.h"

#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void require(bool condition)
{
    if (!condition)
        abort();
}

static lom_image *take_image(fuzz_bytes *in)
{
    lom_format format = (lom_format)(1 + take_choice(in, LOM_FORMAT_COUNT - 1));
    int width = 1 + take_choice(in, 24), height = 1 + take_choice(in, 24), depth = 1 + take_choice(in, 9) / 8;
    return lom_create_image(width, height, depth, format, NULL);
}

/* A run of bytes over and over, with a few others among them. */
static void fill(fuzz_bytes *in, lom_image *image)
{
    uint8_t run[16];
    for (int i = 0; i < 16; i++)
        run[i] = (uint8_t)take_byte(in);
    size_t size = lom_image_size(image);
    for (size_t i = 0; i < size; i++)
        image->pixels[i] = run[i % 16];
    for (int i = take_choice(in, 32); i > 0; i--)
        image->pixels[take_word(in) % size] = (uint8_t)take_byte(in);
}

static size_t lit_pixels(const lom_image *a, const lom_image *b)
{
    lom_image *picture = lom_compare_picture(a, b, NULL);
    require(picture != NULL);
    size_t lit = 0;
    for (size_t i = 0; i < lom_image_size(picture); i += 3)
        lit += (picture->pixels[i] | picture->pixels[i + 1] | picture->pixels[i + 2]) != 0;
    lom_free_image(picture);
    return lit;
}

static void check_pair(const lom_image *a, const lom_image *b, double tolerance)
{
    lom_comparison c, swapped;
    require(lom_compare_images(a, b, &c, NULL) && lom_compare_images(b, a, &swapped, NULL));
    size_t lit = lit_pixels(a, b), above, more;
    if (!c.same_size)
        return;
    require(c.pixels == swapped.pixels && c.max_delta == swapped.max_delta && c.rmse == swapped.rmse);
    require(c.identical == (c.pixels == 0) && c.identical == (c.max_delta == 0) && c.pixels == lit);
    require(c.identical || (c.box[0] >= 0 && c.box[1] >= 0 && c.box[2] > 0 && c.box[3] > 0 &&
                            c.box[0] + c.box[2] <= a->width && c.box[1] + c.box[3] <= a->height));
    require(lom_count_differing_pixels(a, b, 0, &above, NULL) && above == c.pixels);
    require(lom_count_differing_pixels(a, b, tolerance, &above, NULL) && above <= c.pixels);
    require(lom_count_differing_pixels(a, b, 2 * tolerance, &more, NULL) && more <= above);
    double s, t, f, g;
    require(lom_compare_ssim(a, b, &s, NULL) && lom_compare_ssim(b, a, &t, NULL) && s == t && s >= -1.001 &&
            s <= 1.001);
    require(lom_compare_flip(a, b, &f, NULL) && lom_compare_flip(b, a, &g, NULL) && f == g && f >= 0 && f <= 1);
    require(!c.identical || (f < 1e-12 && s > 1 - 1e-9));
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_bytes in = { data, size };
    lom_image *a = take_image(&in), *b = take_bool(&in) ? take_image(&in) : NULL;
    if (b == NULL && a != NULL)
        b = lom_create_image(a->width, a->height, a->depth, (lom_format)(1 + take_choice(&in, LOM_FORMAT_COUNT - 1)),
                             NULL);
    if (a != NULL && b != NULL) {
        fill(&in, a);
        fuzz_bytes again = in;
        fill(take_bool(&in) ? &again : &in, b);
        double tolerance = take_choice(&in, 200);
        check_pair(a, b, tolerance);
        check_pair(a, a, tolerance);
    }
    lom_free_image(a);
    lom_free_image(b);
    return 0;
}
