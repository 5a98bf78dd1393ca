/* The legend of an overlay. In: what is shown, its scale, its numbers. Out: text, a bar with ticks or squares with words,
 * and the least, mean and greatest number, in the lowest rows of a picture. Lengths are in pixels of the letters. */
#include "inspect/overlay.h"
#include "inspect/short_number.h"

#include "image/color_map.h"
#include "image/glyphs.h"

#include <stdio.h>
#include <string.h>

enum { MARGIN = 4, BAR = 7, TICK = 3, SQUARE = 7, WIDE = 1280, LONGEST_TEXT = 400 };

static const uint8_t ink[3] = { 240, 240, 240 }, edge[3] = { 0, 0, 0 };

/* What a look that has no scale is explained by: a colour and a word. */
struct square {
    uint8_t rgb[3];
    const char *text;
};
enum { SQUARES = 4 };

/* Where the pen is. */
struct page {
    struct lom_pixel_rows rows;
    int scale, left, right, y; /* pixels of the picture */
};

/* ---- words ---- */

/* Lines of at most so many letters, broken at spaces; how many they are. */
static int wrap(char *text, int letters)
{
    int lines = 1, used = 0;
    char *space = NULL;
    for (char *c = text; *c != '\0'; c++) {
        if (*c == ' ')
            space = c;
        if (++used <= letters || space == NULL)
            continue;
        *space = '\n';
        used = (int)(c - space);
        space = NULL;
        lines++;
    }
    return lines;
}

static int scale_of(int width)
{
    return width >= WIDE ? 2 : 1;
}

/* ---- numbers ---- */

struct summary {
    double least, mean, greatest;
    size_t count;
    bool is_gray; /* some show none */
};

static struct summary summarize(const struct overlay_scale *scale, const lom_image *numbers)
{
    struct summary s = { .count = 0 };
    const float *value = (const float *)(const void *)numbers->pixels;
    for (size_t i = 0; i < (size_t)numbers->width * (size_t)numbers->height; i++) {
        double x = (double)value[i];
        s.is_gray |= !lom_has_number(scale, value[i]);
        if (x != x)
            continue;
        s.least = s.count == 0 || x < s.least ? x : s.least;
        s.greatest = s.count == 0 || x > s.greatest ? x : s.greatest;
        s.mean += x;
        s.count++;
    }
    s.mean /= s.count != 0 ? (double)s.count : 1;
    return s;
}

static void write_summary(const struct overlay_row *row, const struct overlay_scale *scale, const lom_image *numbers,
                          char text[LONGEST_TEXT])
{
    char least[LOM_SHORT_NUMBER], mean[LOM_SHORT_NUMBER], greatest[LOM_SHORT_NUMBER];
    text[0] = '\0';
    if (numbers->format != LOM_FORMAT_R32F || row->look == OVERLAY_LINES)
        return;
    struct summary s = summarize(scale, numbers);
    lom_print_short(least, s.least);
    lom_print_short(mean, s.mean);
    lom_print_short(greatest, s.greatest);
    if (s.count == 0)
        snprintf(text, LONGEST_TEXT, "here: nothing");
    else
        snprintf(text, LONGEST_TEXT, "here: %s to %s, mean %s%s", least, greatest, mean,
                 s.is_gray ? "; gray: nothing" : "");
}

/* What stands above and below the scale. */
struct words {
    char title[LONGEST_TEXT], summary[LONGEST_TEXT];
    int title_lines, summary_lines;
};

static void write_words(const struct overlay_row *row, const struct overlay_scale *scale, const lom_image *numbers,
                        struct words *words)
{
    int letters = (numbers->width / scale_of(numbers->width) - 2 * MARGIN) / LOM_GLYPH_STEP;
    snprintf(words->title, LONGEST_TEXT, "%s: %s", row->kind.name, row->kind.text);
    write_summary(row, scale, numbers, words->summary);
    words->title_lines = wrap(words->title, letters);
    words->summary_lines = words->summary[0] != '\0' ? wrap(words->summary, letters) : 0;
}

/* ---- drawing ---- */

static void fill(const struct page *p, int x, int y, int width, int height, const uint8_t rgb[3])
{
    for (int j = y < 0 ? 0 : y; j < y + height && j < p->rows.height; j++)
        for (int i = x < 0 ? 0 : x; i < x + width && i < p->rows.width; i++)
            memcpy(p->rows.pixels + (size_t)j * p->rows.pitch + (size_t)i * 3, rgb, 3);
}

static void darken(const struct page *p, int top)
{
    for (int y = top < 0 ? 0 : top; y < p->rows.height; y++)
        for (size_t i = 0; i < (size_t)p->rows.width * 3; i++) {
            uint8_t *byte = &p->rows.pixels[(size_t)y * p->rows.pitch + i];
            *byte = (uint8_t)(*byte / 5 + 14);
        }
}

static void write_line(struct page *p, const char *text, int lines)
{
    lom_draw_text(&p->rows, p->left, p->y, p->scale, text, ink, edge);
    p->y += lines * LOM_GLYPH_LINE * p->scale;
}

