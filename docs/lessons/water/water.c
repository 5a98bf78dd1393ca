/* Lesson 11. The nine steps of water: water OUT.png
 * In: stones on a level bed. Out: a picture of a lake over them. Passes: the mirrored world above the water (1), the world
 * below it with its depth (2), the world once more with the water's square (3), which joins them (4..9). */
#include <lom/lom.h>
#include <stdio.h>

enum { WIDTH = 320, HEIGHT = 180, WORLD = 0, NORMAL = 3, VARYINGS = 6 };
static const lom_vec3 eye = { -1, 1.1, 6 }, target = { 0.3, 0, -1 }, up = { 0, 1, 0 };
static const float near_plane = 0.1f;
/* x, y, z and size: three stones, the bed, the water */
static const float things[5][4] = {
    { 1.5f, -1, -1.5f, 2 }, { -2.2f, -1.2f, -3, 2 }, { 0, -1, 1.2f, 1.1f }, { 0, -61, -2, 60 }, { 0, 0, -60, 60 }
};

struct uniforms {
    lom_matrix_uniform to_clip;
    float plane[4], thing[4]; /* (0, 1, 0, 0) keeps what is above the water, (0, -1, 0, 0) what is below */
    lom_texture *color[3], *depth[3], *normals; /* of the reflection, the refraction, the picture; the ripples */
};

static void place(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct uniforms *u = uniforms;
    const lom_float4 *a = in->attribute;
    const float *p = u->thing;
    lom_float3 at = { a[0].x * p[3] + p[0], a[0].y * p[3] + p[1], a[0].z * p[3] + p[2] };
    const lom_float value[VARYINGS] = { at.x, at.y, at.z, a[0].x, a[0].y, a[0].z };
    memcpy(out->varying, value, sizeof value);
    out->position = lom_transform4(&u->to_clip, at);
    out->distance[0] = lom_transform_row(u->plane, at);
}

static void paint(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)uniforms;
    lom_float3 n = { in->varying[NORMAL], in->varying[NORMAL + 1], in->varying[NORMAL + 2] };
    lom_float light = lom_max(lom_dot3(lom_normalize3(n), lom_splat3(-0.48f, 0.6f, -0.64f)), lom_splat(0)) + 0.3f;
    lom_float moss = lom_smoothstep(lom_splat(0.1f), lom_splat(0.6f), in->varying[WORLD + 1]) * 0.25f;
    out->color[0] = (lom_float4){ light * (0.4f - moss), light * 0.35f, light * (0.26f - moss), lom_splat(1) };
}

static void paint_water(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct uniforms *u = uniforms;
    const lom_float *v = in->varying;
    lom_float s = in->x * (1.0f / WIDTH), t = in->y * (1.0f / HEIGHT), zero = lom_splat(0);
    lom_float bed = near_plane / lom_max(lom_sample_depth(u->depth[1], s, t), lom_splat(1e-6f));
    lom_float shore = lom_saturate((bed - in->w) * 1.5f); /* 9: clear where the water is thin */
    lom_float4 map = lom_sample(u->normals, v[WORLD] * 0.2f, v[WORLD + 2] * 0.2f, zero);
    s += (map.x - 0.5f) * 0.06f * shore; /* 4: ripples move the lookups */
    t += (map.y - 0.5f) * 0.06f * shore;
    lom_float4 above = lom_sample(u->color[0], s, t, zero), below = lom_sample(u->color[1], s, t, zero);
    lom_float3 n = lom_normalize3((lom_float3){ map.x * 2 - 1, map.z * 3, map.y * 2 - 1 }); /* 5: y is up here */
    lom_float3 to_eye = { (float)eye.x - v[WORLD], lom_splat((float)eye.y), (float)eye.z - v[WORLD + 2] };
    lom_float3 e = lom_normalize3(to_eye), sun = lom_reflect3(lom_splat3(0.48f, -0.6f, 0.64f), n);
    lom_float f = lom_saturate(lom_dot3(e, n)); /* 6: from above one sees the bed, from aside the sky */
    lom_float glint = lom_pow_integer(lom_saturate(lom_dot3(sun, e)), 64); /* 7: the sun's highlight */
    lom_float3 seen = { lom_mix(above.x, below.x, f), lom_mix(above.y, below.y, f), lom_mix(above.z, below.z, f) };
    seen = lom_add3(lom_scale3(seen, lom_splat(0.8f)), lom_splat3(0.004f, 0.03f, 0.06f)); /* 8: a fifth of tint */
    out->color[0] = (lom_float4){ seen.x + glint, seen.y + glint, seen.z + glint, shore };
}

