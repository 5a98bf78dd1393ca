/* The samplers at the extremes of coordinates and levels, by name; cubes by continuity over their edges; one table of
 * hashes that every width has to meet. */
#include "plain_texture.h"

/* ---- extremes, by name ---- */

/* 4 texels of values 10, 20, 30, 40 (of 255) along s. */
static lom_texture *ramp(lom_wrap wrap, lom_filter filter)
{
    static const uint8_t pixels[4] = { 10, 20, 30, 40 };
    return lom_create_texture(&(lom_texture_desc){ .width = 4,
                                                   .height = 1,
                                                   .format = LOM_FORMAT_R8,
                                                   .pixels = pixels,
                                                   .sampler = { .minify = filter, .magnify = filter, .wrap_s = wrap } },
                              &error);
}

static void expect_at(lom_wrap wrap, lom_filter filter, float s, float want)
{
    lom_texture *t = ramp(wrap, filter);
    lom_float4 got = lom_sample(t, lom_splat(s), lom_splat(0.5f), lom_splat(0));
    for (int i = 0; i < LOM_LANES; i++)
        CHECK(got.x[i] == want / 255.0f, "wrap %d filter %d s %.9g: %.9g, not %.9g of 255", wrap, filter, (double)s,
              (double)(got.x[i] * 255), (double)want);
    lom_free_texture(t);
}

static void s2_large_coordinates_wrap_exactly(void)
{
    expect_at(LOM_WRAP_REPEAT, LOM_FILTER_NEAREST, 1e8f, 10);
    expect_at(LOM_WRAP_REPEAT, LOM_FILTER_NEAREST, -1e8f, 10);
    expect_at(LOM_WRAP_REPEAT, LOM_FILTER_NEAREST, 4194304.5f, 30);
    expect_at(LOM_WRAP_REPEAT, LOM_FILTER_NEAREST, 8388609.0f, 10);
    expect_at(LOM_WRAP_REPEAT, LOM_FILTER_NEAREST, -0.0f, 10);
    expect_at(LOM_WRAP_REPEAT, LOM_FILTER_NEAREST, 0x1.fffffep-1f, 40);
    expect_at(LOM_WRAP_MIRROR, LOM_FILTER_NEAREST, 1e8f, 10);
    expect_at(LOM_WRAP_MIRROR, LOM_FILTER_NEAREST, 8388609.0f, 40);
    expect_at(LOM_WRAP_CLAMP, LOM_FILTER_NEAREST, 1e8f, 40);
    expect_at(LOM_WRAP_CLAMP, LOM_FILTER_LINEAR, -1e38f, 10);
    expect_at(LOM_WRAP_BORDER, LOM_FILTER_LINEAR, 1e38f, 0);
}

static void s3_just_below_zero_is_texel_zero(void)
{
    expect_at(LOM_WRAP_REPEAT, LOM_FILTER_NEAREST, -1e-10f, 10);
    expect_at(LOM_WRAP_REPEAT, LOM_FILTER_LINEAR, -1e-10f, 25); /* halfway between texels 3 and 0 */
    expect_at(LOM_WRAP_REPEAT, LOM_FILTER_NEAREST, -0x1p-24f, 40);
    expect_at(LOM_WRAP_MIRROR, LOM_FILTER_NEAREST, -1e-10f, 10);
}

static void s4_nan_and_infinity_are_defined(void)
{
    for (int filter = LOM_FILTER_NEAREST; filter <= LOM_FILTER_LINEAR; filter++) {
        expect_at(LOM_WRAP_REPEAT, filter, NAN, filter == LOM_FILTER_LINEAR ? 25 : 10);
        expect_at(LOM_WRAP_REPEAT, filter, INFINITY, filter == LOM_FILTER_LINEAR ? 25 : 10);
        expect_at(LOM_WRAP_REPEAT, filter, -INFINITY, filter == LOM_FILTER_LINEAR ? 25 : 10);
        expect_at(LOM_WRAP_MIRROR, filter, NAN, 10);
        expect_at(LOM_WRAP_MIRROR, filter, INFINITY, 10);
        expect_at(LOM_WRAP_CLAMP, filter, NAN, 10);
        expect_at(LOM_WRAP_CLAMP, filter, INFINITY, 40);
        expect_at(LOM_WRAP_CLAMP, filter, -INFINITY, 10);
        expect_at(LOM_WRAP_BORDER, filter, NAN, filter == LOM_FILTER_LINEAR ? 5 : 10);
        expect_at(LOM_WRAP_BORDER, filter, INFINITY, 0);
        expect_at(LOM_WRAP_BORDER, filter, -INFINITY, 0);
    }
}

