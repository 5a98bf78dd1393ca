/* Proves of foam that shallow water carries: on water at rest it stays and fades by the closed form; in a channel it goes
 * as fast as the water, and no cell has more than all; a body that moves leaves it on its way, one that rests does not;
 * any moment alone is that of a run. */
#include "check.h"

#include "base/numbers.h"
#include "base/threads.h"
#include "waves/shallow_state.h"
#include "waves/wave_site.h"

static lom_water_waves waves = { .kind = LOM_WAVES_NONE };
static const lom_water_surf no_surf;
static lom_water_foam foam = { .amount = 1, .carried = true, .window = 2 };
static lom_shallow_body body = { .half = { 2, 1 }, .draft = 0.3, .followed = 1 };
static double speed; /* of the body, along +x */

static void follow(const void *scene, size_t followed, double time, double place[2], double *heading)
{
    (void)scene;
    (void)followed;
    place[0] = -6 + speed * time;
    place[1] = 0;
    *heading = 0;
}

/* 40 x 20 m of water, 100 m deep, in cells of a quarter of a metre. */
static lom_shallow_water water = { .present = true,
                                   .size = { 40, 20 },
                                   .cells = 160,
                                   .step = 1. / 50,
                                   .implicitness = 0.55,
                                   .edge = LOM_SHALLOW_WALL,
                                   .bodies = &body };

static struct lom_wave_site site_of(size_t bodies)
{
    water.body_count = bodies;
    return (struct lom_wave_site){ .waves = &waves,
                                   .foam = &foam,
                                   .surf = &no_surf,
                                   .shallow = &water,
                                   .size = { 40, 20 },
                                   .tile = 1,
                                   .ripple_up = 1,
                                   .follow = follow };
}

static bool open_region(struct lom_shallow_region *region, const struct lom_wave_site *site, double time)
{
    lom_error error = { 0 };
    const bool done =
        lom_open_shallow_region(region, site, &error) && lom_advance_shallow_region(region, site, time, &error);
    CHECK(done, "%s", error.text);
    return done;
}

static double total(const struct lom_shallow_region *region, double *middle)
{
    double sum = 0, moment = 0;
    for (int z = 0; z < region->rows; z++)
        for (int x = 0; x < region->columns; x++) {
            const double here = (double)region->foam[(size_t)z * (size_t)region->columns + (size_t)x];
            CHECK(here >= 0 && here <= 1, "foam %g", here);
            sum += here;
            moment += here * x;
        }
    *middle = sum > 0 ? moment / sum * region->cell : 0;
    return sum;
}

static void put_foam(struct lom_shallow_region *region)
{
    for (int z = 30; z < 50; z++)
        for (int x = 40; x < 60; x++)
            region->foam[(size_t)z * (size_t)region->columns + (size_t)x] = 1;
}

static void foam_at_rest_fades(void)
{
    const struct lom_wave_site site = site_of(0);
    struct lom_shallow_region region;
    double middle, start, before;
    lom_error error = { 0 };
    if (open_region(&region, &site, 0)) {
        put_foam(&region);
        before = total(&region, &start);
        CHECK(lom_advance_shallow_region(&region, &site, 3, &error), "%s", error.text);
        const double left = total(&region, &middle) / before, exact = lom_double_exp(-3 / foam.window);
        CHECK(left > exact * (1 - 1e-4) && left < exact * (1 + 1e-4), "%g is left, not %g", left, exact);
        CHECK(middle == start || (middle - start < 1e-6 && start - middle < 1e-6), "from %g to %g", start, middle);
    }
    lom_close_shallow_region(&region);
}

