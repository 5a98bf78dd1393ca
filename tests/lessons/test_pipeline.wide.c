/* Proves that the pipeline in one file (docs/lessons/pipeline/pipeline.c) and the library draw the same bytes: meshes
 * textured, lit, cut by the near plane, by the guard band and by a clip plane, opaque and blended, from many cameras and
 * in many sizes, by every path of the library; and that they agree stage by stage, in floats. A difference is printed
 * with what each stage had at the first pixel that has one. */
#include <lom/lanes_mathematics.h>
#include <lom/pipeline.h>

#include "pipeline/device.h"
#include "plain.h"

/* ---- the lesson's shader over lanes ---- */

struct lane_uniforms {
    struct uniforms u;
    const lom_texture *texture;
};

static void place(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct uniforms *u = &((const struct lane_uniforms *)uniforms)->u;
    const lom_float4 *a = in->attribute;
    lom_float3 at = { a[0].x, a[0].y, a[0].z }, normal = { a[1].x, a[1].y, a[1].z };
    lom_float3 world = lom_transform3(&u->to_world, at);
    normal = lom_rotate3(&u->normal_to_world, normal);
    out->position = lom_transform4(&u->to_clip, at);
    const lom_float value[VARYINGS] = {
        a[2].x * u->tiling[0], a[2].y * u->tiling[1], normal.x, normal.y, normal.z, world.x, world.y, world.z
    };
    memcpy(out->varying, value, sizeof value);
    out->distance[0] = lom_transform_row(u->clip_plane, world);
}

static lom_float4 light(const lom_varyings *in, const struct lane_uniforms *uniforms, lom_float *lod, lom_float4 *texel)
{
    const struct uniforms *u = &uniforms->u;
    const lom_float *v = in->varying;
    *lod = lom_lod(uniforms->texture, in, S, T);
    *texel = lom_sample(uniforms->texture, v[S], v[T], *lod);
    lom_float3 n = lom_normalize3((lom_float3){ v[NORMAL], v[NORMAL + 1], v[NORMAL + 2] });
    lom_float3 world = { v[WORLD], v[WORLD + 1], v[WORLD + 2] };
    lom_float3 e = lom_normalize3(lom_sub3(lom_splat3(u->eye[0], u->eye[1], u->eye[2]), world));
    lom_mask turned = lom_dot3(n, e) < 0.0f;
    n = (lom_float3){ lom_select(turned, -n.x, n.x), lom_select(turned, -n.y, n.y), lom_select(turned, -n.z, n.z) };
    lom_float3 lit_from = lom_splat3(to_light[0], to_light[1], to_light[2]);
    lom_float diffuse = lom_max(lom_dot3(n, lit_from), lom_splat(0));
    lom_float3 r = lom_reflect3(lom_scale3(lit_from, lom_splat(-1)), n);
    lom_float specular = lom_pow_integer(lom_max(lom_dot3(r, e), lom_splat(0)), u->shininess) * shine;
    specular = lom_select(diffuse > 0.0f, specular, lom_splat(0));
    lom_float factor = ambient + lamp * diffuse;
    return (lom_float4){ texel->x * factor + specular, texel->y * factor + specular, texel->z * factor + specular,
                         texel->w * u->opacity };
}

static void paint_lanes(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    lom_float lod;
    lom_float4 texel;
    out->color[0] = light(in, uniforms, &lod, &texel);
}

/* What the stages had, in floats. */
static void show_stages(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const lom_float *v = in->varying;
    lom_float lod;
    lom_float4 texel;
    out->color[3] = light(in, uniforms, &lod, &texel);
    out->color[0] = (lom_float4){ in->z, in->w, lod, texel.x };
    out->color[1] = (lom_float4){ v[S], v[T], v[NORMAL], v[NORMAL + 1] };
    out->color[2] = (lom_float4){ v[NORMAL + 2], v[WORLD], v[WORLD + 1], v[WORLD + 2] };
}

LOM_SHADER(painting, place, paint_lanes, .attributes = 3, .varyings = VARYINGS, .clip_distances = 1,
           .reads = LOM_VARYINGS(0, VARYINGS), .differentiates = 1u << S | 1u << T, .colors = 1,
           .uniforms_size = sizeof(struct lane_uniforms))
LOM_SHADER(stages, place, show_stages, .attributes = 3, .varyings = VARYINGS, .clip_distances = 1,
           .reads = LOM_VARYINGS(0, VARYINGS), .differentiates = 1u << S | 1u << T, .reads_position = true, .colors = 4,
           .uniforms_size = sizeof(struct lane_uniforms))

