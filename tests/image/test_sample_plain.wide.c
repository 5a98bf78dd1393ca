/* The short ways of sampling float textures give, bit for bit, what the general sampler gives of each texture by itself: of
 * four channels, alone and three at a time, of all wraps, sizes, levels and filters; and the nearest depth; at any
 * coordinates. */
#include "check.h"

#include "image/sample_alike.h"
#include "image/sample_lanes.h"

static lom_error error;

/* Any bits: what is no number or too large is made one when the texture is. */
static lom_texture *make(lom_texture_desc desc, uint64_t key)
{
    size_t count = (size_t)desc.width * (size_t)desc.height * lom_format_size(desc.format) / 4;
    uint32_t *pixels = malloc(count * 4);
    for (size_t i = 0; i < count; i++) {
        uint32_t bits = (uint32_t)lom_random_bits(key, i);
        pixels[i] = i % 3 == 0 ? bits : (bits & 0x83ffffff) | 0x3c000000;
    }
    desc.pixels = pixels;
    lom_texture *texture = lom_create_texture(&desc, &error);
    CHECK(texture != NULL, "%s", error.text);
    free(pixels);
    return texture;
}

static lom_float4 sample_in_general(const lom_texture *texture, const lom_float2 *at, lom_float lod)
{
    sample_point point = { .face = { 0 } };
    point.s = sample_wrap(at->x, texture->sampler.wrap_s);
    point.t = sample_wrap(at->y, texture->sampler.wrap_t);
    return texture->storage == LOM_STORAGE_R32F
               ? sample_texture(texture, LOM_TEXTURE_2D, LOM_STORAGE_R32F, false, &point, lod)
               : sample_texture(texture, LOM_TEXTURE_2D, LOM_STORAGE_RGBA32F, false, &point, lod);
}

static float coordinate(uint64_t key, uint64_t i)
{
    static const float special[] = { 0,    1,      -1,      0.5f,      -0.0f,    1e-8f,     -1e-8f,   0.99999994f,
                                     1e6f, -1e30f, 3.4e38f, 0x1p-149f, 1 / 0.0f, -1 / 0.0f, 0 / 0.0f, 0.25f };
    uint64_t bits = lom_random_bits(key, i);
    return bits % 8 == 0 ? special[bits / 8 % (sizeof special / sizeof *special)]
                         : (float)(lom_random_uniform(key + 1, i) * 5 - 2);
}

/* Every other packet lies within a level, as near a large triangle, or exactly at one. */
static lom_float level_of_detail(uint64_t key, int n)
{
    lom_float lod;
    for (int i = 0; i < LOM_LANES; i++) {
        lod[i] = (float)(lom_random_uniform(key, (uint64_t)(n * LOM_LANES + i)) * 9 - 1.5);
        if (n % 7 == 6)
            lod[i] = coordinate(key, (uint64_t)(n * LOM_LANES + i)) * 4;
    }
    if (n % 2 == 0)
        lod = lom_splat((float)(int)(lod[0] + 2) - 2 + (n % 8 == 0 ? 0 : 0.75f)) +
              (n % 4 == 0 ? lom_splat(0) : lom_to_float(lom_lane_index()) * 0.01f);
    return lod;
}

static void compare(const lom_texture *const texture[3], int packets, uint64_t key)
{
    for (int n = 0; n < packets; n++) {
        lom_float2 at;
        for (int i = 0; i < LOM_LANES; i++) {
            at.x[i] = coordinate(key, (uint64_t)(n * LOM_LANES + i));
            at.y[i] = coordinate(key + 2, (uint64_t)(n * LOM_LANES + i));
        }
        const lom_float lod = level_of_detail(key + 4, n);
        lom_float4 three[3];
        LOM_WIDE(lom_sample_three_lanes)(texture, &at, &lod, three);
        for (int k = 0; k < 3; k++) {
            const lom_float4 one = lom_sample(texture[k], at.x, at.y, lod);
            const lom_float4 general = sample_in_general(texture[k], &at, lod);
            CHECK(memcmp(&one, &general, sizeof one) == 0, "%s %dx%d wrap %d %d filter %d: packet %d",
                  lom_describe_format(texture[k]->format)->name, texture[k]->level[0].width,
                  texture[k]->level[0].height, texture[k]->sampler.wrap_s, texture[k]->sampler.wrap_t,
                  texture[k]->sampler.minify, n);
            CHECK(memcmp(&three[k], &general, sizeof general) == 0, "texture %d of three, %dx%d: packet %d", k,
                  texture[k]->level[0].width, texture[k]->level[0].height, n);
        }
    }
}

