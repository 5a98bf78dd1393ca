/* Proves what rays measure in volumes of density: optical depths by closed forms, and the extremes of boxes, rays and
 * voxels (V2 to V9, V14, V15, V19). */
#include "check.h"
#include "volumes.h"

static const double EPSILON = 0x1p-52, INFINITE = __builtin_inf();

static bool near(double a, double b, double tolerance)
{
    return __builtin_fabs(a - b) <= tolerance;
}

static double depth_along(const lom_reference_volume *v, lom_vec3 origin, lom_vec3 d)
{
    return lom_volume_optical_depth(v, origin, d, 0, INFINITE);
}

static lom_vec3 random_direction(uint64_t key, uint64_t i)
{
    double z = 2 * lom_random_uniform(key, 2 * i) - 1, angle = 6.283185307179586 * lom_random_uniform(key, 2 * i + 1);
    double r = lom_double_sqrt(1 - z * z);
    return (lom_vec3){ r * lom_double_cos(angle), r * lom_double_sin(angle), z };
}

/* Beer and Lambert: extinction times the way through the box, whatever the voxels' number. */
static void a_uniform_slab_is_as_deep_as_its_chord(void)
{
    const int sizes[][3] = { { 1, 1, 1 }, { 2, 3, 5 }, { 16, 16, 16 } };
    for (int i = 0; i < 3; i++) {
        lom_reference_volume *v = make_volume(&(struct volume_of){
            .size = { sizes[i][0], sizes[i][1], sizes[i][2] }, .high = { 4, 3, 2 }, .extinction = 0.7 });
        for (uint64_t k = 0; v != NULL && k < 200; k++) {
            lom_vec3 d = random_direction(1, k), inside = { 1 + lom_random_uniform(2, k), 1, 1 };
            double from = -1e9, to = 1e9;
            CHECK(lom_cross_volume(v, inside, d, &from, &to));
            CHECK(near(lom_volume_optical_depth(v, inside, d, -1e9, 1e9), 0.7 * (to - from), 1e-14));
        }
        CHECK(v != NULL && near(depth_along(v, (lom_vec3){ -5, 1, 1 }, (lom_vec3){ 1, 0, 0 }), 2.8, 4 * EPSILON));
        lom_free_reference_volume(v);
    }
}

static double ramp(double x, double y, double z)
{
    return 0.1 + 0.2 * x + 0.3 * y + 0.1 * z;
}

static double product_of_three(double x, double y, double z)
{
    return x * y * z;
}

/* Trilinear density of x y z is that product: along the diagonal, between the outermost centres, the integral of a
 * cubic. */
static void a_cubic_is_integrated_exactly(void)
{
    lom_reference_volume *v = make_volume(
        &(struct volume_of){ .size = { 8, 8, 8 }, .high = { 1, 1, 1 }, .extinction = 1, .at = product_of_three });
    double a = 1 / 16.0, b = 15 / 16.0, root = lom_double_sqrt(3);
    double found = lom_volume_optical_depth(v, (lom_vec3){ 0, 0, 0 }, (lom_vec3){ 1, 1, 1 }, a * root, b * root);
    CHECK(near(found, root * (b * b * b * b - a * a * a * a) / 4, 1e-7), "%.17g", found); /* voxels are floats */
    lom_free_reference_volume(v);
    v = make_volume(&(struct volume_of){ .size = { 4, 8, 16 }, .high = { 1, 1, 1 }, .extinction = 2, .at = ramp });
    for (uint64_t i = 0; i < 100; i++) { /* a linear density: length times its value in the middle */
        lom_vec3 p = { 0.2 + 0.6 * lom_random_uniform(1, i), 0.2 + 0.6 * lom_random_uniform(2, i),
                       0.2 + 0.6 * lom_random_uniform(3, i) };
        lom_vec3 q = { 0.2 + 0.6 * lom_random_uniform(4, i), 0.2 + 0.6 * lom_random_uniform(5, i),
                       0.2 + 0.6 * lom_random_uniform(6, i) };
        double size = length(difference(q, p));
        double expected = 2 * size * ramp((p.x + q.x) / 2, (p.y + q.y) / 2, (p.z + q.z) / 2);
        CHECK(near(lom_volume_optical_depth(v, p, difference(q, p), 0, size), expected, 3e-7 * size));
    }
    lom_free_reference_volume(v);
}

static double half(double x, double y, double z)
{
    return 0.5 + 0 * (x + y + z);
}