static void s6_negative_texels(void)
{
    expect_at(LOM_WRAP_REPEAT, LOM_FILTER_NEAREST, -0.375f, 30);
    expect_at(LOM_WRAP_MIRROR, LOM_FILTER_NEAREST, -0.375f, 20);
    expect_at(LOM_WRAP_MIRROR, LOM_FILTER_NEAREST, 1.125f, 40);
    expect_at(LOM_WRAP_MIRROR, LOM_FILTER_LINEAR, 1.25f, 35);
    expect_at(LOM_WRAP_CLAMP, LOM_FILTER_LINEAR, -0.25f, 10);
    expect_at(LOM_WRAP_BORDER, LOM_FILTER_NEAREST, -0.125f, 0);
    expect_at(LOM_WRAP_BORDER, LOM_FILTER_LINEAR, 0, 5);
    expect_at(LOM_WRAP_BORDER, LOM_FILTER_LINEAR, 1, 20);
    expect_at(LOM_WRAP_BORDER, LOM_FILTER_LINEAR, 1.125f, 0);
}

static void s7_levels_of_detail_are_clamped(void)
{
    uint8_t pixels[64];
    for (int i = 0; i < 64; i++)
        pixels[i] = (uint8_t)(i * 4);
    const float inf = INFINITY;
    struct {
        float lod, bias, low, high;
        int level;
    } cases[] = { { -inf, 0, 0, 0, 0 },  { inf, 0, 0, 0, 3 },    { NAN, 0, 0, 0, 0 },      { 1, 1000, 0, 0, 3 },
                  { 1, -1000, 0, 0, 0 }, { inf, -inf, 0, 0, 3 }, { 1, 0, 2, 1, 1 },        { 0, 0, 2, 5, 2 },
                  { 9, 0, 0, 1, 1 },     { 1, 1, 0, 0, 2 },      { 3e38f, 3e38f, 0, 0, 3 } };
    for (int i = 0; i < (int)(sizeof cases / sizeof *cases); i++) {
        lom_texture *t =
            lom_create_texture(&(lom_texture_desc){ .width = 8,
                                                    .height = 8,
                                                    .format = LOM_FORMAT_R8,
                                                    .pixels = pixels,
                                                    .mips = LOM_MIPS_ALL,
                                                    .sampler = { .minify = LOM_FILTER_NEAREST_MIPMAP_LINEAR,
                                                                 .magnify = LOM_FILTER_NEAREST,
                                                                 .lod_bias = cases[i].bias,
                                                                 .lod_min = cases[i].low,
                                                                 .lod_max = cases[i].high } },
                               &error);
        lom_float4 got = lom_sample(t, lom_splat(0), lom_splat(0), lom_splat(cases[i].lod));
        lom_float4 want = lom_fetch(t, (lom_int){ 0 }, (lom_int){ 0 }, cases[i].level);
        for (int k = 0; k < LOM_LANES; k++)
            CHECK(got.x[k] == want.x[k], "lod case %d", i);
        lom_free_texture(t);
    }
    CHECK(lom_create_texture(&(lom_texture_desc){ .width = 1, .height = 1, .sampler = { .lod_bias = NAN } }, NULL) ==
              NULL,
          "a NaN bias is refused");
}

