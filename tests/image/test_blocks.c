/* Block compression. Oracle: the palettes of Khronos Data Format 1.3 as exact fractions, worked out here from the bits
 * one by one; a texel must be the nearest number to its fraction, which integers decide. Proves: every pair of end
 * points of every channel gives the nearest bytes (signed: floats), in both modes; every texel takes its own index;
 * black of three colours is transparent where there is alpha and opaque where there is none. */
#include "coded_files.h"

#include <math.h>

/* The picture of these blocks, `across` of them side by side in rows. */
static lom_image *decode_blocks(const char *code, const uint8_t *blocks, size_t size, int across, int down)
{
    coded_file file =
        begin_dds(&(dds_fields){ .width = (uint32_t)across * 4, .height = (uint32_t)down * 4, .code = code });
    append_bytes(&file, blocks, size);
    lom_error error = { 0 };
    lom_image *image = lom_decode_image(file.data, file.size, "blocks.dds", &error);
    CHECK(image != NULL, "%s: %s", code, error.text);
    free(file.data);
    return image;
}

static const void *texel(const lom_image *image, int block, int i)
{
    int across = image->width / 4;
    return lom_image_pixel(image, block % across * 4 + i % 4, block / across * 4 + i / 4, 0);
}

/* Bits first .. first + count - 1 of little-endian bytes. */
static int bits_of(const uint8_t *bytes, int first, int count)
{
    int value = 0;
    for (int i = 0; i < count; i++)
        value |= (bytes[(first + i) / 8] >> (first + i) % 8 & 1) << i;
    return value;
}

typedef struct fraction {
    int64_t above, below;
} fraction;

/* Whether 255 f is nearest to byte; a tie goes up, which is to the even one (127.5 is the only tie). */
static bool is_nearest(int byte, fraction f)
{
    int64_t distance = 2 * (byte * f.below - 255 * f.above);
    return distance > -f.below && distance <= f.below;
}

/* Channel c of texel i by a colour block. */
static fraction color_of(const uint8_t *block, bool four, int i, int c)
{
    static const int first[3] = { 11, 5, 0 }, count[3] = { 5, 6, 5 };
    int a = bits_of(block, first[c], count[c]), b = bits_of(block + 2, first[c], count[c]), most = (1 << count[c]) - 1;
    bool mode = four || bits_of(block, 0, 16) > bits_of(block + 2, 0, 16);
    switch (bits_of(block + 4, 2 * i, 2)) {
    case 0:
        return (fraction){ a, most };
    case 1:
        return (fraction){ b, most };
    case 2:
        return mode ? (fraction){ 2 * a + b, 3 * most } : (fraction){ a + b, 2 * most };
    default:
        return mode ? (fraction){ a + 2 * b, 3 * most } : (fraction){ 0, 1 };
    }
}

/* A channel block: end points a and b, of which `most` is 1. */
static fraction channel_of(const uint8_t *block, int a, int b, int most, int lowest, int i)
{
    int index = bits_of(block + 2, 3 * i, 3);
    if (index < 2)
        return (fraction){ index == 0 ? a : b, most };
    if (a > b)
        return (fraction){ (8 - index) * a + (index - 1) * b, 7 * most };
    if (index < 6)
        return (fraction){ (6 - index) * a + (index - 1) * b, 5 * most };
    return (fraction){ index == 6 ? lowest : 1, 1 };
}

enum { BLOCKS = 4096, SIDE = 64 };

/* Colour blocks over every pair of 5-bit and of 6-bit end points, in both orders, with any indices. */
static void fill_color_blocks(uint8_t *blocks, size_t stride)
{
    for (int k = 0; k < BLOCKS; k++) {
        uint8_t *block = blocks + stride * (size_t)k;
        int g0 = k % 64, g1 = k / 64, r0 = k % 32, r1 = k / 32 % 32, b0 = 31 - r0, b1 = (r1 + k / 1024) % 32;
        int ends[2] = { r0 << 11 | g0 << 5 | b0, r1 << 11 | g1 << 5 | b1 };
        for (int e = 0; e < 2; e++) {
            block[2 * e] = (uint8_t)ends[e];
            block[2 * e + 1] = (uint8_t)(ends[e] >> 8);
        }
        for (int i = 4; i < 8; i++)
            block[i] = (uint8_t)(lom_random_bits(3, (uint64_t)(8 * k + i)) >> 5);
        block[4] = 0xe4; /* all four indices */
    }
}