/* Even noise n leaves (d - s n) / (1 - s n) of a density d everywhere; noise of which every second voxel along x is 0,
 * linear in between, eats 4 times as far where it is 1: on the way along x through whole repetitions the mean of
 * (1/2 - n/4) / (1 - n/4) over n in 0..1, which is 1 + 2 ln(3/4). */
static void detail_leaves_what_its_formula_says(void)
{
    lom_image *detail = lom_create_image(2, 2, 2, LOM_FORMAT_R8, NULL);
    struct volume_of of = { .size = { 3, 3, 3 },
                            .high = { 8, 3, 2 },
                            .extinction = 0.7,
                            .at = half,
                            .detail = detail,
                            .detail_strength = 0.25,
                            .detail_size = 2 };
    for (int n = 0; n <= 255; n += 51) {
        memset(detail->pixels, n, 8);
        lom_reference_volume *v = make_volume(&of);
        double eaten = 0.25 * n / 255, want = 0.7 * 8 * (0.5 - eaten) / (1 - eaten);
        double found = depth_along(v, (lom_vec3){ -5, 1, 1 }, (lom_vec3){ 1, 0, 0 });
        CHECK(near(found, want, 1e-7) && near(lom_volume_extinction(v, (lom_vec3){ 3, 1, 1 }), want / 8, 1e-7),
              "%d: %.17g, not %.17g", n, found, want);
        lom_free_reference_volume(v);
    }
    for (int i = 0; i < 8; i++)
        detail->pixels[i] = i % 2 == 1 ? 255 : 0;
    of.size[0] = 64; /* so that a part of the way lies within a slope of the noise */
    lom_reference_volume *v = make_volume(&of);
    double found = depth_along(v, (lom_vec3){ -5, 1, 1 }, (lom_vec3){ 1, 0, 0 });
    double want = 0.7 * 8 * (1 + 2 * lom_double_log(0.75));
    CHECK(near(found, want, 1e-5), "%.17g, not %.17g", found, want);
    lom_free_reference_volume(v);
    of.detail_strength = 1;
    CHECK(make_volume(&of) == NULL, "noise that leaves nothing");
    lom_free_image(detail);
}

static double noise(double x, double y, double z)
{
    return lom_random_uniform(9, (uint64_t)(x * 64) + 1000 * (uint64_t)(y * 64) + 1000000 * (uint64_t)(z * 64));
}

/* Any volume: the exact sum against half a million midpoints. */
static void noise_is_integrated_like_by_small_steps(void)
{
    lom_reference_volume *v =
        make_volume(&(struct volume_of){ .size = { 9, 7, 8 }, .high = { 2, 1, 3 }, .extinction = 3, .at = noise });
    for (uint64_t i = 0; i < 6; i++) {
        lom_vec3 d = random_direction(4, i), inside = { 1.1, 0.4, 1.3 };
        double from = -1e9, to = 1e9, total = 0;
        CHECK(lom_cross_volume(v, inside, d, &from, &to));
        enum { STEPS = 60000 };
        for (int k = 0; k < STEPS; k++)
            total += lom_volume_extinction(v, along(inside, d, from + (k + 0.5) * (to - from) / STEPS));
        total *= (to - from) / STEPS;
        CHECK(near(lom_volume_optical_depth(v, inside, d, -1e9, 1e9) / total, 1, 1e-8), "ray %d", (int)i);
    }
    lom_free_reference_volume(v);
}

static void v14_v15_parts_and_order_change_nothing(void)
{
    lom_reference_volume *v =
        make_volume(&(struct volume_of){ .size = { 8, 8, 8 }, .high = { 1, 1, 1 }, .extinction = 0.6 });
    lom_reference_volume *rough =
        make_volume(&(struct volume_of){ .size = { 8, 8, 8 }, .high = { 1, 1, 1 }, .extinction = 2, .at = noise });
    for (uint64_t i = 0; i < 100; i++) {
        lom_vec3 d = random_direction(5, i), o = { 0.5, 0.4, 0.6 };
        double whole = lom_double_exp(-lom_volume_optical_depth(v, o, d, -1, 1));
        double parts = lom_double_exp(-lom_volume_optical_depth(v, o, d, -1, 0.05)) *
                       lom_double_exp(-lom_volume_optical_depth(v, o, d, 0.05, 1));
        CHECK(near(parts / whole, 1, 2 * EPSILON), "%g ulp", (parts / whole - 1) / EPSILON);
        double back = lom_volume_optical_depth(rough, o, scaled(d, -1), -1, 1);
        CHECK(near(back / lom_volume_optical_depth(rough, o, d, -1, 1), 1, 4 * EPSILON));
    }
    lom_free_reference_volume(v);
    lom_free_reference_volume(rough);
}

