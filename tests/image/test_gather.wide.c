/* Gather and depth comparison. Oracles: lom_fetch at texels that plain integers wrap; the shares of a linear filter in
 * double, and lom_sample of a texture that holds the outcomes themselves. Proves: the four texels are those that a linear
 * filter mixes, in the order of OpenGL; a comparison is filtered as its outcomes would be, for every function, format of
 * depth, wrap mode and filter; NaN, infinities and the shared edge of two texels are defined. */
#include "check.h"

#include <math.h>

#include "image/texture.h"

static lom_error error;

enum { WIDTH = 6, HEIGHT = 4 };

static float place(uint64_t key, uint64_t i)
{
    static const float odd[] = {
        0, 1, -1e-10f, 0.5f, 1e8f, NAN, INFINITY, -INFINITY, 5.5f / WIDTH, 3.5f / HEIGHT, -0.0f
    };
    return lom_random_bits(key, 2 * i) % 4 == 0 ? odd[lom_random_bits(key, 2 * i + 1) % 11]
                                                : (float)(lom_random_uniform(key, 2 * i + 1) * 4 - 1.5);
}

/* c as lom/texture.h defines it. */
static float wrapped(float s, lom_wrap wrap)
{
    bool finite = fabsf(s) <= 3e38f;
    if (wrap == LOM_WRAP_REPEAT)
        return finite && s - floorf(s) < 1 ? s - floorf(s) : 0;
    if (wrap == LOM_WRAP_MIRROR) {
        float half = finite ? fabsf(s) * 0.5f : 0, c = (half - floorf(half)) * 2;
        return c > 1 ? 2 - c : c;
    }
    return s != s ? 0 : wrap == LOM_WRAP_CLAMP ? fminf(fmaxf(s, 0), 1) : s;
}

/* Texel k - 1 or k of n, wrapped; -1: the border. */
static int index_of(int i, int n, lom_wrap wrap)
{
    if (wrap == LOM_WRAP_BORDER)
        return i < 0 || i >= n ? -1 : i;
    if (wrap == LOM_WRAP_REPEAT)
        return (i + n) % n;
    return i < 0 ? 0 : i >= n ? n - 1 : i;
}

static int locate(float s, int n, lom_wrap wrap, double *weight)
{
    float x = wrapped(s, wrap) * (float)n + 0.5f;
    x = wrap == LOM_WRAP_BORDER ? fminf(fmaxf(x, -1), (float)n + 1) : x;
    int k = (int)floorf(x);
    *weight = fmin((double)x - k, 1 - 0x1p-23);
    return k;
}

static lom_texture *make(lom_format format, const void *pixels, lom_wrap s, lom_wrap t, lom_filter magnify)
{
    lom_texture *texture = lom_create_texture(
        &(lom_texture_desc){ .width = WIDTH,
                             .height = HEIGHT,
                             .format = format,
                             .pixels = pixels,
                             .sampler = { .wrap_s = s, .wrap_t = t, .magnify = magnify, .border = { 1, 0, 1, 0 } } },
        &error);
    CHECK(texture != NULL, "%s", error.text);
    return texture;
}

static void *random_pixels(lom_format format)
{
    const lom_format_info *info = lom_describe_format(format);
    static uint8_t pixels[WIDTH * HEIGHT * 16];
    for (size_t i = 0; i < (size_t)(WIDTH * HEIGHT * info->channels); i++) {
        float x = (float)(lom_random_bits(3, i) % 5) / 4; /* equal ones among them */
        uint32_t word = (uint32_t)(x * (float)0xffffff);
        uint16_t half = (uint16_t)(x * 65535);
        if (format == LOM_FORMAT_DEPTH24)
            memcpy(pixels + 4 * i, &word, 4);
        else if (info->bits == 32)
            memcpy(pixels + 4 * i, &x, 4);
        else if (info->bits == 16)
            memcpy(pixels + 2 * i, &half, 2);
        else
            pixels[i] = (uint8_t)(x * 255);
    }
    return pixels;
}

/* Channel `channel` of texel (x, y), -1 in either: the border. */
static float texel(const lom_texture *texture, int x, int y, int channel)
{
    static const float border[4] = { 1, 0, 1, 0 };
    bool single = texture->storage == LOM_STORAGE_R32F;
    if (x < 0 || y < 0)
        return single && channel > 0 ? (channel == 3 ? 1 : 0) : border[channel];
    lom_float4 value = lom_fetch(texture, lom_splat_int(x), lom_splat_int(y), 0);
    return channel == 0 ? value.x[0] : channel == 1 ? value.y[0] : channel == 2 ? value.z[0] : value.w[0];
}

static const lom_format formats[] = { LOM_FORMAT_R32F,    LOM_FORMAT_DEPTH32F, LOM_FORMAT_DEPTH24,   LOM_FORMAT_DEPTH16,
                                      LOM_FORMAT_RGBA32F, LOM_FORMAT_RGBA8,    LOM_FORMAT_RGBA8_SRGB };
enum { FORMATS = sizeof formats / sizeof *formats };

