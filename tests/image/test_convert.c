/* Conversions of single numbers and of pictures: correct rounding shown by exact integers (unorm), by the midpoints of
 * neighbours (half) and by thresholds computed again (sRGB). LOM_EXHAUSTIVE=1 visits every float. */
#include "check.h"

#include <lom/image.h>
#include <math.h>

#include "image/convert.h"
#include "image/convert_rows.h"

static uint32_t float_stride(void)
{
    return getenv("LOM_EXHAUSTIVE") != NULL ? 1 : 509;
}

/* round(x * largest) by integers alone: x = m 2^e. */
static uint32_t exact_unorm(float x, uint32_t largest)
{
    uint32_t bits = lom_bits_of_float(x);
    if (bits > 0x7f800000) /* negative or NaN (0x7f800000 is infinity) */
        return 0;
    if (bits >= 0x3f800000)
        return largest;
    int exponent = (int)(bits >> 23);
    uint64_t m = exponent != 0 ? (bits & 0x7fffff) | 0x800000 : bits & 0x7fffff;
    int shift = 150 - (exponent != 0 ? exponent : 1);
    return shift > 50 ? 0 : (uint32_t)((m * largest + (UINT64_C(1) << (shift - 1))) >> shift);
}

static const uint32_t largests[] = { 255, 65535, 16777215 };

static void unorm_is_rounded_for_every_float(void)
{
    uint32_t stride = float_stride();
    for (uint64_t bits = 0; bits <= UINT32_MAX; bits += stride) {
        float x = lom_float_of_bits((uint32_t)bits);
        for (int i = 0; i < 3; i++)
            CHECK(lom_unorm_of(x, largests[i]) == exact_unorm(x, largests[i]), "of bits %08x to %u", (unsigned)bits,
                  largests[i]);
    }
}

static void unorm_changes_at_its_thresholds(void)
{
    for (int i = 0; i < 3; i++)
        for (uint32_t k = 1; k <= largests[i]; k += i < 2 ? 1 : 997) {
            uint32_t near = lom_bits_of_float((float)((k - 0.5) / largests[i]));
            for (uint32_t bits = near - 3; bits <= near + 3; bits++) {
                float x = lom_float_of_bits(bits);
                CHECK(lom_unorm_of(x, largests[i]) == exact_unorm(x, largests[i]), "of bits %08x to %u", bits,
                      largests[i]);
            }
        }
}

static void unorm_of_special_values(void)
{
    CHECK(lom_unorm_of(NAN, 255) == 0 && lom_unorm_of(-NAN, 255) == 0, "NaN");
    CHECK(lom_unorm_of(INFINITY, 255) == 255 && lom_unorm_of(-INFINITY, 255) == 0, "infinity");
    CHECK(lom_unorm_of(-0.0, 255) == 0 && lom_unorm_of(0.5, 255) == 128 && lom_unorm_of(0.5, 65535) == 32768, "half");
    CHECK(lom_unorm_of(0x1.fffffep-1, 16777215) == 16777214, "just below 1: 2^24 - 1 - (1 - 2^-24) rounds down");
}

static void unorm24_comes_back_through_float(void)
{
    for (uint32_t v = 0; v < 1u << 24; v++) {
        float x = (float)(v / 16777215.0);
        CHECK(lom_unorm_of(x, 16777215) == v, "%u came back as %u", v, lom_unorm_of(x, 16777215));
    }
}

/* ---- sRGB ---- */

static double srgb_light(double v)
{
    return v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
}

/* The light where codes k - 1 and k meet, by the encoding function's own branch. */
static double srgb_threshold(int k)
{
    double v = (k - 0.5) / 255;
    return v / 12.92 <= 0.0031308 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
}

/* Bits of the first float not below x > 0. */
static uint32_t first_float(double x)
{
    uint32_t bits = lom_bits_of_float((float)x);
    return (double)lom_float_of_bits(bits) < x ? bits + 1 : bits;
}

static void srgb_tables_are_the_definition(void)
{
    for (int k = 0; k < 256; k++)
        CHECK(lom_srgb_linear[k] == (float)srgb_light(k / 255.0), "code %d", k);
    uint32_t threshold[257] = { 0 };
    for (int k = 1; k < 256; k++)
        threshold[k] = first_float(srgb_threshold(k));
    threshold[256] = UINT32_MAX;
    int code = 0;
    for (uint32_t i = 0; i < LOM_SRGB_BUCKETS; i++) {
        uint32_t start = (i << 16) + (114u << 23);
        while (threshold[code + 1] < start)
            code++;
        bool has = threshold[code + 1] - start <= 0xffff;
        uint32_t entry = ((uint32_t)code << 16) + (has ? 0x10000 - (threshold[code + 1] & 0xffff) : 0);
        CHECK(lom_srgb_codes[i] == entry, "bucket %u holds %x, not %x", i, lom_srgb_codes[i], entry);
        CHECK(!has || threshold[code + 2] - start > 0xffff, "bucket %u holds two thresholds", i);
    }
}

