/* Proves that what moves is where it should be 10^9 s from the start and 2^27 m from the origin: phases of trochoids, of
 * the sea, of surf and its groups, flow, ripples, the wind's way and drops' lives, as shaders get them, against the
 * oracle in integers of 128 bits (tests/oracle/turns.h). A product of doubles is rounded once, by 2^-53 of its turns at
 * most, so each bound is a few times that; docs/extremes.md has the errors that are printed. */
#include "check.h"
#include "oracle/turns.h"

#include "cloud/cloud_draw.h"
#include "water/lake.h"
#include "waves/sea_state.h"
#include "waves/surf.h"
#include "waves/wave_lanes.h"
#include "waves/wave_trains.h"

#include <lom/particles.h>

static const double two_pi = 6.283185307179586, latest = 1e9, farthest = 0x1p27, rounding = 0x1p-53;
enum { TRIES = 20000 };

static double between(uint64_t i, uint64_t what, double low, double high)
{
    return low + (high - low) * lom_random_uniform(11 + what, i);
}

static double time_at(uint64_t i)
{
    return i % 4 == 0 ? latest - (double)i : between(i, 0, -latest, latest);
}

/* The largest error, and the largest as a share of its bound. */
struct worst {
    double error, share;
};

static void note(struct worst *worst, double error, double bound)
{
    worst->error = fmax(worst->error, error);
    worst->share = fmax(worst->share, error / bound);
}

static void print_worst(const char *what, const struct worst *worst, const char *unit)
{
    printf("  %-46s %.3g %s at most, %.2f of the bound\n", what, worst->error, unit, worst->share);
    CHECK(worst->share > 0 && worst->share <= 1, "%s: %g of the bound", what, worst->share);
}

/* k (d . p) + 2 pi phase - w t. Two roundings in each product and its sum, one of 2 pi. */
static void trochoids_keep_their_phase(void)
{
    static const double ends[][2] = { { 1e7, 1e7 }, { 1e9, 0x1p27 }, { 1e9, 0x1p27 } }, least[] = { 0.2, 0.2, 8 };
    static const double bounds[] = { 1e-7, 5e-6, 1e-6 };
    static const char *const says[] = { "trochoids of 0.2 to 1000 m, 1e7 s, 1e7 m", "the same, 1e9 s, 2^27 m",
                                        "of 8 to 1000 m, 1e9 s, 2^27 m" };
    for (int e = 0; e < 3; e++) {
        struct worst worst = { 0, 0 };
        for (uint64_t i = 0; i < TRIES; i++) {
            const double length = exp(between(i, 1, log(least[e]), log(1000))), turned = between(i, 2, 0, 7);
            const lom_trochoid t = { .direction = { cos(turned), sin(turned) },
                                     .number = two_pi / length,
                                     .rate = sqrt(9.80665 * two_pi / length),
                                     .phase = between(i, 3, 0, 1) };
            const double time = time_at(i) / latest * ends[e][0], x = between(i, 4, -ends[e][1], ends[e][1]);
            const double z = between(i, 5, -ends[e][1], ends[e][1]);
            const double want = t.phase + part_of_product(radian, (double[]){ t.number, t.direction[0], x }, 3) +
                                part_of_product(radian, (double[]){ t.number, t.direction[1], z }, 3) -
                                part_of_product(radian, (double[]){ t.rate, time }, 2);
            const double got = lom_trochoid_phase(&t, x, z, time) / two_pi;
            const double turns = (fabs(t.rate * time) + t.number * (fabs(x) + fabs(z))) / two_pi;
            note(&worst, two_pi * turns_apart(got, want), two_pi * (4 * rounding * turns + 1e-15));
        }
        print_worst(says[e], &worst, "rad");
        CHECK(worst.error <= bounds[e], "%g radians", worst.error);
    }
}

/* cos and sin of w t as the shader's own rows have them: one rounding of the turns, one of the angle to float, and those
 * of the functions. */
static void the_seas_phases_are_turned_exactly(void)
{
    enum { SIZE = 64, HALF = SIZE / 2 };
    static double turns[SIZE * 64];
    static float factors[4][SIZE * 64], waves[2][SIZE * 64];
    const size_t pitch = lom_fft_pitch(HALF), plane = pitch * SIZE;
    CHECK(plane <= sizeof turns / sizeof *turns);
    for (size_t i = 0; i < plane; i++) {
        turns[i] = sqrt(9.80665 * exp(between(i, 6, log(0.006), log(60)))) / two_pi;
        factors[0][i] = factors[3][i] = 1;
    }
    float packed[4 * SIZE * 64];
    for (int k = 0; k < 4; k++)
        memcpy(packed + (size_t)k * plane, factors[k], plane * sizeof(float));
    struct worst worst = { 0, 0 };
    for (uint64_t t = 0; t < 40; t++) {
        const struct lom_sea_rows rows = { .turns = turns,
                                           .factors = packed,
                                           .wave_re = waves[0],
                                           .wave_im = waves[1],
                                           .size = SIZE,
                                           .time = time_at(t) };
        LOM_WIDE(lom_sea_wave_row)(&rows, (int)t);
        for (size_t i = t * pitch; i < t * pitch + HALF; i++) {
            const double want = part_of_product(half_turn, (double[]){ turns[i], rows.time, 2 }, 3);
            const double got = atan2((double)waves[1][i], (double)waves[0][i]) / two_pi;
            note(&worst, two_pi * turns_apart(got, want), two_pi * (rounding * turns[i] * fabs(rows.time)) + 3e-7);
        }
    }
    print_worst("the sea's waves of 0.1 to 1000 m, 1e9 s", &worst, "rad");
}

