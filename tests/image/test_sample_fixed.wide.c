/* Filtering in fixed point: every lane is, bit for bit, what a scalar definition in integers gives that wraps each texel
 * index by itself; the result lies between its texels, is the texel at its centre, and the same from a mirrored texture
 * at the mirrored place; it is within the bound of lom/texture.h of the float filter; what is not 8-bit, or nearest,
 * stays as it is in float. */
#include "check.h"

#include <math.h>

#include "image/convert.h"
#include "image/sample_fixed.h"

static lom_error error;

static const lom_format formats[] = { LOM_FORMAT_R8,        LOM_FORMAT_RG8,       LOM_FORMAT_RGB8,
                                      LOM_FORMAT_RGBA8,     LOM_FORMAT_R8_SRGB,   LOM_FORMAT_RG8_SRGB,
                                      LOM_FORMAT_RGB8_SRGB, LOM_FORMAT_RGBA8_SRGB };
enum { FORMATS = sizeof formats / sizeof *formats };

static uint8_t *random_pixels(const lom_texture_desc *desc, uint64_t key)
{
    int layers = desc->kind == LOM_TEXTURE_CUBE ? 6 : desc->kind == LOM_TEXTURE_3D ? desc->depth : 1;
    size_t count = (size_t)desc->width * (size_t)desc->height * (size_t)layers * lom_format_size(desc->format);
    uint8_t *pixels = malloc(count);
    for (size_t i = 0; i < count; i++)
        pixels[i] = (uint8_t)lom_random_bits(key, i);
    return pixels;
}

static lom_texture *make(lom_texture_desc desc, lom_filtering filtering, const uint8_t *pixels)
{
    desc.pixels = pixels;
    desc.sampler.filtering = filtering;
    lom_texture *texture = lom_create_texture(&desc, &error);
    CHECK(texture != NULL, "%s", error.text);
    return texture;
}

static lom_float4 sample(const lom_texture *texture, lom_float3 at, lom_float lod)
{
    return texture->kind == LOM_TEXTURE_3D     ? lom_sample_3d(texture, at.x, at.y, at.z, lod)
           : texture->kind == LOM_TEXTURE_CUBE ? lom_sample_cube(texture, at, lod)
                                               : lom_sample(texture, at.x, at.y, lod);
}

static float channel_of(const lom_float4 *x, int c, int i)
{
    return c == 0 ? x->x[i] : c == 1 ? x->y[i] : c == 2 ? x->z[i] : x->w[i];
}

/* ---- the definition, a sample at a time ---- */

/* Of the texels that a sample mixes. */
typedef struct range {
    int low[4], high[4];
} range;

static float wrapped(float s, lom_wrap wrap)
{
    if (!(fabsf(s) <= 3e38f) && (wrap == LOM_WRAP_REPEAT || wrap == LOM_WRAP_MIRROR))
        return 0;
    if (wrap == LOM_WRAP_REPEAT) {
        float c = s - floorf(s);
        return c < 1 ? c : 0;
    }
    if (wrap == LOM_WRAP_MIRROR) {
        float half = fabsf(s) * 0.5f, c = (half - floorf(half)) * 2;
        return c > 1 ? 2 - c : c;
    }
    if (s != s)
        return 0;
    return wrap == LOM_WRAP_CLAMP ? fminf(fmaxf(s, 0), 1) : s;
}

/* The number of the first texel, and the weight of the second in 1/32768. */
static int locate(float c, int n, bool border, bool nearest, int *weight)
{
    float x = c * (float)n + 0.5f;
    if (border)
        x = fminf(fmaxf(x, 0), (float)n + 1);
    if (nearest) {
        float texel = floorf(c * (float)n), low = border ? -1 : 0, high = (float)(border ? n : n - 1);
        x = fminf(fmaxf(texel, low), high) + 1;
    }
    int k = (int)x;
    double exact = ((double)x - k) * 32768;
    *weight = (int)nearbyint(exact);
    return k - 1;
}