static void srgb_changes_at_its_thresholds(void)
{
    for (int k = 1; k < 256; k++) {
        uint32_t bits = first_float(srgb_threshold(k));
        CHECK(lom_srgb8_of(lom_float_of_bits(bits)) == k, "first float of code %d", k);
        CHECK(lom_srgb8_of(lom_float_of_bits(bits - 1)) == k - 1, "last float below code %d", k);
    }
    for (int k = 0; k < 256; k++)
        CHECK(lom_srgb8_of(lom_srgb_linear[k]) == k, "code %d does not come back", k);
    CHECK(lom_srgb8_of(NAN) == 0 && lom_srgb8_of(-NAN) == 0 && lom_srgb8_of(-0.0f) == 0, "NaN and -0");
    CHECK(lom_srgb8_of(INFINITY) == 255 && lom_srgb8_of(-INFINITY) == 0 && lom_srgb8_of(7) == 255, "infinity");
}

static void srgb_is_rounded_for_every_float(void)
{
    uint32_t stride = float_stride(), threshold[257] = { 0 };
    for (int k = 1; k < 256; k++)
        threshold[k] = first_float(srgb_threshold(k));
    threshold[256] = UINT32_MAX;
    int code = 0;
    for (uint64_t bits = 0; bits <= 0x7f800000; bits += stride) {
        while (threshold[code + 1] <= bits)
            code++;
        CHECK(lom_srgb8_of(lom_float_of_bits((uint32_t)bits)) == code, "of bits %08x", (unsigned)bits);
    }
}

/* ---- half ---- */

static void half_comes_back(void)
{
    for (uint32_t h = 0; h < 65536; h++) {
        uint16_t back = lom_half_of(lom_float_of_half((uint16_t)h));
        bool nan = (h & 0x7fff) > 0x7c00;
        CHECK(back == (nan ? 0x7e00 : h), "%04x came back as %04x", h, back);
    }
    CHECK(lom_float_of_half(0x3c00) == 1 && lom_float_of_half(1) == 0x1p-24f && lom_float_of_half(0x7bff) == 65504,
          "1, the least and the largest half");
}

static void half_rounds_at_midpoints_to_even(void)
{
    for (uint32_t h = 0; h < 0x7c00; h++) {
        double low = lom_float_of_half((uint16_t)h), high = h == 0x7bff ? 65536 : lom_float_of_half((uint16_t)(h + 1));
        double middle = (low + high) / 2;
        uint32_t even = h + (h & 1);
        CHECK(lom_half_of(middle) == even && lom_half_of(-middle) == (even | 0x8000), "middle of %04x", h);
        CHECK(lom_half_of(nextafter(middle, 0)) == h && lom_half_of(nextafterf((float)middle, 0)) == h, "below %04x",
              h);
        CHECK(lom_half_of(nextafter(middle, 1e9)) == h + 1 && lom_half_of(nextafterf((float)middle, 1e9f)) == h + 1,
              "above %04x", h);
    }
    for (double large = 65536; large < 1e300; large *= 1e7)
        CHECK(lom_half_of(large) == 0x7c00 && lom_half_of(-large) == 0xfc00, "%g is not infinite", large);
    CHECK(lom_half_of(INFINITY) == 0x7c00 && lom_half_of(-INFINITY) == 0xfc00, "infinity");
}

/* ---- pictures ---- */

/* A sample as a long double, and a value as a sample, by the definitions alone. */
static long double naive_decode(const lom_format_info *info, int c, const uint8_t *at)
{
    uint16_t half;
    uint32_t word;
    float single;
    memcpy(&half, at, info->bits >= 16 ? 2 : 0);
    memcpy(&word, at, info->bits == 32 ? 4 : 0);
    memcpy(&single, at, info->bits == 32 ? 4 : 0);
    if (info->bits == 8)
        return info->is_srgb && c < 3 ? (long double)(float)srgb_light(*at / 255.0) : *at / 255.0L;
    if (info->bits == 16)
        return info->is_float ? (long double)lom_float_of_half(half) : half / 65535.0L;
    return info->is_float ? (long double)single : word / 16777215.0L;
}

