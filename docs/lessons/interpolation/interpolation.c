/* Lesson 5. What a pixel gets from three vertices: interpolation OUT.png
 * In: a floor of 8 x 8 tiles as two triangles, in clip space. Out: a picture of it, twice: left with the weights of the
 * screen as they are, right with weights that know how far away each vertex is. */
#include <lom/geometry.h>

#include <stdio.h>

enum { WIDTH = 320, HEIGHT = 180, HALF = WIDTH / 2 };

struct vertex {
    double x, y, one_over_w; /* in the window */
    double s, t;             /* what varies: the place in the pattern, in tiles */
};

static double edge(const struct vertex *a, const struct vertex *b, double x, double y)
{
    return (b->x - a->x) * (y - a->y) - (b->y - a->y) * (x - a->x);
}

/* On the screen f/w and 1/w vary evenly, and f is their quotient. */
static void to_perspective(const struct vertex v[3], double weight[3])
{
    double sum = 0;
    for (int i = 0; i < 3; i++) {
        weight[i] *= v[i].one_over_w;
        sum += weight[i];
    }
    for (int i = 0; i < 3; i++)
        weight[i] /= sum;
}

static void draw_triangle(lom_image *picture, const struct vertex v[3], double left, bool perspective)
{
    static const float tile[2][3] = { { 0.05f, 0.12f, 0.2f }, { 0.8f, 0.75f, 0.6f } };
    double area = edge(&v[0], &v[1], v[2].x, v[2].y);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < HALF; x++) {
            double weight[3], s = 0, t = 0;
            for (int i = 0; i < 3; i++)
                weight[i] = edge(&v[(i + 1) % 3], &v[(i + 2) % 3], x + 0.5, y + 0.5) / area;
            if (weight[0] < 0 || weight[1] < 0 || weight[2] < 0)
                continue;
            if (perspective)
                to_perspective(v, weight);
            for (int i = 0; i < 3; i++) {
                s += weight[i] * v[i].s;
                t += weight[i] * v[i].t;
            }
            float *pixel = lom_image_pixel(picture, (int)left + x, y, 0);
            for (int c = 0; c < 3; c++)
                pixel[c] = tile[(lom_int_of(s) + lom_int_of(t)) % 2][c];
        }
}

/* A corner of the floor, from metres to the window. */
static struct vertex place(const lom_mat4 *to_clip, double x, double z)
{
    double clip[4];
    lom_transform_clip(to_clip, (lom_vec3){ x, 0, z }, clip);
    return (struct vertex){ (clip[0] / clip[3] + 1) * HALF / 2, (1 - clip[1] / clip[3]) * HEIGHT / 2, 1 / clip[3],
                            x + 4, z + 9 };
}

int main(int argc, char **argv)
{
    lom_image *picture = lom_create_image(WIDTH, HEIGHT, 1, LOM_FORMAT_RGB32F, NULL);
    lom_mat4 view = lom_look_at((lom_vec3){ 0, 6, 3 }, (lom_vec3){ 0, 0, -4 }, (lom_vec3){ 0, 1, 0 });
    lom_mat4 lens = lom_perspective(0.85, (double)HALF / HEIGHT, 0.1), to_clip = lom_multiply(&lens, &view);
    struct vertex corner[4] = { place(&to_clip, -4, -1), place(&to_clip, 4, -1), place(&to_clip, 4, -9),
                                place(&to_clip, -4, -9) };
    for (int i = 0; i < 3 * WIDTH * HEIGHT && picture != NULL; i++)
        ((float *)(void *)picture->pixels)[i] = 0.3f + 0.15f * (float)(i % 3);
    for (int half = 0; half < 2 && picture != NULL; half++)
        for (int i = 0; i < 2; i++)
            draw_triangle(picture, (struct vertex[3]){ corner[0], corner[1 + i], corner[2 + i] }, half * HALF,
                          half == 1);
    lom_image *bytes = picture == NULL ? NULL : lom_convert_image(picture, LOM_FORMAT_RGB8_SRGB, NULL);
    bool done = argc == 2 && bytes != NULL && lom_write_image(argv[1], NULL, bytes, NULL);
    lom_free_image(picture);
    lom_free_image(bytes);
    if (!done)
        fprintf(stderr, "interpolation: nothing was written; usage: interpolation OUT.png\n");
    return done ? 0 : 2;
}
