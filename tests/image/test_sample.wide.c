/* The samplers against an oracle in double that wraps each texel index by itself: wraps x filters x sizes x formats. */
#include "plain_texture.h"

/* ---- the oracle ---- */

/* The texel that index i of n means; -1 for the border. */
static int wrap_index(long i, int n, lom_wrap wrap)
{
    if (wrap == LOM_WRAP_REPEAT)
        return (int)(((i % n) + n) % n);
    if (wrap == LOM_WRAP_MIRROR) {
        long m = ((i % (2 * n)) + 2 * n) % (2 * n);
        return (int)(m < n ? m : 2 * n - 1 - m);
    }
    if (i >= 0 && i < n)
        return (int)i;
    return wrap == LOM_WRAP_BORDER ? -1 : i < 0 ? 0 : n - 1;
}

static const double *texel_at(const plain_texture *p, int level, const long i[3])
{
    int x = wrap_index(i[0], p->width[level], p->desc.sampler.wrap_s);
    int y = wrap_index(i[1], p->height[level], p->desc.sampler.wrap_t);
    int z = p->desc.kind == LOM_TEXTURE_3D ? wrap_index(i[2], p->depth[level], p->desc.sampler.wrap_r) : 0;
    if (x < 0 || y < 0 || z < 0)
        return p->border;
    return p->texel[level][((size_t)z * (size_t)p->height[level] + (size_t)y) * (size_t)p->width[level] + (size_t)x];
}

/* One level; bound is how far float coordinates may move the result, and shaky is set when they may choose another
 * nearest texel. */
static void oracle_level(const plain_texture *p, int level, const double at[3], bool nearest, double out[4],
                         double *bound, bool *shaky)
{
    int size[3] = { p->width[level], p->height[level], p->depth[level] };
    int dimensions = p->desc.kind == LOM_TEXTURE_3D ? 3 : 2;
    long first[3] = { 0, 0, 0 };
    double weight[3] = { 0, 0, 0 };
    for (int d = 0; d < dimensions; d++) {
        double x = at[d] * size[d] - (nearest ? 0 : 0.5), error_of_x = (size[d] + 1) * 0x1p-22;
        x = x > 1e9 ? 1e9 : x < -1e9 ? -1e9 : x;
        first[d] = (long)floor(x);
        weight[d] = nearest ? 0 : x - floor(x);
        *bound += nearest ? 0 : error_of_x;
        if (nearest && fabs(x - round(x)) < error_of_x && (size[d] & (size[d] - 1)) != 0)
            *shaky = true;
    }
    for (int c = 0; c < 4; c++)
        out[c] = 0;
    for (int corner = 0; corner < 8; corner++) {
        double w = 1;
        long i[3];
        for (int d = 0; d < 3; d++) {
            w *= corner >> d & 1 ? weight[d] : 1 - weight[d];
            i[d] = first[d] + (corner >> d & 1);
        }
        const double *texel = w != 0 ? texel_at(p, level, i) : p->border;
        for (int c = 0; c < 4 && w != 0; c++)
            out[c] += w * texel[c];
    }
}

static void oracle(const plain_texture *p, const double at[3], double lod, double out[4], double *bound, bool *shaky)
{
    static const lom_filter nearest_within[] = { LOM_FILTER_NEAREST, LOM_FILTER_NEAREST_MIPMAP_NEAREST,
                                                 LOM_FILTER_NEAREST_MIPMAP_LINEAR };
    const lom_sampler_desc *s = &p->desc.sampler;
    lom_filter filter = lod > 0 ? s->minify : s->magnify;
    bool nearest = false, between_linear = filter >= LOM_FILTER_NEAREST_MIPMAP_LINEAR;
    bool between_nearest = filter >= LOM_FILTER_NEAREST_MIPMAP_NEAREST && !between_linear;
    for (int i = 0; i < 3; i++)
        nearest |= filter == nearest_within[i];
    double level = 0, last = p->levels - 1;
    if (between_nearest)
        level = fmin(ceil(lod + 0.5) - 1, last);
    if (between_linear)
        level = fmin(lod, last);
    double near[4], far[4] = { 0 }, fraction = level - floor(level);
    oracle_level(p, (int)level, at, nearest, near, bound, shaky);
    if (fraction > 0)
        oracle_level(p, (int)level + 1, at, nearest, far, bound, shaky);
    for (int c = 0; c < 4; c++)
        out[c] = near[c] + (fraction > 0 ? (far[c] - near[c]) * fraction : 0);
}

/* ---- lanes against the oracle ---- */

static float float_at(lom_float x, int i)
{
    return x[i];
}

