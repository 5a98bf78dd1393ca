/* Explicit gradients and anisotropic filtering. Oracles: lom_sample at the level of lom_lod_of; the definition of
 * lom/texture.h in double, probe by probe; closed-form means. Proves: a round footprint, and anisotropy 1, are
 * lom_sample bit for bit; every lane is the definition; a constant stays one and nothing leaves the range of the texels;
 * a row that looks along a checkerboard far away is its mean, near that of the box it covers where the isotropic filter
 * is a level's blur; ratios of 1e6, axes of length 0 and NaN are defined; lanes do not depend on each other. */
#include "check.h"

#include <math.h>

#include "image/texture.h"

static lom_error error;

enum { SIZE = 64 };

static lom_texture *make(lom_format format, const void *pixels, int anisotropy, lom_filtering filtering, lom_wrap wrap)
{
    lom_texture *texture = lom_create_texture(
        &(lom_texture_desc){
            .width = SIZE,
            .height = SIZE / 2,
            .format = format,
            .pixels = pixels,
            .mips = LOM_MIPS_ALL,
            .sampler = { .anisotropy = anisotropy, .filtering = filtering, .wrap_s = wrap, .wrap_t = wrap } },
        &error);
    CHECK(texture != NULL, "%s", error.text);
    return texture;
}

static uint8_t *noise(void)
{
    static uint8_t pixels[SIZE * SIZE / 2 * 4];
    for (size_t i = 0; i < sizeof pixels; i++)
        pixels[i] = (uint8_t)(lom_random_bits(8, i) >> 4);
    return pixels;
}

static float random_in(uint64_t key, uint64_t i, float low, float high)
{
    return low + (high - low) * (float)lom_random_uniform(key, i);
}

static bool same(lom_float4 a, lom_float4 b)
{
    return memcmp(&a, &b, sizeof a) == 0;
}

/* ---- round footprints ---- */

static void isotropic_is_sample(void)
{
    for (int kind = 0; kind < 4; kind++) {
        lom_format format = kind % 2 == 0 ? LOM_FORMAT_RGBA8 : LOM_FORMAT_RGBA8_SRGB;
        lom_filtering filtering = kind < 2 ? LOM_FILTERING_FLOAT : LOM_FILTERING_FIXED;
        lom_texture *one = make(format, noise(), kind % 2, filtering, LOM_WRAP_REPEAT);
        lom_texture *many = make(format, noise(), 16, filtering, LOM_WRAP_REPEAT);
        for (uint64_t i = 0; i < 300; i++) {
            lom_float s, t, d[4], r[4];
            for (int lane = 0; lane < LOM_LANES; lane++) {
                uint64_t n = 8 * (i * LOM_LANES + (uint64_t)lane);
                s[lane] = random_in(1, n, -2, 2);
                t[lane] = random_in(1, n + 1, -2, 2);
                for (uint64_t k = 0; k < 4; k++)
                    d[k][lane] = random_in(1, n + 2 + k, -1, 1) * (float)ldexp(1, -(int)(i % 12));
                /* a turn by a quarter, in texels: as long, exactly */
                float x = random_in(1, n + 6, -1, 1), y = random_in(1, n + 7, -1, 1);
                r[0][lane] = x / SIZE;
                r[1][lane] = y / (SIZE / 2);
                r[2][lane] = -y / SIZE;
                r[3][lane] = x / (SIZE / 2);
            }
            CHECK(same(lom_sample_gradient(one, s, t, d[0], d[1], d[2], d[3]),
                       lom_sample(one, s, t, lom_lod_of(one, d[0], d[1], d[2], d[3]))),
                  "anisotropy %d, case %d", kind % 2, (int)i);
            for (int k = 0; k < 4; k++)
                r[k] = r[k] * (float)ldexp(1, (int)(i % 8));
            CHECK(same(lom_sample_gradient(many, s, t, r[0], r[1], r[2], r[3]),
                       lom_sample(many, s, t, lom_lod_of(many, r[0], r[1], r[2], r[3]))),
                  "a round footprint, case %d", (int)i);
        }
        lom_free_texture(one);
        lom_free_texture(many);
    }
}

