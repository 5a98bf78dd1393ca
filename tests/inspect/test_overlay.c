/* Proves that overlays of scenes are what was drawn: the frame below has the bytes of lom_render_frame, also in a run of
 * impostors; depths are those of the frame's own target, normals and counts of fragments those of the records of every
 * pixel (lom/record.h); the legend lies where it was asked for. */
#include "check.h"

#include "image/color_map.h"

#include <lom/lom.h>

enum { WIDTH = 160, HEIGHT = 90 };

struct open {
    lom_scene *scene;
    lom_renderer *renderer;
};

/* What is counted has sharp edges. */
static struct open open_scene(const char *name)
{
    static const char *const sharp = "output.edges=sharp";
    char path[200];
    lom_error error = { .code = LOM_OK };
    snprintf(path, sizeof path, "assets/scenes/%s.toml", name);
    struct open o = { .scene = lom_read_scene(path, &sharp, 1, &error) };
    o.renderer = o.scene != NULL ? lom_create_renderer(o.scene, NULL, &error) : NULL;
    CHECK(o.renderer != NULL, "%s: %s", name, error.text);
    return o;
}

static void close_scene(struct open *o)
{
    lom_free_renderer(o->renderer);
    lom_free_scene(o->scene);
}

static lom_overlay overlay_of(const struct open *o, const char *kind, int frame, const char *pass, lom_legend legend)
{
    lom_error error = { .code = LOM_OK };
    lom_overlay overlay;
    const lom_overlay_desc desc = { .frame = { .width = WIDTH, .height = HEIGHT, .frame = frame },
                                    .kind = lom_find_overlay(kind, &error),
                                    .pass = pass,
                                    .legend = legend };
    CHECK(desc.kind != NULL && lom_draw_overlay(o->renderer, &desc, &overlay, &error), "%s: %s", kind, error.text);
    return overlay;
}

static bool same(const lom_image *a, const lom_image *b)
{
    return a != NULL && b != NULL && a->format == b->format && lom_image_size(a) == lom_image_size(b) &&
           memcmp(a->pixels, b->pixels, lom_image_size(a)) == 0;
}

static lom_image *picture_of(const struct open *o, int frame)
{
    lom_frame drawn = { .image = NULL };
    const lom_frame_desc desc = { .width = WIDTH, .height = HEIGHT, .frame = frame };
    CHECK(lom_render_frame(o->renderer, &desc, &drawn, NULL));
    return drawn.image;
}

static void the_frame_below_is_the_same_bytes(void)
{
    static const char *const scenes[] = { "lake", "falls" };
    for (int i = 0; i < 2; i++) {
        struct open o = open_scene(scenes[i]);
        lom_image *picture = picture_of(&o, 0);
        const lom_overlay_kind *kind;
        for (size_t k = 0; (kind = lom_describe_overlay(k)) != NULL; k += i == 0 ? 1 : 5) {
            lom_overlay overlay = overlay_of(&o, kind->name, 0, NULL, LOM_LEGEND_BELOW);
            CHECK(same(overlay.frame.image, picture), "%s, %s", scenes[i], kind->name);
            lom_free_overlay(&overlay);
        }
        lom_image *again = picture_of(&o, 0);
        CHECK(same(picture, again), "%s", scenes[i]);
        lom_free_image(picture);
        lom_free_image(again);
        close_scene(&o);
    }
}

