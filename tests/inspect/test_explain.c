/* Proves that an explanation ends with the pixel of the picture: rectangles of scenes, drawn while every pixel of them is
 * watched, have the bytes that lom_render_frame gives without, and so has the last write of each pixel's record; and that
 * lookups of the frame's own pictures lead to texels whose records end with what was read. LOM_EXHAUSTIVE: every scene of
 * assets/scenes, every pixel of it at 320x180 (18 scenes: a million). */
#include "check.h"

#include <lom/lom.h>

#include <math.h>

enum { WIDTH = 320, HEIGHT = 180 };

static size_t checked;

static bool is_exhaustive(void)
{
    return getenv("LOM_EXHAUSTIVE") != NULL;
}

/* The picture's numbers after the last write; false: nothing was written. */
static bool last_write(const lom_pixel_record *pixel, float after[4])
{
    bool any = false;
    for (const lom_pass_record *pass = pixel->passes; pass != NULL; pass = pass->next)
        for (const lom_draw_record *draw = pass->draws; draw != NULL; draw = draw->next) {
            CHECK(draw->recorded, "draw %zu of %s", draw->number, draw->desc.shader->name);
            for (const lom_triangle_record *t = draw->triangles; t != NULL; t = t->next)
                if (t->covered && t->fragment.write[0].written) {
                    any = true;
                    memcpy(after, t->fragment.write[0].after, 4 * sizeof *after);
                }
        }
    return any;
}

static void check_rectangle(lom_renderer *renderer, const lom_image *picture, const char *scene, int frame, lom_rect at)
{
    lom_error error = { .code = LOM_OK };
    const lom_explain_desc desc = { .frame = { .width = WIDTH, .height = HEIGHT, .frame = frame },
                                    .x = at.x,
                                    .y = at.y,
                                    .width = at.width,
                                    .height = at.height };
    lom_explanation *x = lom_explain(renderer, &desc, &error);
    CHECK(x != NULL, "%s: %s", scene, error.text);
    for (int i = 0; x != NULL && i < at.width * at.height; i++) {
        int column = i % at.width, row = i / at.width;
        const uint8_t *bytes = lom_image_pixel(picture, at.x + column, at.y + row, 0);
        const uint8_t *own = lom_image_pixel(x->frame.image, column, row, 0);
        const lom_pixel_record *pixel = lom_watched_pixel(lom_renderer_device(renderer), 0,
                                                          x->item[0].record->x + column, x->item[0].record->y + row);
        float after[4];
        CHECK(memcmp(bytes, own, 3) == 0, "%s: pixel %d,%d", scene, at.x + column, at.y + row);
        bool any = last_write(pixel, after);
        for (int c = 0; c < 3; c++)
            CHECK(!any || after[c] == bytes[c], "%s: pixel %d,%d ends with %g, is %d", scene, at.x + column, at.y + row,
                  (double)after[c], bytes[c]);
        checked++;
    }
    lom_free_explanation(renderer, x);
}

static void check_scene(const char *name, int frame, lom_rect at)
{
    char path[200];
    lom_error error = { .code = LOM_OK };
    snprintf(path, sizeof path, "assets/scenes/%s.toml", name);
    lom_scene *scene = lom_read_scene(path, NULL, 0, &error);
    lom_renderer *renderer = scene != NULL ? lom_create_renderer(scene, NULL, &error) : NULL;
    lom_frame whole = { .image = NULL };
    const lom_frame_desc desc = { .width = WIDTH, .height = HEIGHT, .frame = frame };
    CHECK(renderer != NULL && lom_render_frame(renderer, &desc, &whole, &error), "%s: %s", name, error.text);
    if (whole.image != NULL && whole.image->format != LOM_FORMAT_RGB32F) {
        if (!is_exhaustive())
            check_rectangle(renderer, whole.image, name, frame, at);
        for (int i = 0; i < 20 && is_exhaustive(); i++)
            check_rectangle(renderer, whole.image, name, frame,
                            (lom_rect){ i % 5 * (WIDTH / 5), i / 5 * (HEIGHT / 4), WIDTH / 5, HEIGHT / 4 });
    }
    lom_free_image(whole.image);
    lom_free_renderer(renderer);
    lom_free_scene(scene);
}

