/* A mip level from the one above it. In: a level; out: the level of half the size (rounded down, at least 1) whose
 * texels are the means of the areas they cover, in linear light, rounded once to the storage (8 bits: to nearest, ties
 * to even, so that no level is brighter on average).
 *
 * An axis of n = 2m texels covers two texels a texel; n = 2m + 1 covers n/m: texel i of m spans the texels 2i, 2i + 1,
 * 2i + 2 by (m - i), m, (i + 1), in units of 1/m; n = 1 stays. Compiled for speed. */
#include "texture.h"
#include "convert.h"

typedef struct span {
    int first, count;
    uint32_t weight[3]; /* sums to total */
    uint32_t total;
} span;

static span span_of(int n, int i)
{
    uint32_t m = (uint32_t)n / 2, k = (uint32_t)i;
    if (n == 1)
        return (span){ 0, 1, { 1, 0, 0 }, 1 };
    if (n % 2 == 0)
        return (span){ 2 * i, 2, { 1, 1, 0 }, 2 };
    return (span){ 2 * i, 3, { m - k, m, k + 1 }, 2 * m + 1 };
}

/* The channels of a texel, in linear light; bytes that are not sRGB as 0..255. */
static void read_texel(const lom_texture *texture, const void *texel, double channel[4])
{
    if (texture->storage == LOM_STORAGE_RGBA8) {
        uint32_t value;
        memcpy(&value, texel, sizeof value);
        for (int c = 0; c < 4; c++) {
            uint32_t code = value >> 8 * c & 255;
            channel[c] = texture->srgb && c < 3 ? lom_srgb_linear[code] : code;
        }
        return;
    }
    float value[4] = { 0 };
    memcpy(value, texel, lom_texel_size(texture));
    for (int c = 0; c < 4; c++)
        channel[c] = value[c];
}

/* sum / total to the nearest integer, ties to even. */
static uint32_t round_quotient(uint64_t sum, uint64_t total)
{
    uint64_t quotient = sum / total, rest = sum % total;
    return (uint32_t)(quotient + (2 * rest > total || (2 * rest == total && quotient % 2 == 1)));
}

static void write_texel(const lom_texture *texture, void *texel, const double sum[4], uint64_t total)
{
    if (texture->storage == LOM_STORAGE_RGBA8) {
        uint32_t value = 0;
        for (int c = 0; c < 4; c++) {
            bool srgb = texture->srgb && c < 3; /* otherwise sum is an integer below 2^40 */
            uint32_t code = srgb ? lom_srgb8_of((float)(sum[c] / (double)total))
                                 : round_quotient((uint64_t)lom_int64_of(sum[c]), total);
            value |= code << 8 * c;
        }
        memcpy(texel, &value, sizeof value);
        return;
    }
    float value[4];
    for (int c = 0; c < 4; c++)
        value[c] = (float)(sum[c] / (double)total);
    memcpy(texel, value, lom_texel_size(texture));
}

static void shrink_texel(lom_texture *texture, int level, int layer, const span *x, const span *y, const span *z,
                         void *to)
{
    double sum[4] = { 0, 0, 0, 0 };
    for (int k = 0; k < z->count; k++)
        for (int j = 0; j < y->count; j++)
            for (int i = 0; i < x->count; i++) {
                double channel[4];
                read_texel(texture, lom_texel(texture, level - 1, x->first + i, y->first + j, layer + z->first + k),
                           channel);
                double weight = (double)x->weight[i] * y->weight[j] * z->weight[k];
                for (int c = 0; c < 4; c++)
                    sum[c] += weight * channel[c];
            }
    write_texel(texture, to, sum, (uint64_t)x->total * y->total * z->total);
}

/* Four linear bytes at once, 2 x 2: two channels in the halves of a word, each sum below 2^10. */
static void shrink_row_of_bytes(const uint32_t *upper, const uint32_t *lower, int width, uint32_t *to)
{
    const uint32_t even = 0x00ff00ff, one = 0x00010001;
    for (int x = 0; x < width; x++) {
        uint32_t a = upper[2 * x], b = upper[2 * x + 1], c = lower[2 * x], d = lower[2 * x + 1];
        uint32_t p = (a & even) + (b & even) + (c & even) + (d & even);
        uint32_t q = (a >> 8 & even) + (b >> 8 & even) + (c >> 8 & even) + (d >> 8 & even);
        p = (p + one + (p >> 2 & one)) >> 2 & even;
        q = (q + one + (q >> 2 & one)) >> 2 & even;
        to[x] = p | q << 8;
    }
}

