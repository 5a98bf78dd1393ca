/* Textures as memory: what comes back, mip levels against an area integral in double, aprons, bad descriptors. */
#include "check.h"

#include <math.h>

#include "image/convert.h"
#include "image/texture.h"

static lom_error error;

static uint8_t *random_pixels(lom_format format, size_t count)
{
    const lom_format_info *info = lom_describe_format(format);
    uint8_t *pixels = malloc(count * lom_format_size(format));
    for (size_t i = 0; i < count * (size_t)info->channels; i++) {
        uint32_t bits = (uint32_t)lom_random_bits(1, i);
        uint16_t half = (uint16_t)bits;
        float single = (float)lom_random_uniform(2, i);
        if (info->bits == 8)
            pixels[i] = (uint8_t)bits;
        if (info->bits == 16 && info->is_float)
            half &= 0xbbff; /* no infinities, no NaN */
        if (info->bits == 16)
            memcpy(pixels + 2 * i, &half, 2);
        bits &= 0xffffff;
        if (info->bits == 32)
            memcpy(pixels + 4 * i, info->is_float ? (void *)&single : (void *)&bits, 4);
    }
    return pixels;
}

static void every_format_comes_back(void)
{
    for (int format = 1; format < LOM_FORMAT_COUNT; format++)
        for (int kind = 0; kind < 3; kind++) {
            lom_texture_desc desc = { .kind = kind, .width = 5, .height = 5, .format = format };
            desc.depth = kind == LOM_TEXTURE_3D ? 6 : 0;
            size_t count = 25 * (kind == LOM_TEXTURE_2D ? 1 : 6);
            uint8_t *pixels = random_pixels(format, count);
            desc.pixels = pixels;
            lom_texture *t = lom_create_texture(&desc, &error);
            lom_image *image = lom_read_texture(t, 0, -1, &error);
            CHECK(image != NULL && lom_image_size(image) == count * lom_format_size(format), "%s", error.text);
            CHECK(memcmp(image->pixels, pixels, lom_image_size(image)) == 0, "%s kind %d",
                  lom_describe_format(format)->name, kind);
            lom_image *again = lom_read_texture(t, 0, 0, &error);
            CHECK(memcmp(again->pixels, pixels, lom_image_size(again)) == 0, "the first layer alone");
            lom_free_image(again);
            lom_free_image(image);
            lom_free_texture(t);
            free(pixels);
        }
}

/* ---- mip levels ---- */

static double light_of(const lom_texture *t, const void *texel, int channel)
{
    if (t->storage == LOM_STORAGE_RGBA8) {
        uint32_t value;
        memcpy(&value, texel, 4);
        double v = (value >> 8 * channel & 255) / 255.0;
        return !t->srgb || channel == 3 ? v : v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
    }
    float value[4] = { 0 };
    memcpy(value, texel, lom_texel_size(t));
    return value[channel];
}

static double overlap(int i, int n, int texel, int m) /* of texel i of n with texel of m, both over 0..1, times n */
{
    double low = fmax((double)i / n, (double)texel / m), high = fmin((i + 1.0) / n, (texel + 1.0) / m);
    return high > low ? (high - low) * n : 0;
}

/* The mean light of the area of a texel, over all texels of the level above. */
static double area_mean(const lom_texture *t, int level, int x, int y, int z, int channel)
{
    const lom_level *from = &t->level[level - 1], *to = &t->level[level];
    double sum = 0, total = 0;
    bool deep = t->kind == LOM_TEXTURE_3D;
    for (int k = 0; k < (deep ? from->depth : 1); k++)
        for (int j = 0; j < from->height; j++)
            for (int i = 0; i < from->width; i++) {
                double w = overlap(i, from->width, x, to->width) * overlap(j, from->height, y, to->height) *
                           (deep ? overlap(k, from->depth, z, to->depth) : 1);
                total += w;
                if (w > 0)
                    sum += w * light_of(t, lom_texel(t, level - 1, i, j, deep ? k : z), channel);
            }
    return sum / total;
}

