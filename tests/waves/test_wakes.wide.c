/* Proves of the foam of wakes, at every width: none lies before the bow, beside the wake or behind a body that rests; behind
 * one that goes straight it fades by 1/e in the window and spreads with the fourth root of the way; it lies where the body
 * was, whatever its heading is now, and stays there; what is sampled wide has as much of it in all; where it is carried, the
 * pattern has spread with the water. */
#include "check.h"

#include "base/numbers.h"
#include "waves/wake_lanes.h"
#include "waves/wave_field.h"

static lom_device *device;
static const lom_water_waves still = { .kind = LOM_WAVES_NONE };
static const lom_shallow_water not_shallow;
static const lom_water_surf no_surf;
static lom_water_foam foam = { .amount = 1, .window = 3 };
static const lom_water_wake wake = { .entity = "boat", .heading = -lom_pi / 2, .half = { 2, 0.8 }, .followed = 1 };

/* Ways of a boat: at a speed along +x; round a circle of 10 m, clockwise from above. */
static double speed, turns;
static void follow(const void *scene, size_t followed, double time, double place[2], double *heading)
{
    (void)scene;
    CHECK(followed == 1, "entity %zu", followed);
    place[0] = turns > 0 ? 10 * lom_double_sin(turns * time) : speed * time;
    place[1] = turns > 0 ? -10 * lom_double_cos(turns * time) : 0;
    *heading = turns > 0 ? turns * time : 0;
}

struct sampled {
    double foam, drift[2];
};

static struct sampled sample(double time, double x, double z, double size)
{
    const struct lom_wave_site site = { .waves = &still,
                                        .foam = &foam,
                                        .surf = &no_surf,
                                        .shallow = &not_shallow,
                                        .wakes = &wake,
                                        .wake_count = 1,
                                        .size = { 100, 100 },
                                        .tile = 1,
                                        .ripple_up = 1,
                                        .follow = follow };
    const struct lom_wave_source source = { &site, NULL, NULL, device };
    const struct lom_footprint f = { lom_splat((float)size), { 0 }, { 0 }, lom_splat((float)size) };
    struct lom_waves_uniform waves;
    struct lom_wave_slopes w;
    lom_error error = { 0 };
    memset(&waves, 0, sizeof waves);
    memset(&w, 0, sizeof w);
    struct lom_wave_field *field = lom_load_wave_field(&source, &error);
    const lom_vec3 origin = { 3, 0, -2 };
    const bool done = field != NULL && lom_place_waves(field, &waves, origin, time, &error) &&
                      lom_fill_waves(field, &waves, time, &error);
    CHECK(done, "%s", error.text);
    if (done)
        w = lom_find_slopes(&waves, lom_splat((float)(x - origin.x)), lom_splat((float)(z - origin.z)), &f);
    lom_free_wave_field(field);
    return (struct sampled){ (double)w.foam[LOM_LANES - 1], { (double)w.drift_x[0], (double)w.drift_z[0] } };
}

static void foam_lies_behind_what_moves(void)
{
    const double time = 40.03, bow = 5 * time + 2;
    speed = 5;
    for (double away = 0.05; away < 3; away += 0.2)
        CHECK(sample(time, bow + away, 0, 0).foam == 0, "foam %g m before the bow", away);
    for (double behind = 4; behind < 40; behind += 3)
        CHECK(sample(time, bow - behind, 0, 0).foam > 0.05, "none %g m behind the bow", behind);
    for (int side = -1; side <= 1; side += 2)
        CHECK(sample(time, bow - 4, side * 1.05, 0).foam == 0 && sample(time, bow - 2, side * 0.85, 0).foam > 0,
              "beside the hull");
    CHECK(sample(time, bow - 62, 0, 0).foam == 0, "there is foam of more than four windows ago");
    speed = 0;
    CHECK(sample(time, 0, 0, 0).foam == 0, "a body that rests has foam");
    speed = 0.4;
    const double slow = sample(time, speed * time + 1.8, 0, 0).foam;
    CHECK(slow > 0.1 && slow < 0.25, "one that is slow: %g", slow);
}

static void it_fades_and_spreads(void)
{
    speed = 5;
    const double time = 40, bow = 5 * time + 2, last = lom_double_exp(-4);
    for (double age = 0.8; age < 11; age += 0.9) {
        const double left = (lom_double_exp(-age / 3) - last) / (1 - last), way = 5 * age;
        const double found = sample(time, bow - way, 0, 0).foam;
        CHECK(found - left < 0.004 && left - found < 0.004, "after %g s: %g, not %g", age, found, left);
        const double half = lom_double_sqrt(lom_double_sqrt(lom_larger(way / 4, 1)));
        const double inside = sample(time, bow - way, 0.97 * half, 0).foam,
                     outside = sample(time, bow - way, 1.01 * half, 0).foam;
        CHECK(inside > 0 && outside == 0, "%g m behind the bow it is not %g m wide: %g, %g", way, half, inside,
              outside);
    }
}

