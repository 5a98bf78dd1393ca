/* Proves that the table of jitter holds every rank once, belongs to its seed, and is blue: hardly anything of it is
 * slow, so that what it moves does not show as bands or blotches. */
#include "check.h"
#include "cloud/cloud_draw.h"

enum { SIZE = 32, PIXELS = SIZE * SIZE };

static void v18_ranks_are_a_permutation_of_their_seed(void)
{
    float *a = lom_make_blue_noise(SIZE, 1, NULL), *b = lom_make_blue_noise(SIZE, 1, NULL);
    float *other = lom_make_blue_noise(SIZE, 2, NULL);
    int seen[PIXELS] = { 0 };
    for (int i = 0; i < PIXELS; i++) {
        CHECK(a[i] > 0 && a[i] < 1, "%g", a[i]);
        seen[(int)(a[i] * PIXELS)]++;
    }
    for (int i = 0; i < PIXELS; i++)
        CHECK(seen[i] == 1, "rank %d: %d times", i, seen[i]);
    CHECK(memcmp(a, b, PIXELS * sizeof *a) == 0, "differs from itself");
    CHECK(memcmp(a, other, PIXELS * sizeof *a) != 0, "does not follow its seed");
    lom_release(a);
    lom_release(b);
    lom_release(other);
}

/* Power at (u, v) periods a side, over that of white noise: the variance 1/12 times the pixels. */
static double power_at(const float *table, int u, int v)
{
    double re = 0, im = 0;
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++) {
            double turn = 6.283185307179586 * ((u * x + v * y) % SIZE) / SIZE, value = (double)table[y * SIZE + x];
            re += value * lom_double_cos(turn);
            im += value * lom_double_sin(turn);
        }
    return (re * re + im * im) * 12 / PIXELS;
}

static void v18_the_table_is_blue(void)
{
    float *table = lom_make_blue_noise(SIZE, 1, NULL);
    double slow = 0, all = 0;
    int slow_count = 0;
    for (int v = -SIZE / 2; v < SIZE / 2; v++)
        for (int u = 0; u < SIZE / 2; u++) {
            if (u == 0 && v == 0)
                continue;
            double power = power_at(table, u, (v + SIZE) % SIZE);
            all += power;
            if (u * u + v * v <= 16) {
                slow += power;
                slow_count++;
            }
        }
    CHECK(all / (SIZE * SIZE / 2) > 0.9, "%g of white noise in all", all / (SIZE * SIZE / 2));
    CHECK(slow / slow_count < 0.05, "%g of white noise in waves longer than 8 pixels", slow / slow_count);
    lom_release(table);
}

int main(int argc, char **argv)
{
    RUN(v18_ranks_are_a_permutation_of_their_seed);
    RUN(v18_the_table_is_blue);
    return check_result();
}
