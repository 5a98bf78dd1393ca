/* Proves of drops that bounce: a step is the documented formula; on level ground a drop that falls from rest comes back to the
 * height h bounce^2 each time, within what a step is worth, and is never below the ground; on a slope it leaves mirrored at the
 * normal; before it hits anything it is within a step's fall of the exact flight; time that is not left changes nothing. */
#include "check.h"

#include "spray/spray.h"

#include <lom/stages.h>

#include <math.h>

enum { DROPS = 5, STRIDE = LOM_BOUNCE_FLOATS * sizeof(float) };

/* Steps the drops `steps` times; low and high: of each drop's height over all of them. */
static void run(float state[DROPS][LOM_BOUNCE_FLOATS], const struct lom_bounce_uniforms *u, int steps, float *high)
{
    static float other[DROPS][LOM_BOUNCE_FLOATS];
    lom_device *device = lom_open_device(&(lom_device_desc){ .threads = 1 });
    for (int n = 0; n < steps; n++) {
        lom_feedback f = { .data = other[0], .size = DROPS * STRIDE, .varyings = LOM_VARYINGS(0, LOM_BOUNCE_FLOATS) };
        lom_begin_pass(device, &(lom_pass_desc){ .feedback_only = true });
        lom_draw(device, &(lom_draw_desc){ .shader = &lom_bounce_shader,
                                           .uniforms = u,
                                           .attribute = { { state, DROPS * STRIDE, STRIDE, LOM_ATTRIBUTE_FLOAT4 },
                                                          { state[0] + LOM_BOUNCE_VELOCITY, DROPS * STRIDE - 16, STRIDE,
                                                            LOM_ATTRIBUTE_FLOAT3 } },
                                           .count = DROPS,
                                           .topology = LOM_POINTS,
                                           .feedback = &f });
        CHECK(lom_end_pass(device) && f.written == DROPS, "%s", lom_device_error(device)->text);
        memcpy(state, other, sizeof other);
        for (int i = 0; i < DROPS && high != NULL; i++) {
            high[n * DROPS + i] = state[i][1];
            CHECK(state[i][1] >= u->level, "step %d, drop %d: height %g", n, i, (double)state[i][1]);
        }
    }
    lom_close_device(device);
}

static void place(float *state, float y, float left, float vx, float vy)
{
    const float drop[LOM_BOUNCE_FLOATS] = { 0, y, 0, left, vx, vy, 0 };
    memcpy(state, drop, sizeof drop);
}

static void drops_come_back_to_a_part_of_their_height(void)
{
    enum { STEPS = 64 * 6 };
    static float state[DROPS][LOM_BOUNCE_FLOATS], high[STEPS * DROPS];
    struct lom_bounce_uniforms u = { .step = LOM_BOUNCE_STEP, .bounce = 0.7f, .level = -1 };
    for (int i = 0; i < DROPS; i++)
        place(state[i], 2.0f + (float)i, 100, 0, 0);
    run(state, &u, STEPS, high);
    for (int i = 0; i < DROPS; i++) {
        double height = 3 + i, peak = 0;
        int bounces = 0;
        for (int n = 1; n + 1 < STEPS && bounces < 2; n++) {
            float before = high[(n - 1) * DROPS + i], here = high[n * DROPS + i], after = high[(n + 1) * DROPS + i];
            if (!(here > before && here >= after))
                continue;
            peak = (double)here + 1;
            height *= 0.49;
            bounces++;
            CHECK(fabs(peak - height) < 0.09 * (3 + i), "drop %d, bounce %d: %g m, not %g", i, bounces, peak, height);
        }
        CHECK(bounces == 2, "drop %d bounces %d times", i, bounces);
    }
}

