/* Proves that what a pass draws into a layer of an array, a face of a cube or a level is what it draws into a 2D texture of
 * that size, texel by texel; that the levels and aprons which follow, across the seams of a cube too, are those of a texture
 * made of the same pixels; that no other layer and level changes; that a pass goes on with what a slice holds, and a pass's
 * depth has slices of its own; and that what no slice is, is refused. */
#include "image/texture.h"
#include "pipeline/device.h"
#include "stage.h"

LOM_SHADER(values, place_values, show_values, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .colors = 1)

static vertex corners[12];

/* Triangles that the seed says. */
static void draw_with(lom_device *device, const lom_pass_desc *pass, uint64_t seed)
{
    random_draws = seed;
    for (int k = 0; k < 12; k++) {
        corners[k] = (vertex){ .position = { random_float(-2, 2), random_float(-2, 2), random_float(0, 1), 1 } };
        for (int i = 0; i < 4; i++)
            corners[k].value[i] = random_float(0, 1);
    }
    lom_begin_pass(device, pass);
    lom_draw_desc draw = draw_of(&values, corners, 12);
    lom_draw(device, &draw);
    CHECK(lom_end_pass(device), "%s", lom_device_error(device)->text);
}

static void draw_slice(lom_device *device, lom_texture *target, lom_slice slice, lom_load_action load, uint64_t seed)
{
    draw_with(device,
              &(lom_pass_desc){ .color = { target },
                                .color_slice = { slice },
                                .color_load = { load },
                                .clear_color = { { 0.1f, 0.6f, 0.9f, 1 } } },
              seed);
}

static void compare_all(const lom_texture *a, const lom_texture *b, const char *what)
{
    for (int level = 0; level < a->level_count; level++)
        for (int layer = 0; layer < a->layers; layer++) {
            const lom_level *l = &a->level[level];
            size_t row = ((size_t)l->width + 2) * lom_texel_size(a);
            for (int y = -1; y <= l->height; y++)
                CHECK(memcmp(lom_texel(a, level, -1, y, layer), lom_texel(b, level, -1, y, layer), row) == 0,
                      "%s: row %d of level %d of layer %d, format %d", what, y, level, layer, (int)a->format);
        }
}

/* Each layer drawn twice, the second time over the first, in an order that is not theirs. */
static void draw_layers(lom_texture_kind kind, lom_format format, lom_mips mips, int threads)
{
    enum { SIZE = 37, MOST = 6 };
    static uint8_t pixels[MOST * SIZE * SIZE * 16];
    static const int order[MOST] = { 3, 0, 5, 1, 4, 2 };
    const int layers = kind == LOM_TEXTURE_CUBE ? 6 : 4;
    lom_device *device = open_device((lom_device_desc){ .threads = threads, .tile = 16 });
    lom_texture_desc desc = { .kind = kind,
                              .width = SIZE,
                              .height = SIZE,
                              .depth = kind == LOM_TEXTURE_CUBE ? 1 : layers,
                              .format = format,
                              .mips = mips };
    const lom_texture_desc flat = { .width = SIZE, .height = SIZE, .format = format };
    lom_texture *target = lom_make_texture(device, &desc);
    for (int i = 0; i < MOST; i++) {
        const lom_slice slice = { 0, order[i] };
        if (order[i] >= layers)
            continue;
        draw_slice(device, target, slice, LOM_LOAD_CLEAR, 100 + (uint64_t)i);
        draw_slice(device, target, slice, LOM_LOAD_KEEP, 200 + (uint64_t)i);
        lom_texture *alone = lom_make_texture(device, &flat);
        draw_slice(device, alone, (lom_slice){ 0, 0 }, LOM_LOAD_CLEAR, 100 + (uint64_t)i);
        draw_slice(device, alone, (lom_slice){ 0, 0 }, LOM_LOAD_KEEP, 200 + (uint64_t)i);
        lom_image *image = lom_read_texture(alone, 0, 0, NULL);
        memcpy(pixels + lom_image_size(image) * (size_t)order[i], image->pixels, lom_image_size(image));
        lom_free_image(image);
        lom_release_texture(device, alone);
    }
    desc.pixels = pixels;
    lom_texture *copy = lom_create_texture(&desc, NULL);
    CHECK(copy != NULL && copy->level_count == target->level_count);
    if (copy != NULL)
        compare_all(target, copy, kind == LOM_TEXTURE_CUBE ? "cube" : "array");
    lom_free_texture(copy);
    lom_close_device(device);
}

