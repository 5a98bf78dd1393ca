/* Stage 7 of 7 where pixels have several samples, its end. In: the samples of a tile. Out: the means of colours in the tile's
 * images, and the depths of the first samples.
 *
 * Invariant: a pixel's texel depends on its samples alone; those of an undivided block are all its image's. */
#include "pipeline/packet.h"

/* Of `count` values, a power of two, added in pairs; they are overwritten. */
LOM_INLINE lom_float mean(lom_float *x, int count)
{
    for (int left = count; left > 1; left /= 2)
        for (int i = 0; i < left / 2; i++)
            x[i] = x[2 * i] + x[2 * i + 1];
    return x[0] * (1.0f / (float)count);
}

/* Two channels of each word, the whole numbers nearest to their means: sums of 16 bytes fit 16 bits. */
static lom_int mean_of_pairs(const lom_int *word, int count, int shift)
{
    lom_int sum = lom_splat_int((count / 2) * 0x10001);
    for (int s = 0; s < count; s++)
        sum += word[s] >> shift & 0xff00ff;
    return (lom_int)((lom_uint)sum >> __builtin_ctz((unsigned)count)) & 0xff00ff;
}

/* Of `count` words of four codes. */
static lom_int mean_of_codes(const lom_int *word, int count, bool srgb)
{
    lom_float light[LOM_MAX_SAMPLES];
    lom_int result = mean_of_pairs(word, count, 0) | mean_of_pairs(word, count, 8) << 8;
    for (int c = 0; c < 3 && srgb; c++) {
        for (int s = 0; s < count; s++)
            light[s] = lom_float_of_srgb8_lanes(word[s] >> 8 * c & 255);
        result = (result & ~(255 << 8 * c)) | lom_srgb8_of_lanes(mean(light, count)) << 8 * c;
    }
    return result;
}

/* A finite float as the attachment's format holds it. */
static lom_float round_to_format(lom_format format, lom_float x)
{
    const lom_format_info *info = lom_describe_format(format);
    if (info->bits == 16)
        return info->is_float ? lom_float_of_half_lanes(lom_half_of_lanes(x))
                              : lom_float_of_unorm_lanes(lom_unorm_of_lanes(x, 65535.0f), 65535.0f);
    return lom_make_finite(x);
}

enum { BLOCKS = LOM_LANES / 4 };

/* Whether none of the blocks of LOM_LANES pixels, from pixel `at` on, is divided, some or all. */
enum { NONE, SOME, ALL };

LOM_INLINE int find_divided(const uint8_t *several, int at)
{
    int count = 0;
    for (int i = 0; i < BLOCKS; i++)
        count += several[at / 4 + i];
    return count == 0 ? NONE : count < BLOCKS ? SOME : ALL;
}

/* The lanes of those that are. */
static lom_mask load_flags(const uint8_t *several, int at)
{
    lom_mask flags = { 0 };
    for (int i = 0; i < LOM_LANES; i++)
        flags[i] = -(int32_t)several[(at + i) >> 2];
    return flags;
}

/* The samples of undivided blocks are not there: their image stays. */
LOM_INLINE void find_mean_codes(const struct lom_pass *pass, const struct lom_tile *tile, int i, int count, bool srgb)
{
    const int pixels = pass->tile * pass->tile, pitch = pass->sample_pitch;
    const uint8_t *several = tile->several[i];
    const float *samples = tile->sample_color[i];
    int32_t *image = tile->color[i];
    for (int at = 0; at < pixels; at += LOM_LANES) {
        const int divided = find_divided(several, at);
        lom_int word[LOM_MAX_SAMPLES];
        if (divided == NONE)
            continue;
        for (int s = 0; s < count; s += 4) {
            lom_float4 rows = lom_gather_rows(samples + at * pitch + s, lom_lane_index() * pitch);
            const lom_float column[4] = { rows.x, rows.y, rows.z, rows.w };
            for (int k = 0; k < 4 && s + k < count; k++)
                word[s + k] = lom_as_int(column[k]);
        }
        lom_int result = mean_of_codes(word, count, srgb);
        if (divided == SOME)
            result = lom_select_int(load_flags(several, at), result, lom_load_int(image + at));
        lom_store_int(image + at, result);
    }
}

static void find_mean_floats(const struct lom_pass *pass, const struct lom_tile *tile, int i)
{
    const int pixels = pass->tile * pass->tile;
    float *image = tile->color[i];
    const float *samples = tile->sample_color[i];
    for (int at = 0; at < 4 * pixels; at += LOM_LANES) {
        lom_float x[LOM_MAX_SAMPLES];
        if (find_divided(tile->several[i], at % pixels) == NONE)
            continue;
        for (int s = 0; s < pass->samples; s++)
            x[s] = lom_load(samples + s * 4 * pixels + at);
        lom_float result = round_to_format(pass->color[i].format, mean(x, pass->samples));
        lom_store(image + at, lom_select(load_flags(tile->several[i], at % pixels), result, lom_load(image + at)));
    }
}

void LOM_WIDE(lom_find_means)(const struct lom_pass *pass, const struct lom_tile *tile, int i)
{
    const bool srgb = pass->color[i].kind == COLOR_SRGB8;
    if (pass->color[i].kind == COLOR_FLOAT)
        find_mean_floats(pass, tile, i);
    else if (pass->samples == 4)
        find_mean_codes(pass, tile, i, 4, srgb);
    else
        find_mean_codes(pass, tile, i, pass->samples, srgb);
}

void LOM_WIDE(lom_take_first)(const uint32_t *from, int pitch, size_t count, uint32_t *to)
{
    const lom_int first = lom_lane_index() * pitch;
    for (size_t i = 0; i < count; i += LOM_LANES)
        lom_store_int((int32_t *)to + i, lom_gather_int((const int32_t *)from + i * (size_t)pitch, first));
}