/* Texel i of n; -1: the border. */
static int texel_index(int i, int n, lom_wrap wrap)
{
    if (i >= 0 && i < n)
        return i;
    return wrap == LOM_WRAP_BORDER ? -1 : wrap == LOM_WRAP_REPEAT ? (i + n) % n : i < 0 ? 0 : n - 1;
}

static uint32_t texel_of(const lom_texture *t, int level, int x, int y, int z)
{
    const lom_sampler_desc *s = &t->sampler;
    uint32_t texel, border = 0;
    if (t->kind != LOM_TEXTURE_CUBE) { /* a cube's apron holds what lies across its edges */
        x = texel_index(x, t->level[level].width, s->wrap_s);
        y = texel_index(y, t->level[level].height, s->wrap_t);
        z = t->kind == LOM_TEXTURE_3D ? texel_index(z, t->level[level].depth, s->wrap_r) : 0;
        for (int c = 0; c < 4; c++)
            border |= (s->border[c] > 0 ? 255u : 0) << 8 * c; /* the tests use 0 and 1 */
        if (x < 0 || y < 0 || z < 0)
            return border;
    }
    memcpy(&texel, lom_texel(t, level, x, y, z), sizeof texel);
    return texel;
}

static int number_of(const lom_texture *t, uint32_t texel, int c)
{
    uint32_t code = texel >> 8 * c & 255;
    if (!t->srgb || c == 3)
        return (int)(128 * code);
    return (int)floor((double)(lom_srgb_linear[code] * 32767.0f + 0.5f));
}

static int mix(int a, int b, int weight)
{
    return a + (int)floor(((double)(b - a) * weight + 16384) / 32768);
}

static void define_level(const lom_texture *t, int level, int face, const float c[3], bool nearest, range *r,
                         int out[4])
{
    const lom_sampler_desc *s = &t->sampler;
    bool flat = t->kind != LOM_TEXTURE_CUBE, deep = t->kind == LOM_TEXTURE_3D;
    int w[3] = { 0, 0, 0 }, k[3] = { 0, 0, face };
    k[0] = locate(c[0], t->level[level].width, flat && s->wrap_s == LOM_WRAP_BORDER, nearest, &w[0]);
    k[1] = locate(c[1], t->level[level].height, flat && s->wrap_t == LOM_WRAP_BORDER, nearest, &w[1]);
    if (deep)
        k[2] = locate(c[2], t->level[level].depth, s->wrap_r == LOM_WRAP_BORDER, nearest, &w[2]);
    for (int channel = 0; channel < 4; channel++) {
        int v[8];
        for (int i = 0; i < 8; i++) {
            /* a texel with weight 0 may lie beyond the apron */
            int x = k[0] + (w[0] != 0 && i & 1), y = k[1] + (w[1] != 0 && i >> 1 & 1), z = k[2] + (w[2] != 0 && i >> 2);
            v[i] = number_of(t, texel_of(t, level, x, y, z), channel);
            r->low[channel] = v[i] < r->low[channel] ? v[i] : r->low[channel];
            r->high[channel] = v[i] > r->high[channel] ? v[i] : r->high[channel];
        }
        int front = mix(mix(v[0], v[1], w[0]), mix(v[2], v[3], w[0]), w[1]);
        int back = mix(mix(v[4], v[5], w[0]), mix(v[6], v[7], w[0]), w[1]);
        out[channel] = mix(front, back, w[2]);
    }
}