static void s7_lod_is_log2_of_the_footprint(void)
{
    lom_texture *t = lom_create_texture(&(lom_texture_desc){ .width = 256, .height = 64 }, &error);
    lom_float zero = { 0 };
    for (int n = 0; n < 4000; n++) {
        lom_float d[4];
        for (int k = 0; k < 4; k++)
            for (int i = 0; i < LOM_LANES; i++)
                d[k][i] = (float)(exp2(random_unit(5, (uint64_t)(n * LOM_LANES + i) * 8 + (uint64_t)k) * 40 - 25) *
                                  (random_unit(6, (uint64_t)(n * 4 + k)) - 0.5));
        lom_float lod = lom_lod_of(t, d[0], d[1], d[2], d[3]);
        for (int i = 0; i < LOM_LANES; i++) {
            double x = hypot(d[0][i] * 256.0, d[1][i] * 64.0), y = hypot(d[2][i] * 256.0, d[3][i] * 64.0);
            CHECK(fabs(lod[i] - log2(fmax(x, y))) < 0x1p-14, "%.9g, not %.9g", (double)lod[i], log2(fmax(x, y)));
        }
    }
    for (int k = -20; k < 20; k++) /* exact at powers of two, and the integer part right just beside them */
        for (int side = -1; side <= 1; side++) {
            float d = ldexpf(1, k - 8) * (1 + (float)side * 0x1p-20f);
            lom_float lod = lom_lod_of(t, lom_splat(d), zero, zero, zero);
            CHECK(side == 0 ? lod[0] == k : (int)floorf(lod[0]) == (side > 0 ? k : k - 1), "2^%d: %.9g", k,
                  (double)lod[0]);
        }
    CHECK(lom_lod_of(t, zero, zero, zero, zero)[0] == -63, "zero derivative");
    CHECK(lom_lod_of(t, lom_splat(NAN), zero, zero, zero)[0] == -63, "NaN");
    CHECK(lom_lod_of(t, lom_splat(INFINITY), zero, zero, zero)[0] == 64, "infinity");
    CHECK(lom_lod_of(t, lom_splat(NAN), zero, lom_splat(1.0f / 256), zero)[0] == 0, "NaN beside a number");
    lom_free_texture(t);
}

static void s9_exact_at_centres_and_within_the_range(void)
{
    for (int f = 0; f < 4; f++) {
        plain_texture p = make_plain((lom_texture_desc){ .width = 16, .height = 16, .format = plain_formats[f] });
        for (int n = 0; n < 256; n += LOM_LANES) {
            lom_int i = lom_splat_int(n) + lom_lane_index(), x = i & 15, y = i >> 4;
            lom_float4 got = lom_sample(p.texture, (lom_to_float(x) + 0.5f) / 16.0f, (lom_to_float(y) + 0.5f) / 16.0f,
                                        (lom_float){ 0 });
            lom_float4 want = lom_fetch(p.texture, x, y, 0);
            CHECK(memcmp(&got, &want, sizeof got) == 0, "texels from %d of format %d", n, f);
        }
        for (int n = 0; n < 100000; n += LOM_LANES) { /* weights next to 0 and 1 try to leave the range */
            lom_float s = { 0 }, t = { 0 };
            double low[LOM_LANES], high[LOM_LANES];
            for (int i = 0; i < LOM_LANES; i++) {
                uint64_t bits = lom_random_bits(9, (uint64_t)(n + i));
                int x = (int)(bits & 15), y = (int)(bits >> 4 & 15);
                float offset_x = (float)((bits >> 8 & 7) + 1) * 0x1p-20f,
                      offset_y = (float)((bits >> 11 & 7) + 1) * 0x1p-20f;
                s[i] = (float)(x + 0.5) / 16 + ((bits >> 14 & 1) != 0 ? offset_x : -offset_x) / 16;
                t[i] = (float)(y + 0.5) / 16 + ((bits >> 15 & 1) != 0 ? offset_y : -offset_y) / 16;
                low[i] = 1e9;
                high[i] = -1e9;
                for (int k = 0; k < 9; k++) {
                    const double *texel = p.texel[0][((y + 15 + k / 3) % 16) * 16 + (x + 15 + k % 3) % 16];
                    bool in = (k % 3 == 1 || (k % 3 == 2) == (s[i] * 16 > x + 0.5)) &&
                              (k / 3 == 1 || (k / 3 == 2) == (t[i] * 16 > y + 0.5));
                    low[i] = in && texel[0] < low[i] ? texel[0] : low[i];
                    high[i] = in && texel[0] > high[i] ? texel[0] : high[i];
                }
            }
            lom_float4 got = lom_sample(p.texture, s, t, (lom_float){ 0 });
            for (int i = 0; i < LOM_LANES; i++)
                CHECK(got.x[i] >= (float)low[i] && got.x[i] <= (float)high[i], "%.9g outside %.9g..%.9g",
                      (double)got.x[i], low[i], high[i]);
        }
        free_plain(&p);
    }
}