/* As floats: half an ulp of pi. */
static void surf_and_its_groups_come_in_time(void)
{
    struct worst worst = { 0, 0 }, groups = { 0, 0 };
    for (uint64_t i = 0; i < TRIES; i++) {
        const double turned = between(i, 7, 0, 7), time = time_at(i), group[2] = { 6.1, 3.7 };
        const struct lom_surf_map map = { .width = 4,
                                          .height = 4,
                                          .spacing = { 5, 5 },
                                          .along = { cos(turned), sin(turned) },
                                          .length = between(i, 8, 3, 300) };
        const lom_water_surf surf = { .period = between(i, 9, 1, 30), .variation = 0.3 };
        const double origin[2] = { between(i, 10, -farthest, farthest), between(i, 11, -farthest, farthest) };
        struct lom_surf_uniform got;
        memset(&got, 0, sizeof got);
        lom_fill_surf(&got, &map, &surf, origin, time);
        const double crests = fabs(time) / surf.period;
        note(&worst, two_pi * turns_apart((double)got.time / two_pi, part_of_quotient(time, 1, surf.period, 1)),
             two_pi * 4 * rounding * crests + 2.4e-7);
        for (int k = 0; k < 2; k++) {
            double want = part_of_quotient(time, 1, surf.period, group[k]), ways = 0;
            for (int a = 0; a < 2; a++) {
                want += (k == 0 ? 1 : -1) * part_of_quotient(map.along[a], origin[a], map.length, group[k]);
                ways += fabs(map.along[a] * origin[a]) / map.length;
            }
            note(&groups, two_pi * turns_apart((double)got.group_time[k] / two_pi, want),
                 two_pi * 5 * rounding * (crests + ways) / group[k] + 1e-6);
        }
    }
    print_worst("surf of 1 to 30 s, 1e9 s", &worst, "rad");
    print_worst("its groups, 2^27 m", &groups, "rad");
}

/* Which of the ripples of a river are seen: in a cycle of tile / (3 speed) they drift a third of a tile. */
static void rivers_flow_on(void)
{
    struct worst drift = { 0, 0 }, jump = { 0, 0 };
    for (uint64_t i = 0; i < TRIES; i++) {
        const double speed = between(i, 12, 0.05, 5), tile = between(i, 13, 0.5, 50), time = time_at(i);
        const double origin[2] = { between(i, 14, -farthest, farthest), between(i, 15, -farthest, farthest) };
        struct lom_river_uniform got;
        memset(&got, 0, sizeof got);
        lom_fill_river_phases(&got, speed, tile, origin, time);
        const double cycles = 3 * speed * fabs(time) / tile;
        for (int k = 0; k < 2; k++) {
            double share = part_of_quotient(3 * speed, time, tile, 1) + 0.5 * k;
            share -= floor(share);
            if (share < 1e-4 || share > 1 - 1e-4)
                continue; /* its weight is nothing there */
            const double whole = floor(3 * speed * time / tile + 0.5 * k - share + 0.5);
            const double want = 0.618034 * whole, exact = fabs(want) + fabs(origin[1]) / tile;
            note(&drift, fabs((double)got.drift[k] / tile * 3 - (share - 0.5)), 6 * rounding * (cycles + 1) + 6e-8);
            note(&jump,
                 turns_apart((double)got.jump[k][1], part_of_product(half_turn, (double[]){ 0.618034, whole, 2 }, 3) +
                                                         part_of_quotient(origin[1], 1, tile, 1)),
                 4 * rounding * exact + 6e-8);
        }
    }
    print_worst("drift of a river's ripples, 1e9 s", &drift, "of a cycle");
    print_worst("where its ripples are, 1e9 s, 2^27 m", &jump, "of a tile");
}

