/* The picture of the sun. In: a size, how strong its rays are. Out: how bright each place around the sun is: a disc, a
 * glow that falls off in all directions, faint rays. 0 at the edge, so that the square it is on does not show. */
#include "base/own_float_state.h"
#include "base/range.h"
#include "sky/sky_draw.h"

static double falloff(double from, double to, double x)
{
    double t = (x - from) / (to - from);
    t = t > 0 ? t < 1 ? t : 1 : 0;
    return 1 - t * t * (3 - 2 * t);
}

/* Rays: two fans of different counts, sharpened. */
static double rays_at(double angle)
{
    double a = 0.5 + 0.5 * lom_double_cos(7 * angle + 1.3), b = 0.5 + 0.5 * lom_double_cos(12 * angle + 0.4);
    return 0.5 * a * a * a + 0.5 * b * b * b * b;
}

lom_image *lom_make_sun_picture(int size, double rays, lom_error *error)
{
    LOM_OWN_FLOAT_STATE;
    if (!lom_check_range(rays, 0, 1, error, "The strength of the sun's rays"))
        return NULL;
    lom_image *image = lom_create_image(size, size, 1, LOM_FORMAT_R32F, error);
    for (int y = 0; image != NULL && y < size; y++)
        for (int x = 0; x < size; x++) {
            double dx = (2 * x + 1.0) / size - 1, dy = (2 * y + 1.0) / size - 1;
            double square = dx * dx + dy * dy, r = lom_double_sqrt(square);
            double rest = square < 1 ? 1 - r : 0;
            double light = 4 * falloff(0.035, 0.05, r) + 1.2 * lom_double_exp(-r / 0.06) + 0.25 * rest;
            light += 0.4 * rays * rays_at(lom_double_atan2(dy, dx)) * falloff(0.02, 0.1, 0.12 - r);
            *(float *)lom_image_pixel(image, x, y, 0) = (float)(light * rest * rest);
        }
    return image;
}
