/* Proves rays through scenes against closed forms: exact places of texels, seen directly and mirrored; Fresnel's share,
 * Snell's window and Beer's law at still water; the sun's disc; surfaces that are given as functions. */
#include "check.h"
#include "reference/reference.h"
#include "scene_files.h"

static lom_scene *scene;
static lom_reference *reference;

static bool open_scene(const char *text)
{
    scene = make_scene(text);
    reference = scene == NULL ? NULL : lom_create_reference(scene, NULL);
    CHECK(reference != NULL);
    return reference != NULL;
}

static void close_scene(void)
{
    lom_free_reference(reference);
    lom_free_scene(scene);
}

static bool near(double a, double b, double tolerance)
{
    return __builtin_fabs(a - b) <= tolerance;
}

static bool near3(lom_vec3 a, lom_vec3 b, double tolerance)
{
    return near(a.x, b.x, tolerance) && near(a.y, b.y, tolerance) && near(a.z, b.z, tolerance);
}

static lom_vec3 trace_towards(lom_vec3 eye, lom_vec3 target)
{
    return lom_trace_ray(reference, eye, unit(difference(target, eye)), 0, 0, 8);
}

/* Light in which a surface looks like its texture. */
#define PLAIN_LIGHT "output.transfer = \"naive\"\nlight.intensity = 0\nlight.ambient = [1, 1, 1]\n"

/* The centre of a texel of the quad that stands around `middle`. */
static lom_vec3 texel_place(lom_vec3 middle, int x, int y)
{
    return sum(middle, (lom_vec3){ (x + 0.5) * 2 / TEXELS - 1, 1 - (y + 0.5) * 2 / TEXELS, 0 });
}

static lom_vec3 texel_color(int x, int y)
{
    return (lom_vec3){ texel_code(x, y, 0) / 255.0, texel_code(x, y, 1) / 255.0, texel_code(x, y, 2) / 255.0 };
}

static void a_quad_shows_its_texels_in_their_places(void)
{
    if (!open_scene(PLAIN_LIGHT "[[entity]]\nmesh = \"quad.obj\"\nposition = [3, 2, -5]\n"))
        return;
    lom_vec3 middle = { 3, 2, -5 }, eye = { 0.3, 4, 7 };
    for (int y = 0; y < TEXELS; y++)
        for (int x = 0; x < TEXELS; x++)
            CHECK(near3(trace_towards(eye, texel_place(middle, x, y)), texel_color(x, y), 1e-12), "texel %d, %d", x, y);
    lom_vec3 between = sum(texel_place(middle, 2, 3), (lom_vec3){ 0.5 / TEXELS, 0, 0 }); /* a quarter of the way */
    lom_vec3 mixed = along(scaled(texel_color(2, 3), 0.75), texel_color(3, 3), 0.25);
    CHECK(near3(trace_towards(eye, between), mixed, 1e-12));
    lom_vec3 sky = { scene->sky.color[0], scene->sky.color[1], scene->sky.color[2] };
    CHECK(near3(trace_towards(eye, (lom_vec3){ 3, 3.001, -5 }), sky, 0)); /* past its upper edge */
    CHECK(!near3(trace_towards(eye, (lom_vec3){ 3, 2.999, -5 }), sky, 1e-3));
    CHECK(near3(trace_towards((lom_vec3){ 3, 2, -9 }, middle), sky, 0)); /* it has no back */
    close_scene();
}

/* Water of an endless index is a mirror. */
static void make_mirror(void)
{
    lom_reference_water water = lom_get_reference_water(reference);
    water.index = 1e15;
    water.roughness = 0;
    CHECK(lom_set_reference_water(reference, &water, NULL));
}

static void a_mirror_shows_the_mirrored_point(void)
{
    if (!open_scene(PLAIN_LIGHT "[water]\nlevel = 0.5\n[[entity]]\nmesh = \"quad.obj\"\nposition = [3, 2, -5]\n"))
        return;
    make_mirror();
    lom_vec3 middle = { 3, 2, -5 }, eye = { 0.3, 4, 7 };
    for (int y = 0; y < TEXELS; y++)
        for (int x = 0; x < TEXELS; x++) {
            lom_vec3 target = texel_place(middle, x, y);
            target.y = 2 * 0.5 - target.y;
            CHECK(near3(trace_towards(eye, target), texel_color(x, y), 1e-12), "texel %d, %d", x, y);
        }
    close_scene();
}

