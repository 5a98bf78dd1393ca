/* Lesson 7. Textures and their levels: textures OUT.png
 * In: a floor of tiles that goes to the horizon. Out: a picture in three strips: the nearest texel of the finest level;
 * four texels of the finest level; eight texels of the two levels that fit. */
#include <lom/geometry.h>
#include <lom/pipeline.h>

#include <stdio.h>

enum { WIDTH = 320, HEIGHT = 180, SIZE = 64, STRIPS = 3 };
enum { S, T }; /* the varyings */

struct uniforms {
    lom_matrix_uniform to_clip;
    const lom_texture *texture;
};

static void place(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct uniforms *u = uniforms;
    lom_float3 at = { in->attribute[0].x, in->attribute[0].y, in->attribute[0].z };
    out->position = lom_transform4(&u->to_clip, at);
    out->varying[S] = at.x * 0.5f; /* the pattern repeats every two metres */
    out->varying[T] = at.z * 0.5f;
}

static void paint(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct uniforms *u = uniforms;
    lom_float lod = lom_lod(u->texture, in, S, T); /* log2 of how many texels the pixel goes over */
    out->color[0] = lom_sample(u->texture, in->varying[S], in->varying[T], lod);
}

LOM_SHADER(lesson_textures, place, paint, .attributes = 1, .varyings = 2, .reads = 1u << S | 1u << T,
           .differentiates = 1u << S | 1u << T, .colors = 1, .uniforms_size = sizeof(struct uniforms))

/* Two light and two dark tiles with a thin seam around each. */
static void make_pattern(uint8_t pixels[SIZE * SIZE][4])
{
    static const uint8_t colors[3][4] = { { 235, 220, 190, 255 }, { 40, 60, 70, 255 }, { 10, 10, 10, 255 } };
    for (int i = 0; i < SIZE * SIZE; i++) {
        int x = i % SIZE, y = i / SIZE, half = SIZE / 2;
        bool seam = x % half < 2 || y % half < 2;
        memcpy(pixels[i], colors[seam ? 2 : (x / half + y / half) % 2], 4);
    }
}

static bool draw_strips(lom_device *device, lom_texture *picture)
{
    static const lom_filter filter[STRIPS] = { LOM_FILTER_NEAREST, LOM_FILTER_LINEAR, LOM_FILTER_LINEAR_MIPMAP_LINEAR };
    static const float floor[4][3] = { { -400, 0, 2 }, { 400, 0, 2 }, { 400, 0, -800 }, { -400, 0, -800 } };
    static uint8_t pixels[SIZE * SIZE][4];
    make_pattern(pixels);
    lom_mat4 view = lom_look_at((lom_vec3){ 0, 1.2, 0 }, (lom_vec3){ 1.5, 0.6, -5 }, (lom_vec3){ 0, 1, 0 });
    lom_mat4 lens = lom_perspective(0.9, (double)WIDTH / HEIGHT, 0.1), to_clip = lom_multiply(&lens, &view);
    lom_begin_pass(device, &(lom_pass_desc){ .color = { picture }, .clear_color = { { 0.4f, 0.55f, 0.75f, 1 } } });
    for (int i = 0; i < STRIPS; i++) {
        struct uniforms u = { .to_clip = lom_round_matrix(&to_clip) };
        u.texture = lom_make_texture(device, &(lom_texture_desc){ .width = SIZE,
                                                                  .height = SIZE,
                                                                  .format = LOM_FORMAT_RGBA8_SRGB,
                                                                  .pixels = pixels,
                                                                  .mips = LOM_MIPS_ALL,
                                                                  .sampler = { .minify = filter[i] } });
        lom_draw(device, &(lom_draw_desc){ .shader = &lesson_textures,
                                           .uniforms = &u,
                                           .attribute = { { floor, sizeof floor, 12, LOM_ATTRIBUTE_FLOAT3 } },
                                           .count = 4,
                                           .topology = LOM_TRIANGLE_FAN,
                                           .scissor = { WIDTH * i / STRIPS, 0, WIDTH / STRIPS - 1, HEIGHT } });
    }
    return lom_end_pass(device);
}

int main(int argc, char **argv)
{
    lom_error error = { .code = LOM_OK };
    lom_device *device = lom_open_device(&(lom_device_desc){ 0 });
    lom_texture *picture = lom_make_texture(
        device, &(lom_texture_desc){ .width = WIDTH, .height = HEIGHT, .format = LOM_FORMAT_RGBA8_SRGB });
    lom_image *image = draw_strips(device, picture) ? lom_read_texture(picture, 0, 0, &error) : NULL;
    bool done = argc == 2 && image != NULL && lom_write_image(argv[1], NULL, image, &error);
    if (!done)
        fprintf(stderr, "textures: nothing was written; usage: textures OUT.png. %s %s\n",
                lom_device_error(device)->text, error.text);
    lom_free_image(image);
    lom_close_device(device);
    return done ? 0 : 2;
}
