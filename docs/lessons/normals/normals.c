/* Lesson 8. The normal matrix: normals OUT.png
 * In: a sphere that is flattened and tilted. Out: a picture of it, twice: left its normals go through the same matrix as its
 * points, right through that matrix's inverse transpose. The upper row shows the normals as colours, the lower one light. */
#include <lom/geometry.h>
#include <lom/pipeline.h>

#include <stdio.h>

enum { WIDTH = 320, HEIGHT = 180 };
enum { NORMAL_X, NORMAL_Y, NORMAL_Z, VARYINGS };

struct uniforms {
    lom_matrix_uniform to_clip, to_world;
    float to_light[3];
    bool shows_normals;
};

static void place(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct uniforms *u = uniforms;
    const lom_float4 *a = in->attribute;
    out->position = lom_transform4(&u->to_clip, (lom_float3){ a[0].x, a[0].y, a[0].z });
    lom_float3 normal = lom_rotate3(&u->to_world, (lom_float3){ a[1].x, a[1].y, a[1].z });
    out->varying[NORMAL_X] = normal.x;
    out->varying[NORMAL_Y] = normal.y;
    out->varying[NORMAL_Z] = normal.z;
}

static void paint(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct uniforms *u = uniforms;
    lom_float3 n = lom_normalize3((lom_float3){ in->varying[NORMAL_X], in->varying[NORMAL_Y], in->varying[NORMAL_Z] });
    lom_float light = lom_max(lom_dot3(n, lom_splat3(u->to_light[0], u->to_light[1], u->to_light[2])), lom_splat(0));
    lom_float gray = 0.05f + 0.9f * light, one = lom_splat(1);
    out->color[0] = (lom_float4){ gray, gray, gray, one };
    if (u->shows_normals)
        out->color[0] = (lom_float4){ 0.5f + 0.5f * n.x, 0.5f + 0.5f * n.y, 0.5f + 0.5f * n.z, one };
}

LOM_SHADER(lesson_normals, place, paint, .attributes = 2, .varyings = VARYINGS, .reads = LOM_VARYINGS(0, VARYINGS),
           .colors = 1, .uniforms_size = sizeof(struct uniforms))

static void draw_sphere(lom_device *device, const lom_mesh *sphere, bool inverse_transpose, bool shows_normals)
{
    lom_mat4 view = lom_look_at((lom_vec3){ 0, 0, 5 }, (lom_vec3){ 0, 0, 0 }, (lom_vec3){ 0, 1, 0 });
    lom_mat4 lens = lom_perspective(0.5, (double)WIDTH / HEIGHT, 0.1), camera = lom_multiply(&lens, &view);
    lom_mat4 model = lom_model_matrix((lom_vec3){ 0, 0, 0 }, (lom_vec3){ 0.3, 0, 0.4 }, (lom_vec3){ 1.5, 0.4, 1.5 });
    lom_mat4 to_clip = lom_multiply(&camera, &model), normals = model;
    if (inverse_transpose)
        lom_normal_matrix(&model, &normals);
    struct uniforms u = {
        lom_round_matrix(&to_clip), lom_round_matrix(&normals), { 0.48f, 0.8f, 0.36f }, shows_normals
    };
    const lom_mesh_vertex *v = sphere->vertices;
    size_t stride = sizeof *v, size = sphere->vertex_count * stride;
    lom_draw(device, &(lom_draw_desc){ .shader = &lesson_normals,
                                       .uniforms = &u,
                                       .attribute = { { v->position, size, stride, LOM_ATTRIBUTE_FLOAT3 },
                                                      { v->normal, size - 12, stride, LOM_ATTRIBUTE_FLOAT3 } },
                                       .indices = sphere->indices,
                                       .count = sphere->index_count,
                                       .cull = LOM_CULL_BACK });
}

static bool draw_quarters(lom_device *device, lom_texture *picture, const lom_mesh *sphere)
{
    bool done = sphere != NULL;
    for (int i = 0; i < 4 && done; i++) { /* a pass a quarter: its viewport is where -1..1 comes to lie */
        lom_begin_pass(
            device, &(lom_pass_desc){ .color = { picture },
                                      .color_load = { i == 0 ? LOM_LOAD_CLEAR : LOM_LOAD_KEEP },
                                      .clear_color = { { 0.02f, 0.02f, 0.03f, 1 } },
                                      .viewport = { i % 2 * WIDTH / 2, i / 2 * HEIGHT / 2, WIDTH / 2, HEIGHT / 2 } });
        draw_sphere(device, sphere, i % 2 == 1, i < 2);
        done = lom_end_pass(device);
    }
    return done;
}

int main(int argc, char **argv)
{
    lom_error error = { .code = LOM_OK };
    lom_device *device = lom_open_device(&(lom_device_desc){ 0 });
    lom_mesh *sphere = lom_make_sphere(1, 64, 32, &error);
    lom_texture *picture = lom_make_texture(
        device, &(lom_texture_desc){ .width = WIDTH, .height = HEIGHT, .format = LOM_FORMAT_RGBA8_SRGB });
    lom_image *image = draw_quarters(device, picture, sphere) ? lom_read_texture(picture, 0, 0, &error) : NULL;
    bool done = argc == 2 && image != NULL && lom_write_image(argv[1], NULL, image, &error);
    if (!done)
        fprintf(stderr, "normals: nothing was written; usage: normals OUT.png. %s %s\n", lom_device_error(device)->text,
                error.text);
    lom_free_mesh(sphere);
    lom_free_image(image);
    lom_close_device(device);
    return done ? 0 : 2;
}
