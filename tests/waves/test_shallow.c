/* Proves of shallow water: water at rest stays at rest to the bit; volume is kept, with sources, edges and obstacles
 * too; waves have their period and a broken dam its speed; nothing grows at any step; what is poured runs together in
 * the lowest place; a checkpoint goes on as the run did; and the bytes are the same everywhere. */
#include "check.h"

#include <lom/shallow.h>

enum { COLUMNS = 50, ROWS = 41, CELLS = COLUMNS * ROWS }; /* no multiples of the lines that are solved together */

static double bed[CELLS], depth[CELLS];

static double magnitude(double x)
{
    return x < 0 ? -x : x;
}

/* Hills of up to 3 m, some above the level of 1 m. */
static void make_rough_bed(void)
{
    for (int j = 0; j < ROWS; j++)
        for (int i = 0; i < COLUMNS; i++)
            bed[j * COLUMNS + i] = 1.5 * (1 + lom_double_sin(0.31 * i) * lom_double_cos(0.27 * j)) * 0.8 +
                                   0.3 * lom_random_uniform(5, (uint64_t)(j * COLUMNS + i));
}

static lom_shallow_desc rough_desc(void)
{
    make_rough_bed();
    return (
        lom_shallow_desc){ .columns = COLUMNS, .rows = ROWS, .cell = 0.5, .bed = bed, .level = 1, .friction = 0.01 };
}

/* A column of 4 m of water in the middle of a rough bed. */
static lom_shallow_desc dam_desc(void)
{
    lom_shallow_desc desc = rough_desc();
    for (int i = 0; i < CELLS; i++) {
        int x = i % COLUMNS - COLUMNS / 2, z = i / COLUMNS - ROWS / 2;
        depth[i] = x * x + z * z < 60 ? 4 : 0;
    }
    desc.depth = depth;
    return desc;
}

static double least_depth(const lom_shallow *s)
{
    lom_shallow_view v = lom_view_shallow(s);
    double least = 1e300;
    for (int i = 0; i < v.columns * v.rows; i++)
        least = v.depth[i] >= least ? least : v.depth[i]; /* a NaN is taken */
    return least;
}

static void water_at_rest_stays_at_rest(void)
{
    lom_shallow_desc desc = rough_desc();
    lom_shallow *s = lom_create_shallow(&desc, NULL);
    static double first[CELLS];
    memcpy(first, lom_view_shallow(s).depth, sizeof first);
    for (int i = 0; i < 500; i++)
        lom_step_shallow(s, NULL, 0, NULL, 0, NULL);
    lom_shallow_view v = lom_view_shallow(s);
    int dry = 0;
    for (int i = 0; i < CELLS; i++)
        dry += v.depth[i] == 0;
    CHECK(memcmp(first, v.depth, sizeof first) == 0, "the water moved");
    CHECK(dry > 100 && dry < CELLS - 100, "%d cells are dry", dry);
    lom_free_shallow(s);
}

static void volume_is_kept_over_ten_thousand_steps(void)
{
    lom_shallow_desc desc = dam_desc();
    lom_shallow *s = lom_create_shallow(&desc, NULL);
    double first = lom_view_shallow(s).volume;
    for (int i = 0; i < 10000; i++) {
        lom_step_shallow(s, NULL, 0, NULL, 0, NULL);
        if (i % 100 == 0)
            CHECK(least_depth(s) >= 0, "depth %g at step %d", least_depth(s), i);
    }
    double last = lom_view_shallow(s).volume;
    CHECK(magnitude(last / first - 1) < 1e-11, "%.17g m^3 became %.17g", first, last);
    lom_free_shallow(s);
}

