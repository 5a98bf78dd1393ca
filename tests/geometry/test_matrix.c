/* Matrices, cameras and frustum: closed forms, identities, and a sampled oracle. */
#include "check.h"

#include <lom/geometry.h>

static const double PI = 3.14159265358979323846;

static double distance(const lom_mat4 *a, const lom_mat4 *b)
{
    double largest = 0;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++) {
            double d = __builtin_fabs(a->m[i][j] - b->m[i][j]);
            largest = d > largest || d != d ? d : largest;
        }
    return largest;
}

static double separation(lom_vec3 a, lom_vec3 b)
{
    return lom_vec3_length(lom_vec3_subtract(a, b));
}

static double uniform(uint64_t *counter, double low, double high)
{
    return low + (high - low) * lom_random_uniform(77, (*counter)++);
}

static lom_vec3 random_vector(uint64_t *counter, double low, double high)
{
    lom_vec3 v;
    v.x = uniform(counter, low, high);
    v.y = uniform(counter, low, high);
    v.z = uniform(counter, low, high);
    return v;
}

static bool all_zero(const lom_mat4 *m)
{
    for (int i = 0; i < 16; i++)
        if (m->m[i / 4][i % 4] != 0)
            return false;
    return true;
}

static void vectors(void)
{
    lom_vec3 a = { 1, 2, 3 }, b = { -4, 5, 6 }, c = lom_vec3_cross(a, b);
    CHECK(c.x == -3 && c.y == -18 && c.z == 13);
    CHECK(lom_vec3_dot(a, c) == 0 && lom_vec3_dot(b, c) == 0);
    CHECK(lom_vec3_length((lom_vec3){ 3e300, 4e300, 0 }) > 4.9999999e300);
    CHECK(lom_vec3_length((lom_vec3){ 3e-310, 4e-310, 0 }) > 4.99e-310);
    lom_vec3 unit = lom_vec3_normalize((lom_vec3){ 0, -5e-320, 0 });
    CHECK(unit.x == 0 && unit.y == -1 && unit.z == 0);
    lom_vec3 none[3] = { { 0, 0, 0 }, { __builtin_nan(""), 1, 0 }, { 1, __builtin_inf(), 0 } };
    for (int i = 0; i < 3; i++) {
        unit = lom_vec3_normalize(none[i]);
        CHECK(unit.x == 0 && unit.y == 0 && unit.z == 0, "case %d", i);
    }
}

static void rotations(void)
{
    lom_mat4 x = lom_rotation((lom_vec3){ PI / 2, 0, 0 }), z = lom_rotation((lom_vec3){ 0, 0, PI / 2 });
    CHECK(separation(lom_transform_point(&x, (lom_vec3){ 0, 1, 0 }), (lom_vec3){ 0, 0, 1 }) < 1e-15);
    CHECK(separation(lom_transform_point(&z, (lom_vec3){ 1, 0, 0 }), (lom_vec3){ 0, 1, 0 }) < 1e-15);
    uint64_t counter = 0;
    for (int i = 0; i < 1000; i++) {
        lom_vec3 angle = random_vector(&counter, -7, 7), factor = random_vector(&counter, .1, 3);
        lom_vec3 offset = random_vector(&counter, -50, 50);
        lom_mat4 rx = lom_rotation((lom_vec3){ angle.x, 0, 0 }), ry = lom_rotation((lom_vec3){ 0, angle.y, 0 });
        lom_mat4 rz = lom_rotation((lom_vec3){ 0, 0, angle.z }), whole = lom_rotation(angle);
        lom_mat4 product = lom_multiply(&ry, &rx), identity = lom_identity();
        product = lom_multiply(&rz, &product);
        CHECK(distance(&whole, &product) < 1e-15);
        lom_mat4 transposed = lom_transpose(&whole), one = lom_multiply(&whole, &transposed);
        CHECK(distance(&one, &identity) < 1e-15);
        lom_mat4 t = lom_translation(offset), s = lom_scaling(factor);
        product = lom_multiply(&whole, &s);
        product = lom_multiply(&t, &product);
        lom_mat4 model = lom_model_matrix(offset, angle, factor);
        CHECK(distance(&model, &product) < 1e-14);
    }
}