/* The same, for many rays: what a ray sees in the mirror is what it sees from behind it, water left away. */
static void a_mirrored_scene_is_the_scene_from_a_mirrored_eye(void)
{
    if (!open_scene("light.azimuth = 40\n[sky]\ncolor = [0.2, 0.3, 0.4]\n[water]\nsize = 1000\n"
                    "[[entity]]\nmesh = \"quad.obj\"\nposition = [1, 2.5, -5]\n"
                    "[entity.material]\nspecular = [1, 1, 1]\nshininess = 5\n"
                    "[[entity]]\nmesh = \"quad.obj\"\nposition = [-1, 3.5, -4]\nrotation = [20, 30, 50]\n"))
        return;
    make_mirror();
    lom_reference_water mirror = lom_get_reference_water(reference), none = mirror;
    none.high[0] = none.low[0] - 1;
    int hits = 0;
    for (uint64_t i = 0; i < 500; i++) {
        lom_vec3 eye = { 0.1, 3, 6 };
        lom_vec3 d = unit((lom_vec3){ lom_random_uniform(1, i) - 0.5, -0.35 - 0.4 * lom_random_uniform(2, i), -1 });
        CHECK(lom_set_reference_water(reference, &mirror, NULL));
        lom_vec3 seen = lom_trace_ray(reference, eye, d, 0, 0, 1);
        CHECK(lom_set_reference_water(reference, &none, NULL));
        lom_vec3 behind = lom_trace_ray(reference, (lom_vec3){ eye.x, -eye.y, eye.z }, (lom_vec3){ d.x, -d.y, d.z },
                                        eye.y / -d.y, 0, 1);
        hits += behind.x != 0.2;
        CHECK(near3(seen, behind, 1e-9), "ray %d: %g, %g", (int)i, seen.x, behind.x);
    }
    CHECK(hits > 30);
    close_scene();
}

/* ---- several waters ---- */

#define POOL "level = 0\nsize = 8\nposition = [0, 0]\n"
#define TARN "level = 5\nsize = 8\nposition = [20, 0]\n[water.optics]\nabsorption = [0.9, 0.4, 0.2]\n"

/* What a ray sees of a water in two tables is what it sees where that water is the only one, from above and from within. */
static void each_of_several_waters_is_met(void)
{
    static const char *const bed = PLAIN_LIGHT "[[entity]]\nmesh = \"quad.obj\"\nposition = [0, -3, 0]\n"
                                               "rotation = [-90, 0, 0]\nscale = 200\n";
    static const char *const waters[] = { "[[water]]\n" POOL "[[water]]\nname = \"tarn\"\n" TARN, "[water]\n" POOL,
                                          "[water]\n" TARN };
    lom_vec3 seen[3][4];
    for (int n = 0; n < 3; n++) {
        char text[1024];
        snprintf(text, sizeof text, "%s%s", bed, waters[n]);
        if (!open_scene(text))
            return;
        const lom_vec3 eyes[4] = { { 1, 9, 1 }, { 21, 9, 1 }, { 1, -1, 1 }, { 21, 4, 1 } };
        for (int i = 0; i < 4; i++)
            seen[n][i] = lom_trace_ray(reference, eyes[i], unit((lom_vec3){ 0.1, -1, 0.05 }), 0, 0, 8);
        close_scene();
    }
    for (int i = 0; i < 4; i++) {
        const lom_vec3 own = seen[i % 2 == 0 ? 1 : 2][i], other = seen[i % 2 == 0 ? 2 : 1][i];
        CHECK(near3(seen[0][i], own, 1e-12), "eye %d: %g, alone %g", i, seen[0][i].y, own.y);
        CHECK(!near3(own, other, 1e-3), "eye %d: both waters look the same, %g", i, own.y);
    }
}

/* ---- haze ---- */

