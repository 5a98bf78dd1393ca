/* An overlay for eyes. In: numbers, the picture that they are of. Out: colours; where there is no number, or where the kind
 * shows lines and marks over the picture, the picture in a dark gray. */
#include "inspect/overlay.h"

#include "image/color_map.h"

#include <string.h>

const uint8_t lom_line_color[3] = { 255, 236, 160 };

struct overlay_scale lom_overlay_scale(double low, double high, bool is_logarithmic)
{
    struct overlay_scale s = { .low = low, .high = high, .is_logarithmic = is_logarithmic };
    s.from = is_logarithmic ? lom_double_log(low) : low;
    s.length = (is_logarithmic ? lom_double_log(high) : high) - s.from;
    return s;
}

double lom_overlay_part(const struct overlay_scale *s, double value)
{
    double along = !s->is_logarithmic ? value : value > 0 ? lom_double_log(value) : s->from;
    double part = (along - s->from) / s->length;
    return part > 0 ? part < 1 ? part : 1 : 0;
}

bool lom_has_number(const struct overlay_scale *s, float value)
{
    return value == value && !(s->is_logarithmic && value == 0);
}

void lom_vertex_color(int made, uint8_t rgb[3])
{
    uint8_t map[256][3];
    lom_make_color_map(map);
    memcpy(rgb, map[made * 85], 3);
}

struct painter {
    const struct overlay_row *row;
    const struct overlay_scale *scale;
    uint8_t map[256][3];
};

/* Rec. 709 weights on the encoded values, which a gray for the background needs no better; less than half as bright. */
static void paint_gray(const uint8_t *picture, uint8_t *rgb)
{
    int gray = (picture[0] * 54 + picture[1] * 183 + picture[2] * 19) >> 8;
    rgb[0] = rgb[1] = rgb[2] = (uint8_t)(16 + gray * 3 / 8);
}

static void paint_scale(const struct painter *p, const float *value, uint8_t *rgb)
{
    double part = lom_overlay_part(p->scale, (double)value[0]);
    memcpy(rgb, p->map[lom_int_of(part * 255 + 0.5)], 3);
}

/* A line is two pixels wide, and fades over its outer half. */
static void paint_lines(const struct painter *p, const float *value, uint8_t *rgb)
{
    (void)p;
    float part = value[0] < 1 ? 1 - (value[0] > 0 ? value[0] : 0) : 0;
    for (int c = 0; c < 3; c++)
        rgb[c] = (uint8_t)lom_int_of((float)rgb[c] + part * ((float)lom_line_color[c] - (float)rgb[c]) + 0.5f);
}

static void paint_vectors(const struct painter *p, const float *value, uint8_t *rgb)
{
    (void)p;
    for (int c = 0; c < 3; c++) {
        float x = value[c] < -1 ? -1 : value[c] > 1 ? 1 : value[c];
        rgb[c] = (uint8_t)lom_int_of((x * 0.5f + 0.5f) * 255 + 0.5f);
    }
}

static void paint_marks(const struct painter *p, const float *value, uint8_t *rgb)
{
    (void)p;
    if (value[0] != 0)
        memcpy(rgb, lom_mark_color, 3);
}

static void paint_vertices(const struct painter *p, const float *value, uint8_t *rgb)
{
    if (value[0] > 3)
        memcpy(rgb, lom_mark_color, 3);
    else if (value[0] > 0)
        memcpy(rgb, p->map[lom_int_of(value[0]) * 85], 3);
}

typedef void paint(const struct painter *p, const float *value, uint8_t *rgb);
static paint *const looks[OVERLAY_LOOKS] = {
    [OVERLAY_SCALE] = paint_scale, [OVERLAY_LINES] = paint_lines,       [OVERLAY_VECTORS] = paint_vectors,
    [OVERLAY_MARKS] = paint_marks, [OVERLAY_VERTICES] = paint_vertices,
};

lom_image *lom_show_overlay(const struct overlay_row *row, const struct overlay_scale *scale, lom_legend legend,
                            const lom_image *numbers, const lom_image *picture, lom_error *error)
{
    struct painter p = { .row = row, .scale = scale };
    int strip = legend == LOM_LEGEND_BELOW ? lom_legend_height(row, scale, numbers) : 0;
    lom_image *shown = lom_create_image(numbers->width, numbers->height + strip, 1, LOM_FORMAT_RGB8, error);
    lom_make_color_map(p.map);
    for (int y = 0; shown != NULL && y < numbers->height; y++)
        for (int x = 0; x < numbers->width; x++) {
            const float *value = lom_image_pixel(numbers, x, y, 0);
            uint8_t *rgb = lom_image_pixel(shown, x, y, 0);
            paint_gray(lom_image_pixel(picture, x, y, 0), rgb);
            if (lom_has_number(scale, value[0]))
                looks[row->look](&p, value, rgb);
        }
    if (shown != NULL && legend != LOM_LEGEND_NONE)
        lom_draw_legend(row, scale, numbers, shown);
    return shown;
}
