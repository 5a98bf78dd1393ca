/* Cameras: view and projection matrices, the frustum and boxes against it. In: cameras in metres and radians. Out:
 * matrices to clip space (0 <= z <= w, reversed depth; or OpenGL's: lom/geometry.h) and a conservative visibility.
 * Compiled for speed. */
#include "base/numbers.h"
#include "geometry/frustum.h"

#include <lom/geometry.h>

#include <string.h>

/* ---- views ---- */

/* A unit vector across forward and up, or the zero vector when they are parallel within rounding. */
static lom_vec3 across(lom_vec3 forward, lom_vec3 up)
{
    lom_vec3 side = lom_vec3_cross(forward, lom_vec3_normalize(up));
    return lom_vec3_length(side) > 1e-12 ? lom_vec3_normalize(side) : (lom_vec3){ 0, 0, 0 };
}

lom_mat4 lom_look_at(lom_vec3 eye, lom_vec3 target, lom_vec3 up)
{
    lom_vec3 forward = lom_vec3_normalize(lom_vec3_subtract(target, eye));
    if (lom_vec3_dot(forward, forward) == 0)
        forward = (lom_vec3){ 0, 0, -1 };
    const lom_vec3 ups[3] = { up, { 0, 0, forward.y < 0 ? -1 : 1 }, { 0, 1, 0 } };
    lom_vec3 s = { 0, 0, 0 };
    for (int i = 0; i < 3 && lom_vec3_dot(s, s) == 0; i++)
        s = across(forward, ups[i]);
    lom_vec3 u = lom_vec3_cross(s, forward);
    return (lom_mat4){ { { s.x, s.y, s.z, -lom_vec3_dot(s, eye) },
                         { u.x, u.y, u.z, -lom_vec3_dot(u, eye) },
                         { -forward.x, -forward.y, -forward.z, lom_vec3_dot(forward, eye) },
                         { 0, 0, 0, 1 } } };
}

/* ---- projections ---- */

static bool positive(double x)
{
    return x > 0 && x < __builtin_inf();
}

static bool valid_view(double field_of_view, double aspect, double near_plane)
{
    return field_of_view > 0 && field_of_view < lom_pi && positive(aspect) && positive(near_plane);
}

/* cot(angle / 2) by sine and cosine, so that it stays finite up to pi. */
static double focal_length(double field_of_view)
{
    return lom_double_cos(field_of_view / 2) / lom_double_sin(field_of_view / 2);
}

lom_mat4 lom_perspective(double field_of_view, double aspect, double near_plane)
{
    if (!valid_view(field_of_view, aspect, near_plane))
        return (lom_mat4){ { { 0 } } };
    double t = focal_length(field_of_view);
    return (lom_mat4){ { { t / aspect, 0, 0, 0 }, { 0, t, 0, 0 }, { 0, 0, 0, near_plane }, { 0, 0, -1, 0 } } };
}

lom_mat4 lom_perspective_gl(double field_of_view, double aspect, double near_plane, double far_plane)
{
    double depth = near_plane - far_plane;
    if (!valid_view(field_of_view, aspect, near_plane) || !positive(-depth))
        return (lom_mat4){ { { 0 } } };
    double t = focal_length(field_of_view);
    return (lom_mat4){ { { t / aspect, 0, 0, 0 },
                         { 0, t, 0, 0 },
                         { 0, 0, (far_plane + near_plane) / depth, 2 * far_plane * near_plane / depth },
                         { 0, 0, -1, 0 } } };
}

/* z = (far + z_view) / (far - near): 1 at z_view = -near, 0 at -far. */
lom_mat4 lom_orthographic(double width, double height, double near_plane, double far_plane)
{
    double depth = far_plane - near_plane;
    if (!positive(width) || !positive(height) || !positive(depth))
        return (lom_mat4){ { { 0 } } };
    return (lom_mat4){
        { { 2 / width, 0, 0, 0 }, { 0, 2 / height, 0, 0 }, { 0, 0, 1 / depth, far_plane / depth }, { 0, 0, 0, 1 } }
    };
}

static bool is_finite(double x)
{
    return x - x == 0;
}