static void s10_a_constant_stays_constant(void)
{
    for (int kind = 0; kind < 3; kind++)
        for (int value = 1; value < 256; value += 23) {
            uint8_t pixels[6 * 5 * 5 * 4];
            memset(pixels, value, sizeof pixels);
            lom_texture *t =
                lom_create_texture(&(lom_texture_desc){ .kind = kind,
                                                        .width = 5,
                                                        .height = 5,
                                                        .depth = kind == LOM_TEXTURE_3D ? 6 : 0,
                                                        .format = value & 1 ? LOM_FORMAT_RGBA8_SRGB : LOM_FORMAT_RGBA8,
                                                        .pixels = pixels,
                                                        .mips = LOM_MIPS_ALL },
                                   &error);
            float light = value & 1 ? (float)decode_srgb(value / 255.0) : (float)(value / 255.0);
            for (int n = 0; n < 40; n++) {
                lom_float3 at = { 0 };
                lom_float lod = { 0 };
                for (int i = 0; i < LOM_LANES; i++) {
                    uint64_t k = (uint64_t)(n * LOM_LANES + i) * 4;
                    at.x[i] = (float)(random_unit(3, k) * 2 - 1);
                    at.y[i] = (float)(random_unit(3, k + 1) * 2 - 1);
                    at.z[i] = (float)(random_unit(3, k + 2) * 2 - 1);
                    lod[i] = (float)(random_unit(3, k + 3) * 4 - 1);
                }
                lom_float4 got = kind == LOM_TEXTURE_CUBE ? lom_sample_cube(t, at, lod)
                                 : kind == LOM_TEXTURE_3D ? lom_sample_3d(t, at.x, at.y, at.z, lod)
                                                          : lom_sample(t, at.x, at.y, lod);
                for (int i = 0; i < LOM_LANES; i++)
                    CHECK(got.x[i] == light && got.z[i] == light && got.w[i] == (float)(value / 255.0), "%d became %g",
                          value, (double)got.x[i] * 255);
            }
            lom_free_texture(t);
        }
}

static void s11_edges_of_the_picture(void)
{
    expect_at(LOM_WRAP_CLAMP, LOM_FILTER_LINEAR, 0.875f, 40); /* x = W - 0.5 */
    expect_at(LOM_WRAP_REPEAT, LOM_FILTER_LINEAR, 0.875f, 40);
    expect_at(LOM_WRAP_REPEAT, LOM_FILTER_LINEAR, 1.0f, 25);
    expect_at(LOM_WRAP_CLAMP, LOM_FILTER_NEAREST, 1.0f, 40);
}