/* The same of sRGB codes: their light is floats between 2^-12 and 1, of which sums of four are exact in double, whatever
 * their order. */
static void shrink_row_of_srgb(const uint32_t *upper, const uint32_t *lower, int width, uint32_t *to)
{
    for (int x = 0; x < width; x++) {
        const uint32_t a = upper[2 * x], b = upper[2 * x + 1], c = lower[2 * x], d = lower[2 * x + 1];
        const uint32_t alpha = (a >> 24) + (b >> 24) + (c >> 24) + (d >> 24);
        uint32_t texel = (alpha + 1 + (alpha >> 2 & 1)) >> 2 << 24;
        for (int shift = 0; shift < 24; shift += 8) {
            double light = (double)lom_srgb_linear[a >> shift & 255] + (double)lom_srgb_linear[b >> shift & 255];
            light += (double)lom_srgb_linear[c >> shift & 255] + (double)lom_srgb_linear[d >> shift & 255];
            texel |= (uint32_t)lom_srgb8_of((float)(light / 4)) << shift;
        }
        to[x] = texel;
    }
}

/* The same of floats, of so many a texel: means of four in double. */
static void shrink_row_of_floats(const float *upper, const float *lower, int width, int floats, float *to)
{
    for (int x = 0; x < width; x++, upper += 2 * floats, lower += 2 * floats)
        for (int c = 0; c < floats; c++) {
            double sum = 0.0 + (double)upper[c];
            sum = sum + upper[floats + c] + lower[c] + lower[floats + c];
            *to++ = (float)(sum / 4);
        }
}

/* Rows of an even level of two dimensions. */
static void shrink_even_row(const lom_texture *texture, const void *upper, const void *lower, int width, void *to)
{
    switch (texture->storage) {
    case LOM_STORAGE_RGBA8:
        (texture->srgb ? shrink_row_of_srgb : shrink_row_of_bytes)(upper, lower, width, to);
        return;
    case LOM_STORAGE_RGBA32F:
        shrink_row_of_floats(upper, lower, width, 4, to);
        return;
    case LOM_STORAGE_R32F:
        shrink_row_of_floats(upper, lower, width, 1, to);
        return;
    }
}

/* The same of any level of two dimensions: the sums of weighted codes are integers below 2^40. */
static void shrink_odd_row_of_bytes(const lom_texture *texture, int level, int layer, int v, uint32_t *to)
{
    const lom_level *from = &texture->level[level - 1];
    span y = span_of(from->height, v);
    const uint32_t *row[3];
    for (int j = 0; j < y.count; j++)
        row[j] = lom_texel(texture, level - 1, 0, y.first + j, layer);
    for (int u = 0; u < texture->level[level].width; u++) {
        span x = span_of(from->width, u);
        uint64_t sum[4] = { 0, 0, 0, 0 }, total = (uint64_t)x.total * y.total;
        for (int j = 0; j < y.count; j++)
            for (int i = 0; i < x.count; i++) {
                uint32_t texel = row[j][x.first + i];
                uint64_t weight = (uint64_t)x.weight[i] * y.weight[j];
                for (int c = 0; c < 4; c++)
                    sum[c] += weight * (texel >> 8 * c & 255);
            }
        to[u] = 0;
        for (int c = 0; c < 4; c++)
            to[u] |= round_quotient(sum[c], total) << 8 * c;
    }
}

void lom_shrink_rows(lom_texture *texture, int level, int layer, int first, int end)
{
    const lom_level *from = &texture->level[level - 1], *to = &texture->level[level];
    bool deep = texture->kind == LOM_TEXTURE_3D;
    bool even = !deep && from->width % 2 == 0 && from->height % 2 == 0;
    size_t texel = lom_texel_size(texture);
    span z = span_of(deep ? from->depth : 1, deep ? layer : 0);
    for (int v = first; v < end; v++) {
        uint8_t *row = lom_texel(texture, level, 0, v, layer);
        if (even) {
            shrink_even_row(texture, lom_texel(texture, level - 1, 0, 2 * v, layer),
                            lom_texel(texture, level - 1, 0, 2 * v + 1, layer), to->width, row);
            continue;
        }
        if (!deep && !texture->srgb && texture->storage == LOM_STORAGE_RGBA8) {
            shrink_odd_row_of_bytes(texture, level, layer, v, (uint32_t *)(void *)row);
            continue;
        }
        span y = span_of(from->height, v);
        for (int u = 0; u < to->width; u++) {
            span x = span_of(from->width, u);
            shrink_texel(texture, level, deep ? 0 : layer, &x, &y, &z, row + (size_t)u * texel);
        }
    }
}
