/* The parts of the self-test that draw nothing: numbers as text, random numbers, mathematics in double, pictures in
 * files. In: formulas. Out: a hash a part; a NaN counts as one value, whatever its bits. */
#include "measure/selftest.h"

#include <string.h>

uint64_t lom_selftest_add(uint64_t hash, uint64_t value)
{
    uint8_t bytes[8];
    for (int i = 0; i < 8; i++)
        bytes[i] = (uint8_t)(value >> (8 * i));
    return lom_hash_bytes(hash, bytes, sizeof bytes);
}

static uint64_t add_double(uint64_t hash, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return lom_selftest_add(hash, value != value ? UINT64_MAX : bits);
}

/* Of any bits: both signs, every exponent; NaN and infinities among them. */
static double any_double(uint64_t counter)
{
    uint64_t bits = lom_random_bits(1, counter);
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

bool lom_selftest_numbers(uint64_t *hash, lom_error *error)
{
    (void)error;
    for (uint64_t i = 0; i < 400; i++) {
        char text[32];
        double read = 0;
        float narrow = 0;
        size_t length = lom_print_double(text, any_double(i));
        *hash = lom_hash_bytes(*hash, text, length);
        lom_parse_double(text, length > 3 ? length - 2 : length, &read);
        lom_parse_float(text, length, &narrow);
        *hash = add_double(*hash, read);
        length = lom_print_float(text, narrow);
        *hash = lom_hash_bytes(*hash, text, length);
    }
    return true;
}

bool lom_selftest_random(uint64_t *hash, lom_error *error)
{
    (void)error;
    for (uint64_t i = 0; i < 200; i++) {
        double normal[2];
        lom_random_normal(i % 7, i, normal);
        *hash = lom_selftest_add(*hash, lom_random_bits(i, ~i));
        *hash = add_double(*hash, lom_random_uniform(3, i));
        *hash = add_double(*hash, normal[0]);
        *hash = add_double(*hash, normal[1]);
    }
    return true;
}

bool lom_selftest_mathematics(uint64_t *hash, lom_error *error)
{
    static double (*const functions[])(double) = {
        lom_double_sqrt,  lom_double_floor, lom_double_sin,  lom_double_cos,   lom_double_tan,
        lom_double_asin,  lom_double_acos,  lom_double_atan, lom_double_exp,   lom_double_exp2,
        lom_double_expm1, lom_double_log,   lom_double_log2, lom_double_log1p, lom_double_sinh,
        lom_double_cosh,  lom_double_tanh,  lom_double_erf,  lom_double_cbrt,
    };
    (void)error;
    for (size_t f = 0; f < sizeof functions / sizeof functions[0]; f++) {
        for (uint64_t i = 0; i < 60; i++) {
            double x = 4 * (lom_random_uniform(f, i) - 0.5);
            *hash = add_double(*hash, functions[f](x));
            *hash = add_double(*hash, functions[f](x * 100));
            *hash = add_double(*hash, functions[f](any_double(i)));
        }
    }
    for (uint64_t i = 0; i < 200; i++) {
        double x = 8 * lom_random_uniform(98, i), y = 16 * (lom_random_uniform(99, i) - 0.5);
        *hash = add_double(*hash, lom_double_pow(x, y));
        *hash = add_double(*hash, lom_double_atan2(x - 4, y));
        *hash = add_double(*hash, lom_double_pow(any_double(i), any_double(i + 200)));
    }
    return true;
}

/* A float picture with steep and smooth parts, a little outside 0..1. */
static lom_image *make_picture(int width, int height, lom_error *error)
{
    lom_image *image = lom_create_image(width, height, 1, LOM_FORMAT_RGBA32F, error);
    for (int i = 0; image != NULL && i < width * height; i++) {
        float *pixel = lom_image_pixel(image, i % width, i / width, 0);
        double x = (double)(i % width) / width, y = (double)(i / width) / height;
        pixel[0] = (float)(1.2 * x - 0.1);
        pixel[1] = (float)(0.5 + 0.5 * lom_double_sin(40 * x * y));
        pixel[2] = (float)lom_random_uniform(5, (uint64_t)i / 9);
        pixel[3] = (float)(y * y);
    }
    return image;
}

/* Through a format and a PNG file and back. */
static bool add_file(uint64_t *hash, const lom_image *picture, lom_format format, const char *kind, lom_error *error)
{
    lom_image *image = lom_convert_image(picture, format, error);
    lom_bytes file = image != NULL ? lom_encode_image(kind, image, error) : (lom_bytes){ NULL, 0 };
    lom_image *read = file.data != NULL ? lom_decode_image(file.data, file.size, "selftest", error) : NULL;
    if (read != NULL) {
        *hash = lom_hash_bytes(*hash, file.data, file.size);
        *hash = lom_selftest_add(*hash, lom_hash_image(read));
    }
    bool done = read != NULL;
    lom_free_image(read);
    lom_release(file.data);
    lom_free_image(image);
    return done;
}

bool lom_selftest_pictures(uint64_t *hash, lom_error *error)
{
    lom_image *picture = make_picture(61, 37, error);
    bool done = picture != NULL;
    for (int format = LOM_FORMAT_R8; done && format < LOM_FORMAT_COUNT; format++) {
        lom_image *converted = lom_convert_image(picture, (lom_format)format, error);
        lom_image *back = converted != NULL ? lom_convert_image(converted, LOM_FORMAT_RGBA32F, error) : NULL;
        done = back != NULL;
        if (done) {
            *hash = lom_selftest_add(*hash, lom_hash_image(converted));
            *hash = lom_selftest_add(*hash, lom_hash_image(back));
        }
        lom_free_image(back);
        lom_free_image(converted);
    }
    done = done && add_file(hash, picture, LOM_FORMAT_RGBA8_SRGB, "png", error) &&
           add_file(hash, picture, LOM_FORMAT_RGB16, "png", error) &&
           add_file(hash, picture, LOM_FORMAT_R8, "png", error) &&
           add_file(hash, picture, LOM_FORMAT_RGB32F, "pfm", error);
    lom_free_image(picture);
    return done;
}
