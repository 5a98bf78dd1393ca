/* Lesson 9. Lights and materials: lights OUT.png
 * In: a torus, one light. Out: a picture of the torus, four times: the ambient term alone, the diffuse one, the specular
 * one, and their sum, which is what a material looks like. */
#include <lom/geometry.h>
#include <lom/lanes_mathematics.h>
#include <lom/pipeline.h>

#include <stdio.h>

enum { WIDTH = 320, HEIGHT = 180 };
enum { NORMAL, WORLD = NORMAL + 3, VARYINGS = WORLD + 3 };
enum { AMBIENT = 1, DIFFUSE = 2, SPECULAR = 4 };

struct uniforms {
    lom_matrix_uniform to_clip, to_world; /* the model only turns, so it takes normals, too */
    float eye[3], to_light[3];
    float ambient[3], diffuse[3], specular[3]; /* the material, times the light */
    int shininess, terms;
};

static lom_float3 splat(const float v[3])
{
    return lom_splat3(v[0], v[1], v[2]);
}

static void place(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct uniforms *u = uniforms;
    const lom_float4 *a = in->attribute;
    lom_float3 at = { a[0].x, a[0].y, a[0].z };
    lom_float3 world = lom_transform3(&u->to_world, at),
               normal = lom_rotate3(&u->to_world, (lom_float3){ a[1].x, a[1].y, a[1].z });
    const lom_float value[VARYINGS] = { normal.x, normal.y, normal.z, world.x, world.y, world.z };
    out->position = lom_transform4(&u->to_clip, at);
    memcpy(out->varying, value, sizeof value);
}

static void paint(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct uniforms *u = uniforms;
    const lom_float *v = in->varying;
    lom_float3 n = lom_normalize3((lom_float3){ v[NORMAL], v[NORMAL + 1], v[NORMAL + 2] });
    lom_float3 to_eye = lom_normalize3(lom_sub3(splat(u->eye), (lom_float3){ v[WORLD], v[WORLD + 1], v[WORLD + 2] }));
    lom_float3 to_light = splat(u->to_light), mirrored = lom_reflect3(lom_scale3(to_light, lom_splat(-1)), n);
    lom_float zero = lom_splat(0), cosine = lom_max(lom_dot3(n, to_light), zero);
    lom_float highlight = lom_pow_integer(lom_max(lom_dot3(mirrored, to_eye), zero), u->shininess);
    highlight = lom_select(cosine > 0.0f, highlight, zero); /* no light, no highlight */
    lom_float3 sum = lom_splat3(0, 0, 0);
    if (u->terms & AMBIENT)
        sum = lom_add3(sum, splat(u->ambient));
    if (u->terms & DIFFUSE)
        sum = lom_add3(sum, lom_scale3(splat(u->diffuse), cosine));
    if (u->terms & SPECULAR)
        sum = lom_add3(sum, lom_scale3(splat(u->specular), highlight));
    out->color[0] = (lom_float4){ sum.x, sum.y, sum.z, lom_splat(1) };
}

LOM_SHADER(lesson_lights, place, paint, .attributes = 2, .varyings = VARYINGS, .reads = LOM_VARYINGS(0, VARYINGS),
           .colors = 1, .uniforms_size = sizeof(struct uniforms))

static bool draw_terms(lom_device *device, lom_texture *picture, const lom_mesh *torus)
{
    static const int terms[4] = { AMBIENT, DIFFUSE, SPECULAR, AMBIENT | DIFFUSE | SPECULAR };
    lom_texture *depth = lom_make_texture(
        device, &(lom_texture_desc){ .width = WIDTH, .height = HEIGHT, .format = LOM_FORMAT_DEPTH32F });
    lom_mat4 view = lom_look_at((lom_vec3){ 0, 0, 5 }, (lom_vec3){ 0, 0, 0 }, (lom_vec3){ 0, 1, 0 });
    lom_mat4 lens = lom_perspective(0.45, (double)WIDTH / HEIGHT, 0.1), camera = lom_multiply(&lens, &view);
    lom_mat4 model = lom_rotation((lom_vec3){ 0.9, 0.2, 0.3 }), to_clip = lom_multiply(&camera, &model);
    struct uniforms u = { .to_clip = lom_round_matrix(&to_clip),
                          .to_world = lom_round_matrix(&model),
                          .eye = { 0, 0, 5 },
                          .to_light = { 0.48f, 0.64f, 0.6f },
                          .ambient = { 0.03f, 0.01f, 0.01f },
                          .diffuse = { 0.6f, 0.08f, 0.05f },
                          .specular = { 0.5f, 0.5f, 0.5f },
                          .shininess = 40 };
    bool done = torus != NULL;
    for (int i = 0; i < 4 && done; i++) {
        u.terms = terms[i];
        lom_begin_pass(
            device, &(lom_pass_desc){ .color = { picture },
                                      .depth = depth,
                                      .color_load = { i == 0 ? LOM_LOAD_CLEAR : LOM_LOAD_KEEP },
                                      .viewport = { i % 2 * WIDTH / 2, i / 2 * HEIGHT / 2, WIDTH / 2, HEIGHT / 2 } });
        const lom_mesh_vertex *v = torus->vertices;
        size_t stride = sizeof *v, size = torus->vertex_count * stride;
        lom_draw(device, &(lom_draw_desc){ .shader = &lesson_lights,
                                           .uniforms = &u,
                                           .attribute = { { v->position, size, stride, LOM_ATTRIBUTE_FLOAT3 },
                                                          { v->normal, size - 12, stride, LOM_ATTRIBUTE_FLOAT3 } },
                                           .indices = torus->indices,
                                           .count = torus->index_count });
        done = lom_end_pass(device);
    }
    return done;
}

int main(int argc, char **argv)
{
    lom_error error = { .code = LOM_OK };
    lom_device *device = lom_open_device(&(lom_device_desc){ 0 });
    lom_mesh *torus = lom_make_torus(0.8, 0.36, 96, 48, &error);
    lom_texture *picture = lom_make_texture(
        device, &(lom_texture_desc){ .width = WIDTH, .height = HEIGHT, .format = LOM_FORMAT_RGBA8_SRGB });
    lom_image *image = draw_terms(device, picture, torus) ? lom_read_texture(picture, 0, 0, &error) : NULL;
    bool done = argc == 2 && image != NULL && lom_write_image(argv[1], NULL, image, &error);
    if (!done)
        fprintf(stderr, "lights: nothing was written; usage: lights OUT.png. %s %s\n", lom_device_error(device)->text,
                error.text);
    lom_free_mesh(torus);
    lom_free_image(image);
    lom_close_device(device);
    return done ? 0 : 2;
}