/* x' = x + right depth, depth = -z. */
lom_mat4 lom_oblique(double width, double height, double near_plane, double far_plane, double right, double up)
{
    lom_mat4 m = lom_orthographic(width, height, near_plane, far_plane);
    if (m.m[3][3] == 0 || !is_finite(right) || !is_finite(up))
        return (lom_mat4){ { { 0 } } };
    m.m[0][2] = -right * m.m[0][0];
    m.m[1][2] = -up * m.m[1][1];
    return m;
}

/* ---- rays ---- */

/* With clip x = p00 x + p02 z + p03: where z is 0, x is (ndc - p03) / p00; a metre of depth moves it by p02 / p00. */
lom_view_rays lom_find_view_rays(const lom_mat4 *projection, const lom_mat4 *view)
{
    const double(*p)[4] = projection->m, (*v)[4] = view->m, scale[2] = { 1 / p[0][0], 1 / p[1][1] };
    lom_view_rays rays = { .parallel = p[3][2] == 0, .ahead = { -v[2][0], -v[2][1], -v[2][2] } };
    double along[3];
    for (int i = 0; i < 3; i++) {
        rays.row[i][0] = v[0][i] * scale[0];
        rays.row[i][1] = v[1][i] * scale[1];
        rays.row[i][2] = -v[2][i];
        along[i] = v[0][i] * p[0][2] * scale[0] + v[1][i] * p[1][2] * scale[1] - v[2][i];
        if (rays.parallel)
            rays.row[i][2] = -v[0][i] * p[0][3] * scale[0] - v[1][i] * p[1][3] * scale[1];
    }
    rays.along = (lom_vec3){ along[0], along[1], along[2] };
    return rays;
}

/* The view's rotation takes a vector of the view to the world. */
static lom_vec3 turned(const lom_mat4 *view, double x, double y, double z)
{
    const double(*v)[4] = view->m;
    return (lom_vec3){ v[0][0] * x + v[1][0] * y + v[2][0] * z, v[0][1] * x + v[1][1] * y + v[2][1] * z,
                       v[0][2] * x + v[1][2] * y + v[2][2] * z };
}

void lom_ray_through(const lom_mat4 *projection, const lom_mat4 *view, lom_vec3 eye, double x, double y,
                     lom_vec3 *origin, lom_vec3 *direction)
{
    const double(*p)[4] = projection->m;
    *origin = eye;
    if (p[3][2] != 0) {
        *direction = turned(view, x / p[0][0], y / p[1][1], -1);
        return;
    }
    *direction = turned(view, p[0][2] / p[0][0], p[1][2] / p[1][1], -1);
    *origin = lom_vec3_add(eye, turned(view, (x - p[0][3]) / p[0][0], (y - p[1][3]) / p[1][1], 0));
}

/* ---- boxes ---- */

static bool empty_box(lom_box box)
{
    return box.low.x > box.high.x || box.low.y > box.high.y || box.low.z > box.high.z;
}

static bool holds_nan(lom_box box)
{
    return box.low.x != box.low.x || box.low.y != box.low.y || box.low.z != box.low.z || box.high.x != box.high.x ||
           box.high.y != box.high.y || box.high.z != box.high.z;
}

/* Arvo, Transforming Axis-Aligned Bounding Boxes, Graphics Gems 1990: an axis is a sum of intervals. */
lom_box lom_transform_box(const lom_mat4 *m, lom_box box)
{
    if (empty_box(box))
        return box;
    double low[3] = { box.low.x, box.low.y, box.low.z }, high[3] = { box.high.x, box.high.y, box.high.z };
    double out_low[3], out_high[3];
    for (int i = 0; i < 3; i++) {
        out_low[i] = out_high[i] = m->m[i][3];
        for (int j = 0; j < 3; j++) {
            double a = m->m[i][j] * low[j], b = m->m[i][j] * high[j];
            out_low[i] += a < b ? a : b;
            out_high[i] += a < b ? b : a;
        }
    }
    return (lom_box){ { out_low[0], out_low[1], out_low[2] }, { out_high[0], out_high[1], out_high[2] } };
}

/* ---- the frustum ---- */