/* A fetch is the nearest sample at a texel's centre, of every storage and level. */
static void fetches_are_nearest_samples(void)
{
    static const lom_format formats[] = { LOM_FORMAT_R8,      LOM_FORMAT_RGBA8, LOM_FORMAT_RGBA8_SRGB, LOM_FORMAT_R32F,
                                          LOM_FORMAT_RGBA32F, LOM_FORMAT_RGB16, LOM_FORMAT_DEPTH16 };
    static uint8_t pixels[5 * 4 * 16];
    for (size_t i = 0; i < sizeof pixels; i++) /* no exponent of all ones, so no NaN */
        pixels[i] = (uint8_t)(lom_random_bits(4, i) & 0x3f);
    for (size_t f = 0; f < sizeof formats / sizeof formats[0]; f++) {
        lom_texture *t = lom_create_texture(
            &(lom_texture_desc){ .width = 5,
                                 .height = 4,
                                 .format = formats[f],
                                 .pixels = pixels,
                                 .mips = LOM_MIPS_ALL,
                                 .sampler = { LOM_FILTER_NEAREST_MIPMAP_NEAREST, LOM_FILTER_NEAREST } },
            &error);
        CHECK(t != NULL && lom_texture_format(t) == formats[f] && lom_texture_depth(t) == 1, "format %zu: %s", f,
              error.text);
        for (int level = 0; t != NULL && level < 2; level++)
            for (int y = 0; y < 4 >> level; y++)
                for (int x = 0; x < 5 >> level; x++) {
                    float s = ((float)x + 0.5f) / (float)(5 >> level), r = ((float)y + 0.5f) / (float)(4 >> level);
                    lom_float4 a = lom_fetch(t, lom_splat_int(x), lom_splat_int(y), level);
                    lom_float4 b = lom_sample(t, lom_splat(s), lom_splat(r), lom_splat((float)level));
                    CHECK(memcmp(&a, &b, sizeof a) == 0, "format %zu, level %d, texel %d,%d: %g, not %g", f, level, x,
                          y, (double)a.x[0], (double)b.x[0]);
                }
        lom_free_texture(t);
    }
}

static void depth_and_fetch_read_one_channel(void)
{
    static const float pixels[4] = { 0.25f, 0.5f, 1, 0 };
    lom_texture *t = lom_create_texture(
        &(lom_texture_desc){ .width = 2, .height = 2, .format = LOM_FORMAT_DEPTH32F, .pixels = pixels }, &error);
    lom_float d = lom_sample_depth(t, lom_splat(0.5f), lom_splat(0.25f));
    CHECK(d[0] == 0.375f && d[LOM_LANES - 1] == 0.375f, "%g", (double)d[0]);
    lom_float4 f = lom_fetch(t, lom_splat_int(-5), lom_splat_int(99), 7);
    CHECK(f.x[0] == 1 && f.y[0] == 0 && f.w[0] == 1, "fetches are clamped");
    lom_free_texture(t);
}

/* Of a picture of depth with one level, clamped and unfiltered, the lookup of one channel has a way of its own. */
static void depth_is_what_the_general_sampler_gives(void)
{
    static const int sizes[][2] = { { 1, 1 }, { 7, 5 }, { 640, 3 }, { 33, 200 } };
    static const float extremes[] = { 0, -0.0f, 1, -1, 2, 1e30f, -1e30f, 0x1p-149f, 0x1.fffffep-1f, INFINITY, NAN };
    const int count = (int)(sizeof extremes / sizeof *extremes);
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        int width = sizes[i][0], height = sizes[i][1];
        float *pixels = malloc((size_t)width * (size_t)height * sizeof *pixels);
        for (int k = 0; k < width * height; k++)
            pixels[k] = k % 5 == 0 ? -0.0f : (float)k;
        lom_texture *t = lom_create_texture(&(lom_texture_desc){ .width = width,
                                                                 .height = height,
                                                                 .format = LOM_FORMAT_DEPTH32F,
                                                                 .pixels = pixels,
                                                                 .sampler = { .wrap_s = LOM_WRAP_CLAMP,
                                                                              .wrap_t = LOM_WRAP_CLAMP,
                                                                              .minify = LOM_FILTER_NEAREST,
                                                                              .magnify = LOM_FILTER_NEAREST } },
                                            &error);
        for (int k = 0; k < 4000; k++) {
            lom_float s, r;
            for (int lane = 0; lane < LOM_LANES; lane++) {
                uint64_t number = (uint64_t)(k * LOM_LANES + lane);
                s[lane] = (float)(1.4 * lom_random_uniform(31, number) - 0.2);
                r[lane] = k % 3 == 0 ? extremes[number % (uint64_t)count] : (float)lom_random_uniform(32, number);
                if (k % 7 == 0)
                    s[lane] = (float)(number % (uint64_t)(width + 1)) / (float)width; /* the edges of texels */
            }
            lom_float d = lom_sample_depth(t, s, r), want = lom_sample(t, s, r, lom_splat(-1000.0f)).x;
            CHECK(memcmp(&d, &want, sizeof d) == 0, "%dx%d at %g %g: %g, not %g", width, height, (double)s[0],
                  (double)r[0], (double)d[0], (double)want[0]);
        }
        lom_free_texture(t);
        free(pixels);
    }
}