/* A ray through haze that thins with height, up, level and down through its base: against the integral by steps. */
static void haze_is_the_integral_along_the_way(void)
{
    if (!open_scene(PLAIN_LIGHT "[[entity]]\nmesh = \"quad.obj\"\nposition = [0, 5, -40]\nscale = 200\n"
                                "[haze]\ndensity = [0.01, 0.02, 0.04]\ncolor = [0.3, 0.4, 0.5]\nbase = 2\nheight = 6\n"
                                "glow = [0, 0, 0]\n"))
        return;
    for (int i = 0; i < 40; i++) {
        lom_vec3 eye = { 0, 12 - 0.4 * i, 0 }, d = unit((lom_vec3){ 0.1, 0.01 * (i % 7) * (i % 7) - 0.16, -1 });
        struct lom_ray ray = { eye, d };
        double far = 40 / -d.z, sum = 0;
        enum { STEPS = 20000 };
        for (int k = 0; k < STEPS; k++) {
            double y = eye.y + d.y * far * (k + 0.5) / STEPS - 2;
            sum += far / STEPS * (y > 0 ? lom_double_exp(-y / 6) : 1);
        }
        lom_vec3 got = lom_light_through_haze(reference, &ray, far, (lom_vec3){ 1, 1, 1 });
        lom_vec3 wanted = { 0.3 + 0.7 * lom_double_exp(-0.01 * sum), 0.4 + 0.6 * lom_double_exp(-0.02 * sum),
                            0.5 + 0.5 * lom_double_exp(-0.04 * sum) };
        CHECK(near3(got, wanted, 1e-6), "way %d: %g, not %g", i, got.x, wanted.x);
        lom_vec3 hit = lom_light_through_haze(reference, &ray, far, lom_trace_ray(reference, eye, d, 0, 0, 0));
        CHECK(!near3(hit, lom_trace_ray(reference, eye, d, 0, 0, 0), 1e-6), "way %d has haze", i);
    }
    struct lom_ray up = { { 0, 3, 0 }, { 0, 1, 0 } };
    CHECK(near3(lom_light_through_haze(reference, &up, 1e300, (lom_vec3){ 1, 2, 3 }), (lom_vec3){ 1, 2, 3 }, 1e-12),
          "the sky is as it is");
    close_scene();
}

/* ---- still water under a white sky ---- */

#define WHITE_SKY                                                                                                      \
    "light.ambient = [0, 0, 0]\nlight.intensity = 0\nsky.color = [1, 1, 1]\n[water]\nsize = 1e5\n"                     \
    "[water.optics]\nroughness = 0\nindex = 1.33\nabsorption = [0.5, 0.25, 0]\nscatter = [0, 0, 0]\n"

static void water_reflects_by_fresnel(void)
{
    if (!open_scene(WHITE_SKY))
        return;
    for (int degrees = 0; degrees < 90; degrees += 3) { /* red is lost below: what is seen is mirrored */
        double angle = degrees * 0.017453292519943295, cosine = lom_double_cos(angle);
        lom_vec3 seen =
            lom_trace_ray(reference, (lom_vec3){ 0, 2, 0 }, (lom_vec3){ lom_double_sin(angle), -cosine, 0 }, 0, 0, 8);
        CHECK(near(seen.x, lom_reference_fresnel(cosine, 1.33), 1e-15), "%d degrees", degrees);
        CHECK(near(seen.z, 1, 1e-15)); /* blue is neither lost nor won */
    }
    close_scene();
}

static void snells_window_ends_at_the_critical_angle(void)
{
    if (!open_scene(WHITE_SKY))
        return;
    double critical = lom_double_asin(1 / 1.33);
    for (int i = -50; i <= 50; i++) {
        double angle = critical + (i + 0.5) * 1e-7;
        lom_vec3 up = { lom_double_sin(angle), lom_double_cos(angle), 0 };
        double seen = lom_trace_ray(reference, (lom_vec3){ 0, -1e-9, 0 }, up, 0, 0, 8).x;
        CHECK(i < 0 ? seen > 1e-4 : seen == 0, "%g of the light at %g beyond the window's edge", seen,
              angle - critical);
    }
    close_scene();
}

static void light_fades_by_beer_and_lambert(void)
{
    if (!open_scene(WHITE_SKY))
        return;
    double passed = 1 - lom_reference_fresnel(1, 1.33);
    for (int depth = 1; depth < 64; depth *= 2) {
        lom_vec3 seen = lom_trace_ray(reference, (lom_vec3){ 0, -depth, 0 }, (lom_vec3){ 0, 1, 0 }, 0, 0, 1);
        lom_vec3 expected = { passed * lom_double_exp(-0.5 * depth), passed * lom_double_exp(-0.25 * depth), 1 };
        CHECK(near(seen.x / expected.x, 1, 1e-14) && near(seen.y / expected.y, 1, 1e-14) &&
              near(seen.z / expected.z, 1, 1e-14));
    }
    close_scene();
}