static void check_level(const lom_texture *t, int level)
{
    const lom_level *l = &t->level[level];
    for (int z = 0; z < lom_level_layers(t, level); z++)
        for (int y = 0; y < l->height; y++)
            for (int x = 0; x < l->width; x++)
                for (int c = 0; c < 4; c++) {
                    double want = area_mean(t, level, x, y, z, c), got = light_of(t, lom_texel(t, level, x, y, z), c);
                    bool code = t->srgb && c < 3;
                    if (code) {
                        uint32_t texel;
                        memcpy(&texel, lom_texel(t, level, x, y, z), 4);
                        uint8_t low = lom_srgb8_of((float)(want * (1 - 1e-6)));
                        uint8_t high = lom_srgb8_of((float)(want * (1 + 1e-6))), is = texel >> 8 * c & 255;
                        CHECK(is == low || is == high, "level %d: code %d, not %d", level, is, low);
                        continue;
                    }
                    double bound = t->storage == LOM_STORAGE_RGBA8 ? 0.5 / 255 + 1e-12 : fabs(want) * 0x1p-23;
                    CHECK(fabs(want - got) <= bound, "level %d texel %d %d %d: %.9g, not %.9g", level, x, y, z, got,
                          want);
                }
}

static void mip_levels_are_area_means(void)
{
    static const lom_format formats[] = { LOM_FORMAT_RGBA8, LOM_FORMAT_RGBA8_SRGB, LOM_FORMAT_R32F,
                                          LOM_FORMAT_RGBA16F };
    static const int sizes[][3] = { { 16, 16, 1 }, { 7, 13, 1 }, { 1, 9, 1 }, { 32, 3, 1 }, { 8, 5, 3 }, { 5, 5, 1 } };
    for (int f = 0; f < 4; f++)
        for (int n = 0; n < 6; n++) {
            lom_texture_desc desc = { .width = sizes[n][0],
                                      .height = sizes[n][1],
                                      .kind = n == 5   ? LOM_TEXTURE_CUBE
                                              : n == 4 ? LOM_TEXTURE_3D
                                                       : LOM_TEXTURE_2D,
                                      .depth = sizes[n][2],
                                      .format = formats[f],
                                      .mips = LOM_MIPS_ALL };
            uint8_t *pixels = random_pixels(formats[f], (size_t)(6 * sizes[n][0] * sizes[n][1] * sizes[n][2]));
            desc.pixels = pixels;
            lom_texture *t = lom_create_texture(&desc, &error);
            CHECK(t != NULL, "%s", error.text);
            for (int level = 1; level < t->level_count; level++)
                check_level(t, level);
            const lom_level *last = &t->level[t->level_count - 1];
            CHECK(last->width == 1 && last->height == 1 && last->depth == 1, "the last level is one texel");
            lom_free_texture(t);
            free(pixels);
        }
}

/* Noise around 127 keeps its mean from level to level: rounding halves up would add 1/8 of a code each. */
static void levels_do_not_brighten(void)
{
    static uint8_t pixels[256 * 256];
    for (int i = 0; i < 256 * 256; i++)
        pixels[i] = (uint8_t)(120 + lom_random_bits(4, (uint64_t)i) % 15);
    lom_texture *t = lom_create_texture(
        &(lom_texture_desc){
            .width = 256, .height = 256, .format = LOM_FORMAT_R8, .pixels = pixels, .mips = LOM_MIPS_ALL },
        &error);
    double mean[9];
    for (int level = 0; level < 7; level++) {
        lom_image *image = lom_read_texture(t, level, 0, &error);
        double sum = 0;
        for (size_t i = 0; i < lom_image_size(image); i++)
            sum += image->pixels[i];
        mean[level] = sum / (double)lom_image_size(image);
        CHECK(fabs(mean[level] - mean[0]) < 0.15, "level %d: mean %g, not %g", level, mean[level], mean[0]);
        lom_free_image(image);
    }
    lom_free_texture(t);
}

