/* The tiles of a pass. In: the lengths of their lists, as they are told. Out: a grid with colours and numbers. Invariant:
 * the grid is the frame's, wherever the attachment lies in it. */
#include "inspect/steps_tiles.h"

#include "base/numbers.h"
#include "base/reserve.h"

static const struct ink white = { { 1, 1, 1 }, 0.95f };
static const struct ink shadow = { { 0, 0, 0 }, 0.7f };

void lom_count_bin(const struct steps *s, struct tiles *tiles, const lom_rect *tile, size_t triangles)
{
    const lom_pass_desc *pass = &s->chosen.desc;
    if (tiles->edge == 0) {
        tiles->edge = tile->width;
        tiles->columns = (s->width + tile->width - 1) / tile->width + 1; /* one more: the attachment may begin within */
        tiles->rows = (s->height + tile->width - 1) / tile->width + 1;
        lom_renew(&tiles->count, &tiles->capacity, (size_t)tiles->columns * (size_t)tiles->rows, sizeof *tiles->count,
                  s->error);
    }
    int x = tile->x / tiles->edge - pass->origin_x / tiles->edge;
    int y = tile->y / tiles->edge - pass->origin_y / tiles->edge;
    if (tiles->count != NULL && x >= 0 && y >= 0 && x < tiles->columns && y < tiles->rows)
        tiles->count[y * tiles->columns + x] += triangles;
}

/* Of the tile's part that lies in the attachment: left, top, right, bottom in pixels of it. */
static void draw_tile(struct canvas *canvas, const int side[4], int zoom, uint64_t count, double share, int size)
{
    uint8_t color[3];
    int width = (side[2] - side[0]) * zoom, height = (side[3] - side[1]) * zoom;
    int middle[2] = { (side[0] + side[2]) * zoom / 2, (side[1] + side[3]) * zoom / 2 };
    struct ink ink = { .cover = count > 0 ? 0.55f : 0 };
    lom_ramp_color(lom_ramp, share, color);
    for (int c = 0; c < 3; c++)
        ink.color[c] = (float)color[c] / 255;
    lom_fill_box(canvas, side[0] * zoom, side[1] * zoom, width, height, ink);
    lom_draw_box(canvas, side[0] * zoom, side[1] * zoom, width, height, white);
    if (width <= 14 * size || height <= 6 * size)
        return;
    lom_draw_number(canvas, middle[0] + 1, middle[1] + 1, size, count, shadow);
    lom_draw_number(canvas, middle[0], middle[1], size, count, white);
}

void lom_draw_tiles(const struct steps *s, const struct tiles *tiles, struct canvas *canvas)
{
    const lom_pass_desc *pass = &s->chosen.desc;
    uint64_t most = 1;
    for (int i = 0; tiles->count != NULL && i < tiles->columns * tiles->rows; i++)
        most = tiles->count[i] > most ? tiles->count[i] : most;
    for (int i = 0; tiles->count != NULL && i < tiles->columns * tiles->rows; i++) {
        int x = i % tiles->columns * tiles->edge - pass->origin_x % tiles->edge;
        int y = i / tiles->columns * tiles->edge - pass->origin_y % tiles->edge;
        const int side[4] = { lom_larger_int(x, 0), lom_larger_int(y, 0), lom_smaller_int(x + tiles->edge, s->width),
                              lom_smaller_int(y + tiles->edge, s->height) };
        double share = lom_double_log(1 + (double)tiles->count[i]) / lom_double_log(1 + (double)most);
        if (side[0] < side[2] && side[1] < side[3])
            draw_tile(canvas, side, s->zoom, tiles->count[i], share, lom_larger_int(1, tiles->edge * s->zoom / 30));
    }
}
