/* Proves of exposure and tone curves: the closed forms of their papers in double, over every half; they rise, from 0 to at
 * most 1, and reach it where white is said to be; NaN, what is negative and infinities have a value; without a curve the
 * result is the light times a power of two; with exposure 0 and no curve nothing is asked for. */
#include "check.h"
#include "image/convert.h"
#include "render/tone.h"

#include <float.h>
#include <math.h>

enum { HALVES = 0x7c00 }; /* from 0 up to the largest */

static struct lom_tone tone(lom_curve curve, double exposure, double white)
{
    return lom_make_tone(&(lom_output){ .curve = curve, .exposure = exposure, .white = white });
}

/* ---- as the papers have them ---- */

static double reinhard(double x, double white)
{
    return x * (1 + x / (white * white)) / (1 + x);
}

static double hable(double x)
{
    const double A = 0.15, B = 0.50, C = 0.10, D = 0.20, E = 0.02, F = 0.30;
    return ((x * (A * x + C * B) + D * E) / (x * (A * x + B) + D * F)) - E / F;
}

static double filmic(double x, double white)
{
    return hable(x) / hable(white);
}

static double aces(double x, double white)
{
    (void)white;
    return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
}

static const struct {
    const char *name;
    lom_curve curve;
    double (*form)(double x, double white);
} curves[] = { { "reinhard", LOM_CURVE_REINHARD, reinhard },
               { "filmic", LOM_CURVE_FILMIC, filmic },
               { "aces", LOM_CURVE_ACES, aces } };
enum { CURVES = sizeof curves / sizeof *curves };

static const double whites[] = { 1, 1.5, 8, 11.2, 1e6 };
enum { WHITES = sizeof whites / sizeof *whites };

static void curves_are_those_of_the_papers(void)
{
    for (size_t i = 0; i < CURVES; i++)
        for (size_t w = 0; w < WHITES; w++)
            for (int exposure = -10; exposure <= 10; exposure += 5) {
                const struct lom_tone t = tone(curves[i].curve, exposure, whites[w]);
                double worst = 0;
                for (unsigned half = 0; half < HALVES; half++) {
                    const double x = lom_float_of_half((uint16_t)half), lit = ldexp(x, exposure);
                    double expected = curves[i].form(lit, whites[w]);
                    expected = expected > 1 || (curves[i].curve != LOM_CURVE_ACES && lit > whites[w]) ? 1 : expected;
                    const double got = (double)lom_tone_of(&t, (float)x);
                    const double error = fabs(got - expected) / (fabs(expected) + 1e-6);
                    worst = error > worst ? error : worst;
                }
                CHECK(worst < 1e-7, "%s, white %g, exposure %d: a share of %g apart", curves[i].name, whites[w],
                      exposure, worst);
            }
}

static void curves_rise_from_0_to_1(void)
{
    for (size_t i = 0; i < CURVES; i++)
        for (size_t w = 0; w < WHITES; w++) {
            const struct lom_tone t = tone(curves[i].curve, 0, whites[w]);
            float before = lom_tone_of(&t, 0);
            CHECK(before == 0 && !signbit(before), "%s of 0 is %g", curves[i].name, (double)before);
            for (unsigned half = 1; half < HALVES; half++) {
                const float x = lom_float_of_half((uint16_t)half), y = lom_tone_of(&t, x);
                if (!(y >= before && y <= 1)) {
                    CHECK(false, "%s, white %g: %g after %g at %g", curves[i].name, whites[w], (double)y,
                          (double)before, (double)x);
                    break;
                }
                before = y;
            }
            CHECK(lom_tone_of(&t, FLT_MAX) == 1, "%s of the largest float", curves[i].name);
        }
}

/* The floats next to one another where the curve is flattest. */
static void curves_rise_between_neighbours(void)
{
    for (size_t i = 0; i < CURVES; i++) {
        const struct lom_tone t = tone(curves[i].curve, 0, 8);
        float x = 6, before = 0;
        int falls = 0;
        for (int step = 0; step < 2000000; step++, x = nextafterf(x, 9)) {
            const float y = lom_tone_of(&t, x);
            falls += y < before;
            before = y;
        }
        CHECK(falls == 0, "%s falls %d times from 6 to %g", curves[i].name, falls, (double)x);
    }
}

static void white_is_where_it_is_said_to_be(void)
{
    for (size_t i = 0; i < CURVES; i++) {
        const bool own = curves[i].curve == LOM_CURVE_ACES;
        const struct lom_tone t = tone(curves[i].curve, 1, 8);
        const float at = own ? 3.6214f : 4, below = own ? 3.6f : 3.9f; /* aces: 7.2428 after exposure */
        CHECK(lom_tone_of(&t, at) == 1, "%s at white is %.9g", curves[i].name, (double)lom_tone_of(&t, at));
        CHECK(lom_tone_of(&t, below) < 1, "%s below white is 1", curves[i].name);
    }
    const struct lom_tone line = tone(LOM_CURVE_REINHARD, 0, 1);
    for (unsigned half = 0; half <= 0x3c00; half++) {
        const float x = lom_float_of_half((uint16_t)half);
        if (lom_tone_of(&line, x) != x) {
            CHECK(false, "reinhard with white 1 of %g is %.9g", (double)x, (double)lom_tone_of(&line, x));
            break;
        }
    }
}

static void all_numbers_have_a_value(void)
{
    for (size_t i = 0; i < CURVES; i++)
        for (int exposure = -10; exposure <= 10; exposure += 10) {
            const struct lom_tone t = tone(curves[i].curve, exposure, 8);
            CHECK(lom_tone_of(&t, NAN) == 0 && lom_tone_of(&t, -1) == 0 && lom_tone_of(&t, -INFINITY) == 0 &&
                      lom_tone_of(&t, -0.0f) == 0 && lom_tone_of(&t, INFINITY) == 1,
                  "%s, exposure %d", curves[i].name, exposure);
        }
}

static void exposure_is_a_power_of_two(void)
{
    for (int exposure = -10; exposure <= 10; exposure++) {
        const struct lom_tone t = tone(LOM_CURVE_CLAMP, exposure, 8);
        static const float lights[] = { 0, 0.1f, 1, 7.3f, -2.5f, 60000 };
        for (size_t i = 0; i < sizeof lights / sizeof *lights; i++)
            CHECK(lom_tone_of(&t, lights[i]) == ldexpf(lights[i], exposure), "%g by %d stops", (double)lights[i],
                  exposure);
        CHECK(isnan(lom_tone_of(&t, NAN)), "NaN is hidden without a curve");
    }
}

static void the_defaults_ask_for_nothing(void)
{
    CHECK(!lom_is_toned(&(lom_output){ .white = 8 }), "the defaults are toned");
    CHECK(!lom_is_toned(&(lom_output){ .white = 8, .exposure = -0.0 }), "exposure -0 is toned");
    CHECK(lom_is_toned(&(lom_output){ .white = 8, .exposure = 1e-300 }), "an exposure is not toned");
    CHECK(lom_is_toned(&(lom_output){ .white = 8, .curve = LOM_CURVE_REINHARD }), "a curve is not toned");
}

int main(int argc, char **argv)
{
    RUN(curves_are_those_of_the_papers);
    RUN(curves_rise_from_0_to_1);
    RUN(curves_rise_between_neighbours);
    RUN(white_is_where_it_is_said_to_be);
    RUN(all_numbers_have_a_value);
    RUN(exposure_is_a_power_of_two);
    RUN(the_defaults_ask_for_nothing);
    return check_result();
}