static void supplied_levels_are_kept(void)
{
    static const uint8_t zero[16] = { 1, 2, 3, 4, 5, 6, 7, 8 }, one[4] = { 9, 10, 11, 12 };
    const void *levels[1] = { one };
    lom_texture *t = lom_create_texture(&(lom_texture_desc){ .width = 2,
                                                             .height = 2,
                                                             .pixels = zero,
                                                             .mips = LOM_MIPS_SUPPLIED,
                                                             .level_pixels = levels,
                                                             .level_count = 2 },
                                        &error);
    lom_image *image = lom_read_texture(t, 1, 0, &error);
    CHECK(memcmp(image->pixels, one, 4) == 0, "level 1");
    lom_free_image(image);
    CHECK(lom_read_texture(t, 2, 0, &error) == NULL && error.code == LOM_ERROR_USAGE, "no level 2");
    error.code = LOM_OK;
    lom_free_texture(t);
}

/* ---- what a pass does: writes level 0, then finishes ---- */

static void finishing_follows_level_zero(void)
{
    lom_texture *t = lom_create_texture(&(lom_texture_desc){ .width = 2, .height = 2, .mips = LOM_MIPS_ALL }, &error);
    uint32_t *row = lom_texel(t, 0, 0, 0, 0);
    row[0] = row[1] = 0x10203040;
    row = lom_texel(t, 0, 0, 1, 0);
    row[0] = row[1] = 0x10203040;
    lom_finish_texture(t);
    CHECK(*(uint32_t *)lom_texel(t, 1, 0, 0, 0) == 0x10203040, "level 1 is built");
    CHECK(*(uint32_t *)lom_texel(t, 0, -1, -1, 0) == 0x10203040 && *(uint32_t *)lom_texel(t, 0, 2, 2, 0) == 0x10203040,
          "the apron is filled");
    lom_free_texture(t);
}

/* Rows of what a pass may draw into begin with a cache line, at every level, so that tiles of 16 pixels share none. */
static void rows_of_targets_begin_with_a_cache_line(void)
{
    static const lom_format formats[] = { LOM_FORMAT_RGBA8, LOM_FORMAT_DEPTH32F, LOM_FORMAT_RGBA32F };
    for (int f = 0; f < 3; f++)
        for (int width = 1; width < 1100; width += width < 40 ? 1 : 53) {
            lom_texture *t = lom_create_texture(
                &(lom_texture_desc){ .width = width, .height = 5, .format = formats[f], .mips = LOM_MIPS_ALL }, &error);
            for (int level = 0; level < t->level_count; level++)
                for (int y = 0; y < t->level[level].height; y++)
                    CHECK((uintptr_t)lom_texel(t, level, 0, y, 0) % 64 == 0, "row %d of level %d, %d wide", y, level,
                          width);
            CHECK(t->level[0].pitch * lom_texel_size(t) % 1024 != 0, "%d wide: rows share few sets of a cache", width);
            lom_free_texture(t);
        }
}

/* ---- new pixels into a texture ---- */

static void check_same_texels(const lom_texture *a, const lom_texture *b, const char *what)
{
    const char *format = lom_describe_format(b->format)->name;
    CHECK(a->texel_count == b->texel_count && memcmp(a->texels, b->texels, b->texel_count * lom_texel_size(b)) == 0,
          "%s: %s kind %d: texels of another texture", what, format, (int)b->kind);
    CHECK((a->decoded == NULL) == (b->decoded == NULL) &&
              (b->decoded == NULL || memcmp(a->decoded, b->decoded, b->texel_count * 4 * sizeof(float)) == 0),
          "%s: %s kind %d: other decoded texels", what, format, (int)b->kind);
}