/* ---- the definition ---- */

/* Of one lane: probes at places and a level worked out in double, sampled one by one, averaged in double. False where
 * the number of probes hangs on a rounding. */
static bool define(const lom_texture *texture, double s, double t, const double d[4], double out[4])
{
    double a = texture->sampler.anisotropy, w = SIZE, h = SIZE / 2.0;
    double x = hypot(d[0] * w, d[1] * h), y = hypot(d[2] * w, d[3] * h);
    const double *along = x >= y ? d : d + 2;
    double longer = fmax(x, y), q = fmax(fmin(x, y), longer / a), width = fmax(q, 1), exact = longer / width;
    if (fabs(x - y) < 1e-4 * longer || fabs(exact - nearbyint(exact)) < 1e-4)
        return false;
    int count = (int)fmin(fmax(ceil(exact), 1), a);
    for (int c = 0; c < 4; c++)
        out[c] = 0;
    for (int k = 0; k < count; k++) {
        double part = count > 1 ? ((double)k / (count - 1) - 0.5) * (longer - width) / longer : 0;
        lom_float4 value = lom_sample(texture, lom_splat((float)(s + along[0] * part)),
                                      lom_splat((float)(t + along[1] * part)), lom_splat((float)log2(q)));
        const double channels[4] = { (double)value.x[0], (double)value.y[0], (double)value.z[0], (double)value.w[0] };
        for (int c = 0; c < 4; c++)
            out[c] += channels[c] / count;
    }
    return true;
}

static void every_lane_is_the_definition(void)
{
    int checked = 0, many = 0;
    for (int anisotropy = 2; anisotropy <= 16; anisotropy += 7)
        for (int filtering = 0; filtering < 2; filtering++) {
            lom_texture *texture =
                make(LOM_FORMAT_RGBA8, noise(), anisotropy, (lom_filtering)filtering, LOM_WRAP_MIRROR);
            for (uint64_t i = 0; i < 400; i++) {
                lom_float s, t, d[4];
                for (int lane = 0; lane < LOM_LANES; lane++) {
                    uint64_t n = 8 * (i * LOM_LANES + (uint64_t)lane);
                    float longer = (float)ldexp(1, (int)(lom_random_bits(2, n) % 8) - 7);
                    float ratio = random_in(2, n + 1, 0, 1) * random_in(2, n + 2, 0, 1);
                    s[lane] = random_in(3, n, -2, 2);
                    t[lane] = random_in(3, n + 1, -2, 2);
                    for (uint64_t k = 0; k < 4; k++)
                        d[k][lane] = random_in(3, n + 2 + k, -1, 1) * longer *
                                     ((k < 2) == (lom_random_bits(2, n + 3) % 2 == 0) ? ratio : 1);
                }
                lom_float4 value = lom_sample_gradient(texture, s, t, d[0], d[1], d[2], d[3]);
                for (int lane = 0; lane < LOM_LANES; lane++) {
                    double want[4];
                    const double g[4] = { (double)d[0][lane], (double)d[1][lane], (double)d[2][lane],
                                          (double)d[3][lane] };
                    if (!define(texture, (double)s[lane], (double)t[lane], g, want))
                        continue;
                    const float got[4] = { value.x[lane], value.y[lane], value.z[lane], value.w[lane] };
                    for (int c = 0; c < 4; c++)
                        CHECK(fabs((double)got[c] - want[c]) < 2e-4, "anisotropy %d, (%g, %g), channel %d: %g not %g",
                              anisotropy, (double)s[lane], (double)t[lane], c, (double)got[c], want[c]);
                    checked++;
                    many += hypot(g[0] * 2, g[1]) > 4 * hypot(g[2] * 2, g[3]);
                }
            }
            lom_free_texture(texture);
        }
    CHECK(checked > 3000 && many > 300, "%d, %d", checked, many);
}

/* ---- what follows ---- */

