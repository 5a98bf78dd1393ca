/* Proves that what a sampler gives one lane does not depend on the other lanes of its packet: every public function of
 * <lom/texture.h> over lanes, and three textures at once, of every kind, storage and filter, at coordinates and levels of
 * any bits; of float textures as a pass may leave them too, whose texels differ by more than there are floats, or are -0. */
#include "neighbours.h"

#include "image/sample_alike.h"
#include "image/texture.h"

static lom_error error;

enum { PACKETS = 400 };

static void call_sample(const void *context, const lom_float *in, lom_float *out)
{
    const lom_float4 texel = lom_sample(context, in[0], in[1], in[2]);
    memcpy(out, &texel, sizeof texel);
}

static void call_cube(const void *context, const lom_float *in, lom_float *out)
{
    const lom_float4 texel = lom_sample_cube(context, (lom_float3){ in[0], in[1], in[3] }, in[2]);
    memcpy(out, &texel, sizeof texel);
}

static void call_3d(const void *context, const lom_float *in, lom_float *out)
{
    const lom_float4 texel = lom_sample_3d(context, in[0], in[1], in[3], in[2]);
    memcpy(out, &texel, sizeof texel);
}

static void call_array(const void *context, const lom_float *in, lom_float *out)
{
    const lom_float4 texel = lom_sample_array(context, in[0], in[1], in[3], in[2]);
    memcpy(out, &texel, sizeof texel);
}

static void call_gradient(const void *context, const lom_float *in, lom_float *out)
{
    const lom_float4 texel = lom_sample_gradient(context, in[0], in[1], in[2], in[3], in[4], in[5]);
    memcpy(out, &texel, sizeof texel);
}

static void call_gather(const void *context, const lom_float *in, lom_float *out)
{
    const lom_float4 texel = lom_sample_gather(context, in[0], in[1], 0);
    memcpy(out, &texel, sizeof texel);
}

static void call_compare(const void *context, const lom_float *in, lom_float *out)
{
    out[0] = lom_sample_compare(context, in[0], in[1], in[2], LOM_COMPARE_GREATER_EQUAL);
}

static void call_depth(const void *context, const lom_float *in, lom_float *out)
{
    out[0] = lom_sample_depth(context, in[0], in[1]);
}

static void call_fetch(const void *context, const lom_float *in, lom_float *out)
{
    const lom_float4 texel = lom_fetch(context, lom_as_int(in[0]), lom_as_int(in[1]), 1);
    memcpy(out, &texel, sizeof texel);
}

static void call_lod(const void *context, const lom_float *in, lom_float *out)
{
    out[0] = lom_lod_of(context, in[0], in[1], in[2], in[3]);
    out[1] = lom_lod_of_3d(context, (lom_float3){ in[0], in[1], in[2] }, (lom_float3){ in[3], in[4], in[5] });
}

static void call_three(const void *context, const lom_float *in, lom_float *out)
{
    const lom_texture *const three[3] = { context, context, context };
    const lom_float2 at = { in[0], in[1] };
    lom_float4 texel[3];
    LOM_WIDE(lom_sample_three_lanes)(three, &at, &in[2], texel);
    memcpy(out, texel, sizeof texel);
}

static const struct {
    const char *name;
    lane_function *function;
    int inputs, outputs;
    lom_texture_kind kind;
} functions[] = {
    { "lom_sample", call_sample, 3, 4, LOM_TEXTURE_2D },
    { "lom_sample_three", call_three, 3, 12, LOM_TEXTURE_2D },
    { "lom_sample_gradient", call_gradient, 6, 4, LOM_TEXTURE_2D },
    { "lom_sample_gather", call_gather, 2, 4, LOM_TEXTURE_2D },
    { "lom_sample_compare", call_compare, 3, 1, LOM_TEXTURE_2D },
    { "lom_sample_depth", call_depth, 2, 1, LOM_TEXTURE_2D },
    { "lom_fetch", call_fetch, 2, 4, LOM_TEXTURE_2D },
    { "lom_lod_of", call_lod, 6, 2, LOM_TEXTURE_2D },
    { "lom_sample_cube", call_cube, 4, 4, LOM_TEXTURE_CUBE },
    { "lom_sample_3d", call_3d, 4, 4, LOM_TEXTURE_3D },
    { "lom_sample_array", call_array, 4, 4, LOM_TEXTURE_2D_ARRAY },
};