static void what_comes_and_goes_is_counted(void)
{
    lom_shallow_desc desc = dam_desc();
    desc.edge[0] = LOM_SHALLOW_FALL;
    desc.edge[3] = LOM_SHALLOW_OPEN;
    desc.edge_level[3] = 1.8;
    lom_shallow *s = lom_create_shallow(&desc, NULL);
    double first = lom_view_shallow(s).volume;
    const lom_shallow_source sources[] = { { 6, 7, 1.2, 0.8 }, { 20, 15, 2, -0.5 }, { 12.01, 3.02, 0, 0.1 } };
    for (int i = 0; i < 10000; i++) {
        lom_shallow_obstacle boat = { 12 + 8 * lom_double_sin(0.01 * i), 10, { 2, 0.8 }, 0.3, 0.6 };
        lom_step_shallow(s, sources, 3, &boat, 1, NULL);
    }
    lom_shallow_view v = lom_view_shallow(s);
    CHECK(v.gained > 100 && v.lost > 100, "%g m^3 came, %g went", v.gained, v.lost);
    CHECK(magnitude(v.volume - (first + v.gained - v.lost)) < 1e-9 * (first + v.gained), "%.17g m^3, not %.17g",
          v.volume, first + v.gained - v.lost);
    CHECK(least_depth(s) >= 0, "depth %g", least_depth(s));
    lom_free_shallow(s);
}

/* A basin without an outlet fills by rate / area. */
static void a_basin_fills_evenly(void)
{
    memset(bed, 0, sizeof bed);
    lom_shallow_desc desc = { .columns = 40, .rows = 30, .cell = 0.5, .bed = bed, .level = 1 };
    lom_shallow *s = lom_create_shallow(&desc, NULL);
    lom_shallow_source source = { 10, 7.5, 3, 2 };
    for (int i = 0; i < 6000; i++) /* 100 s, 200 m^3 on 300 m^2 */
        lom_step_shallow(s, &source, 1, NULL, 0, NULL);
    lom_shallow_view v = lom_view_shallow(s);
    CHECK(magnitude(v.volume - 500) < 1e-8, "%.12g m^3", v.volume);
    for (int i = 0; i < 1200; i++)
        CHECK(magnitude(v.depth[i] - 500.0 / 300) < 0.05, "depth %g", v.depth[i]);
    lom_free_shallow(s);
}

/* The first standing wave of a closed basin of length L and depth h has the period 2 L / sqrt(g h). */
static void a_standing_wave_has_its_period(void)
{
    enum { LENGTH = 100 };
    static double flat[LENGTH * 2], still[LENGTH * 2];
    const double pi = 3.141592653589793, height = 2, wanted = 2 * LENGTH / lom_double_sqrt(9.80665 * height);
    for (int i = 0; i < LENGTH * 2; i++)
        still[i] = height + 0.01 * lom_double_cos(pi * (i % LENGTH + 0.5) / LENGTH);
    lom_shallow_desc desc = {
        .columns = LENGTH, .rows = 2, .cell = 1, .bed = flat, .depth = still, .step = 0.02, .implicitness = 0.5
    };
    lom_shallow *s = lom_create_shallow(&desc, NULL);
    double before = still[0] - height, first = 0, last = 0;
    int crossings = 0;
    for (int i = 1; i < 20000 && crossings < 9; i++) {
        lom_step_shallow(s, NULL, 0, NULL, 0, NULL);
        double now = lom_view_shallow(s).depth[0] - height;
        if ((now < 0) != (before < 0)) {
            last = (i - 1 + before / (before - now)) * desc.step;
            first = crossings++ == 0 ? last : first;
        }
        before = now;
    }
    CHECK(crossings == 9, "%d crossings", crossings);
    CHECK(magnitude((last - first) / 4 / wanted - 1) < 0.005, "period %g, not %g", (last - first) / 4, wanted);
    lom_free_shallow(s);
}

/* Steps a hundred times longer than a wave takes for a cell: the surface stays within what it was, and calms down. */
static void it_is_stable_at_any_step(void)
{
    static const double implicitness[] = { 0.5, 0.55, 1 };
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < CELLS; i++) {
            bed[i] = 0;
            depth[i] = 1.5 + lom_random_uniform(9, (uint64_t)i);
        }
        lom_shallow_desc desc = { .columns = COLUMNS, .rows = ROWS, .cell = 0.5, .bed = bed, .depth = depth };
        desc.step = 100 * desc.cell / lom_double_sqrt(9.80665 * 2);
        desc.implicitness = implicitness[k];
        lom_shallow *s = lom_create_shallow(&desc, NULL);
        double high = 0, low = 1e9;
        for (int i = 0; i < 10000; i++) {
            lom_step_shallow(s, NULL, 0, NULL, 0, NULL);
            lom_shallow_view v = lom_view_shallow(s);
            for (int c = 0; c < CELLS; c += 7) {
                high = v.depth[c] > high ? v.depth[c] : high;
                low = v.depth[c] < low ? v.depth[c] : low;
            }
        }
        CHECK(high < 3 && low > 1, "implicitness %g: depths from %g to %g", implicitness[k], low, high);
        lom_free_shallow(s);
    }
}

