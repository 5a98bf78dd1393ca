/* Lesson 1. A triangle, one pixel after the other: triangle OUT.png
 * In: three corners and the light that each has. Out: a picture. README.md beside this file explains every line. */
#include <lom/image.h>

#include <stdio.h>

enum { WIDTH = 320, HEIGHT = 180 };

struct point {
    double x, y; /* in pixels: x to the right, y down, (0, 0) is the outer corner of the first pixel */
};

/* Twice the area of the triangle from, to, p. Above 0 where p lies to the right of the way, as one sees it who goes. */
static double edge(struct point from, struct point to, struct point p)
{
    return (to.x - from.x) * (p.y - from.y) - (to.y - from.y) * (p.x - from.x);
}

/* The corners in clockwise order on the screen, so that the inside is to the right of all three ways. */
static void draw_triangle(lom_image *picture, const struct point corner[3], const float light[3][3])
{
    double area = edge(corner[0], corner[1], corner[2]);
    for (int y = 0; y < picture->height; y++)
        for (int x = 0; x < picture->width; x++) {
            struct point middle = { x + 0.5, y + 0.5 };
            double e[3] = { edge(corner[1], corner[2], middle), edge(corner[2], corner[0], middle),
                            edge(corner[0], corner[1], middle) };
            if (e[0] < 0 || e[1] < 0 || e[2] < 0)
                continue;
            float *pixel = lom_image_pixel(picture, x, y, 0);
            for (int c = 0; c < 3; c++) /* each corner's light by its share: e / area, which sum up to 1 */
                pixel[c] = (float)((e[0] * light[0][c] + e[1] * light[1][c] + e[2] * light[2][c]) / area);
        }
}

int main(int argc, char **argv)
{
    const struct point corner[3] = { { 160, 12 }, { 290, 165 }, { 30, 165 } };
    const float light[3][3] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } }; /* red, green, blue */
    lom_image *picture = lom_create_image(WIDTH, HEIGHT, 1, LOM_FORMAT_RGB32F, NULL);
    if (picture != NULL)
        draw_triangle(picture, corner, light);
    lom_image *bytes = picture == NULL ? NULL : lom_convert_image(picture, LOM_FORMAT_RGB8_SRGB, NULL);
    bool done = argc == 2 && bytes != NULL && lom_write_image(argv[1], NULL, bytes, NULL);
    lom_free_image(picture);
    lom_free_image(bytes);
    if (!done)
        fprintf(stderr, "triangle: nothing was written; usage: triangle OUT.png\n");
    return done ? 0 : 2;
}