/* A tick with its number, unless it would touch the one before, which ends at *taken. */
static void draw_tick(const struct page *p, const struct overlay_scale *scale, double value, int *taken)
{
    char text[LOM_SHORT_NUMBER];
    lom_print_short(text, value);
    int width = lom_text_width(text, p->scale), length = p->right - p->left - 1;
    int x = p->left + lom_int_of(lom_overlay_part(scale, value) * length + 0.5), from = x - width / 2;
    from = from > p->right - width ? p->right - width : from < p->left ? p->left : from;
    fill(p, x, p->y, p->scale, TICK * p->scale, ink);
    if (from < *taken)
        return;
    lom_draw_text(&p->rows, from, p->y + (TICK + 1) * p->scale, p->scale, text, ink, edge);
    *taken = from + width + 2 * LOM_GLYPH_STEP * p->scale;
}

/* The distance of ticks, 1, 2 or 5 times a power of ten, of which at most `most` lie in a range. */
static double tick_step(double range, int most)
{
    double step = 1e-30;
    for (int i = 0; range > step * most; i++)
        step *= i % 3 == 1 ? 2.5 : 2;
    return step;
}

static void draw_ticks(const struct page *p, const struct overlay_scale *s)
{
    int taken = p->left;
    if (s->is_logarithmic) {
        double base = s->high / s->low >= 1000 ? 10 : 2, value = 1;
        while (value > s->low)
            value /= base;
        while (value < s->low * (1 - 1e-9))
            value *= base;
        for (; value <= s->high * (1 + 1e-9); value *= base)
            draw_tick(p, s, value, &taken);
        return;
    }
    double step = tick_step(s->high - s->low, 8), first = lom_double_floor(s->low / step);
    for (int i = 0; i <= 10; i++) {
        double value = (first + i) * step;
        if (value >= s->low - step * 1e-9 && value <= s->high + step * 1e-9)
            draw_tick(p, s, value, &taken);
    }
}

static void draw_bar(struct page *p, const struct overlay_scale *scale)
{
    uint8_t map[256][3];
    lom_make_color_map(map);
    int length = p->right - p->left;
    for (int x = 0; x < length; x++)
        fill(p, p->left + x, p->y, 1, BAR * p->scale, map[x * 255 / (length > 1 ? length - 1 : 1)]);
    p->y += BAR * p->scale;
    draw_ticks(p, scale);
    p->y += (TICK + 1 + LOM_GLYPH_LINE) * p->scale;
}

/* The squares of a look; text NULL behind the last. */
static void list_squares(enum overlay_look look, struct square squares[SQUARES + 1])
{
    static const struct square vectors[] = { { { 255, 128, 128 }, "x, east" },
                                             { { 128, 255, 128 }, "y, up" },
                                             { { 128, 128, 255 }, "z, south" } };
    static const char *const vertices[] = { "one", "two", "three" };
    memset(squares, 0, (SQUARES + 1) * sizeof *squares);
    if (look == OVERLAY_VECTORS)
        memcpy(squares, vectors, sizeof vectors);
    if (look == OVERLAY_LINES || look == OVERLAY_MARKS) {
        memcpy(squares[0].rgb, look == OVERLAY_LINES ? lom_line_color : lom_mark_color, 3);
        squares[0].text = look == OVERLAY_LINES ? "edges" : "one or more";
    }
    for (int i = 0; i < 3 && look == OVERLAY_VERTICES; i++) {
        lom_vertex_color(i + 1, squares[i].rgb);
        squares[i].text = vertices[i];
    }
    if (look == OVERLAY_VERTICES) {
        memcpy(squares[3].rgb, lom_mark_color, 3);
        squares[3].text = "a vertex that was made";
    }
}

static void draw_squares(struct page *p, enum overlay_look look)
{
    struct square squares[SQUARES + 1];
    int x = p->left;
    list_squares(look, squares);
    for (int i = 0; squares[i].text != NULL; i++) {
        fill(p, x, p->y, SQUARE * p->scale, SQUARE * p->scale, squares[i].rgb);
        x += (SQUARE + MARGIN) * p->scale;
        lom_draw_text(&p->rows, x, p->y, p->scale, squares[i].text, ink, edge);
        x += lom_text_width(squares[i].text, p->scale) + 2 * LOM_GLYPH_STEP * p->scale;
    }
    p->y += LOM_GLYPH_LINE * p->scale;
}

static int height_of(const struct overlay_row *row, const struct words *words, int width)
{
    int scale = row->look == OVERLAY_SCALE ? BAR + TICK + 1 + LOM_GLYPH_LINE : LOM_GLYPH_LINE;
    int lines = words->title_lines + words->summary_lines;
    return (2 * MARGIN + lines * LOM_GLYPH_LINE + scale) * scale_of(width);
}

int lom_legend_height(const struct overlay_row *row, const struct overlay_scale *scale, const lom_image *numbers)
{
    struct words words;
    write_words(row, scale, numbers, &words);
    return height_of(row, &words, numbers->width);
}

void lom_draw_legend(const struct overlay_row *row, const struct overlay_scale *scale, const lom_image *numbers,
                     lom_image *shown)
{
    struct words words;
    struct page p = {
        .rows = { shown->pixels, (size_t)shown->width * 3, shown->width, shown->height, 3 },
        .scale = scale_of(shown->width),
    };
    write_words(row, scale, numbers, &words);
    int height = height_of(row, &words, shown->width);
    p.left = MARGIN * p.scale;
    p.right = shown->width - MARGIN * p.scale;
    p.y = shown->height - height + MARGIN * p.scale;
    darken(&p, shown->height - height);
    write_line(&p, words.title, words.title_lines);
    if (row->look == OVERLAY_SCALE)
        draw_bar(&p, scale);
    else
        draw_squares(&p, row->look);
    write_line(&p, words.summary, words.summary_lines);
}
