/* Proves how surf plunges over a bed, at every width: what shaders displace is what lom_surf_shift says in double; the
 * phase at which a wave began to break is one along a ray and that where 0.78 of the depth is reached; waves plunge by
 * the slope of the bed, between Iribarren numbers of 0.5 and 3.3; where they do not, displacements keep their bytes. */
#include "check.h"

#include "waves/wave_field.h"

enum { COLUMNS = 60, ROWS = 300 };
static float heights[(COLUMNS + 1) * (ROWS + 1)];
static lom_device *device;
static const lom_water_waves still = { .kind = LOM_WAVES_NONE };
static const lom_water_foam foam = { .window = 3 };
static const lom_shallow_water not_shallow;
static const struct lom_footprint point;

static double distance(double a, double b)
{
    return a < b ? b - a : a - b;
}

/* A beach of this slope, 4 m of water before it, whose contours bend. */
static struct lom_wave_site beach(const lom_water_surf *surf, double slope, double bent)
{
    for (int i = 0; i < (COLUMNS + 1) * (ROWS + 1); i++) {
        const double x = i % (COLUMNS + 1) - COLUMNS / 2.0, z = i / (COLUMNS + 1) - ROWS / 2.0;
        const double rise = slope * (z - bent * x * x);
        heights[i] = (float)(rise < -4 ? -4 : rise);
    }
    return (struct lom_wave_site){ .waves = &still,
                                   .foam = &foam,
                                   .surf = surf,
                                   .shallow = &not_shallow,
                                   .size = { COLUMNS, ROWS },
                                   .tile = 1,
                                   .ripple_up = 1,
                                   .bed = { heights, COLUMNS, ROWS, { COLUMNS, ROWS }, 0 } };
}

static lom_water_surf waves_of(enum lom_surf_breaking breaking, double plunging)
{
    return (lom_water_surf){ .height = 1.2,
                             .period = 8,
                             .direction = 1.5707963267948966,
                             .variation = 0.2,
                             .breaking = (int)breaking,
                             .plunging = plunging };
}

static void shaders_displace_what_double_says(void)
{
    const lom_water_surf surf = waves_of(LOM_SURF_PLUNGING, 0.9);
    const struct lom_wave_site site = beach(&surf, 0.09, 0.004);
    const struct lom_wave_source source = { &site, NULL, NULL, device };
    struct lom_wave_field *field = lom_load_wave_field(&source, NULL);
    struct lom_surf_map map;
    CHECK(field != NULL && lom_make_site_surf(&map, &site, NULL), "made");
    double thrown = 0;
    for (int n = 0; n < 16; n++) {
        struct lom_waves_uniform waves;
        memset(&waves, 0, sizeof waves);
        CHECK(lom_place_waves(field, &waves, (lom_vec3){ 3, 0, -20 }, 100 + 0.5 * n, NULL), "placed");
        for (double z = -60; z < -5; z += 0.7) {
            const double x = 8 * lom_double_sin(z);
            double exact[3];
            struct lom_wave_shift p =
                lom_displace(&waves, lom_splat((float)(x - 3)), lom_splat((float)(z + 20)), &point);
            lom_surf_shift(&map, &waves.surf, x, z, exact);
            const double got[3] = { (double)p.dx[0], (double)p.h[LOM_LANES - 1], (double)p.dz[0] };
            for (int i = 0; i < 3; i++)
                CHECK(distance(got[i], exact[i]) < 2e-3, "time %d, z %g: %d is %g, not %g", n, z, i, got[i], exact[i]);
            thrown = exact[2] > thrown ? exact[2] : thrown;
            CHECK(exact[2] < (double)waves.reach, "%g m, bound %g", exact[2], (double)waves.reach);
            CHECK(exact[1] >= (double)waves.lowest && exact[1] <= (double)waves.highest, "%g m high", exact[1]);
        }
    }
    CHECK(thrown > 3, "thrown by %g m", thrown);
    lom_free_surf_map(&map);
    lom_free_wave_field(field);
}

