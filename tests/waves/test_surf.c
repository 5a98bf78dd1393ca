/* Proves by closed forms: wave numbers solve the dispersion relation, between its limits; group velocities are dw/dk;
 * over a plane beach the flux of energy is kept and Green's law holds in shallow water, phases are integrals of k,
 * crests turn by Snell's law; waves break at 0.78 of the depth and end at 0.4 of it; phases grow along every way to the
 * shore, behind an island too; the shape of a wave is single, of its height and of mean 0; a moment alone is that of a
 * run. */
#include "check.h"
#include "waves/surf.h"

static const double two_pi = 6.283185307179586, gravity = 9.80665;

static double distance(double a, double b)
{
    return a < b ? b - a : a - b;
}

static void wave_numbers_solve_the_dispersion_relation(void)
{
    static const double periods[] = { 1, 5, 8, 14, 30 }, depths[] = { 1e-3, 0.02, 0.3, 1, 4, 20, 100, 1e4 };
    for (size_t p = 0; p < sizeof periods / sizeof *periods; p++)
        for (size_t d = 0; d < sizeof depths / sizeof *depths; d++) {
            double w = two_pi / periods[p], k = lom_wave_number(w, depths[d]);
            double back = gravity * k * lom_double_tanh(k * depths[d]);
            CHECK(distance(back, w * w) < 1e-13 * w * w, "%g s, %g m: %.17g", periods[p], depths[d], back / (w * w));
            double step = 1e-5, faster = lom_wave_number(w * (1 + step), depths[d]);
            double slower = lom_wave_number(w * (1 - step), depths[d]), ratio = 2 * step * w / (faster - slower);
            double group = lom_group_velocity(w, depths[d]);
            CHECK(distance(group, ratio) < 1e-7 * ratio, "%g s, %g m: group %g, dw/dk %g", periods[p], depths[d], group,
                  ratio);
        }
    CHECK(distance(lom_wave_number(1, 1e4), 1 / gravity) < 1e-15, "deep water");
    CHECK(distance(lom_group_velocity(0.1, 0.01), lom_double_sqrt(gravity * 0.01)) < 1e-5, "shallow water");
}

enum { COLUMNS = 41, ROWS = 801 };
static double depths[COLUMNS * ROWS];

/* A beach whose depth falls from 16 m at z = 0 to the shore at z = 400 m; waves come along +z, turned by an angle. */
static struct lom_surf_map beach(double wave_height, double turned)
{
    for (int y = 0; y < ROWS; y++)
        for (int x = 0; x < COLUMNS; x++)
            depths[y * COLUMNS + x] = 16 * (1 - 0.5 * y / 390.0);
    struct lom_surf_desc desc = { .width = COLUMNS,
                                  .height = ROWS,
                                  .spacing = { 0.5, 0.5 },
                                  .depth = depths,
                                  .surf = { .height = wave_height, .period = 9, .direction = two_pi / 4 + turned } };
    struct lom_surf_map map;
    lom_error error = { 0 };
    CHECK(lom_make_surf_map(&map, &desc, &error), "%s", error.text);
    return map;
}

static double height_at(const struct lom_surf_map *map, int row)
{
    return 2 * (double)map->cells[row * COLUMNS + COLUMNS / 2].amplitude;
}

static void heights_follow_the_flux_and_greens_law(void)
{
    struct lom_surf_map map = beach(0.02, 0);
    const double w = two_pi / 9, start = 0.02 * 0.02 * lom_group_velocity(w, 16);
    for (int y = 4; y < 700; y++) {
        double depth = depths[y * COLUMNS], flux = height_at(&map, y) * height_at(&map, y);
        flux *= lom_group_velocity(w, depth);
        CHECK(distance(flux, start) < 1e-4 * start, "row %d: %g of the flux", y, flux / start);
    }
    int a = 700, b = 760; /* 1.6 and 0.4 m of water */
    double green = lom_double_pow(depths[a * COLUMNS] / depths[b * COLUMNS], 0.25);
    double ratio = height_at(&map, b) / height_at(&map, a);
    CHECK(ratio > 1.2 && distance(ratio, green) < 0.02 * green, "%g, Green's law %g", ratio, green);
    lom_free_surf_map(&map);
}

