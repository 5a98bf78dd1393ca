/* A canvas. In: lines, dots, boxes, numbers, in pixels. Out: a picture. Invariant: what is drawn covers by its share of a
 * pixel along the line's minor axis (Wu 1991, "An efficient antialiasing technique"); nothing outside is touched. */
#include "inspect/canvas.h"

#include "base/numbers.h"

bool lom_make_canvas(struct canvas *canvas, int width, int height, struct ink ground, lom_error *error)
{
    size_t pixels = (size_t)width * (size_t)height;
    *canvas = (struct canvas){ width, height, lom_allocate(pixels, 3 * sizeof(float), error) };
    for (size_t i = 0; canvas->color != NULL && i < 3 * pixels; i++)
        canvas->color[i] = ground.color[i % 3];
    return canvas->color != NULL;
}

void lom_clear_canvas(struct canvas *canvas)
{
    lom_release(canvas->color);
    *canvas = (struct canvas){ .width = 0 };
}

lom_image *lom_canvas_image(const struct canvas *canvas, lom_error *error)
{
    lom_image *image = lom_create_image(canvas->width, canvas->height, 1, LOM_FORMAT_RGB8_SRGB, error);
    for (size_t i = 0; image != NULL && i < lom_image_size(image); i++) {
        double value = lom_larger(0, lom_smaller((double)canvas->color[i], 1));
        image->pixels[i] = (uint8_t)lom_int_of(value * 255 + 0.5);
    }
    return image;
}

static void mix(struct canvas *canvas, int x, int y, const struct ink *ink, float share)
{
    if (x < 0 || y < 0 || x >= canvas->width || y >= canvas->height)
        return;
    float *to = canvas->color + 3 * ((size_t)y * (size_t)canvas->width + (size_t)x);
    for (int c = 0; c < 3; c++)
        to[c] += (ink->color[c] - to[c]) * (ink->cover * share);
}

/* What lies within [0, most] of an axis of the line from a to b (Liang and Barsky 1984). */
static bool cut(double from, double to, double most, double *first, double *last)
{
    double way = to - from;
    if (way == 0)
        return from >= 0 && from <= most;
    double s = -from / way, t = (most - from) / way;
    *first = lom_larger(*first, lom_smaller(s, t));
    *last = lom_smaller(*last, lom_larger(s, t));
    return *first < *last;
}

void lom_draw_line(struct canvas *canvas, const double a[2], const double b[2], struct ink ink)
{
    double first = 0, last = 1;
    if (!(lom_magnitude(a[0]) < 1e9 && lom_magnitude(a[1]) < 1e9 && lom_magnitude(b[0]) < 1e9 &&
          lom_magnitude(b[1]) < 1e9))
        return;
    if (!cut(a[0], b[0], canvas->width, &first, &last) || !cut(a[1], b[1], canvas->height, &first, &last))
        return;
    const double way[2] = { b[0] - a[0], b[1] - a[1] };
    int along = lom_magnitude(way[0]) >= lom_magnitude(way[1]) ? 0 : 1, across = 1 - along;
    double slope = way[along] != 0 ? way[across] / way[along] : 0;
    double from = a[along] + way[along] * first, to = a[along] + way[along] * last;
    int low = lom_int_of(lom_double_floor(lom_smaller(from, to)));
    int high = lom_int_of(lom_double_floor(lom_larger(from, to)));
    for (int i = low; i <= high; i++) {
        double place = a[across] + (i + 0.5 - a[along]) * slope - 0.5, whole = lom_double_floor(place);
        float share = (float)(place - whole);
        int k = lom_int_of(whole);
        mix(canvas, along == 0 ? i : k, along == 0 ? k : i, &ink, 1 - share);
        mix(canvas, along == 0 ? i : k + 1, along == 0 ? k + 1 : i, &ink, share);
    }
}

void lom_draw_dot(struct canvas *canvas, const double at[2], double radius, struct ink ink)
{
    if (!(at[0] > -radius && at[1] > -radius && at[0] < canvas->width + radius && at[1] < canvas->height + radius))
        return;
    int reach = lom_int_of(radius) + 1, x = lom_int_of(at[0]), y = lom_int_of(at[1]);
    for (int j = y - reach; j <= y + reach; j++)
        for (int i = x - reach; i <= x + reach; i++) {
            double dx = i + 0.5 - at[0], dy = j + 0.5 - at[1];
            double inside = radius + 0.5 - lom_double_sqrt(dx * dx + dy * dy);
            if (inside > 0)
                mix(canvas, i, j, &ink, (float)lom_smaller(inside, 1));
        }
}