enum { STAGE_VALUES = 16 };
static const char *const stage_names[STAGE_VALUES] = {
    "depth",    "w",       "level of detail", "texel's red", "s",   "t",     "normal x", "normal y",
    "normal z", "world x", "world y",         "world z",     "red", "green", "blue",     "alpha",
};

static void list_stages(const struct fragment *f, float value[STAGE_VALUES])
{
    const float head[4] = { f->depth, f->w, f->lod, f->texel[0] };
    memcpy(value, head, sizeof head);
    memcpy(value + 4, f->varying, sizeof f->varying);
    memcpy(value + 12, f->color, sizeof f->color);
}

/* ---- scenes ---- */

static struct skin read_skin(const char *path)
{
    lom_error error = { .code = LOM_OK };
    lom_image *image = lom_read_image(path, &error);
    lom_image *rgba = image == NULL ? NULL : lom_convert_image(image, LOM_FORMAT_RGBA8, &error);
    CHECK(rgba != NULL, "%s", error.text);
    struct skin skin = rgba == NULL ? make_noise(8, 8) : make_skin(rgba->width, rgba->height, rgba->pixels);
    lom_free_image(image);
    lom_free_image(rgba);
    return skin;
}

enum { MOST_DRAWS = 4 };
struct scene {
    const char *name;
    int camera, width, height, draws;
    struct draw draw[MOST_DRAWS];
    lom_mat4 view_projection;
    lom_vec3 eye;
};

/* Cameras around the origin: far and near, above and level; every fourth right beside what it sees. */
static void aim(struct scene *scene, double near_plane)
{
    int c = scene->camera;
    double far = c % 4 == 3 ? 0.75 : 1.5 + 0.7 * (c % 5), angle = 0.9 * c;
    scene->eye = (lom_vec3){ far * lom_double_cos(angle), 0.15 + 0.4 * (c % 3), far * lom_double_sin(angle) };
    lom_mat4 view = lom_look_at(scene->eye, (lom_vec3){ 0.1, 0.3, 0 }, (lom_vec3){ 0.1 * (c % 2), 1, 0 });
    lom_mat4 lens = lom_perspective(0.6 + 0.25 * (c % 4), (double)scene->width / scene->height, near_plane);
    scene->view_projection = lom_multiply(&lens, &view);
}

static struct draw *add(struct scene *scene, const lom_mesh *mesh, const struct skin *skin, const lom_mat4 *model)
{
    struct draw *draw = &scene->draw[scene->draws++];
    *draw = (struct draw){ .mesh = mesh, .texture = &skin->plain };
    lom_mat4 to_clip = lom_multiply(&scene->view_projection, model), normals;
    lom_normal_matrix(model, &normals);
    draw->uniforms = (struct uniforms){ .to_clip = lom_round_matrix(&to_clip),
                                        .to_world = lom_round_matrix(model),
                                        .normal_to_world = lom_round_matrix(&normals),
                                        .clip_plane = { 0, 0, 0, 1 },
                                        .eye = { (float)scene->eye.x, (float)scene->eye.y, (float)scene->eye.z },
                                        .tiling = { 3, 2 },
                                        .opacity = 1 };
    draw->uniforms.shininess = 1 + 13 * (scene->camera % 5);
    return draw;
}

static void cut_by(struct draw *draw, float x, float y, float z, float distance)
{
    const float plane[4] = { x, y, z, distance };
    memcpy(draw->uniforms.clip_plane, plane, sizeof plane);
}

/* ---- both ways, compared ---- */

static double pixels_compared;

