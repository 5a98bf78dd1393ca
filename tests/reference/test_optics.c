/* Proves Fresnel's equations and Snell's law against their closed forms and extremes (O1 to O7). */
#include "base/numbers.h"
#include "check.h"
#include "reference/vectors.h"

#include <lom/reference.h>

static const double EPSILON = 0x1p-52, RIGHT_ANGLE = 1.5707963267948966;
static const lom_vec3 UP = { 0, 1, 0 };
static const double indices[] = { 1.31, 1.33, 1.5, 2.42, 1 / 1.33, 1 / 2.42 };
enum { INDICES = 6 };

static bool near(double a, double b, double tolerance)
{
    return __builtin_fabs(a - b) <= tolerance;
}

/* A unit direction that comes in at this angle to the normal +y. */
static lom_vec3 incident(double angle, double turn)
{
    double s = lom_double_sin(angle);
    return (lom_vec3){ s * lom_double_cos(turn), -lom_double_cos(angle), s * lom_double_sin(turn) };
}

static void o1_upright_and_grazing(void)
{
    for (int i = 0; i < INDICES; i++) {
        double n = indices[i], upright = (n - 1) / (n + 1);
        CHECK(near(lom_reference_fresnel(1, n), upright * upright, 2 * EPSILON));
        CHECK(lom_reference_fresnel(0, n) == 1);
    }
    CHECK(near(lom_reference_fresnel(1, 1.33), 0.020059312, 1e-9)); /* water: two percent */
    lom_vec3 d = unit((lom_vec3){ 0.3, -0.2, 0.9 }), out = { 0, 0, 0 };
    CHECK(lom_reference_fresnel(0, 1) == 0 && lom_reference_fresnel(0.5, 1) == 0);
    CHECK(lom_reference_refract(d, UP, 1, &out) && out.x == d.x && out.y == d.y && out.z == d.z);
}

static void o2_total_internal_reflection(void)
{
    double index = 1 / 1.33, critical = lom_double_asin(index), cosine = lom_double_cos(critical);
    lom_vec3 out = { 7, 7, 7 };
    CHECK(lom_reference_fresnel(cosine - 1e-9, index) == 1);
    CHECK(lom_reference_fresnel(cosine + 1e-9, index) < 1);
    CHECK(!lom_reference_refract(incident(critical + 1e-9, 0), UP, index, &out) && out.x == 7);
    CHECK(lom_reference_refract(incident(critical - 1e-9, 0), UP, index, &out) && near(out.y, 0, 1e-4));
    for (int i = -64; i <= 64; i++) { /* in units in the last place around the critical angle */
        double share = lom_reference_fresnel(cosine + i * (EPSILON / 2), index);
        CHECK(share > 0.99 && share <= 1);
    }
}

static void o3_brewster_and_reversal(void)
{
    for (int i = 0; i < INDICES; i++) {
        double n = indices[i], brewster = lom_double_atan(n);
        lom_vec3 out, d = incident(brewster, 1);
        CHECK(lom_reference_refract(d, UP, n, &out));
        CHECK(near(dot(lom_reference_mirror(d, UP), out), 0, 8 * EPSILON)); /* at right angles */
        double sine = lom_double_sin(2 * brewster - RIGHT_ANGLE);
        CHECK(near(lom_reference_fresnel(-d.y, n), sine * sine / 2, 4 * EPSILON)); /* one polarisation alone */
        for (int k = 1; k < 90; k++) {
            double cosine = lom_double_cos(k * RIGHT_ANGLE / 90);
            if (!lom_reference_refract(incident(k * RIGHT_ANGLE / 90, 0), UP, n, &out))
                continue;
            double there = lom_reference_fresnel(cosine, n), back = lom_reference_fresnel(-out.y, 1 / n);
            CHECK(near(there, back, 64 * EPSILON / cosine), "%g and %g at %d degrees", there, back, k);
        }
    }
}

static void o4_snell(void)
{
    for (int i = 0; i < INDICES; i++)
        for (int k = 0; k < 90; k++) {
            lom_vec3 d = incident(k * RIGHT_ANGLE / 90, k), out;
            if (!lom_reference_refract(d, UP, indices[i], &out))
                continue;
            CHECK(near(dot(out, out), 1, 4 * EPSILON));
            double in_front = lom_double_sqrt(d.x * d.x + d.z * d.z),
                   behind = lom_double_sqrt(out.x * out.x + out.z * out.z);
            CHECK(near(in_front, indices[i] * behind, 8 * EPSILON), "%d degrees", k);
            CHECK(out.y < 0 && near(out.x * d.z, out.z * d.x, 4 * EPSILON)); /* in the plane of incidence */
        }
    lom_vec3 straight;
    CHECK(lom_reference_refract((lom_vec3){ 0, -1, 0 }, UP, 1.33, &straight) && straight.y == -1 && straight.x == 0);
}

static void o5_extreme_indices(void)
{
    const double zero = 0, nan = zero / zero, strange[] = { 0, -1, nan, 1 / zero };
    lom_vec3 d = incident(0.5, 0), out = { 7, 7, 7 };
    for (int i = 0; i < 4; i++) {
        CHECK(lom_reference_fresnel(0.5, strange[i]) == 0);
        CHECK(!lom_reference_refract(d, UP, strange[i], &out) && out.x == 7);
    }
    CHECK(lom_reference_fresnel(0.5, 1e-6) == 1);
    CHECK(lom_reference_fresnel(0.5, 1e6) > 0.9999 && lom_reference_fresnel(0.5, 1e6) <= 1);
    CHECK(lom_reference_refract(d, UP, 1e6, &out) && near(out.y, -1, 1e-9));
    CHECK(lom_reference_fresnel(nan, 1.33) == 1 && lom_reference_fresnel(2, 1.33) == lom_reference_fresnel(1, 1.33));
    lom_vec3 still = lom_reference_mirror(d, (lom_vec3){ 0, 0, 0 });
    CHECK(still.x == d.x && still.y == d.y);
}

static void o6_schlick_differs_by_so_much(void)
{
    double upright = 0.33 / 2.33 * (0.33 / 2.33), largest = 0;
    for (int k = 0; k <= 9000; k++) {
        double cosine = lom_double_cos(k / 9000.0 * RIGHT_ANGLE), r = 1 - cosine;
        double schlick = upright + (1 - upright) * r * r * r * r * r;
        largest = lom_larger(__builtin_fabs(schlick - lom_reference_fresnel(cosine, 1.33)), largest);
    }
    CHECK(near(largest, 0.05992, 1e-5), "%g", largest); /* at 84 degrees */
}

static void o7_mirrored_twice(void)
{
    for (uint64_t i = 0; i < 1000; i++) {
        lom_vec3 d = incident(lom_random_uniform(2, i) * 3, lom_random_uniform(3, i) * 6);
        lom_vec3 n =
            unit((lom_vec3){ 2 * lom_random_uniform(1, i) - 1, lom_random_uniform(4, i), lom_random_uniform(5, i) });
        lom_vec3 twice = lom_reference_mirror(lom_reference_mirror(d, n), n);
        CHECK(length(difference(twice, d)) < 16 * EPSILON);
    }
}

int main(int argc, char **argv)
{
    RUN(o1_upright_and_grazing);
    RUN(o2_total_internal_reflection);
    RUN(o3_brewster_and_reversal);
    RUN(o4_snell);
    RUN(o5_extreme_indices);
    RUN(o6_schlick_differs_by_so_much);
    RUN(o7_mirrored_twice);
    return check_result();
}