/* The decoded copy of an sRGB texture is for speed alone. */
static void srgb_by_table_and_decoded_agree(void)
{
    for (int kind = 0; kind < 3; kind++) {
        plain_texture p = make_plain((lom_texture_desc){ .kind = kind,
                                                         .width = 9,
                                                         .height = 9,
                                                         .depth = kind == LOM_TEXTURE_3D ? 4 : 0,
                                                         .format = LOM_FORMAT_RGBA8_SRGB,
                                                         .mips = LOM_MIPS_ALL });
        CHECK(p.texture->decoded != NULL, "a texture made from pixels is decoded");
        float *decoded = p.texture->decoded;
        for (int n = 0; n < 100; n++) {
            lom_float3 at = { 0 };
            for (int i = 0; i < LOM_LANES; i++) {
                uint64_t k = (uint64_t)(n * LOM_LANES + i) * 3;
                at.x[i] = (float)(random_unit(41, k) * 3 - 1);
                at.y[i] = (float)(random_unit(41, k + 1) * 3 - 1);
                at.z[i] = (float)(random_unit(41, k + 2) * 3 - 1);
            }
            lom_float lod = at.x * at.y;
            lom_float4 value[2];
            for (int i = 0; i < 2; i++) {
                p.texture->decoded = i == 0 ? decoded : NULL;
                value[i] = kind == LOM_TEXTURE_CUBE ? lom_sample_cube(p.texture, at, lod) : sample_any(&p, at, lod);
            }
            CHECK(memcmp(&value[0], &value[1], sizeof value[0]) == 0, "kind %d", kind);
        }
        p.texture->decoded = decoded;
        free_plain(&p);
    }
}

/* ---- cubes ---- */

/* Texel (x, y) of face f holds f / 8, x / 16, y / 16: where a direction lands is read from the colour. */
static void s1_faces_lie_as_in_opengl(void)
{
    static const float directions[6][3][3] = {
        /* centre, towards +s, towards +t */
        { { 1, 0, 0 }, { 0, 0, -1 }, { 0, -1, 0 } }, { { -1, 0, 0 }, { 0, 0, 1 }, { 0, -1, 0 } },
        { { 0, 1, 0 }, { 1, 0, 0 }, { 0, 0, 1 } },   { { 0, -1, 0 }, { 1, 0, 0 }, { 0, 0, -1 } },
        { { 0, 0, 1 }, { 1, 0, 0 }, { 0, -1, 0 } },  { { 0, 0, -1 }, { -1, 0, 0 }, { 0, -1, 0 } },
    };
    float pixels[6][16][16][4];
    for (int f = 0; f < 6; f++)
        for (int y = 0; y < 16; y++)
            for (int x = 0; x < 16; x++)
                for (int c = 0; c < 4; c++)
                    pixels[f][y][x][c] = c == 0 ? (float)f / 8 : c == 1 ? (float)x / 16 : (float)y / 16;
    lom_texture *t = lom_create_texture(&(lom_texture_desc){ .kind = LOM_TEXTURE_CUBE,
                                                             .width = 16,
                                                             .height = 16,
                                                             .format = LOM_FORMAT_RGBA32F,
                                                             .pixels = pixels,
                                                             .sampler = { .magnify = LOM_FILTER_NEAREST } },
                                        &error);
    for (int f = 0; f < 6; f++)
        for (int k = 0; k < 256; k++) {
            float d[3], s = ((float)(k % 16) + 0.5f) / 8 - 1, v = ((float)(k / 16) + 0.5f) / 8 - 1;
            for (int a = 0; a < 3; a++)
                d[a] = 3 * (directions[f][0][a] + s * directions[f][1][a] + v * directions[f][2][a]);
            lom_float4 got = lom_sample_cube(t, lom_splat3(d[0], d[1], d[2]), lom_splat(0));
            CHECK(got.x[0] * 8 == f && got.y[0] * 16 == k % 16 && got.z[0] * 16 == k / 16, "face %d texel %d: %g %g %g",
                  f, k, (double)got.x[0] * 8, (double)got.y[0] * 16, (double)got.z[0] * 16);
        }
    const float special[][4] = { { 0, 0, 0, 0 },   { NAN, NAN, NAN, 5 },     { 1, 1, 1, 0 },     { -1, 1, 1, 1 },
                                 { 0, 1, 1, 2 },   { 0, -1, -1, 3 },         { -0.0f, 0, 0, 0 }, { INFINITY, 1, 1, 0 },
                                 { 1, 0, NAN, 5 }, { 1e-45f, 0, -1e-45f, 0 } };
    for (int i = 0; i < (int)(sizeof special / sizeof *special); i++) {
        lom_float4 got = lom_sample_cube(t, lom_splat3(special[i][0], special[i][1], special[i][2]), lom_splat(0));
        CHECK(got.x[0] == got.x[0] && (i == 1 || i == 8 || got.x[0] * 8 == special[i][3]), "direction %d on face %g", i,
              (double)got.x[0] * 8);
    }
    lom_free_texture(t);
}

