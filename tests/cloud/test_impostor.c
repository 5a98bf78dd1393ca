/* Proves: plates cover their cloud and nothing is lost at their border; they are made anew exactly when a rule's bound
 * is passed and not again until it is passed once more; the extremes of impostors (behind, straddling, inside, tiny,
 * huge, near, far, rolled, at the pole) are defined; clouds are drawn the farthest first, of equals the first in the
 * file last. */
#include "check.h"
#include "cloud/impostor_draw.h"

#include <lom/pipeline.h>

static const double half[3] = { 800, 500, 700 };

static void set_corners(lom_vec3 corner[8])
{
    for (int c = 0; c < 8; c++)
        corner[c] =
            (lom_vec3){ (c & 1 ? 1 : -1) * half[0], (c >> 1 & 1 ? 1 : -1) * half[1], (c >> 2 ? 1 : -1) * half[2] };
}

/* A picture of 1280 x 720 with 60 degrees of height, seen from eye towards target. */
static struct lom_impostor_eye look(lom_vec3 eye, lom_vec3 target, lom_vec3 up)
{
    lom_mat4 view = lom_look_at(eye, target, up);
    double tall = 0.57735026918962576;
    return (struct lom_impostor_eye){ .right = { view.m[0][0], view.m[0][1], view.m[0][2] },
                                      .up = { view.m[1][0], view.m[1][1], view.m[1][2] },
                                      .forward = { -view.m[2][0], -view.m[2][1], -view.m[2][2] },
                                      .near_plane = 0.5,
                                      .tangent = { tall * 16 / 9, tall },
                                      .pixel = 2 * tall / 720,
                                      .height = 720 };
}

static const lom_vec3 origin = { 0, 0, 0 }, upwards = { 0, 1, 0 };

static bool facing(lom_vec3 eye, struct lom_plate *plate)
{
    lom_vec3 corner[8];
    struct lom_impostor_eye view = look(eye, origin, upwards);
    set_corners(corner);
    return lom_make_facing_plate(corner, eye, &view, 1, 0, 1024, plate);
}

static enum lom_refresh rule(const struct lom_plate *plate, lom_vec3 eye, double bound)
{
    lom_vec3 corner[8];
    struct lom_impostor_eye view = look(eye, origin, upwards);
    set_corners(corner);
    return lom_bounded_refresh(plate, corner, eye, &view, bound);
}

static double error_of(const struct lom_plate *plate, lom_vec3 eye)
{
    lom_vec3 corner[8];
    struct lom_impostor_eye view = look(eye, origin, upwards);
    set_corners(corner);
    return lom_parallax_error(plate, corner, eye, &view);
}

/* ---- sizes ---- */

static void test_powers_of_two_by_saturation(void)
{
    for (uint32_t n = 1; n < 100000; n++) {
        uint32_t p = lom_next_power_of_two(n);
        CHECK(p >= n && (p & (p - 1)) == 0 && p / 2 < n, "%u: %u", n, p);
    }
    CHECK(lom_next_power_of_two(0) == 1 && lom_next_power_of_two(0x80000000u) == 0x80000000u &&
              lom_next_power_of_two(0x80000001u) == 0,
          "ends of the range");
}

static void test_reference_edges(void)
{
    const struct {
        double width, height;
        int edge;
    } cases[] = { { 240, 300, 64 }, { 241, 300, 64 }, { 120, 900, 32 },  { 121, 900, 64 },
                  { 30, 30, 8 },    { 0, 0, 1 },      { 1e12, 1e12, 64 } };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        int edge = lom_reference_plate_edge(cases[i].width, cases[i].height, 720, 64);
        CHECK(edge == cases[i].edge, "%g x %g: %d instead of %d", cases[i].width, cases[i].height, edge, cases[i].edge);
    }
}