void lom_fill_box(struct canvas *canvas, int x, int y, int width, int height, struct ink ink)
{
    for (int j = y; j < y + height; j++)
        for (int i = x; i < x + width; i++)
            mix(canvas, i, j, &ink, 1);
}

void lom_draw_box(struct canvas *canvas, double x, double y, double width, double height, struct ink ink)
{
    const double corner[4][2] = { { x, y }, { x + width, y }, { x + width, y + height }, { x, y + height } };
    for (int i = 0; i < 4; i++)
        lom_draw_line(canvas, corner[i], corner[(i + 1) % 4], ink);
}

void lom_draw_number(struct canvas *canvas, int x, int y, int size, uint64_t number, struct ink ink)
{
    static const uint16_t dots[10] = { 075557, 026227, 071747, 071717, 055711, 074717, 074757, 071111, 075757, 075717 };
    int count = 1, digits[20];
    digits[0] = (int)(number % 10);
    for (number /= 10; number != 0; number /= 10)
        digits[count++] = (int)(number % 10);
    int left = x - (4 * count - 1) * size / 2, top = y - 5 * size / 2;
    for (int i = 0; i < 15 * count; i++) {
        int digit = digits[count - 1 - i / 15], dot = i % 15;
        if (dots[digit] >> (14 - dot) & 1)
            lom_fill_box(canvas, left + (4 * (i / 15) + dot % 3) * size, top + dot / 3 * size, size, size, ink);
    }
}

/* ---- colours of numbers ---- */

/* As even in lightness as in hue, seen by all (after Smith and van der Walt's viridis, 2015). */
const uint8_t lom_ramp[LOM_RAMP_COLORS][3] = { { 68, 1, 84 },    { 71, 44, 122 },  { 59, 81, 139 },
                                               { 44, 113, 142 }, { 33, 144, 141 }, { 39, 173, 129 },
                                               { 92, 200, 99 },  { 170, 220, 50 }, { 253, 231, 37 } };
const uint8_t lom_signed_ramp[LOM_RAMP_COLORS][3] = { { 170, 225, 255 }, { 86, 178, 240 }, { 42, 118, 196 },
                                                      { 30, 62, 112 },   { 24, 26, 34 },   { 112, 58, 24 },
                                                      { 198, 104, 30 },  { 245, 160, 70 }, { 255, 222, 160 } };

void lom_ramp_color(const uint8_t ramp[LOM_RAMP_COLORS][3], double share, uint8_t color[3])
{
    double at = lom_larger(0, lom_smaller(share, 1)) * (LOM_RAMP_COLORS - 1);
    int i = lom_smaller_int(lom_int_of(at), LOM_RAMP_COLORS - 2);
    for (int c = 0; c < 3; c++)
        color[c] = (uint8_t)lom_int_of(ramp[i][c] + (at - i) * (ramp[i + 1][c] - ramp[i][c]) + 0.5);
}

struct ink lom_ink_of(uint64_t number, float cover)
{
    uint64_t hash = lom_random_bits(LOM_HASH_START, number);
    struct ink ink = { .cover = cover };
    int dark = (int)(hash >> 40) % 3;
    for (int c = 0; c < 3; c++)
        ink.color[c] = (c == dark ? 0.24f : 0.36f) + (float)(hash >> (8 + 9 * c) & 127) / 380.0f;
    return ink;
}

lom_image *lom_magnify(lom_image *image, int times, lom_error *error)
{
    if (image == NULL || times == 1)
        return image;
    lom_image *large = lom_create_image(image->width * times, image->height * times, 1, image->format, error);
    size_t size = lom_format_size(image->format);
    for (int y = 0; large != NULL && y < large->height; y++)
        for (int x = 0; x < large->width; x++)
            memcpy(lom_image_pixel(large, x, y, 0), lom_image_pixel(image, x / times, y / times, 0), size);
    lom_free_image(image);
    return large;
}