/* Random texels: a wrong neighbour would jump. Walks across every edge and around every corner in steps so small that
 * no right filter changes by more than the step allows. */
static void s1_no_seam_at_edges_and_corners(void)
{
    for (int n = 1; n < 10; n += 4) {
        plain_texture p = make_plain(
            (lom_texture_desc){ .kind = LOM_TEXTURE_CUBE, .width = n, .height = n, .format = LOM_FORMAT_RGBA8 });
        for (int k = 0; k < 3000; k++) {
            double a[3], b[3];
            int axis = k % 3, other = (k / 3) % 3;
            for (int i = 0; i < 3; i++)
                a[i] = random_unit(21, (uint64_t)(k * 3 + i)) * 2 - 1;
            a[axis] = k & 8 ? 1 : -1;
            if (other != axis)
                a[other] = k & 16 ? 1 : -1; /* on an edge */
            if (k % 5 == 0 && other != axis)
                a[3 - axis - other] = k & 32 ? 1 : -1; /* at a corner */
            for (int i = 0; i < 3; i++)
                b[i] = a[i] + (random_unit(22, (uint64_t)(k * 3 + i)) - 0.5) * 1e-4;
            lom_float4 p0 = lom_sample_cube(p.texture, lom_splat3((float)a[0], (float)a[1], (float)a[2]), lom_splat(0));
            lom_float4 p1 = lom_sample_cube(p.texture, lom_splat3((float)b[0], (float)b[1], (float)b[2]), lom_splat(0));
            CHECK(fabs((double)p0.x[0] - (double)p1.x[0]) < 2e-4 * n + 0.5 / 255 * 0.5, "n %d at %g %g %g: %g and %g",
                  n, a[0], a[1], a[2], (double)p0.x[0], (double)p1.x[0]);
        }
        free_plain(&p);
    }
}

/* ---- one result for all widths ---- */

static uint64_t hash_floats(uint64_t hash, lom_float x)
{
    for (int i = 0; i < LOM_LANES; i++) {
        uint32_t bits;
        memcpy(&bits, (const char *)&x + 4 * i, sizeof bits);
        const uint8_t bytes[4] = { (uint8_t)bits, (uint8_t)(bits >> 8), (uint8_t)(bits >> 16), (uint8_t)(bits >> 24) };
        hash = lom_hash_bytes(hash, bytes, 4);
    }
    return hash;
}