static void colors_of_bc1(void)
{
    static uint8_t blocks[8 * BLOCKS];
    fill_color_blocks(blocks, 8);
    lom_image *image = decode_blocks("DXT1", blocks, sizeof blocks, SIDE, SIDE);
    int transparent = 0;
    for (int k = 0; k < BLOCKS && image != NULL; k++)
        for (int i = 0; i < 16; i++) {
            const uint8_t *block = blocks + 8 * k, *rgba = texel(image, k, i);
            bool three = bits_of(block, 0, 16) <= bits_of(block + 2, 0, 16);
            int alpha = three && bits_of(block + 4, 2 * i, 2) == 3 ? 0 : 255;
            for (int c = 0; c < 3; c++)
                CHECK(is_nearest(rgba[c], color_of(block, false, i, c)), "block %d texel %d channel %d: %d", k, i, c,
                      rgba[c]);
            CHECK(rgba[3] == alpha, "block %d texel %d: alpha %d", k, i, rgba[3]);
            transparent += alpha == 0;
        }
    CHECK(transparent > 1000, "%d", transparent);
    lom_free_image(image);
}

static void colors_and_alpha_of_bc2_and_bc3(void)
{
    static uint8_t blocks[16 * BLOCKS];
    for (size_t i = 0; i < sizeof blocks; i++)
        blocks[i] = (uint8_t)(lom_random_bits(4, i) >> 7);
    fill_color_blocks(blocks + 8, 16);
    lom_image *bc2 = decode_blocks("DXT3", blocks, sizeof blocks, SIDE, SIDE);
    lom_image *bc3 = decode_blocks("DXT5", blocks, sizeof blocks, SIDE, SIDE);
    for (int k = 0; k < BLOCKS && bc2 != NULL && bc3 != NULL; k++)
        for (int i = 0; i < 16; i++) {
            const uint8_t *block = blocks + 16 * k, *a = texel(bc2, k, i), *b = texel(bc3, k, i);
            for (int c = 0; c < 3; c++)
                CHECK(is_nearest(a[c], color_of(block + 8, true, i, c)) && a[c] == b[c], "block %d texel %d", k, i);
            CHECK(a[3] == bits_of(block, 4 * i, 4) * 17, "block %d texel %d: alpha %d", k, i, a[3]);
            CHECK(is_nearest(b[3], channel_of(block, block[0], block[1], 255, 0, i)), "block %d texel %d: alpha %d", k,
                  i, b[3]);
        }
    lom_free_image(bc2);
    lom_free_image(bc3);
}

/* A block for each pair of end points, whose texels have all eight indices. */
static uint8_t *all_channel_blocks(void)
{
    uint8_t *blocks = malloc(8 * 65536);
    for (int k = 0; k < 65536; k++) {
        uint8_t *block = blocks + 8 * k;
        uint64_t indices = 0;
        for (int i = 0; i < 16; i++)
            indices |= (uint64_t)((i + k) % 8) << 3 * i;
        block[0] = (uint8_t)k;
        block[1] = (uint8_t)(k >> 8);
        for (int i = 0; i < 6; i++)
            block[2 + i] = (uint8_t)(indices >> 8 * i);
    }
    return blocks;
}

static void every_pair_of_bc4(void)
{
    uint8_t *blocks = all_channel_blocks();
    lom_image *image = decode_blocks("BC4U", blocks, 8 * 65536, 256, 256);
    for (int k = 0; k < 65536 && image != NULL; k++)
        for (int i = 0; i < 16; i++) {
            const uint8_t *block = blocks + 8 * k, *value = texel(image, k, i);
            CHECK(is_nearest(*value, channel_of(block, block[0], block[1], 255, 0, i)), "ends %d %d texel %d: %d",
                  block[0], block[1], i, *value);
        }
    lom_free_image(image);
    free(blocks);
}

/* Signed: the float nearest to the fraction: no neighbour is nearer, which doubles decide (a fraction over 889 is never
 * within 2^-34 of the middle of two floats). */