/* OpenGL 4.6, table 8.19. */
static int face_of(const float d[3], float *s, float *t)
{
    static const int axes[6][4] = { { 2, -1, 1, -1 }, { 2, 1, 1, -1 }, { 0, 1, 2, 1 },
                                    { 0, 1, 2, -1 },  { 0, 1, 1, -1 }, { 0, -1, 1, -1 } };
    float x = fabsf(d[0]), y = fabsf(d[1]), z = fabsf(d[2]);
    int axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2, face = 2 * axis + (d[axis] < 0);
    float u = d[axes[face][0]] * (float)axes[face][1] / fabsf(d[axis]);
    float v = d[axes[face][2]] * (float)axes[face][3] / fabsf(d[axis]);
    *s = (fabsf(u) <= 1 ? u : 0) * 0.5f + 0.5f;
    *t = (fabsf(v) <= 1 ? v : 0) * 0.5f + 0.5f;
    return face;
}

static void define(const lom_texture *t, const float at[3], float lod, range *r, float out[4])
{
    const lom_sampler_desc *s = &t->sampler;
    float c[3] = { wrapped(at[0], s->wrap_s), wrapped(at[1], s->wrap_t), wrapped(at[2], s->wrap_r) };
    int face = t->kind == LOM_TEXTURE_CUBE ? face_of(at, &c[0], &c[1]) : 0;
    lod = fminf(fmaxf(lod + s->lod_bias, t->lod_min), t->lod_max); /* NaN is the least */
    lom_filter filter = lod > 0 ? s->minify : s->magnify;
    bool nearest = filter == LOM_FILTER_NEAREST || filter == LOM_FILTER_NEAREST_MIPMAP_NEAREST ||
                   filter == LOM_FILTER_NEAREST_MIPMAP_LINEAR;
    float level = 0, last = (float)(t->level_count - 1);
    if (filter == LOM_FILTER_NEAREST_MIPMAP_NEAREST || filter == LOM_FILTER_LINEAR_MIPMAP_NEAREST)
        level = fminf(ceilf(lod + 0.5f) - 1, last);
    if (filter == LOM_FILTER_NEAREST_MIPMAP_LINEAR || filter == LOM_FILTER_LINEAR_MIPMAP_LINEAR)
        level = fminf(lod, last);
    for (int i = 0; i < 4; i++)
        *r = (range){ { 32767, 32767, 32767, 32767 }, { 0, 0, 0, 0 } };
    int near[4], far[4], weight = (int)nearbyint((double)(level - floorf(level)) * 32768);
    define_level(t, (int)level, face, c, nearest, r, near);
    memcpy(far, near, sizeof far);
    if (weight != 0)
        define_level(t, (int)level + 1, face, c, nearest, r, far);
    for (int i = 0; i < 4; i++)
        out[i] = (float)mix(near[i], far[i], weight) / (t->srgb && i < 3 ? 32767.0f : 32640.0f);
}

/* ---- lanes against it ---- */

static float coordinate(uint64_t key, uint64_t i)
{
    static const float special[] = { 0,
                                     1,
                                     -1,
                                     0.5f,
                                     -0.0f,
                                     1e-8f,
                                     -1e-8f,
                                     0.99999994f,
                                     2,
                                     -3,
                                     1e6f,
                                     -1e30f,
                                     3e38f,
                                     __builtin_inff(),
                                     -__builtin_inff(),
                                     __builtin_nanf("") };
    uint64_t bits = lom_random_bits(key, 2 * i);
    if (bits % 8 == 0)
        return special[bits / 8 % (sizeof special / sizeof *special)];
    float x = (float)(lom_random_uniform(key, 2 * i + 1) * 5 - 2);
    return bits % 8 == 1 ? floorf(x * 16) / 16 : x;
}

