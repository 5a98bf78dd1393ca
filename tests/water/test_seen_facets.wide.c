/* Proves what an eye sees of rough water at every width against quadrature in double over the slopes (tests/rough_water.h):
 * the share of light that it mirrors, and that what is smooth is a mirror. */
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

struct view {
    const rough_water *water;
    double v[3];
};

static double share_of_facet(const double n[3], double cosine, const void *context)
{
    const struct view *view = context;
    const double share = smooth_reflectance(cosine, view->water->index), up = 2 * cosine * n[1] - view->v[1];
    const double seen = hidden_facets(view->v[1], view->water->up);
    const double hidden = up > 0 && up < 1 ? hidden_facets(up, view->water->up) : 0;
    const double open = up > 0 ? (1 + seen) / (1 + seen + hidden) : 0;
    return share * (open + (1 - open) * share);
}

static void the_share_is_the_mean_over_what_is_seen(void)
{
    static const double deviations[] = { 0.01, 0.03, 0.06, 0.1, 0.15, 0.2, 0.3 };
    static const double angles[] = { 0, 30, 50, 60, 70, 75, 80, 83, 86, 88, 89, 89.7 };
    for (int i = 0; i < 7; i++) {
        double worst = 0;
        for (int k = 0; k < 12; k++) {
            const double s = deviations[i], angle = angles[k] * degree;
            const rough_water w = { s * s, 0.64 * s * s, 1.34 };
            const struct view view = { &w, { sin(angle), cos(angle), 0 } };
            const struct lom_surface_point p = point_of(&w, angle);
            const double got = (double)lom_see_facets(&uniforms, &p).share[LOM_LANES - 1];
            const double want = seen_mean(&w, view.v, share_of_facet, &view);
            CHECK(fabs(got - want) < 0.014, "deviation %g, %g degrees: %g, not %g", s, angles[k], got, want);
            worst = fabs(got - want) > worst ? fabs(got - want) : worst;
        }
        printf("  slopes of %.2f: within %.4f\n", deviations[i], worst);
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
    RUN(the_share_is_the_mean_over_what_is_seen);
    RUN(smooth_water_is_a_mirror);
    RUN(what_is_turned_away_has_a_share);
    return check_result();
}