static void flights_are_exact_but_for_a_step(void)
{
    const double wind[3] = { 3, 0.5, -2 }, speed[3] = { 4, 6, 0 };
    for (int k = 0; k < 4; k++) {
        static float state[DROPS][LOM_BOUNCE_FLOATS];
        double drag = (const double[]){ 0, 0.3, 5, 1000 }[k];
        struct lom_bounce_uniforms u = {
            .step = LOM_BOUNCE_STEP, .drag = (float)drag, .wind = { 3, 0.5f, -2 }, .level = -1e6f
        };
        for (int i = 0; i < DROPS; i++)
            place(state[i], 0, 0.37f * (float)i, 4, 6);
        run(state, &u, 128, NULL);
        for (int i = 0; i < DROPS; i++) {
            double start[3] = { 0, 0, 0 }, now[3], age = (double)(0.37f * (float)i);
            lom_particle_flight(start, speed, wind, drag, age, now, NULL);
            CHECK(state[i][LOM_BOUNCE_LEFT] == 0, "drop %d has %g s left", i, (double)state[i][LOM_BOUNCE_LEFT]);
            for (int c = 0; c < 3; c++) /* an error of the first order: half a step of the change of velocity */
                CHECK(fabs(now[c] - (double)state[i][c]) < 0.0085 * (20 + 9.81 * age), "drag %g, age %g: %g, not %g",
                      drag, age, (double)state[i][c], now[c]);
        }
    }
}

static void a_slope_mirrors_at_its_normal(void)
{
    static const float heights[9] = { 0, 4, 8, 0, 4, 8, 0, 4, 8 }; /* rises by 1 along x */
    static float state[DROPS][LOM_BOUNCE_FLOATS];
    struct lom_bounce_uniforms u = { .step = LOM_BOUNCE_STEP,
                                     .bounce = 1,
                                     .heights = heights,
                                     .columns = 2,
                                     .rows = 2,
                                     .corner = { -4, -4 },
                                     .scale = { 0.25f, 0.25f } };
    for (int i = 0; i < DROPS; i++)
        place(state[i], 4.01f, LOM_BOUNCE_STEP, 0, -5.0f - (float)i);
    place(state[DROPS - 1], 4.01f, 0, 0, -9); /* no time left */
    run(state, &u, 1, NULL);
    for (int i = 0; i + 1 < DROPS; i++) {
        double down = 5 + i + 9.80665 / 64; /* straight down onto 45 degrees: away level */
        CHECK(fabs((double)state[i][LOM_BOUNCE_VELOCITY] + down) < 1e-4 &&
                  fabs((double)state[i][LOM_BOUNCE_VELOCITY + 1]) < 1e-4,
              "drop %d leaves with %g, %g", i, (double)state[i][LOM_BOUNCE_VELOCITY],
              (double)state[i][LOM_BOUNCE_VELOCITY + 1]);
        CHECK(state[i][1] == 4, "drop %d is at %g", i, (double)state[i][1]);
    }
    CHECK(state[DROPS - 1][1] == 4.01f && state[DROPS - 1][LOM_BOUNCE_VELOCITY + 1] == -9, "time that is not left");
}

/* Beside the map there is no ground; NaN stays with its drop. */
static void what_is_beside_the_ground_falls(void)
{
    static const float heights[4] = { 0, 0, 0, 0 };
    static float state[DROPS][LOM_BOUNCE_FLOATS];
    const struct lom_bounce_uniforms u = {
        .step = LOM_BOUNCE_STEP, .bounce = 1, .heights = heights, .columns = 1, .rows = 1, .scale = { 1, 1 }
    };
    for (int i = 0; i < DROPS; i++)
        place(state[i], 0.001f, 1, 0, -1);
    state[1][0] = -0.01f;
    state[2][0] = 1e30f;
    state[3][0] = __builtin_nanf("");
    state[4][0] = 1;
    run(state, &u, 1, NULL);
    CHECK(state[0][1] == 0 && state[4][1] == 0, "over the ground: %g, %g", (double)state[0][1], (double)state[4][1]);
    for (int i = 1; i < 4; i++)
        CHECK(state[i][1] < 0, "drop %d: %g", i, (double)state[i][1]);
}

int main(int argc, char **argv)
{
    RUN(drops_come_back_to_a_part_of_their_height);
    RUN(flights_are_exact_but_for_a_step);
    RUN(a_slope_mirrors_at_its_normal);
    RUN(what_is_beside_the_ground_falls);
    return check_failed_tests != 0;
}
