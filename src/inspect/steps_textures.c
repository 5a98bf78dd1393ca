/* Pictures of textures. In: which texels of which levels were read. Out: for each texture a picture of those levels, one
 * beside the other; what was read is bright. Invariant: texels are shown as they are stored. */
#include "inspect/eyes.h"
#include "inspect/steps.h"

#include "base/numbers.h"
#include "image/texture.h"

#include <stdio.h>

enum { MOST_TEXTURES = 32, MOST_SHOWN = 16 };
static const struct ink ground = { { 0.055f, 0.065f, 0.085f }, 1 };
static const struct ink read_ink = { { 1, 0.85f, 0.3f }, 1 };
static const struct ink unread_ink = { { 0.3f, 0.31f, 0.34f }, 1 };

/* The levels of a texture that were read, larger ones first. */
static int list_levels(const struct steps *s, const lom_texture *texture, const struct read_level *list[MOST_SHOWN],
                       uint64_t *reads)
{
    int count = 0;
    *reads = 0;
    for (size_t i = 0; i < s->level_count; i++) {
        const struct read_level *l = &s->levels[i];
        if (l->texture != texture)
            continue;
        *reads += l->reads;
        int at = count < MOST_SHOWN ? count++ : MOST_SHOWN - 1;
        if (count == MOST_SHOWN && at == MOST_SHOWN - 1 && list[at] != NULL &&
            (list[at]->level < l->level || (list[at]->level == l->level && list[at]->layer < l->layer)))
            continue;
        for (; at > 0 &&
               (list[at - 1]->level > l->level || (list[at - 1]->level == l->level && list[at - 1]->layer > l->layer));
             at--)
            list[at] = list[at - 1];
        list[at] = l;
    }
    return count;
}

/* Floats that are no colours: halved around gray where some are negative, else as parts of the largest. */
static void stretch(lom_image *image)
{
    float *value = (float *)(void *)image->pixels, low = 0, high = 0;
    size_t count = lom_image_size(image) / sizeof *value;
    for (size_t i = 0; i < count; i++) {
        low = value[i] < low ? value[i] : low;
        high = value[i] > high ? value[i] : high;
    }
    float most = -low > high ? -low : high;
    for (size_t i = 0; i < count && (low < 0 || high > 1); i++)
        value[i] = low < 0 ? 0.5f + value[i] / most * 0.5f : value[i] / most;
}

/* The picture of a level for eyes. */
static lom_image *read_level(const struct steps *s, const struct read_level *l)
{
    lom_image *image = lom_read_texture(l->texture, l->level, l->layer, s->error), *floats = NULL, *shown = NULL;
    const lom_format_info *format = image != NULL ? lom_describe_format(image->format) : NULL;
    if (format != NULL && format->is_depth) {
        floats = lom_depth_to_eyes(lom_convert_image(image, LOM_FORMAT_R32F, s->error), s->error);
    } else if (format != NULL && format->is_float) {
        floats = lom_convert_image(image, LOM_FORMAT_RGB32F, s->error);
        if (floats != NULL)
            stretch(floats);
    }
    if (floats != NULL)
        shown = lom_convert_image(floats, LOM_FORMAT_RGB8, s->error);
    else if (format != NULL && !format->is_depth && !format->is_float)
        shown = lom_convert_image(image, format->is_srgb ? LOM_FORMAT_RGB8_SRGB : LOM_FORMAT_RGB8, s->error);
    lom_free_image(image);
    lom_free_image(floats);
    return shown;
}

/* Whether a texel of a rectangle was read. */
static bool is_read(const struct read_level *l, int x0, int y0, int x1, int y1)
{
    for (int y = y0; y <= y1; y++)
        for (int x = x0; x <= x1; x++)
            if (l->times[(size_t)y * (size_t)l->width + (size_t)x] != 0)
                return true;
    return false;
}