/* White ground under two metres of water, ambient light alone, looking straight down. */
static void the_bed_is_seen_through_its_water(void)
{
    if (!open_scene("light.intensity = 0\nlight.elevation = 90\nlight.ambient = [1, 1, 1]\nsky.color = [1, 1, "
                    "1]\n[water]\nlevel = 2\n"
                    "size = 500\n[water.optics]\nroughness = 0\nindex = 1.33\nabsorption = [0.5, 0.25, 0]\nscatter = "
                    "[0.1, 0.2, 0.3]\n"
                    "[[entity]]\nmesh = \"ground.obj\"\n[entity.material]\nambient = [1, 1, 1]\n"))
        return;
    lom_vec3 seen = lom_trace_ray(reference, (lom_vec3){ 0, 9, 0 }, (lom_vec3){ 0, -1, 0 }, 0, 0, 1);
    const double absorption[3] = { 0.5, 0.25, 0 }, scatter[3] = { 0.1, 0.2, 0.3 },
                 found[3] = { seen.x, seen.y, seen.z };
    double mirrored = lom_reference_fresnel(1, 1.33);
    for (int i = 0; i < 3; i++) {
        double left = lom_double_exp(-2 * absorption[i]);
        double below = 0.934 * left * left + scatter[i] * (1 - left * left);
        CHECK(near(found[i], mirrored + (1 - mirrored) * below, 1e-14), "channel %d", i);
    }
    CHECK(near(lom_trace_ray(reference, (lom_vec3){ 0, 9, 0 }, (lom_vec3){ 0, -1, 0 }, 0, 0, 0).z, 0.934, 1e-14));
    close_scene();
}

/* The sun at 30 degrees above the horizon in +x, seen in the water: its disc has light / sin^2 radius. */
static void the_suns_disc_is_mirrored(void)
{
    if (!open_scene("light.azimuth = 90\nlight.elevation = 30\nlight.color = [1, 1, 1]\nlight.intensity = 2\n"
                    "sky.color = [0, 0, 0]\nquality.reference.sun = 0.5\n[water]\nsize = 1e5\n"
                    "[water.optics]\nroughness = 0\nscatter = [0, 0, 0]\n"))
        return;
    const double degree = 0.017453292519943295;
    double index = scene->water.optics.index, sine = lom_double_sin(0.5 * degree);
    for (int i = -4; i <= 4; i++) {
        double down = (30 + 0.13 * i) * degree;
        lom_vec3 d = { lom_double_cos(down), -lom_double_sin(down), 0 };
        lom_vec3 seen = lom_trace_ray(reference, (lom_vec3){ 0, 1, 0 }, d, 0, 0, 1);
        double expected = i > -4 && i < 4 ? 2 * lom_reference_fresnel(-d.y, index) / (sine * sine) : 0;
        CHECK(near(seen.x, expected, 1e-10 * expected), "%g, not %g", seen.x, expected);
        CHECK(lom_trace_ray(reference, (lom_vec3){ 0, 1, 0 }, (lom_vec3){ d.x, -d.y, 0 }, 0, 0, 1).x == 0);
    }
    close_scene();
}

/* ---- surfaces given as functions ---- */

static double tilted_height(const void *context, double x, double z, double time)
{
    const double *slope = context;
    return slope[0] * x + slope[1] * z + time;
}

static void tilted_slope(const void *context, double x, double z, double time, double out[2])
{
    const double *slope = context;
    (void)x, (void)z, (void)time;
    out[0] = slope[0];
    out[1] = slope[1];
}