static void compare_made(const lom_texture_desc desc[3], int packets, uint64_t key)
{
    lom_texture *texture[3];
    for (int k = 0; k < 3; k++)
        texture[k] = make(desc[k], key + 10 + (uint64_t)k);
    compare((const lom_texture *const *)texture, packets, key);
    for (int k = 0; k < 3; k++)
        lom_free_texture(texture[k]);
}

static void three_textures_that_are_alike(void)
{
    static const int sizes[][2] = { { 1, 1 }, { 3, 5 }, { 8, 4 }, { 1, 7 }, { 64, 64 }, { 257, 33 } };
    static const lom_format formats[] = { LOM_FORMAT_RGBA32F, LOM_FORMAT_R32F };
    uint64_t key = 100;
    for (int f = 0; f < 2; f++)
        for (int n = 0; n < 6; n++)
            for (int wraps = 0; wraps < 16; wraps++)
                for (int mips = LOM_MIPS_NONE; mips <= LOM_MIPS_ALL; mips++) {
                    const lom_texture_desc desc = { .width = sizes[n][0],
                                                    .height = sizes[n][1],
                                                    .format = formats[f],
                                                    .mips = (lom_mips)mips,
                                                    .sampler = { .wrap_s = (lom_wrap)(wraps % 4),
                                                                 .wrap_t = (lom_wrap)(wraps / 4),
                                                                 .lod_bias = wraps == 5 ? 0.3f : 0,
                                                                 .lod_min = wraps == 8 ? 0.5f : 0,
                                                                 .lod_max = wraps == 8 ? 1.7f : 0 } };
                    compare_made((const lom_texture_desc[3]){ desc, desc, desc }, 32, key += 100);
                }
}

/* Of another size, wrap, bias, filter or format than the first. */
static void textures_that_are_not_alike(void)
{
    for (int which = 0; which < 7; which++)
        for (int k = 0; k < 3; k++) {
            const lom_texture_desc same = {
                .width = 16, .height = 16, .format = LOM_FORMAT_RGBA32F, .mips = LOM_MIPS_ALL
            };
            lom_texture_desc desc[3] = { same, same, same };
            desc[k].width = which == 0 ? 8 : 16;
            desc[k].sampler.wrap_t = which == 1 ? LOM_WRAP_MIRROR : LOM_WRAP_REPEAT;
            desc[k].sampler.lod_bias = which == 2 ? 1 : 0;
            desc[k].sampler.minify = which == 3 ? LOM_FILTER_NEAREST_MIPMAP_LINEAR : LOM_FILTER_DEFAULT;
            desc[k].sampler.magnify = which == 4 ? LOM_FILTER_NEAREST : LOM_FILTER_DEFAULT;
            desc[k].mips = which == 5 ? LOM_MIPS_NONE : LOM_MIPS_ALL;
            desc[k].format = which == 6 ? LOM_FORMAT_R32F : LOM_FORMAT_RGBA32F;
            compare_made(desc, 32, (uint64_t)(which * 3 + k));
        }
}

static void depths_that_are_nearest(void)
{
    static const lom_filter filters[] = { LOM_FILTER_NEAREST, LOM_FILTER_LINEAR };
    for (int wraps = 0; wraps < 16; wraps++)
        for (int f = 0; f < 4; f++) {
            const lom_texture_desc desc = { .width = 5 + 60 * (wraps % 3),
                                            .height = 7,
                                            .format = LOM_FORMAT_DEPTH32F,
                                            .sampler = { .minify = filters[f % 2],
                                                         .magnify = filters[f / 2],
                                                         .wrap_s = (lom_wrap)(wraps % 4),
                                                         .wrap_t = (lom_wrap)(wraps / 4),
                                                         .border = { 0.75f } } };
            lom_texture *texture = make(desc, (uint64_t)wraps);
            for (int n = 0; n < 64; n++) {
                lom_float2 at;
                for (int i = 0; i < LOM_LANES; i++) {
                    at.x[i] = coordinate(7, (uint64_t)(n * LOM_LANES + i));
                    at.y[i] = coordinate(8, (uint64_t)(n * LOM_LANES + i));
                }
                const lom_float depth = lom_sample_depth(texture, at.x, at.y);
                const lom_float4 general = sample_in_general(texture, &at, lom_splat(-1000.0f));
                CHECK(memcmp(&depth, &general.x, sizeof depth) == 0, "wraps %d, filters %d: packet %d", wraps, f, n);
            }
            lom_free_texture(texture);
        }
}

int main(int argc, char **argv)
{
    RUN(three_textures_that_are_alike);
    RUN(textures_that_are_not_alike);
    RUN(depths_that_are_nearest);
    return check_result();
}