/* At any later moment it is where it was made. */
static void it_stays_on_the_way_of_the_body(void)
{
    turns = 0.5;
    for (double time = 20; time < 23; time += 0.37)
        for (double age = 1; age < 8; age += 1.3) {
            const double angle =
                turns * (time - age) + 0.1974; /* of the bow: atan(2 / 10) ahead, 10.2 m from the middle */
            const double x = 10.198 * lom_double_sin(angle), z = -10.198 * lom_double_cos(angle);
            const double left = lom_double_exp(-age / 3), found = sample(time, x, z, 0).foam;
            CHECK(found > left - 0.03 && found < left + 0.03, "%g s after the bow was there: %g, not %g", age, found,
                  left);
            CHECK(sample(time, 0.6 * x, 0.6 * z, 0).foam == 0, "there is foam within the circle");
        }
    turns = 0;
}

/* Sums across the wake over samples that are no wider than it is, and much wider. */
static void a_wide_sample_has_its_share(void)
{
    speed = 5;
    const double time = 30, x = 5 * time - 10;
    double sum[3] = { 0 };
    static const double sizes[3] = { 0.1, 2, 16 };
    for (int i = 0; i < 3; i++)
        for (double z = -20; z <= 20; z += 0.1)
            sum[i] += 0.1 * sample(time, x, z + 0.013, sizes[i]).foam;
    for (int i = 1; i < 3; i++)
        CHECK(sum[i] > 0.85 * sum[0] && sum[i] < 1.15 * sum[0], "samples of %g m: %g m of foam, not %g", sizes[i],
              sum[i], sum[0]);
}

static void the_pattern_spreads_with_it(void)
{
    speed = 5;
    const double time = 40, way = 32, z = 0.9;
    CHECK(sample(time, 5 * time + 2 - way, z, 0).drift[1] == 0, "what is not carried moves");
    foam.carried = true;
    const struct sampled at = sample(time, 5 * time + 2 - way, z, 0);
    const double moved = z * (1 - 1 / lom_double_sqrt(lom_double_sqrt(way / 4)));
    CHECK(at.drift[1] - moved < 1e-3 && moved - at.drift[1] < 1e-3, "by %g m, not %g", at.drift[1], moved);
    CHECK(at.drift[0] < 1e-3 && at.drift[0] > -1e-3, "along the way by %g m", at.drift[0]);
    foam.carried = false;
}

/* A part of a wake whose box is smaller than its foam, as rounding may make it: a place within gives what it gives alone, one
 * without has nothing of it, whichever share a packet. */
static void a_place_does_not_see_its_neighbours(void)
{
    static struct lom_wake_track track = { .half = { 2, 0.875f } };
    struct lom_wake_run *run = &track.run[0];
    *run = (struct lom_wake_run){ .low = { -6, -0.4f }, .high = { -1, 0.8f } };
    for (int i = 0; i <= LOM_WAKE_STEPS; i++)
        run->place[i] = (struct lom_wake_place){ (float)-i, 0.1f * (float)i, (float)i, 1 };
    const struct lom_wakes_uniform wakes = { &track, 1, true };
    const struct lom_footprint f = { lom_splat(0.002f), { 0 }, { 0 }, lom_splat(0.002f) };
    int inside = 0, outside = 0;
    for (uint64_t n = 0; n < 2000; n++) {
        lom_float x, z;
        struct lom_wave_slopes w, own;
        memset(&w, 0, sizeof w);
        for (int i = 0; i < LOM_LANES; i++) {
            x[i] = (float)(-7 + 7 * lom_random_uniform(1, n * LOM_LANES + (uint64_t)i));
            z[i] = (float)(-1 + 3 * lom_random_uniform(2, n * LOM_LANES + (uint64_t)i));
        }
        add_wakes(&wakes, x, z, &f, &w);
        for (int i = 0; i < LOM_LANES; i++) {
            memset(&own, 0, sizeof own);
            add_wakes(&wakes, lom_splat(x[i]), lom_splat(z[i]), &f, &own);
            CHECK(w.foam[i] == own.foam[i] && w.drift_x[i] == own.drift_x[i] && w.drift_z[i] == own.drift_z[i],
                  "at %.9g, %.9g foam of %g, %g alone", (double)x[i], (double)z[i], (double)w.foam[i],
                  (double)own.foam[i]);
            inside += own.foam[i] > 0;
            outside += own.foam[i] == 0;
        }
    }
    CHECK(inside > 1000 && outside > 1000, "%d places have foam, %d have none", inside, outside);
}

int main(int argc, char **argv)
{
    device = lom_open_device(&(lom_device_desc){ .threads = 1, .lanes = LOM_LANES });
    RUN(foam_lies_behind_what_moves);
    RUN(it_fades_and_spreads);
    RUN(it_stays_on_the_way_of_the_body);
    RUN(a_wide_sample_has_its_share);
    RUN(the_pattern_spreads_with_it);
    RUN(a_place_does_not_see_its_neighbours);
    lom_close_device(device);
    return check_result();
}