static void a_wave_began_to_break_where_its_height_says(void)
{
    const lom_water_surf surf = waves_of(LOM_SURF_PLUNGING, 1);
    const struct lom_wave_site site = beach(&surf, 0.06, 0);
    struct lom_surf_map map;
    CHECK(lom_make_site_surf(&map, &site, NULL) && map.curls != NULL, "made");
    int first = 0;
    for (int y = 0; y < ROWS && first == 0; y++) {
        const struct lom_surf_cell *cell = &map.cells[y * map.width + COLUMNS / 2];
        first = 2 * (double)cell->amplitude > 0.76 * 0.06 * (ROWS / 2.0 - y) && y > ROWS / 2 - 60 ? y : 0;
    }
    const double onset = (double)map.cells[first * map.width + COLUMNS / 2].phase;
    for (int y = first - 30; y < first + 12; y++) {
        const int i = y * map.width + COLUMNS / 2;
        const double since = (double)map.curls[i].since, exact = (double)map.cells[i].phase - onset;
        CHECK(distance(since, exact) < 0.35, "row %d: %g radians since, not %g", y, since, exact);
        const double step = (double)map.curls[i + map.width].since - since;
        const double phase = (double)map.cells[i + map.width].phase - (double)map.cells[i].phase;
        CHECK(distance(step, phase) < 0.02, "row %d: %g radians later, %g of phase", y, step, phase);
        CHECK(map.curls[i].strength > 0.95f, "row %d: %g", y, (double)map.curls[i].strength);
    }
    lom_free_surf_map(&map);
}

static void they_plunge_by_the_slope_of_the_bed(void)
{
    static const struct {
        double slope, low, high;
    } rows[] = { { 0.02, 0, 0.05 }, { 0.12, 0.95, 1 }, { 0.2, 0.95, 1 } };
    for (int n = 0; n < 3; n++) {
        const lom_water_surf surf = waves_of(LOM_SURF_AUTO, 1);
        const struct lom_wave_site site = beach(&surf, rows[n].slope, 0);
        struct lom_surf_map map;
        CHECK(lom_make_site_surf(&map, &site, NULL), "made");
        float most = 0;
        for (int y = 30; y < ROWS - 30; y++) {
            const struct lom_surf_curl_cell *curl = &map.curls[y * map.width + COLUMNS / 2];
            if (curl->since > -2 && curl->since < 0.5f)
                most = curl->strength > most ? curl->strength : most;
        }
        CHECK((double)most >= rows[n].low && (double)most <= rows[n].high, "slope %g (Iribarren %g to %g): %g",
              rows[n].slope, map.plunging_slope[0], map.plunging_slope[1], (double)most);
        lom_free_surf_map(&map);
    }
}

static void where_they_spill_nothing_changes(void)
{
    static const struct {
        enum lom_surf_breaking breaking;
        double plunging;
    } rows[] = { { LOM_SURF_SPILLING, 1 }, { LOM_SURF_PLUNGING, 0 }, { LOM_SURF_AUTO, 0 } };
    struct lom_wave_shift first[8];
    for (int n = 0; n < 3; n++) {
        const lom_water_surf surf = waves_of(rows[n].breaking, rows[n].plunging);
        const struct lom_wave_site site = beach(&surf, 0.1, 0.003);
        const struct lom_wave_source source = { &site, NULL, NULL, device };
        struct lom_wave_field *field = lom_load_wave_field(&source, NULL);
        struct lom_waves_uniform waves;
        memset(&waves, 0, sizeof waves);
        CHECK(field != NULL && lom_place_waves(field, &waves, (lom_vec3){ 0, 0, 0 }, 11.3, NULL), "placed");
        CHECK(waves.surf.curls[0] == NULL && waves.reach == 0, "row %d plunges", n);
        for (int i = 0; i < 8; i++) {
            struct lom_wave_shift p = lom_displace(&waves, lom_splat(2), lom_splat((float)(-50 + 5 * i)), &point);
            first[i] = n == 0 ? p : first[i];
            CHECK(memcmp(&p, &first[i], sizeof p) == 0, "row %d, place %d", n, i);
        }
        lom_free_wave_field(field);
    }
}

int main(int argc, char **argv)
{
    device = lom_open_device(&(lom_device_desc){ .threads = 1, .lanes = LOM_LANES });
    RUN(shaders_displace_what_double_says);
    RUN(a_wave_began_to_break_where_its_height_says);
    RUN(they_plunge_by_the_slope_of_the_bed);
    RUN(where_they_spill_nothing_changes);
    lom_close_device(device);
    return check_result();
}
