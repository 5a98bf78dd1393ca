/* Proves: particles fly as a fine numeric integration does; lives follow one another without a jump and in constant
 * number; a moment alone is that moment of a run; limits are refused with a sentence; the order is stable. */
#include "check.h"
#include <lom/particles.h>

static lom_emitter fall(size_t count)
{
    return (lom_emitter){ .seed = 7,
                          .count = count,
                          .from = { -3, 20, 1 },
                          .to = { 3, 20, 2 },
                          .velocity = { 0, 0, 2 },
                          .spread = 0.3,
                          .spread_up = 0.01,
                          .wind = { 1, 0, 0 },
                          .drag = 0.4,
                          .life = 2.5 };
}

static double distance(double a, double b)
{
    return a < b ? b - a : a - b;
}

/* Velocity by the classical Runge-Kutta steps, place by Simpson's rule, which are one method on this equation. */
static void flight_is_the_integral_of_the_equation(void)
{
    static const double drags[] = { 0, 1e-9, 1e-3, 0.3, 0.5, 0.999, 1.001, 5, 40 };
    for (size_t d = 0; d < sizeof drags / sizeof *drags; d++) {
        const double start[3] = { 1, 2, 3 }, first[3] = { 4, 5, -6 }, wind[3] = { -2, 0.5, 1 };
        const int steps = 20000;
        const double step = 2.0 / steps, k = drags[d];
        double x[3] = { 1, 2, 3 }, v[3] = { 4, 5, -6 }, place[3], now[3];
        for (int n = 0; n < steps; n++)
            for (int i = 0; i < 3; i++) {
                double force = (i == 1 ? -9.80665 : 0) + k * wind[i];
                double a = force - k * v[i], b = force - k * (v[i] + step / 2 * a);
                double c = force - k * (v[i] + step / 2 * b), e = force - k * (v[i] + step * c);
                x[i] += step * (v[i] + step / 6 * (a + b + c));
                v[i] += step / 6 * (a + 2 * b + 2 * c + e);
            }
        lom_particle_flight(start, first, wind, k, 2, place, now);
        for (int i = 0; i < 3; i++)
            CHECK(distance(now[i], v[i]) < 1e-9 && distance(place[i], x[i]) < 1e-9,
                  "drag %g axis %d: %.15g, integrated %.15g", k, i, place[i], x[i]);
    }
}

static void fall_time_inverts_the_flight(void)
{
    static const double heights[] = { 1e-6, 0.1, 1, 20, 979, 1e5 }, drags[] = { 0, 1e-6, 0.4, 3, 1000 };
    for (size_t h = 0; h < sizeof heights / sizeof *heights; h++)
        for (size_t d = 0; d < sizeof drags / sizeof *drags; d++) {
            const double zero[3] = { 0, 0, 0 };
            double place[3];
            lom_particle_flight(zero, zero, zero, drags[d], lom_fall_time(heights[h], drags[d]), place, NULL);
            CHECK(distance(-place[1], heights[h]) <= 1e-12 * heights[h], "%g m, drag %g: %.17g", heights[h], drags[d],
                  -place[1]);
        }
    CHECK(distance(lom_fall_time(9.80665 / 2, 0), 1) < 1e-15, "half of g in a second");
    CHECK(lom_fall_time(0, 1) == 0, "no height");
}

static void lives_follow_without_a_jump(void)
{
    lom_emitter e = fall(50);
    lom_particle before[50], now[50];
    int births = 0;
    CHECK(lom_place_particles(&e, -6, before, NULL), "a valid emitter");
    for (int n = 1; n <= 12000; n++) {
        CHECK(lom_place_particles(&e, -6 + 0.001 * n, now, NULL), "a valid emitter");
        for (int i = 0; i < 50; i++) {
            CHECK(now[i].share >= 0 && now[i].share < 1 && now[i].alpha >= 0 && now[i].alpha <= 1, "alive");
            CHECK(distance(now[i].alpha, before[i].alpha) < 0.0075, "alpha jumps at particle %d", i);
            CHECK(now[i].life == before[i].life || now[i].life == before[i].life + 1, "lives are consecutive");
            if (now[i].life != before[i].life) {
                births++;
                CHECK(now[i].alpha < 1e-3 && before[i].alpha < 1e-3, "a life begins and ends unseen");
            } else {
                for (int k = 0; k < 3; k++)
                    CHECK(distance(now[i].place[k], before[i].place[k]) < 0.03, "particle %d jumps", i);
            }
            before[i] = now[i];
        }
    }
    CHECK(births >= 239 && births <= 241, "%d births; 50 particles in 12 s at 2.5 s a life are 240", births);
}