/* Ritter 1892: the front on a dry bed runs at 2 sqrt(g h); the linear equations are slower, never faster. */
static void a_broken_dam_runs_no_faster_than_ritter(void)
{
    enum { LENGTH = 400 };
    static double flat[LENGTH * 2], dam[LENGTH * 2];
    for (int i = 0; i < LENGTH * 2; i++)
        dam[i] = i % LENGTH < 100 ? 2 : 0;
    lom_shallow_desc desc = { .columns = LENGTH, .rows = 2, .cell = 0.5, .bed = flat, .depth = dam, .step = 0.005 };
    lom_shallow *s = lom_create_shallow(&desc, NULL);
    double speed = 2 * lom_double_sqrt(9.80665 * 2);
    for (int i = 1; i <= 1600; i++) {
        lom_step_shallow(s, NULL, 0, NULL, 0, NULL);
        lom_shallow_view v = lom_view_shallow(s);
        int front = LENGTH - 1;
        while (front > 0 && v.depth[front] < 1e-3)
            front--;
        double way = (front + 1 - 100) * desc.cell;
        CHECK(way <= speed * i * desc.step + 2 * desc.cell, "%g m after %g s", way, i * desc.step);
        CHECK(i < 400 || way > 0.3 * speed * i * desc.step, "only %g m after %g s", way, i * desc.step);
    }
    lom_free_shallow(s);
}

/* Over the edge of a cliff of 20 m, where the surface falls by 200 times the depth of the water that comes. */
static void a_fall_carries_what_its_depth_allows(void)
{
    enum { LENGTH = 60, EDGE = 30 };
    static double cliff[LENGTH * 2], film[LENGTH * 2];
    for (int i = 0; i < LENGTH * 2; i++) {
        cliff[i] = i % LENGTH < EDGE ? 20 : 0;
        film[i] = i % LENGTH < EDGE ? 0.1 : 0;
    }
    lom_shallow_desc desc = { .columns = LENGTH, .rows = 2, .cell = 0.5, .bed = cliff, .depth = film };
    lom_shallow *s = lom_create_shallow(&desc, NULL);
    double most = 2 * 0.1 * lom_double_sqrt(9.80665 * 0.1), seen = 0, before = 0.1 * EDGE;
    for (int i = 0; i < 120; i++) {
        double after = 0;
        lom_step_shallow(s, NULL, 0, NULL, 0, NULL);
        for (int c = 0; c < EDGE; c++)
            after += lom_view_shallow(s).depth[c];
        double flow = (before - after) * desc.cell * 60;
        seen = flow > seen ? flow : seen;
        before = after;
    }
    CHECK(seen <= most * 1.0001 && seen > 0.2 * most, "%g m^2/s, of %g", seen, most);
    lom_free_shallow(s);
}

static void a_mirrored_bed_has_mirrored_water(void)
{
    static double bed2[CELLS], depth2[CELLS];
    lom_shallow_desc desc = dam_desc(), mirrored = desc;
    depth[3 * COLUMNS + 7] = 5; /* nothing is symmetric */
    for (int i = 0; i < CELLS; i++) {
        int there = i / COLUMNS * COLUMNS + COLUMNS - 1 - i % COLUMNS;
        bed2[i] = bed[there];
        depth2[i] = depth[there];
    }
    mirrored.bed = bed2;
    mirrored.depth = depth2;
    lom_shallow *a = lom_create_shallow(&desc, NULL), *b = lom_create_shallow(&mirrored, NULL);
    for (int i = 0; i < 100; i++) {
        lom_step_shallow(a, NULL, 0, NULL, 0, NULL);
        lom_step_shallow(b, NULL, 0, NULL, 0, NULL);
    }
    lom_shallow_view v = lom_view_shallow(a), w = lom_view_shallow(b);
    for (int i = 0; i < CELLS; i++) {
        double there = w.depth[i / COLUMNS * COLUMNS + COLUMNS - 1 - i % COLUMNS];
        CHECK(magnitude(v.depth[i] - there) < 1e-9, "cell %d: %g and %g", i, v.depth[i], there);
    }
    lom_free_shallow(a);
    lom_free_shallow(b);
}

