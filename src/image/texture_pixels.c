/* Texels from and to pixels. In: tightly packed pixels of a texture's format; out: its texels, the levels made of them,
 * pixels again. Invariant: every float stored here is finite. Nothing is allocated but the picture that is read back.
 * Compiled for speed. */
#include "convert.h"
#include "convert_rows.h"
#include "texture.h"

#include <string.h>

enum { TOGETHER = 64 }; /* texels of the formats that are converted in double */

/* ---- a row ---- */

static inline void pack(int channels, const uint8_t *from, int count, uint32_t *to)
{
    for (int i = 0; i < count; i++, from += channels) {
        uint32_t texel = channels == 4 ? 0 : 0xff000000u;
        for (int c = 0; c < channels; c++)
            texel |= (uint32_t)from[c] << 8 * c;
        to[i] = texel;
    }
}

/* A loop for each number of channels. */
static void pack_bytes(int channels, const uint8_t *from, int count, uint32_t *to)
{
    switch (channels) {
    case 1:
        pack(1, from, count, to);
        return;
    case 2:
        pack(2, from, count, to);
        return;
    case 3:
        pack(3, from, count, to);
        return;
    default:
        pack(4, from, count, to);
        return;
    }
}

/* Four channels are, where the machine puts the low byte first, the words as they lie. */
static void unpack_bytes(int channels, const uint32_t *from, int count, uint8_t *to)
{
    if (channels == 4 && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__) {
        memcpy(to, from, (size_t)count * 4);
        return;
    }
    for (int i = 0; i < count; i++, to += channels)
        for (int c = 0; c < channels; c++)
            to[c] = (uint8_t)(from[i] >> 8 * c);
}

static void pack_floats(int channels, const double (*rgba)[4], int count, float *to)
{
    const double most = 0x1p123;
    for (int i = 0; i < count; i++)
        for (int c = 0; c < channels; c++) {
            double x = rgba[i][c];
            x = x == x ? x : 0;
            *to++ = (float)(x > -most ? (x < most ? x : most) : -most);
        }
}

/* The same of floats as they are. */
static void copy_floats(const float *from, size_t count, float *to)
{
    const float most = 0x1p123f;
    for (size_t i = 0; i < count; i++) {
        float x = from[i] == from[i] ? from[i] : 0;
        to[i] = x > -most ? (x < most ? x : most) : -most;
    }
}

/* The number of floats of a texel; 0 for bytes. */
static int floats_of(const lom_texture *texture)
{
    return texture->storage == LOM_STORAGE_RGBA32F ? 4 : texture->storage == LOM_STORAGE_R32F;
}

static void store_row(const lom_texture *texture, const uint8_t *pixels, int width, void *row)
{
    if (texture->storage == LOM_STORAGE_RGBA8) {
        pack_bytes(lom_describe_format(texture->format)->channels, pixels, width, row);
        return;
    }
    int floats = floats_of(texture);
    if (texture->format == LOM_FORMAT_RGBA32F || texture->format == LOM_FORMAT_R32F) {
        copy_floats((const float *)(const void *)pixels, (size_t)width * (size_t)floats, row);
        return;
    }
    double rgba[TOGETHER][4];
    float *to = row;
    for (int x = 0; x < width; x += TOGETHER) {
        int count = width - x < TOGETHER ? width - x : TOGETHER;
        lom_decode_row(texture->format, pixels, (size_t)count, rgba);
        pack_floats(floats, (const double(*)[4])rgba, count, to);
        pixels += (size_t)count * lom_format_size(texture->format);
        to += count * floats;
    }
}

static void read_row(const lom_texture *texture, const void *row, int width, uint8_t *to)
{
    if (texture->storage == LOM_STORAGE_RGBA8) {
        unpack_bytes(lom_describe_format(texture->format)->channels, row, width, to);
        return;
    }
    if (texture->format == LOM_FORMAT_RGBA32F || texture->format == LOM_FORMAT_R32F) {
        memcpy(to, row, (size_t)width * (size_t)floats_of(texture) * sizeof(float));
        return;
    }
    double rgba[TOGETHER][4];
    const float *from = row;
    lom_format format = texture->storage == LOM_STORAGE_R32F ? LOM_FORMAT_R32F : LOM_FORMAT_RGBA32F;
    for (int x = 0; x < width; x += TOGETHER) {
        int count = width - x < TOGETHER ? width - x : TOGETHER;
        lom_decode_row(format, from, (size_t)count, rgba);
        lom_encode_row(texture->format, (const double(*)[4])rgba, (size_t)count, to);
        from += count * floats_of(texture);
        to += (size_t)count * lom_format_size(texture->format);
    }
}

/* ---- a level ---- */

void lom_store_rows(lom_texture *texture, int level, const void *pixels, int first, int end)
{
    const lom_level *l = &texture->level[level];
    const uint8_t *from = pixels;
    size_t step = (size_t)l->width * lom_format_size(texture->format);
    for (int row = first; row < end; row++)
        store_row(texture, from + (size_t)row * step, l->width,
                  lom_texel(texture, level, 0, row % l->height, row / l->height));
}

