/* Proves that the levels and aprons which workers make of an attachment together are those that one makes of a texture
 * of the same pixels, texel by texel, beyond the edges too: odd and even sizes, every storage, every wrap; and that
 * stores past the caches change no byte. */
#include "image/texture.h"
#include "pipeline/device.h"
#include "stage.h"

LOM_SHADER(values, place_values, show_values, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .colors = 1)

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

/* A texture that was made of pixels keeps them decoded: after a pass has drawn into it, what it drew. */
static void what_is_drawn_is_decoded_again(void)
{
    static uint8_t pixels[37 * 20 * 4];
    lom_device *device = open_device((lom_device_desc){ .threads = 2 });
    lom_texture_desc desc = {
        .width = 37, .height = 20, .format = LOM_FORMAT_RGBA8_SRGB, .pixels = pixels, .mips = LOM_MIPS_ALL
    };
    lom_texture *target = lom_make_texture(device, &desc);
    draw_scene(device, target);
    lom_image *drawn = lom_read_texture(target, 0, 0, NULL);
    desc.pixels = drawn->pixels;
    lom_texture *copy = lom_create_texture(&desc, NULL);
    size_t size = target->texel_count * 4 * sizeof *target->decoded;
    CHECK(memcmp(drawn->pixels, pixels, sizeof pixels) != 0, "nothing was drawn");
    CHECK(target->decoded != NULL && memcmp(target->decoded, copy->decoded, size) == 0,
          "it shows what was there before");
    for (int level = 0; level < target->level_count; level++)
        compare_levels(target, copy, level);
    lom_free_texture(copy);
    lom_free_image(drawn);
    lom_close_device(device);
}

static const float *make_noise(void)
{
    enum { MOST = 6 * 300 * 300 * 4 };
    static float noise[MOST];
    random_draws = 5;
    for (size_t i = 0; i < MOST; i++)
        noise[i] = random_float(0, 1);
    return noise;
}

/* All of it, what lies around levels and slices and is never looked at aside: texels that samplers read. */
static void compare_made(const lom_texture *a, const lom_texture *b)
{
    const size_t decoded = a->fixed ? 2 * sizeof(uint32_t) : 4 * sizeof(float);
    CHECK(memcmp(a->texels, b->texels, a->texel_count * lom_texel_size(a)) == 0, "kind %d, format %d of %dx%d",
          (int)a->kind, (int)a->format, a->level[0].width, a->level[0].height);
    CHECK((a->decoded == NULL) == (b->decoded == NULL) &&
              (a->decoded == NULL || memcmp(a->decoded, b->decoded, a->texel_count * decoded) == 0),
          "kind %d, format %d, decoded", (int)a->kind, (int)a->format);
}

/* A texture of pixels, of every kind and of sizes that are and are not worth sharing, is what lom_create_texture makes. */
static void workers_make_textures(void)
{
    static const lom_texture_desc descs[] = {
        { .width = 256, .height = 512 },
        { .width = 37, .height = 21 },
        { .kind = LOM_TEXTURE_CUBE, .width = 256, .height = 256 },
        { .kind = LOM_TEXTURE_CUBE, .width = 33, .height = 33 },
        { .kind = LOM_TEXTURE_2D_ARRAY, .width = 300, .height = 200, .depth = 5 },
        { .kind = LOM_TEXTURE_3D, .width = 70, .height = 50, .depth = 60 },
    };
    static const lom_format formats[] = { LOM_FORMAT_RGBA8, LOM_FORMAT_RGBA8_SRGB, LOM_FORMAT_R32F,
                                          LOM_FORMAT_RGBA32F };
    const float *noise = make_noise();
    for (int threads = 1; threads <= 5; threads += 2) {
        lom_device *device = open_device((lom_device_desc){ .threads = threads });
        for (size_t i = 0; i < 4 * sizeof descs / sizeof *descs; i++) {
            lom_texture_desc desc = descs[i / 4];
            desc.format = formats[i % 4];
            desc.pixels = noise;
            desc.mips = LOM_MIPS_ALL;
            lom_texture *made = lom_make_texture(device, &desc);
            desc.sampler.filtering = made != NULL ? made->sampler.filtering : LOM_FILTERING_FLOAT;
            lom_texture *alone = lom_create_texture(&desc, NULL);
            CHECK(made != NULL && alone != NULL, "%s", lom_device_error(device)->text);
            if (made != NULL && alone != NULL)
                compare_made(made, alone);
            lom_free_texture(alone);
            lom_release_texture(device, made);
        }
        lom_close_device(device);
    }
}

/* The colours and depths of a scene, on a device whose caches hold so many bytes. */
static void draw_with_caches(size_t bytes, lom_format color, int width, lom_image *images[2])
{
    lom_device *device = open_device((lom_device_desc){ .threads = 2 });
    lom_texture *target =
        lom_make_texture(device, &(lom_texture_desc){ .width = width, .height = 150, .format = color });
    lom_texture *depth =
        lom_make_texture(device, &(lom_texture_desc){ .width = width, .height = 150, .format = LOM_FORMAT_DEPTH24 });
    device->cache_bytes = bytes;
    random_draws = 77;
    for (int k = 0; k < 12; k++) {
        corners[k] = (vertex){ .position = { random_float(-2, 2), random_float(-2, 2), random_float(0, 1), 1 } };
        for (int i = 0; i < 4; i++)
            corners[k].value[i] = random_float(0, 1);
    }
    lom_begin_pass(device,
                   &(lom_pass_desc){ .color = { target }, .depth = depth, .clear_color = { { 0.1f, 0.6f, 0.9f, 1 } } });
    lom_draw_desc draw = draw_of(&values, corners, 12);
    lom_draw(device, &draw);
    CHECK(lom_end_pass(device), "%s", lom_device_error(device)->text);
    images[0] = lom_read_texture(target, 0, 0, NULL);
    images[1] = lom_read_texture(depth, 0, 0, NULL);
    lom_close_device(device);
}

/* What is larger than the caches is stored past them: the same bytes. */
static void stores_past_the_caches_change_no_byte(void)
{
    static const lom_format formats[] = { LOM_FORMAT_RGBA8, LOM_FORMAT_RGBA8_SRGB, LOM_FORMAT_RGB8, LOM_FORMAT_R32F,
                                          LOM_FORMAT_RGBA32F };
    for (size_t f = 0; f < sizeof formats / sizeof formats[0]; f++)
        for (int width = 191; width <= 192; width++) {
            lom_image *within[2], *past[2];
            draw_with_caches((size_t)1 << 30, formats[f], width, within);
            draw_with_caches(1, formats[f], width, past);
            for (int i = 0; i < 2; i++) {
                CHECK(same_images(within[i], past[i]), "format %d, %d pixels wide, attachment %d", (int)formats[f],
                      width, i);
                lom_free_image(within[i]);
                lom_free_image(past[i]);
            }
        }
}

int main(int argc, char **argv)
{
    RUN(levels_and_aprons_are_those_of_a_texture);
    RUN(what_is_drawn_is_decoded_again);
    RUN(workers_make_textures);
    RUN(stores_past_the_caches_change_no_byte);
    return check_result();
}