static void constants_and_range(void)
{
    static float pixels[SIZE * SIZE / 2];
    for (int pass = 0; pass < 2; pass++) {
        float low = 3e-5f, high = pass == 0 ? 3e-5f : 1e30f;
        for (int i = 0; i < SIZE * SIZE / 2; i++)
            pixels[i] = i % 3 == 0 ? low : high;
        lom_texture *texture = make(LOM_FORMAT_R32F, pixels, 16, LOM_FILTERING_FLOAT, LOM_WRAP_REPEAT);
        for (uint64_t i = 0; i < 500; i++) {
            lom_float x[6];
            for (int lane = 0; lane < LOM_LANES; lane++)
                for (uint64_t k = 0; k < 6; k++)
                    x[k][lane] = random_in(4, 6 * (i * LOM_LANES + (uint64_t)lane) + k, -1, 1) * (k < 4 ? 1 : 0.1f);
            lom_float value = lom_sample_gradient(texture, x[0], x[1], x[2], x[3], x[4], x[5]).x;
            CHECK(lom_all((value >= low) & (value <= high)), "case %d: %g", (int)i, (double)value[0]);
        }
        lom_free_texture(texture);
    }
}

/* A checkerboard of squares of 4 texels, seen along t by a pixel that covers `rows` of it and one texel across: over
 * whole periods the mean is exactly half, whatever the column. The isotropic filter takes the level of the rows, and is
 * gray as well; half a period of t alone tells: across a boundary of columns the pixel must still see them. */
static void a_checkerboard_far_away(void)
{
    static uint8_t pixels[SIZE * SIZE / 2];
    for (int i = 0; i < SIZE * SIZE / 2; i++)
        pixels[i] = (i % SIZE / 4 + i / SIZE / 4) % 2 == 0 ? 255 : 0;
    lom_texture *texture = make(LOM_FORMAT_R8, pixels, 16, LOM_FILTERING_FLOAT, LOM_WRAP_REPEAT);
    for (int column = 0; column < SIZE; column++) {
        lom_float s = lom_splat(((float)column + 0.5f) / SIZE), zero = { 0 };
        /* 16 rows: 2 periods, a probe a row, each the bilinear of level 0 */
        lom_float far = lom_sample_gradient(texture, s, lom_splat(0.31f), lom_splat(1.0f / SIZE), zero, zero,
                                            lom_splat(16.0f / (SIZE / 2)))
                            .x;
        CHECK(fabs((double)far[0] - 0.5) < 1e-6, "column %d: %g", column, (double)far[0]);
        /* stripes: 4 rows of one colour, in the middle of the square */
        float want = (column / 4) % 2 == 0 ? 1 : 0;
        lom_float near = lom_sample_gradient(texture, s, lom_splat(2.0f / (SIZE / 2)), lom_splat(1.0f / SIZE), zero,
                                             zero, lom_splat(4.0f / (SIZE / 2)))
                             .x;
        lom_float blurred = lom_sample(texture, s, lom_splat(2.0f / (SIZE / 2)), lom_splat(2)).x;
        bool inner = column % 4 == 1 || column % 4 == 2;
        CHECK(!inner || fabsf(near[0] - want) < 1e-6f, "column %d: %g", column, (double)near[0]);
        CHECK(!inner || fabsf(blurred[0] - want) > 0.1f, "column %d: %g without probes", column, (double)blurred[0]);
    }
    lom_free_texture(texture);
}