void lom_store_level(lom_texture *texture, int level, const void *pixels)
{
    lom_store_rows(texture, level, pixels, 0, texture->level[level].height * lom_level_layers(texture, level));
}

static lom_image *read_level(const lom_texture *texture, int level, int layer, lom_error *error)
{
    if (level < 0 || level >= texture->level_count || layer < -1 || layer >= lom_level_layers(texture, level)) {
        lom_fail(error, LOM_ERROR_USAGE, "The texture has no level %d with a layer %d.", level, layer);
        return NULL;
    }
    const lom_level *l = &texture->level[level];
    int first = layer < 0 ? 0 : layer, count = layer < 0 ? lom_level_layers(texture, level) : 1;
    lom_image *image = lom_create_image(l->width, l->height, count, texture->format, error);
    for (int z = 0; image != NULL && z < count; z++)
        for (int y = 0; y < l->height; y++)
            read_row(texture, lom_texel(texture, level, 0, y, first + z), l->width, lom_image_pixel(image, 0, y, z));
    return image;
}

lom_image *lom_read_texture(const lom_texture *texture, int level, int layer, lom_error *error)
{
    lom_float_state state;
    lom_enter_float_state(&state);
    lom_image *image = read_level(texture, level, layer, error);
    lom_leave_float_state(&state);
    return image;
}

lom_image *lom_read_stencil(const lom_texture *texture, lom_error *error)
{
    if (texture->stencil == NULL) {
        lom_fail(error, LOM_ERROR_USAGE, "The texture has no stencil.");
        return NULL;
    }
    const lom_level *l = &texture->level[0];
    lom_image *image = lom_create_image(l->width, l->height, 1, LOM_FORMAT_R8, error);
    if (image != NULL)
        memcpy(image->pixels, texture->stencil, (size_t)l->width * (size_t)l->height);
    return image;
}

/* ---- the whole ---- */

static uint32_t linear15(uint32_t code)
{
    return (uint32_t)lom_int_of(lom_srgb_linear[code] * LOM_FIXED_LINEAR + 0.5f);
}

static void decode_pairs(const lom_texture *texture, size_t first, size_t end)
{
    const uint32_t *texel = texture->texels;
    uint32_t *to = (uint32_t *)texture->decoded + 2 * first, linear[256];
    for (uint32_t code = 0; code < 256; code++)
        linear[code] = linear15(code);
    for (size_t i = first; i < end; i++, to += 2) {
        to[0] = linear[texel[i] & 255] | linear[texel[i] >> 16 & 255] << 16;
        to[1] = linear[texel[i] >> 8 & 255] | (texel[i] >> 24) << 23;
    }
}

static void decode_floats(const lom_texture *texture, size_t first, size_t end)
{
    const uint32_t *texel = texture->texels;
    float *to = (float *)texture->decoded + 4 * first;
    for (size_t i = first; i < end; i++, to += 4) {
        for (int c = 0; c < 3; c++)
            to[c] = lom_srgb_linear[texel[i] >> 8 * c & 255];
        to[3] = (float)(texel[i] >> 24);
    }
}

void lom_decode_texels(const lom_texture *texture, size_t first, size_t end)
{
    (texture->fixed ? decode_pairs : decode_floats)(texture, first, end);
}

void lom_finish_texture(lom_texture *texture)
{
    for (int i = 0; i < texture->level_count; i++) {
        for (int z = 0; i > 0 && texture->builds_mips && z < lom_level_layers(texture, i); z++)
            lom_shrink_rows(texture, i, z, 0, texture->level[i].height);
        lom_fill_apron(texture, i);
    }
    if (texture->decoded != NULL)
        lom_decode_texels(texture, 0, texture->texel_count);
}

/* Bytes of the pixels of level 0. */
static uint64_t pixel_bytes(const lom_texture *texture)
{
    const lom_level *l = &texture->level[0];
    return (uint64_t)l->width * (uint64_t)l->height * (uint64_t)lom_level_layers(texture, 0) *
           lom_format_size(texture->format);
}

bool lom_check_update(const lom_texture *texture, const void *pixels, size_t size, lom_error *error)
{
    if (texture == NULL || pixels == NULL)
        return lom_fail(error, LOM_ERROR_USAGE, "An update needs a texture and the pixels of its level 0.");
    if (texture->level_count > 1 && !texture->builds_mips)
        return lom_fail(error, LOM_ERROR_USAGE, "A texture whose levels were supplied is made anew, not updated.");
    if (size != pixel_bytes(texture))
        return lom_fail(error, LOM_ERROR_USAGE, "Level 0 of the texture has %llu bytes of pixels, not %zu.",
                        (unsigned long long)pixel_bytes(texture), size);
    return true;
}

bool lom_store_texture(lom_texture *texture, const void *pixels, size_t size, lom_error *error)
{
    if (!lom_check_update(texture, pixels, size, error))
        return false;
    lom_float_state state;
    lom_enter_float_state(&state);
    lom_store_level(texture, 0, pixels);
    lom_finish_texture(texture);
    lom_leave_float_state(&state);
    return true;
}