static void layers_and_faces_are_drawn_as_flat_textures(void)
{
    static const lom_format formats[] = { LOM_FORMAT_RGBA8, LOM_FORMAT_RGBA8_SRGB, LOM_FORMAT_R32F,
                                          LOM_FORMAT_RGBA32F };
    for (int f = 0; f < 4; f++)
        for (int mips = 0; mips < 2; mips++) {
            draw_layers(LOM_TEXTURE_CUBE, formats[f], mips ? LOM_MIPS_ALL : LOM_MIPS_NONE, 1 + f);
            draw_layers(LOM_TEXTURE_2D_ARRAY, formats[f], mips ? LOM_MIPS_ALL : LOM_MIPS_NONE, 3 - f % 3);
        }
}

/* A level has what a texture of its size gets; the levels around it keep what they have. */
static void a_level_alone_changes(void)
{
    static const lom_texture_kind kinds[] = { LOM_TEXTURE_2D, LOM_TEXTURE_2D_ARRAY, LOM_TEXTURE_CUBE };
    lom_device *device = open_device((lom_device_desc){ .threads = 2 });
    for (int k = 0; k < 3; k++) {
        const lom_texture_desc desc = { .kind = kinds[k],
                                        .width = 50,
                                        .height = 50,
                                        .mips = LOM_MIPS_ALL,
                                        .depth = kinds[k] == LOM_TEXTURE_2D_ARRAY ? 3 : 1 };
        const int layer = k == 0 ? 0 : 2;
        lom_texture *target = lom_make_texture(device, &desc);
        draw_slice(device, target, (lom_slice){ 0, layer }, LOM_LOAD_CLEAR, 7);
        lom_image *before[LOM_MAX_LEVELS], *after[LOM_MAX_LEVELS];
        for (int i = 0; i < target->level_count; i++)
            before[i] = lom_read_texture(target, i, -1, NULL);
        draw_slice(device, target, (lom_slice){ 2, layer }, LOM_LOAD_CLEAR, 8);
        lom_texture *alone = lom_make_texture(device, &(lom_texture_desc){ .width = 12, .height = 12 });
        draw_slice(device, alone, (lom_slice){ 0, 0 }, LOM_LOAD_CLEAR, 8);
        lom_image *expected = lom_read_texture(alone, 0, 0, NULL), *got = lom_read_texture(target, 2, layer, NULL);
        CHECK(memcmp(expected->pixels, got->pixels, lom_image_size(got)) == 0, "kind %d", k);
        for (int i = 0; i < target->level_count; i++) {
            after[i] = lom_read_texture(target, i, -1, NULL);
            const bool same = memcmp(before[i]->pixels, after[i]->pixels, lom_image_size(after[i])) == 0;
            CHECK(same == (i != 2), "kind %d: level %d", k, i);
            lom_free_image(before[i]);
            lom_free_image(after[i]);
        }
        lom_free_image(expected);
        lom_free_image(got);
        lom_release_texture(device, alone);
        lom_release_texture(device, target);
    }
    lom_close_device(device);
}

