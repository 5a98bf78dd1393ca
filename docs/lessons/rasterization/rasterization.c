/* Lesson 4. Which pixels are a triangle's: rasterization OUT.png
 * In: two triangles that share an edge, on a grid of 20 x 11 pixels. Out: a picture of that grid, 16 times as large: each
 * pixel in the colour of the triangle that has it, its centre as a dot, the edges as lines; white is what both drew.
 * Positions are whole numbers, 256 a pixel, so edge functions are exact. */
#include <lom/image.h>

#include <stdio.h>
#include <stdlib.h>

enum { COLUMNS = 20, ROWS = 11, ZOOM = 16, UNITS = 256, TRIANGLES = 2 };

struct point {
    int x, y; /* in 1/256 pixel */
};

/* Clockwise on the screen. Many centres lie exactly upon edges: an edge of 45 degrees, one upright, one level. */
static const struct point corner[TRIANGLES][3] = {
    { { 640, 384 }, { 2944, 384 }, { 640, 2688 } },
    { { 2944, 384 }, { 4480, 2688 }, { 640, 2688 } },
};

static long edge(struct point from, struct point to, struct point p)
{
    return (long)(to.x - from.x) * (p.y - from.y) - (long)(to.y - from.y) * (p.x - from.x);
}

/* A centre upon an edge belongs to the triangle whose top or left edge that is: a level one with the inside below, or
 * any with the inside to its right. Its neighbour has the same edge as a bottom or right one. */
static bool is_top_or_left(struct point from, struct point to)
{
    return (from.y == to.y && to.x > from.x) || to.y < from.y;
}

static bool covers(const struct point t[3], struct point centre)
{
    for (int i = 0; i < 3; i++) {
        long e = edge(t[i], t[(i + 1) % 3], centre);
        if (e < 0 || (e == 0 && !is_top_or_left(t[i], t[(i + 1) % 3])))
            return false;
    }
    return true;
}

/* Whether a place is less than half a pixel of the picture from one of the edges. */
static bool is_near_edge(const struct point t[3], struct point p)
{
    for (int i = 0; i < 3; i++) {
        struct point a = t[i], b = t[(i + 1) % 3];
        double e = (double)edge(a, b, p), x = b.x - a.x, y = b.y - a.y, along = (p.x - a.x) * x + (p.y - a.y) * y;
        double length = x * x + y * y, reach = UNITS / (2.0 * ZOOM);
        if (e * e <= reach * reach * length && along >= 0 && along <= length)
            return true;
    }
    return false;
}

static void paint(int x, int y, uint8_t pixel[3])
{
    static const uint8_t colors[4][3] = { { 60, 62, 66 }, { 214, 150, 60 }, { 70, 130, 190 }, { 255, 255, 255 } };
    struct point centre = { x / ZOOM * UNITS + UNITS / 2, y / ZOOM * UNITS + UNITS / 2 };
    struct point here = { x * UNITS / ZOOM + UNITS / (2 * ZOOM), y * UNITS / ZOOM + UNITS / (2 * ZOOM) };
    int owners = 0;
    bool is_line = false;
    for (int t = 0; t < TRIANGLES; t++) {
        owners |= covers(corner[t], centre) ? 1 << t : 0;
        is_line = is_line || is_near_edge(corner[t], here);
    }
    bool is_gap = x % ZOOM == 0 || y % ZOOM == 0, is_dot = abs(here.x - centre.x) < 25 && abs(here.y - centre.y) < 25;
    for (int c = 0; c < 3; c++)
        pixel[c] = is_line || is_dot ? 0 : is_gap ? colors[owners][c] * 3 / 4 : colors[owners][c];
}

int main(int argc, char **argv)
{
    lom_image *picture = lom_create_image(COLUMNS * ZOOM, ROWS * ZOOM, 1, LOM_FORMAT_RGB8_SRGB, NULL);
    for (int i = 0; picture != NULL && i < picture->width * picture->height; i++)
        paint(i % picture->width, i / picture->width, picture->pixels + 3 * (size_t)i);
    bool done = argc == 2 && picture != NULL && lom_write_image(argv[1], NULL, picture, NULL);
    lom_free_image(picture);
    if (!done)
        fprintf(stderr, "rasterization: nothing was written; usage: rasterization OUT.png\n");
    return done ? 0 : 2;
}