static void inverses(void)
{
    uint64_t counter = 0;
    const double scales[] = { 1, 1e-3, 1e-20, 1e20, 1e-150, 1e150 };
    for (int i = 0; i < 6000; i++) {
        double scale = scales[i % 6];
        lom_vec3 factor = random_vector(&counter, .1, 3);
        lom_mat4 model = lom_model_matrix(random_vector(&counter, -50, 50), random_vector(&counter, -7, 7),
                                          (lom_vec3){ factor.x * scale, -factor.y, factor.z }),
                 inverse, identity = lom_identity();
        CHECK(lom_invert(&model, &inverse), "scale %g", scale);
        lom_mat4 one = lom_multiply(&inverse, &model);
        for (int r = 0; r < 4; r++) /* rounding of an entry is relative to the terms that make it */
            for (int c = 0; c < 4; c++) {
                double size = 1;
                for (int k = 0; k < 4; k++)
                    size += __builtin_fabs(inverse.m[r][k] * model.m[k][c]);
                CHECK(__builtin_fabs(one.m[r][c] - identity.m[r][c]) <= 1e-14 * size, "scale %g: %d,%d", scale, r, c);
            }
    }
    lom_mat4 projection = lom_perspective(1, 1.5, .1), inverse, identity = lom_identity();
    CHECK(lom_invert(&projection, &inverse));
    lom_mat4 one = lom_multiply(&projection, &inverse);
    CHECK(distance(&one, &identity) < 1e-15);
    CHECK(lom_invert(&identity, &inverse) && distance(&inverse, &identity) == 0);
    CHECK(lom_invert(&projection, &projection), "in place");
    lom_mat4 tiny = lom_scaling((lom_vec3){ 1e-300, 1e-300, 1e-300 });
    CHECK(lom_invert(&tiny, &inverse) && inverse.m[0][0] > .99e300 && inverse.m[0][0] < 1.01e300);
}

static void singular(void)
{
    lom_mat4 cases[] = {
        { { { 1, 2, 3, 0 }, { 4, 5, 6, 0 }, { 7, 8, 9, 0 }, { 0, 0, 0, 1 } } },
        { { { 0.1, 0.2, 0.3, 0 }, { 0.4, 0.5, 0.6, 0 }, { 0.7, 0.8, 0.9, 0 }, { 0, 0, 0, 1 } } },
        lom_scaling((lom_vec3){ 1, 0, 1 }),
        lom_scaling((lom_vec3){ __builtin_nan(""), 1, 1 }),
        lom_scaling((lom_vec3){ __builtin_inf(), 1, 1 }),
        lom_scaling((lom_vec3){ 1e-310, 1, 1 }), /* its inverse does not fit */
        { { { 0 } } },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        lom_mat4 inverse = lom_identity(), normal = lom_identity();
        CHECK(!lom_invert(&cases[i], &inverse) && all_zero(&inverse), "case %zu", i);
        bool normal_exists = lom_normal_matrix(&cases[i], &normal);
        CHECK(!normal_exists && all_zero(&normal), "case %zu", i);
    }
    uint64_t counter = 0;
    for (int i = 0; i < 1000; i++) { /* a flattened and turned model is singular whatever the rounding */
        lom_mat4 turn = lom_rotation(random_vector(&counter, -7, 7)), flat = lom_scaling((lom_vec3){ 1, 0, 2 });
        lom_mat4 back = lom_rotation(random_vector(&counter, -7, 7)), inverse;
        flat = lom_multiply(&turn, &flat);
        flat = lom_multiply(&flat, &back);
        CHECK(!lom_invert(&flat, &inverse));
    }
}

static void normals(void)
{
    uint64_t counter = 0;
    for (int i = 0; i < 1000; i++) { /* n . t = 0 stays so: n' = inverse transpose n, t' = M t */
        lom_mat4 model = lom_model_matrix(random_vector(&counter, -9, 9), random_vector(&counter, -7, 7),
                                          random_vector(&counter, .1, 5)),
                 normal;
        lom_vec3 n = random_vector(&counter, -1, 1), t = lom_vec3_cross(n, random_vector(&counter, -1, 1));
        CHECK(lom_normal_matrix(&model, &normal));
        double dot = lom_vec3_dot(lom_transform_direction(&normal, n), lom_transform_direction(&model, t));
        CHECK(__builtin_fabs(dot) < 1e-13, "%g", dot);
    }
}