static void test_plate_covers_the_box_with_a_border(void)
{
    for (int i = 0; i < 200; i++) {
        double turn = 0.1 * i, rise = 40 * (i % 50) - 1000, away = 2000 + 90 * i;
        lom_vec3 eye = { away * lom_double_cos(turn), rise, away * lom_double_sin(turn) }, corner[8];
        struct lom_plate p;
        set_corners(corner);
        CHECK(facing(eye, &p), "%d", i);
        double texel = (p.high[0] - p.low[0]) / p.width, other = (p.high[1] - p.low[1]) / p.height;
        CHECK(texel - other < 1e-12 && other - texel < 1e-12, "texels are %g x %g", texel, other);
        CHECK(p.width <= 1024 && p.height <= 1024, "%d x %d", p.width, p.height);
        for (int c = 0; c < 8; c++) {
            lom_vec3 to = lom_vec3_subtract(corner[c], eye);
            double z = lom_vec3_dot(to, p.forward), x = lom_vec3_dot(to, p.right) / z, y = lom_vec3_dot(to, p.up) / z;
            CHECK(x >= p.low[0] + 0.99 * texel && x <= p.high[0] - 0.99 * texel && y >= p.low[1] + 0.99 * texel &&
                      y <= p.high[1] - 0.99 * texel,
                  "eye %d, corner %d reaches the border", i, c);
        }
    }
}

static double at_random(uint64_t *n)
{
    return lom_random_uniform(11, (*n)++);
}

/* A point of the box that a picture from `eye` shows, in plate's tangents; false: the picture does not show it there.
 */
static bool shown_at(const struct lom_plate *plate, lom_vec3 point, lom_vec3 eye, const struct lom_impostor_eye *view,
                     double at[2])
{
    lom_vec3 ray = lom_vec3_subtract(point, plate->eye);
    double away = lom_vec3_dot(ray, plate->forward);
    lom_vec3 on_plane = lom_vec3_add(plate->eye, lom_vec3_scale(ray, plate->distance / away));
    lom_vec3 to = lom_vec3_subtract(on_plane, eye);
    double ahead = lom_vec3_dot(to, view->forward);
    at[0] = lom_vec3_dot(ray, plate->right) / away;
    at[1] = lom_vec3_dot(ray, plate->up) / away;
    double x = lom_vec3_dot(to, view->right) / ahead, y = lom_vec3_dot(to, view->up) / ahead;
    return ahead > 0 && x >= -view->tangent[0] && x <= view->tangent[0] && y >= -view->tangent[1] &&
           y <= view->tangent[1];
}

/* Eyes close to the box that look past it: the plate is smaller than the box, holds every point of the box that the
 * picture shows, and is kept by an eye that moved and turned only while that stays so. */
static void test_plate_covers_what_is_in_view(void)
{
    int smaller = 0, kept = 0, made = 0, points = 0;
    uint64_t n = 0;
    for (int i = 0; i < 3000; i++) {
        lom_vec3 eye = { 1500 + 2000 * at_random(&n), 1800 * at_random(&n) - 900, 3000 * at_random(&n) - 1500 },
                 corner[8];
        lom_vec3 target = { 6000 * at_random(&n) - 3000, 4000 * at_random(&n) - 2000, 6000 * at_random(&n) - 3000 };
        struct lom_impostor_eye view = look(eye, target, upwards);
        struct lom_plate plate;
        set_corners(corner);
        if (!lom_make_facing_plate(corner, eye, &view, 1, 0, 1024, &plate))
            continue;
        smaller += plate.high[0] - plate.low[0] < 0.9 * (plate.whole_high[0] - plate.whole_low[0]);
        double step = 3 * at_random(&n);
        lom_vec3 next = { eye.x + step, eye.y + step * at_random(&n), eye.z - step };
        target.x += 400 * at_random(&n);
        target.y += 400 * at_random(&n);
        struct lom_impostor_eye after = look(next, target, upwards);
        bool is_kept = lom_bounded_refresh(&plate, corner, next, &after, 1e6) == LOM_REFRESH_NONE;
        *(is_kept ? &kept : &made) += 1;
        for (int k = 0; k < 20; k++) {
            lom_vec3 p = { half[0] * (2 * at_random(&n) - 1), half[1] * (2 * at_random(&n) - 1),
                           half[2] * (2 * at_random(&n) - 1) };
            double at[2];
            bool is_in_view = shown_at(&plate, p, eye, &view, at);
            bool is_held =
                at[0] >= plate.low[0] && at[0] <= plate.high[0] && at[1] >= plate.low[1] && at[1] <= plate.high[1];
            CHECK(is_held || !is_in_view, "plate %d does not hold a point in view", i);
            is_in_view = shown_at(&plate, p, next, &after, at);
            CHECK(is_held || !is_in_view || !is_kept, "plate %d is kept and lacks a point in view", i);
            points += is_in_view;
        }
    }
    CHECK(smaller > 300 && kept > 300 && made > 100 && points > 3000, "%d smaller, %d kept, %d made anew, %d points",
          smaller, kept, made, points);
}