/* Both ways in which texels are fetched in turn, whichever is this processor's. */
static void compare_with_definition(lom_texture *t, int packets, uint64_t key)
{
    const lom_sampler_desc *s = &t->sampler;
    for (int n = 0; n < packets * 16 / LOM_LANES; n++) {
        t->gathers = (n >> 2 & 1) == (key / 1000 & 1);
        lom_float3 at = { 0 };
        lom_float lod = { 0 };
        for (int i = 0; i < LOM_LANES; i++) {
            uint64_t counter = (uint64_t)(n * LOM_LANES + i) * 4;
            at.x[i] = coordinate(key, counter);
            at.y[i] = coordinate(key, counter + 1);
            at.z[i] = coordinate(key, counter + 2);
            lod[i] = (float)(lom_random_uniform(key + 1, counter) * (t->level_count + 2) - 1.5);
        }
        /* half the packets within a level, as near a large triangle, a sixteenth of them exactly at it; a quarter in one of
         * two neighbouring levels, as of small triangles; the others in any */
        if ((n & 1) != 0)
            lod = lom_splat(floorf(lod[0]) + (n % 16 == 1 ? 0 : 0.75f)) +
                  lom_select(at.x > 0.3f, lom_splat(0.125f), (lom_float){ 0 });
        else if (n % 4 == 0)
            lod = lom_splat(floorf(lod[0])) + lom_select(at.x > 0.3f, lom_splat(1), (lom_float){ 0 }) +
                  lom_select(at.y > 0.7f, lom_splat(0.625f), (lom_float){ 0 });
        if (n % 8 == 5)
            lod[key % LOM_LANES] = __builtin_nanf("");
        lom_float4 got = sample(t, at, lod);
        for (int i = 0; i < LOM_LANES; i++) {
            float want[4], place[3] = { at.x[i], at.y[i], at.z[i] };
            range r;
            define(t, place, lod[i], &r, want);
            for (int c = 0; c < 4; c++) {
                float g = channel_of(&got, c, i), scale = t->srgb && c < 3 ? 32767.0f : 32640.0f;
                CHECK(g == want[c],
                      "%s %dx%dx%d wrap %d %d %d filter %d %d at %.9g %.9g %.9g lod %g channel %d: %.9g, not %.9g",
                      lom_describe_format(t->format)->name, t->level[0].width, t->level[0].height, t->level[0].depth,
                      s->wrap_s, s->wrap_t, s->wrap_r, s->minify, s->magnify, (double)place[0], (double)place[1],
                      (double)place[2], (double)lod[i], c, (double)g, (double)want[c]);
                CHECK(g >= (float)r.low[c] / scale && g <= (float)r.high[c] / scale, "%.9g is not within %d..%d of %g",
                      (double)g, r.low[c], r.high[c], (double)scale);
            }
        }
    }
}

static void every_lane_is_the_definition(void)
{
    static const int sizes[][3] = { { 1, 1, 1 }, { 3, 5, 2 }, { 8, 4, 4 }, { 1, 7, 3 } };
    static const lom_filter filters[][2] = { { LOM_FILTER_LINEAR, LOM_FILTER_LINEAR },
                                             { LOM_FILTER_LINEAR_MIPMAP_LINEAR, LOM_FILTER_LINEAR },
                                             { LOM_FILTER_LINEAR_MIPMAP_NEAREST, LOM_FILTER_NEAREST },
                                             { LOM_FILTER_NEAREST_MIPMAP_LINEAR, LOM_FILTER_LINEAR } };
    uint64_t key = 100;
    for (int kind = LOM_TEXTURE_2D; kind <= LOM_TEXTURE_3D; kind++)
        for (int f = 0; f < FORMATS; f++)
            for (int n = 0; n < 4; n++)
                for (int wraps = 0; wraps < 16; wraps++) {
                    bool cube = kind == LOM_TEXTURE_CUBE;
                    lom_texture_desc desc = { .kind = (lom_texture_kind)kind,
                                              .width = sizes[n][0],
                                              .height = sizes[n][cube ? 0 : 1],
                                              .depth = kind == LOM_TEXTURE_3D ? sizes[n][2] : 1,
                                              .format = formats[f],
                                              .mips = LOM_MIPS_ALL,
                                              .sampler = { .minify = filters[(wraps + f) % 4][0],
                                                           .magnify = filters[(wraps + f) % 4][1],
                                                           .wrap_s = (lom_wrap)(wraps % 4),
                                                           .wrap_t = (lom_wrap)(wraps / 4),
                                                           .wrap_r = (lom_wrap)((wraps + f) % 4),
                                                           .border = { 1, 0, 1, 0 } } };
                    uint8_t *pixels = random_pixels(&desc, ++key);
                    lom_texture *t = make(desc, LOM_FILTERING_FIXED, pixels);
                    compare_with_definition(t, 2, 1000 * key);
                    lom_free_texture(t);
                    free(pixels);
                }
}

