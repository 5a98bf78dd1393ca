/* Lesson 2. Moving, turning and scaling, and their order: transforms OUT.png
 * In: the letter F, as points around (0, 0). Out: a picture of it as it is (gray), turned and then moved (left), moved
 * and then turned (right). All of it goes through one matrix that takes metres to pixels. */
#include <lom/geometry.h>

#include <stdio.h>

enum { WIDTH = 320, HEIGHT = 180, POINTS = 18 };

/* Six triangles, two a bar, counter-clockwise; y points up. */
static const double letter[POINTS][2] = {
    { 0, 0 },      { 0.3, 0 },    { 0.3, 1.5 }, { 0, 0 },      { 0.3, 1.5 }, { 0, 1.5 }, /* the upright bar */
    { 0, 1.5 },    { 1, 1.5 },    { 1, 1.8 },   { 0, 1.5 },    { 1, 1.8 },   { 0, 1.8 }, /* the upper one */
    { 0.3, 0.75 }, { 0.8, 0.75 }, { 0.8, 1 },   { 0.3, 0.75 }, { 0.8, 1 },   { 0.3, 1 }  /* the middle one */
};

static double edge(lom_vec3 from, lom_vec3 to, double x, double y)
{
    return (to.x - from.x) * (y - from.y) - (to.y - from.y) * (x - from.x);
}

/* Lesson 1's triangle in one colour; the corners in any order. */
static void fill(lom_image *picture, const lom_vec3 p[3], const float color[3])
{
    double turn = edge(p[0], p[1], p[2].x, p[2].y) < 0 ? -1 : 1;
    for (int y = 0; y < picture->height; y++)
        for (int x = 0; x < picture->width; x++) {
            bool inside = true;
            for (int i = 0; i < 3; i++)
                inside = inside && edge(p[i], p[(i + 1) % 3], x + 0.5, y + 0.5) * turn >= 0;
            for (int c = 0; c < 3 && inside; c++)
                ((float *)lom_image_pixel(picture, x, y, 0))[c] = color[c];
        }
}

static void draw_letter(lom_image *picture, const lom_mat4 *to_pixels, const lom_mat4 *model, const float color[3])
{
    lom_mat4 whole = lom_multiply(to_pixels, model);
    for (int i = 0; i < POINTS; i += 3) {
        lom_vec3 corner[3];
        for (int k = 0; k < 3; k++)
            corner[k] = lom_transform_point(&whole, (lom_vec3){ letter[i + k][0], letter[i + k][1], 0 });
        fill(picture, corner, color);
    }
}

/* A line a metre, the axes darker. */
static void draw_grid(lom_image *picture, double left, double top, double pixels_a_metre)
{
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            double along = (x - left) / pixels_a_metre, down = (y - top) / pixels_a_metre;
            bool line = along == lom_double_floor(along) || down == lom_double_floor(down);
            for (int c = 0; c < 3; c++)
                ((float *)lom_image_pixel(picture, x, y, 0))[c] = along * down == 0 ? 0.15f : line ? 0.6f : 0.85f;
        }
}

int main(int argc, char **argv)
{
    static const float gray[3] = { 0.4f, 0.4f, 0.4f }, blue[3] = { 0.05f, 0.2f, 0.7f }, red[3] = { 0.7f, 0.1f, 0.05f };
    const double size = 30; /* pixels a metre */
    lom_image *picture = lom_create_image(WIDTH, HEIGHT, 1, LOM_FORMAT_RGB32F, NULL);
    lom_mat4 move = lom_translation((lom_vec3){ 2, 0.5, 0 });
    lom_mat4 turn = lom_rotation((lom_vec3){ 0, 0, 1.0 }); /* radians about z, counter-clockwise */
    lom_mat4 turned_then_moved = lom_multiply(&move, &turn), moved_then_turned = lom_multiply(&turn, &move);
    lom_mat4 still = lom_identity(), flip = lom_scaling((lom_vec3){ size, -size, 1 });
    bool done = picture != NULL && argc == 2;
    if (done) {
        lom_mat4 origin = lom_translation((lom_vec3){ 110, 150, 0 }), to_pixels = lom_multiply(&origin, &flip);
        draw_grid(picture, 110, 150, size);
        draw_letter(picture, &to_pixels, &still, gray);
        draw_letter(picture, &to_pixels, &turned_then_moved, blue);
        draw_letter(picture, &to_pixels, &moved_then_turned, red);
    }
    lom_image *bytes = done ? lom_convert_image(picture, LOM_FORMAT_RGB8_SRGB, NULL) : NULL;
    done = bytes != NULL && lom_write_image(argv[1], NULL, bytes, NULL);
    lom_free_image(picture);
    lom_free_image(bytes);
    if (!done)
        fprintf(stderr, "transforms: nothing was written; usage: transforms OUT.png\n");
    return done ? 0 : 2;
}