/* Out of view altogether, a plate is as small as it gets, and is kept until the box comes into view. */
static void test_plate_out_of_view_costs_nothing(void)
{
    lom_vec3 eye = { 3000, 0, 0 }, corner[8];
    struct lom_impostor_eye away = look(eye, (lom_vec3){ 3000, 0, -9000 }, upwards), back = look(eye, origin, upwards);
    struct lom_plate plate;
    set_corners(corner);
    CHECK(lom_make_facing_plate(corner, eye, &away, 1, 0, 1024, &plate), "a plate");
    CHECK(plate.width == 16 && plate.height == 16, "%d x %d texels", plate.width, plate.height);
    CHECK(lom_bounded_refresh(&plate, corner, eye, &away, 1) == LOM_REFRESH_NONE, "still out of view");
    CHECK(lom_bounded_refresh(&plate, corner, eye, &back, 1) == LOM_REFRESH_VIEW, "in view again");
}

/* Texels are no finer than asked, at the middle of the cloud; far away a pixel is coarser than that. */
static void test_texels_are_no_finer_than_the_cloud(void)
{
    lom_vec3 corner[8];
    set_corners(corner);
    for (int i = 0; i < 40; i++) {
        lom_vec3 eye = { 1500 + 500 * i, 0, 0 };
        struct lom_impostor_eye view = look(eye, origin, upwards);
        struct lom_plate plate;
        CHECK(lom_make_facing_plate(corner, eye, &view, 1, 8, 4096, &plate), "a plate");
        double texel = (plate.high[0] - plate.low[0]) / plate.width * eye.x, pixel = view.pixel * eye.x;
        double wanted = pixel > 8 ? pixel : 8;
        CHECK(texel > 0.999999 * wanted && texel < 1.000001 * wanted, "%g m: a texel of %g m, not %g", eye.x, texel,
              wanted);
        CHECK(lom_bounded_refresh(&plate, corner, eye, &view, 1e-9) == LOM_REFRESH_NONE, "%g m", eye.x);
    }
}

/* ---- errors and rules ---- */

/* Nothing moves: no error. The camera turns on the spot: none either. */
static void test_no_parallax_without_moving(void)
{
    lom_vec3 eye = { 3000, -400, 2500 }, corner[8];
    struct lom_plate plate;
    set_corners(corner);
    CHECK(facing(eye, &plate), "a plate");
    for (int i = 0; i < 20; i++) {
        lom_vec3 target = { 100.0 * i, 30.0 * i, -50.0 * i };
        struct lom_impostor_eye view = look(eye, target, upwards);
        double error = lom_parallax_error(&plate, corner, eye, &view);
        CHECK(error < 1e-9, "turned by %d: %g pixels", i, error);
        CHECK(lom_bounded_refresh(&plate, corner, eye, &view, 1e-6) == LOM_REFRESH_NONE, "turned by %d", i);
    }
}

/* A point at depth d before the plane, seen from an eye that moved by s across: s (1 / (D - d) - 1 / D) to the first
 * order. The bound is at least that for the nearest corner, and grows with the way. */
static void test_parallax_follows_the_closed_form(void)
{
    lom_vec3 eye = { 0, 0, 6000 };
    struct lom_plate plate;
    CHECK(facing(eye, &plate), "a plate");
    double pixel = 2 * 0.57735026918962576 / 720, before = 0;
    for (int s = 1; s <= 60; s++) {
        lom_vec3 moved = { s, 0, 6000 };
        double error = error_of(&plate, moved);
        double closed = s * (1 / (6000 - half[2]) - 1 / 6000.0) / pixel;
        CHECK(error > 0.95 * closed && error < 1.15 * closed, "%d m: %g pixels, closed form %g", s, error, closed);
        CHECK(error > before, "%d m", s);
        before = error;
    }
}