/* The carrying alone, over a channel of known flow. */
static void foam_goes_with_the_water(void)
{
    enum { COLUMNS = 160, ROWS = 80 };
    static double bed[COLUMNS * ROWS];
    const double rate = 1.5 * 2; /* m^3/s a metre: 1.5 m/s in 2 m */
    const struct lom_wave_site site = site_of(0);
    struct lom_shallow_region region;
    lom_error error = { 0 };
    for (int i = 0; i < COLUMNS * ROWS; i++)
        bed[i] = -2;
    if (!open_region(&region, &site, 0)) {
        lom_close_shallow_region(&region);
        return;
    }
    lom_free_shallow(region.now);
    region.now = lom_create_shallow(&(lom_shallow_desc){ .columns = COLUMNS,
                                                         .rows = ROWS,
                                                         .cell = 0.25,
                                                         .bed = bed,
                                                         .step = 1. / 50,
                                                         .edge = { LOM_SHALLOW_OPEN, LOM_SHALLOW_OPEN } },
                                    &error);
    CHECK(region.now != NULL, "%s", error.text);
    for (int i = 0; region.now != NULL && i < (COLUMNS + 1) * ROWS; i++)
        region.now->flow_x[i] = rate;
    put_foam(&region);
    double start, middle, before = total(&region, &start);
    for (int i = 0; region.now != NULL && i < 100; i++)
        lom_carry_shallow_foam(&region, &site, NULL, NULL);
    const double left = total(&region, &middle) / before, exact = lom_double_exp(-2 / foam.window);
    CHECK(middle - start > 2.98 && middle - start < 3.02, "in 2 s it goes %g m, the water 3 m", middle - start);
    CHECK(left > 0.999 * exact && left < 1.001 * exact, "%g is left, not %g", left, exact);
    lom_close_shallow_region(&region);
}

static double foam_of(const struct lom_shallow_region *region, double x, double z)
{
    const int column = lom_int_of((x - region->corner[0]) / region->cell);
    const int row = lom_int_of((z - region->corner[1]) / region->cell);
    return (double)region->foam[(size_t)row * (size_t)region->columns + (size_t)column];
}

static void a_body_leaves_it_on_its_way(void)
{
    const struct lom_wave_site site = site_of(1);
    for (int moves = 0; moves < 2; moves++) {
        struct lom_shallow_region region;
        double middle;
        speed = moves != 0 ? 4 : 0;
        if (open_region(&region, &site, 2)) { /* from x = -6 to 2 */
            const double sum = total(&region, &middle);
            CHECK(moves != 0 ? sum > 30 : sum == 0, "%g of foam", sum);
            CHECK(moves == 0 || foam_of(&region, 1.5, 0.1) > 0.9, "in the body: %g", foam_of(&region, 1.5, 0.1));
            CHECK(moves == 0 || foam_of(&region, -2, 0.1) > 0.1, "behind it: %g", foam_of(&region, -2, 0.1));
            CHECK(foam_of(&region, 8, 0.1) == 0 && foam_of(&region, -2, 8) == 0, "foam before it or far away");
        }
        lom_close_shallow_region(&region);
    }
}

static void a_moment_alone_is_that_of_a_run(void)
{
    const struct lom_wave_site site = site_of(1);
    struct lom_shallow_region alone, run;
    lom_error error = { 0 };
    speed = 4;
    const bool first = open_region(&alone, &site, 1.5), second = open_region(&run, &site, 2);
    if (first && second) {
        for (int i = 0; i < 2; i++) /* back, then on */
            CHECK(lom_advance_shallow_region(&run, &site, i == 0 ? 0.4 : 1.5, &error), "%s", error.text);
        const size_t cells = (size_t)alone.columns * (size_t)alone.rows;
        CHECK(memcmp(alone.foam, run.foam, cells * sizeof *alone.foam) == 0, "another foam");
    }
    lom_close_shallow_region(&alone);
    lom_close_shallow_region(&run);
}

/* Shared by the workers of a pool it is what the caller alone carries. */
static void workers_carry_as_one_does(void)
{
    const struct lom_wave_site site = site_of(1);
    struct lom_shallow_region regions[2];
    lom_pool *pool = lom_create_pool(3, NULL);
    lom_error error = { 0 };
    speed = 3;
    for (int i = 0; i < 2; i++) {
        bool done = lom_open_shallow_region(&regions[i], &site, &error);
        done = done && (i == 0 || lom_share_shallow(regions[i].first, pool, &error));
        CHECK(done && lom_advance_shallow_region(&regions[i], &site, 2, &error), "%s", error.text);
    }
    const size_t cells = (size_t)regions[0].columns * (size_t)regions[0].rows;
    CHECK(memcmp(regions[0].foam, regions[1].foam, cells * sizeof(float)) == 0, "three workers carry another foam");
    for (int i = 0; i < 2; i++)
        lom_close_shallow_region(&regions[i]);
    lom_free_pool(pool);
}

int main(int argc, char **argv)
{
    RUN(foam_at_rest_fades);
    RUN(foam_goes_with_the_water);
    RUN(a_body_leaves_it_on_its_way);
    RUN(a_moment_alone_is_that_of_a_run);
    RUN(workers_carry_as_one_does);
    return check_result();
}
