/* Proves, against closed forms: a medium seen by a transfer function is exact where its value is even or linear, at any
 * step, steps of the function among them; its shadow is the same integral; surfaces follow Lambert; no more light comes
 * than the function has; skipping changes no byte; and what is no function is refused. */
#include "check.h"
#include "media.h"

#include "base/numbers.h"

#include <string.h>

static const lom_transfer_desc bare = { .look = LOM_LOOK_GLOWING, .size = { 1, 1, 1 }, .to_light = { 0, 1, 0 } };

static lom_transfer_function made(const lom_transfer_point *points, size_t count)
{
    lom_transfer_function transfer;
    lom_error error = { 0 };
    CHECK(lom_make_transfer_function(points, count, &transfer, &error), "%s", error.text);
    return transfer;
}

/* Random points; some of them steps. */
static size_t random_points(uint32_t *state, lom_transfer_point points[LOM_MAX_TRANSFER])
{
    size_t count = 1 + (size_t)uniform(state, 0, LOM_MAX_TRANSFER - 0.01);
    double value = 0;
    for (size_t i = 0; i < count; i++) {
        if (uniform(state, 0, 1) < 0.7)
            value += uniform(state, 0, 1 - value);
        points[i] = (lom_transfer_point){ value,
                                          uniform(state, 0, 1) < 0.3 ? 0 : uniform(state, 0, 1),
                                          { uniform(state, 0, 2), uniform(state, 0, 1), uniform(state, 0, 1) } };
    }
    return count;
}

/* Channel k of the function in double (3: extinction): of equal values the last point. */
static double channel_of(const lom_transfer_point *p, int k)
{
    return k == 3 ? p->extinction : p->color[k] * p->extinction;
}

static double function_at(const lom_transfer_point *points, size_t count, int k, double value)
{
    size_t above = 0;
    while (above < count && points[above].value <= value)
        above++;
    if (above == 0 || above == count)
        return channel_of(&points[above == 0 ? 0 : count - 1], k);
    const lom_transfer_point *a = &points[above - 1], *b = &points[above];
    double part = (value - a->value) / (b->value - a->value);
    return channel_of(a, k) + part * (channel_of(b, k) - channel_of(a, k));
}

/* The integral from a to b by its definition: the midpoint rule, fine. */
static double integral_of(const lom_transfer_point *points, size_t count, int k, double a, double b)
{
    enum { PARTS = 20000 };
    double sum = 0;
    for (int i = 0; i < PARTS; i++)
        sum += function_at(points, count, k, a + (b - a) * (i + 0.5) / PARTS);
    return sum * (b - a) / PARTS;
}

static lom_transfer_result seen_by(const lom_medium_rays *rays, const lom_medium_desc *medium,
                                   const lom_transfer_function *transfer)
{
    lom_transfer_desc desc = bare;
    lom_transfer_result result;
    desc.transfer = transfer;
    LOM_WIDE(lom_march_transfer)(&result, rays, medium, &desc, NULL);
    return result;
}

static double half(double x)
{
    (void)x;
    return 26214 / 65535.0; /* 0.4, which 16 bits hold */
}

/* A slab of one value: Beer and Lambert, with the function's own extinction and colour. */
static void slab_is_beer_lambert(void)
{
    lom_medium *medium = medium_along_x(8, half);
    uint32_t state = 1;
    for (int i = 0; i < 300; i++) {
        lom_transfer_point points[LOM_MAX_TRANSFER];
        size_t count = random_points(&state, points);
        lom_transfer_function transfer = made(points, count);
        int steps = 1 + i % 40;
        lom_medium_desc desc = plain(medium, uniform(&state, 0, 12), 1.0 / steps);
        lom_medium_rays rays = rays_along_x(0, 1);
        lom_transfer_result seen = seen_by(&rays, &desc, &transfer);
        double k = function_at(points, count, 3, 0.4), want = lom_double_exp(-k * (double)desc.extinction);
        CHECK(magnitude((double)seen.transmittance[0] - want) <= (64 + steps) * 0x1p-24, "%d: %.9g, not %.9g", i,
              (double)seen.transmittance[0], want);
        double red = k > 0 ? function_at(points, count, 0, 0.4) / k * (1 - want) : 0;
        CHECK(magnitude((double)seen.color.x[0] - red) <= 1e-5, "%d: red %.9g, not %.9g", i, (double)seen.color.x[0],
              red);
    }
    lom_free_medium(medium);
}

