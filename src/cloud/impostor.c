/* What impostors decide. In: the corners of a cloud's box, eyes, how the picture looks. Out: plates and reasons to make
 * them anew. Invariant: functions of their arguments alone; a value exactly at a bound keeps the plate. */
#include "cloud/impostor.h"

static double ceiling(double x)
{
    return -lom_double_floor(-x);
}

uint32_t lom_next_power_of_two(uint32_t n)
{
    if (n == 0)
        return 1;
    n--;
    for (int shift = 1; shift < 32; shift *= 2)
        n |= n >> shift;
    return n + 1;
}

int lom_reference_plate_edge(double width, double height, int window_height, int largest)
{
    double smaller = width < height ? width : height;
    double edge = ceiling(smaller * 3 * 64 / window_height);
    if (!(edge > 1))
        return 1;
    return edge >= largest ? largest : (int)lom_next_power_of_two((uint32_t)lom_count_of(edge, (size_t)largest));
}

bool lom_find_window(const lom_vec3 corner[8], lom_vec3 eye, const lom_vec3 axes[3], double near_plane,
                     struct lom_plate *plate)
{
    *plate = (struct lom_plate){ .eye = eye, .right = axes[0], .up = axes[1], .forward = axes[2] };
    for (int a = 0; a < 2; a++) {
        plate->low[a] = 1e300;
        plate->high[a] = -1e300;
    }
    plate->distance = 1e300;
    for (int c = 0; c < 8; c++) {
        lom_vec3 to = lom_vec3_subtract(corner[c], eye);
        double along = lom_vec3_dot(to, axes[2]);
        if (!(along > near_plane))
            return false;
        plate->distance = along < plate->distance ? along : plate->distance;
        for (int a = 0; a < 2; a++) {
            double tangent = lom_vec3_dot(to, axes[a]) / along;
            plate->low[a] = tangent < plate->low[a] ? tangent : plate->low[a];
            plate->high[a] = tangent > plate->high[a] ? tangent : plate->high[a];
        }
    }
    for (int a = 0; a < 2; a++) {
        plate->whole_low[a] = plate->low[a];
        plate->whole_high[a] = plate->high[a];
    }
    return true;
}

/* Of the polygon in[0..count) what lies where side.x x + side.y y + side.z >= 0 (Sutherland and Hodgman 1974). */
static int cut_polygon(double (*in)[2], int count, lom_vec3 side, double (*out)[2])
{
    int kept = 0;
    for (int i = 0; i < count; i++) {
        const double *a = in[i], *b = in[(i + 1) % count];
        double at = side.x * a[0] + side.y * a[1] + side.z, next = side.x * b[0] + side.y * b[1] + side.z;
        if (at >= 0) {
            out[kept][0] = a[0];
            out[kept++][1] = a[1];
        }
        if ((at < 0) != (next < 0)) {
            double part = at / (at - next);
            out[kept][0] = a[0] + part * (b[0] - a[0]);
            out[kept++][1] = a[1] + part * (b[1] - a[1]);
        }
    }
    return kept;
}

bool lom_find_visible(const struct lom_plate *plate, lom_vec3 eye, const struct lom_impostor_eye *view, double margin,
                      double low[2], double high[2])
{
    const double *l = plate->whole_low, *h = plate->whole_high;
    double polygon[2][8][2] = { { { l[0], l[1] }, { h[0], l[1] }, { h[0], h[1] }, { l[0], h[1] } } };
    int count = 4;
    lom_vec3 moved = lom_vec3_subtract(plate->eye, eye);
    for (int s = 0; s < 4; s++) { /* the plane through the eye and a side of the picture: normal . (point - eye) >= 0 */
        lom_vec3 across = s & 1 ? view->up : view->right;
        lom_vec3 normal = lom_vec3_add(lom_vec3_scale(across, s & 2 ? -1 : 1),
                                       lom_vec3_scale(view->forward, view->tangent[s & 1] * (1 + margin)));
        lom_vec3 side = { lom_vec3_dot(normal, plate->right), lom_vec3_dot(normal, plate->up),
                          lom_vec3_dot(normal, plate->forward) + lom_vec3_dot(normal, moved) / plate->distance };
        count = cut_polygon(polygon[s & 1], count, side, polygon[~s & 1]);
    }
    for (int a = 0; a < 2; a++) {
        low[a] = 1e300;
        high[a] = -1e300;
        for (int i = 0; i < count; i++) {
            low[a] = polygon[0][i][a] < low[a] ? polygon[0][i][a] : low[a];
            high[a] = polygon[0][i][a] > high[a] ? polygon[0][i][a] : high[a];
        }
    }
    return count != 0;
}

bool lom_make_reference_plate(const lom_vec3 corner[8], lom_vec3 eye, const struct lom_impostor_eye *view, int largest,
                              struct lom_plate *plate)
{
    const lom_vec3 axes[3] = { view->right, view->up, view->forward };
    if (!lom_find_window(corner, eye, axes, view->near_plane, plate))
        return false;
    double extent[2];
    for (int a = 0; a < 2; a++)
        extent[a] = (plate->high[a] - plate->low[a]) / view->pixel;
    plate->width = plate->height = lom_reference_plate_edge(extent[0], extent[1], view->height, largest);
    plate->extent = extent[0] > extent[1] ? extent[0] : extent[1];
    plate->pitch = plate->extent / plate->width;
    return true;
}

static const double view_margin = 0.15;