/* A run, then the same run with every other frame under an overlay: plates grow older from frame to frame. */
static void a_run_of_impostors_goes_on(void)
{
    enum { FRAMES = 6 };
    struct open o = open_scene("flight");
    lom_image *pictures[FRAMES];
    int oldest = 0;
    for (int frame = 0; frame < FRAMES; frame++)
        pictures[frame] = picture_of(&o, frame);
    for (int frame = 0; frame < FRAMES; frame++) {
        if (frame % 2 == 0) {
            lom_image *own = picture_of(&o, frame);
            CHECK(same(own, pictures[frame]), "frame %d", frame);
            lom_free_image(own);
        } else {
            lom_overlay overlay = overlay_of(&o, "impostor-age", frame, "picture", LOM_LEGEND_NONE);
            CHECK(same(overlay.frame.image, pictures[frame]), "frame %d", frame);
            for (int i = 0; overlay.numbers != NULL && i < WIDTH * HEIGHT; i++) {
                float age = ((float *)(void *)overlay.numbers->pixels)[i];
                CHECK(age != age || (age >= 0 && age <= (float)frame), "frame %d: %g", frame, (double)age);
                oldest = age > (float)oldest ? lom_int_of((double)age) : oldest;
            }
            lom_free_overlay(&overlay);
        }
    }
    CHECK(oldest == FRAMES - 1, "the oldest plate has %d frames", oldest);
    for (int frame = 0; frame < FRAMES; frame++)
        lom_free_image(pictures[frame]);
    close_scene(&o);
}

/* Where nothing is there an overlay has a NaN, and --show a 0. */
static void check_depth(const struct open *o, const char *scene)
{
    lom_overlay overlay = overlay_of(o, "depth", 0, NULL, LOM_LEGEND_NONE);
    const lom_frame_desc desc = { .width = WIDTH, .height = HEIGHT };
    lom_image *shown = lom_show_pass(o->renderer, &desc, "depth", NULL);
    CHECK(shown != NULL && overlay.numbers != NULL && lom_image_size(shown) == lom_image_size(overlay.numbers));
    const float *a = (const float *)(const void *)overlay.numbers->pixels,
                *b = (const float *)(const void *)shown->pixels;
    int there = 0;
    for (size_t i = 0; i < lom_image_size(shown) / sizeof *a; i++) {
        CHECK((a[i] == a[i] ? a[i] : 0) == b[i], "%s: %zu: %g, not %g", scene, i, (double)a[i], (double)b[i]);
        there += a[i] == a[i];
    }
    CHECK(there > 1000, "%s: %d", scene, there);
    lom_free_image(shown);
    lom_free_overlay(&overlay);
}

static void depths_are_those_of_the_target(void)
{
    static const char *const scenes[] = { "falls", "gale" }; /* planar water leaves no depth */
    for (int i = 0; i < 2; i++) {
        struct open o = open_scene(scenes[i]);
        check_depth(&o, scenes[i]);
        close_scene(&o);
    }
}

/* The last that is stored of an object. */
static const lom_triangle_record *find_object(const lom_pixel_record *pixel)
{
    const lom_triangle_record *last = NULL;
    for (const lom_pass_record *pass = pixel->passes; pass != NULL; pass = pass->next)
        for (const lom_draw_record *draw = pass->draws; draw != NULL; draw = draw->next)
            for (const lom_triangle_record *t = draw->triangles; t != NULL; t = t->next)
                if (draw->desc.object != 0 && (t->fate == LOM_FATE_STORED || t->fate == LOM_FATE_BLENDED_OVER))
                    last = t;
    return last;
}

/* Of a rectangle of the lake: objects and normals of what is seen. */
static void what_is_seen_is_that_of_records(void)
{
    enum { X = 20, Y = 20, W = 90, H = 50 };
    struct open o = open_scene("lake");
    const lom_frame_desc frame = { .width = WIDTH, .height = HEIGHT };
    lom_image *objects = lom_show_pass(o.renderer, &frame, "objects", NULL);
    lom_overlay normals = overlay_of(&o, "normals", 0, NULL, LOM_LEGEND_NONE);
    const lom_explain_desc desc = { .frame = frame, .x = X, .y = Y, .width = W, .height = H };
    lom_explanation *x = lom_explain(o.renderer, &desc, NULL);
    CHECK(x != NULL && objects != NULL);
    for (int i = 0; x != NULL && i < W * H; i++) {
        const lom_triangle_record *seen =
            find_object(lom_watched_pixel(lom_renderer_device(o.renderer), 0, i % W, i / W));
        const float *number = lom_image_pixel(objects, X + i % W, Y + i / W, 0);
        const float *normal = lom_image_pixel(normals.numbers, X + i % W, Y + i / W, 0), *expected = NULL;
        for (const lom_note_record *n = seen != NULL ? seen->fragment.notes : NULL; n != NULL; n = n->next)
            if (n->kind == LOM_NOTE_VALUE && n->components == 3 && strcmp(n->name, "normal") == 0)
                expected = n->value;
        CHECK(*number == (seen != NULL ? (float)seen->draw->desc.object : 0), "pixel %d: %g", i, (double)*number);
        CHECK(expected != NULL ? memcmp(normal, expected, 3 * sizeof *normal) == 0 : normal[0] != normal[0],
              "pixel %d: %g", i, (double)normal[0]);
    }
    lom_free_explanation(o.renderer, x);
    lom_free_image(objects);
    lom_free_overlay(&normals);
    close_scene(&o);
}