static void birth_is_unseen_and_on_the_segment(void)
{
    lom_emitter e = fall(1);
    lom_particle p, next;
    CHECK(lom_place_particles(&e, 0, &p, NULL) && lom_place_particles(&e, 2.5, &next, NULL), "valid");
    CHECK(p.share == 0 && p.alpha == 0 && p.life == 0 && next.alpha == 0 && next.life == 1, "births");
    CHECK(p.place[1] == 20 && p.place[0] >= -3 && p.place[0] <= 3, "on the lip");
    CHECK(distance(p.place[2], 1 + (p.place[0] + 3) / 6) < 1e-12, "on the lip");
    CHECK(p.place[0] != next.place[0], "each life draws its own place");
}

/* -1e-17 - floor(-1e-17) is 1 in double, which is no share of a life. */
static void a_moment_that_rounds_to_a_birth_is_that_birth(void)
{
    lom_emitter e = fall(1);
    lom_particle birth, p;
    CHECK(lom_place_particles(&e, 0, &birth, NULL) && lom_place_particles(&e, -1e-17, &p, NULL), "valid");
    CHECK(p.share == 0 && p.life == 0 && memcmp(p.place, birth.place, sizeof p.place) == 0, "share %g", p.share);
    CHECK(lom_place_particles(&e, -1e-9, &p, NULL) && p.life == -1 && p.share < 1 && p.alpha < 1e-8, "before it");
}

static bool is_same(const lom_particle *a, const lom_particle *b)
{
    return memcmp(a->place, b->place, sizeof a->place) == 0 && a->share == b->share && a->alpha == b->alpha &&
           a->life == b->life;
}

static void a_moment_alone_is_that_of_a_run(void)
{
    static lom_particle run[300], alone[300];
    lom_emitter e = fall(300);
    for (int n = 0; n <= 100; n++)
        CHECK(lom_place_particles(&e, n / 25.0, run, NULL), "valid");
    CHECK(lom_place_particles(&e, 4, alone, NULL), "valid");
    for (int i = 0; i < 300; i++)
        CHECK(is_same(&run[i], &alone[i]), "particle %d", i);
    CHECK(lom_place_particles(&e, 1e9, alone, NULL) && alone[299].share < 1, "the last time");
}

static void limits_are_refused_with_a_sentence(void)
{
    const double zero = 0, nan = (zero - zero) / zero;
    lom_particle p = { .life = 99 };
    lom_emitter bad[9];
    for (int i = 0; i < 9; i++)
        bad[i] = fall(1);
    bad[0].count = 1000000000;
    bad[1].count = LOM_MAX_PARTICLES + 1;
    bad[2].from[1] = nan;
    bad[3].to[2] = 1e300;
    bad[4].velocity[0] = nan;
    bad[5].wind[2] = nan;
    bad[6].spread = -1;
    bad[7].drag = nan;
    bad[8].life = 0;
    for (int i = 0; i < 9; i++) {
        lom_error error = { LOM_OK, "" };
        CHECK(!lom_place_particles(&bad[i], 0, &p, &error) && error.code == (i < 2 ? LOM_ERROR_LIMIT : LOM_ERROR_USAGE),
              "case %d", i);
        CHECK(error.text[0] != 0 && p.life == 99, "case %d: a sentence, and nothing written", i);
    }
    bad[0] = bad[1] = fall(1);
    bad[0].jets = -1;
    bad[1].jets = 2;
    bad[1].jet_time = nan;
    bad[2] = fall(1);
    bad[2].spread_up = nan;
    for (int i = 0; i < 3; i++)
        CHECK(!lom_place_particles(&bad[i], 0, &p, NULL) && p.life == 99, "jets %d", i);
    lom_emitter e = fall(1), none = fall(0), most = fall(LOM_MAX_PARTICLES);
    lom_error error = { LOM_OK, "" };
    CHECK(!lom_place_particles(&e, nan, &p, &error) && error.code == LOM_ERROR_USAGE, "no time");
    CHECK(lom_place_particles(&none, 0, NULL, NULL), "none at all");
    lom_particle *many = lom_allocate(LOM_MAX_PARTICLES, sizeof *many, NULL);
    CHECK(many != NULL && lom_place_particles(&most, 0.1, many, NULL) && many[999999].alpha > 0, "10^6");
    lom_release(many);
}

