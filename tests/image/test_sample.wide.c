/* The samplers against an oracle in double that wraps each texel index by itself: wraps x filters x sizes x formats. */
#include "oracle/sampling.h"

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
            sample_plain(p, place, lod[i], want, &bound, &shaky);
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
