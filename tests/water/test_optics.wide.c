/* Proves the optics of water at every width: closed forms at the angles that have one, conservation and reciprocity,
 * Snell's law, total reflection, extremes, and the distance of each approximation from the exact equations. */
#include "check.h"

#include "water/seen_facets.h"

#include <lom/water.h>

#define EPS 1.1920929e-7 /* 2^-23 */

static double fresnel(double cosine, double eta)
{
    return lom_fresnel_exact(lom_splat((float)cosine), lom_splat((float)eta))[LOM_LANES - 1];
}

static float angle_cosine(int i, int count)
{
    return (float)lom_double_cos(1.5707963267948966 * i / count);
}

static lom_float3 ray(double angle, double turn)
{
    double s = lom_double_sin(angle);
    return lom_splat3((float)(s * lom_double_cos(turn)), (float)-lom_double_cos(angle),
                      (float)(s * lom_double_sin(turn)));
}

static double length3(lom_float3 v)
{
    double x = v.x[0], y = v.y[0], z = v.z[0];
    return lom_double_sqrt(x * x + y * y + z * z);
}

static const double indices[] = { 1 / 1.333, 1.333, 1 / 1.5, 1.5, 0.2, 5, 1.0001, 1 / 1.0001 };
enum { INDICES = sizeof indices / sizeof indices[0] };

static void o1_fresnel_at_normal_and_grazing_incidence(void)
{
    for (int i = 0; i < INDICES; i++) {
        double eta = (float)indices[i], root = (eta - 1) / (eta + 1);
        double got = fresnel(1, eta);
        CHECK(got >= root * root * (1 - 8 * EPS) - 1e-12 && got <= root * root * (1 + 8 * EPS) + 1e-12,
              "eta %g gives %g, not %g", eta, got, root * root);
        CHECK(fresnel(0, eta) == 1, "eta %g at 90 degrees gives %.9g", eta, fresnel(0, eta));
    }
    for (int i = 0; i < 1000; i++) {
        lom_float3 d = ray(1.5707 * i / 1000, 0.7 * i), n = lom_splat3(0, 1, 0), out;
        CHECK(fresnel(-d.y[0], 1) == 0, "equal indices reflect %g", fresnel(-d.y[0], 1));
        CHECK(lom_all(lom_refract3(d, n, lom_splat(1), &out)), "equal indices reflect all");
        CHECK(out.x[0] == d.x[0] && out.y[0] == d.y[0] && out.z[0] == d.z[0], "equal indices bend the ray %d", i);
    }
}

static void o2_total_reflection_beyond_the_critical_angle(void)
{
    for (int i = 0; i < INDICES; i++) {
        float eta = (float)indices[i];
        if (eta <= 1)
            continue;
        float critical = (float)lom_double_sqrt(1 - 1.0 / ((double)eta * eta));
        for (int step = -3; step <= 3; step++) {
            int32_t bits;
            float cosine;
            memcpy(&bits, &critical, 4);
            bits += step;
            memcpy(&cosine, &bits, 4);
            double r = fresnel(cosine, eta);
            CHECK(r > 0.9 && r <= 1, "eta %g, %d ulp from the critical angle: %g", eta, step, r);
            lom_float3 d = lom_splat3((float)lom_double_sqrt(1 - (double)cosine * cosine), -cosine, 0), out;
            lom_mask passes = lom_refract3(d, lom_splat3(0, 1, 0), lom_splat(eta), &out);
            CHECK(length3(out) > 0.9999 && length3(out) < 1.0001, "length %g", length3(out));
            CHECK(lom_all(passes) || out.x[0] == d.x[0], "a ray that is all reflected is bent");
        }
        lom_float3 flat = ray(1.5, 0), out;
        CHECK(fresnel(-flat.y[0], eta) == 1 || eta < 1.01f, "eta %g at 1.5 radians reflects %g", eta,
              fresnel(-flat.y[0], eta));
        CHECK(!lom_any(lom_refract3(flat, lom_splat3(0, 1, 0), lom_splat(eta), &out)) || eta < 1.01f, "light escapes");
    }
}

static double magnitude(double x)
{
    return x < 0 ? -x : x;
}

/* What rounding the cosine and the index to float may change, and a few roundings more. */
static double allowed(double cosine, double eta)
{
    double there = lom_fresnel_exact_double(cosine, eta);
    double by_cosine = lom_fresnel_exact_double(cosine * (1 - EPS), eta) - there;
    double by_index = lom_fresnel_exact_double(cosine, eta * (1 - EPS)) - there;
    return 4 * magnitude(by_cosine) + 4 * magnitude(by_index) + 8 * EPS;
}

