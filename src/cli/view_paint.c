/* What a window shows. In: a picture, sentences, the menu. Out: pixels. Invariant: every pixel is written once by the
 * picture, and text can be read before any of them. */
#include "view_enlarge.h"
#include "view_menu.h"

#include "base/numbers.h"
#include "image/glyphs.h"

#include <lom/inspect.h>

#include <string.h>

enum {
    MARGIN = 4,  /* letters' pixels from the border */
    COLUMNS = 46 /* of the menu */
};

struct painting {
    const struct lom_view *view;
    struct lom_pixel_rows rows;
    int scale; /* pixels of a letter's pixel */
};

/* Red, green and blue as the host has them. */
static void order_bytes(const struct painting *p, uint32_t color, uint8_t bytes[4])
{
    int red = p->view->host.order == LOM_ORDER_BGRX ? 2 : 0;
    bytes[red] = (uint8_t)(color >> 16);
    bytes[1] = (uint8_t)(color >> 8);
    bytes[2 - red] = (uint8_t)color;
    bytes[3] = 255;
}

static void write_text(const struct painting *p, int x, int y, const char *text, uint32_t color)
{
    uint8_t ink[4], edge[4];
    order_bytes(p, color, ink);
    order_bytes(p, 0, edge);
    lom_draw_text(&p->rows, x, y, p->scale, text, ink, edge);
}

/* ---- the picture ---- */

/* The middle of the window that the picture takes. */
static lom_rect find_place(const struct lom_view_picture *picture, int width, int height)
{
    if (picture->fills)
        return (lom_rect){ 0, 0, width, height };
    int64_t wide = (int64_t)picture->width * height, high = (int64_t)picture->height * width;
    lom_rect place = { 0, 0, width, height };
    if (wide < high)
        place.width = lom_larger_int((int)(wide / picture->height), 1);
    else
        place.height = lom_larger_int((int)(high / picture->width), 1);
    place.x = (width - place.width) / 2;
    place.y = (height - place.height) / 2;
    return place;
}

/* The whole number of times by which a smaller picture is to be enlarged, when it can be; else 0. */
static int find_factor(const struct lom_view_picture *picture, int width, int height)
{
    for (int factor = 2; factor <= 4; factor += 2)
        if (picture->fills && picture->width <= LOM_MAX_ENLARGED && picture->width == (width + factor - 1) / factor &&
            picture->height == (height + factor - 1) / factor)
            return factor;
    return 0;
}

static void paint_row(const struct painting *p, const struct lom_view_picture *picture, lom_rect place, int y)
{
    uint32_t *to = (uint32_t *)(void *)(p->rows.pixels + (size_t)y * p->rows.pitch);
    if (y < place.y || y >= place.y + place.height) {
        memset(to, 0, (size_t)p->rows.width * 4);
        return;
    }
    size_t row = (size_t)((int64_t)(y - place.y) * picture->height / place.height);
    const uint32_t *from = (const uint32_t *)(const void *)picture->pixels + row * (size_t)picture->width;
    if (place.width == picture->width && place.width == p->rows.width) {
        memcpy(to, from, (size_t)place.width * 4);
        return;
    }
    memset(to, 0, (size_t)p->rows.width * 4);
    for (int x = 0; x < place.width; x++)
        to[place.x + x] = from[(int64_t)x * picture->width / place.width];
}

static void paint_picture(const struct painting *p)
{
    const struct lom_view_picture *picture = &p->view->shown;
    if (picture->pixels == NULL) {
        for (int y = 0; y < p->rows.height; y++)
            memset(p->rows.pixels + (size_t)y * p->rows.pitch, 0, (size_t)p->rows.width * 4);
        return;
    }
    lom_rect place = find_place(picture, p->rows.width, p->rows.height);
    const int factor = find_factor(picture, p->rows.width, p->rows.height);
    for (int y = 0; y < p->rows.height; y++)
        if (factor != 0)
            lom_enlarge_row((const uint32_t *)(const void *)picture->pixels, picture->width, picture->height, factor, y,
                            p->rows.width, (uint32_t *)(void *)(p->rows.pixels + (size_t)y * p->rows.pitch));
        else
            paint_row(p, picture, place, y);
}

