/* Proves how surf takes foam along, at every width: the way of the water at a place changes by its velocity, the integral
 * of a w / tanh(kd) sin t along the wave, which is no faster than the wave; without foam that is carried there is none. */
#include "check.h"

#include "waves/wave_field.h"

enum { COLUMNS = 40, ROWS = 80 };
static float heights[(COLUMNS + 1) * (ROWS + 1)]; /* zeros: a level bed */
static lom_device *device;
static const lom_water_waves still = { .kind = LOM_WAVES_NONE };
static const lom_shallow_water not_shallow;
static const struct lom_footprint point;

static void way_at(const struct lom_wave_site *site, double time, double x, double z, double way[2])
{
    const struct lom_wave_source source = { site, NULL, NULL, device };
    struct lom_waves_uniform waves;
    lom_error error = { 0 };
    memset(&waves, 0, sizeof waves);
    struct lom_wave_field *field = lom_load_wave_field(&source, &error);
    CHECK(field != NULL && lom_place_waves(field, &waves, (lom_vec3){ 0, 0, 0 }, time, &error), "%s", error.text);
    struct lom_wave_slopes w = lom_find_slopes(&waves, lom_splat((float)x), lom_splat((float)z), &point);
    way[0] = (double)w.drift_x[0];
    way[1] = (double)w.drift_z[LOM_LANES - 1];
    lom_free_wave_field(field);
}

static struct lom_wave_site site_of(const lom_water_surf *surf, const lom_water_foam *foam)
{
    return (struct lom_wave_site){ .waves = &still,
                                   .foam = foam,
                                   .surf = surf,
                                   .shallow = &not_shallow,
                                   .size = { COLUMNS, ROWS },
                                   .tile = 1,
                                   .ripple_up = 1,
                                   .bed = { heights, COLUMNS, ROWS, { COLUMNS, ROWS }, -3 } };
}

static void its_change_is_the_waters_velocity(void)
{
    static const lom_water_foam foam = { .amount = 1, .window = 3, .carried = true };
    const lom_water_surf surf = { .height = 0.6, .period = 6, .direction = 1.5707963267948966 };
    const struct lom_wave_site site = site_of(&surf, &foam);
    struct lom_surf_map map;
    lom_error error = { 0 };
    CHECK(lom_make_site_surf(&map, &site, &error), "%s", error.text);
    const double w = 6.283185307179586 / surf.period, step = 0.02, x = 1.5, z = 4.2;
    const struct lom_surf_place at = lom_surf_place_at(&map, x, z);
    const double number = lom_wave_number(w, 3), most = at.amplitude * w / lom_double_tanh(number * 3);
    double fastest = 0;
    for (int i = 0; i < 12; i++) {
        const double time = 100 + 0.5 * i;
        double before[2], after[2];
        way_at(&site, time - step, x, z, before);
        way_at(&site, time + step, x, z, after);
        const double speed = (after[1] - before[1]) / (2 * step), exact = most * lom_double_sin(w * time - at.phase);
        CHECK(speed - exact < 0.02 * most && exact - speed < 0.02 * most, "%g m/s, the water %g", speed, exact);
        CHECK(after[0] < 0.02 && after[0] > -0.02, "across the wave by %g m", after[0]);
        fastest = speed > fastest ? speed : fastest;
    }
    CHECK(fastest > 0.9 * most, "at most %g m/s of %g", fastest, most);
    lom_free_surf_map(&map);
}

static void no_water_is_faster_than_its_wave(void)
{
    static const lom_water_foam foam = { .amount = 1, .window = 3, .carried = true };
    const lom_water_surf surf = { .height = 20, .period = 6, .direction = 1.5707963267948966 };
    const struct lom_wave_site site = site_of(&surf, &foam);
    const double number = lom_wave_number(6.283185307179586 / surf.period, 3);
    for (int i = 0; i < 12; i++) {
        double way[2];
        way_at(&site, 0.5 * i, 0, -30, way);
        const double length = lom_double_sqrt(way[0] * way[0] + way[1] * way[1]);
        CHECK(length < 1.05 / number, "a way of %g m, of a wave of 1 / k = %g", length, 1 / number);
    }
}

static void foam_that_is_not_carried_stays(void)
{
    static const lom_water_foam foam = { .amount = 1, .window = 3 };
    const lom_water_surf surf = { .height = 0.6, .period = 6, .direction = 1.5707963267948966 };
    const struct lom_wave_site site = site_of(&surf, &foam);
    double way[2];
    way_at(&site, 2.3, 1, 1, way);
    CHECK(way[0] == 0 && way[1] == 0, "%g %g", way[0], way[1]);
}

int main(int argc, char **argv)
{
    device = lom_open_device(&(lom_device_desc){ .threads = 1, .lanes = LOM_LANES });
    RUN(its_change_is_the_waters_velocity);
    RUN(no_water_is_faster_than_its_wave);
    RUN(foam_that_is_not_carried_stays);
    lom_close_device(device);
    return check_result();
}