/* Adds the plane last * row 3 + sign * row >= 0, unless it does not depend on the point and always holds. */
static void add_plane(lom_frustum *frustum, const lom_mat4 *m, int row, double last, double sign)
{
    double *plane = frustum->plane[frustum->count], *reach = frustum->reach[frustum->count];
    for (int j = 0; j < 4; j++) {
        plane[j] = last * m->m[3][j] + sign * m->m[row][j];
        reach[j] = last * __builtin_fabs(m->m[3][j]) + __builtin_fabs(m->m[row][j]);
    }
    if (plane[0] != 0 || plane[1] != 0 || plane[2] != 0 || plane[3] < 0)
        frustum->count++;
}

lom_frustum lom_view_frustum(const lom_mat4 *view_projection, bool gl_depth)
{
    lom_frustum frustum = { 0 };
    for (int row = 0; row < 2; row++) {
        add_plane(&frustum, view_projection, row, 1, 1);
        add_plane(&frustum, view_projection, row, 1, -1);
    }
    add_plane(&frustum, view_projection, 2, gl_depth ? 1 : 0, 1);
    add_plane(&frustum, view_projection, 2, 1, -1);
    return frustum;
}

/* What rounding may have made of a plane's value at a corner of a box is a part of this. */
static double size_at(const double reach[4], const double low[3], const double high[3])
{
    double size = reach[3];
    for (int j = 0; j < 3; j++) {
        double p = __builtin_fabs(low[j]), q = __builtin_fabs(high[j]);
        size += reach[j] * (p > q ? p : q);
    }
    return size;
}

/* How far floats are off counts only near a plane. */
static inline lom_visibility side_of(const lom_frustum *frustum, int k, const double low[3], const double high[3],
                                     bool may_be_inside)
{
    const double rounding = 0x1p-20; /* four roundings of a float, four times over */
    const double *plane = frustum->plane[k], *reach = frustum->reach[k];
    double farthest = plane[3], nearest = plane[3];
    for (int j = 0; j < 3; j++) {
        double a = plane[j] * low[j], b = plane[j] * high[j];
        farthest += a > b ? a : b;
        nearest += a > b ? b : a;
    }
    if (farthest < 0 && farthest < -rounding * size_at(reach, low, high))
        return LOM_OUTSIDE;
    const bool inside = may_be_inside && nearest > 0 && nearest > rounding * size_at(reach, low, high);
    return inside ? LOM_INSIDE : LOM_CROSSING;
}

/* Of the box only the farthest corner counts, once it crosses a plane. */
lom_visibility lom_box_visibility(const lom_frustum *frustum, lom_box box)
{
    double low[3] = { box.low.x, box.low.y, box.low.z }, high[3] = { box.high.x, box.high.y, box.high.z };
    if (holds_nan(box))
        return LOM_CROSSING;
    if (empty_box(box))
        return LOM_OUTSIDE;
    lom_visibility visibility = LOM_INSIDE;
    for (int k = 0; k < frustum->count; k++) {
        const lom_visibility side = side_of(frustum, k, low, high, visibility == LOM_INSIDE);
        if (side == LOM_OUTSIDE)
            return LOM_OUTSIDE;
        visibility = side;
    }
    return visibility;
}

lom_visibility lom_find_crossed(const lom_frustum *frustum, lom_box box, lom_frustum *crossed)
{
    double low[3] = { box.low.x, box.low.y, box.low.z }, high[3] = { box.high.x, box.high.y, box.high.z };
    const bool is_odd = holds_nan(box);
    if (!is_odd && empty_box(box))
        return LOM_OUTSIDE;
    crossed->count = 0;
    for (int k = 0; k < frustum->count; k++) {
        const lom_visibility side = is_odd ? LOM_CROSSING : side_of(frustum, k, low, high, true);
        if (side == LOM_OUTSIDE)
            return LOM_OUTSIDE;
        if (side == LOM_INSIDE)
            continue;
        memcpy(crossed->plane[crossed->count], frustum->plane[k], sizeof frustum->plane[k]);
        memcpy(crossed->reach[crossed->count], frustum->reach[k], sizeof frustum->reach[k]);
        crossed->count++;
    }
    return crossed->count > 0 || is_odd ? LOM_CROSSING : LOM_INSIDE;
}