static void i3_threshold_exactly_equal_keeps(void)
{
    lom_vec3 eye = { 0, 100, 5000 }, moved = { 60, 110, 4990 };
    struct lom_plate plate;
    CHECK(facing(eye, &plate), "a plate");
    double error = error_of(&plate, moved);
    CHECK(error > 0.5, "%g", error);
    CHECK(rule(&plate, moved, error) == LOM_REFRESH_NONE, "equal to the bound");
    CHECK(rule(&plate, moved, error * (1 - 1e-15)) == LOM_REFRESH_VIEW, "just above the bound");
    /* the reference's: 0.99999 itself is kept */
    struct lom_impostor_eye view = look(eye, origin, upwards);
    struct lom_plate turned = { .forward = { 0, 0, 1 } };
    view.forward = (lom_vec3){ 0, 0, 0.99999 };
    CHECK(lom_reference_refresh(&turned, (lom_vec3){ 0, 0, 1e6 }, &view, 100) == LOM_REFRESH_NONE, "0.99999");
    view.forward.z = 0.9999899999999999;
    CHECK(lom_reference_refresh(&turned, (lom_vec3){ 0, 0, 1e6 }, &view, 100) == LOM_REFRESH_VIEW, "less");
    CHECK(lom_reference_refresh(&turned, (lom_vec3){ 0, 0, 199.9 }, &view, 100) == LOM_REFRESH_NEAR, "near");
}

/* The eye swings by a hair about the place where the bound is passed: once at most. */
static void i3_swinging_about_the_bound_refreshes_once(void)
{
    lom_vec3 eye = { 0, 0, 5000 };
    struct lom_plate plate;
    CHECK(facing(eye, &plate), "a plate");
    double low = 0, high = 400;
    for (int i = 0; i < 60; i++) {
        double middle = (low + high) / 2;
        *(error_of(&plate, (lom_vec3){ middle, 0, 5000 }) > 1 ? &high : &low) = middle;
    }
    int refreshed = 0;
    for (int i = 0; i < 1000; i++) {
        lom_vec3 at = { high + (i % 2 ? 1e-6 : -1e-6), 0, 5000 };
        if (rule(&plate, at, 1) != LOM_REFRESH_NONE) {
            refreshed++;
            facing(at, &plate);
        }
    }
    CHECK(refreshed == 1, "%d times", refreshed);
}

static void i3_switches_have_hysteresis(void)
{
    bool is_on = false;
    int changes = 0;
    for (int i = 0; i < 1000; i++) {
        bool now = lom_switch(is_on, i % 2 ? 1 - 1e-6 : 1 + 1e-6, 1, 1.25);
        changes += now != is_on;
        is_on = now;
    }
    CHECK(changes == 1 && is_on, "%d changes", changes);
    CHECK(!lom_switch(false, 1, 1, 1.25) && lom_switch(true, 1.25, 1, 1.25) && !lom_switch(true, 1.2500001, 1, 1.25),
          "at the bounds themselves it stays as it was");
}

static void test_size_error(void)
{
    struct lom_plate plate;
    CHECK(facing((lom_vec3){ 0, 0, 20000 }, &plate), "a plate");
    CHECK(rule(&plate, (lom_vec3){ 0, 0, 19000 }, 1) == LOM_REFRESH_NONE, "5 %% nearer");
    CHECK(rule(&plate, (lom_vec3){ 0, 0, 9000 }, 1) == LOM_REFRESH_SIZE, "texels of more than two pixels");
    CHECK(rule(&plate, (lom_vec3){ 0, 0, 39000 }, 1) == LOM_REFRESH_NONE, "texels of more than half a pixel");
    CHECK(rule(&plate, (lom_vec3){ 0, 0, 41000 }, 1) == LOM_REFRESH_SIZE, "texels of less");
}

/* ---- extremes ---- */

static void i1_behind_straddling_and_inside_have_no_plate(void)
{
    const lom_vec3 eyes[] = { { 0, 0, 0 }, { 100, 50, -30 }, { 800, 500, 700 }, { 0, 0, 700.2 }, { 810, 0, 0 } };
    lom_vec3 corner[8];
    struct lom_plate plate;
    set_corners(corner);
    for (size_t i = 0; i < sizeof eyes / sizeof eyes[0]; i++)
        CHECK(!facing(eyes[i], &plate) || eyes[i].x == 810, "eye %zu", i);
    /* the middle behind an upright plate's camera, and a box that crosses its near plane */
    struct lom_impostor_eye view = look((lom_vec3){ 0, 0, 5000 }, (lom_vec3){ 0, 0, 9000 }, upwards);
    CHECK(!lom_make_reference_plate(corner, (lom_vec3){ 0, 0, 5000 }, &view, 64, &plate), "behind");
    view = look((lom_vec3){ 0, 0, 600 }, origin, upwards);
    CHECK(!lom_make_reference_plate(corner, (lom_vec3){ 0, 0, 600 }, &view, 64, &plate), "straddling");
    lom_make_screen_plate((lom_vec3){ 0, 0, 600 }, &view, 0.5, 1281, 721, &plate);
    CHECK(plate.width == 641 && plate.height == 361 && plate.distance > view.near_plane, "the whole picture");
}

