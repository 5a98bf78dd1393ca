/* Block compression, decoded (blocks.h). In: a block of 8 or 16 bytes, any bytes. Out: its 16 texels. Invariant: every
 * byte pattern is a block. */
#include "blocks.h"

#include "bytes.h"

#include <stdbool.h>

/* 255 numerator / denominator to the nearest integer, a half upwards. */
static uint8_t round_to_byte(uint32_t numerator, uint32_t denominator)
{
    return (uint8_t)((2 * 255 * numerator + denominator) / (2 * denominator));
}

/* ---- colours ---- */

static void make_palette(const uint8_t *block, bool four, uint8_t palette[4][4])
{
    static const struct {
        uint32_t shift, most;
    } channels[3] = { { 11, 31 }, { 5, 63 }, { 0, 31 } };
    uint32_t ends[2] = { load_16_little(block), load_16_little(block + 2) };
    four = four || ends[0] > ends[1];
    for (int c = 0; c < 3; c++) {
        uint32_t most = channels[c].most;
        uint32_t a = ends[0] >> channels[c].shift & most, b = ends[1] >> channels[c].shift & most;
        palette[0][c] = round_to_byte(a, most);
        palette[1][c] = round_to_byte(b, most);
        palette[2][c] = four ? round_to_byte(2 * a + b, 3 * most) : round_to_byte(a + b, 2 * most);
        palette[3][c] = four ? round_to_byte(a + 2 * b, 3 * most) : 0;
    }
    for (int i = 0; i < 4; i++)
        palette[i][3] = i < 3 || four ? 255 : 0;
}

/* The first `channels` of 4 of each texel. */
static void decode_colors(const uint8_t *block, bool four, int channels, uint8_t *texels)
{
    uint8_t palette[4][4];
    make_palette(block, four, palette);
    uint32_t indices = load_32_little(block + 4);
    for (int i = 0; i < 16; i++, indices >>= 2)
        for (int c = 0; c < channels; c++)
            *texels++ = palette[indices & 3][c];
}

/* ---- one channel ---- */

/* The weights of end 0 and end 1 in palette entry i, of `steps` in all. */
static int weigh(int end_0, int end_1, int steps, int i)
{
    return i < 2 ? (i == 0 ? end_0 : end_1) * steps : end_0 * (steps + 1 - i) + end_1 * (i - 1);
}

static uint64_t load_indices(const uint8_t *block)
{
    return load_64_little(block) >> 16;
}

static void decode_channel(const uint8_t *block, int step, uint8_t *texels)
{
    uint8_t palette[8] = { [6] = 0, [7] = 255 };
    int steps = block[0] > block[1] ? 7 : 5;
    for (int i = 0; i < steps + 1; i++)
        palette[i] = round_to_byte((uint32_t)weigh(block[0], block[1], steps, i), 255 * (uint32_t)steps);
    uint64_t indices = load_indices(block);
    for (int i = 0; i < 16; i++, indices >>= 3)
        texels[step * i] = palette[indices & 7];
}

static int signed_end(uint8_t byte)
{
    int value = byte < 128 ? byte : byte - 256;
    return value > -127 ? value : -127;
}

static void decode_signed_channel(const uint8_t *block, int step, float *texels)
{
    float palette[8] = { [6] = -1, [7] = 1 };
    int ends[2] = { signed_end(block[0]), signed_end(block[1]) }, steps = ends[0] > ends[1] ? 7 : 5;
    for (int i = 0; i < steps + 1; i++)
        palette[i] = (float)weigh(ends[0], ends[1], steps, i) / (float)(127 * steps);
    uint64_t indices = load_indices(block);
    for (int i = 0; i < 16; i++, indices >>= 3)
        texels[step * i] = palette[indices & 7];
}

/* ---- blocks ---- */

void lom_decode_bc1_rgb(const uint8_t *block, void *texels)
{
    decode_colors(block, false, 3, texels);
}

void lom_decode_bc1(const uint8_t *block, void *texels)
{
    decode_colors(block, false, 4, texels);
}

void lom_decode_bc2(const uint8_t *block, void *texels)
{
    uint8_t *to = texels;
    decode_colors(block + 8, true, 4, to);
    uint64_t alpha = load_64_little(block);
    for (int i = 0; i < 16; i++, alpha >>= 4)
        to[4 * i + 3] = (uint8_t)((alpha & 15) * 17);
}

void lom_decode_bc3(const uint8_t *block, void *texels)
{
    uint8_t *to = texels;
    decode_colors(block + 8, true, 4, to);
    decode_channel(block, 4, to + 3);
}

void lom_decode_bc4(const uint8_t *block, void *texels)
{
    decode_channel(block, 1, texels);
}

void lom_decode_bc5(const uint8_t *block, void *texels)
{
    uint8_t *to = texels;
    decode_channel(block, 2, to);
    decode_channel(block + 8, 2, to + 1);
}

void lom_decode_bc4_signed(const uint8_t *block, void *texels)
{
    decode_signed_channel(block, 1, texels);
}

void lom_decode_bc5_signed(const uint8_t *block, void *texels)
{
    float *to = texels;
    decode_signed_channel(block, 2, to);
    decode_signed_channel(block + 8, 2, to + 1);
}
