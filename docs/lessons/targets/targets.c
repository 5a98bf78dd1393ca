/* Lesson 10. Render targets and clip planes: targets OUT.png
 * In: a torus, half under a mirror that lies level. Out: a picture of both. The first pass draws the mirrored world into a
 * texture, only what lies above the mirror; the second draws the world, and the mirror, which looks itself up there. */
#include <lom/geometry.h>
#include <lom/pipeline.h>

#include <stdio.h>

enum { WIDTH = 320, HEIGHT = 180 };

struct uniforms {
    lom_matrix_uniform to_clip, to_world;
    float plane[4]; /* drawn is where x p[0] + y p[1] + z p[2] + p[3] >= 0; all 0: everything */
    const lom_texture *reflection;
};

static void place(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct uniforms *u = uniforms;
    const lom_float4 *a = in->attribute;
    lom_float3 at = { a[0].x, a[0].y, a[0].z };
    lom_float3 normal = lom_rotate3(&u->to_world, (lom_float3){ a[1].x, a[1].y, a[1].z }); /* the model only turns */
    out->position = lom_transform4(&u->to_clip, at);
    out->distance[0] = lom_transform_row(u->plane, lom_transform3(&u->to_world, at));
    out->varying[0] = normal.x;
    out->varying[1] = normal.y;
    out->varying[2] = normal.z;
}

static void paint(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)uniforms;
    lom_float3 n = lom_normalize3((lom_float3){ in->varying[0], in->varying[1], in->varying[2] });
    lom_float light = 0.2f + 0.8f * lom_max(lom_dot3(n, lom_splat3(0.36f, 0.8f, 0.48f)), lom_splat(0));
    out->color[0] = (lom_float4){ light * 0.8f, light * 0.45f, light * 0.1f, lom_splat(1) };
}

/* The mirror's pixel looks up the same pixel of the reflection: both were drawn for the same window. */
static void paint_mirror(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct uniforms *u = uniforms;
    lom_float4 seen = lom_sample(u->reflection, in->x * (1.0f / WIDTH), in->y * (1.0f / HEIGHT), lom_splat(0));
    out->color[0] = (lom_float4){ seen.x * 0.7f, seen.y * 0.8f, seen.z * 0.85f, lom_splat(1) };
}

LOM_SHADER(lesson_targets, place, paint, .attributes = 2, .varyings = 3, .clip_distances = 1,
           .reads = LOM_VARYINGS(0, 3), .colors = 1, .uniforms_size = sizeof(struct uniforms))
LOM_SHADER(lesson_targets_mirror, place, paint_mirror, .attributes = 2, .varyings = 3, .clip_distances = 1, .colors = 1,
           .reads_position = true, .uniforms_size = sizeof(struct uniforms))

static void draw(lom_device *device, const lom_shader *shader, const lom_mesh *mesh, const struct uniforms *u,
                 bool mirrored)
{
    const lom_mesh_vertex *v = mesh->vertices;
    size_t stride = sizeof *v, size = mesh->vertex_count * stride;
    lom_draw(device, &(lom_draw_desc){ .shader = shader,
                                       .uniforms = u,
                                       .attribute = { { v->position, size, stride, LOM_ATTRIBUTE_FLOAT3 },
                                                      { v->normal, size - 12, stride, LOM_ATTRIBUTE_FLOAT3 } },
                                       .indices = mesh->indices,
                                       .count = mesh->index_count,
                                       .cull = LOM_CULL_BACK,
                                       .front_clockwise = mirrored }); /* a mirror turns every triangle over */
}

static bool draw_passes(lom_device *device, lom_texture *picture, const lom_mesh *torus, const lom_mesh *mirror)
{
    lom_texture_desc size = { .width = WIDTH, .height = HEIGHT, .format = LOM_FORMAT_RGBA8_SRGB };
    size.sampler = (lom_sampler_desc){ .wrap_s = LOM_WRAP_CLAMP, .wrap_t = LOM_WRAP_CLAMP };
    lom_texture *reflection = lom_make_texture(device, &size);
    size.format = LOM_FORMAT_DEPTH32F;
    lom_texture *depth = lom_make_texture(device, &size);
    lom_mat4 view = lom_look_at((lom_vec3){ 0, 1.5, 4 }, (lom_vec3){ 0, 0.1, 0 }, (lom_vec3){ 0, 1, 0 });
    lom_mat4 lens = lom_perspective(0.7, (double)WIDTH / HEIGHT, 0.1), camera = lom_multiply(&lens, &view);
    lom_mat4 turned_over = lom_mirror((lom_vec3){ 0, 1, 0 }, 0), mirrored = lom_multiply(&camera, &turned_over);
    lom_mat4 model = lom_rotation((lom_vec3){ 1.2, 0.5, 0 }), to_clip = lom_multiply(&mirrored, &model),
             still = lom_identity();
    struct uniforms u = { .to_clip = lom_round_matrix(&to_clip),
                          .to_world = lom_round_matrix(&model),
                          .plane = { 0, 1, 0, 0 } };

    lom_pass_desc pass = { .color = { reflection }, .depth = depth, .clear_color = { { 0.3f, 0.5f, 0.8f, 1 } } };
    lom_begin_pass(device, &pass);
    draw(device, &lesson_targets, torus, &u, true);
    lom_end_pass(device);

    pass.color[0] = picture;
    lom_begin_pass(device, &pass);
    to_clip = lom_multiply(&camera, &model);
    struct uniforms whole = { .to_clip = lom_round_matrix(&to_clip), .to_world = lom_round_matrix(&model) };
    draw(device, &lesson_targets, torus, &whole, false);
    struct uniforms level = { .to_clip = lom_round_matrix(&camera), .to_world = lom_round_matrix(&still) };
    level.reflection = reflection;
    draw(device, &lesson_targets_mirror, mirror, &level, false);
    return lom_end_pass(device);
}

int main(int argc, char **argv)
{
    lom_error error = { .code = LOM_OK };
    lom_device *device = lom_open_device(&(lom_device_desc){ 0 });
    lom_mesh *torus = lom_make_torus(0.7, 0.25, 96, 48, &error), *mirror = lom_make_quad(5, 4, &error);
    lom_texture *picture = lom_make_texture(
        device, &(lom_texture_desc){ .width = WIDTH, .height = HEIGHT, .format = LOM_FORMAT_RGBA8_SRGB });
    bool drawn = torus != NULL && mirror != NULL && draw_passes(device, picture, torus, mirror);
    lom_image *image = drawn ? lom_read_texture(picture, 0, 0, &error) : NULL;
    bool done = argc == 2 && image != NULL && lom_write_image(argv[1], NULL, image, &error);
    if (!done)
        fprintf(stderr, "targets: nothing was written; usage: targets OUT.png. %s %s\n", lom_device_error(device)->text,
                error.text);
    lom_free_mesh(torus);
    lom_free_mesh(mirror);
    lom_free_image(image);
    lom_close_device(device);
    return done ? 0 : 2;
}