static void v2_v3_thin_and_thick(void)
{
    const double extinctions[] = { 1e-8, 1e-30, 1e6, 1e30 };
    for (int i = 0; i < 4; i++) {
        lom_reference_volume *v =
            make_volume(&(struct volume_of){ .size = { 2, 2, 2 }, .high = { 1, 1, 1 }, .extinction = extinctions[i] });
        lom_vec3 d = { 0, 0, 1 }, o = { 0.3, 0.3, -1 };
        double depth = depth_along(v, o, d), alpha = -lom_double_expm1(-depth);
        CHECK(near(depth / extinctions[i], 1, 4 * EPSILON));
        CHECK(alpha >= 0 && alpha <= 1 && (i < 2 ? near(alpha / extinctions[i], 1, 1e-8) : alpha == 1));
        lom_free_reference_volume(v);
    }
}

static void v6_v7_faces_edges_corners_parallels(void)
{
    lom_reference_volume *a =
        make_volume(&(struct volume_of){ .size = { 4, 4, 4 }, .high = { 1, 1, 1 }, .extinction = 1 });
    lom_reference_volume *b = make_volume(
        &(struct volume_of){ .size = { 4, 4, 4 }, .low = { 1, 0, 0 }, .high = { 2, 1, 1 }, .extinction = 1 });
    const lom_vec3 up = { 0, 1, 0 };
    const double at[] = { 0, 0.5, 1, 1.5, 2 };
    for (int x = 0; x < 5; x++)
        for (int z = 0; z < 5;
             z++) { /* two boxes with a common face: every parallel ray is in one of them, or in none */
            double both =
                depth_along(a, (lom_vec3){ at[x], -1, at[z] }, up) + depth_along(b, (lom_vec3){ at[x], -1, at[z] }, up);
            CHECK(both == (at[x] < 2 && at[z] < 1 ? 1 : 0), "%g at %g, %g", both, at[x], at[z]);
        }
    const lom_vec3 places[] = { { .5, .5, .5 }, { 0, .5, .5 }, { 0, 0, .5 }, { 0, 0, 0 }, { 1, 1, 1 }, { 3, .5, .5 } };
    const double towards[] = { 0.5, 1, 1, 1, 0, 0 };
    for (int i = 0; i < 6; i++)
        CHECK(near(depth_along(a, places[i], (lom_vec3){ 1, 0, 0 }), towards[i], 1e-15), "place %d", i);
    CHECK(near(depth_along(a, (lom_vec3){ 1, 1, 1 }, (lom_vec3){ -1, -1, -1 }), lom_double_sqrt(3), 1e-15));
    lom_free_reference_volume(a);
    lom_free_reference_volume(b);
}

static void v8_directions_of_any_length(void)
{
    lom_reference_volume *v =
        make_volume(&(struct volume_of){ .size = { 4, 4, 4 }, .high = { 1, 1, 1 }, .extinction = 1, .at = noise });
    lom_vec3 o = { -1, 0.4, 0.3 };
    double once = depth_along(v, o, (lom_vec3){ 1, 0.1, 0 });
    CHECK(once > 0.1);
    const double lengths[] = { 1e-310, 1e-160, 1e-3, 1e9, 1e300 };
    for (int i = 0; i < 5; i++)
        CHECK(near(depth_along(v, o, (lom_vec3){ lengths[i], 0.1 * lengths[i], 0 }), once, 1e-10), "%g", lengths[i]);
    lom_volume_rays rays = { .origin = o, .far = 10, .paths = 1, .events = 1 };
    lom_reference_light dark = { .to_sun = { 0, 1, 0 } };
    lom_volume_light out;
    lom_error error = { .code = LOM_OK };
    CHECK(!lom_trace_volume(v, &dark, &rays, &out, &error) && error.code == LOM_ERROR_USAGE);
    CHECK(depth_along(v, o, (lom_vec3){ 0, 0, 0 }) == 0);
    lom_free_reference_volume(v);
}