/* Fragments and early kills of a rectangle, counted from the records of its pixels. */
static void counts_are_those_of_records(void)
{
    enum { X = 30, Y = 30, W = 60, H = 40 };
    struct open o = open_scene("lake");
    lom_overlay overdraw = overlay_of(&o, "overdraw", 0, NULL, LOM_LEGEND_NONE);
    lom_overlay kills = overlay_of(&o, "early-kills", 0, NULL, LOM_LEGEND_NONE);
    const lom_explain_desc desc = {
        .frame = { .width = WIDTH, .height = HEIGHT }, .x = X, .y = Y, .width = W, .height = H
    };
    lom_explanation *x = lom_explain(o.renderer, &desc, NULL);
    CHECK(x != NULL);
    for (int i = 0; x != NULL && i < W * H; i++) {
        float drawn = 0, killed = 0;
        const lom_pixel_record *pixel = lom_watched_pixel(lom_renderer_device(o.renderer), 0, i % W, i / W);
        for (const lom_pass_record *pass = pixel->passes; pass != NULL; pass = pass->next)
            for (const lom_draw_record *draw = pass->draws; draw != NULL; draw = draw->next)
                for (const lom_triangle_record *t = draw->triangles; t != NULL; t = t->next) {
                    const lom_fragment_record *f = &t->fragment;
                    drawn += (float)f->shaded;
                    killed += (float)(t->covered && f->inside_distances && !f->shaded);
                }
        int px = X + i % W, py = Y + i / W;
        CHECK(*(float *)lom_image_pixel(overdraw.numbers, px, py, 0) == drawn, "pixel %d,%d", px, py);
        CHECK(*(float *)lom_image_pixel(kills.numbers, px, py, 0) == killed, "pixel %d,%d", px, py);
    }
    lom_free_explanation(o.renderer, x);
    lom_free_overlay(&overdraw);
    lom_free_overlay(&kills);
    close_scene(&o);
}

/* The sum over each tile of 64 pixels of the frame, of a part of it that begins within one. */
static void work_of_a_tile_is_the_sum_of_its_pixels(void)
{
    static const char *const counts[] = { "early-kills", "overdraw", "lookups", "march-steps" };
    static const double weights[] = { 0.25, 0.5, 1, 2.5 };
    const lom_rect crop = { 40, 10, 100, 70 };
    struct open o = open_scene("lake");
    double sum[2][3] = { { 0 } };
    lom_overlay overlay;
    lom_overlay_desc desc = { .frame = { .width = WIDTH, .height = HEIGHT, .crop = crop }, .legend = LOM_LEGEND_NONE };
    for (int i = 0; i < 4; i++) {
        desc.kind = lom_find_overlay(counts[i], NULL);
        CHECK(lom_draw_overlay(o.renderer, &desc, &overlay, NULL));
        for (int p = 0; p < crop.width * crop.height; p++)
            sum[(crop.y + p / crop.width) / 64][(crop.x + p % crop.width) / 64] +=
                weights[i] * (double)((float *)(void *)overlay.numbers->pixels)[p];
        lom_free_overlay(&overlay);
    }
    desc.kind = lom_find_overlay("tile-work", NULL);
    CHECK(lom_draw_overlay(o.renderer, &desc, &overlay, NULL));
    for (int p = 0; p < crop.width * crop.height; p++) {
        double expected = sum[(crop.y + p / crop.width) / 64][(crop.x + p % crop.width) / 64];
        CHECK((double)((float *)(void *)overlay.numbers->pixels)[p] == (double)(float)expected, "pixel %d", p);
    }
    lom_free_overlay(&overlay);
    close_scene(&o);
}

