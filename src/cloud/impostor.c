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
    return edge >= largest ? largest : (int)lom_next_power_of_two((uint32_t)edge);
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
    return true;
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

bool lom_make_facing_plate(const lom_vec3 corner[8], lom_vec3 eye, const struct lom_impostor_eye *view, double scale,
                           int largest, struct lom_plate *plate)
{
    lom_mat4 look = lom_look_at(eye, (lom_vec3){ 0, 0, 0 }, (lom_vec3){ 0, 1, 0 });
    const lom_vec3 axes[3] = { { look.m[0][0], look.m[0][1], look.m[0][2] },
                               { look.m[1][0], look.m[1][1], look.m[1][2] },
                               { -look.m[2][0], -look.m[2][1], -look.m[2][2] } };
    if (!lom_find_window(corner, eye, axes, view->near_plane, plate))
        return false;
    plate->distance = lom_vec3_length(eye);
    double width = plate->high[0] - plate->low[0], height = plate->high[1] - plate->low[1];
    double texel = view->pixel / scale, longest = width > height ? width : height;
    if (longest / texel > largest - 2)
        texel = longest / (largest - 2);
    plate->extent = longest / view->pixel;
    plate->pitch = texel / view->pixel;
    for (int a = 0; a < 2; a++) {
        double extent = plate->high[a] - plate->low[a], middle = (plate->high[a] + plate->low[a]) / 2;
        int texels = 2 + (int)ceiling(extent / texel);
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
    plate->width = (int)ceiling(width * scale);
    plate->height = (int)ceiling(height * scale);
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