static void the_lakes_maps_drift_on(void)
{
    struct worst worst = { 0, 0 }, place = { 0, 0 };
    for (uint64_t i = 0; i < TRIES; i++) {
        lom_water_params water = { .tile = between(i, 16, 1, 100), .flow_speed = between(i, 17, -2, 2) };
        const lom_lake_view view = { .time = time_at(i),
                                     .eye = { between(i, 18, -farthest, farthest), 3, 0 },
                                     .frame_width = 64,
                                     .frame_height = 64 };
        struct lom_lake_uniforms u;
        water.shore_depth = 1;
        (void)lom_lake_draw(&lom_lake_shader, &water, &view, &u);
        note(&worst,
             turns_apart((double)u.move, part_of_product(half_turn, (double[]){ view.time, water.flow_speed, 2 }, 3)),
             rounding * fabs(view.time * water.flow_speed) + 6e-8);
        note(&place, turns_apart((double)u.shift[0], part_of_quotient(view.eye.x, 1, water.tile, 1)),
             rounding * farthest / water.tile + 6e-8);
    }
    print_worst("drift of the lake's maps, 1e9 s", &worst, "of a tile");
    print_worst("where they are, 2^27 m", &place, "of a tile");
}

/* a b in 2^-60 m. */
static __int128 length_of(double a, double b)
{
    int one, two;
    const uint128 product = (uint128)whole_of(a, &one) * whole_of(b, &two);
    const int shift = one + two + 60;
    const __int128 size = (__int128)(shift >= 0 ? product << shift : product >> -shift);
    return (a < 0) ^ (b < 0) ? -size : size;
}

/* A 64th of a metre is the grain of ways; what is added is an ulp of the way, and of the gusts. */
static void winds_carry_clouds_exactly(void)
{
    struct worst worst = { 0, 0 };
    for (uint64_t i = 0; i < TRIES; i++) {
        lom_cloud_wind wind = { .speed = between(i, 19, 0, 60),
                                .gust = between(i, 20, 0, 30),
                                .gust_period = between(i, 21, 1, 600) };
        const lom_clouds params = { .winds = &wind, .wind_count = 1 };
        const lom_cloud cloud = { .size = { 500, 300, 500 } };
        const double time = time_at(i), blown = part_of_quotient(time, 1, wind.gust_period, 1);
        const double gusts = wind.gust * wind.gust_period / two_pi * (1 - cos(two_pi * blown));
        const double got = lom_cloud_way(&params, &cloud, time).x;
        const double rest = (double)(length_of(got, 1) - length_of(wind.speed, time)) * 0x1p-60;
        note(&worst, fabs(rest - gusts), 1.0 / 128 + 4 * rounding * wind.speed * latest);
    }
    print_worst("the way of clouds, 1e9 s", &worst, "m");
}

static void drops_are_as_old_as_they_should_be(void)
{
    struct worst worst = { 0, 0 };
    lom_particle drops[64];
    for (uint64_t i = 0; i < TRIES / 64; i++) {
        const lom_emitter e = { .seed = i, .count = 64, .life = between(i, 22, 0.05, 30) };
        const double time = time_at(i);
        CHECK(lom_place_particles(&e, time, drops, NULL), "refused");
        for (int k = 0; k < 64; k++)
            note(&worst, turns_apart(drops[k].share, part_of_quotient(time, 1, e.life, 1) + k / 64.0),
                 2 * rounding * fabs(time) / e.life + 1e-15);
    }
    print_worst("the age of drops of 0.05 to 30 s, 1e9 s", &worst, "of a life");
}

/* The oracle by what is known: whole turns are none, and turns add up. */
static void the_oracle_knows_whole_turns(void)
{
    CHECK(part_of_quotient(1e9, 1, 0.5, 1) == 0 && part_of_quotient(7, 1, 4, 1) == 0.75);
    CHECK(part_of_quotient(-7, 1, 4, 1) == 0.25 && part_of_quotient(3, 5, 2, 4) == 0.875);
    CHECK(fabs(part_of_product(radian, (double[]){ two_pi, 1e15 }, 2)) < 0.1 * 1e15 * 0x1p-51);
    for (uint64_t i = 0; i < TRIES; i++) {
        const double a = between(i, 23, -1e9, 1e9), b = between(i, 24, -1e3, 1e3);
        const double once = part_of_product(radian, (double[]){ a, b }, 2);
        const double thrice = part_of_product(radian, (double[]){ a, b, 3 }, 3);
        CHECK(turns_apart(thrice, 3 * once) < 1e-15, "%g * %g", a, b);
        const double turns = part_of_product(half_turn, (double[]){ a, b, 2 }, 3);
        CHECK(turns_apart(turns, part_of_quotient(a, b, 1, 1)) < 1e-15, "%g * %g turns", a, b);
    }
    const double small = part_of_product(radian, (double[]){ 0.3, 0.7 }, 2);
    CHECK(fabs(small - 0.21 / two_pi) < 1e-16, "%g", small);
}

int main(int argc, char **argv)
{
    RUN(the_oracle_knows_whole_turns);
    RUN(trochoids_keep_their_phase);
    RUN(the_seas_phases_are_turned_exactly);
    RUN(surf_and_its_groups_come_in_time);
    RUN(rivers_flow_on);
    RUN(the_lakes_maps_drift_on);
    RUN(winds_carry_clouds_exactly);
    RUN(drops_are_as_old_as_they_should_be);
    return check_result();
}
