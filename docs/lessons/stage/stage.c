/* Lesson 17. A stage of your own: stage OUT.png
 * In: a torus and a floor. Out: a picture of them as a drawing: three tones and black outlines. The first pass draws tones
 * and, into a second target, normals; the second one is ours: a stage that looks at the neighbours of each pixel. */
#include <lom/lom.h>

#include <stdio.h>

enum { WIDTH = 320, HEIGHT = 180 };

struct uniforms {
    lom_matrix_uniform to_clip, to_world; /* the model only turns and moves */
    float color[3];
    const lom_texture *tones, *normals, *depth; /* of the second pass */
};

static void place(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct uniforms *u = uniforms;
    const lom_float4 *a = in->attribute;
    out->position = lom_transform4(&u->to_clip, (lom_float3){ a[0].x, a[0].y, a[0].z });
    lom_float3 normal = lom_rotate3(&u->to_world, (lom_float3){ a[1].x, a[1].y, a[1].z });
    memcpy(out->varying, (lom_float[3]){ normal.x, normal.y, normal.z }, 3 * sizeof(lom_float));
}

static void paint_tones(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct uniforms *u = uniforms;
    lom_float3 n = lom_normalize3((lom_float3){ in->varying[0], in->varying[1], in->varying[2] });
    lom_float light = lom_max(lom_dot3(n, lom_splat3(-0.48f, 0.8f, 0.36f)), lom_splat(0));
    lom_float tone = (lom_floor(light * 2.999f) + 1.0f) * (1 / 3.0f);
    out->color[0] = (lom_float4){ u->color[0] * tone, u->color[1] * tone, u->color[2] * tone, lom_splat(1) };
    out->color[1] = (lom_float4){ n.x, n.y, n.z, lom_splat(0) };
}

/* The stage: black where the depth bends or the normal turns between a pixel's four neighbours. */
static void paint_outlines(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct uniforms *u = uniforms;
    lom_int x = lom_to_int(in->x), y = lom_to_int(in->y), left = x - 1, right = x + 1, up = y - 1, down = y + 1;
    lom_float here = lom_fetch(u->depth, x, y, 0).x;
    lom_float4 a = lom_fetch(u->normals, left, y, 0), b = lom_fetch(u->normals, right, y, 0);
    lom_float4 c = lom_fetch(u->normals, x, up, 0), d = lom_fetch(u->normals, x, down, 0);
    lom_float across = lom_fetch(u->depth, left, y, 0).x + lom_fetch(u->depth, right, y, 0).x - 2 * here;
    lom_float along = lom_fetch(u->depth, x, up, 0).x + lom_fetch(u->depth, x, down, 0).x - 2 * here;
    lom_float turn = lom_abs(a.x - b.x) + lom_abs(a.y - b.y) + lom_abs(a.z - b.z) + lom_abs(c.x - d.x) +
                     lom_abs(c.y - d.y) + lom_abs(c.z - d.z);
    lom_mask line = (lom_abs(across) + lom_abs(along) > here * 0.04f) | (turn > 1.2f);
    lom_float4 tone = lom_fetch(u->tones, x, y, 0);
    lom_float keep = lom_select(line, lom_splat(0), lom_splat(1));
    out->color[0] = (lom_float4){ tone.x * keep, tone.y * keep, tone.z * keep, lom_splat(1) };
}

LOM_SHADER(lesson_stage_tones, place, paint_tones, .attributes = 2, .varyings = 3, .reads = LOM_VARYINGS(0, 3),
           .colors = 2, .uniforms_size = sizeof(struct uniforms))
LOM_SHADER(lesson_stage, place, paint_outlines, .attributes = 2, .varyings = 3, .reads_position = true, .colors = 1,
           .uniforms_size = sizeof(struct uniforms))