/* The value rises evenly from 0.25 to 0.75: a step of the function takes what lies above it, at any step of the march. */
static void step_takes_what_lies_above(void)
{
    lom_medium *medium = medium_along_x(64, ramp);
    for (int i = 0; i <= 20; i++)
        for (int steps = 1; steps < 100; steps = steps * 2 + 1) {
            double at = 0.2 + 0.03 * i, above = at < 0.25 ? 0.5 : at > 0.75 ? 0 : 0.75 - at;
            const lom_transfer_point points[] = { { at, 0, { 0 } }, { at, 1, { 1, 1, 1 } } };
            lom_transfer_function transfer = made(points, 2);
            lom_medium_desc desc = plain(medium, 3, 0.5 / steps);
            lom_medium_rays rays = rays_along_x(0.25, 0.75);
            rays.shift = lom_splat(0.3f);
            double got = (double)seen_by(&rays, &desc, &transfer).transmittance[0], want = lom_double_exp(-3 * above);
            CHECK(magnitude(got - want) < 1e-4, "a step at %g, %d steps: %g, not %g", at, steps, got, want);
            lom_float depth;
            LOM_WIDE(lom_transfer_depth)(&depth, &rays, &desc, &transfer, steps);
            CHECK(magnitude((double)depth[0] - 3 * above) < 1e-4, "shadow of a step at %g, %d steps: %g", at, steps,
                  (double)depth[0]);
        }
    lom_free_medium(medium);
}

/* Any function over an even rise, forwards and back: its integral. */
static void even_rise_is_the_integral(void)
{
    lom_medium *medium = medium_along_x(64, ramp);
    uint32_t state = 7;
    for (int i = 0; i < 60; i++) {
        lom_transfer_point points[LOM_MAX_TRANSFER];
        size_t count = random_points(&state, points);
        lom_transfer_function transfer = made(points, count);
        double low = uniform(&state, 0.05, 0.4), high = uniform(&state, 0.6, 0.95);
        lom_medium_desc desc = plain(medium, 1e-4, uniform(&state, 0.01, 1));
        lom_medium_rays rays = rays_along_x(low, high);
        lom_transfer_result seen = seen_by(&rays, &desc, &transfer);
        const lom_float got[3] = { seen.color.x, seen.color.y, seen.color.z };
        for (int k = 0; k < 3; k++) {
            double want = 1e-4 * integral_of(points, count, k, low, high);
            CHECK(magnitude((double)got[k][0] - want) < 3e-8, "%d, channel %d: %g, not %g", i, k, (double)got[k][0],
                  want);
        }
        lom_float depth;
        LOM_WIDE(lom_transfer_depth)(&depth, &rays, &desc, &transfer, 3);
        double want = 1e-4 * integral_of(points, count, 3, low, high);
        CHECK(magnitude((double)depth[0] - want) < 3e-8, "%d: depth %g, not %g", i, (double)depth[0], want);
    }
    lom_free_medium(medium);
}

/* Extinction that is the value itself, white: the medium as it is, to the order of both rules. */
static void the_value_itself_is_the_medium(void)
{
    const lom_transfer_point points[] = { { 0, 0, { 1, 1, 1 } }, { 1, 1, { 1, 1, 1 } } };
    lom_transfer_function transfer = made(points, 2);
    lom_medium *medium = medium_along_x(64, exponential);
    lom_medium_desc desc = plain(medium, 4, 1.0 / 200);
    lom_medium_rays rays = rays_along_x(0, 1);
    double got = (double)seen_by(&rays, &desc, &transfer).transmittance[0],
           want = (double)march(&rays, &desc).transmittance[0];
    CHECK(magnitude(got - want) < 1e-4, "%g, not %g", got, want);
    lom_free_medium(medium);
}