static void i2_i5_sizes_from_nothing_to_huge(void)
{
    struct lom_plate plate;
    CHECK(facing((lom_vec3){ 0, 0, 1e9 }, &plate) && plate.extent < 0.01 && plate.width == 16, "far: %g, %d",
          plate.extent, plate.width);
    CHECK(lom_switch(false, plate.extent, 1, 1.25), "less than a pixel is not drawn");
    CHECK(facing((lom_vec3){ 0, 0, 1.0 * 2 * half[0] * 720 / 1.1547 + half[2] }, &plate) && plate.extent > 0.99 &&
              plate.extent < 1.01,
          "one pixel: %g", plate.extent);
    CHECK(facing((lom_vec3){ 0, 0, 720 }, &plate) && plate.width == 1024 && plate.height <= 1024 && plate.pitch > 1,
          "close: %d x %d", plate.width, plate.height);
    CHECK(!facing((lom_vec3){ 0, 0, 0 }, &plate), "distance 0");
}

static void i4_roll_and_pole(void)
{
    lom_vec3 eye = { 0, 5000, 0 }, corner[8];
    struct lom_plate plate;
    set_corners(corner);
    CHECK(facing(eye, &plate), "straight above");
    CHECK(lom_vec3_length(plate.right) > 0.999999 && lom_vec3_length(plate.up) > 0.999999, "axes at the pole");
    for (int i = 0; i < 8; i++) {
        lom_vec3 up = { lom_double_sin(i * 0.8), 0, lom_double_cos(i * 0.8) };
        struct lom_impostor_eye view = look(eye, origin, up);
        CHECK(lom_bounded_refresh(&plate, corner, eye, &view, 1e-6) == LOM_REFRESH_NONE, "rolled by %d", i);
    }
    /* a step across the pole turns the axes of a new plate, not of the old one */
    CHECK(rule(&plate, (lom_vec3){ 1e-3, 5000, 1e-3 }, 0.01) == LOM_REFRESH_NONE, "a step");
}

static void test_misting(void)
{
    CHECK(lom_misting(1e9, 1000) == 1 && lom_misting(2000, 1000) == 1 && lom_misting(0, 1000) == 0.8 &&
              lom_misting(1800, 1000) == 0.9,
          "distance over twice the size, within 0.8..1");
}

/* ---- pictures ---- */

static struct lom_cloud_set *load(lom_cloud clouds[], size_t count, const lom_clouds *params)
{
    const struct lom_cloud_quality quality = {
        .model = LOM_CLOUDS_OCTAVES, .error = 0.05, .stop = 0.004, .light_scale = 0.5, .octaves = 2, .jitter = true
    };
    for (size_t i = 0; i < count; i++) {
        clouds[i].kind = "hemisphere";
        clouds[i].seed = 1;
        clouds[i].density = 1;
        clouds[i].extinction = 0.03;
        clouds[i].detail_size = 180;
        clouds[i].visible = true;
        for (int k = 0; k < 3; k++) {
            clouds[i].voxels[k] = 20;
            clouds[i].size[k] = 1000;
        }
    }
    lom_error error = { 0 };
    struct lom_cloud_set *set;
    CHECK(lom_load_cloud_set(clouds, count, params, &quality, NULL, NULL, &set, &error), "%s", error.text);
    return set;
}

static const lom_clouds air = { .albedo = 1, .brightness = 1, .forward = 0.8, .sky = { 0.3, 0.4, 0.6 } };

static struct lom_cloud_view view_from(lom_vec3 eye)
{
    return (struct lom_cloud_view){ .projection = lom_perspective(1.0471975511965976, 16.0 / 9, 0.5),
                                    .view = lom_look_at(eye, origin, upwards),
                                    .eye = eye,
                                    .near_plane = 0.5,
                                    .pixel_angle = 2 * 0.57735026918962576 / 720,
                                    .light = { .to_light = { 0, 1, 0 }, .color = { 1, 1, 1 } } };
}