bool lom_make_facing_plate(const lom_vec3 corner[8], lom_vec3 eye, const struct lom_impostor_eye *view, double scale,
                           double finest, int largest, struct lom_plate *plate)
{
    lom_mat4 look = lom_look_at(eye, (lom_vec3){ 0, 0, 0 }, (lom_vec3){ 0, 1, 0 });
    const lom_vec3 axes[3] = { { look.m[0][0], look.m[0][1], look.m[0][2] },
                               { look.m[1][0], look.m[1][1], look.m[1][2] },
                               { -look.m[2][0], -look.m[2][1], -look.m[2][2] } };
    if (!lom_find_window(corner, eye, axes, view->near_plane, plate))
        return false;
    plate->distance = lom_vec3_length(eye);
    double width = plate->high[0] - plate->low[0], height = plate->high[1] - plate->low[1];
    plate->extent = (width > height ? width : height) / view->pixel;
    if (!lom_find_visible(plate, eye, view, view_margin, plate->low, plate->high))
        for (int a = 0; a < 2; a++)
            plate->low[a] = plate->high[a] = (plate->whole_low[a] + plate->whole_high[a]) / 2;
    width = plate->high[0] - plate->low[0];
    height = plate->high[1] - plate->low[1];
    double texel = view->pixel / scale, longest = width > height ? width : height;
    texel = texel > finest / plate->distance ? texel : finest / plate->distance;
    if (longest / texel > largest - 2)
        texel = longest / (largest - 2);
    plate->pitch = texel / view->pixel;
    for (int a = 0; a < 2; a++) {
        double extent = plate->high[a] - plate->low[a], middle = (plate->high[a] + plate->low[a]) / 2;
        int texels = 2 + lom_int_of(ceiling(extent / texel));
        texels = (texels + 15) / 16 * 16 < largest ? (texels + 15) / 16 * 16 : largest;
        plate->low[a] = middle - texels * texel / 2;
        plate->high[a] = middle + texels * texel / 2;
        *(a == 0 ? &plate->width : &plate->height) = texels;
    }
    return true;
}

void lom_make_screen_plate(lom_vec3 eye, const struct lom_impostor_eye *view, double scale, int width, int height,
                           struct lom_plate *plate)
{
    *plate = (struct lom_plate){ .eye = eye,
                                 .right = view->right,
                                 .up = view->up,
                                 .forward = view->forward,
                                 .low = { -view->tangent[0], -view->tangent[1] },
                                 .high = { view->tangent[0], view->tangent[1] },
                                 .distance = 2 * view->near_plane,
                                 .pitch = 1 / scale };
    plate->width = lom_int_of(ceiling(width * scale));
    plate->height = lom_int_of(ceiling(height * scale));
}

static double square(double x)
{
    return x * x;
}

double lom_parallax_error(const struct lom_plate *plate, const lom_vec3 corner[8], lom_vec3 eye,
                          const struct lom_impostor_eye *view)
{
    double most = 0;
    double edge = 1 / (1 + square(view->tangent[0]) + square(view->tangent[1])); /* cos^2 at the picture's corner */
    for (int c = 0; c < 8; c++) {
        lom_vec3 ray = lom_vec3_subtract(corner[c], plate->eye);
        lom_vec3 shown =
            lom_vec3_add(plate->eye, lom_vec3_scale(ray, plate->distance / lom_vec3_dot(ray, plate->forward)));
        lom_vec3 a = lom_vec3_normalize(lom_vec3_subtract(corner[c], eye));
        lom_vec3 b = lom_vec3_normalize(lom_vec3_subtract(shown, eye));
        double ahead = lom_vec3_dot(a, view->forward), other = lom_vec3_dot(b, view->forward);
        ahead = other < ahead ? other : ahead;
        double squeeze = ahead > 0 && ahead * ahead > edge ? ahead * ahead : edge;
        double error = lom_vec3_length(lom_vec3_subtract(a, b)) / (view->pixel * squeeze);
        most = error > most ? error : most;
    }
    return most;
}

double lom_plate_pitch(const struct lom_plate *plate, lom_vec3 eye, const struct lom_impostor_eye *view)
{
    double wide = (plate->high[0] - plate->low[0]) / plate->width;
    double tall = (plate->high[1] - plate->low[1]) / plate->height;
    return (wide > tall ? wide : tall) * lom_vec3_length(plate->eye) / (lom_vec3_length(eye) * view->pixel);
}

enum lom_refresh lom_reference_refresh(const struct lom_plate *plate, lom_vec3 eye, const struct lom_impostor_eye *view,
                                       double longest)
{
    if (lom_vec3_length(eye) < 2 * longest)
        return LOM_REFRESH_NEAR;
    return lom_vec3_dot(plate->forward, view->forward) < 0.99999 ? LOM_REFRESH_VIEW : LOM_REFRESH_NONE;
}

enum lom_refresh lom_bounded_refresh(const struct lom_plate *plate, const lom_vec3 corner[8], lom_vec3 eye,
                                     const struct lom_impostor_eye *view, double bound)
{
    double pitch = lom_plate_pitch(plate, eye, view);
    if (pitch - plate->pitch > bound || pitch < plate->pitch / 2)
        return LOM_REFRESH_SIZE;
    double low[2], high[2];
    if (lom_find_visible(plate, eye, view, 0, low, high))
        for (int a = 0; a < 2; a++)
            if (low[a] < plate->low[a] || high[a] > plate->high[a])
                return LOM_REFRESH_VIEW;
    return lom_parallax_error(plate, corner, eye, view) > bound ? LOM_REFRESH_VIEW : LOM_REFRESH_NONE;
}

bool lom_switch(bool was_on, double value, double on, double off)
{
    return was_on ? !(value > off) : value < on;
}

double lom_misting(double distance, double longest)
{
    double part = distance / (2 * longest);
    return part < 1 ? part > 0.8 ? part : 0.8 : 1;
}