/* Darkens what text will stand on. */
static void shade(const struct painting *p, lom_rect place)
{
    int right = lom_smaller_int(place.x + place.width, p->rows.width);
    int bottom = lom_smaller_int(place.y + place.height, p->rows.height);
    for (int y = lom_larger_int(place.y, 0); y < bottom; y++) {
        uint8_t *row = p->rows.pixels + (size_t)y * p->rows.pitch;
        for (int x = 4 * lom_larger_int(place.x, 0); x < 4 * right; x++)
            row[x] = (uint8_t)((x & 3) == 3 ? 255 : row[x] / 3);
    }
}

/* ---- sentences ---- */

/* Breaks lines at spaces so that none has more than `columns` letters; the number of lines. */
static int wrap(char *text, int columns)
{
    int lines = 1;
    char *start = text, *space = NULL;
    for (char *at = text; *at != '\0'; at++) {
        if (*at == ' ')
            space = at;
        if (*at == '\n') {
            start = at + 1;
            space = NULL;
            lines++;
        } else if (at - start >= columns && space != NULL) {
            *space = '\n';
            start = space + 1;
            space = NULL;
            lines++;
        }
    }
    return lines;
}

/* A box of text with its top at y; the y behind it. */
static int paint_box(const struct painting *p, int x, int y, int columns, const char *sentence, uint32_t color)
{
    char text[1400];
    if (sentence[0] == '\0')
        return y;
    snprintf(text, sizeof text, "%s", sentence);
    int lines = wrap(text, lom_larger_int(columns, 8)), margin = MARGIN * p->scale;
    lom_rect place = { x, y, lom_text_width(text, p->scale) + 2 * margin, lines * LOM_GLYPH_LINE * p->scale + margin };
    shade(p, place);
    write_text(p, x + margin, y + margin, text, color);
    return y + place.height;
}

static int columns_of(const struct painting *p, int width)
{
    return (width - 2 * MARGIN * p->scale) / (LOM_GLYPH_STEP * p->scale);
}

static void paint_cross(const struct painting *p)
{
    const struct lom_view *view = p->view;
    if (view->explained_x < 0)
        return;
    int half = 2 * p->scale; /* '+' is five pixels wide, and its middle two below the top */
    write_text(p, view->explained_x - half, view->explained_y - half - p->scale, "+", 0xffff60);
}

/* At the bottom, or beside what is at the top, since an overlay's legend is at the bottom. To the right of it, where there is
 * room, how one learns more. */
static void paint_status(const struct painting *p, int x)
{
    static const char *const kinds[] = { "scene's camera", "free", "third person", "first person" };
    static const char *const keys_hint = "f1: keys";
    const struct lom_view *view = p->view;
    const char *name = view->eye.followed != 0 ? view->scene->entities[view->eye.followed - 1].name : NULL;
    char text[400];
    size_t used =
        (size_t)snprintf(text, sizeof text, "%s%s%s  %.2f s%s  %.1f m/s  %.1f ms", kinds[view->eye.kind],
                         name != NULL ? ": " : "", name != NULL ? name : "", view->time, view->runs ? " runs" : "",
                         view->pilot.flies ? view->pilot.speed : view->speed, view->took);
    if (view->rate > 0)
        used += (size_t)snprintf(text + used, sizeof text - used, "  %.0f/s", view->rate);
    if (view->divisor > 1)
        used += (size_t)snprintf(text + used, sizeof text - used, "  1/%d", view->divisor);
    snprintf(text + used, sizeof text - used, "%s%s%s%s%s", view->is_free ? "  free" : "",
             view->adapts ? "" : "  whole", view->load != NULL ? "  reading ..." : "",
             view->recording.runs ? "  recording" : "", view->saves ? "  writing ..." : "");
    int height = LOM_GLYPH_LINE * p->scale, margin = MARGIN * p->scale;
    bool is_above = view->overlay >= 0;
    int left = (is_above ? x : 0) + margin, y = is_above ? p->scale : view->height - height - p->scale;
    write_text(p, left, y, text, 0xffffff);
    int hint = view->width - margin - lom_text_width(keys_hint, p->scale);
    if (left + lom_text_width(text, p->scale) + 2 * margin <= hint)
        write_text(p, hint, y, keys_hint, 0xffffff);
}