static void draw_by_lanes(lom_device *device, const struct scene *scene, const lom_shader *shader,
                          lom_texture *const *color, lom_texture *depth, const float clear[4])
{
    lom_pass_desc pass = { .depth = depth };
    for (int i = 0; i < shader->colors; i++) {
        pass.color[i] = color[i];
        memcpy(pass.clear_color[i], clear, sizeof pass.clear_color[i]);
    }
    lom_begin_pass(device, &pass);
    for (int i = 0; i < scene->draws; i++) {
        const struct draw *d = &scene->draw[i];
        struct lane_uniforms uniforms = { d->uniforms, ((const struct skin *)(const void *)d->texture)->lanes };
        const lom_mesh_vertex *v = d->mesh->vertices;
        size_t size = d->mesh->vertex_count * sizeof *v;
        lom_draw_desc desc = { .shader = shader, .uniforms = &uniforms };
        desc.attribute[0] = (lom_attribute){ v->position, size, sizeof *v, LOM_ATTRIBUTE_FLOAT3 };
        desc.attribute[1] = (lom_attribute){ v->normal, size - 12, sizeof *v, LOM_ATTRIBUTE_FLOAT3 };
        desc.attribute[2] = (lom_attribute){ v->uv, size - 24, sizeof *v, LOM_ATTRIBUTE_FLOAT2 };
        desc.indices = d->mesh->indices;
        desc.count = d->mesh->index_count;
        desc.cull = d->cull > 0 ? LOM_CULL_BACK : d->cull < 0 ? LOM_CULL_FRONT : LOM_CULL_NONE;
        if (shader == &painting && d->blends)
            desc.blend[0] =
                (lom_blend){ true,           LOM_FACTOR_SOURCE_ALPHA,           LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA,
                             LOM_FACTOR_ONE, LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA, LOM_BLEND_ADD,
                             LOM_BLEND_ADD };
        lom_draw(device, &desc);
    }
    CHECK(lom_end_pass(device), "%s", lom_device_error(device)->text);
}

/* As a float attachment holds it: no NaN, no infinity. */
static float stored(float x)
{
    return x != x ? 0 : clamp(x, -0x1p123f, 0x1p123f);
}

/* The float stages of both, pixel by pixel; prints all of the first pixel that differs. */
static void compare_stages(const struct scene *scene, const struct picture *plain, lom_device *device)
{
    static const float nothing[4] = { 0 };
    size_t pixels = (size_t)scene->width * (size_t)scene->height;
    lom_texture *color[4], *depth = NULL;
    lom_image *image[4];
    lom_texture_desc desc = { .width = scene->width, .height = scene->height, .format = LOM_FORMAT_RGBA32F };
    for (int i = 0; i < 4; i++)
        color[i] = lom_make_texture(device, &desc);
    desc.format = LOM_FORMAT_DEPTH32F;
    depth = lom_make_texture(device, &desc);
    draw_by_lanes(device, scene, &stages, color, depth, nothing);
    for (int i = 0; i < 4; i++)
        image[i] = lom_read_texture(color[i], 0, 0, NULL);
    bool same = true;
    for (size_t at = 0; at < pixels && same; at++) {
        float value[STAGE_VALUES], lanes[STAGE_VALUES];
        list_stages(&plain->seen[at], value);
        for (size_t i = 0; i < 4; i++)
            memcpy(lanes + 4 * i, (const float *)(const void *)image[i]->pixels + 4 * at, 4 * sizeof(float));
        for (int i = 0; i < STAGE_VALUES; i++)
            same &= stored(value[i]) == lanes[i];
        for (int i = 0; i < STAGE_VALUES && !same; i++)
            printf("  pixel (%d, %d), %s: %.9g plain, %.9g by lanes%s\n", (int)(at % (size_t)scene->width),
                   (int)(at / (size_t)scene->width), stage_names[i], (double)value[i], (double)lanes[i],
                   stored(value[i]) == lanes[i] ? "" : " (differs)");
    }
    CHECK(same, "the stages of %s, camera %d, %d x %d", scene->name, scene->camera, scene->width, scene->height);
    for (int i = 0; i < 4; i++) {
        lom_free_image(image[i]);
        lom_release_texture(device, color[i]);
    }
    lom_release_texture(device, depth);
}

/* The paths of the library that one width has: fragments packed or triangle by triangle, tiles and chunks of any size. */
static const struct path {
    const char *name;
    lom_device_desc desc;
    bool one_by_one;
} paths[] = {
    { "packed", { .threads = 2 }, false },
    { "triangle by triangle", { .threads = 1, .tile = 32 }, true },
    { "small tiles, small chunks", { .threads = 1, .tile = 16, .chunk = 16, .batch = 3 }, false },
};

