/* The stages that a picture went through, a picture each. In: the records of all its pixels (lom/record.h), strip by
 * strip. Out: what each stage made of the triangle that the pixel holds, as colours. Invariant: every number shown was
 * recorded by the stage that draws. */
#include "inspect/verdict.h"
#include "web/lesson_page.h"

#include <math.h>

enum { STRIP = 8 }; /* rows that are watched at once: some kilobytes a pixel */

/* Square of the length of the side opposite to vertex i of the stage's order, in units of 1/256 pixel. */
static double side(const lom_triangle_record *t, int i)
{
    const lom_vertex_record *v = t->pieces > 0 ? t->cut : t->vertex;
    const int32_t *a = v[t->order[(i + 1) % 3]].fixed, *b = v[t->order[(i + 2) % 3]].fixed;
    double x = (double)a[0] - b[0], y = (double)a[1] - b[1];
    return x * x + y * y;
}

/* A colour a triangle; darker where an edge is nearer than 0.6 pixels: edge functions are lengths times distances. */
static void paint_setup(const lom_pixel_record *pixel, const lom_triangle_record *t, float rgb[3])
{
    (void)pixel;
    float light = 1;
    for (int i = 0; i < 3; i++) {
        double reach = 0.6 * 256, e = (double)t->edge[i];
        light = e * e < reach * reach * side(t, i) ? 0.35f : light;
    }
    for (int c = 0; c < 3; c++)
        rgb[c] = light * (0.2f + 0.8f * (float)lom_random_uniform((uint64_t)c + 1,
                                                                  (uint64_t)t->draw->number << 32 | t->number));
}

/* How many triangles cover the pixel: six and more are white. */
static void paint_raster(const lom_pixel_record *pixel, const lom_triangle_record *owner, float rgb[3])
{
    int covered = 0;
    (void)owner;
    for (const lom_pass_record *pass = pixel->passes; pass != NULL; pass = pass->next)
        for (const lom_draw_record *draw = pass->draws; draw != NULL; draw = draw->next)
            for (const lom_triangle_record *t = draw->triangles; t != NULL; t = t->next)
                covered += t->covered;
    rgb[0] = rgb[1] = rgb[2] = (float)(covered < 6 ? covered : 6) / 6;
}

static void paint_weights(const lom_pixel_record *pixel, const lom_triangle_record *t, float rgb[3])
{
    (void)pixel;
    memcpy(rgb, t->fragment.l, 3 * sizeof *rgb);
}

static void paint_depth(const lom_pixel_record *pixel, const lom_triangle_record *t, float rgb[3])
{
    (void)pixel;
    rgb[0] = rgb[1] = rgb[2] = t->fragment.depth_tested || t->fragment.depth_written ? t->fragment.z : 0;
}

static void paint_fragment(const lom_pixel_record *pixel, const lom_triangle_record *t, float rgb[3])
{
    (void)pixel;
    if (t->draw->pass->attachment >= 0)
        memcpy(rgb, t->fragment.color[t->draw->pass->attachment], 3 * sizeof *rgb);
}

static const struct view {
    const char *name, *text;
    void (*paint)(const lom_pixel_record *pixel, const lom_triangle_record *owner, float rgb[3]);
    bool stretched; /* its numbers from the least above 0 to the largest are black to white */
} views[] = {
    { "setup", "stage setup: the triangle that each pixel shows, in a colour of its own; edges dark", paint_setup,
      false },
    { "raster", "stage raster: how many triangles cover each pixel; black none, white six", paint_raster, false },
    { "weights", "stage raster: the weights of the triangle's three vertices, as red, green and blue", paint_weights,
      false },
    { "depth", "stage depth: the depth of what each pixel shows, from the farthest, black, to the nearest", paint_depth,
      true },
    { "fragment", "stage fragment: the light that the shader gives, before it is blended and encoded", paint_fragment,
      false },
};
enum { VIEWS = sizeof views / sizeof views[0] };

const char *lom_lesson_view(int index, const char **text)
{
    if (index >= VIEWS)
        return NULL;
    *text = views[index].text;
    return views[index].name;
}

/* ---- drawing ---- */

static void look_at_strip(lom_lesson_run *run, const lom_image *picture)
{
    lom_image *const *view = run->seen;
    for (int y = run->watch.y; y < run->watch.y + run->watch.height; y++)
        for (int x = 0; x < picture->width; x++) {
            lom_explained explained = { .record = lom_watched_pixel(run->device, 0, x, y) };
            lom_find_verdict(&explained);
            for (int i = 0; i < VIEWS && (explained.owner != NULL || views[i].paint == paint_raster); i++)
                views[i].paint(explained.record, explained.owner, lom_image_pixel(view[i], x, y, 0));
        }
}

static void stretch(lom_image *image)
{
    float *value = (float *)(void *)image->pixels, least = INFINITY, most = 0;
    size_t count = lom_image_size(image) / sizeof *value;
    for (size_t i = 0; i < count; i++) {
        least = value[i] > 0 && value[i] < least ? value[i] : least;
        most = value[i] > most ? value[i] : most;
    }
    for (size_t i = 0; i < count && most > least; i++)
        value[i] = value[i] > 0 ? (value[i] - least) / (most - least) : 0;
}

bool lom_write_lesson_views(lom_lesson_run *run, const char *prefix)
{
    lom_image *view[VIEWS];
    const int width = run->width, height = run->height;
    bool done = true;
    char path[256];
    for (int i = 0; i < VIEWS; i++) {
        view[i] = lom_create_image(width, height, 1, LOM_FORMAT_RGB32F, NULL);
        done = done && view[i] != NULL;
    }
    run->seen = view;
    run->look = look_at_strip;
    for (int y = 0; y < height && done; y += STRIP) {
        run->watch = (lom_rect){ 0, y, width, height - y < STRIP ? height - y : STRIP };
        snprintf(path, sizeof path, "%.200s.png", prefix);
        done = lom_run_lesson(run, path) == 0;
    }
    for (int i = 0; i < VIEWS; i++) {
        snprintf(path, sizeof path, "%.200s-%s.png", prefix, views[i].name);
        if (done && views[i].stretched)
            stretch(view[i]);
        done = done && lom_write_lesson_picture(path, view[i]);
        lom_free_image(view[i]);
    }
    return done;
}