/* Texels of all formats here lie in [-2, 2]: differences up to 4; weights and mixtures are a few roundings. */
static void compare_with_oracle(const plain_texture *p, int packets, uint64_t key)
{
    /* levels of 16-bit formats are floats, which the oracle reads back rounded */
    double rounding = p->levels > 1 && lom_describe_format(p->desc.format)->bits == 16 ? 0.5 / 65535 : 0;
    bool exact = p->desc.sampler.minify == LOM_FILTER_NEAREST && p->desc.sampler.magnify == LOM_FILTER_NEAREST;
    for (int n = 0; n < packets * 16 / LOM_LANES; n++) {
        lom_float3 at = { 0 };
        lom_float lod = { 0 };
        for (int i = 0; i < LOM_LANES; i++) {
            uint64_t counter = (uint64_t)(n * LOM_LANES + i) * 4;
            at.x[i] = (float)(random_unit(key, counter) * 5 - 2);
            at.y[i] = (float)(random_unit(key, counter + 1) * 5 - 2);
            at.z[i] = (float)(random_unit(key, counter + 2) * 5 - 2);
            lod[i] = (float)(random_unit(key, counter + 3) * (p->levels + 2) - 1.5);
        }
        lom_float4 got = sample_any(p, at, lod);
        for (int i = 0; i < LOM_LANES; i++) {
            double want[4], bound = 0, place[3] = { at.x[i], at.y[i], at.z[i] };
            bool shaky = false;
            oracle(p, place, lod[i], want, &bound, &shaky);
            double allowed = (exact ? 0x1p-23 : bound * 4 + 0x1p-19) + rounding;
            float g[4] = { float_at(got.x, i), float_at(got.y, i), float_at(got.z, i), float_at(got.w, i) };
            for (int c = 0; c < 4 && !shaky; c++)
                CHECK(fabs(g[c] - want[c]) <= allowed,
                      "%s %dx%dx%d wrap %d %d filter %d %d at %.9g %.9g %.9g lod %g channel %d: %.9g, not %.9g",
                      lom_describe_format(p->desc.format)->name, p->desc.width, p->desc.height, p->desc.depth,
                      p->desc.sampler.wrap_s, p->desc.sampler.wrap_t, p->desc.sampler.minify, p->desc.sampler.magnify,
                      place[0], place[1], place[2], (double)lod[i], c, (double)g[c], want[c]);
        }
    }
}

static void small_sizes_wraps_filters_formats(void)
{
    static const int sizes[][2] = { { 1, 1 }, { 1, 7 }, { 3, 5 }, { 8, 4 } };
    for (int f = 0; f < 7; f++)
        for (int n = 0; n < 4; n++)
            for (int wraps = 0; wraps < 16; wraps++)
                for (int filters = 0; filters < 12; filters++) {
                    if (f > 1 && (filters + wraps + n) % 5 != 0)
                        continue;
                    lom_texture_desc desc = {
                        .width = sizes[n][0],
                        .height = sizes[n][1],
                        .format = plain_formats[f],
                        .mips = LOM_MIPS_ALL,
                        .sampler = { .minify = LOM_FILTER_NEAREST + filters % 6,
                                     .magnify = LOM_FILTER_NEAREST + filters / 6,
                                     .wrap_s = wraps % 4,
                                     .wrap_t = wraps / 4,
                                     .border = { 1, 0, 1, 0 } },
                    };
                    plain_texture p = make_plain(desc);
                    compare_with_oracle(&p, 3, (uint64_t)(wraps * 12 + filters));
                    free_plain(&p);
                }
}

static void large_sizes(void)
{
    static const int sizes[][2] = { { 257, 1023 }, { 16384, 1 }, { 1, 3000 }, { 256, 256 } };
    for (int n = 0; n < 4; n++)
        for (int wrap = 0; wrap < 4; wrap++) {
            lom_texture_desc desc = { .width = sizes[n][0],
                                      .height = sizes[n][1],
                                      .format = plain_formats[wrap],
                                      .mips = LOM_MIPS_ALL,
                                      .sampler = { .minify = LOM_FILTER_LINEAR_MIPMAP_LINEAR,
                                                   .magnify = LOM_FILTER_LINEAR,
                                                   .wrap_s = wrap,
                                                   .wrap_t = (wrap + n) % 4,
                                                   .border = { 1, 1, 0, 1 } } };
            plain_texture p = make_plain(desc);
            compare_with_oracle(&p, 64, (uint64_t)n);
            free_plain(&p);
        }
}

static void volumes(void)
{
    static const int sizes[][3] = { { 1, 1, 1 }, { 3, 5, 7 }, { 4, 4, 4 }, { 8, 1, 2 } };
    for (int n = 0; n < 4; n++)
        for (int f = 0; f < 4; f++)
            for (int wrap = 0; wrap < 4; wrap++)
                for (int filters = 0; filters < 12; filters += 1 + f) {
                    lom_texture_desc desc = { .kind = LOM_TEXTURE_3D,
                                              .width = sizes[n][0],
                                              .height = sizes[n][1],
                                              .depth = sizes[n][2],
                                              .format = plain_formats[f],
                                              .mips = LOM_MIPS_ALL,
                                              .sampler = { .minify = LOM_FILTER_NEAREST + filters % 6,
                                                           .magnify = LOM_FILTER_NEAREST + filters / 6,
                                                           .wrap_s = wrap,
                                                           .wrap_t = (wrap + filters) % 4,
                                                           .wrap_r = (wrap + n) % 4,
                                                           .border = { 0, 1, 0, 1 } } };
                    plain_texture p = make_plain(desc);
                    compare_with_oracle(&p, 3, (uint64_t)filters);
                    free_plain(&p);
                }
}

int main(int argc, char **argv)
{
    RUN(small_sizes_wraps_filters_formats);
    RUN(large_sizes);
    RUN(volumes);
    return check_result();
}