static void compare_path(const struct scene *scene, const struct path *path, const struct picture *plain,
                         const float clear[4])
{
    lom_device_desc desc = path->desc;
    desc.lanes = LOM_LANES;
#ifdef LOM_LOWERED
    desc.plain = true;
#endif
    lom_device *device = lom_open_device(&desc);
    lom_texture_desc target = { .width = scene->width, .height = scene->height, .format = LOM_FORMAT_RGBA8_SRGB };
    lom_texture *color = lom_make_texture(device, &target);
    target.format = LOM_FORMAT_DEPTH32F;
    lom_texture *depth = lom_make_texture(device, &target);
    device->one_by_one = path->one_by_one;
    draw_by_lanes(device, scene, &painting, &color, depth, clear);
    lom_image *image = lom_read_texture(color, 0, 0, NULL), *depths = lom_read_texture(depth, 0, 0, NULL);
    size_t pixels = (size_t)scene->width * (size_t)scene->height, at = 0;
    const float *z = (const float *)(const void *)depths->pixels;
    while (at < pixels && memcmp(image->pixels + 4 * at, plain->color[at], 4) == 0 && z[at] == plain->depth[at])
        at++;
    CHECK(at == pixels,
          "%s, camera %d, %d x %d, %s: pixel (%d, %d) is %02x%02x%02x%02x at depth %.9g plain, %02x%02x%02x%02x at "
          "%.9g by lanes",
          scene->name, scene->camera, scene->width, scene->height, path->name, (int)(at % (size_t)scene->width),
          (int)(at / (size_t)scene->width), plain->color[at][0], plain->color[at][1], plain->color[at][2],
          plain->color[at][3], (double)plain->depth[at], image->pixels[4 * at], image->pixels[4 * at + 1],
          image->pixels[4 * at + 2], image->pixels[4 * at + 3], (double)z[at]);
    if (at < pixels || path == paths)
        compare_stages(scene, plain, device);
    lom_free_image(image);
    lom_free_image(depths);
    lom_close_device(device);
}

static void compare(const struct scene *scene)
{
    static const float clear[4] = { 0.25f, 0.45f, 0.7f, 0.8f };
    size_t pixels = (size_t)scene->width * (size_t)scene->height, drawn = 0;
    struct picture plain = { scene->width,
                             scene->height,
                             { 2.0f * BAND / (float)scene->width, 2.0f * BAND / (float)scene->height },
                             lom_allocate(pixels, 4, NULL),
                             lom_allocate(pixels, sizeof(float), NULL),
                             lom_allocate(pixels, sizeof *plain.seen, NULL) };
    for (size_t i = 0; i < pixels; i++)
        write_pixel(clear, false, plain.color[i]);
    for (int i = 0; i < scene->draws; i++)
        draw_mesh(&plain, &scene->draw[i]);
    for (size_t i = 0; i < pixels; i++)
        drawn += plain.depth[i] > 0;
    CHECK(drawn * 100 >= pixels, "%s, camera %d: only %zu of %zu pixels are drawn", scene->name, scene->camera, drawn,
          pixels);
    for (size_t i = 0; i < sizeof paths / sizeof *paths; i++)
        compare_path(scene, &paths[i], &plain, clear);
    pixels_compared += (double)pixels;
    lom_release(plain.color);
    lom_release(plain.depth);
    lom_release(plain.seen);
}

static void sized(struct scene *scene, int camera)
{
    static const int sizes[][2] = { { 160, 90 }, { 97, 61 }, { 320, 180 }, { 33, 250 }, { 641, 363 }, { 250, 7 } };
    scene->camera = camera;
    scene->width = sizes[camera % 6][0];
    scene->height = sizes[camera % 6][1];
    scene->draws = 0;
}

/* ---- the tests ---- */

/* Triangles of a pixel and of the whole picture, cut by the near plane, both halves of a clip plane, blended. */
static void a_cut_torus_on_the_ground_is_the_same_bytes(void)
{
    lom_mesh *torus = lom_make_torus(0.6, 0.25, 60, 30, NULL), *fine = lom_make_torus(0.6, 0.25, 400, 200, NULL);
    lom_mesh *ground = lom_make_quad(600, 600, NULL);
    struct skin skin = make_noise(64, 16), floor = make_noise(128, 128);
    for (int camera = 0; camera < 18; camera++) {
        struct scene scene = { .name = "torus" };
        sized(&scene, camera);
        aim(&scene, camera % 2 == 0 ? 0.1 : 0.001);
        lom_mat4 still = lom_identity(),
                 model = lom_model_matrix((lom_vec3){ 0, 0.4, 0 }, (lom_vec3){ 0.3 * camera, 0.5, 1 },
                                          (lom_vec3){ 1, camera % 3 == 0 ? 0.6 : 1, 1.2 });
        const lom_mesh *mesh = camera % 5 == 2 ? fine : torus;
        add(&scene, ground, &floor, &still);
        struct draw *half = add(&scene, mesh, &skin, &model), *back = add(&scene, mesh, &skin, &model);
        struct draw *front = add(&scene, mesh, &skin, &model);
        half->cull = camera % 3 - 1;
        back->cull = -1;
        front->cull = 1;
        back->blends = front->blends = true;
        back->uniforms.opacity = front->uniforms.opacity = 0.4f;
        cut_by(half, 0.6f, 0.8f, 0, -0.25f);
        cut_by(back, -0.6f, -0.8f, 0, 0.25f);
        cut_by(front, -0.6f, -0.8f, 0, 0.25f);
        compare(&scene);
    }
    free_skin(&skin);
    free_skin(&floor);
    lom_free_mesh(torus);
    lom_free_mesh(fine);
    lom_free_mesh(ground);
}

