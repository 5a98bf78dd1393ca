/* Colour textures. In: a name, a size, a seed; out: an sRGB picture that repeats without a seam. Invariant: a painter
 * writes every pixel, and reads noise whose period divides the picture. */
#include "geometry/canvas.h"

#include <string.h>

lom_tint lom_tint_of(int r, int g, int b)
{
    return (lom_tint){ r / 255.0, g / 255.0, b / 255.0 };
}

lom_tint lom_mix_tint(lom_tint a, lom_tint b, double t)
{
    double part = lom_clamp_double(t, 0, 1);
    return (lom_tint){ lom_mix_double(a.r, b.r, part), lom_mix_double(a.g, b.g, part), lom_mix_double(a.b, b.b, part) };
}

lom_tint lom_scale_tint(lom_tint a, double factor)
{
    return (lom_tint){ a.r * factor, a.g * factor, a.b * factor };
}

size_t lom_canvas_index(const lom_canvas *canvas, int x, int y)
{
    int size = canvas->size;
    return (size_t)((y % size + size) % size) * (size_t)size + (size_t)((x % size + size) % size);
}

void lom_put_tint(lom_canvas *canvas, int x, int y, lom_tint tint)
{
    double *color = canvas->color[lom_canvas_index(canvas, x, y)];
    color[0] = tint.r;
    color[1] = tint.g;
    color[2] = tint.b;
}

void lom_cover(lom_canvas *canvas, int x, int y, lom_tint tint, double coverage)
{
    double *color = canvas->color[lom_canvas_index(canvas, x, y)];
    color[0] = lom_mix_double(color[0], tint.r, coverage);
    color[1] = lom_mix_double(color[1], tint.g, coverage);
    color[2] = lom_mix_double(color[2], tint.b, coverage);
}

/* Discs along a parabola, half a pixel apart; coverage falls over the last pixel of the radius. */
void lom_paint_stroke(lom_canvas *canvas, const lom_stroke *s)
{
    int steps = lom_int_of(s->length * 2) + 1;
    for (int i = 0; i < steps; i++) {
        double t = (double)i / steps;
        double sideways = s->bend * s->length * t * t;
        double x = s->x + s->dx * s->length * t - s->dy * sideways;
        double y = s->y + s->dy * s->length * t + s->dx * sideways;
        double radius = 0.5 * s->width * (1 - 0.75 * t);
        lom_tint tint = lom_mix_tint(s->foot, s->tip, t);
        int left = lom_int_of(lom_double_floor(x - radius)), top = lom_int_of(lom_double_floor(y - radius));
        int reach = lom_int_of(2 * radius) + 2;
        for (int b = top; b < top + reach; b++)
            for (int a = left; a < left + reach; a++) {
                double distance = lom_double_sqrt((a - x) * (a - x) + (b - y) * (b - y));
                double coverage = lom_clamp_double(radius + 0.5 - distance, 0, 1);
                if (coverage > 0)
                    lom_cover(canvas, a, b, tint, 0.6 * coverage);
            }
    }
}

void lom_shade_relief(lom_canvas *canvas, double strength)
{
    for (int y = 0; y < canvas->size; y++)
        for (int x = 0; x < canvas->size; x++) {
            double here = canvas->height[lom_canvas_index(canvas, x, y)];
            double across = here - canvas->height[lom_canvas_index(canvas, x - 1, y)];
            double down = here - canvas->height[lom_canvas_index(canvas, x, y - 1)];
            double slope = 0.6 * across + 0.8 * down;
            double light = 1 + strength * slope / lom_double_sqrt(1 + slope * slope);
            double *color = canvas->color[lom_canvas_index(canvas, x, y)];
            for (int k = 0; k < 3; k++)
                color[k] *= light;
        }
}

double lom_canvas_random(const lom_canvas *canvas, unsigned what, unsigned which)
{
    return lom_random_uniform(canvas->seed + what, which);
}

/* ---- the table ---- */

static const struct albedo {
    const char *name;
    int size; /* when none is asked for */
    void (*paint)(lom_canvas *canvas);
} albedos[] = {
    { "grass", 512, lom_paint_grass },
    { "forest", 512, lom_paint_forest },
    { "rock", 512, lom_paint_rock },
    { "shore", 512, lom_paint_shore },
    { "snow", 256, lom_paint_snow },
    { "planks", 256, lom_paint_planks },
    { "paint", 256, lom_paint_paint },
    { "log", 256, lom_paint_log },
    { "shingles", 256, lom_paint_shingles },
    { "bark", 256, lom_paint_bark },
    { "masonry", 256, lom_paint_masonry },
    { "needles", 256, lom_paint_needles },
    { "reed", 128, lom_paint_reed },
    { "window", 128, lom_paint_window },
    { "lit_window", 128, lom_paint_lit_window },
    { "stone", 256, lom_paint_rock },
    { "livery", 512, lom_paint_livery },
    { "net", 128, lom_paint_net },
};

const char *lom_albedo_name(size_t index)
{
    return index < sizeof albedos / sizeof albedos[0] ? albedos[index].name : NULL;
}

static const struct albedo *find_albedo(const char *name)
{
    for (size_t i = 0; i < sizeof albedos / sizeof albedos[0]; i++)
        if (strcmp(albedos[i].name, name) == 0)
            return &albedos[i];
    return NULL;
}

static lom_image *round_canvas(const lom_canvas *canvas, lom_error *error)
{
    lom_image *picture = lom_create_image(canvas->size, canvas->size, 1, LOM_FORMAT_RGB8_SRGB, error);
    size_t pixels = (size_t)canvas->size * (size_t)canvas->size;
    for (size_t i = 0; picture != NULL && i < pixels; i++)
        for (int k = 0; k < 3; k++)
            picture->pixels[3 * i + (size_t)k] = lom_unorm8_of_double(canvas->color[i][k]);
    return picture;
}

lom_image *lom_make_albedo(const lom_albedo_desc *desc, lom_error *error)
{
    if (desc == NULL || desc->name == NULL) {
        lom_fail(error, LOM_ERROR_USAGE, "A texture that is made has a name.");
        return NULL;
    }
    const struct albedo *albedo = find_albedo(desc->name);
    if (albedo == NULL) {
        lom_fail(error, LOM_ERROR_USAGE, "There is no texture named \"%s\".", desc->name);
        return NULL;
    }
    lom_canvas canvas = { .size = desc->size != 0 ? desc->size : albedo->size, .seed = desc->seed << 8 };
    if (canvas.size < 64 || canvas.size > 4096) {
        lom_fail(error, LOM_ERROR_USAGE, "A texture is made with a side of 64 to 4096, not %d.", canvas.size);
        return NULL;
    }
    lom_seed_noise(&canvas.noise, desc->seed);
    size_t pixels = (size_t)canvas.size * (size_t)canvas.size;
    canvas.color = lom_allocate(pixels, sizeof *canvas.color, error);
    canvas.height = lom_allocate(pixels, sizeof *canvas.height, error);
    lom_image *picture = NULL;
    lom_float_state state;
    lom_enter_float_state(&state);
    if (canvas.color != NULL && canvas.height != NULL) {
        albedo->paint(&canvas);
        picture = round_canvas(&canvas, error);
    }
    lom_leave_float_state(&state);
    lom_release(canvas.color);
    lom_release(canvas.height);
    return picture;
}