static void explained_pixels_are_the_pictures(void)
{
    static const struct {
        const char *name;
        int frame;
        lom_rect at; /* empty: in the long test alone */
    } scenes[] = {
        { "lake", 0, { 140, 90, 24, 20 } },  { "tarn", 3, { 100, 110, 24, 12 } }, { "cove", 0, { 150, 100, 20, 14 } },
        { "sunset", 0, { 40, 60, 16, 12 } }, { "clouds-30", 0, { 0, 0, 0, 0 } },  { "clouds-100", 0, { 0, 0, 0, 0 } },
        { "cumulus", 0, { 0, 0, 0, 0 } },    { "falls", 0, { 0, 0, 0, 0 } },      { "flight", 40, { 0, 0, 0, 0 } },
        { "gale", 0, { 0, 0, 0, 0 } },       { "lagoon", 0, { 0, 0, 0, 0 } },     { "mackerel", 0, { 0, 0, 0, 0 } },
        { "reef", 0, { 0, 0, 0, 0 } },       { "river", 0, { 0, 0, 0, 0 } },      { "storm", 0, { 0, 0, 0, 0 } },
        { "surf", 0, { 0, 0, 0, 0 } },       { "swell", 0, { 0, 0, 0, 0 } },      { "wake", 0, { 0, 0, 0, 0 } },
        { "tradewind", 0, { 0, 0, 0, 0 } },
    };
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++)
        if (is_exhaustive() || scenes[i].at.width != 0)
            check_scene(scenes[i].name, scenes[i].frame, scenes[i].at);
    CHECK(checked > (is_exhaustive() ? 1000000u : 1000u), "%zu pixels", checked);
    printf("  %zu pixels\n", checked);
}

/* ---- following ---- */

/* Whether one lookup of the pixel leads to a texel of this name, whose record ends with what the lookup read. */
static bool leads_to(const lom_explanation *x, const char *name)
{
    bool found = false;
    for (size_t i = 0; i < x->count; i++)
        for (const lom_pass_record *pass = x->item[i].record->passes; pass != NULL; pass = pass->next)
            for (const lom_draw_record *draw = pass->draws; draw != NULL; draw = draw->next)
                for (const lom_triangle_record *t = draw->triangles; t != NULL; t = t->next)
                    for (const lom_note_record *n = t->fragment.notes; n != NULL; n = n->next) {
                        const lom_explained *to = n->texture != NULL ? lom_followed(x, pass->number, n) : NULL;
                        if (to == NULL)
                            continue;
                        const lom_pass_record *last = to->record->passes;
                        while (last->next != NULL)
                            last = last->next;
                        CHECK(last->number < pass->number && to->verdict[0] != 0);
                        if (to->record->format != LOM_FORMAT_RGBA8_SRGB)
                            CHECK(last->end[0] == lom_main_tap(n)->color[0], "%s: %g, %g", to->name,
                                  (double)last->end[0], (double)lom_main_tap(n)->color[0]);
                        found |= strcmp(to->name, name) == 0;
                    }
    return found;
}

static void water_leads_to_its_pictures_and_ground_to_its_shadow(void)
{
    lom_error error = { .code = LOM_OK };
    lom_scene *scene = lom_read_scene("assets/scenes/lake.toml", NULL, 0, &error);
    lom_renderer *renderer = lom_create_renderer(scene, NULL, &error);
    CHECK(renderer != NULL, "%s", error.text);
    lom_explain_desc desc = { .frame = { .width = WIDTH, .height = HEIGHT }, .x = 160, .y = 150, .follow = 3 };
    for (int round = 0; round < 2; round++) { /* the same a second time: nothing is left of the first */
        lom_explanation *x = lom_explain(renderer, &desc, &error);
        CHECK(x != NULL && x->item[0].owner != NULL, "%s", error.text);
        CHECK(leads_to(x, "reflection") && leads_to(x, "refraction"));
        CHECK(strstr(x->item[0].verdict, "lom_lake_shader") != NULL, "%s", x->item[0].verdict);
        size_t deep = 0;
        for (size_t i = 0; i < x->count; i++)
            deep += x->item[i].depth >= 2;
        CHECK(deep > 0, "nothing is followed through two pictures");
        lom_free_explanation(renderer, x);
    }
    desc.follow = 0;
    lom_explanation *alone = lom_explain(renderer, &desc, &error);
    CHECK(alone->count == 1);
    lom_free_explanation(renderer, alone);
    desc.x = WIDTH;
    CHECK(lom_explain(renderer, &desc, &error) == NULL && strstr(error.text, "320,150 does not lie in") != NULL);
    lom_free_renderer(renderer);
    lom_free_scene(scene);
}