static void extremes(void)
{
    static const float odd[] = { 0, -0.0f, 1e-6f, 1, 1e6f, 1e-30f, 1e30f, NAN, INFINITY, -INFINITY, 3e38f, 1e-45f };
    enum { ODD = sizeof odd / sizeof *odd };
    lom_texture *texture = make(LOM_FORMAT_RGBA8, noise(), 16, LOM_FILTERING_FIXED, LOM_WRAP_REPEAT);
    for (int i = 0; i < ODD * ODD * ODD * ODD; i++) {
        lom_float d[4];
        for (int lane = 0; lane < LOM_LANES; lane++) /* each lane another case: none may disturb the next */
            for (int k = 0, n = (i + lane * 977) % (ODD * ODD * ODD * ODD); k < 4; k++, n /= ODD)
                d[k][lane] = odd[n % ODD];
        lom_float4 all = lom_sample_gradient(texture, lom_splat(0.3f), lom_splat(0.7f), d[0], d[1], d[2], d[3]);
        CHECK(lom_all((all.x >= 0.0f) & (all.x <= 1.0f) & (all.w >= 0.0f) & (all.w <= 1.0f)), "case %d", i);
        if (i % 16 != 0)
            continue;
        int lane = i / 16 % LOM_LANES;
        lom_float4 alone = lom_sample_gradient(texture, lom_splat(0.3f), lom_splat(0.7f), lom_splat(d[0][lane]),
                                               lom_splat(d[1][lane]), lom_splat(d[2][lane]), lom_splat(d[3][lane]));
        CHECK(alone.x[0] == all.x[lane] && alone.w[0] == all.w[lane], "case %d lane %d", i, lane);
    }
    /* all NaN: as a footprint of length 0 */
    lom_float bad = lom_splat(NAN), zero = { 0 };
    CHECK(same(lom_sample_gradient(texture, lom_splat(0.3f), lom_splat(0.7f), bad, bad, bad, bad),
               lom_sample_gradient(texture, lom_splat(0.3f), lom_splat(0.7f), zero, zero, zero, zero)),
          "NaN is no footprint");
    /* a NaN axis counts nothing beside a finite one: 16 probes of its sixteenth */
    CHECK(same(lom_sample_gradient(texture, lom_splat(0.3f), lom_splat(0.7f), bad, bad, lom_splat(0.5f), zero),
               lom_sample_gradient(texture, lom_splat(0.3f), lom_splat(0.7f), zero, zero, lom_splat(0.5f), zero)),
          "a NaN axis");
    lom_free_texture(texture);
    for (int anisotropy = -1; anisotropy <= 17; anisotropy += 18) {
        lom_error why = { 0 };
        CHECK(
            lom_create_texture(&(lom_texture_desc){ .width = 1, .height = 1, .sampler = { .anisotropy = anisotropy } },
                               &why) == NULL &&
                strstr(why.text, "anisotropy") != NULL,
            "%d: %s", anisotropy, why.text);
    }
}

/* ---- the level of 3D textures ---- */

static void levels_of_volumes(void)
{
    lom_texture *texture = lom_create_texture(&(lom_texture_desc){ .kind = LOM_TEXTURE_3D,
                                                                   .width = 32,
                                                                   .height = 16,
                                                                   .depth = 8,
                                                                   .format = LOM_FORMAT_R8,
                                                                   .mips = LOM_MIPS_ALL },
                                              &error);
    for (uint64_t i = 0; i < 500; i++) {
        lom_float3 dx, dy;
        double want = 0;
        float x[6];
        for (uint64_t k = 0; k < 6; k++)
            x[k] = random_in(7, 6 * i + k, -1, 1) * (float)ldexp(1, (int)(i % 20) - 10);
        dx = lom_splat3(x[0], x[1], x[2]);
        dy = lom_splat3(x[3], x[4], x[5]);
        for (int k = 0; k < 6; k += 3) {
            double u = (double)x[k] * 32, v = (double)x[k + 1] * 16, w = (double)x[k + 2] * 8;
            want = fmax(want, sqrt(u * u + v * v + w * w));
        }
        CHECK(fabs((double)lom_lod_of_3d(texture, dx, dy)[0] - log2(want)) < 0x1p-14, "case %d", (int)i);
    }
    lom_float3 texels = lom_splat3(4.0f / 32, 0, 0), none = lom_splat3(0, 0, 0);
    CHECK(lom_lod_of_3d(texture, texels, none)[0] == 2 && lom_lod_of_3d(texture, none, none)[0] == -63,
          "powers of two");
    lom_free_texture(texture);
}

int main(int argc, char **argv)
{
    RUN(isotropic_is_sample);
    RUN(every_lane_is_the_definition);
    RUN(constants_and_range);
    RUN(a_checkerboard_far_away);
    RUN(extremes);
    RUN(levels_of_volumes);
    return check_result();
}
