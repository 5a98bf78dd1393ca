/* The scene that shows the mistakes. In: stages. Out: a picture of it by them. */
#ifndef LOM_LESSONS_GALLERY_H
#define LOM_LESSONS_GALLERY_H

#include "stages.h"

enum { GALLERY_WIDTH = 128, GALLERY_HEIGHT = 80, SKIN = 64 };

/* Four fields with a border, no two of them alike, so that turning it over shows. */
static void make_skin(uint8_t rgba[SKIN * SKIN][4])
{
    static const uint8_t fields[4][4] = {
        { 214, 178, 132, 255 }, { 74, 110, 128, 255 }, { 120, 60, 50, 255 }, { 250, 246, 238, 255 }
    };
    for (int i = 0; i < SKIN * SKIN; i++) {
        int x = i % SKIN, y = i / SKIN, half = SKIN / 2, field = x / half + 2 * (y / half);
        memcpy(rgba[i], fields[field], 4);
        for (int c = 0; c < 3 && (x % half < 2 || y % half < 2); c++)
            rgba[i][c] = 30;
    }
}

/* A cut through three waves that run to the right, at 1.7 seconds: at the lower left, 16 pixels a metre. */
static void draw_waves(const struct stages *by, uint8_t (*color)[4])
{
    enum { LEFT = 2, WIDE = 48, TOP = 60, LEVEL = 70, BOTTOM = 78, PARTS = 16 };
    static const lom_trochoid waves[3] = { { { 1, 0 }, 4.2, 6.42, 0.1, 0.22, 0.22 },
                                           { { 1, 0 }, 7.7, 8.69, 0.4, 0.05, 0.05 },
                                           { { 1, 0 }, 13.1, 11.33, 0.7, 0.02, 0.02 } };
    for (int i = 0; i < WIDE * (BOTTOM - TOP); i++)
        write_pixel((const float[4]){ 0.8f, 0.8f, 0.75f, 1 }, false,
                    color[(TOP + i / WIDE) * GALLERY_WIDTH + LEFT + i % WIDE]);
    for (int i = -WIDE * PARTS; i < 2 * WIDE * PARTS;
         i++) { /* columns of water at rest, some of which move into the cut */
        float x = (float)i / (16 * PARTS), at[2] = { x, 0 };
        for (int k = 0; k < 3; k++) {
            float moved[3];
            by->wave(&waves[k], x, 0, 1.7f, moved);
            at[0] += moved[0];
            at[1] += moved[1];
        }
        int column = lom_int_of(floorf(at[0] * 16)), top = LEVEL - lom_int_of(rintf(at[1] * 16));
        for (int y = top > 0 ? top : 0; y < BOTTOM && column >= 0 && column < WIDE; y++)
            write_pixel((const float[4]){ 0.03f, 0.15f, 0.25f, 1 }, false, color[y * GALLERY_WIDTH + LEFT + column]);
    }
}

/* A round cloud over the middle, lit from above: 8 steps a ray, blended over what is there. */
static void draw_cloud(const struct stages *by, uint8_t (*color)[4])
{
    enum { STEPS = 8, RADIUS = 11, X = 58, Y = 13 };
    for (int y = Y - RADIUS; y <= Y + RADIUS; y++)
        for (int x = X - RADIUS; x <= X + RADIUS; x++) {
            float ray[2] = { 1, 0 }, across = (float)(x - X) / RADIUS, up = (float)(Y - y) / RADIUS;
            for (int i = 0; i < STEPS; i++) { /* from the eye's side, which is darker */
                float along = ((float)i + 0.5f) * 2 / STEPS - 1,
                      from_edge = 1 - (across * across + up * up + along * along);
                by->march(greater(from_edge, 0) * 6 / STEPS, 0.35f + 0.25f * up + 0.4f * (along > 0 ? 1.0f : 0.0f),
                          ray);
            }
            uint8_t *pixel = color[y * GALLERY_WIDTH + x];
            float light[4] = { 0, 0, 0, 1 };
            for (int c = 0; c < 3; c++)
                light[c] = ray[1] + ray[0] * decode(pixel[c]);
            write_pixel(light, false, pixel);
        }
}