static void v4_v9_what_is_refused(void)
{
    uint8_t voxel = 255;
    lom_image image = { .width = 1, .height = 1, .depth = 1, .format = LOM_FORMAT_R8, .pixels = &voxel };
    const double nan = INFINITE - INFINITE;
    const lom_reference_volume_desc good = { .density = &image, .high = { 1, 1, 1 }, .extinction = 1 };
    lom_reference_volume_desc bad[10];
    for (int i = 0; i < 10; i++)
        bad[i] = good;
    bad[0].high.x = 0; /* no thickness */
    bad[1].low.y = 2;  /* inverted */
    bad[2].high.z = nan;
    bad[3].extinction = -1;
    bad[4].extinction = INFINITE;
    bad[5].albedo[1] = 1.0000001; /* more than meets it */
    bad[6].albedo[0] = nan;
    bad[7].density = NULL;
    bad[8].high.x = INFINITE;
    uint8_t rgb[3] = { 255, 255, 255 };
    lom_image colors = { .width = 1, .height = 1, .depth = 1, .format = LOM_FORMAT_RGB8, .pixels = rgb };
    bad[9].density = &colors;
    for (int i = 0; i < 10; i++) {
        lom_error error = { .code = LOM_OK };
        CHECK(lom_create_reference_volume(&bad[i], &error) == NULL && error.code == LOM_ERROR_USAGE, "case %d", i);
    }
    const double scales[] = { 1e-30, 1e30 };
    for (int i = 0; i < 2; i++) {
        lom_reference_volume_desc d = good;
        d.high = (lom_vec3){ scales[i], scales[i], scales[i] };
        d.extinction = 1 / scales[i];
        lom_reference_volume *v = lom_create_reference_volume(&d, NULL);
        lom_vec3 o = { scales[i] / 4, scales[i] / 4, -scales[i] };
        CHECK(v != NULL && near(depth_along(v, o, (lom_vec3){ 0, 0, 1 }), 1, 1e-14));
        lom_free_reference_volume(v);
    }
    lom_reference_volume_desc afar = good; /* 1e7 m away a double still resolves 2e-9 m */
    afar.low = (lom_vec3){ 1e7, 1e7, 1e7 };
    afar.high = (lom_vec3){ 1e7 + 1, 1e7 + 1, 1e7 + 1 };
    lom_reference_volume *v = lom_create_reference_volume(&afar, NULL);
    CHECK(v != NULL && near(depth_along(v, (lom_vec3){ 0, 0, 0 }, (lom_vec3){ 1, 1, 1 }), lom_double_sqrt(3), 1e-7));
    lom_free_reference_volume(v);
}

static void v19_voxels_of_every_format(void)
{
    uint8_t bytes[2] = { 255, 51 };
    uint16_t words[2] = { 65535, 13107 };
    float floats[2] = { 1, 0.2f }, strange[2] = { -3, (float)(INFINITE - INFINITE) };
    lom_image images[] = {
        { .width = 2, .height = 1, .depth = 1, .format = LOM_FORMAT_R8, .pixels = bytes },
        { .width = 2, .height = 1, .depth = 1, .format = LOM_FORMAT_R16, .pixels = (uint8_t *)words },
        { .width = 2, .height = 1, .depth = 1, .format = LOM_FORMAT_R32F, .pixels = (uint8_t *)floats },
        { .width = 2, .height = 1, .depth = 1, .format = LOM_FORMAT_R32F, .pixels = (uint8_t *)strange }
    };
    for (int i = 0; i < 4; i++) {
        lom_reference_volume *v = lom_create_reference_volume(
            &(lom_reference_volume_desc){ .density = &images[i], .high = { 2, 1, 1 }, .extinction = 1 }, NULL);
        double depth = depth_along(v, (lom_vec3){ -1, 0.5, 0.5 }, (lom_vec3){ 1, 0, 0 });
        CHECK(near(depth, i < 3 ? 1.2 : 0, 1e-7), "%g", depth);
        CHECK(depth_along(v, (lom_vec3){ 2.5, 0.5, 0.5 }, (lom_vec3){ 1, 0, 0 }) == 0); /* it has left the grid */
        lom_free_reference_volume(v);
    }
}

int main(int argc, char **argv)
{
    RUN(a_uniform_slab_is_as_deep_as_its_chord);
    RUN(a_cubic_is_integrated_exactly);
    RUN(detail_leaves_what_its_formula_says);
    RUN(noise_is_integrated_like_by_small_steps);
    RUN(v14_v15_parts_and_order_change_nothing);
    RUN(v2_v3_thin_and_thick);
    RUN(v6_v7_faces_edges_corners_parallels);
    RUN(v8_directions_of_any_length);
    RUN(v4_v9_what_is_refused);
    RUN(v19_voxels_of_every_format);
    return check_result();
}