static void phases_are_integrals_of_the_wave_number(void)
{
    struct lom_surf_map map = beach(0.02, 0);
    double phase = map.cells[COLUMNS / 2].phase;
    for (int y = 1; y < 760; y++) {
        double middle = (depths[y * COLUMNS] + depths[(y - 1) * COLUMNS]) / 2;
        phase += 0.5 * lom_wave_number(two_pi / 9, middle);
        const struct lom_surf_cell *c = &map.cells[y * COLUMNS + COLUMNS / 2];
        CHECK(distance((double)c->phase, phase) < 2e-3 * (1 + phase), "row %d: %g, integral %g", y, (double)c->phase,
              phase);
        CHECK(c->kz > 0 && c->kx < 1e-3f && c->kx > -1e-3f, "row %d: straight on", y);
    }
    lom_free_surf_map(&map);
}

/* k sin(angle) is kept; on a ray the flux through the width between rays, which goes as cos(angle), too. */
static void crests_turn_by_snells_law(void)
{
    const double angle = 0.35, w = two_pi / 9, kx = lom_wave_number(w, 16) * lom_double_sin(angle);
    struct lom_surf_map map = beach(0.02, -angle);
    for (int y = 20; y < 700; y += 20) {
        const struct lom_surf_cell *c = &map.cells[y * COLUMNS + COLUMNS / 2];
        double k = lom_wave_number(w, depths[y * COLUMNS]), across = lom_double_sqrt(k * k - kx * kx);
        CHECK(distance((double)c->kx, kx) < 0.03 * kx, "row %d: kx %g, kept %g", y, (double)c->kx, kx);
        CHECK(distance((double)c->kz, across) < 0.03 * across, "row %d: kz %g of %g", y, (double)c->kz, across);
    }
    lom_free_surf_map(&map);
}

static void waves_break_and_end_at_their_ratios_to_the_depth(void)
{
    struct lom_surf_map map = beach(1.5, 0);
    int first = 0;
    for (int y = 1; y < 770 && first == 0; y++)
        if (height_at(&map, y) / depths[y * COLUMNS] > 0.775)
            first = y;
    CHECK(first > 0, "none breaks");
    CHECK(distance(map.breaking_depth, depths[first * COLUMNS]) < 0.05, "breaks in %g m, not in %g m",
          map.breaking_depth, depths[first * COLUMNS]);
    for (int y = first + 2; y < 770; y++) {
        double ratio = height_at(&map, y) / depths[y * COLUMNS];
        CHECK(ratio < 0.79 && ratio > 0.4, "row %d: %g of the depth", y, ratio);
        CHECK(height_at(&map, y) <= height_at(&map, y - 1), "row %d: a wave that breaks grows", y);
    }
    CHECK(map.cells[(first + 4) * COLUMNS + 20].breaking > 0.5f, "foam where it breaks");
    CHECK(map.cells[(first - 8) * COLUMNS + 20].breaking == 0.0f, "none before");
    lom_free_surf_map(&map);
    /* over a flat bed after a step the height falls to 0.4 of the depth */
    for (int i = 0; i < COLUMNS * ROWS; i++)
        depths[i] = i / COLUMNS < 100 ? 5 : 2;
    struct lom_surf_desc desc = {
        COLUMNS, ROWS, { 0.5, 0.5 }, depths, { .height = 1.7, .period = 9, .direction = two_pi / 4 }
    };
    CHECK(lom_make_surf_map(&map, &desc, NULL), "made");
    double end = height_at(&map, ROWS - 4) / 2;
    CHECK(end > 0.399 && end < 0.41, "%g of the depth at the end", end);
    lom_free_surf_map(&map);
}

static void phases_grow_to_the_shore_and_around_an_island(void)
{
    struct lom_surf_map map = beach(1, 0.2);
    lom_free_surf_map(&map);
    for (int y = 300; y < 340; y++)
        for (int x = 10; x < 22; x++)
            depths[y * COLUMNS + x] = -3;
    struct lom_surf_desc desc = {
        COLUMNS, ROWS, { 0.5, 0.5 }, depths, { .height = 1, .period = 9, .direction = two_pi / 4 }
    };
    CHECK(lom_make_surf_map(&map, &desc, NULL), "made");
    for (int y = 1; y < ROWS; y++)
        for (int x = 0; x < COLUMNS; x++) {
            const struct lom_surf_cell *c = &map.cells[y * COLUMNS + x], *before = c - COLUMNS;
            bool is_behind = x >= 8 && x < 24 && y >= 298 && y < 400;
            CHECK(is_behind || c->phase > before->phase, "%d, %d: the phase falls", x, y);
            CHECK(c->amplitude >= 0 && c->amplitude < 3 && c->skew * c->skew + c->lean * c->lean < 0.64f, "%d, %d", x,
                  y);
        }
    CHECK(map.cells[320 * COLUMNS + 16].amplitude == 0 && map.cells[350 * COLUMNS + 2].amplitude > 0.2f,
          "on the island");
    lom_free_surf_map(&map);
}