/* 70 wide: more texels than are converted together. */
static void updated_textures_are_new_ones(void)
{
    for (int format = 1; format < LOM_FORMAT_COUNT; format++)
        for (int kind = 0; kind < 3; kind++)
            for (int mips = LOM_MIPS_NONE; mips <= LOM_MIPS_ALL; mips++) {
                lom_texture_desc desc = { .kind = kind, .width = 70, .height = 70, .format = format, .mips = mips };
                desc.depth = kind == LOM_TEXTURE_3D ? 5 : 0;
                desc.sampler.wrap_s = LOM_WRAP_CLAMP;
                desc.sampler.wrap_t = LOM_WRAP_BORDER;
                size_t count = 70 * 70 * (kind == LOM_TEXTURE_3D ? 5 : kind == LOM_TEXTURE_CUBE ? 6 : 1);
                size_t size = count * lom_format_size(format);
                uint8_t *first = random_pixels(format, count), *second = malloc(size);
                for (size_t i = 0; i < count; i++) /* in another order */
                    memcpy(second + i * lom_format_size(format), first + (count - 1 - i) * lom_format_size(format),
                           lom_format_size(format));
                desc.pixels = first;
                lom_texture *one = lom_create_texture(&desc, &error);
                lom_texture *same = lom_create_texture(&desc, &error);
                desc.pixels = second;
                lom_texture *other = lom_create_texture(&desc, &error);
                CHECK(memcmp(one->texels, other->texels, one->texel_count * lom_texel_size(one)) != 0, "no change");
                CHECK(lom_store_texture(one, second, size, &error), "%s", error.text);
                check_same_texels(one, other, "second pixels");
                CHECK(lom_store_texture(one, first, size, &error), "%s", error.text);
                check_same_texels(one, same, "first pixels again");
                lom_free_texture(one);
                lom_free_texture(same);
                lom_free_texture(other);
                free(first);
                free(second);
            }
}

/* Refused, and nothing is changed. */
static void updates_of_another_size_are_refused(void)
{
    static const uint8_t pixels[64] = { 1, 2, 3 }, others[65] = { 9, 9 };
    const void *levels[2] = { pixels, pixels };
    lom_texture_desc desc = { .width = 4, .height = 4, .pixels = pixels, .mips = LOM_MIPS_ALL };
    lom_texture *built = lom_create_texture(&desc, &error), *same = lom_create_texture(&desc, &error);
    desc.mips = LOM_MIPS_SUPPLIED;
    desc.level_pixels = levels;
    desc.level_count = 3;
    lom_texture *supplied = lom_create_texture(&desc, &error);
    const struct {
        lom_texture *texture;
        const void *pixels;
        size_t size;
    } wrong[] = { { built, others, 63 }, { built, others, 65 }, { built, others, 0 },    { built, others, SIZE_MAX },
                  { built, NULL, 64 },   { NULL, others, 64 },  { supplied, others, 64 } };
    for (int i = 0; i < (int)(sizeof wrong / sizeof *wrong); i++) {
        lom_error why = { 0 };
        CHECK(!lom_store_texture(wrong[i].texture, wrong[i].pixels, wrong[i].size, &why) &&
                  why.code == LOM_ERROR_USAGE && why.text[0] != 0,
              "update %d: \"%s\"", i, why.text);
    }
    check_same_texels(built, same, "refused updates");
    lom_free_texture(built);
    lom_free_texture(same);
    lom_free_texture(supplied);
}

static void floats_are_kept_finite(void)
{
    const float pixels[4] = { NAN, INFINITY, -INFINITY, 1 };
    lom_texture *t = lom_create_texture(
        &(lom_texture_desc){ .width = 4, .height = 1, .format = LOM_FORMAT_R32F, .pixels = pixels }, &error);
    const float *texel = lom_texel(t, 0, 0, 0, 0);
    CHECK(texel[0] == 0 && texel[1] == 0x1p123f && texel[2] == -0x1p123f && texel[3] == 1, "%g %g %g", (double)texel[0],
          (double)texel[1], (double)texel[2]);
    lom_free_texture(t);
}