static void four_texels_in_order(void)
{
    for (int f = 0; f < FORMATS; f++)
        for (int mode = 0; mode < 16; mode++) {
            lom_wrap ws = (lom_wrap)(mode % 4), wt = (lom_wrap)(mode / 4);
            lom_texture *texture = make(formats[f], random_pixels(formats[f]), ws, wt, LOM_FILTER_LINEAR);
            for (uint64_t i = 0; i < 24; i++) {
                lom_float s, t;
                int channel = (int)(i % 4);
                for (int lane = 0; lane < LOM_LANES; lane++) {
                    s[lane] = place(5, 2 * (i * LOM_LANES + (uint64_t)lane));
                    t[lane] = place(5, 2 * (i * LOM_LANES + (uint64_t)lane) + 1);
                }
                lom_float4 four = lom_sample_gather(texture, s, t, channel);
                for (int lane = 0; lane < LOM_LANES; lane++) {
                    double weight;
                    int x = locate(s[lane], WIDTH, ws, &weight), y = locate(t[lane], HEIGHT, wt, &weight);
                    int left = index_of(x - 1, WIDTH, ws), right = index_of(x, WIDTH, ws);
                    int above = index_of(y - 1, HEIGHT, wt), below = index_of(y, HEIGHT, wt);
                    const float want[4] = { texel(texture, left, below, channel), texel(texture, right, below, channel),
                                            texel(texture, right, above, channel),
                                            texel(texture, left, above, channel) };
                    const float got[4] = { four.x[lane], four.y[lane], four.z[lane], four.w[lane] };
                    for (int k = 0; k < 4; k++)
                        CHECK(got[k] == want[k], "%s, wrap %d: (%g, %g) channel %d: texel %d is %g, not %g",
                              lom_describe_format(formats[f])->name, mode, (double)s[lane], (double)t[lane], channel, k,
                              (double)got[k], (double)want[k]);
                }
            }
            lom_free_texture(texture);
        }
}

static bool holds(lom_compare compare, float a, float b)
{
    switch (compare) {
    case LOM_COMPARE_NEVER:
        return false;
    case LOM_COMPARE_LESS:
        return a < b;
    case LOM_COMPARE_EQUAL:
        return a == b;
    case LOM_COMPARE_LESS_EQUAL:
        return a <= b;
    case LOM_COMPARE_NOT_EQUAL:
        return a != b;
    case LOM_COMPARE_GREATER_EQUAL:
        return a >= b;
    case LOM_COMPARE_ALWAYS:
        return true;
    default:
        return a > b;
    }
}

/* The outcomes as a texture of their own, sampled: the same bits. The border's outcome has no place in it: that mode is
 * in double. */
static void outcomes_are_filtered(void)
{
    static const float references[] = { 0, 0.25f, 0.5f, 1, 0.3f, NAN, INFINITY, -1 };
    int between = 0;
    for (int f = 0; f < FORMATS; f++)
        for (int compare = 0; compare <= LOM_COMPARE_ALWAYS; compare++)
            for (int mode = 0; mode < 8; mode++) {
                lom_wrap wrap = (lom_wrap)(mode % 4);
                lom_filter filter = mode < 4 ? LOM_FILTER_LINEAR : LOM_FILTER_NEAREST;
                lom_texture *texture = make(formats[f], random_pixels(formats[f]), wrap, wrap, filter);
                float reference = references[(compare + mode + 3 * f) % 8], outcome[WIDTH * HEIGHT];
                for (int i = 0; i < WIDTH * HEIGHT; i++)
                    outcome[i] = holds((lom_compare)compare, reference, texel(texture, i % WIDTH, i / WIDTH, 0));
                lom_texture *outcomes = make(LOM_FORMAT_R32F, outcome, wrap, wrap, filter);
                for (uint64_t i = 0; i < 8; i++) {
                    lom_float s, t;
                    for (int lane = 0; lane < LOM_LANES; lane++) {
                        s[lane] = place(6, 2 * (i * LOM_LANES + (uint64_t)lane));
                        t[lane] = place(6, 2 * (i * LOM_LANES + (uint64_t)lane) + 1);
                    }
                    lom_float share = lom_sample_compare(texture, s, t, lom_splat(reference), (lom_compare)compare);
                    lom_float want = lom_sample_depth(outcomes, s, t);
                    for (int lane = 0; lane < LOM_LANES; lane++) {
                        double u, v, square[4];
                        int x = locate(s[lane], WIDTH, wrap, &u), y = locate(t[lane], HEIGHT, wrap, &v);
                        for (int k = 0; k < 4; k++)
                            square[k] = holds((lom_compare)compare, reference,
                                              texel(texture, index_of(x - 1 + k % 2, WIDTH, wrap),
                                                    index_of(y - 1 + k / 2, HEIGHT, wrap), 0));
                        double mixed =
                            (square[0] * (1 - u) + square[1] * u) * (1 - v) + (square[2] * (1 - u) + square[3] * u) * v;
                        CHECK(filter == LOM_FILTER_NEAREST || fabs((double)share[lane] - mixed) < 1e-6,
                              "%s compare %d wrap %d: (%g, %g) %g not %g", lom_describe_format(formats[f])->name,
                              compare, (int)wrap, (double)s[lane], (double)t[lane], (double)share[lane], mixed);
                        CHECK(wrap == LOM_WRAP_BORDER || share[lane] == want[lane],
                              "%s compare %d wrap %d filter %d: %g", lom_describe_format(formats[f])->name, compare,
                              (int)wrap, (int)filter, (double)share[lane]);
                        between += share[lane] > 0 && share[lane] < 1;
                    }
                }
                lom_free_texture(texture);
                lom_free_texture(outcomes);
            }
    CHECK(between > 500, "%d shares were partial", between);
}

int main(int argc, char **argv)
{
    RUN(four_texels_in_order);
    RUN(outcomes_are_filtered);
    return check_result();
}
