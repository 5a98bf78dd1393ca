/* Proves that a program which draws by a device, without a renderer, is shown stage by stage and explained as a scene is:
 * which pixels a triangle covers, what a pixel looked up in a picture that an earlier pass drew, and what fails. */
#include "check.h"

#include <lom/lom.h>

enum { SIZE = 64 };

struct uniforms {
    const lom_texture *seen;
};

static void place(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    (void)uniforms;
    out->position = (lom_float4){ in->attribute[0].x, in->attribute[0].y, lom_splat(0.5f), lom_splat(1) };
}

static void paint_red(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)in, (void)uniforms;
    out->color[0] = (lom_float4){ lom_splat(1), lom_splat(0), lom_splat(0), lom_splat(1) };
}

/* The same pixel of another picture. */
static void paint_seen(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct uniforms *u = uniforms;
    out->color[0] = lom_sample(u->seen, in->x * (1.0f / SIZE), in->y * (1.0f / SIZE), lom_splat(0));
}

LOM_SHADER(red, place, paint_red, .attributes = 1, .colors = 1)
LOM_SHADER(seen, place, paint_seen, .attributes = 1, .colors = 1, .reads_position = true,
           .uniforms_size = sizeof(struct uniforms))

struct program {
    lom_device *device;
    lom_texture *first, *second;
    bool fails;
};

/* A triangle over the half of a window where x < y, counted from the top left; and all of a window that shows the first. */
static lom_image *draw_program(void *context, lom_error *error)
{
    static const float half[3][2] = { { -1, 1 }, { -1, -1 }, { 1, -1 } },
                       all[3][2] = { { -1, 3 }, { -1, -1 }, { 3, -1 } };
    const struct program *p = context;
    const struct uniforms u = { p->first };
    lom_draw_desc draw = { .shader = &red, .count = 3 };
    draw.attribute[0] = (lom_attribute){ half, sizeof half, 8, LOM_ATTRIBUTE_FLOAT2 };
    lom_begin_pass(p->device, &(lom_pass_desc){ .color = { p->first }, .label = "half" });
    lom_draw(p->device, &draw);
    lom_end_pass(p->device);
    draw.shader = &seen;
    draw.uniforms = &u;
    draw.attribute[0].data = all;
    lom_begin_pass(p->device, &(lom_pass_desc){ .color = { p->second }, .label = "all" });
    lom_draw(p->device, &draw);
    lom_end_pass(p->device);
    return p->fails ? NULL : lom_read_texture(p->second, 0, 0, error);
}

static lom_drawing open_program(struct program *p)
{
    const lom_texture_desc size = { .width = SIZE,
                                    .height = SIZE,
                                    .format = LOM_FORMAT_RGBA8_SRGB,
                                    .sampler = { .wrap_s = LOM_WRAP_CLAMP, .wrap_t = LOM_WRAP_CLAMP } };
    *p = (struct program){ .device = lom_open_device(&(lom_device_desc){ .threads = 1 }) };
    p->first = lom_make_texture(p->device, &size);
    p->second = lom_make_texture(p->device, &size);
    return (lom_drawing){ p->device, p, draw_program };
}

static const lom_stage_picture *find(const lom_stage_pictures *pictures, const char *name)
{
    static const lom_stage_picture none;
    for (size_t i = 0; i < pictures->count; i++)
        if (strcmp(pictures->picture[i].name, name) == 0)
            return &pictures->picture[i];
    CHECK(false, "no picture \"%s\"", name);
    return &none;
}

static void what_a_program_draws_has_pictures(void)
{
    lom_error error = { .code = LOM_OK };
    struct program p;
    const lom_drawing drawing = open_program(&p);
    lom_image *whole = draw_program(&p, NULL);
    lom_stage_pictures *pictures = lom_picture_drawing(&drawing, NULL, &error);
    CHECK(pictures != NULL && whole != NULL, "%s", error.text);
    if (pictures != NULL && whole != NULL) {
        const lom_image *coverage = find(pictures, "coverage")->image, *last = find(pictures, "final")->image;
        CHECK(strcmp(pictures->pass, "half") == 0 && pictures->plan.count == 0);
        CHECK(memcmp(whole->pixels, last->pixels, lom_image_size(whole)) == 0);
        int zoom = coverage->width / SIZE;
        const uint8_t *none = lom_image_pixel(coverage, (SIZE - 1) * zoom, 0, 0);
        for (int x = 0; x < SIZE; x++)
            for (int y = 0; y < SIZE; y++) {
                const uint8_t *c = lom_image_pixel(coverage, x * zoom, y * zoom, 0);
                CHECK(x == y || (memcmp(c, none, 3) != 0) == (x < y), "%d,%d", x, y); /* x = y lies upon the edge */
            }
        CHECK(find(pictures, "pass-all")->image != NULL);
    }
    lom_free_image(whole);
    lom_free_stage_pictures(pictures);
    CHECK(lom_picture_drawing(&drawing, "mirror", &error) == NULL && strstr(error.text, "half, all") != NULL, "%s",
          error.text);
    p.fails = true;
    error = (lom_error){ .code = LOM_OK };
    CHECK(lom_picture_drawing(&drawing, NULL, &error) == NULL && error.text[0] != 0);
    lom_close_device(p.device);
}

static void what_a_program_draws_is_explained(void)
{
    lom_error error = { .code = LOM_OK };
    struct program p;
    const lom_drawing drawing = open_program(&p);
    for (int i = 0; i < 2; i++) {
        int x = i == 0 ? 10 : 50, y = i == 0 ? 50 : 10;
        lom_explanation *e = lom_explain_drawing(&drawing, p.second, x, y, 2, &error);
        CHECK(e != NULL && e->count == 2 && e->width == SIZE, "%s", error.text);
        if (e == NULL)
            continue;
        CHECK(e->item[0].owner != NULL && e->item[0].owner->draw->desc.shader == &seen);
        CHECK(e->item[1].texture == p.first && e->item[1].x == x && e->item[1].y == y && e->item[1].depth == 1);
        CHECK((e->item[1].owner != NULL) == (i == 0), "%s", e->item[1].verdict);
        CHECK(e->frame.image->width == 1 && e->frame.image->pixels[0] == (i == 0 ? 255 : 0));
        lom_free_drawing_explanation(&drawing, e);
    }
    CHECK(lom_explain_drawing(&drawing, p.second, SIZE, 0, 0, &error) == NULL && error.text[0] != 0);
    lom_free_drawing_explanation(&drawing, NULL);
    lom_close_device(p.device);
}

int main(int argc, char **argv)
{
    RUN(what_a_program_draws_has_pictures);
    RUN(what_a_program_draws_is_explained);
    return check_result();
}