static void every_pair_of_signed_bc4(void)
{
    uint8_t *blocks = all_channel_blocks();
    lom_image *image = decode_blocks("BC4S", blocks, 8 * 65536, 256, 256);
    for (int k = 0; k < 65536 && image != NULL; k++) {
        const uint8_t *block = blocks + 8 * k;
        int ends[2];
        for (int e = 0; e < 2; e++) {
            ends[e] = block[e] > 127 ? block[e] - 256 : block[e];
            ends[e] = ends[e] == -128 ? -127 : ends[e];
        }
        for (int i = 0; i < 16; i++) {
            float value = *(const float *)texel(image, k, i);
            fraction f = channel_of(block, ends[0], ends[1], 127, -1, i);
            double exact = (double)f.above / (double)f.below;
            double off = fabs((double)value - exact);
            CHECK(off <= fabs((double)nextafterf(value, 2) - exact) &&
                      off <= fabs((double)nextafterf(value, -2) - exact),
                  "ends %d %d texel %d: %.9g", ends[0], ends[1], i, (double)value);
        }
    }
    lom_free_image(image);
    free(blocks);
}

/* Two channels are two blocks of one. */
static void bc5_is_twice_bc4(void)
{
    static uint8_t blocks[16 * 256], halves[2][8 * 256];
    for (size_t i = 0; i < sizeof blocks; i++) {
        blocks[i] = (uint8_t)(lom_random_bits(6, i) >> 7);
        halves[i / 8 % 2][i / 16 * 8 + i % 8] = blocks[i];
    }
    const char *codes[2][2] = { { "BC5U", "BC4U" }, { "BC5S", "BC4S" } };
    for (int kind = 0; kind < 2; kind++) {
        lom_image *both = decode_blocks(codes[kind][0], blocks, sizeof blocks, 16, 16);
        lom_image *red = decode_blocks(codes[kind][1], halves[0], sizeof halves[0], 16, 16);
        lom_image *green = decode_blocks(codes[kind][1], halves[1], sizeof halves[1], 16, 16);
        size_t size = kind == 0 ? 1 : 4;
        for (size_t i = 0; i < 64 * 64; i++)
            CHECK(memcmp(both->pixels + 2 * size * i, red->pixels + size * i, size) == 0 &&
                      memcmp(both->pixels + 2 * size * i + size, green->pixels + size * i, size) == 0,
                  "%s: texel %zu", codes[kind][0], i);
        lom_free_image(both);
        lom_free_image(red);
        lom_free_image(green);
    }
}

/* KTX has BC1 without alpha: the same colours, and black is opaque. */
static void bc1_without_alpha(void)
{
    static uint8_t blocks[8 * BLOCKS];
    fill_color_blocks(blocks, 8);
    lom_image *with = decode_blocks("DXT1", blocks, sizeof blocks, SIDE, SIDE);
    coded_file file = begin_ktx(&(ktx_fields){ .type_size = 1,
                                               .internal = 0x83f0,
                                               .base = 0x1907,
                                               .width = 4 * SIDE,
                                               .height = 4 * SIDE,
                                               .faces = 1,
                                               .levels = 1 });
    append_word(&file, sizeof blocks, false);
    append_bytes(&file, blocks, sizeof blocks);
    lom_error error = { 0 };
    lom_image *without = lom_decode_image(file.data, file.size, "blocks.ktx", &error);
    CHECK(without != NULL && without->format == LOM_FORMAT_RGB8, "%s", error.text);
    for (size_t i = 0; without != NULL && i < 16 * BLOCKS; i++)
        CHECK(memcmp(with->pixels + 4 * i, without->pixels + 3 * i, 3) == 0, "texel %zu", i);
    lom_free_image(with);
    lom_free_image(without);
    free(file.data);
}

int main(int argc, char **argv)
{
    RUN(colors_of_bc1);
    RUN(colors_and_alpha_of_bc2_and_bc3);
    RUN(every_pair_of_bc4);
    RUN(every_pair_of_signed_bc4);
    RUN(bc5_is_twice_bc4);
    RUN(bc1_without_alpha);
    return check_result();
}
