/* Lesson 3. Clip space: clip_space OUT.png
 * In: a road of tiles that goes on behind the eye, and posts beside it, in metres. Out: a picture of them in perspective.
 * Each triangle is taken to clip space by one matrix, cut where the near plane cuts it, divided by w, and filled. */
#include <lom/geometry.h>

#include <stdio.h>

enum { WIDTH = 320, HEIGHT = 180 };

struct point {
    double x, y, z, w; /* clip space; after the division x and y are pixels */
};

static const lom_vec3 eye = { 0.8, 1.6, 0 }, target = { 0, 0.9, -8 }, up = { 0, 1, 0 };
static const double field_of_view = 0.9, near_plane = 0.1; /* radians, metres */

static double edge(struct point from, struct point to, double x, double y)
{
    return (to.x - from.x) * (y - from.y) - (to.y - from.y) * (x - from.x);
}

static void fill(lom_image *picture, const struct point p[3], const float color[3])
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

/* Where the way from a to b meets the near plane, z = w. The distance w - z is linear along the way. */
static struct point cut(struct point a, struct point b)
{
    double da = a.w - a.z, db = b.w - b.z, t = da / (da - db);
    return (struct point){ a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t, a.z + (b.z - a.z) * t, a.w + (b.w - a.w) * t };
}

/* Keeps what lies before the eye: a triangle becomes none, a triangle or a quadrilateral. */
static int clip_near(const struct point triangle[3], struct point kept[4])
{
    int count = 0;
    for (int i = 0; i < 3; i++) {
        struct point a = triangle[i], b = triangle[(i + 1) % 3];
        if (a.z <= a.w)
            kept[count++] = a;
        if ((a.z <= a.w) != (b.z <= b.w))
            kept[count++] = cut(a, b);
    }
    return count;
}

static struct point to_window(struct point p)
{
    return (struct point){ (p.x / p.w + 1) * WIDTH / 2, (1 - p.y / p.w) * HEIGHT / 2, p.z / p.w, p.w };
}

/* Four corners, one after the other around. */
static void draw_quad(lom_image *picture, const lom_mat4 *to_clip, const lom_vec3 corner[4], const float color[3])
{
    for (int half = 0; half < 2; half++) {
        struct point clip[3], kept[4];
        for (int k = 0; k < 3; k++) {
            double c[4];
            lom_transform_clip(to_clip, corner[k == 0 ? 0 : k + half], c);
            clip[k] = (struct point){ c[0], c[1], c[2], c[3] };
        }
        int count = clip_near(clip, kept);
        for (int k = 0; k < count; k++)
            kept[k] = to_window(kept[k]);
        for (int k = 1; k + 1 < count; k++)
            fill(picture, (struct point[3]){ kept[0], kept[k], kept[k + 1] }, color);
    }
}

static void draw_scene(lom_image *picture)
{
    static const float tile[2][3] = { { 0.28f, 0.26f, 0.24f }, { 0.5f, 0.47f, 0.42f } },
                       post[3] = { 0.7f, 0.12f, 0.06f };
    lom_mat4 view = lom_look_at(eye, target, up);
    lom_mat4 lens = lom_perspective(field_of_view, (double)WIDTH / HEIGHT, near_plane);
    lom_mat4 to_clip = lom_multiply(&lens, &view);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++)
            for (int c = 0; c < 3; c++)
                ((float *)lom_image_pixel(picture, x, y, 0))[c] = 0.25f + 0.2f * (float)c + 0.1f * (float)y / HEIGHT;
    for (int z = -60; z < 4; z++) /* from far to near, so that the nearer is painted over the farther */
        for (int x = -2; x < 2; x++)
            draw_quad(picture, &to_clip,
                      (lom_vec3[4]){ { x, 0, z }, { x + 1, 0, z }, { x + 1, 0, z + 1 }, { x, 0, z + 1 } },
                      tile[(x + z) & 1]);
    for (int z = -60; z < 4; z += 4) /* one metre high */
        for (int side = -1; side <= 1; side += 2)
            draw_quad(
                picture, &to_clip,
                (lom_vec3[4]){ { 2.1 * side, 0, z }, { 2.3 * side, 0, z }, { 2.3 * side, 1, z }, { 2.1 * side, 1, z } },
                post);
}

int main(int argc, char **argv)
{
    lom_image *picture = lom_create_image(WIDTH, HEIGHT, 1, LOM_FORMAT_RGB32F, NULL);
    if (picture != NULL)
        draw_scene(picture);
    lom_image *bytes = picture == NULL ? NULL : lom_convert_image(picture, LOM_FORMAT_RGB8_SRGB, NULL);
    bool done = argc == 2 && bytes != NULL && lom_write_image(argv[1], NULL, bytes, NULL);
    lom_free_image(picture);
    lom_free_image(bytes);
    if (!done)
        fprintf(stderr, "clip_space: nothing was written; usage: clip_space OUT.png\n");
    return done ? 0 : 2;
}