/* Channels are hashed one after the other, so that the order of samples does not depend on the width. */
static uint64_t hash_samples(lom_texture_kind kind, lom_format format, lom_wrap wrap)
{
    plain_texture p = make_plain((lom_texture_desc){ .kind = kind,
                                                     .width = 13,
                                                     .height = kind == LOM_TEXTURE_CUBE ? 13 : 8,
                                                     .depth = kind == LOM_TEXTURE_3D ? 5 : 0,
                                                     .format = format,
                                                     .mips = LOM_MIPS_ALL,
                                                     .sampler = { .wrap_s = wrap, .wrap_t = wrap, .wrap_r = wrap } });
    uint64_t hash[4] = { LOM_HASH_START, LOM_HASH_START, LOM_HASH_START, LOM_HASH_START };
    for (int n = 0; n < 1024; n += LOM_LANES) {
        lom_float3 at = { 0 };
        lom_float d[4];
        for (int i = 0; i < LOM_LANES; i++) {
            uint64_t k = (uint64_t)(n + i) * 8;
            at.x[i] = (float)(random_unit(31, k) * 3 - 1);
            at.y[i] = (float)(random_unit(31, k + 1) * 3 - 1);
            at.z[i] = (float)(random_unit(31, k + 2) * 3 - 1);
            for (int c = 0; c < 4; c++)
                d[c][i] = (float)(random_unit(31, k + 3 + (uint64_t)c) * 0.5);
        }
        lom_float lod = lom_lod_of(p.texture, d[0], d[1], d[2], d[3]);
        lom_float4 x = kind == LOM_TEXTURE_CUBE ? lom_sample_cube(p.texture, at, lod) : sample_any(&p, at, lod);
        const lom_float channel[4] = { x.x, x.y, x.z, x.w };
        for (int c = 0; c < 4; c++)
            hash[c] = hash_floats(hash[c], channel[c]);
    }
    free_plain(&p);
    return hash[0] ^ hash[1] * 3 ^ hash[2] * 5 ^ hash[3] * 7;
}

static void the_same_bits_at_every_width(void)
{
    static const uint64_t recorded[3][4] = {
        /* by kind, then format */
        {
            UINT64_C(0xde80f72ac2e68451),
            UINT64_C(0xe861058282f1bb07),
            UINT64_C(0xab7d6e33d4daccc0),
            UINT64_C(0x82ecb4a13b4b904d),
        },
        {
            UINT64_C(0x3f769593dfbc9ba2),
            UINT64_C(0xc1d5dafa6fbbe606),
            UINT64_C(0x4eb884158a88e019),
            UINT64_C(0x7a5a43b118c7355c),
        },
        {
            UINT64_C(0xd5de0d785897a242),
            UINT64_C(0x6799c0297c659c60),
            UINT64_C(0x2d5c5720a0cc14b8),
            UINT64_C(0x63597938fbd3f505),
        },
    };
    for (int kind = 0; kind < 3; kind++)
        for (int f = 0; f < 4; f++) {
            uint64_t hash = hash_samples(kind, plain_formats[f], f);
            CHECK(hash == recorded[kind][f], "kind %d format %d: UINT64_C(0x%016llx)", kind, f,
                  (unsigned long long)hash);
        }
}

int main(int argc, char **argv)
{
    RUN(s1_faces_lie_as_in_opengl);
    RUN(s1_no_seam_at_edges_and_corners);
    RUN(s2_large_coordinates_wrap_exactly);
    RUN(s3_just_below_zero_is_texel_zero);
    RUN(s4_nan_and_infinity_are_defined);
    RUN(s6_negative_texels);
    RUN(s7_levels_of_detail_are_clamped);
    RUN(s7_lod_is_log2_of_the_footprint);
    RUN(s9_exact_at_centres_and_within_the_range);
    RUN(s10_a_constant_stays_constant);
    RUN(s11_edges_of_the_picture);
    RUN(srgb_by_table_and_decoded_agree);
    RUN(depth_and_fetch_read_one_channel);
    RUN(depth_is_what_the_general_sampler_gives);
    RUN(fetches_are_nearest_samples);
    RUN(the_same_bits_at_every_width);
    return check_result();
}