static void mirrors(void)
{
    uint64_t counter = 0;
    for (int i = 0; i < 1000; i++) {
        lom_vec3 n = lom_vec3_normalize(random_vector(&counter, -1, 1)), p = random_vector(&counter, -9, 9);
        double d = uniform(&counter, -5, 5);
        lom_mat4 mirror = lom_mirror(n, d);
        lom_vec3 q = lom_transform_point(&mirror, p), middle = lom_vec3_scale(lom_vec3_add(p, q), .5);
        CHECK(__builtin_fabs(lom_vec3_dot(n, middle) - d) < 1e-13);
        CHECK(lom_vec3_length(lom_vec3_cross(n, lom_vec3_subtract(p, q))) < 1e-12);
        CHECK(separation(lom_transform_point(&mirror, q), p) < 1e-13);
    }
}

/* A camera mirrored in a level plane with its pitch inverted sees what the view times the mirror matrix shows, upside
 * down: so a lookup with y inverted in the one is the lookup as it is in the other, and depths agree. */
static void an_inverted_pitch_is_the_mirror_upside_down(void)
{
    const lom_vec3 up = { 0, 1, 0 };
    uint64_t counter = 0;
    for (int i = 0; i < 1000; i++) {
        double level = uniform(&counter, -5, 5), yaw = uniform(&counter, -PI, PI), pitch = uniform(&counter, -1.5, 1.5);
        lom_vec3 eye = random_vector(&counter, -9, 9), under = { eye.x, 2 * level - eye.y, eye.z };
        double flat = lom_double_cos(pitch), rise = lom_double_sin(pitch);
        lom_vec3 ahead = { -lom_double_sin(yaw) * flat, rise, -lom_double_cos(yaw) * flat },
                 inverted = { ahead.x, -rise, ahead.z };
        lom_mat4 view = lom_look_at(eye, lom_vec3_add(eye, ahead), up), mirror = lom_mirror(up, level);
        lom_mat4 projection = lom_perspective(uniform(&counter, 0.3, 2), 1.6, 0.1);
        lom_mat4 mirrored = lom_multiply(&view, &mirror);
        lom_mat4 moved = lom_look_at(under, lom_vec3_add(under, inverted), up);
        mirrored = lom_multiply(&projection, &mirrored);
        moved = lom_multiply(&projection, &moved);
        for (int k = 0; k < 20; k++) {
            lom_vec3 p = random_vector(&counter, -50, 50);
            double a[4], b[4];
            lom_transform_clip(&mirrored, p, a);
            lom_transform_clip(&moved, p, b);
            double size = __builtin_fabs(a[3]) + 1;
            CHECK(__builtin_fabs(a[0] - b[0]) < 1e-11 * size && __builtin_fabs(a[1] + b[1]) < 1e-11 * size &&
                      a[2] == b[2] && __builtin_fabs(a[3] - b[3]) < 1e-11 * size,
                  "camera %d, point %d: %g %g %g, %g %g %g", i, k, a[0], a[1], a[3], b[0], b[1], b[3]);
        }
    }
}

static void look_at(void)
{
    lom_mat4 identity = lom_identity();
    lom_mat4 view = lom_look_at((lom_vec3){ 0, 0, 0 }, (lom_vec3){ 0, 0, -3 }, (lom_vec3){ 0, 1, 0 });
    CHECK(distance(&view, &identity) == 0);
    view = lom_look_at((lom_vec3){ 1, 2, 3 }, (lom_vec3){ 1, 2, 3 }, (lom_vec3){ 0, 1, 0 });
    lom_mat4 expected = lom_translation((lom_vec3){ -1, -2, -3 });
    CHECK(distance(&view, &expected) == 0, "an eye at its target looks along -z");
    /* straight down with up = y: the top of the picture is -z, its right +x */
    view = lom_look_at((lom_vec3){ 0, 9, 0 }, (lom_vec3){ 0, 0, 0 }, (lom_vec3){ 0, 1, 0 });
    CHECK(separation(lom_transform_direction(&view, (lom_vec3){ 0, 0, -1 }), (lom_vec3){ 0, 1, 0 }) < 1e-15);
    CHECK(separation(lom_transform_direction(&view, (lom_vec3){ 1, 0, 0 }), (lom_vec3){ 1, 0, 0 }) < 1e-15);
    /* along z with up = z: falls through to +y */
    view = lom_look_at((lom_vec3){ 0, 0, 0 }, (lom_vec3){ 0, 0, -1 }, (lom_vec3){ 0, 0, 2 });
    CHECK(distance(&view, &identity) == 0);
    uint64_t counter = 0;
    for (int i = 0; i < 1000; i++) {
        lom_vec3 eye = random_vector(&counter, -9, 9), target = random_vector(&counter, -9, 9);
        view = lom_look_at(eye, target, i % 2 ? (lom_vec3){ 0, 1, 0 } : (lom_vec3){ 0, 0, 0 });
        CHECK(lom_vec3_length(lom_transform_point(&view, eye)) < 1e-13);
        lom_vec3 seen = lom_transform_point(&view, target);
        CHECK(separation(seen, (lom_vec3){ 0, 0, -separation(eye, target) }) < 1e-13);
        lom_mat4 linear = view;
        linear.m[0][3] = linear.m[1][3] = linear.m[2][3] = 0;
        lom_mat4 transposed = lom_transpose(&linear), one = lom_multiply(&linear, &transposed);
        CHECK(distance(&one, &identity) < 1e-14);
    }
}