/* At Brewster's angle tan a = n2 / n1 only one polarisation reflects: R = (s^2) / 2. Reversing the ray changes nothing,
 * and what is not reflected passes: T = 2 e c t (1 / (e c + t)^2 + 1 / (c + e t)^2). */
static void o3_brewster_reciprocity_and_conservation(void)
{
    for (int i = 0; i < INDICES; i++) {
        double eta = (float)indices[i], brewster = lom_double_atan(1 / eta);
        double c = lom_double_cos(brewster), t = lom_double_cos(1.5707963267948966 - brewster);
        double s = (eta * c - t) / (eta * c + t), off = fresnel(c, eta) - 0.5 * s * s;
        CHECK(off < allowed(c, eta) && off > -allowed(c, eta), "eta %g: off by %g", eta, off);
        for (int k = 0; k < 1000 && eta < 1; k++) {
            double cosine = angle_cosine(k, 1000);
            double across = (float)lom_double_sqrt(1 - eta * eta * (1 - cosine * cosine));
            double there = fresnel(cosine, eta), back = fresnel(across, (float)(1 / eta)) - there;
            double slope = allowed(cosine, eta) + allowed(across, (float)(1 / eta));
            CHECK(back < slope && back > -slope, "eta %g cosine %g: back %g more", eta, cosine, back);
            double e = eta * cosine + across, f = cosine + eta * across;
            double sum = there + 2 * eta * cosine * across * (1 / (e * e) + 1 / (f * f)) - 1;
            CHECK(sum < slope && sum > -slope, "eta %g cosine %g: R + T - 1 = %g", eta, cosine, sum);
        }
    }
}

static void o4_snells_law(void)
{
    for (int i = 0; i < INDICES; i++)
        for (int k = 0; k < 500; k++) {
            double angle = 1.57 * k / 500;
            lom_float3 d = ray(angle, 0.3 * k), n = lom_splat3(0, 1, 0), out;
            float eta = (float)indices[i];
            if (!lom_all(lom_refract3(d, n, lom_splat(eta), &out)))
                continue;
            double scale = 1 + eta, error = length3(out) - length3(d);
            CHECK(error < 4 * EPS * scale && error > -4 * EPS * scale, "eta %g: length off by %g", eta, error);
            double in_x = eta * d.x[0] - out.x[0], in_z = eta * d.z[0] - out.z[0];
            CHECK(in_x * in_x + in_z * in_z < 64 * EPS * EPS, "eta %g: the tangent is off by %g %g", eta, in_x, in_z);
        }
}

static void o4_lanes_follow_the_double_twin(void)
{
    for (int k = 0; k < 4000; k++) {
        double angle = 1.5 * lom_random_uniform(1, (uint64_t)k), turn = 6.28 * lom_random_uniform(2, (uint64_t)k);
        float eta = (float)(0.5 + 1.5 * lom_random_uniform(3, (uint64_t)k));
        lom_float3 d = ray(angle, turn), m = ray(0.3 * lom_random_uniform(4, (uint64_t)k), -turn), out;
        lom_float3 n = lom_scale3(m, lom_splat(k & 1 ? -1.0f : 1.0f));
        lom_vec3 wide, dd = { d.x[0], d.y[0], d.z[0] }, nn = { n.x[0], n.y[0], n.z[0] };
        bool passes = lom_refract_double(dd, nn, eta, &wide);
        bool lanes = lom_all(lom_refract3(d, n, lom_splat(eta), &out));
        double ratio = lom_vec3_dot(dd, nn) > 0 ? 1.0 / eta : eta, c = lom_vec3_dot(dd, nn);
        double square = 1 - ratio * ratio * (1 - c * c), near = 1e-5;
        if (square < near && square > -near)
            continue; /* which of the two it is hangs on the last bit */
        CHECK(passes == lanes, "case %d", k);
        double off = lom_vec3_length(lom_vec3_subtract(wide, (lom_vec3){ out.x[0], out.y[0], out.z[0] }));
        CHECK(off < 2000 * EPS, "case %d is off by %g", k, off);
        double cosine = c < 0 ? -c : c, exact = lom_fresnel_exact_double((float)cosine, (float)ratio);
        double got = fresnel(cosine, (float)ratio);
        CHECK(got - exact < 1e-4 && exact - got < 1e-4, "case %d reflects %g, not %g", k, got, exact);
    }
}

static bool is_unit_range(double x)
{
    return x >= 0 && x <= 1;
}