/* The eye is 17.5 m high, the sea's level 0, the tarn's 10.3: each mirror has the eye beyond its own water. */
static void each_water_mirrors_at_its_level(void)
{
    static const struct {
        int x, y;
        double eye;
    } cases[] = { { 160, 58, -17.5 }, { 160, 110, 2 * 10.3 - 17.5 } };
    lom_error error = { .code = LOM_OK };
    lom_scene *scene = lom_read_scene("assets/scenes/features/waters.toml", NULL, 0, &error);
    lom_renderer *renderer = lom_create_renderer(scene, NULL, &error);
    CHECK(renderer != NULL, "%s", error.text);
    for (int i = 0; i < 2; i++) {
        const lom_explain_desc desc = {
            .frame = { .width = WIDTH, .height = HEIGHT }, .x = cases[i].x, .y = cases[i].y, .follow = 1
        };
        lom_explanation *x = lom_explain(renderer, &desc, &error);
        int mirrors = 0;
        for (size_t k = 1; x != NULL && k < x->count; k++)
            if (strncmp(x->item[k].name, "reflection", 10) == 0) {
                mirrors++;
                CHECK(fabs(x->item[k].eye.y - cases[i].eye) < 1e-9, "%s: the eye at %g, not %g", x->item[k].name,
                      x->item[k].eye.y, cases[i].eye);
            }
        CHECK(mirrors > 0, "%s", x != NULL ? x->item[0].verdict : error.text);
        lom_free_explanation(renderer, x);
    }
    lom_free_renderer(renderer);
    lom_free_scene(scene);
}

/* ---- edges ---- */

static int code_at(const lom_image *image, int x, int y, int channel)
{
    const uint8_t *pixel = lom_image_pixel(image, x, y, 0);
    return pixel[channel];
}

static double linear_light(int code)
{
    const double s = code / 255.0;
    return s <= 0.04045 ? s / 12.92 : pow((s + 0.055) / 1.055, 2.4);
}

static double srgb_code(double light)
{
    return 255 * (light <= 0.0031308 ? 12.92 * light : 1.055 * pow(light, 1 / 2.4) - 0.055);
}

/* The parts of its neighbours that a pixel's record tells, and that what it is filtered from is kept; NULL: no edge. */
static const float *find_parts(const lom_pixel_record *pixel)
{
    const float *parts = NULL;
    const lom_pass_record *pass = pixel->passes;
    CHECK(pass->draws != NULL && !pass->filters && strcmp(pass->label, "scene") == 0);
    while (!pass->filters && pass->next != NULL)
        pass = pass->next;
    CHECK(pass->filters && pass->next == NULL && strcmp(pass->label, "edges") == 0);
    for (const lom_note_record *n = pass->draws->triangles->fragment.notes; n != NULL; n = n->next)
        parts = n->kind == LOM_NOTE_VALUE ? n->value : parts;
    return parts;
}

static lom_image *draw_river(const char *edges, lom_scene **scene, lom_renderer **renderer)
{
    const char *const set[] = { "quality.clouds=off", edges };
    lom_error error = { .code = LOM_OK };
    lom_frame frame = { .image = NULL };
    *scene = lom_read_scene("assets/scenes/river.toml", set, 2, &error);
    *renderer = lom_create_renderer(*scene, NULL, &error);
    CHECK(*renderer != NULL, "%s", error.text);
    const lom_frame_desc desc = { .width = WIDTH, .height = HEIGHT };
    CHECK(lom_render_frame(*renderer, &desc, &frame, &error), "%s", error.text);
    return frame.image;
}

