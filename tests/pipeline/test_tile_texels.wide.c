/* Proves that texels of four floats go between attachments and tile memory as one by one, bit for bit: rectangles of all
 * sizes from even and odd places of a tile, every number of channels, patterns of bits that are NaN, infinite, denormal
 * and -0 among them; and that nothing beside the rectangle is written. */
#include "../check.h"
#include "pipeline/device.h"
#include "pipeline/variants.h"

enum { EDGE = 64, PITCH = 4 * 71, WORDS = 4 * EDGE * EDGE, TEXELS = PITCH * EDGE };

static uint32_t memory[WORDS], texels[TEXELS], expected_memory[WORDS], expected_texels[TEXELS], state = 1;

static uint32_t next(void)
{
    state = state * 1664525u + 1013904223u;
    return state >> 8 ^ state << 16;
}

static void fill(uint32_t *to, size_t count)
{
    static const uint32_t hostile[] = { 0, 0x80000000u, 0x7f800000u, 0xff800000u, 0x7fc00000u, 0x7f800001u, 1 };
    for (size_t i = 0; i < count; i++)
        to[i] = next() % 4 == 0 ? hostile[next() % 7] : next();
}

static int random_int(int low, int high)
{
    return low + (int)(next() % (uint32_t)(high - low + 1));
}

static struct lom_rectangle random_rectangle(void)
{
    struct lom_rectangle r = { .edge = EDGE, .texels = texels, .pitch = PITCH, .keep = -1 };
    r.x = next() % 2 == 0 ? 0 : random_int(0, EDGE - 1);
    r.y = next() % 2 == 0 ? 0 : random_int(0, EDGE - 1);
    r.width = next() % 4 == 0 ? EDGE - r.x : random_int(1, EDGE - r.x);
    r.height = next() % 4 == 0 ? EDGE - r.y : random_int(1, EDGE - r.y);
    fill(memory, WORDS);
    fill(texels, TEXELS);
    memcpy(expected_memory, memory, sizeof memory);
    memcpy(expected_texels, texels, sizeof texels);
    return r;
}

/* The word of channel c of a pixel of the rectangle, in blocks of 2x2. */
static size_t word_of(const struct lom_rectangle *r, int x, int y, int c)
{
    const int in_x = r->x + x, in_y = r->y + y;
    return (size_t)(c * EDGE * EDGE + (in_y / 2 * (EDGE / 2) + in_x / 2) * 4 + in_y % 2 * 2 + in_x % 2);
}

static void check_both(const struct lom_rectangle *r, int channels, const char *what)
{
    CHECK(memcmp(texels, expected_texels, sizeof texels) == 0 && memcmp(memory, expected_memory, sizeof memory) == 0,
          "%s of %dx%d at %d,%d with %d channels", what, r->width, r->height, r->x, r->y, channels);
}

static void texels_are_stored_as_one_by_one(void)
{
    for (int i = 0; i < 4000; i++) {
        const struct lom_rectangle r = random_rectangle();
        const int channels = random_int(2, 4);
        for (int y = 0; y < r.height; y++)
            for (int x = 0; x < r.width; x++)
                for (int c = 0; c < 4; c++)
                    expected_texels[y * PITCH + 4 * x + c] = c < channels ? memory[word_of(&r, x, y, c)]
                                                             : c == 3     ? 0x3f800000u
                                                                          : 0;
        LOM_WIDE(lom_store_texels)(&r, channels, (const float *)(const void *)memory);
        check_both(&r, channels, "store");
    }
}

static void texels_are_loaded_as_one_by_one(void)
{
    for (int i = 0; i < 4000; i++) {
        const struct lom_rectangle r = random_rectangle();
        for (int y = 0; y < r.height; y++)
            for (int x = 0; x < r.width; x++)
                for (int c = 0; c < 4; c++)
                    expected_memory[word_of(&r, x, y, c)] = texels[y * PITCH + 4 * x + c];
        LOM_WIDE(lom_load_texels)(&r, (float *)(void *)memory);
        check_both(&r, 4, "load");
    }
}

static void texels_are_filled_as_one_by_one(void)
{
    for (int i = 0; i < 4000; i++) {
        const struct lom_rectangle r = random_rectangle();
        uint32_t words[4];
        float texel[4];
        fill(words, 4);
        memcpy(texel, words, sizeof texel);
        for (int y = 0; y < r.height; y++)
            for (int x = 0; x < r.width; x++)
                memcpy(&expected_texels[y * PITCH + 4 * x], words, sizeof words);
        LOM_WIDE(lom_fill_texels)(&r, texel);
        check_both(&r, 4, "fill");
    }
}

int main(int argc, char **argv)
{
    RUN(texels_are_stored_as_one_by_one);
    RUN(texels_are_loaded_as_one_by_one);
    RUN(texels_are_filled_as_one_by_one);
    return check_result();
}
