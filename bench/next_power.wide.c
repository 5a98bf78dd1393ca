/* The next power of two by saturating bits, as lom does it, and by logarithms: seconds for the sizes of plates of 1 to
 * 100 clouds, as CSV. It also checks that both agree. */
#include "cloud/impostor.h"

#include <math.h>
#include <stdio.h>
#include <time.h>

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static uint32_t by_logarithm(uint32_t n)
{
    return (uint32_t)pow(2, ceil(log(n) / log(2)));
}

enum { ROUNDS = 200000, REPEATS = 5 };

/* Nanoseconds for one frame's `count` plates: the least of a few repeats. */
static double measure(uint32_t (*function)(uint32_t), int count, uint32_t *sum)
{
    double least = 1e9;
    for (int repeat = 0; repeat < REPEATS; repeat++) {
        double start = now();
        for (int round = 0; round < ROUNDS / count; round++)
            for (int i = 0; i < count; i++)
                *sum += function((uint32_t)(5 + (i * 7 + round) % 59));
        double each = (now() - start) / (ROUNDS / count) * 1e9;
        least = each < least ? each : least;
    }
    return least;
}

int main(void)
{
    static const int counts[] = { 1, 10, 20, 40, 60, 80, 100 };
    uint32_t sum = 0;
    for (uint32_t n = 5; n < 64; n++)
        if (by_logarithm(n) != lom_next_power_of_two(n)) {
            printf("%u: %u by logarithm, %u by bits\n", n, by_logarithm(n), lom_next_power_of_two(n));
            return 1;
        }
    printf("clouds,by logarithm ns,by saturation ns\n");
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++)
        printf("%d,%.1f,%.1f\n", counts[i], measure(by_logarithm, counts[i], &sum),
               measure(lom_next_power_of_two, counts[i], &sum));
    return sum == 0;
}