/* The picture with sharp edges, mixed by the parts that are told, is the one with smooth edges. */
static void edges_are_the_mix_that_is_told(void)
{
    const lom_rect at = { 50, 40, 24, 16 };
    static const int dx[] = { 1, -1, 0, 0 }, dy[] = { 0, 0, 1, -1 };
    lom_scene *scene[2];
    lom_renderer *renderer[2];
    lom_image *sharp = draw_river("output.edges=sharp", &scene[0], &renderer[0]);
    lom_image *smooth = draw_river("output.edges=smooth", &scene[1], &renderer[1]);
    const lom_explain_desc desc = {
        .frame = { .width = WIDTH, .height = HEIGHT }, .x = at.x, .y = at.y, .width = at.width, .height = at.height
    };
    lom_error error = { .code = LOM_OK };
    lom_explanation *x = lom_explain(renderer[1], &desc, &error);
    CHECK(x != NULL && x->item[0].owner != NULL, "%s", error.text);
    int mixed = 0;
    for (int i = 0; i < at.width * at.height; i++) {
        const int column = at.x + i % at.width, row = at.y + i / at.width;
        const lom_pixel_record *first = x->item[0].record;
        const float *part = find_parts(
            lom_watched_pixel(lom_renderer_device(renderer[1]), 0, first->x + i % at.width, first->y + i / at.width));
        for (int c = 0; c < 3 && part != NULL; c++) {
            double light = linear_light(code_at(sharp, column, row, c)), beside = 0;
            light *= 1 - ((double)part[0] + (double)part[1] + (double)part[2] + (double)part[3]);
            for (int k = 0; k < 4; k++)
                beside += (double)part[k] * linear_light(code_at(sharp, column + dx[k], row + dy[k], c));
            const int code = code_at(smooth, column, row, c);
            CHECK(fabs(srgb_code(light + beside) - code) <= 0.51, "pixel %d,%d: %g, is %d", column, row,
                  srgb_code(light + beside), code);
        }
        mixed += part != NULL && part[0] + part[1] + part[2] + part[3] > 0;
    }
    CHECK(mixed > 40, "%d pixels", mixed);
    lom_free_explanation(renderer[1], x);
    for (int i = 0; i < 2; i++) {
        lom_free_image(i == 0 ? sharp : smooth);
        lom_free_renderer(renderer[i]);
        lom_free_scene(scene[i]);
    }
}

static void a_verdict_tells_of_the_neighbours(void)
{
    lom_error error = { .code = LOM_OK };
    lom_scene *scene = lom_read_scene("assets/scenes/river.toml", NULL, 0, &error);
    lom_renderer *renderer = lom_create_renderer(scene, NULL, &error);
    const lom_explain_desc desc = { .frame = { .width = WIDTH, .height = HEIGHT }, .x = 58, .y = 48, .follow = 1 };
    lom_explanation *x = lom_explain(renderer, &desc, &error);
    CHECK(x != NULL && strstr(x->item[0].verdict, "pine.obj") != NULL &&
              strstr(x->item[0].verdict, "wrote this. Rejected") != NULL &&
              strstr(x->item[0].verdict, "Its edge is smoothed: 17.9 % of its light is the left neighbour's.") != NULL,
          "%s", x != NULL ? x->item[0].verdict : error.text);
    for (size_t i = 1; x != NULL && i < x->count; i++)
        CHECK(x->item[i].texture != x->item[0].filtered, "the picture before its edges are smooth is not followed");
    lom_free_explanation(renderer, x);
    lom_free_renderer(renderer);
    lom_free_scene(scene);
}

int main(int argc, char **argv)
{
    RUN(explained_pixels_are_the_pictures);
    RUN(each_water_mirrors_at_its_level);
    RUN(edges_are_the_mix_that_is_told);
    RUN(a_verdict_tells_of_the_neighbours);
    RUN(water_leads_to_its_pictures_and_ground_to_its_shadow);
    return check_result();
}