static double depth(const lom_mat4 *projection, double z)
{
    double clip[4];
    lom_transform_clip(projection, (lom_vec3){ .3, -.2, z }, clip);
    return clip[2] / clip[3];
}

static void projections(void)
{
    lom_mat4 p = lom_perspective(PI / 3, 2, .25), g = lom_perspective_gl(PI / 3, 2, .5, 200);
    CHECK(depth(&p, -.25) == 1 && depth(&p, -1e30) < 1e-29 && depth(&p, -.5) == .5);
    CHECK(__builtin_fabs(depth(&g, -.5) + 1) < 1e-14 && __builtin_fabs(depth(&g, -200) - 1) < 1e-14);
    double clip[4], t = 1.7320508075688772; /* cot 30 degrees */
    lom_transform_clip(&p, (lom_vec3){ 2 / t, 1 / t, -1 }, clip);
    CHECK(__builtin_fabs(clip[0] - 1) < 1e-15 && __builtin_fabs(clip[1] - 1) < 1e-15 && clip[3] == 1);
    lom_mat4 o = lom_orthographic(8, 4, -3, 7);
    CHECK(__builtin_fabs(depth(&o, 3) - 1) < 1e-15 && __builtin_fabs(depth(&o, -7)) < 1e-15);
    lom_transform_clip(&o, (lom_vec3){ 4, -2, 0 }, clip);
    CHECK(clip[0] == 1 && clip[1] == -1 && clip[3] == 1);
    double nan = __builtin_nan(""), inf = __builtin_inf();
    const double bad[][4] = { { 0, 1, 1, 2 },   { PI, 1, 1, 2 },  { -1, 1, 1, 2 },  { 1, 0, 1, 2 },   { 1, -1, 1, 2 },
                              { 1, 1, 0, 2 },   { 1, 1, -1, 2 },  { nan, 1, 1, 2 }, { 1, nan, 1, 2 }, { 1, 1, nan, 2 },
                              { 1, inf, 1, 2 }, { 1, 1, inf, 2 }, { 4, 1, 1, 2 } };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        p = lom_perspective(bad[i][0], bad[i][1], bad[i][2]);
        g = lom_perspective_gl(bad[i][0], bad[i][1], bad[i][2], bad[i][3]);
        CHECK(all_zero(&p) && all_zero(&g), "case %zu", i);
    }
    const double bad_far[] = { 1, .5, nan, inf, -2 };
    for (int i = 0; i < 5; i++) {
        g = lom_perspective_gl(1, 1, 1, bad_far[i]);
        o = lom_orthographic(1, 1, 1, bad_far[i]);
        CHECK(all_zero(&g) && all_zero(&o), "case %d", i);
    }
}

/* What recedes a metre is shown so much farther right and up; the plane of the eye stays. */
static void oblique(void)
{
    lom_mat4 m = lom_oblique(8, 4, -3, 7, .5, -.25), o = lom_orthographic(8, 4, -3, 7);
    double clip[4];
    lom_transform_clip(&m, (lom_vec3){ 1, 1, 0 }, clip);
    CHECK(clip[0] == .25 && clip[1] == .5 && clip[3] == 1);
    lom_transform_clip(&m, (lom_vec3){ 1, 1, -4 }, clip);
    CHECK(clip[0] == .75 && clip[1] == 0 && depth(&m, -4) == depth(&o, -4));
    const double bad[][2] = { { __builtin_nan(""), 0 }, { 0, __builtin_inf() } };
    for (int i = 0; i < 2; i++) {
        m = lom_oblique(8, 4, -3, 7, bad[i][0], bad[i][1]);
        CHECK(all_zero(&m), "case %d", i);
    }
    m = lom_oblique(8, 4, 3, 3, 0, 0);
    CHECK(all_zero(&m));
}