static lom_medium *random_medium(uint32_t *state)
{
    lom_image *image = lom_create_image(9, 7, 8, LOM_FORMAT_R16, NULL);
    for (size_t i = 0; i < 9 * 7 * 8; i++)
        ((uint16_t *)image->pixels)[i] = (uint16_t)(uniform(state, 0, 1) < 0.6 ? 0 : (int)uniform(state, 0, 65535));
    lom_medium *medium = lom_create_medium(image, NULL);
    lom_free_image(image);
    return medium;
}

/* What is sent is at most the largest colour in parts of what does not come through; and more extinction never lets more
 * through. */
static void light_is_bounded_and_falls(void)
{
    uint32_t state = 3;
    for (int i = 0; i < 200; i++) {
        lom_medium *medium = random_medium(&state);
        lom_transfer_point points[LOM_MAX_TRANSFER];
        size_t count = random_points(&state, points);
        lom_transfer_function thin = made(points, count);
        double most = 0;
        for (size_t k = 0; k < count; k++) {
            most = points[k].color[0] > most ? points[k].color[0] : most;
            points[k].extinction += (1 - points[k].extinction) * uniform(&state, 0, 1);
        }
        lom_transfer_function thick = made(points, count);
        lom_medium_desc desc = plain(medium, uniform(&state, 0, 60), uniform(&state, 0.01, 0.3));
        lom_medium_rays rays = random_rays(&state, 1);
        lom_transfer_result a = seen_by(&rays, &desc, &thin), b = seen_by(&rays, &desc, &thick);
        for (int lane = 0; lane < LOM_LANES; lane++) {
            double through = (double)a.transmittance[lane], red = (double)a.color.x[lane];
            CHECK(through >= -1e-6 && through <= 1 && red >= 0 && red <= most * (1 - through) * (1 + 1e-4) + 1e-6,
                  "%d: %g comes through, %g is sent of at most %g", i, through, red, most);
            CHECK((double)b.transmittance[lane] <= through + 1e-5, "%d: %g, with more extinction %g", i, through,
                  (double)b.transmittance[lane]);
        }
        lom_free_medium(medium);
    }
}

/* Skipping gives the bytes of walking; rays that are not there, whatever numbers are in them, give and change nothing. */
static void skipping_changes_no_byte(void)
{
    uint32_t state = 5;
    for (int i = 0; i < 200; i++) {
        lom_medium *medium = random_medium(&state);
        lom_transfer_point points[LOM_MAX_TRANSFER];
        size_t count = random_points(&state, points);
        if (i % 4 != 0)
            points[0] = (lom_transfer_point){ 0, 0, { 1, 1, 1 } };
        lom_transfer_function transfer = made(points, count);
        CHECK(i % 4 == 0 || count > 1 || transfer.empty_is_clear, "what is empty is clear");
        lom_medium_desc desc = plain(medium, uniform(&state, 0, 60), uniform(&state, 0.01, 0.1)), walk = desc;
        walk.walk = true;
        lom_medium_rays rays = random_rays(&state, 1), poisoned = rays;
        lom_transfer_result a = seen_by(&rays, &desc, &transfer), b = seen_by(&rays, &walk, &transfer);
        CHECK(memcmp(&a, &b, sizeof a) == 0, "%d: skipping and walking differ", i);
        lom_float near, far;
        LOM_WIDE(lom_transfer_depth)(&near, &rays, &desc, &transfer, 20);
        LOM_WIDE(lom_transfer_depth)(&far, &rays, &walk, &transfer, 20);
        CHECK(memcmp(&near, &far, sizeof near) == 0, "%d: shadows by skipping and walking differ", i);
        lom_mask gone = lom_splat_int(0);
        gone[0] = -1;
        poisoned.active &= ~gone;
        poisoned.start.x = lom_select(gone, lom_splat(__builtin_nanf("")), poisoned.start.x);
        lom_transfer_result c = seen_by(&poisoned, &desc, &transfer);
        CHECK(c.transmittance[0] == 1 && c.color.x[0] == 0 && c.distance[0] == 0, "%d: a ray that is not there", i);
        for (int lane = 1; lane < LOM_LANES; lane++)
            CHECK(c.transmittance[lane] == a.transmittance[lane] && c.color.y[lane] == a.color.y[lane],
                  "%d: lane %d changed", i, lane);
        lom_free_medium(medium);
    }
}