/* A ray that a tilted plane mirrors sees the texel that lies where the mirrored one was aimed at. */
static void a_tilted_surface_mirrors_at_its_own_normal(void)
{
    static const double slope[2] = { 0.2, -0.1 };
    if (!open_scene(PLAIN_LIGHT "water.size = 40\n[[entity]]\nmesh = \"quad.obj\"\nposition = [1, 4, -5]\n"))
        return;
    lom_reference_water water = lom_get_reference_water(reference);
    water.index = 1e15;
    water.roughness = 0;
    water.lowest = -20;
    water.highest = 20;
    water.step = 0.5;
    water.context = slope;
    water.height = tilted_height;
    water.slope = tilted_slope;
    CHECK(lom_set_reference_water(reference, &water, NULL));
    lom_vec3 normal = unit((lom_vec3){ -slope[0], 1, -slope[1] }), eye = { 0.3, 5, 7 };
    for (int y = 0; y < TEXELS; y++)
        for (int x = 0; x < TEXELS; x++) {
            lom_vec3 target = texel_place((lom_vec3){ 1, 4, -5 }, x, y);
            lom_vec3 image = along(target, normal, -2 * (dot(normal, target) - normal.y * 0.25));
            lom_vec3 seen = lom_trace_ray(reference, eye, unit(difference(image, eye)), 0, 0.25, 4);
            CHECK(near3(seen, texel_color(x, y), 1e-7), "texel %d, %d", x, y);
        }
    close_scene();
}

static double still_height(const void *context, double x, double z, double time)
{
    (void)context, (void)x, (void)z, (void)time;
    return 0.5;
}

/* A level surface by steps is the plane, above and below. */
static void a_level_function_is_the_plane(void)
{
    if (!open_scene("[sky]\ncolor = [0.9, 0.7, 0.5]\n[water]\nlevel = 0.5\nsize = 90\n"
                    "[[entity]]\nmesh = \"ground.obj\"\nposition = [0, -2, 0]\n"))
        return;
    lom_reference_water plane = lom_get_reference_water(reference);
    plane.roughness = 0;
    lom_reference_water field = plane;
    field.height = still_height;
    field.lowest = 0.25;
    field.highest = 0.75;
    field.step = 0.1;
    for (uint64_t i = 0; i < 200; i++) {
        lom_vec3 eye = { 0, i % 2 == 0 ? 3 : -1, 0 };
        lom_vec3 d = unit((lom_vec3){ lom_random_uniform(1, i) - 0.5, lom_random_uniform(2, i) - 0.5, -0.5 });
        CHECK(lom_set_reference_water(reference, &plane, NULL));
        lom_vec3 a = lom_trace_ray(reference, eye, d, 0, 0, 3);
        CHECK(lom_set_reference_water(reference, &field, NULL));
        CHECK(near3(a, lom_trace_ray(reference, eye, d, 0, 0, 3), 1e-8), "ray %d", (int)i);
    }
    close_scene();
}

static void bad_water_is_refused(void)
{
    if (!open_scene("water.level = 1\n"))
        return;
    const double zero = 0, nan = zero / zero;
    lom_reference_water good = lom_get_reference_water(reference), bad[6] = { good, good, good, good, good, good };
    bad[0].index = 0;
    bad[1].absorption[1] = -1;
    bad[2].lowest = nan;
    bad[3].high[0] = 1 / zero;
    bad[4].height = still_height; /* without a step */
    bad[5].color[2] = nan;
    for (int i = 0; i < 6; i++) {
        lom_error error = { .code = LOM_OK };
        CHECK(!lom_set_reference_water(reference, &bad[i], &error) && error.code == LOM_ERROR_USAGE, "water %d", i);
    }
    CHECK(lom_get_reference_water(reference).lowest == 1);
    close_scene();
}

int main(int argc, char **argv)
{
    if (!write_files()) {
        printf("FAIL files: they cannot be written\n");
        return 1;
    }
    RUN(a_quad_shows_its_texels_in_their_places);
    RUN(a_mirror_shows_the_mirrored_point);
    RUN(a_mirrored_scene_is_the_scene_from_a_mirrored_eye);
    RUN(haze_is_the_integral_along_the_way);
    RUN(water_reflects_by_fresnel);
    RUN(snells_window_ends_at_the_critical_angle);
    RUN(light_fades_by_beer_and_lambert);
    RUN(the_bed_is_seen_through_its_water);
    RUN(the_suns_disc_is_mirrored);
    RUN(a_tilted_surface_mirrors_at_its_own_normal);
    RUN(a_level_function_is_the_plane);
    RUN(bad_water_is_refused);
    RUN(each_of_several_waters_is_met);
    remove_files();
    return check_result();
}