static void draw(lom_device *device, const lom_shader *shader, const lom_mesh *mesh, const struct uniforms *u)
{
    const lom_mesh_vertex *v = mesh->vertices;
    size_t stride = sizeof *v, size = mesh->vertex_count * stride;
    lom_draw_desc what = { .shader = shader, .uniforms = u, .indices = mesh->indices, .count = mesh->index_count };
    what.attribute[0] = (lom_attribute){ v->position, size, stride, LOM_ATTRIBUTE_FLOAT3 };
    what.attribute[1] = (lom_attribute){ v->normal, size - 12, stride, LOM_ATTRIBUTE_FLOAT3 };
    lom_draw(device, &what);
}

static lom_texture *draw_passes(lom_device *device, const lom_mesh *torus, const lom_mesh *square)
{
    lom_texture_desc size = { .width = WIDTH, .height = HEIGHT, .format = LOM_FORMAT_RGBA8_SRGB };
    lom_texture *tones = lom_make_texture(device, &size), *picture = lom_make_texture(device, &size);
    size.format = LOM_FORMAT_RGBA32F;
    lom_texture *normals = lom_make_texture(device, &size);
    size.format = LOM_FORMAT_DEPTH32F;
    lom_texture *depth = lom_make_texture(device, &size);
    lom_mat4 view = lom_look_at((lom_vec3){ 0, 2.2, 4.4 }, (lom_vec3){ 0, 0.4, 0 }, (lom_vec3){ 0, 1, 0 });
    lom_mat4 lens = lom_perspective(0.6, (double)WIDTH / HEIGHT, 0.1), camera = lom_multiply(&lens, &view);
    lom_mat4 model = lom_model_matrix((lom_vec3){ 0, 0.75, 0 }, (lom_vec3){ 0.6, 0, 0.4 }, (lom_vec3){ 1, 1, 1 });
    lom_mat4 to_clip = lom_multiply(&camera, &model), still = lom_identity();
    struct uniforms thing = {
        lom_round_matrix(&to_clip), lom_round_matrix(&model), { 0.9f, 0.5f, 0.15f }, NULL, NULL, NULL
    };
    struct uniforms floor = {
        lom_round_matrix(&camera), lom_round_matrix(&still), { 0.4f, 0.6f, 0.7f }, NULL, NULL, NULL
    };
    lom_begin_pass(
        device,
        &(lom_pass_desc){ .color = { tones, normals }, .depth = depth, .clear_color = { { 0.9f, 0.9f, 0.85f, 1 } } });
    draw(device, &lesson_stage_tones, torus, &thing);
    draw(device, &lesson_stage_tones, square, &floor);
    lom_end_pass(device);
    /* The square over the whole window: x and z of its corners as clip x and y, w 1. */
    struct uniforms whole = { { { { 1, 0, 0, 0 }, { 0, 0, -1, 0 }, { 0, 0, 0, 0.5f }, { 0, 0, 0, 1 } } },
                              lom_round_matrix(&still),
                              { 0 },
                              tones,
                              normals,
                              depth };
    lom_begin_pass(device, &(lom_pass_desc){ .color = { picture } });
    draw(device, &lesson_stage, square, &whole);
    return lom_end_pass(device) ? picture : NULL;
}

int main(int argc, char **argv)
{
    lom_device *device = lom_open_device(&(lom_device_desc){ 0 });
    lom_mesh *torus = lom_make_torus(0.8, 0.32, 96, 48, NULL), *square = lom_make_quad(2.6, 2.6, NULL);
    lom_texture *picture = torus == NULL || square == NULL ? NULL : draw_passes(device, torus, square);
    lom_image *image = picture == NULL ? NULL : lom_read_texture(picture, 0, 0, NULL);
    bool done = argc == 2 && image != NULL && lom_write_image(argv[1], NULL, image, NULL);
    if (!done)
        fprintf(stderr, "stage: nothing was written; usage: stage OUT.png. %s\n", lom_device_error(device)->text);
    lom_free_mesh(torus);
    lom_free_mesh(square);
    lom_free_image(image);
    lom_close_device(device);
    return done ? 0 : 2;
}