/* Meshes of files, with their textures; a few thousand triangles of all sizes. */
static void meshes_of_files_are_the_same_bytes(void)
{
    static const char *const files[][2] = { { "assets/entities/cabin.obj", "assets/entities/log.png" },
                                            { "assets/entities/aircraft.obj", "assets/entities/livery.png" },
                                            { "assets/entities/spruce.obj", "assets/entities/needles.png" } };
    for (int file = 0; file < 3; file++) {
        lom_error error = { .code = LOM_OK };
        lom_mesh *mesh = lom_read_obj(files[file][0], &error);
        struct skin skin = read_skin(files[file][1]);
        CHECK(mesh != NULL, "%s", error.text);
        for (int camera = file; camera < 6 && mesh != NULL; camera++) {
            struct scene scene = { .name = files[file][0] };
            lom_box box = lom_mesh_bounds(mesh);
            double size = 4 / lom_vec3_length(lom_vec3_subtract(box.high, box.low));
            lom_mat4 model =
                lom_model_matrix((lom_vec3){ 0, -0.2, 0 }, (lom_vec3){ 0, 0.7, 0 }, (lom_vec3){ size, size, size });
            sized(&scene, camera);
            aim(&scene, 0.05);
            struct draw *draw = add(&scene, mesh, &skin, &model);
            draw->blends = camera % 2 == 1;
            draw->uniforms.opacity = 0.8f;
            cut_by(draw, 0.3f, -0.7f, 0.1f, 0.6f);
            compare(&scene);
        }
        free_skin(&skin);
        lom_free_mesh(mesh);
    }
}

static float between(uint64_t counter, float low, float high)
{
    return low + (high - low) * (float)lom_random_uniform(99, counter);
}

/* Position of a vertex of the heap: clip x, y and w. Some on pixel centres and corners of a grid, some behind the eye, at
 * it, far outside of the guard band, or no numbers at all. */
static void throw_vertex(uint64_t n, const struct scene *scene, float position[3])
{
    static const float odd[] = { 0, -0.0f, 1e-38f, 1e-30f, 1e30f, -1e30f, 0x1p123f, 0x1p125f, -1, 1e-6f };
    uint64_t kind = lom_random_bits(5, n / 3) % 16;
    float scale = kind < 4 ? 0.05f : kind < 8 ? 0.4f : 3;
    for (uint64_t i = 0; i < 2; i++)
        position[i] = between(n / 3 * 8 + i, -1, 1) + between(n * 8 + 4 + i, -scale, scale);
    position[2] = kind % 4 == 0 ? 1 : between(n * 8 + 6, kind == 15 ? -1.0f : 0.2f, 2);
    if (kind % 4 == 0 && kind > 0) { /* whole and half pixels */
        position[0] = rintf(position[0] * (float)scene->width) / (float)scene->width;
        position[1] = rintf(position[1] * (float)scene->height) / (float)scene->height;
    }
    if (lom_random_bits(6, n) % 40 == 0)
        position[lom_random_bits(7, n) % 3] = odd[lom_random_bits(8, n) % 10];
    if (lom_random_bits(6, n) % 400 == 1)
        position[0] = lom_random_bits(7, n) % 2 == 0 ? __builtin_nanf("") : __builtin_inff();
}