/* All that was poured on the slopes of a bowl stands level in it in the end. */
static void water_runs_together_in_the_lowest_place(void)
{
    for (int i = 0; i < CELLS; i++) {
        double x = i % COLUMNS - COLUMNS / 2, z = i / COLUMNS - ROWS / 2;
        bed[i] = 0.004 * (x * x + z * z);
        depth[i] = 0.05;
    }
    lom_shallow_desc desc = {
        .columns = COLUMNS, .rows = ROWS, .cell = 0.5, .bed = bed, .depth = depth, .friction = 0.02, .implicitness = 0.7
    };
    lom_shallow *s = lom_create_shallow(&desc, NULL);
    for (int i = 0; i < 20000; i++)
        lom_step_shallow(s, NULL, 0, NULL, 0, NULL);
    lom_shallow_view v = lom_view_shallow(s);
    double low = 1e9, high = -1e9, outside = 0;
    for (int i = 0; i < CELLS; i++) {
        double surface = v.bed[i] + v.depth[i];
        if (v.depth[i] > 0.05) {
            low = surface < low ? surface : low;
            high = surface > high ? surface : high;
        } else if (bed[i] > 0.8)
            outside += v.depth[i];
    }
    CHECK(high - low < 0.01 && high > 0.2, "the pool stands from %g to %g", low, high);
    CHECK(outside * 0.25 < 0.03 * v.volume, "%g of %g m^3 are still on the slopes", outside * 0.25, v.volume);
    lom_free_shallow(s);
}

/* A boat that has lain there long has water of the same level around and below it, as much as before. */
static void a_still_boat_displaces_its_draft(void)
{
    memset(bed, 0, sizeof bed);
    lom_shallow_desc desc = {
        .columns = 40, .rows = 30, .cell = 0.5, .bed = bed, .level = 2, .step = 0.25, .implicitness = 1
    };
    lom_shallow *s = lom_create_shallow(&desc, NULL);
    lom_shallow_obstacle boat = { 10, 7, { 3, 1 }, 0.5, 0.7 };
    lom_step_shallow(s, NULL, 0, &boat, 1, NULL);
    lom_shallow_view v = lom_view_shallow(s);
    double disturbed = 0, displaced = 0;
    for (int i = 0; i < 1200; i++) {
        disturbed += magnitude(v.bed[i] + v.depth[i] - 2);
        displaced += v.bed[i] * 0.25;
    }
    CHECK(disturbed > 0.1, "the boat makes no wave");
    for (int i = 0; i < 4000; i++)
        lom_step_shallow(s, NULL, 0, &boat, 1, NULL);
    v = lom_view_shallow(s);
    double level = 2 + displaced / 300;
    CHECK(displaced > 1 && displaced < 3, "%g m^3 are displaced", displaced);
    for (int i = 0; i < 1200; i++)
        CHECK(magnitude(v.bed[i] + v.depth[i] - level) < 1e-9, "cell %d stands at %g, not %g", i, v.bed[i] + v.depth[i],
              level);
    for (int i = 0; i < 4000; i++) /* and when it is gone, all is as it was */
        lom_step_shallow(s, NULL, 0, NULL, 0, NULL);
    v = lom_view_shallow(s);
    for (int i = 0; i < 1200; i++)
        CHECK(magnitude(v.depth[i] - 2) < 1e-9, "cell %d is %g deep", i, v.depth[i]);
    lom_free_shallow(s);
}

static uint64_t hash_of(const lom_shallow *s)
{
    lom_shallow_view v = lom_view_shallow(s);
    uint64_t hash = LOM_HASH_START;
    for (int i = 0; i < v.columns * v.rows; i++) {
        uint64_t bits;
        memcpy(&bits, &v.depth[i], sizeof bits);
        for (int byte = 0; byte < 8; byte++) { /* little-endian on every machine */
            uint8_t b = (uint8_t)(bits >> 8 * byte);
            hash = lom_hash_bytes(hash, &b, 1);
        }
    }
    return hash;
}

