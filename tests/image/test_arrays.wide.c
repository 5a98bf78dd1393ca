/* Arrays and rows. Oracle: a 2D texture of a layer's pixels alone. Proves: a layer of an array gives the same bits as
 * that texture, for every way that texels are held, filtered and wrapped, at any coordinate and level; the layer is the
 * nearest whole number, ties to even, and clamped, NaN the first; nothing of a neighbouring layer gets in; rows are 2D
 * textures of height 1, and between two texels the closed form. */
#include "check.h"

#include <math.h>

#include <lom/texture.h>

static lom_error error;

enum { WIDTH = 7, HEIGHT = 5, LAYERS = 4, CASES = 64 };

static const lom_format formats[] = { LOM_FORMAT_RGBA8, LOM_FORMAT_RGBA8_SRGB, LOM_FORMAT_R8,  LOM_FORMAT_R32F,
                                      LOM_FORMAT_RG16,  LOM_FORMAT_RGB8_SRGB,  LOM_FORMAT_RG8, LOM_FORMAT_RGBA32F };
enum { FORMATS = sizeof formats / sizeof *formats };

static uint8_t *random_pixels(lom_format format, size_t texels)
{
    const lom_format_info *info = lom_describe_format(format);
    uint8_t *pixels = malloc(texels * 16);
    for (size_t i = 0; i < texels * (size_t)info->channels; i++) {
        float x = (float)(lom_random_uniform(12, i) * 4 - 2);
        uint16_t half = (uint16_t)lom_random_bits(13, i);
        if (info->bits == 32)
            memcpy(pixels + 4 * i, &x, 4);
        else if (info->bits == 16)
            memcpy(pixels + 2 * i, &half, 2);
        else
            pixels[i] = (uint8_t)lom_random_bits(14, i);
    }
    return pixels;
}

static float place(uint64_t key, uint64_t i)
{
    static const float odd[] = { 0, -0.0f, 1, -1e-10f, 0.5f, 1e8f, -1e8f, 8388608.5f, NAN, INFINITY, -INFINITY, 3e38f };
    uint64_t kind = lom_random_bits(key, 2 * i) % 5;
    return kind == 0 ? odd[lom_random_bits(key, 2 * i + 1) % 12]
                     : (float)(lom_random_uniform(key, 2 * i + 1) * 4 - 1.5);
}

static bool same(const lom_float4 *a, const lom_float4 *b, int lane_a, int lane_b)
{
    const float x[4] = { a->x[lane_a], a->y[lane_a], a->z[lane_a], a->w[lane_a] };
    const float y[4] = { b->x[lane_b], b->y[lane_b], b->z[lane_b], b->w[lane_b] };
    return memcmp(x, y, sizeof x) == 0;
}

/* Every lane of an array against the texture of its layer. */
static void compare(const lom_texture *array, lom_texture *const layers[LAYERS], uint64_t key, const char *what)
{
    for (int i = 0; i < CASES; i += LOM_LANES) {
        lom_float s = { 0 }, t = { 0 }, layer = { 0 }, lod = { 0 };
        for (int lane = 0; lane < LOM_LANES; lane++) {
            s[lane] = place(key, (uint64_t)(4 * (i + lane)));
            t[lane] = place(key, (uint64_t)(4 * (i + lane) + 1));
            lod[lane] = place(key, (uint64_t)(4 * (i + lane) + 2));
            layer[lane] = (float)(lom_random_bits(key, (uint64_t)(1000 + i + lane)) % LAYERS);
        }
        lom_float4 all = lom_sample_array(array, s, t, layer, lod);
        for (int lane = 0; lane < LOM_LANES; lane++) {
            int k = (int)layer[lane];
            lom_float4 one = lom_sample(layers[k], lom_splat(s[lane]), lom_splat(t[lane]), lom_splat(lod[lane]));
            CHECK(same(&all, &one, lane, 0), "%s: (%g, %g) layer %d lod %g", what, (double)s[lane], (double)t[lane], k,
                  (double)lod[lane]);
        }
    }
}

static void layers_are_textures(void)
{
    for (int f = 0; f < FORMATS; f++)
        for (int setting = 0; setting < 24; setting++) {
            uint64_t key = (uint64_t)(100 + setting);
            uint8_t *pixels = random_pixels(formats[f], WIDTH * HEIGHT * LAYERS);
            lom_sampler_desc sampler = { .minify = (lom_filter)(lom_random_bits(key, 0) % LOM_FILTER_COUNT),
                                         .magnify = (lom_filter)(lom_random_bits(key, 1) % 3),
                                         .wrap_s = (lom_wrap)(setting % 4),
                                         .wrap_t = (lom_wrap)(setting / 4 % 4),
                                         .border = { 0.25f, 1, 0, 0.5f },
                                         .filtering = setting % 2 == 0 ? LOM_FILTERING_FLOAT : LOM_FILTERING_FIXED };
            lom_texture_desc desc = { .kind = LOM_TEXTURE_2D_ARRAY,
                                      .width = WIDTH,
                                      .height = HEIGHT,
                                      .depth = LAYERS,
                                      .format = formats[f],
                                      .pixels = pixels,
                                      .mips = setting % 3 == 0 ? LOM_MIPS_NONE : LOM_MIPS_ALL,
                                      .sampler = sampler };
            lom_texture *array = lom_create_texture(&desc, &error), *layers[LAYERS];
            CHECK(array != NULL && lom_texture_layers(array) == LAYERS && lom_texture_depth(array) == 1 &&
                      lom_texture_levels(array) == (setting % 3 == 0 ? 1 : 3),
                  "%s", error.text);
            desc.kind = LOM_TEXTURE_2D;
            desc.depth = 1;
            for (int k = 0; k < LAYERS; k++) {
                desc.pixels = pixels + (size_t)k * WIDTH * HEIGHT * lom_format_size(formats[f]);
                layers[k] = lom_create_texture(&desc, &error);
            }
            char what[64];
            snprintf(what, sizeof what, "%s, setting %d", lom_describe_format(formats[f])->name, setting);
            compare(array, layers, key, what);
            for (int k = 0; k < LAYERS; k++) { /* and what is read back */
                lom_image *a = lom_read_texture(array, lom_texture_levels(array) - 1, k, &error);
                lom_image *b = lom_read_texture(layers[k], lom_texture_levels(array) - 1, 0, &error);
                CHECK(a != NULL && b != NULL && lom_hash_image(a) == lom_hash_image(b), "%s: layer %d", what, k);
                lom_free_image(a);
                lom_free_image(b);
                lom_free_texture(layers[k]);
            }
            lom_free_texture(array);
            free(pixels);
        }
}