/* A level in a cell: as large as fits, whole texels where they are more than a pixel. */
static void draw_level(struct canvas *canvas, const struct read_level *l, const lom_image *image, int x, int y,
                       int width, int height)
{
    double scale = lom_smaller((width - 8.0) / l->width, (height - 8.0) / l->height);
    scale = scale >= 1 ? lom_double_floor(scale) : scale;
    int across = lom_larger_int(1, lom_int_of(l->width * scale)),
        down = lom_larger_int(1, lom_int_of(l->height * scale));
    x += (width - across) / 2;
    y += (height - down) / 2;
    for (int j = 0; j < down; j++)
        for (int i = 0; i < across; i++) {
            int x0 = lom_int_of(i / scale), y0 = lom_int_of(j / scale);
            int x1 = lom_larger_int(x0, lom_smaller_int(lom_int_of((i + 1) / scale - 0.5), l->width - 1)),
                y1 = lom_larger_int(y0, lom_smaller_int(lom_int_of((j + 1) / scale - 0.5), l->height - 1));
            bool read = is_read(l, x0, y0, x1, y1);
            const uint8_t *from = lom_image_pixel(image, (x0 + x1) / 2, (y0 + y1) / 2, 0);
            struct ink ink = { .cover = 1 };
            for (int c = 0; c < 3; c++)
                ink.color[c] = (float)from[c] / 255 * (read ? 1 : 0.28f) + (read ? 0 : 0.05f);
            lom_fill_box(canvas, x + i, y + j, 1, 1, ink);
        }
    lom_draw_box(canvas, x - 1, y - 1, across + 2, down + 2, (struct ink){ { 0.45f, 0.5f, 0.58f }, 0.8f });
}

static uint64_t count_read(const struct read_level *l)
{
    uint64_t count = 0;
    for (size_t i = 0; i < (size_t)l->width * (size_t)l->height; i++)
        count += l->times[i] != 0;
    return count;
}

static void write_levels(const struct read_level *const list[], int count, char text[300])
{
    for (int i = 0; i < count; i++) {
        size_t length = strlen(text);
        const struct read_level *l = list[i];
        bool layered = l->texture->kind != LOM_TEXTURE_2D;
        snprintf(text + length, 300 - length, "%slevel %d%s%.0d: %d x %d, %.3g %%", i > 0 ? "; " : "", l->level,
                 layered ? (l->texture->kind == LOM_TEXTURE_CUBE ? " face " : " slice ") : "", layered ? l->layer : 0,
                 l->width, l->height, 100.0 * (double)count_read(l) / l->width / l->height);
    }
}

static void add_texture(struct steps *s, const lom_texture *texture)
{
    const struct read_level *list[MOST_SHOWN] = { NULL };
    uint64_t reads;
    int count = list_levels(s, texture, list, &reads), columns = 1;
    while (columns * columns < count)
        columns++;
    int rows = (count + columns - 1) / columns, width = s->width * s->zoom, height = s->height * s->zoom;
    struct canvas canvas;
    s->failed |= !lom_make_canvas(&canvas, width, height, ground, s->error);
    for (int i = 0; i < count && !s->failed; i++) {
        lom_image *image = read_level(s, list[i]);
        if (image != NULL)
            draw_level(&canvas, list[i], image, i % columns * (width / columns), i / columns * (height / rows),
                       width / columns, height / rows);
        s->failed |= image == NULL;
        lom_free_image(image);
    }
    char levels[300] = "", name[96], title[96];
    const char *label = lom_texture_label(texture) != NULL ? lom_texture_label(texture) : "texture";
    const char *slash = strrchr(label, '/');
    label = slash != NULL ? slash + 1 : label;
    write_levels(list, count, levels);
    snprintf(name, sizeof name, "texture-%s", label);
    snprintf(title, sizeof title, "Texels of %s", label);
    if (!s->failed) {
        lom_stage_picture *p = lom_add_picture(
            s, "Textures", name, title, "src/image/sample_2d.wide.c", lom_canvas_image(&canvas, s->error),
            "The levels that this pass reads: %s of the texels. %llu reads in all.", levels, (unsigned long long)reads);
        lom_add_legend(p, &read_ink, "texels in their colours: read");
        lom_add_legend(p, &unread_ink, "dark: read by no pixel");
    }
    lom_clear_canvas(&canvas);
}

void lom_picture_textures(struct steps *s)
{
    int count = 0;
    for (size_t i = 0; i < s->level_count && !s->failed && count < MOST_TEXTURES; i++) {
        bool is_first = true;
        for (size_t k = 0; k < i; k++)
            is_first &= s->levels[k].texture != s->levels[i].texture;
        if (!is_first || !lom_is_alive(s, s->levels[i].texture))
            continue;
        add_texture(s, s->levels[i].texture);
        count++;
    }
}