static void o5_extremes_are_defined(void)
{
    static const float etas[] = { 1e-6f, 1e6f, 0, -0.0f, 1e30f, 1e-30f, __builtin_inff(), __builtin_nanf("") };
    for (size_t i = 0; i < sizeof etas / sizeof etas[0]; i++)
        for (int k = 0; k <= 64; k++) {
            double r = fresnel(angle_cosine(k, 64), etas[i]);
            CHECK(is_unit_range(r), "eta %g, step %d reflects %g", etas[i], k, r);
        }
    CHECK(fresnel(0.5, __builtin_nanf("")) == 1, "NaN is no index");
    lom_float3 d = ray(0.7, 1), out;
    CHECK(lom_all(lom_refract3(d, lom_splat3(0, 0, 0), lom_splat(0.75f), &out)) && out.x[0] == d.x[0] &&
              out.y[0] == d.y[0],
          "a normal of length zero bends the ray");
    lom_float3 down = lom_splat3(0, -1, 0), up = lom_splat3(0, 1, 0);
    CHECK(lom_all(lom_refract3(down, up, lom_splat(0.75f), &out)) && out.x[0] == 0 && out.y[0] == -1,
          "a ray along the normal is bent: %g", out.y[0]);
    lom_float3 front, back;
    lom_refract3(d, up, lom_splat(0.75f), &front);
    lom_refract3(d, lom_splat3(0, -1, 0), lom_splat(1 / 0.75f), &back);
    CHECK(front.x[0] - back.x[0] < 4 * EPS && back.x[0] - front.x[0] < 4 * EPS, "the back face does not flip: %g %g",
          front.x[0], back.x[0]);
}

/* The largest error over all angles, for docs/water.md. */
static void o6_schlick_and_dot_against_exact(void)
{
    double schlick = 0, dot = 0;
    for (int k = 0; k <= 9000; k++) {
        float cosine = angle_cosine(k, 9000);
        double exact = lom_fresnel_exact_double(cosine, 1 / 1.333);
        double a = lom_fresnel_schlick(lom_splat(cosine), (float)(1 / 1.333))[0] - exact;
        double b = lom_fresnel_dot(lom_splat(cosine))[0] - exact;
        schlick = a * a > schlick * schlick ? a : schlick;
        dot = b * b > dot * dot ? b : dot;
        double twin = lom_fresnel_schlick_double(cosine, (float)(1 / 1.333));
        double off = lom_fresnel_schlick(lom_splat(cosine), (float)(1 / 1.333))[0] - twin;
        CHECK(off < 4 * EPS && off > -4 * EPS, "Schlick is off by %g", off);
    }
    CHECK(schlick < 0.06 && schlick > 0.055, "Schlick is off by %g", schlick);
    CHECK(dot > 0.5 && dot < 0.7, "the dot product is off by %g", dot);
}

static void o7_reflecting_twice_is_nothing(void)
{
    for (int k = 0; k < 1000; k++) {
        lom_float3 d = ray(1.5 * k / 1000, k), n = ray(0.4 * (k % 7), -k);
        lom_float3 twice = lom_reflect3(lom_reflect3(d, n), n);
        lom_float3 off = lom_sub3(twice, d);
        CHECK(length3(off) < 8 * EPS, "off by %g", length3(off));
    }
}

static void absorption_of_lengths_adds_up(void)
{
    double a[3], scatter[3];
    for (int type = 0; type < LOM_WATER_TYPE_COUNT; type++) {
        lom_water_type_optics((lom_water_type)type, a, scatter);
        float f[3] = { (float)a[0], (float)a[1], (float)a[2] };
        lom_float3 one = lom_transmittance(f, lom_splat(1.5f)), other = lom_transmittance(f, lom_splat(2.5f));
        lom_float3 both = lom_transmittance(f, lom_splat(4.0f)), product = lom_mul3(one, other);
        CHECK(length3(lom_sub3(both, product)) < 4 * EPS, "type %d", type);
        CHECK(a[0] > a[1] && scatter[2] > scatter[0], "type %d: red goes first, and blue comes back", type);
        CHECK(is_unit_range(scatter[0]) && is_unit_range(scatter[2]), "type %d scatters more than it gets", type);
    }
    const float clear[3] = { 0, 0, 0 };
    CHECK(lom_transmittance(clear, lom_splat(1e9f)).x[0] == 1, "clear water absorbs");
}

int main(int argc, char **argv)
{
    RUN(o1_fresnel_at_normal_and_grazing_incidence);
    RUN(o2_total_reflection_beyond_the_critical_angle);
    RUN(o3_brewster_reciprocity_and_conservation);
    RUN(o4_snells_law);
    RUN(o4_lanes_follow_the_double_twin);
    RUN(o5_extremes_are_defined);
    RUN(o6_schlick_and_dot_against_exact);
    RUN(o7_reflecting_twice_is_nothing);
    RUN(absorption_of_lengths_adds_up);
    return check_result();
}
