/* Proves that the levels and aprons which workers make of an attachment together are those that one makes of a texture
 * of the same pixels, texel by texel, beyond the edges too: odd and even sizes, every storage, every wrap. */
#include "image/texture.h"
#include "stage.h"

LOM_SHADER(values, place_values, show_values, .attributes = 2, .varyings = 4, .reads = 15, .colors = 1)

static vertex corners[12];

static void draw_scene(lom_device *device, lom_texture *target)
{
    for (int k = 0; k < 12; k++) {
        corners[k] = (vertex){ .position = { random_float(-2, 2), random_float(-2, 2), 0.5f, 1 } };
        for (int i = 0; i < 4; i++)
            corners[k].value[i] = random_float(0, 1);
    }
    lom_begin_pass(device, &(lom_pass_desc){ .color = { target }, .clear_color = { { 0.1f, 0.6f, 0.9f, 1 } } });
    lom_draw_desc draw = draw_of(&values, corners, 12);
    lom_draw(device, &draw);
    CHECK(lom_end_pass(device), "%s", lom_device_error(device)->text);
}

/* All texels of a level and one around them. */
static void compare_levels(const lom_texture *a, const lom_texture *b, int level)
{
    const lom_level *l = &a->level[level];
    size_t row = ((size_t)l->width + 2) * lom_texel_size(a);
    for (int y = -1; y <= l->height; y++)
        CHECK(memcmp(lom_texel(a, level, -1, y, 0), lom_texel(b, level, -1, y, 0), row) == 0,
              "row %d of level %d of %dx%d, format %d, wrap %d", y, level, a->level[0].width, a->level[0].height,
              (int)a->format, (int)a->sampler.wrap_s);
}

static void finish_as(lom_device *device, int width, int height, lom_format format, lom_wrap wrap)
{
    lom_texture_desc desc = { .width = width, .height = height, .format = format, .mips = LOM_MIPS_ALL };
    desc.sampler = (lom_sampler_desc){ .wrap_s = wrap, .wrap_t = wrap, .border = { 0.2f, 0.4f, 0.6f, 0.8f } };
    lom_texture *target = lom_make_texture(device, &desc);
    draw_scene(device, target);
    lom_image *pixels = lom_read_texture(target, 0, 0, NULL);
    desc.pixels = pixels->pixels;
    lom_texture *copy = lom_create_texture(&desc, NULL);
    for (int level = 0; level < target->level_count; level++)
        compare_levels(target, copy, level);
    lom_free_texture(copy);
    lom_free_image(pixels);
    lom_release_texture(device, target);
}

static void levels_and_aprons_are_those_of_a_texture(void)
{
    static const lom_format formats[] = { LOM_FORMAT_RGBA8, LOM_FORMAT_RGBA8_SRGB, LOM_FORMAT_R32F,
                                          LOM_FORMAT_RGBA32F };
    for (int threads = 1; threads <= 3; threads++) {
        lom_device *device = open_device((lom_device_desc){ .threads = threads });
        for (int f = 0; f < 4; f++) {
            for (int wrap = 0; wrap < LOM_WRAP_COUNT; wrap++)
                finish_as(device, 37 + wrap, 20 + threads, formats[f], (lom_wrap)wrap);
            finish_as(device, 514, 402, formats[f], LOM_WRAP_CLAMP);
            finish_as(device, 531, 401, formats[f], LOM_WRAP_REPEAT);
        }
        lom_close_device(device);
    }
}

int main(int argc, char **argv)
{
    RUN(levels_and_aprons_are_those_of_a_texture);
    return check_result();
}
