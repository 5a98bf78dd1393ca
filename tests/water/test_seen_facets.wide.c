/* Proves what an eye sees of rough water at every width against the walk of light among facets in double
 * (tests/rough_water.h): the share of light that it mirrors, and that what is smooth is a mirror. */
#include "check.h"
#include "rough_water.h"

#include "water/seen_facets.h"

static const double degree = 0.017453292519943295;

/* A level point with slopes of these variances along and across the view, seen by `angle` from upright. */
static struct lom_surface_point point_of(const rough_water *w, double angle)
{
    struct lom_surface_point p = { .normal = lom_splat3(0, 1, 0) };
    p.to_eye = lom_splat3((float)sin(angle), (float)cos(angle), 0);
    p.slopes.vxx = lom_splat((float)w->up);
    p.slopes.vzz = lom_splat((float)w->cross);
    return p;
}

static const struct lom_surface_uniforms uniforms = { .eta = 1 / 1.34f, .fresnel = LOM_FRESNEL_EXACT, .side = 1 };

/* Steeper slopes than those of a wind of 16 m/s are beyond what the model was fitted to. */
static void the_share_is_that_of_the_walk_among_facets(void)
{
    static const double deviations[] = { 0.01, 0.03, 0.06, 0.1, 0.15, 0.2, 0.3 };
    static const double angles[] = { 0, 30, 50, 60, 65, 70, 75, 80, 83, 86, 88, 89, 89.7 };
    for (int i = 0; i < 7; i++) {
        double worst = 0;
        for (int k = 0; k < 13; k++) {
            const double s = deviations[i], angle = angles[k] * degree, v[3] = { sin(angle), cos(angle), 0 };
            const rough_water w = { s * s, 0.64 * s * s, 1.34 };
            const struct lom_surface_point p = point_of(&w, angle);
            const double got = (double)lom_see_facets(&uniforms, &p).share[LOM_LANES - 1];
            const double off = got / walked_sky(&w, v, 100000) - 1;
            CHECK(fabs(off) < (s <= 0.2 ? 0.02 : 0.07), "deviation %g, %g degrees: %+.2f %%", s, angles[k], 100 * off);
            worst = fabs(off) > worst ? fabs(off) : worst;
        }
        printf("  slopes of %.2f: within %.2f %%\n", deviations[i], 100 * worst);
    }
}

/* Closed forms of the density (x + a)+ phi(a) against sums over a, and its quadrature against its own moments. */
static void closed_forms_are_their_integrals(void)
{
    for (double x = -1.2; x < 6; x += 0.3) {
        const struct lom_shown_slopes shown = lom_shown_slopes_of(lom_splat((float)x));
        double moment[4] = { 0, 0, 0, 0 }, nodes[4] = { 0, 0, 0, 0 };
        for (double a = -x + 5e-4; a < 9; a += 1e-3)
            for (int k = 0; k < 4; k++)
                moment[k] += 1e-3 * (x + a) * 0.3989422804014327 * exp(-a * a / 2) * pow(a, k);
        for (int i = 0; i < 2; i++)
            for (int k = 0; k < 4; k++)
                nodes[k] += (double)shown.weight[i][0] * pow((double)shown.at[i][0], k);
        CHECK(fabs((double)shown.whole[0] - moment[0]) < 2e-4 * (2 + fabs(x)), "at %g: %g, not %g", x,
              (double)shown.whole[0], moment[0]);
        CHECK(fabs((double)shown.mean[0] - moment[1] / moment[0]) < 0.01, "at %g: mean", x);
        for (int k = 0; k < 4; k++)
            CHECK(fabs(nodes[k] - moment[k] / moment[0]) < 0.01 + 0.02 * k * k, "at %g: moment %d is %g, not %g", x, k,
                  nodes[k], moment[k] / moment[0]);
        for (double z = -x + 0.2; z < 3; z += 0.4) {
            const struct lom_slope_part part = lom_part_of_slopes(lom_splat((float)x), lom_splat((float)z));
            double area = 0, times = 0;
            for (double a = -x + 5e-4; a < z; a += 1e-3) {
                area += 1e-3 * (x + a) * 0.3989422804014327 * exp(-a * a / 2);
                times += 1e-3 * a * (x + a) * 0.3989422804014327 * exp(-a * a / 2);
            }
            CHECK(fabs((double)part.area[0] - area) < 2e-3, "from %g to %g: %g, not %g", -x, z, (double)part.area[0],
                  area);
            CHECK(fabs((double)part.moment[0] - times) < 2e-3, "from %g to %g: %g, not %g", -x, z,
                  (double)part.moment[0], times);
        }
    }
}

/* What is mirrored and what is let through make up all facets that are seen; those that mirror lean away from an eye near
 * the horizon, where a facet mirrors more the less it shows. */
static void facets_that_mirror_and_those_that_do_not_make_up_all(void)
{
    for (int k = 20; k < 89; k++) {
        const rough_water w = { 0.02, 0.02, 1.34 };
        const struct lom_surface_point p = point_of(&w, k * degree);
        const struct lom_seen_facets seen = lom_see_facets(&uniforms, &p);
        const double share = (double)seen.share[0], x = cos(k * degree) / (sin(k * degree) * sqrt(w.up));
        const double mirrors = (double)(seen.mirroring.x[0] / seen.mirroring.y[0]);
        const double passes = (double)(seen.passing.x[0] / seen.passing.y[0]);
        const double mean = sqrt(w.up) * (double)lom_shown_slopes_of(lom_splat((float)x)).mean[0];
        CHECK(fabs(share * mirrors + (1 - share) * passes - mean) < 1e-4, "%d degrees: %g and %g, not %g", k, mirrors,
              passes, mean);
        CHECK(mirrors < passes, "%d degrees: %g mirrors, %g does not", k, mirrors, passes);
    }
}

static void smooth_water_is_a_mirror(void)
{
    const rough_water none = { 0, 0, 1.34 };
    for (int k = 0; k < 90; k++) {
        const struct lom_surface_point p = point_of(&none, k * degree);
        const struct lom_seen_facets seen = lom_see_facets(&uniforms, &p);
        const double want = smooth_reflectance(cos(k * degree), none.index);
        CHECK(fabs((double)seen.share[0] - want) < 1e-5, "%d degrees: %g, not %g", k, (double)seen.share[0], want);
        CHECK(seen.mirroring.y[0] == 1 && seen.passing.y[0] == 1, "%d degrees: a facet leans", k);
    }
}

/* What is turned away is seen by its rough facets alone, and is no number that is not one. */
static void what_is_turned_away_has_a_share(void)
{
    const rough_water w = { 0.01, 0.01, 1.34 };
    for (int k = 0; k < 100; k++) {
        struct lom_surface_point p = point_of(&w, 89 * degree);
        p.normal = lom_normalize3(lom_splat3((float)-k / 20, 1, 0));
        const double share = (double)lom_see_facets(&uniforms, &p).share[0];
        CHECK(share >= 0 && share <= 1, "slope %d / 20: %g", -k, share);
    }
}

int main(int argc, char **argv)
{
    RUN(the_share_is_that_of_the_walk_among_facets);
    RUN(closed_forms_are_their_integrals);
    RUN(facets_that_mirror_and_those_that_do_not_make_up_all);
    RUN(smooth_water_is_a_mirror);
    RUN(what_is_turned_away_has_a_share);
    return check_result();
}