static void which_layer(void)
{
    static const uint8_t grays[LAYERS] = { 10, 20, 30, 40 };
    static const struct {
        float layer;
        int of;
    } cases[] = { { 0, 0 },         { 0.5f, 0 },  { 0.50001f, 1 }, { 1.5f, 2 },       { 2.5f, 2 },
                  { 2.4999f, 2 },   { 2.6f, 3 },  { 3.5f, 3 },     { 4, 3 },          { 1e30f, 3 },
                  { -0.5f, 0 },     { -1, 0 },    { -1e30f, 0 },   { NAN, 0 },        { INFINITY, 3 },
                  { -INFINITY, 0 }, { -0.0f, 0 }, { 8388609, 3 },  { 0.49999997f, 0 } };
    lom_texture *t = lom_create_texture(&(lom_texture_desc){ .kind = LOM_TEXTURE_2D_ARRAY,
                                                             .width = 1,
                                                             .height = 1,
                                                             .depth = LAYERS,
                                                             .format = LOM_FORMAT_R8,
                                                             .pixels = grays },
                                        &error);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        lom_float4 x = lom_sample_array(t, lom_splat(0.3f), lom_splat(0.9f), lom_splat(cases[i].layer), lom_splat(0));
        CHECK(x.x[0] == (float)grays[cases[i].of] / 255.0f, "layer %g: %g", (double)cases[i].layer, (double)x.x[0]);
    }
    lom_free_texture(t);
}

/* Between the centres of texels i and i + 1 of a row: a + (b - a) f. */
static void rows(void)
{
    static const float values[2][4] = { { 1, 3, -2, 8 }, { 0, 16, 4, 4 } };
    lom_texture_desc desc = { .kind = LOM_TEXTURE_1D,
                              .width = 4,
                              .format = LOM_FORMAT_R32F,
                              .pixels = values,
                              .sampler = { .wrap_s = LOM_WRAP_CLAMP } };
    lom_texture *row = lom_create_texture(&desc, &error);
    CHECK(row != NULL && lom_texture_height(row) == 1, "%s", error.text);
    desc.kind = LOM_TEXTURE_1D_ARRAY;
    desc.depth = 2;
    lom_texture *rows = lom_create_texture(&desc, &error);
    for (int i = 0; row != NULL && rows != NULL && i < 64; i++) {
        float place = (float)i / 16, s = (place + 0.5f) / 4; /* exact */
        int k = i / 16 < 3 ? i / 16 : 3, next = k < 3 ? k + 1 : 3;
        float f = place - (float)k;
        lom_float4 x = lom_sample_1d(row, lom_splat(s), lom_splat(0));
        CHECK(x.x[0] == values[0][k] + (values[0][next] - values[0][k]) * f, "%g: %g", (double)s, (double)x.x[0]);
        for (int layer = 0; layer < 2; layer++) {
            x = lom_sample_1d_array(rows, lom_splat(s), lom_splat((float)layer), lom_splat(0));
            CHECK(x.x[0] == values[layer][k] + (values[layer][next] - values[layer][k]) * f, "%g, %d: %g", (double)s,
                  layer, (double)x.x[0]);
        }
    }
    lom_free_texture(row);
    lom_free_texture(rows);
}

static void what_is_refused(void)
{
    static const lom_texture_desc bad[] = {
        { .width = 4, .height = 2, .kind = LOM_TEXTURE_1D },
        { .width = 4, .depth = 2, .kind = LOM_TEXTURE_1D },
        { .width = 4, .height = 2, .depth = 2, .kind = LOM_TEXTURE_1D_ARRAY },
        { .width = 4, .height = 4, .kind = LOM_TEXTURE_2D_ARRAY },
        { .width = 4, .height = 4, .depth = -1, .kind = LOM_TEXTURE_2D_ARRAY },
        { .width = 32768, .height = 32768, .depth = 32768, .kind = LOM_TEXTURE_2D_ARRAY },
        { .width = 4,
          .height = 4,
          .depth = 8,
          .kind = LOM_TEXTURE_2D_ARRAY,
          .mips = LOM_MIPS_SUPPLIED,
          .level_count = 4 },
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        lom_error why = { 0 };
        CHECK(lom_create_texture(&bad[i], &why) == NULL && why.code != LOM_OK && why.text[0] != 0, "descriptor %zu", i);
    }
}

int main(int argc, char **argv)
{
    RUN(layers_are_textures);
    RUN(which_layer);
    RUN(rows);
    RUN(what_is_refused);
    return check_result();
}