static void bad_descriptors_are_refused(void)
{
    static const lom_texture_desc bad[] = {
        { .width = 0, .height = 1 },
        { .width = 1, .height = -1 },
        { .width = 32769, .height = 1 },
        { .width = 1, .height = 1, .depth = 2 },
        { .width = 2, .height = 1, .kind = LOM_TEXTURE_CUBE },
        { .width = 1, .height = 1, .kind = LOM_TEXTURE_3D },
        { .width = 1, .height = 1, .kind = LOM_TEXTURE_KIND_COUNT },
        { .width = 1, .height = 1, .format = LOM_FORMAT_COUNT },
        { .width = 1, .height = 1, .mips = 7 },
        { .width = 4, .height = 4, .mips = LOM_MIPS_SUPPLIED, .level_count = 4 },
        { .width = 4, .height = 4, .mips = LOM_MIPS_SUPPLIED, .level_count = 3 },
        { .width = 1, .height = 1, .sampler = { .magnify = LOM_FILTER_LINEAR_MIPMAP_LINEAR } },
        { .width = 1, .height = 1, .sampler = { .wrap_s = LOM_WRAP_COUNT } },
        { .width = 32768, .height = 32768, .depth = 32768, .kind = LOM_TEXTURE_3D },
        { .width = 32768, .height = 32768, .kind = LOM_TEXTURE_CUBE },
        { .width = 1, .height = 1, .sampler = { .lod_bias = NAN } },
        { .width = 1, .height = 1, .sampler = { .lod_min = NAN } },
        { .width = 1, .height = 1, .sampler = { .lod_max = NAN } },
    };
    for (int i = 0; i < (int)(sizeof bad / sizeof *bad); i++) {
        lom_error why = { 0 };
        CHECK(lom_create_texture(&bad[i], &why) == NULL && why.code != LOM_OK && why.text[0] != 0, "descriptor %d", i);
        CHECK(lom_create_texture(&bad[i], NULL) == NULL, "descriptor %d without an error", i);
    }
    lom_free_texture(NULL);
}

/* How many of the 64 sets of a cache with 4096 bytes a way hold the beginnings of 64 rows. */
static int sets_of_rows(const lom_texture *texture)
{
    uint64_t sets = 0;
    int count = 0;
    for (size_t row = 0; row < 64; row++)
        sets |= UINT64_C(1) << (row * texture->level[0].pitch * lom_texel_size(texture) / 64 % 64);
    for (; sets != 0; sets &= sets - 1)
        count++;
    return count;
}

static void rows_lie_in_many_sets_of_a_cache(void)
{
    const lom_format formats[] = { LOM_FORMAT_RGBA8, LOM_FORMAT_RGBA32F };
    const uint32_t pixels[2200 * 4] = { 0 };
    for (int i = 0; i < 2; i++)
        for (int width = 256; width <= 2200; width++) {
            lom_texture *texture = lom_create_texture(
                &(lom_texture_desc){ .width = width, .height = 1, .format = formats[i], .pixels = pixels }, NULL);
            CHECK(texture->level[0].pitch >= (size_t)width + 2, "width %d", width);
            CHECK(sets_of_rows(texture) == 64, "width %d: %d sets", width, sets_of_rows(texture));
            lom_free_texture(texture);
        }
}

int main(int argc, char **argv)
{
    RUN(every_format_comes_back);
    RUN(mip_levels_are_area_means);
    RUN(levels_do_not_brighten);
    RUN(supplied_levels_are_kept);
    RUN(finishing_follows_level_zero);
    RUN(rows_of_targets_begin_with_a_cache_line);
    RUN(rows_lie_in_many_sets_of_a_cache);
    RUN(updated_textures_are_new_ones);
    RUN(updates_of_another_size_are_refused);
    RUN(floats_are_kept_finite);
    RUN(bad_descriptors_are_refused);
    return check_result();
}