/* A rise along x, seen along it: its surfaces face the eye, whichever way the value goes. */
static void surfaces_follow_lambert(void)
{
    lom_medium *up = medium_along_x(64, ramp), *down = medium_along_x(64, exponential);
    const lom_transfer_point points[] = { { 0, 1, { 0.5, 0.5, 0.5 } } };
    lom_transfer_function transfer = made(points, 1);
    for (int i = 0; i <= 12; i++) {
        double angle = i * lom_two_pi / 24, cosine = lom_double_cos(angle);
        lom_transfer_desc look = { .transfer = &transfer,
                                   .look = LOM_LOOK_SURFACE,
                                   .sun = { 3, 2, 1 },
                                   .sky = { 0.25f, 0, 0 },
                                   .ground = { 0.5f, 0, 0 },
                                   .size = { 1, 1, 1 },
                                   .to_light = { -(float)cosine, (float)lom_double_sin(angle), 0 } };
        for (int k = 0; k < 2; k++) {
            lom_medium_desc desc = plain(k == 0 ? up : down, 5, 0.1);
            lom_medium_rays rays = rays_along_x(0.2, 0.8);
            lom_transfer_result seen;
            LOM_WIDE(lom_march_transfer)(&seen, &rays, &desc, &look, NULL);
            double share = 0.5 * (1 - lom_double_exp(-3)), lit = cosine > 0 ? cosine : 0;
            CHECK(magnitude((double)seen.color.y[0] - share * 2 * lit) < 1e-4, "%d: %g, not %g", i,
                  (double)seen.color.y[0], share * 2 * lit);
            CHECK(magnitude((double)seen.color.x[0] - share * (3 * lit + 0.375)) < 1e-4, "%d: half sky, half ground",
                  i);
        }
    }
    lom_free_medium(up);
    lom_free_medium(down);
}

static void what_is_no_function_is_refused(void)
{
    const double nan = __builtin_nan(""), inf = __builtin_inf();
    static lom_transfer_point many[LOM_MAX_TRANSFER + 1];
    const struct {
        lom_transfer_point points[2];
        const char *sentence;
    } rows[] = { { { { -0.1, 0, { 0 } } }, "do not fall" },
                 { { { 0.5, 0, { 0 } }, { 0.4, 0, { 0 } } }, "0.4 follows 0.5" },
                 { { { 0.5, 0, { 0 } }, { 1.01, 0, { 0 } } }, "lie in 0 to 1" },
                 { { { nan, 0, { 0 } } }, "do not fall" },
                 { { { 0, 1.5, { 0 } } }, "extinction" },
                 { { { 0, nan, { 0 } } }, "extinction" },
                 { { { 0, 0, { 0, -1, 0 } } }, "colours" },
                 { { { 0, 0, { 0, 0, inf } } }, "colours" },
                 { { { 0, 0, { nan, 0, 0 } } }, "colours" } };
    lom_transfer_function transfer;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        lom_error error = { 0 };
        CHECK(!lom_make_transfer_function(rows[i].points, 2, &transfer, &error) && error.code == LOM_ERROR_USAGE &&
                  strstr(error.text, rows[i].sentence) != NULL,
              "%zu: \"%s\"", i, error.text);
    }
    CHECK(!lom_make_transfer_function(many, 0, &transfer, NULL) &&
              !lom_make_transfer_function(NULL, 1, &transfer, NULL) &&
              !lom_make_transfer_function(many, LOM_MAX_TRANSFER + 1, &transfer, NULL) &&
              lom_make_transfer_function(many, LOM_MAX_TRANSFER, &transfer, NULL),
          "1 to %d points", LOM_MAX_TRANSFER);
}

int main(int argc, char **argv)
{
    RUN(slab_is_beer_lambert);
    RUN(step_takes_what_lies_above);
    RUN(even_rise_is_the_integral);
    RUN(the_value_itself_is_the_medium);
    RUN(light_is_bounded_and_falls);
    RUN(skipping_changes_no_byte);
    RUN(surfaces_follow_lambert);
    RUN(what_is_no_function_is_refused);
    return check_result();
}