static void depths_have_slices_of_their_own(void)
{
    lom_device *device = open_device((lom_device_desc){ .threads = 2 });
    const lom_texture_desc flat = { .width = 40, .height = 40, .format = LOM_FORMAT_DEPTH32F };
    lom_texture_desc layered = flat;
    layered.kind = LOM_TEXTURE_2D_ARRAY;
    layered.depth = 3;
    lom_texture *depths = lom_make_texture(device, &layered), *depth = lom_make_texture(device, &flat);
    lom_texture *color = lom_make_texture(device, &(lom_texture_desc){ .width = 40, .height = 40 });
    lom_texture *cube =
        lom_make_texture(device, &(lom_texture_desc){ .kind = LOM_TEXTURE_CUBE, .width = 40, .height = 40 });
    draw_with(device, &(lom_pass_desc){ .color = { color }, .depth = depth }, 5);
    draw_with(
        device,
        &(lom_pass_desc){ .color = { cube }, .color_slice = { { 0, 4 } }, .depth = depths, .depth_slice = { 0, 2 } },
        5);
    lom_image *a = lom_read_texture(depth, 0, 0, NULL), *b = lom_read_texture(depths, 0, 2, NULL);
    lom_image *c = lom_read_texture(color, 0, 0, NULL), *d = lom_read_texture(cube, 0, 4, NULL);
    lom_image *e = lom_read_texture(depths, 0, 1, NULL);
    CHECK(memcmp(a->pixels, b->pixels, lom_image_size(a)) == 0);
    CHECK(memcmp(c->pixels, d->pixels, lom_image_size(c)) == 0);
    for (size_t i = 0; i < lom_image_size(e); i++)
        CHECK(e->pixels[i] == 0, "a layer beside it");
    lom_free_image(a);
    lom_free_image(b);
    lom_free_image(c);
    lom_free_image(d);
    lom_free_image(e);
    lom_close_device(device);
}

static void what_no_slice_is_is_refused(void)
{
    static const struct {
        lom_texture_desc desc;
        lom_slice slice;
        const char *says;
    } cases[] = { { { .width = 8, .height = 8 }, { 0, 1 }, "layer 1" },
                  { { .width = 8, .height = 8 }, { 1, 0 }, "level 1" },
                  { { .width = 8, .height = 8, .mips = LOM_MIPS_ALL }, { 4, 0 }, "level 4" },
                  { { .width = 8, .height = 8 }, { -1, 0 }, "level -1" },
                  { { .kind = LOM_TEXTURE_CUBE, .width = 8, .height = 8 }, { 0, 6 }, "layer 6" },
                  { { .kind = LOM_TEXTURE_2D_ARRAY, .width = 8, .height = 8, .depth = 3 }, { 0, 3 }, "layer 3" },
                  { { .kind = LOM_TEXTURE_3D, .width = 8, .height = 8, .depth = 3 }, { 0, 0 }, "array or a cube" },
                  { { .width = 8, .height = 8, .mips = LOM_MIPS_ALL, .samples = 4 }, { 1, 0 }, "keeps samples" },
                  { { .width = 8, .height = 8, .format = LOM_FORMAT_DEPTH24, .stencil = true, .mips = LOM_MIPS_ALL },
                    { 1, 0 },
                    "stencil" } };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        lom_device *device = open_device((lom_device_desc){ .threads = 1 });
        lom_texture *target = lom_make_texture(device, &cases[i].desc);
        CHECK(target != NULL, "%zu: %s", i, lom_device_error(device)->text);
        if (cases[i].desc.stencil)
            lom_begin_pass(device, &(lom_pass_desc){ .depth = target, .depth_slice = cases[i].slice });
        else
            lom_begin_pass(device, &(lom_pass_desc){ .color = { target }, .color_slice = { cases[i].slice } });
        CHECK(!lom_end_pass(device) && strstr(lom_device_error(device)->text, cases[i].says) != NULL, "%zu: %s", i,
              lom_device_error(device)->text);
        lom_close_device(device);
    }
}

int main(int argc, char **argv)
{
    RUN(layers_and_faces_are_drawn_as_flat_textures);
    RUN(a_level_alone_changes);
    RUN(depths_have_slices_of_their_own);
    RUN(what_no_slice_is_is_refused);
    return check_result();
}