/* Levels that are moved and bounded, also where no lane takes any but the first. */
static void bias_and_bounds_are_the_definitions(void)
{
    static const float cases[][3] = { { 0.3f, 0, 0 },   { -5, 0, 0 },     { 1, 0.5f, 2 }, { 0, 1, 1 },
                                      { -5, 0.25f, 2 }, { 5, -1, -0.5f }, { 0, 0, 0.75f } };
    for (int f = 0; f < FORMATS; f++)
        for (size_t n = 0; n < sizeof cases / sizeof *cases; n++) {
            lom_texture_desc desc = { .width = 9,
                                      .height = 6,
                                      .format = formats[f],
                                      .mips = LOM_MIPS_ALL,
                                      .sampler = {
                                          .lod_bias = cases[n][0], .lod_min = cases[n][1], .lod_max = cases[n][2] } };
            uint8_t *pixels = random_pixels(&desc, 10 + n);
            lom_texture *t = make(desc, LOM_FILTERING_FIXED, pixels);
            compare_with_definition(t, 32, 1000 * n);
            lom_free_texture(t);
            free(pixels);
        }
}

/* What mixes come to is divided without a division. */
static void every_number_is_divided_correctly(void)
{
    for (int light = 0; light < 2; light++)
        for (int n = 0; n <= 32767; n += LOM_LANES) {
            lom_float x = lom_to_float(lom_lane_index() + n), quotient = x / (light != 0 ? 32767.0f : 32640.0f);
            lom_float share = sample_share(x, light != 0);
            CHECK(memcmp(&share, &quotient, sizeof share) == 0, "%d of %d", n, light != 0 ? 32767 : 32640);
        }
}

/* Large textures, where a float coordinate leaves few bits of weight. */
static void large_textures_too(void)
{
    static const int sizes[][2] = { { 257, 1023 }, { 16384, 1 }, { 1, 3000 } };
    for (int n = 0; n < 3; n++) {
        lom_texture_desc desc = {
            .width = sizes[n][0], .height = sizes[n][1], .format = formats[3 + 4 * (n & 1)], .mips = LOM_MIPS_ALL
        };
        uint8_t *pixels = random_pixels(&desc, 7);
        lom_texture *t = make(desc, LOM_FILTERING_FIXED, pixels);
        compare_with_definition(t, 64, 9);
        lom_free_texture(t);
        free(pixels);
    }
}

/* Places k / 64 and their mirror images are floats, and so are products with sizes up to 16. */
static void a_mirrored_texture_gives_the_same_at_the_mirrored_place(void)
{
    for (int f = 0; f < FORMATS; f++)
        for (int width = 1; width <= 16; width++) {
            lom_texture_desc desc = {
                .width = width, .height = 3, .format = formats[f], .sampler = { .wrap_s = LOM_WRAP_CLAMP }
            };
            size_t size = lom_format_size(desc.format);
            uint8_t *pixels = random_pixels(&desc, (uint64_t)width), *mirrored = malloc((size_t)width * 3 * size);
            for (int y = 0; y < 3; y++)
                for (int x = 0; x < width; x++)
                    memcpy(mirrored + (size_t)(y * width + x) * size,
                           pixels + (size_t)(y * width + width - 1 - x) * size, size);
            lom_texture *t = make(desc, LOM_FILTERING_FIXED, pixels), *m = make(desc, LOM_FILTERING_FIXED, mirrored);
            for (int i = 0; i <= 64; i += LOM_LANES) {
                lom_float x = lom_to_float(lom_lane_index() + i) * (1 / 64.0f), y = lom_splat(0.4f), zero = { 0 };
                lom_float4 a = lom_sample(t, x, y, zero), b = lom_sample(m, 1.0f - x, y, zero);
                CHECK(memcmp(&a, &b, sizeof a) == 0, "%s of %d texels at %d / 64",
                      lom_describe_format(desc.format)->name, width, i);
            }
            lom_free_texture(t);
            lom_free_texture(m);
            free(pixels);
            free(mirrored);
        }
}