/* Which pass is shown; an overlay says it itself. */
static void paint_pass(const struct painting *p, int y)
{
    if (p->view->pass < 0)
        return;
    const lom_shown_pass *pass = lom_describe_shown_pass((size_t)p->view->pass);
    char text[400];
    snprintf(text, sizeof text, "%s: %s", pass->name, pass->text);
    paint_box(p, 0, y, columns_of(p, p->rows.width), text, 0x80e0ff);
}

static void paint_keys(const struct painting *p)
{
    enum { LINE = 96 };
    const char *keys, *text;
    char all[40 * LINE] = "";
    size_t used = 0;
    int lines = 0;
    for (size_t i = 0; lom_describe_view_key(i, &keys, &text) && used + LINE < sizeof all; i++, lines++)
        used += (size_t)snprintf(all + used, LINE, "%s%-13s%s", i > 0 ? "\n" : "", keys, text);
    struct painting smaller = *p;
    while (smaller.scale > 1 && lines * LOM_GLYPH_LINE * smaller.scale > p->rows.height)
        smaller.scale--;
    int margin = MARGIN * smaller.scale;
    shade(p, (lom_rect){ 0, 0, lom_text_width(all, smaller.scale) + 2 * margin,
                         lines * LOM_GLYPH_LINE * smaller.scale + 2 * margin });
    write_text(&smaller, margin, margin, all, 0xffffff);
}

/* ---- the menu ---- */

static size_t find_chosen(const struct lom_view *view)
{
    char text[LOM_MENU_ROW];
    bool is_chosen = false;
    size_t n = 0;
    while (lom_menu_row(view, n, text, &is_chosen) && !is_chosen)
        n++;
    return n;
}

static void paint_menu(const struct painting *p)
{
    const struct lom_view *view = p->view;
    char text[LOM_MENU_ROW];
    bool is_chosen;
    const int line = LOM_GLYPH_LINE * p->scale, margin = MARGIN * p->scale;
    const int width = COLUMNS * LOM_GLYPH_STEP * p->scale + 2 * margin;
    const int rows = lom_larger_int((p->rows.height - 8 * line) / line, 1); /* the rest is for its help */
    size_t chosen = find_chosen(view), first = chosen > (size_t)rows / 2 ? chosen - (size_t)rows / 2 : 0;
    int shown = 0;
    shade(p, (lom_rect){ 0, 0, width, rows * line + 2 * margin });
    for (; shown < rows && lom_menu_row(view, first + (size_t)shown, text, &is_chosen); shown++) {
        if (lom_text_width(text, p->scale) > width - 2 * margin)
            text[COLUMNS] = '\0';
        write_text(p, margin, margin + shown * line, text, is_chosen ? 0xffe060 : 0xffffff);
    }
    paint_box(p, 0, rows * line + 2 * margin, COLUMNS, lom_menu_help(view->menu), 0xc0c0c0);
}

void lom_paint_view(struct lom_view *view, uint8_t *pixels, size_t pitch)
{
    struct painting p = { view,
                          { pixels, pitch, view->width, view->height, 4 },
                          lom_smaller_int(lom_larger_int(view->height / 360, 1), 4) };
    paint_picture(&p);
    paint_cross(&p);
    if (view->menu->is_open)
        paint_menu(&p);
    int x = view->menu->is_open ? COLUMNS * LOM_GLYPH_STEP * p.scale + 3 * MARGIN * p.scale : 0;
    if (view->shows_status)
        paint_status(&p, x);
    if (view->shows_keys) {
        paint_keys(&p);
    } else {
        int y = view->overlay >= 0 && view->shows_status ? LOM_GLYPH_LINE * p.scale + p.scale : 0;
        y = paint_box(&p, x, y, columns_of(&p, view->width - x), view->message, view->is_error ? 0xff8070 : 0xffffff);
        if (!view->menu->is_open)
            paint_pass(&p, y);
    }
    view->is_unpainted = false;
}
