/* Proves that light becomes codes by lanes as it does one by one: floats of every bit pattern (strided), those where the
 * curves end, NaN, infinities, denormals and -0, with every curve, exposures and whites, in sRGB and as it is. */
#include "check.h"
#include "image/convert.h"
#include "render/tone.h"

enum { PIXELS = 16 };

static void check_pixels(const struct lom_tone *t, const uint32_t bits[4 * PIXELS])
{
    float light[4 * PIXELS];
    uint32_t texels[PIXELS];
    memcpy(light, bits, sizeof light);
    for (int srgb = 0; srgb < 2; srgb++) {
        LOM_WIDE(lom_encode_light)(t, srgb, light, PIXELS, texels);
        for (int i = 0; i < PIXELS; i++) {
            uint32_t expected = 0;
            for (int c = 0; c < 3; c++) {
                const float toned = lom_tone_of(t, light[4 * i + c]);
                expected |= (srgb ? lom_srgb8_of(toned) : lom_unorm_of((double)toned, 255)) << 8 * c;
            }
            CHECK(texels[i] == expected, "%08x %08x %08x, srgb %d: %06x, not %06x", bits[4 * i], bits[4 * i + 1],
                  bits[4 * i + 2], srgb, texels[i], expected);
        }
    }
}

/* `stride` apart, from a pattern of bits on. */
static void check_run(const struct lom_tone *t, uint32_t from, uint32_t stride)
{
    uint32_t bits[4 * PIXELS];
    for (uint32_t i = 0; i < 4 * PIXELS; i++)
        bits[i] = from + i * stride;
    check_pixels(t, bits);
}

static void check_tone(const struct lom_tone *t)
{
    static const uint32_t special[] = { 0x7f800000u, 0xff800000u, 0x7fc00000u, 0x7f800001u, 0xffc00000u, 0x80000000u };
    const uint32_t stride = 8191;
    uint32_t bits[4 * PIXELS];
    for (uint64_t from = 0; from <= UINT32_MAX; from += (uint64_t)stride * 4 * PIXELS)
        check_run(t, (uint32_t)from, stride);
    check_run(t, 0, 1);
    check_run(t, lom_bits_of_float(1) - 2 * PIXELS, 1);
    check_run(t, lom_bits_of_float((float)t->white / t->scale) - 2 * PIXELS, 1);
    for (size_t i = 0; i < 4 * PIXELS; i++)
        bits[i] = special[i % (sizeof special / sizeof *special)];
    check_pixels(t, bits);
}

static void codes_are_those_of_one_by_one(void)
{
    static const lom_curve curves[] = { LOM_CURVE_CLAMP, LOM_CURVE_REINHARD, LOM_CURVE_FILMIC, LOM_CURVE_ACES };
    static const double exposures[] = { -10, -0.2, 0, 1, 10 }, whites[] = { 1, 1.1, 8, 1e6 };
    for (size_t c = 0; c < sizeof curves / sizeof *curves; c++)
        for (size_t e = 0; e < sizeof exposures / sizeof *exposures; e++)
            for (size_t w = 0; w < sizeof whites / sizeof *whites; w++) {
                const lom_output output = { .curve = curves[c], .exposure = exposures[e], .white = whites[w] };
                const struct lom_tone tone = lom_make_tone(&output);
                check_tone(&tone);
            }
}

int main(int argc, char **argv)
{
    RUN(codes_are_those_of_one_by_one);
    return check_result();
}