static void pictures_convert_between_all_formats(void)
{
    for (int from = 1; from < LOM_FORMAT_COUNT; from++)
        for (int to = 1; to < LOM_FORMAT_COUNT; to++) {
            const lom_format_info *a = lom_describe_format(from), *b = lom_describe_format(to);
            lom_error error = { 0 };
            lom_image *image = lom_create_image(61, 3, 1, from, &error);
            double rgba[61][4];
            for (int y = 0; y < 3; y++) {
                for (int x = 0; x < 61; x++)
                    for (int c = 0; c < 4; c++)
                        rgba[x][c] = lom_random_uniform(7, (uint64_t)((y * 61 + x) * 4 + c));
                lom_encode_row(from, (const double(*)[4])rgba, 61, lom_image_pixel(image, 0, y, 0));
            }
            lom_image *out = lom_convert_image(image, to, &error);
            CHECK(out != NULL && out->format == (lom_format)to && out->width == 61, "%s", error.text);
            bool luminance = a->channels >= 3 && b->channels == 1;
            for (int i = 0; i < 61 * 3 && !luminance && out != NULL; i++)
                for (int c = 0; c < b->channels; c++) {
                    int source = a->channels == 1 && b->channels >= 3 && c < 3 ? 0 : c;
                    size_t step = lom_format_size(from), step_out = lom_format_size(to);
                    long double x =
                        source >= a->channels
                            ? (long double)(c == 3)
                            : naive_decode(a, source,
                                           image->pixels + (size_t)i * step + (size_t)(source * a->bits / 8));
                    long double y = naive_decode(b, c, out->pixels + (size_t)i * step_out + (size_t)(c * b->bits / 8));
                    double unit = b->is_float ? (b->bits == 16 ? 0x1p-11 : 0x1p-24)
                                              : 0.5 / (b->bits == 32   ? 16777215
                                                       : b->bits == 16 ? 65535
                                                                       : 255);
                    if (b->is_srgb && c < 3)
                        unit = 0.005; /* thresholds have their own tests */
                    CHECK(fabsl(x - y) <= unit * (1 + 1e-9), "%s to %s: pixel %d channel %d: %.9Lg gives %.9Lg",
                          a->name, b->name, i, c, x, y);
                }
            lom_free_image(out);
            lom_free_image(image);
        }
}

static void pictures_match_channels(void)
{
    lom_error error = { 0 };
    lom_image *gray = lom_create_image(1, 1, 1, LOM_FORMAT_R8, &error);
    gray->pixels[0] = 77;
    lom_image *rgba = lom_convert_image(gray, LOM_FORMAT_RGBA8, &error);
    CHECK(memcmp(rgba->pixels, "\115\115\115\377", 4) == 0, "gray is replicated, alpha is 1");
    lom_image *back = lom_convert_image(rgba, LOM_FORMAT_R8, &error);
    CHECK(back->pixels[0] == 77, "the luminance of gray is gray: %d", back->pixels[0]);
    lom_image *rg = lom_convert_image(gray, LOM_FORMAT_RG8, &error);
    CHECK(rg->pixels[0] == 77 && rg->pixels[1] == 0, "a missing channel is 0");
    CHECK(lom_convert_image(gray, LOM_FORMAT_NONE, &error) == NULL && error.code == LOM_ERROR_USAGE, "no format");
    lom_free_image(gray);
    lom_free_image(rgba);
    lom_free_image(back);
    lom_free_image(rg);
}

static void depth_never_holds_nan(void)
{
    const double rgba[4][4] = { { NAN }, { -0.0 }, { 3 }, { -1 } };
    float out[4];
    lom_encode_row(LOM_FORMAT_DEPTH32F, rgba, 4, out);
    CHECK(lom_bits_of_float(out[0]) == 0 && lom_bits_of_float(out[1]) == 0 && out[2] == 1 && out[3] == 0, "depth");
    lom_encode_row(LOM_FORMAT_R32F, rgba, 4, out);
    CHECK(lom_bits_of_float(out[0]) == 0x7fc00000, "one quiet NaN");
}

int main(int argc, char **argv)
{
    RUN(unorm_is_rounded_for_every_float);
    RUN(unorm_changes_at_its_thresholds);
    RUN(unorm_of_special_values);
    RUN(unorm24_comes_back_through_float);
    RUN(srgb_tables_are_the_definition);
    RUN(srgb_changes_at_its_thresholds);
    RUN(srgb_is_rounded_for_every_float);
    RUN(half_comes_back);
    RUN(half_rounds_at_midpoints_to_even);
    RUN(pictures_convert_between_all_formats);
    RUN(pictures_match_channels);
    RUN(depth_never_holds_nan);
    return check_result();
}