LOM_SHADER(lesson_water_stone, place, paint, .attributes = 1, .varyings = VARYINGS, .clip_distances = 1,
           .reads = LOM_VARYINGS(0, VARYINGS), .colors = 1, .uniforms_size = sizeof(struct uniforms))
LOM_SHADER(lesson_water, place, paint_water, .attributes = 1, .varyings = VARYINGS, .clip_distances = 1,
           .reads = LOM_VARYINGS(0, 3), .colors = 1, .reads_position = true, .uniforms_size = sizeof(struct uniforms))

static void draw(lom_device *device, const lom_mesh *mesh, int thing, struct uniforms u)
{
    lom_draw_desc what = { .uniforms = &u, .indices = mesh->indices, .count = mesh->index_count };
    what.shader = thing == 4 ? &lesson_water : &lesson_water_stone;
    what.attribute[0] = (lom_attribute){ mesh->vertices, mesh->vertex_count * 48, 48, LOM_ATTRIBUTE_FLOAT3 };
    what.blend[0] = (lom_blend){ .enabled = thing == 4, LOM_FACTOR_SOURCE_ALPHA, LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA };
    what.mask_off[0] = thing == 4 ? 8 : 0; /* the picture stays opaque */
    memcpy(u.thing, things[thing], sizeof u.thing);
    lom_draw(device, &what);
}

static lom_texture *draw_lake(lom_device *device, lom_mesh *mesh[2], struct uniforms u)
{
    lom_mat4 view = lom_look_at(eye, target, up), lens = lom_perspective(0.75, (double)WIDTH / HEIGHT, near_plane);
    lom_mat4 camera = lom_multiply(&lens, &view), mirror = lom_mirror(up, 0), mirrored = lom_multiply(&camera, &mirror);
    for (int i = 0; i < 3; i++) {
        lom_texture_desc desc = { .width = WIDTH, .height = HEIGHT, .format = LOM_FORMAT_RGBA8_SRGB };
        u.color[i] = lom_make_texture(device, &desc);
        desc.format = LOM_FORMAT_DEPTH32F;
        u.depth[i] = lom_make_texture(device, &desc);
        lom_pass_desc pass = { .color = { u.color[i] },
                               .depth = u.depth[i],
                               .clear_color = { { 0.4f, 0.6f, 0.85f, 1 } } };
        lom_begin_pass(device, &pass);
        u.to_clip = lom_round_matrix(i == 0 ? &mirrored : &camera);
        u.plane[1] = i == 0 ? 1 : i == 1 ? -1 : 0;
        for (int k = 0; k < (i == 2 ? 5 : 4); k++)
            draw(device, mesh[k == 4], k, u);
        lom_end_pass(device);
    }
    return lom_device_error(device)->code == LOM_OK ? u.color[2] : NULL;
}

int main(int argc, char **argv)
{
    lom_device *device = lom_open_device(&(lom_device_desc){ 0 });
    lom_mesh *mesh[2] = { lom_make_sphere(1, 96, 48, NULL), lom_make_quad(2, 2.4, NULL) };
    lom_image *normals = lom_make_normal_map(&(lom_normal_map_desc){ .size = 128, .seed = 1 }, NULL);
    lom_texture *map = lom_texture_of_image(normals, false, LOM_MIPS_ALL, NULL);
    struct uniforms u = { .normals = map };
    lom_texture *picture = mesh[0] != NULL && mesh[1] != NULL && map != NULL ? draw_lake(device, mesh, u) : NULL;
    lom_image *image = picture == NULL ? NULL : lom_read_texture(picture, 0, 0, NULL);
    bool done = argc == 2 && image != NULL && lom_write_image(argv[1], NULL, image, NULL);
    if (!done)
        fprintf(stderr, "water: nothing was written; usage: water OUT.png. %s\n", lom_device_error(device)->text);
    lom_free_mesh(mesh[0]);
    lom_free_mesh(mesh[1]);
    lom_free_texture(map);
    lom_free_image(normals);
    lom_free_image(image);
    lom_close_device(device);
    return done ? 0 : 2;
}
