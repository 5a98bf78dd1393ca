/* Channels of pixels in 16 bits each, in whatever order a width has them. Oracle: bytes, one at a time. Proves: pixels
 * taken apart and joined are themselves, and alpha is that of its own pixel; whole numbers are narrowed to their pixels,
 * and sums of two channels bounded at 255; v / 255 is rounded to the nearest for every v up to 255^2; a pair of channels
 * goes into all pixels and out of the first. */
#include "lanes/channels.h"

#include <lom/lom.h>

#include "check.h"

static uint32_t byte_of(lom_int pixels, int lane, int c)
{
    return (uint32_t)pixels[lane] >> 8 * c & 255;
}

static void pixels_are_taken_apart_and_joined(void)
{
    for (uint64_t trial = 0; trial < 1000; trial++) {
        lom_int x = { 0 };
        for (int i = 0; i < LOM_LANES; i++)
            x[i] = (int32_t)lom_random_bits(trial, (uint64_t)i);
        struct channels c = split(x), swapped = { c.ga, c.rb };
        pairs alpha = alpha_of(c);
        lom_int same = join(c), other = join(swapped), alphas = join((struct channels){ alpha, alpha });
        pairs red = c.rb & ~second_channels();
        CHECK(lom_all(same == x), "trial %d", (int)trial);
        CHECK(lom_all(join((struct channels){ red, red & 0 }) == (x & 255)), "trial %d: red", (int)trial);
        for (int i = 0; i < LOM_LANES; i++)
            for (int k = 0; k < 4; k++) {
                CHECK(byte_of(other, i, k) == byte_of(x, i, k ^ 1), "trial %d, lane %d", (int)trial, i);
                CHECK(byte_of(alphas, i, k) == byte_of(x, i, 3), "trial %d, lane %d: alpha", (int)trial, i);
            }
    }
}

static void whole_numbers_are_narrowed(void)
{
    for (int base = 0; base < 256; base++) {
        lom_int at = (lom_lane_index() * 37 + base) & 255;
        lom_int c[4] = { at, 255 - at, at ^ 85, at ^ 170 };
        lom_int pixels = join(narrow(c[0], c[1], c[2], c[3]));
        CHECK(lom_all(pixels == (c[0] | c[1] << 8 | c[2] << 16 | c[3] << 24)), "base %d", base);
    }
}

static void sums_are_bounded(void)
{
    for (int sum = 0; sum <= 510; sum++) {
        pairs low = splat_pairs((uint16_t)(sum / 2)), high = splat_pairs((uint16_t)(sum - sum / 2)), x = low + high;
        lom_int bounded = join_bounded((struct channels){ x, x });
        uint32_t expected = (sum < 255 ? (uint32_t)sum : 255) * 0x01010101u;
        CHECK(lom_all(bounded == (int32_t)expected), "%d", sum);
    }
}

static void every_quotient_is_rounded(void)
{
    for (int v = 0; v <= 255 * 255; v++) {
        pairs q = divide_by_255(splat_pairs((uint16_t)v)), expected = splat_pairs((uint16_t)((2 * v + 255) / 510));
        CHECK(memcmp(&q, &expected, sizeof q) == 0, "%d / 255: %d", v, q[0]);
    }
}

static void a_pair_goes_into_all_pixels(void)
{
    pairs x = splat_pair(0x00a10037);
    CHECK(first_pair(x) == 0x00a10037, "%08x", first_pair(x));
    CHECK(lom_all(join((struct channels){ x, x & second_channels() }) == (int32_t)0xa1a10037), "not all alike");
}

int main(int argc, char **argv)
{
    RUN(pixels_are_taken_apart_and_joined);
    RUN(whole_numbers_are_narrowed);
    RUN(sums_are_bounded);
    RUN(every_quotient_is_rounded);
    RUN(a_pair_goes_into_all_pixels);
    return check_result();
}