/* n mixes: within n 2^-15 + 2^-20, where light is decoded 2^-16 more. At texel centres nothing is mixed. */
static void the_float_filter_is_within_the_bound(void)
{
    for (int kind = LOM_TEXTURE_2D; kind <= LOM_TEXTURE_3D; kind++)
        for (int f = 0; f < FORMATS; f++) {
            lom_texture_desc desc = { .kind = (lom_texture_kind)kind,
                                      .width = 16,
                                      .height = 16,
                                      .depth = kind == LOM_TEXTURE_3D ? 16 : 1,
                                      .format = formats[f],
                                      .mips = LOM_MIPS_ALL };
            uint8_t *pixels = random_pixels(&desc, (uint64_t)(50 + f));
            lom_texture *fixed = make(desc, LOM_FILTERING_FIXED, pixels),
                        *exact = make(desc, LOM_FILTERING_FLOAT, pixels);
            double worst = 0, most = (kind == LOM_TEXTURE_3D ? 4 : 3) * 0x1p-15 + (fixed->srgb ? 0x1p-16 : 0) + 0x1p-20;
            for (int n = 0; n < 4000 / LOM_LANES; n++) {
                lom_float3 at = { 0 };
                lom_float lod = { 0 };
                for (int i = 0; i < LOM_LANES; i++) {
                    uint64_t counter = (uint64_t)(n * LOM_LANES + i) * 4;
                    at = (lom_float3){ at.x, at.y, at.z };
                    at.x[i] = (float)(lom_random_uniform(3, counter) * 4 - 2);
                    at.y[i] = (float)(lom_random_uniform(3, counter + 1) * 4 - 2);
                    at.z[i] = (float)(lom_random_uniform(3, counter + 2) * 4 - 2);
                    lod[i] = (float)(lom_random_uniform(3, counter + 3) * 6 - 2);
                }
                lom_float4 a = sample(fixed, at, lod), b = sample(exact, at, lod);
                for (int i = 0; i < LOM_LANES; i++)
                    for (int c = 0; c < 4; c++)
                        worst = fmax(worst, fabs((double)channel_of(&a, c, i) - (double)channel_of(&b, c, i)));
            }
            CHECK(worst <= most, "kind %d %s: %g, not at most %g", kind, lom_describe_format(desc.format)->name, worst,
                  most);
            CHECK(worst > 0, "kind %d %s: nothing differs", kind, lom_describe_format(desc.format)->name);
            for (int y = 0; y < 16 && kind == LOM_TEXTURE_2D; y++)
                for (int x = 0; x < 16; x += LOM_LANES) {
                    lom_float s = (lom_to_float(lom_lane_index() + x) + 0.5f) * (1 / 16.0f),
                              t = lom_splat(((float)y + 0.5f) / 16), zero = { 0 };
                    lom_float4 a = lom_sample(fixed, s, t, zero), b = lom_sample(exact, s, t, zero);
                    for (int i = 0; i < LOM_LANES; i++)
                        for (int c = 0; c < 4; c++) {
                            double off = fabs((double)channel_of(&a, c, i) - (double)channel_of(&b, c, i));
                            CHECK(off <= (fixed->srgb && c < 3 ? 0x1p-16 + 0x1p-24 : 0), "texel %d, %d off by %g",
                                  x + i, y, off);
                        }
                }
            lom_free_texture(fixed);
            lom_free_texture(exact);
            free(pixels);
        }
}