static void test_painters_order_with_ties(void)
{
    lom_cloud clouds[6] = { { .position = { 0, -500, 0 } },     { .position = { 3000, -500, 0 } },
                            { .position = { -3000, -500, 0 } }, { .position = { 0, -500, -9000 } },
                            { .position = { 3000, -500, 0 } },  { .position = { 0, -500, 40000 } } };
    struct lom_cloud_set *set = load(clouds, 6, &air);
    struct lom_cloud_view view = view_from((lom_vec3){ 0, 0, 12000 });
    size_t order[6];
    const size_t expected[5] = { 3, 4, 2, 1, 0 }; /* 1, 2 and 4 are equally far; 5 is behind the eye */
    size_t count = lom_order_clouds(set, &view, true, order);
    CHECK(count == 5, "%zu are seen", count);
    for (size_t i = 0; i < count; i++)
        CHECK(order[i] == expected[i], "place %zu: cloud %zu instead of %zu", i, order[i], expected[i]);
    CHECK(lom_order_clouds(set, &view, false, order) == 6 && order[0] == 5, "without culling all are drawn");
    lom_free_cloud_set(set);
}

/* The border is empty, colour never exceeds opacity without light, and no dark fringe: what is not the cloud is 0 in
 * every channel. */
static void i6_plate_border_is_empty(void)
{
    lom_cloud cloud = { .position = { 0, -500, 0 } };
    struct lom_cloud_set *set = load(&cloud, 1, &air);
    struct lom_cloud_view view = view_from((lom_vec3){ 1500, 300, 3000 });
    lom_device *device = lom_open_device(&(lom_device_desc){ .threads = 1 });
    struct lom_impostor_eye eye = look(view.eye, origin, upwards);
    struct lom_plate plate;
    lom_vec3 corner[8];
    const double up[3] = { 0, 1, 0 };
    int swept = 0;
    lom_light_clouds(set, up, NULL, &swept, NULL);
    lom_cloud_corners(&set->clouds[0], corner);
    CHECK(lom_make_facing_plate(corner, view.eye, &eye, 0.25, 0, 1024, &plate), "a plate");
    lom_texture *texture = lom_make_texture(
        device, &(lom_texture_desc){ .width = plate.width, .height = plate.height, .format = LOM_FORMAT_RGBA32F });
    CHECK(lom_draw_plate(device, set, &set->clouds[0], &view, &plate, texture), "%s", lom_device_error(device)->text);
    lom_image *image = lom_read_texture(texture, 0, 0, NULL);
    int seen = 0;
    for (int y = 0; y < image->height; y++)
        for (int x = 0; x < image->width; x++) {
            const float *p = lom_image_pixel(image, x, y, 0);
            bool edge = x == 0 || y == 0 || x == image->width - 1 || y == image->height - 1;
            CHECK(!edge || (p[0] == 0 && p[1] == 0 && p[2] == 0 && p[3] == 0), "%d, %d", x, y);
            CHECK(p[3] >= 0 && p[3] <= 1 && (p[3] > 0 || (p[0] == 0 && p[1] == 0 && p[2] == 0)), "%d, %d", x, y);
            seen += p[3] > 0.5f;
        }
    CHECK(seen > image->width * image->height / 20, "%d texels hold the cloud", seen);
    lom_free_image(image);
    lom_close_device(device);
    lom_free_cloud_set(set);
}

int main(int argc, char **argv)
{
    RUN(test_powers_of_two_by_saturation);
    RUN(test_reference_edges);
    RUN(test_plate_covers_the_box_with_a_border);
    RUN(test_plate_covers_what_is_in_view);
    RUN(test_plate_out_of_view_costs_nothing);
    RUN(test_texels_are_no_finer_than_the_cloud);
    RUN(test_no_parallax_without_moving);
    RUN(test_parallax_follows_the_closed_form);
    RUN(i3_threshold_exactly_equal_keeps);
    RUN(i3_swinging_about_the_bound_refreshes_once);
    RUN(i3_switches_have_hysteresis);
    RUN(test_size_error);
    RUN(i1_behind_straddling_and_inside_have_no_plate);
    RUN(i2_i5_sizes_from_nothing_to_huge);
    RUN(i4_roll_and_pole);
    RUN(test_misting);
    RUN(test_painters_order_with_ties);
    RUN(i6_plate_border_is_empty);
    return check_result();
}