static void heaps_of_wild_triangles_are_the_same_bytes(void)
{
    enum { TRIANGLES = 600 };
    lom_mesh *mesh = lom_create_mesh(3 * TRIANGLES, 3 * TRIANGLES, 0, 0, NULL);
    struct skin skin = make_noise(1, 32);
    for (int heap = 0; heap < 8; heap++) {
        struct scene scene = { .name = "heap" };
        sized(&scene, heap);
        scene.view_projection = lom_identity();
        lom_mat4 still = lom_identity();
        for (size_t i = 0; i < 3 * TRIANGLES; i++) {
            lom_mesh_vertex *v = &mesh->vertices[i];
            uint64_t n = i + 3 * TRIANGLES * (uint64_t)heap;
            throw_vertex(n, &scene, v->position);
            for (uint64_t k = 0; k < 3; k++)
                v->normal[k] = between(n * 8 + k + 77777, -1, 1);
            v->uv[0] = between(n, -3, 3);
            v->uv[1] = between(n + 1234567, -300, 300);
            mesh->indices[i] = (uint32_t)(i % 9 == 4 ? i - 3 : i);
        }
        struct draw *draw = add(&scene, mesh, &skin, &still);
        const float rows[2][4] = { { 0.2f, 0.45f, 0.1f, 0.3f },
                                   { 0, 0, 1, 0 } }; /* beyond the near and the far plane */
        memcpy(draw->uniforms.to_clip.m[2], rows, sizeof rows);
        draw->blends = heap % 2 == 0;
        draw->uniforms.opacity = 0.6f;
        draw->cull = heap % 3 - 1;
        cut_by(draw, 0.5f, 0.25f, 0, heap % 4 == 3 ? -0.125f : 0.5f);
        compare(&scene);
    }
    free_skin(&skin);
    lom_free_mesh(mesh);
}

/* Flat triangles over all of the picture, in clip space: halves whose plane goes through pixel centres, which one of them
 * has; and one whose vertices all lie beyond the guard band. */
static void planes_through_pixel_centres_are_the_same_bytes(void)
{
    static const int sizes[][2] = { { 33, 33 }, { 65, 17 }, { 255, 129 } };
    static const float planes[][3] = { { 1, 0, 0 }, { 0, 1, 0 }, { 1, 1, 0 }, { 1, -1, 0 }, { 0.5f, 0.25f, 0 } };
    lom_mat4 still = lom_identity();
    lom_mesh *square = lom_make_quad(2, 2, NULL), *huge = lom_make_quad(2, 2, NULL);
    struct skin skin = make_noise(32, 32);
    huge->index_count = 3;
    for (size_t i = 0; i < 4; i++) { /* from y to z; three far corners around the picture */
        float at[3][2] = { { -30000, -30000 }, { 30000, -30000 }, { 0, 50000 } };
        square->vertices[i].position[1] = -square->vertices[i].position[2];
        memcpy(huge->vertices[i].position, at[i % 3], sizeof at[0]);
        huge->indices[i % 3] = (uint32_t)(i % 3);
    }
    for (int i = 0; i < 15; i++) {
        struct scene scene = { .name = "square", .camera = i, .width = sizes[i % 3][0], .height = sizes[i % 3][1] };
        scene.view_projection = still;
        scene.eye = (lom_vec3){ 0, 0, 3 };
        for (int half = 0; half < 2; half++) {
            const float *plane = planes[i / 3], sign = half == 0 ? 1 : -1;
            struct draw *draw = add(&scene, square, &skin, &still);
            cut_by(draw, sign * plane[0], sign * plane[1], 0, 0);
            draw->uniforms.tiling[half] = 7;
        }
        struct draw *over = add(&scene, huge, &skin, &still);
        over->blends = true;
        over->uniforms.opacity = 0.5f;
        for (int d = 0; d < 3; d++) { /* z = 0.25 and 0.5, w = 1 */
            const float rows[2][4] = { { 0, 0, 0, d == 2 ? 0.5f : 0.25f }, { 0, 0, 0, 1 } };
            memcpy(scene.draw[d].uniforms.to_clip.m[2], rows, sizeof rows);
        }
        compare(&scene);
    }
    free_skin(&skin);
    lom_free_mesh(square);
    lom_free_mesh(huge);
}

static void more_than_a_million_pixels_were_compared(void)
{
    CHECK(pixels_compared >= 1e6, "only %.0f", pixels_compared);
}

int main(int argc, char **argv)
{
    RUN(planes_through_pixel_centres_are_the_same_bytes);
    RUN(a_cut_torus_on_the_ground_is_the_same_bytes);
    RUN(meshes_of_files_are_the_same_bytes);
    RUN(heaps_of_wild_triangles_are_the_same_bytes);
    if (argc == 1)
        RUN(more_than_a_million_pixels_were_compared);
    return check_result();
}