/* A texture of 16 x 16 (x 4 or layers), whose float texels are as a pass may leave them. */
static lom_texture *make(lom_texture_kind kind, lom_format format, lom_sampler_desc sampler, uint64_t key)
{
    const int layers = kind == LOM_TEXTURE_2D ? 1 : kind == LOM_TEXTURE_CUBE ? 6 : 4;
    static uint8_t pixels[16 * 16 * 6 * 16];
    for (size_t i = 0; i < sizeof pixels / 4; i++) {
        const float value = (float)(lom_random_uniform(key, i) * 2 - 0.5);
        const uint32_t bits = (uint32_t)lom_random_bits(key, i);
        if (lom_describe_format(format)->is_float && lom_describe_format(format)->bits == 32)
            memcpy(pixels + i * 4, &value, 4);
        else
            memcpy(pixels + i * 4, &bits, 4);
    }
    lom_texture *texture = lom_create_texture(&(lom_texture_desc){ .kind = kind,
                                                                   .width = 16,
                                                                   .height = 16,
                                                                   .depth = kind == LOM_TEXTURE_CUBE ? 0 : layers,
                                                                   .format = format,
                                                                   .pixels = pixels,
                                                                   .mips = LOM_MIPS_ALL,
                                                                   .sampler = sampler },
                                              &error);
    CHECK(texture != NULL, "%s", error.text);
    static const float ends[] = { 3.4e38f, -3.4e38f, -0.0f, 1, 0x1p-149f, -0.0f };
    if (texture != NULL && texture->storage != LOM_STORAGE_RGBA8)
        for (size_t i = 0; i < texture->texel_count * lom_texel_size(texture) / 4; i++)
            if (lom_random_bits(key + 1, i) % 4 == 0)
                ((float *)texture->texels)[i] = ends[lom_random_bits(key + 2, i) % 6];
    return texture;
}

/* Places within the texture and about it; levels that are whole in most lanes of some packets; changes of a texel or more. */
static void fill_inputs(lom_float *in, int inputs, int n)
{
    for (int k = 0; k < inputs; k++)
        for (int i = 0; i < LOM_LANES; i++) {
            const uint64_t place = (uint64_t)((n * LOM_LANES + i) * MOST_LANE_INPUTS + k);
            in[k][i] = (float)(lom_random_uniform(3, place) * 3 - 1);
            if (k == 2 && n % 2 == 0)
                in[k][i] = (float)(lom_random_bits(4, place) % 5) + (lom_random_bits(5, place) % 4 == 0 ? 0.25f : 0);
            else if (k >= 2)
                in[k][i] *= (float)(1 + n % 7);
            if (lom_random_bits(6, place) % 16 == 0)
                in[k][i] = poison(7, place);
        }
}

static void try_texture(lom_texture_kind kind, lom_format format, lom_sampler_desc sampler, uint64_t key)
{
    lom_texture *texture = make(kind, format, sampler, key);
    for (size_t f = 0; texture != NULL && f < sizeof functions / sizeof *functions; f++) {
        if (functions[f].kind != kind)
            continue;
        const struct lane_case c = { functions[f].name, functions[f].function, texture, functions[f].inputs,
                                     functions[f].outputs };
        for (int n = 0; n < PACKETS / LOM_LANES; n++) {
            lom_float in[MOST_LANE_INPUTS];
            fill_inputs(in, c.inputs, n);
            expect_lanes_alone(&c, in, key * PACKETS + (uint64_t)n);
        }
    }
    lom_free_texture(texture);
}

static void try_kind(lom_texture_kind kind)
{
    static const lom_format formats[] = { LOM_FORMAT_RGBA8, LOM_FORMAT_RGBA8_SRGB, LOM_FORMAT_R32F,
                                          LOM_FORMAT_RGBA32F };
    static const lom_wrap wraps[] = { LOM_WRAP_REPEAT, LOM_WRAP_BORDER, LOM_WRAP_CLAMP, LOM_WRAP_MIRROR };
    uint64_t key = 100;
    for (size_t f = 0; f < sizeof formats / sizeof *formats; f++)
        for (int minify = LOM_FILTER_DEFAULT; minify < LOM_FILTER_COUNT; minify++)
            for (int fixed = 0; fixed < 2; fixed++) {
                const lom_wrap wrap = wraps[key % 4];
                const lom_sampler_desc sampler = { .minify = (lom_filter)minify,
                                                   .magnify = key % 3 == 0 ? LOM_FILTER_NEAREST : LOM_FILTER_DEFAULT,
                                                   .wrap_s = wrap,
                                                   .wrap_t = wraps[key / 4 % 4],
                                                   .wrap_r = wrap,
                                                   .border = { 0.5f, 0.25f, 1, 0 },
                                                   .filtering = fixed ? LOM_FILTERING_FIXED : LOM_FILTERING_FLOAT,
                                                   .anisotropy = (int)(key % 5) * 2 };
                try_texture(kind, formats[f], sampler, key++);
            }
}

static void textures_of_two_dimensions(void)
{
    try_kind(LOM_TEXTURE_2D);
}

static void cubes(void)
{
    try_kind(LOM_TEXTURE_CUBE);
}

static void volumes(void)
{
    try_kind(LOM_TEXTURE_3D);
}

static void arrays(void)
{
    try_kind(LOM_TEXTURE_2D_ARRAY);
}

int main(int argc, char **argv)
{
    RUN(textures_of_two_dimensions);
    RUN(cubes);
    RUN(volumes);
    RUN(arrays);
    return check_result();
}