/* A point on a ray is seen where the ray goes through, by every kind of projection, zoomed or mirrored. */
static void rays(void)
{
    uint64_t counter = 0;
    for (int k = 0; k < 3000; k++) {
        const lom_vec3 eye = random_vector(&counter, -9, 9);
        lom_mat4 view = lom_look_at(eye, random_vector(&counter, -9, 9), (lom_vec3){ 0, 1, 0 });
        lom_mat4 projection = k % 3 == 0   ? lom_perspective(1, 1.5, .5)
                              : k % 3 == 1 ? lom_orthographic(9, 6, .5, 12)
                                           : lom_oblique(9, 6, .5, 12, .3, .6);
        lom_vec3 start = eye;
        if (k % 2 == 1 && k % 3 != 0) { /* a part of the picture */
            lom_mat4 zoom = lom_scaling((lom_vec3){ 2, 3, 1 });
            zoom.m[0][3] = .25;
            zoom.m[1][3] = -.5;
            projection = lom_multiply(&zoom, &projection);
        } else if (k % 4 == 0) {
            lom_mat4 mirror = lom_mirror((lom_vec3){ 0, 1, 0 }, .75);
            view = lom_multiply(&view, &mirror);
            start.y = 1.5 - eye.y;
        }
        double x = uniform(&counter, -1, 1), y = uniform(&counter, -1, 1), t = uniform(&counter, 1, 9), clip[4];
        lom_vec3 origin, direction;
        lom_ray_through(&projection, &view, start, x, y, &origin, &direction);
        lom_mat4 all = lom_multiply(&projection, &view);
        lom_transform_clip(&all, lom_vec3_add(origin, lom_vec3_scale(direction, t)), clip);
        CHECK(__builtin_fabs(clip[0] / clip[3] - x) < 1e-12 && __builtin_fabs(clip[1] / clip[3] - y) < 1e-12,
              "%d: %g, %g, not %g, %g", k, clip[0] / clip[3], clip[1] / clip[3], x, y);
        lom_view_rays r = lom_find_view_rays(&projection, &view);
        CHECK(r.parallel == (k % 3 != 0) && __builtin_fabs(lom_vec3_dot(direction, r.ahead) - 1) < 1e-12);
        const double from[3] = { origin.x - start.x, origin.y - start.y, origin.z - start.z };
        const double along[3] = { direction.x, direction.y, direction.z };
        for (int i = 0; i < 3; i++) {
            double v = r.row[i][0] * x + r.row[i][1] * y + r.row[i][2];
            CHECK(__builtin_fabs(v - (r.parallel ? from[i] : along[i])) < 1e-12, "%d", k);
        }
    }
}

/* Both ends of a box, and all that rounding may be, at every plane: the specification of lom_box_visibility. */
static lom_visibility plain_visibility(const lom_frustum *planes, lom_vec3 from, lom_vec3 to)
{
    const double low[3] = { from.x, from.y, from.z }, high[3] = { to.x, to.y, to.z };
    lom_visibility visibility = LOM_INSIDE;
    for (int k = 0; k < planes->count; k++) {
        const double *plane = planes->plane[k], *reach = planes->reach[k];
        double most = plane[3], least = plane[3], size = reach[3];
        for (int j = 0; j < 3; j++) {
            most += plane[j] * (plane[j] > 0 ? high : low)[j];
            least += plane[j] * (plane[j] > 0 ? low : high)[j];
            const double ends[2] = { __builtin_fabs(low[j]), __builtin_fabs(high[j]) };
            size += reach[j] * ends[ends[1] > ends[0]];
        }
        if (most < -0x1p-20 * size)
            return LOM_OUTSIDE;
        visibility = least > 0x1p-20 * size ? visibility : LOM_CROSSING;
    }
    return visibility;
}