static void run(lom_shallow *s, int from, int to)
{
    lom_shallow_source spring = { 5, 5, 1, 0.4 };
    for (int i = from; i < to; i++) {
        lom_shallow_obstacle boat = { 8 + 0.02 * i, 10, { 2, 0.8 }, 0, 0.5 };
        lom_step_shallow(s, &spring, 1, &boat, 1, NULL);
    }
}

static void a_checkpoint_goes_on_as_the_run_did(void)
{
    lom_shallow_desc desc = dam_desc();
    lom_shallow *s = lom_create_shallow(&desc, NULL);
    run(s, 0, 100);
    lom_shallow *copy = lom_copy_shallow(s, NULL);
    run(s, 100, 200);
    CHECK(hash_of(copy) != hash_of(s), "the copy moves along");
    run(copy, 100, 200);
    lom_shallow_view v = lom_view_shallow(s), w = lom_view_shallow(copy);
    CHECK(hash_of(copy) == hash_of(s) && v.steps == 200 && w.steps == 200 && v.gained == w.gained && v.lost == w.lost,
          "%lld and %lld steps", (long long)v.steps, (long long)w.steps);
    CHECK(hash_of(s) == 0x5c7fa0f9e60af925u, "%016llx", (unsigned long long)hash_of(s));
    lom_free_shallow(s);
    lom_free_shallow(copy);
}

static void what_cannot_be_is_refused(void)
{
    double nan = __builtin_nan(""), infinite = __builtin_inf();
    lom_shallow_desc good = rough_desc(), bad[12];
    for (int i = 0; i < 12; i++)
        bad[i] = good;
    bad[0].columns = 1;
    bad[1].rows = 1 << 20;
    bad[2].bed = NULL;
    bad[3].cell = 0;
    bad[4].cell = nan;
    bad[5].step = -1;
    bad[6].implicitness = 0.4;
    bad[7].gravity = infinite;
    bad[8].friction = nan;
    bad[9].edge[2] = (lom_shallow_edge)7;
    bad[10].edge_level[1] = nan;
    bad[11].level = nan;
    for (int i = 0; i < 12; i++) {
        lom_error error = { 0 };
        CHECK(lom_create_shallow(&bad[i], &error) == NULL && strlen(error.text) > 20, "case %d", i);
    }
    bed[77] = nan;
    lom_error error = { 0 };
    CHECK(lom_create_shallow(&good, &error) == NULL && strstr(error.text, "(27, 1)") != NULL, "%s", error.text);
    bed[77] = 0;
    lom_shallow *s = lom_create_shallow(&good, NULL);
    uint64_t before = hash_of(s);
    lom_shallow_source source = { 1, 1, 1, nan };
    lom_shallow_obstacle obstacle = { 1, 1, { 0, 1 }, 0, 1 };
    CHECK(!lom_step_shallow(s, &source, 1, NULL, 0, NULL) && !lom_step_shallow(s, NULL, 0, &obstacle, 1, NULL) &&
              !lom_step_shallow(s, NULL, LOM_SHALLOW_SOURCES + 1, NULL, 0, NULL),
          "bad lists");
    CHECK(hash_of(s) == before && lom_view_shallow(s).steps == 0, "a refused step changes something");
    lom_free_shallow(s);
    lom_free_shallow(NULL);
}

int main(int argc, char **argv)
{
    RUN(water_at_rest_stays_at_rest);
    RUN(volume_is_kept_over_ten_thousand_steps);
    RUN(what_comes_and_goes_is_counted);
    RUN(a_basin_fills_evenly);
    RUN(a_standing_wave_has_its_period);
    RUN(it_is_stable_at_any_step);
    RUN(a_broken_dam_runs_no_faster_than_ritter);
    RUN(a_fall_carries_what_its_depth_allows);
    RUN(a_mirrored_bed_has_mirrored_water);
    RUN(water_runs_together_in_the_lowest_place);
    RUN(a_still_boat_displaces_its_draft);
    RUN(a_checkpoint_goes_on_as_the_run_did);
    RUN(what_cannot_be_is_refused);
    return check_result();
}
