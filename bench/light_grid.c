/* Milliseconds that a grid of light of 128^3 takes to be swept, one thread: make bench-light-grid. In: a cumulus; out:
 * a row for each way to the sun, along the axes and oblique, with the fastest and the median of many sweeps in
 * processor time. */
#include <lom/cloud.h>
#include <lom/march.h>

#include <stdio.h>
#include <time.h>

enum { SIZE = 128, RUNS = 60 };

static const double ways[][3] = {
    { 1, 0, 0 },  { -1, 0, 0 }, { 0, 1, 0 },   { 0, -1, 0 }, { 0, 0, 1 },    { 0, 0, -1 }, { 8, 4, 3 },
    { -7, 5, 5 }, { 3, 9, 2 },  { -5, 7, -4 }, { 2, 3, 9 },  { -4, -3, -8 }, { 1, 1, 1 },
};

static double now_ms(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec * 1e3 + (double)t.tv_nsec * 1e-6;
}

/* Insertion: there are few. */
static void sort(double times[RUNS])
{
    for (int i = 1; i < RUNS; i++) {
        double time = times[i];
        int j = i;
        for (; j > 0 && times[j - 1] > time; j--)
            times[j] = times[j - 1];
        times[j] = time;
    }
}

static bool time_way(lom_light_grid *grid, const double way[3], float forward, double times[RUNS], lom_error *error)
{
    double length = lom_double_sqrt(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
    lom_light_desc desc = { .size = { 1000, 1000, 1000 }, .extinction = 0.05f, .forward = forward };
    for (int i = 0; i < 3; i++)
        desc.to_light[i] = (float)(way[i] / length);
    for (int run = 0; run < RUNS; run++) {
        double start = now_ms();
        if (!lom_sweep_sun(grid, &desc, error))
            return false;
        times[run] = now_ms() - start;
    }
    sort(times);
    return true;
}

int main(void)
{
    lom_error error = { 0 };
    float kept[256];
    for (int i = 0; i < 256; i++)
        kept[i] = (float)i / 255;
    lom_image *density = lom_make_cloud(&(lom_cloud_desc){ "cumulus_mediocris", SIZE, SIZE, SIZE, 1 }, &error);
    lom_light_grid *grid = density != NULL ? lom_create_light_grid(density, 1, kept, &error) : NULL;
    for (size_t i = 0; grid != NULL && i < sizeof ways / sizeof *ways; i++) {
        double plain[RUNS], forward[RUNS];
        if (!time_way(grid, ways[i], 0, plain, &error) || !time_way(grid, ways[i], 0.3f, forward, &error))
            break;
        printf("| %g, %g, %g | %.2f | %.2f | %.2f | %.2f |\n", ways[i][0], ways[i][1], ways[i][2], plain[0],
               plain[RUNS / 2], forward[0], forward[RUNS / 2]);
    }
    lom_free_light_grid(grid);
    lom_free_image(density);
    if (error.code != LOM_OK)
        fprintf(stderr, "%s\n", error.text);
    return error.code != LOM_OK;
}