static void frustum(void)
{
    uint64_t counter = 0;
    int outside = 0, inside = 0, wrong = 0;
    for (int k = 0; k < 3000; k++) {
        bool gl = k % 2;
        lom_mat4 view =
            lom_look_at(random_vector(&counter, -9, 9), random_vector(&counter, -9, 9), (lom_vec3){ 0, 1, 0 });
        lom_mat4 projection = gl ? lom_perspective_gl(1, 1.5, .5, 12) : lom_perspective(1, 1.5, .5);
        lom_mat4 whole = lom_multiply(&projection, &view);
        lom_frustum planes = lom_view_frustum(&whole, gl);
        CHECK(planes.count == (gl ? 6 : 5), "%d planes", planes.count);
        lom_vec3 low = random_vector(&counter, -12, 12), size = random_vector(&counter, .1, 4);
        lom_visibility seen = lom_box_visibility(&planes, (lom_box){ low, lom_vec3_add(low, size) });
        outside += seen == LOM_OUTSIDE;
        inside += seen == LOM_INSIDE;
        wrong += seen != plain_visibility(&planes, low, lom_vec3_add(low, size));
        for (int i = 0; i < 200; i++) { /* no point of a box outside is in clip space, every one of a box inside is */
            lom_vec3 p = { low.x + size.x * (i % 6) / 5, low.y + size.y * (i / 6 % 6) / 5,
                           low.z + size.z * (i / 36) / 5 };
            double c[4];
            lom_transform_clip(&whole, p, c);
            bool in = c[0] >= -c[3] && c[0] <= c[3] && c[1] >= -c[3] && c[1] <= c[3] && c[2] <= c[3] &&
                      c[2] >= (gl ? -c[3] : 0);
            wrong += (seen == LOM_OUTSIDE && in) || (seen == LOM_INSIDE && !in);
        }
    }
    CHECK(wrong == 0, "%d points", wrong);
    CHECK(outside > 1000 && inside > 20, "%d outside, %d inside: the test proves little", outside, inside);
    lom_mat4 identity = lom_identity();
    lom_frustum unit = lom_view_frustum(&identity, true);
    double nan = __builtin_nan("");
    CHECK(lom_box_visibility(&unit, (lom_box){ { 1, 1, 1 }, { 2, 2, 2 } }) == LOM_CROSSING, "touching is not outside");
    CHECK(lom_box_visibility(&unit, (lom_box){ { 1.001, 0, 0 }, { 2, 1, 1 } }) == LOM_OUTSIDE);
    CHECK(lom_box_visibility(&unit, (lom_box){ { 1, 0, 0 }, { 0, 1, 1 } }) == LOM_OUTSIDE, "an empty box");
    CHECK(lom_box_visibility(&unit, (lom_box){ { nan, 5, 5 }, { 6, 6, 6 } }) == LOM_CROSSING);
}

static void boxes(void)
{
    uint64_t counter = 0;
    for (int k = 0; k < 1000; k++) {
        lom_mat4 m = lom_model_matrix(random_vector(&counter, -9, 9), random_vector(&counter, -7, 7),
                                      random_vector(&counter, -2, 2));
        lom_vec3 low = random_vector(&counter, -5, 5), high = lom_vec3_add(low, random_vector(&counter, 0, 5));
        lom_box box = lom_transform_box(&m, (lom_box){ low, high });
        lom_vec3 most = { -1e9, -1e9, -1e9 };
        for (int i = 0; i < 8; i++) {
            lom_vec3 p = lom_transform_point(
                &m, (lom_vec3){ i & 1 ? low.x : high.x, i & 2 ? low.y : high.y, i & 4 ? low.z : high.z });
            most = (lom_vec3){ p.x > most.x ? p.x : most.x, p.y > most.y ? p.y : most.y, p.z > most.z ? p.z : most.z };
        }
        CHECK(separation(box.high, most) < 1e-13);
    }
    const lom_mat4 far = lom_translation((lom_vec3){ 5, 6, 7 });
    const lom_box nothing = { { 1, 0, 0 }, { -1, 2, 2 } };
    lom_box moved = lom_transform_box(&far, nothing);
    CHECK(memcmp(&moved, &nothing, sizeof moved) == 0, "an empty box is empty everywhere");
}

int main(int argc, char **argv)
{
    RUN(vectors);
    RUN(rotations);
    RUN(inverses);
    RUN(singular);
    RUN(normals);
    RUN(mirrors);
    RUN(an_inverted_pitch_is_the_mirror_upside_down);
    RUN(look_at);
    RUN(projections);
    RUN(oblique);
    RUN(rays);
    RUN(frustum);
    RUN(boxes);
    return check_result();
}