static bool same_everywhere(const lom_texture *a, const lom_texture *b)
{
    for (int n = 0; n < 100; n++) {
        lom_float3 at = { 0 };
        lom_float lod = { 0 };
        for (int i = 0; i < LOM_LANES; i++) {
            at.x[i] = coordinate(4, (uint64_t)(n * LOM_LANES + i) * 2);
            at.y[i] = coordinate(4, (uint64_t)(n * LOM_LANES + i) * 2 + 1);
            lod[i] = (float)(lom_random_uniform(5, (uint64_t)(n * LOM_LANES + i)) * 5 - 1);
        }
        lom_float4 x = sample(a, at, lod), y = sample(b, at, lod);
        if (memcmp(&x, &y, sizeof x) != 0)
            return false;
    }
    return true;
}

/* A texture without pixels has no decoded copy; given them later it decodes as it goes. */
static void light_decoded_before_and_while_sampling_is_the_same(void)
{
    lom_texture_desc desc = { .width = 9, .height = 6, .format = LOM_FORMAT_RGBA8_SRGB, .mips = LOM_MIPS_ALL };
    uint8_t *pixels = random_pixels(&desc, 8);
    lom_texture *before = make(desc, LOM_FILTERING_FIXED, pixels), *later = make(desc, LOM_FILTERING_FIXED, NULL);
    CHECK(lom_store_texture(later, pixels, (size_t)9 * 6 * 4, &error), "%s", error.text);
    CHECK(before->decoded != NULL && later->decoded == NULL, "both are decoded in the same way");
    CHECK(same_everywhere(before, later), "they differ");
    lom_free_texture(before);
    lom_free_texture(later);
    free(pixels);
}

static void what_is_not_8_bit_or_nearest_stays(void)
{
    static const lom_format others[] = { LOM_FORMAT_R16, LOM_FORMAT_RGBA16, LOM_FORMAT_R32F, LOM_FORMAT_RGBA32F,
                                         LOM_FORMAT_RGBA8_SRGB };
    for (int f = 0; f < 5; f++) {
        lom_texture_desc desc = { .width = 9, .height = 6, .format = others[f], .mips = LOM_MIPS_ALL };
        if (f == 4)
            desc.sampler =
                (lom_sampler_desc){ .minify = LOM_FILTER_NEAREST_MIPMAP_NEAREST, .magnify = LOM_FILTER_NEAREST };
        uint8_t *pixels = random_pixels(&desc, 9);
        lom_texture *fixed = make(desc, LOM_FILTERING_FIXED, pixels), *exact = make(desc, LOM_FILTERING_FLOAT, pixels);
        CHECK(same_everywhere(fixed, exact), "%s", lom_describe_format(others[f])->name);
        lom_free_texture(fixed);
        lom_free_texture(exact);
        free(pixels);
    }
}

static void an_unknown_filtering_is_an_error(void)
{
    lom_texture_desc desc = { .width = 1, .height = 1, .sampler = { .filtering = LOM_FILTERING_COUNT } };
    lom_error failed = { 0 };
    CHECK(lom_create_texture(&desc, &failed) == NULL && failed.code == LOM_ERROR_USAGE, "%s", failed.text);
}

int main(int argc, char **argv)
{
    RUN(every_lane_is_the_definition);
    RUN(bias_and_bounds_are_the_definitions);
    RUN(every_number_is_divided_correctly);
    RUN(large_textures_too);
    RUN(a_mirrored_texture_gives_the_same_at_the_mirrored_place);
    RUN(the_float_filter_is_within_the_bound);
    RUN(light_decoded_before_and_while_sampling_is_the_same);
    RUN(what_is_not_8_bit_or_nearest_stays);
    RUN(an_unknown_filtering_is_an_error);
    return check_result();
}
