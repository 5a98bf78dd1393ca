/* The filters of PNG's rows, undone. In: a filtered row and the row above it; out: the row, in place. Invariant: a byte
 * is what section 9.2 says, modulo 256; the bytes of a pixel, which do not depend on one another, are taken together.
 * Compiled for speed. */
#include "png.h"

#include <string.h>

/* Up to 8 bytes of a pixel as 16-bit numbers. */
typedef uint8_t pixel_bytes __attribute__((vector_size(8)));
typedef int16_t pixel_numbers __attribute__((vector_size(16)));

static inline pixel_numbers load(const uint8_t *from)
{
    pixel_bytes bytes;
    memcpy(&bytes, from, sizeof bytes);
    return __builtin_convertvector(bytes, pixel_numbers);
}

static inline void store(uint8_t *to, pixel_numbers numbers, size_t step)
{
    pixel_bytes bytes = __builtin_convertvector(numbers, pixel_bytes);
    memcpy(to, &bytes, step);
}

static inline pixel_numbers magnitude(pixel_numbers v)
{
    pixel_numbers sign = v >> 15;
    return (v ^ sign) - sign;
}

/* png_paeth of every byte. */
static inline pixel_numbers paeth(pixel_numbers left, pixel_numbers above, pixel_numbers corner)
{
    pixel_numbers down = above - corner, across = left - corner;
    pixel_numbers to_left = magnitude(down), to_above = magnitude(across), to_corner = magnitude(down + across);
    pixel_numbers other_is_above = to_above <= to_corner;
    pixel_numbers is_left = (to_left <= to_above) & (to_left <= to_corner);
    pixel_numbers other = (above & other_is_above) | (corner & ~other_is_above);
    return (left & is_left) | (other & ~is_left);
}

static inline pixel_numbers average(pixel_numbers left, pixel_numbers above, pixel_numbers corner)
{
    (void)corner;
    return (left + above) >> 1;
}

static inline pixel_numbers sub(pixel_numbers left, pixel_numbers above, pixel_numbers corner)
{
    (void)above;
    (void)corner;
    return left;
}

typedef pixel_numbers predict(pixel_numbers left, pixel_numbers above, pixel_numbers corner);

/* Whole pixels for as long as 8 bytes may be read from each; how many bytes that were. */
static inline size_t unfilter_pixels(uint8_t *row, const uint8_t *above, size_t size, size_t step, predict *guess)
{
    const pixel_numbers low = (pixel_numbers){ 0 } + 255;
    pixel_numbers left = { 0 }, corner = { 0 };
    size_t i = 0;
    for (; size - i >= sizeof(pixel_bytes); i += step) {
        pixel_numbers up = load(above + i);
        left = (load(row + i) + guess(left, up, corner)) & low;
        store(row + i, left, step);
        corner = up;
    }
    return i;
}

/* The same for the usual sizes of a pixel, each a loop of its own. */
static inline size_t unfilter_most(uint8_t *row, const uint8_t *above, size_t size, size_t step, predict *guess)
{
    switch (step) {
    case 2:
        return unfilter_pixels(row, above, size, 2, guess);
    case 3:
        return unfilter_pixels(row, above, size, 3, guess);
    case 4:
        return unfilter_pixels(row, above, size, 4, guess);
    case 6:
        return unfilter_pixels(row, above, size, 6, guess);
    case 8:
        return unfilter_pixels(row, above, size, 8, guess);
    default:
        return 0;
    }
}

bool lom_png_unfilter(uint8_t *row, const uint8_t *above, size_t size, size_t step, int filter)
{
    size_t i;
    switch (filter) {
    case PNG_NONE:
        return true;
    case PNG_SUB:
        for (i = unfilter_most(row, above, size, step, sub); i < size; i++)
            row[i] = (uint8_t)(row[i] + (i < step ? 0 : row[i - step]));
        return true;
    case PNG_UP:
        for (i = 0; i < size; i++)
            row[i] = (uint8_t)(row[i] + above[i]);
        return true;
    case PNG_AVERAGE:
        for (i = unfilter_most(row, above, size, step, average); i < size; i++)
            row[i] = (uint8_t)(row[i] + ((i < step ? 0 : row[i - step]) + above[i]) / 2);
        return true;
    case PNG_PAETH:
        for (i = unfilter_most(row, above, size, step, paeth); i < size; i++)
            row[i] = (uint8_t)(row[i] + (i < step ? above[i] : png_paeth(row[i - step], above[i], above[i - step])));
        return true;
    default:
        return false;
    }
}