/* Draws it into color by stages of which those that are NULL are right. False when memory runs out. */
static bool draw_gallery_scene(const struct stages *others, uint8_t (*color)[4])
{
    enum { THINGS = 8 };
    static uint8_t rgba[SKIN * SKIN][4];
    static float room[2 * SKIN * SKIN][4], depth[GALLERY_WIDTH * GALLERY_HEIGHT];
    const struct stages by = complete_stages(others);
    const lom_vec3 eye = { 0.3, 1.7, 4.2 };
    lom_mesh *floor = lom_make_quad(60, 60, NULL), *strip = lom_make_quad(1.4, 40, NULL),
             *torus = lom_make_torus(0.8, 0.36, 48, 24, NULL);
    lom_mesh *sphere = lom_make_sphere(0.7, 10, 6, NULL), *box = lom_make_box((lom_vec3){ 0.8, 0.8, 0.8 }, NULL),
             *panel = lom_make_quad(0.25, 0.4, NULL);
    const double quarter = 1.5707963267948966;
    const struct thing things[THINGS] = {
        { floor, { 0, 0, 0 }, { 0, 0, 0 }, { 1, 1, 1 }, 1, 20, { 0, 0, 0, 0 }, 0, false },
        { strip, { 0.6, 0.003, -12 }, { 0, 0, 0 }, { 1, 1, 1 }, 1, 1, { 0, 0, 0, 0 }, 0, false },
        { torus, { -1.1, 0.9, 0.4 }, { 1.2, 0.3, 0.5 }, { 1.2, 0.6, 0.9 }, 1, 3, { 0, -1, 0, 1.35f }, 0, false },
        { box, { -0.1, 0.55, 2 }, { 0.5, 0.7, 0.2 }, { 1, 0.8, 1 }, 1, 1, { 0, 0, 0, 0 }, 1, false },
        { sphere, { 1.1, 0.8, 1.2 }, { 0.2, 0.4, 0 }, { 1, 1, 1 }, 0.5f, 2, { 0, 0, 0, 0 }, 1, false },
        { sphere, { 1.5, 1.1, -0.6 }, { 0.3, 0, 0.3 }, { 1.4, 1.4, 1.4 }, 0.6f, 2, { 0, 0, 0, 0 }, 1, false },
        /* From (4.5, 4.5) to (36.5, 20.5) on the screen: pixel centres lie on all edges, and on the one between them. */
        { panel, { -0.8046875, 0.6875, 0.9 }, { quarter, 0, 0 }, { 1, 1, 1 }, 0.5f, 0.4f, { 0, 0, 0, 0 }, 0, true },
        { panel, { -0.5546875, 0.6875, 0.95 }, { quarter, 0, 0 }, { 1, 1, 1 }, 0.5f, 0.4f, { 0, 0, 0, 0 }, 0, true },
    };
    lom_mat4 view = lom_look_at(eye, (lom_vec3){ 0.2, 0.7, 0 }, (lom_vec3){ 0, 1, 0 });
    lom_mat4 lens = lom_perspective(0.8, (double)GALLERY_WIDTH / GALLERY_HEIGHT, 0.1),
             camera = lom_multiply(&lens, &view);
    struct picture picture = {
        GALLERY_WIDTH, GALLERY_HEIGHT, { 2.0f * BAND / GALLERY_WIDTH, 2.0f * BAND / GALLERY_HEIGHT }, color, depth, NULL
    };
    make_skin(rgba);
    struct texture texture = by.make_texture(SKIN, SKIN, rgba[0], room);
    for (int i = 0; i < GALLERY_WIDTH * GALLERY_HEIGHT; i++) {
        depth[i] = 0;
        write_pixel((const float[4]){ 0.25f, 0.45f, 0.7f, 1 }, false, color[i]);
    }
    bool drawn[THINGS] = { false },
         done = floor != NULL && strip != NULL && torus != NULL && sphere != NULL && box != NULL && panel != NULL;
    for (int n = 0; n < THINGS && done; n++) { /* the first of those that are least */
        int next = -1;
        for (int i = 0; i < THINGS; i++)
            if (!drawn[i] && (next < 0 || by.order(&things[i], eye) < by.order(&things[next], eye)))
                next = i;
        drawn[next] = true;
        draw_thing_by(&by, &picture, &things[next], &texture, &camera, eye);
    }
    draw_cloud(&by, color);
    draw_waves(&by, color);
    lom_free_mesh(floor);
    lom_free_mesh(strip);
    lom_free_mesh(torus);
    lom_free_mesh(sphere);
    lom_free_mesh(box);
    lom_free_mesh(panel);
    return done;
}

/* As an RGB8 image, which the caller frees; NULL on failure. */
static lom_image *draw_gallery_image(const struct stages *stages, lom_error *error)
{
    static uint8_t color[GALLERY_WIDTH * GALLERY_HEIGHT][4];
    const lom_image image = { .width = GALLERY_WIDTH,
                              .height = GALLERY_HEIGHT,
                              .depth = 1,
                              .format = LOM_FORMAT_RGBA8_SRGB,
                              .pixels = color[0] };
    return draw_gallery_scene(stages, color) ? lom_convert_image(&image, LOM_FORMAT_RGB8_SRGB, error) : NULL;
}

#endif