static double height_in(const struct lom_surf_map *map, const lom_water_surf *surf, double x, double z, double time)
{
    struct lom_surf_uniform moment = { .time = 0 };
    lom_fill_surf(&moment, map, surf, (double[2]){ 0, 0 }, time);
    return lom_surf_height(map, &moment, x, z);
}

/* One wave over a bed of this depth, from trough to crest, at steps of time. */
static void a_wave_has_its_height_and_no_loop(void)
{
    for (int n = 0; n < 3; n++) {
        for (int i = 0; i < COLUMNS * ROWS; i++)
            depths[i] = n == 0 ? 30 : n == 1 ? 5 : 1.5;
        lom_water_surf surf = { .height = 0.5, .period = 9, .direction = two_pi / 4 };
        struct lom_surf_desc desc = { COLUMNS, ROWS, { 0.5, 0.5 }, depths, surf };
        struct lom_surf_map map;
        CHECK(lom_make_surf_map(&map, &desc, NULL), "made");
        double low = 1e9, high = -1e9, mean = 0, steepest = 0, before = height_in(&map, &surf, 10, 100, 0);
        for (int t = 1; t <= 900; t++) {
            double y = height_in(&map, &surf, 10, 100, 0.01 * t);
            low = y < low ? y : low;
            high = y > high ? y : high;
            mean += y / 900;
            steepest = y - before > steepest ? y - before : steepest;
            before = y;
        }
        CHECK(distance(high - low, 0.5) < 0.01, "%g m from trough to crest", high - low);
        CHECK(distance(mean, 0) < 1e-3, "mean %g", mean);
        double sine = 0.25 * two_pi / 9 * 0.01;
        CHECK(n == 0 ? distance(steepest, sine) < 0.1 * sine : steepest > (n == 1 ? 1.02 : 1.2) * sine, "front %g",
              steepest / sine);
        CHECK(n == 0 || high > -1.1 * low, "crests are higher than troughs are deep: %g, %g", high, low);
        lom_free_surf_map(&map);
    }
}

static void a_moment_alone_is_that_of_a_run(void)
{
    struct lom_surf_map map = beach(1, 0);
    lom_water_surf surf = { .height = 1, .period = 9, .direction = two_pi / 4, .variation = 0.3 };
    double run[20], most = 0;
    for (int t = 0; t < 20; t++)
        run[t] = height_in(&map, &surf, 8, 250, 1e6 + 0.7 * t);
    for (int t = 19; t >= 0; t--) {
        CHECK(height_in(&map, &surf, 8, 250, 1e6 + 0.7 * t) == run[t], "moment %d", t);
        most = run[t] > most ? run[t] : most;
    }
    CHECK(most > 0.2 && most < map.highest * 1.3, "%g m", most);
    /* beyond the map the sea goes on: no step at its border */
    double step = height_in(&map, &surf, 8, -0.01, 3) - height_in(&map, &surf, 8, 0.01, 3);
    CHECK(distance(step, 0) < 0.01, "a step of %g at the border", step);
    lom_free_surf_map(&map);
}

int main(int argc, char **argv)
{
    RUN(wave_numbers_solve_the_dispersion_relation);
    RUN(heights_follow_the_flux_and_greens_law);
    RUN(phases_are_integrals_of_the_wave_number);
    RUN(crests_turn_by_snells_law);
    RUN(waves_break_and_end_at_their_ratios_to_the_depth);
    RUN(phases_grow_to_the_shore_and_around_an_island);
    RUN(a_wave_has_its_height_and_no_loop);
    RUN(a_moment_alone_is_that_of_a_run);
    return check_result();
}
