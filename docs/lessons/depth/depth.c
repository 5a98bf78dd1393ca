/* Lesson 6. Which is nearer: depth OUT.png
 * In: plates in pairs, 10 m to 10 km away, a blue one 1 % of its distance behind each red one. Out: a picture, left with
 * 16-bit depth that grows from 0 at the near plane to 1 at a far plane, right with 32-bit floats that fall from 1 at the
 * near plane to 0 infinitely far away. From here on lessons draw with the library: a vertex function and a fragment
 * function in C make a shader, and lom_draw does the rest. Both work on LOM_LANES vertices or pixels at once. */
#include <lom/pipeline.h>
#include <lom/geometry.h>

#include <stdio.h>

enum { WIDTH = 320, HEIGHT = 180, PLATES = 7 };

struct uniforms { /* the same for the whole draw */
    lom_matrix_uniform to_clip;
    float color[3];
};

static void place(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct uniforms *u = uniforms;
    out->position =
        lom_transform4(&u->to_clip, (lom_float3){ in->attribute[0].x, in->attribute[0].y, in->attribute[0].z });
}

static void paint(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct uniforms *u = uniforms;
    (void)in;
    out->color[0] =
        (lom_float4){ lom_splat(u->color[0]), lom_splat(u->color[1]), lom_splat(u->color[2]), lom_splat(1) };
}

LOM_SHADER(lesson_depth, place, paint, .attributes = 1, .colors = 1, .uniforms_size = sizeof(struct uniforms))

/* A slanted square whose middle is `distance` metres ahead, as large as seems the same from the eye. */
static void draw_plate(lom_device *device, const lom_draw_desc *how, const lom_mat4 *lens, double distance,
                       double column, const float color[3])
{
    static const float square[6][3] = { { -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 },
                                        { -1, -1, 0 }, { 1, 1, 0 },  { -1, 1, 0 } };
    double size = 0.045 * distance;
    lom_mat4 model = lom_model_matrix((lom_vec3){ column * distance, 0, -distance }, (lom_vec3){ -0.5, 0.4, 0 },
                                      (lom_vec3){ size, 5 * size, 1 });
    lom_mat4 to_clip = lom_multiply(lens, &model);
    struct uniforms u = { lom_round_matrix(&to_clip), { color[0], color[1], color[2] } };
    lom_draw_desc draw = *how;
    draw.shader = &lesson_depth;
    draw.uniforms = &u;
    draw.attribute[0] = (lom_attribute){ square, sizeof square, 12, LOM_ATTRIBUTE_FLOAT3 };
    draw.count = 6;
    lom_draw(device, &draw);
}

static void draw_plates(lom_device *device, const lom_draw_desc *how, const lom_mat4 *lens)
{
    static const float red[3] = { 0.8f, 0.1f, 0.05f }, blue[3] = { 0.05f, 0.15f, 0.6f };
    for (int i = 0; i < PLATES; i++) {
        double distance = 10 * lom_double_pow(10, i / 2.0), column = 0.12 * (i - (PLATES - 1) / 2.0);
        draw_plate(device, how, lens, 1.01 * distance, column, blue);
        draw_plate(device, how, lens, distance, column, red); /* nearer: the test has to let it through everywhere */
    }
}

static bool draw_halves(lom_device *device, lom_texture *picture)
{
    lom_texture_desc size = { .width = WIDTH, .height = HEIGHT, .format = LOM_FORMAT_DEPTH16 };
    lom_texture *coarse = lom_make_texture(device, &size);
    size.format = LOM_FORMAT_DEPTH32F;
    lom_texture *fine = lom_make_texture(device, &size);
    const double field_of_view = 0.9, aspect = (WIDTH / 2.0) / HEIGHT, near_plane = 0.5;

    lom_mat4 lens = lom_perspective_gl(field_of_view, aspect, near_plane, 20000);
    lom_begin_pass(device, &(lom_pass_desc){ .color = { picture },
                                             .depth = coarse,
                                             .clip_range = LOM_CLIP_MINUS_W_TO_W,
                                             .clear_color = { { 0.5f, 0.6f, 0.7f, 1 } },
                                             .clear_depth = 1,
                                             .viewport = { 0, 0, WIDTH / 2, HEIGHT } });
    draw_plates(device, &(lom_draw_desc){ .depth_compare = LOM_COMPARE_LESS }, &lens);
    lom_end_pass(device);

    lens = lom_perspective(field_of_view, aspect, near_plane);
    lom_begin_pass(device, &(lom_pass_desc){ .color = { picture },
                                             .color_load = { LOM_LOAD_KEEP },
                                             .depth = fine,
                                             .viewport = { WIDTH / 2, 0, WIDTH / 2, HEIGHT } });
    draw_plates(device, &(lom_draw_desc){ 0 }, &lens);
    return lom_end_pass(device);
}

int main(int argc, char **argv)
{
    lom_error error = { .code = LOM_OK };
    lom_device *device = lom_open_device(&(lom_device_desc){ 0 });
    lom_texture *picture = lom_make_texture(
        device, &(lom_texture_desc){ .width = WIDTH, .height = HEIGHT, .format = LOM_FORMAT_RGBA8_SRGB });
    lom_image *image = draw_halves(device, picture) ? lom_read_texture(picture, 0, 0, &error) : NULL;
    bool done = argc == 2 && image != NULL && lom_write_image(argv[1], NULL, image, &error);
    if (!done)
        fprintf(stderr, "depth: nothing was written; usage: depth OUT.png. %s %s\n", lom_device_error(device)->text,
                error.text);
    lom_free_image(image);
    lom_close_device(device);
    return done ? 0 : 2;
}