/* 257/256 is the next key after 1; 1 + 2^-9 shares the key of 1. */
static void order_is_far_to_near_and_stable(void)
{
    const float zero = 0, nan = (zero - zero) / zero;
    const float depth[10] = { 1, 2, 1 + 0x1p-9f, nan, 257 / 256.0f, 1e30f, -5, 2, 0, 1 };
    static const uint32_t expected[10] = { 5, 1, 7, 4, 0, 2, 9, 3, 6, 8 };
    uint32_t order[10], scratch[10];
    lom_order_particles(depth, 10, order, scratch);
    for (int i = 0; i < 10; i++)
        CHECK(order[i] == expected[i], "place %d: %u, expected %u", i, order[i], expected[i]);
    lom_order_particles(depth, 0, order, scratch);
    CHECK(order[0] == 5, "none is none");
}

/* What a jet has let out since it last turned lies together; each jet is elsewhere, and is elsewhere later; a moment
 * alone is that of a run. Jet j of 3 turns at the times (k - j/3)/2. */
static void jets_let_drops_out_together(void)
{
    static lom_particle p[3000], alone[3000];
    lom_emitter e = fall(3000);
    e.jets = 3;
    e.jet_time = 0.5;
    e.jet_width = 0.2;
    double middle[2][3];
    for (int n = 0; n < 2; n++) {
        CHECK(lom_place_particles(&e, 10.1 + 5 * n, p, NULL), "valid");
        for (int jet = 0; jet < 3; jet++) {
            double low = 1e9, high = -1e9;
            for (int i = jet; i < 3000; i += 3) {
                double age = p[i].share * e.life, x = p[i].place[0] - p[i].velocity[0] * age;
                low = age < 0.05 && x < low ? x : low;
                high = age < 0.05 && x > high ? x : high;
            }
            middle[n][jet] = (low + high) / 2;
            CHECK(high > low && high - low < 0.25, "jet %d is %g wide", jet, high - low);
        }
    }
    CHECK(distance(middle[0][0], middle[1][0]) > 0.01 && distance(middle[0][0], middle[0][1]) > 0.01, "places");
    CHECK(lom_place_particles(&e, 15.1, alone, NULL), "valid");
    for (int i = 0; i < 3000; i++)
        CHECK(is_same(&p[i], &alone[i]), "particle %d", i);
}

/* Over many lives, with wind and spread against the velocity; and the bound is not far from the drops. */
static void no_drop_leaves_its_bounds(void)
{
    lom_emitter e = fall(400);
    lom_particle p[400];
    double low[3], high[3], lowest = 1e9;
    e.jets = 5;
    e.jet_time = 0.3;
    e.jet_width = 0.5;
    lom_bound_emitter(&e, low, high);
    for (int n = 0; n < 200; n++) {
        CHECK(lom_place_particles(&e, 0.7 * n, p, NULL), "valid");
        for (int i = 0; i < 400; i++)
            for (int k = 0; k < 3; k++) {
                CHECK(p[i].place[k] >= low[k] && p[i].place[k] <= high[k], "particle %d axis %d", i, k);
                lowest = p[i].place[1] < lowest ? p[i].place[1] : lowest;
            }
    }
    CHECK(lowest - low[1] < 0.2, "the lowest drop is at %g, the bound at %g", lowest, low[1]);
}

int main(int argc, char **argv)
{
    RUN(flight_is_the_integral_of_the_equation);
    RUN(fall_time_inverts_the_flight);
    RUN(lives_follow_without_a_jump);
    RUN(birth_is_unseen_and_on_the_segment);
    RUN(a_moment_that_rounds_to_a_birth_is_that_birth);
    RUN(a_moment_alone_is_that_of_a_run);
    RUN(limits_are_refused_with_a_sentence);
    RUN(jets_let_drops_out_together);
    RUN(no_drop_leaves_its_bounds);
    RUN(order_is_far_to_near_and_stable);
    return check_result();
}