/* Below the bar, from the lowest colour to the highest, a tick for each whole number of 0 to 8. */
static void the_scale_has_its_ticks(void)
{
    enum { MARGIN = 4, LENGTH = WIDTH - 2 * MARGIN };
    struct open o = open_scene("lake");
    lom_overlay below = overlay_of(&o, "overdraw", 0, NULL, LOM_LEGEND_BELOW);
    uint8_t map[256][3];
    lom_make_color_map(map);
    int bar = HEIGHT;
    while (bar < below.shown->height && memcmp(lom_image_pixel(below.shown, MARGIN, bar, 0), map[0], 3) != 0)
        bar++;
    CHECK(bar < below.shown->height);
    CHECK(memcmp(lom_image_pixel(below.shown, WIDTH - MARGIN - 1, bar, 0), map[255], 3) == 0);
    int ticks = bar;
    while (ticks < below.shown->height && memcmp(lom_image_pixel(below.shown, MARGIN, ticks, 0), map[0], 3) == 0)
        ticks++;
    for (int x = 0; x < WIDTH; x++) {
        bool is_tick = false;
        for (int i = 0; i <= 8; i++)
            is_tick |= x == MARGIN + lom_int_of(i / 8.0 * (LENGTH - 1) + 0.5);
        CHECK((*(uint8_t *)lom_image_pixel(below.shown, x, ticks, 0) > 200) == is_tick, "column %d", x);
    }
    lom_free_overlay(&below);
    close_scene(&o);
}

static void legends_lie_where_they_are_asked_for(void)
{
    struct open o = open_scene("lake");
    lom_overlay below = overlay_of(&o, "overdraw", 0, NULL, LOM_LEGEND_BELOW);
    lom_overlay inside = overlay_of(&o, "overdraw", 0, NULL, LOM_LEGEND_INSIDE);
    lom_overlay none = overlay_of(&o, "overdraw", 0, NULL, LOM_LEGEND_NONE);
    int strip = below.shown->height - HEIGHT;
    CHECK(strip > 20 && inside.shown->height == HEIGHT && none.shown->height == HEIGHT);
    CHECK(memcmp(below.shown->pixels, none.shown->pixels, WIDTH * HEIGHT * 3) == 0);
    CHECK(memcmp(inside.shown->pixels, none.shown->pixels, (size_t)(WIDTH * (HEIGHT - strip) * 3)) == 0);
    CHECK(memcmp(inside.shown->pixels, none.shown->pixels, WIDTH * HEIGHT * 3) != 0);
    lom_free_overlay(&below);
    lom_free_overlay(&inside);
    lom_free_overlay(&none);
    lom_overlay mirror = overlay_of(&o, "overdraw", 0, "reflection", LOM_LEGEND_NONE);
    float most = 0;
    for (int i = 0; i < mirror.numbers->width * mirror.numbers->height; i++)
        most =
            ((float *)(void *)mirror.numbers->pixels)[i] > most ? ((float *)(void *)mirror.numbers->pixels)[i] : most;
    CHECK(most >= 1);
    lom_free_overlay(&mirror);
    lom_overlay_kind foreign = *lom_describe_overlay(0);
    lom_overlay_desc desc = { .frame = { .width = WIDTH, .height = HEIGHT }, .kind = &foreign };
    CHECK(!lom_draw_overlay(o.renderer, &desc, &mirror, NULL) && mirror.numbers == NULL && mirror.shown == NULL);
    close_scene(&o);
}

int main(int argc, char **argv)
{
    RUN(the_frame_below_is_the_same_bytes);
    RUN(a_run_of_impostors_goes_on);
    RUN(depths_are_those_of_the_target);
    RUN(what_is_seen_is_that_of_records);
    RUN(counts_are_those_of_records);
    RUN(work_of_a_tile_is_the_sum_of_its_pixels);
    RUN(the_scale_has_its_ticks);
    RUN(legends_lie_where_they_are_asked_for);
    return check_result();
}
