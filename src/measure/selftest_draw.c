/* The parts of the self-test that draw. In: a device descriptor; out: the hash of every attachment of a pass, floats
 * and depth among them, and of a frame of a scene from memory. */
#include "pipeline/check_device.h"
#include "measure/selftest.h"

#include <lom/render.h>

#include <string.h>

enum { WIDTH = 64, HEIGHT = 48 };

/* What a pass draws into. */
struct targets {
    int colors;
    lom_texture *color[LOM_MAX_COLORS], *depth;
};

static lom_texture *make_target(lom_device *device, lom_format format)
{
    return lom_make_texture(device, &(lom_texture_desc){ .width = WIDTH, .height = HEIGHT, .format = format });
}

static struct targets make_targets(lom_device *device, int colors, lom_format color, lom_format depth)
{
    struct targets targets = { .colors = colors };
    for (int i = 0; i < colors; i++)
        targets.color[i] = make_target(device, color);
    if (depth != LOM_FORMAT_NONE)
        targets.depth = make_target(device, depth);
    return targets;
}

static lom_pass_desc pass_into(const struct targets *targets)
{
    lom_pass_desc pass = { .depth = targets->depth };
    for (int i = 0; i < targets->colors; i++) {
        pass.color[i] = targets->color[i];
        for (int c = 0; c < 4; c++)
            pass.clear_color[i][c] = 0.1f + 0.2f * (float)c;
    }
    return pass;
}

/* The picture in 8 bits in the sheet's next cell. */
static bool show_image(struct lom_selftest_sum *sum, const lom_image *image, lom_error *error)
{
    int left = sum->shown % LOM_CELL_COLUMNS * LOM_CELL_WIDTH, top = sum->shown / LOM_CELL_COLUMNS * LOM_CELL_HEIGHT;
    lom_image *bytes = lom_convert_image(image, LOM_FORMAT_RGB8, error);
    sum->shown++;
    for (int y = 0; bytes != NULL && y < bytes->height; y++)
        memcpy(lom_image_pixel(sum->sheet, left, top + y, 0), lom_image_pixel(bytes, 0, y, 0),
               (size_t)bytes->width * 3);
    lom_free_image(bytes);
    return bytes != NULL;
}

/* Adds the picture, and frees it; NULL: the error says why. */
static bool add_image(struct lom_selftest_sum *sum, lom_image *image, lom_error *error)
{
    bool done = image != NULL;
    if (done) {
        sum->hash = lom_selftest_add(sum->hash, lom_hash_image(image));
        done = sum->sheet == NULL || show_image(sum, image, error);
    }
    lom_free_image(image);
    return done;
}

/* Ends the pass and hashes what it drew. */
static bool finish(struct lom_selftest_sum *sum, lom_device *device, const struct targets *targets, lom_error *error)
{
    lom_end_pass(device);
    if (!lom_check_device(device, error))
        return false;
    for (int i = 0; i < targets->colors; i++)
        if (!add_image(sum, lom_read_texture(targets->color[i], 0, 0, error), error))
            return false;
    return targets->depth == NULL || add_image(sum, lom_read_texture(targets->depth, 0, 0, error), error);
}

static uint8_t texel(int layer, int x, int y, int channel)
{
    return (uint8_t)(lom_random_bits((uint64_t)channel, (uint64_t)(((layer * 64) + y / 3) * 64 + x / 2)) & 255);
}

static lom_texture *make_pattern(lom_device *device, lom_texture_desc desc)
{
    int layers = desc.kind == LOM_TEXTURE_CUBE ? 6 : desc.depth > 0 ? desc.depth : 1;
    lom_image *image = lom_create_image(desc.width, desc.height, layers, LOM_FORMAT_RGBA8, NULL);
    if (image == NULL)
        return NULL;
    for (int z = 0; z < layers; z++)
        for (int y = 0; y < desc.height; y++)
            for (int x = 0; x < desc.width; x++)
                for (int c = 0; c < 4; c++)
                    ((uint8_t *)lom_image_pixel(image, x, y, z))[c] = texel(z, x, y, c);
    desc.pixels = image->pixels;
    desc.mips = LOM_MIPS_ALL;
    lom_texture *texture = lom_make_texture(device, &desc);
    lom_free_image(image);
    return texture;
}

/* The eye stands close to a torus, so that its front is cut by the near plane. */
static struct lom_selftest_uniforms make_uniforms(lom_device *device)
{
    lom_mat4 projection = lom_perspective(1.2, (double)WIDTH / HEIGHT, 0.4);
    lom_mat4 view = lom_look_at((lom_vec3){ 0.9, 0.7, 1.1 }, (lom_vec3){ 0.3, 0, 0 }, (lom_vec3){ 0.1, 1, 0 });
    lom_mat4 clip_from_world = lom_multiply(&projection, &view);
    struct lom_selftest_uniforms u = { .light = { .to_light = { 0.6f, 0.64f, 0.48f }, .color = { 1, 1, 1 } },
                                       .plane = { { 0.3f, 1, 0.2f, 0.25f }, { -1, 0.1f, 0.5f, 0.8f } },
                                       .depth = 0.375f };
    u.clip_from_world = lom_round_matrix(&clip_from_world);
    u.texture = make_pattern(device, (lom_texture_desc){ .width = 37,
                                                         .height = 50,
                                                         .format = LOM_FORMAT_RGBA8_SRGB,
                                                         .sampler = { .wrap_t = LOM_WRAP_MIRROR } });
    u.cube = make_pattern(device, (lom_texture_desc){ .kind = LOM_TEXTURE_CUBE, .width = 16, .height = 16 });
    u.volume = make_pattern(
        device,
        (lom_texture_desc){
            .kind = LOM_TEXTURE_3D, .width = 9, .height = 8, .depth = 7, .sampler = { .wrap_r = LOM_WRAP_CLAMP } });
    return u;
}

static void draw_strip(lom_device *device, const lom_shader *shader, const struct lom_selftest_uniforms *uniforms)
{
    lom_draw(device, &(lom_draw_desc){ .shader = shader,
                                       .uniforms = uniforms,
                                       .count = 4,
                                       .vertex_count = 4,
                                       .topology = LOM_TRIANGLE_STRIP,
                                       .depth_compare = LOM_COMPARE_ALWAYS });
}

static lom_draw_desc mesh_draw(const lom_mesh *mesh, const lom_shader *shader,
                               const struct lom_selftest_uniforms *uniforms)
{
    const uint8_t *data = (const uint8_t *)mesh->vertices;
    static const lom_attribute_kind kinds[] = { LOM_ATTRIBUTE_FLOAT3, LOM_ATTRIBUTE_FLOAT3, LOM_ATTRIBUTE_FLOAT2,
                                                LOM_ATTRIBUTE_FLOAT4 };
    static const size_t offsets[] = { 0, 12, 24, 32 };
    size_t size = mesh->vertex_count * sizeof(lom_mesh_vertex);
    lom_draw_desc draw = {
        .shader = shader, .uniforms = uniforms, .indices = mesh->indices, .count = mesh->index_count, .instances = 2
    };
    for (int i = 0; i < 4; i++)
        draw.attribute[i] = (lom_attribute){ data + offsets[i], size - offsets[i], sizeof(lom_mesh_vertex), kinds[i] };
    return draw;
}

bool lom_selftest_draw_functions(struct lom_selftest_sum *sum, const lom_device_desc *desc, lom_error *error)
{
    lom_device *device = lom_open_device(desc);
    struct lom_selftest_uniforms uniforms = { .depth = 0.5f };
    struct targets targets = make_targets(device, 4, LOM_FORMAT_RGBA32F, LOM_FORMAT_NONE);
    lom_pass_desc pass = pass_into(&targets);
    lom_begin_pass(device, &pass);
    draw_strip(device, &lom_selftest_functions, &uniforms);
    bool done = finish(sum, device, &targets, error);
    lom_close_device(device);
    return done;
}

bool lom_selftest_draw_textured(struct lom_selftest_sum *sum, const lom_device_desc *desc, lom_error *error)
{
    static const lom_format formats[] = { LOM_FORMAT_RGBA8_SRGB, LOM_FORMAT_RGBA16F };
    lom_device *device = lom_open_device(desc);
    lom_mesh *mesh = lom_make_torus(1, 0.4, 40, 20, error);
    struct lom_selftest_uniforms uniforms = make_uniforms(device);
    bool done = mesh != NULL;
    for (int i = 0; done && i < 2; i++) {
        struct targets targets = make_targets(device, 1, formats[i], LOM_FORMAT_DEPTH32F);
        lom_pass_desc pass = pass_into(&targets);
        lom_draw_desc draw = mesh_draw(mesh, &lom_selftest_textured, &uniforms);
        draw.cull = i == 0 ? LOM_CULL_BACK : LOM_CULL_NONE;
        lom_begin_pass(device, &pass);
        lom_draw(device, &draw);
        done = finish(sum, device, &targets, error);
    }
    lom_free_mesh(mesh);
    lom_close_device(device);
    return done;
}

static const lom_blend over = { .enabled = true,
                                .source_color = LOM_FACTOR_SOURCE_ALPHA,
                                .target_color = LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA,
                                .source_alpha = LOM_FACTOR_ONE,
                                .target_alpha = LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA };
static const lom_blend largest = { .enabled = true,
                                   .source_color = LOM_FACTOR_ONE,
                                   .target_color = LOM_FACTOR_ONE,
                                   .color_operation = LOM_BLEND_MAX,
                                   .alpha_operation = LOM_BLEND_MIN };

bool lom_selftest_draw_cut(struct lom_selftest_sum *sum, const lom_device_desc *desc, lom_error *error)
{
    static const lom_format formats[] = { LOM_FORMAT_RGBA8, LOM_FORMAT_RGBA32F, LOM_FORMAT_RGBA16 };
    lom_device *device = lom_open_device(desc);
    lom_mesh *mesh = lom_make_torus(1, 0.4, 30, 15, error);
    struct lom_selftest_uniforms uniforms = make_uniforms(device);
    bool done = mesh != NULL;
    for (int i = 0; done && i < 3; i++) {
        struct targets targets = make_targets(device, 2, formats[i], LOM_FORMAT_DEPTH24);
        lom_pass_desc pass = pass_into(&targets);
        lom_draw_desc draw = mesh_draw(mesh, &lom_selftest_cut, &uniforms);
        draw.blend[0] = over;
        draw.blend[1] = largest;
        draw.mask_off[0] = (uint8_t)(i == 2 ? 2 : 0);
        draw.depth_write_off = i == 1;
        pass.scissor = i == 2 ? (lom_rect){ 5, 3, 51, 40 } : (lom_rect){ 0, 0, 0, 0 };
        lom_begin_pass(device, &pass);
        lom_draw(device, &draw);
        done = finish(sum, device, &targets, error);
    }
    lom_free_mesh(mesh);
    lom_close_device(device);
    return done;
}

bool lom_selftest_draw_samples(struct lom_selftest_sum *sum, const lom_device_desc *desc, lom_error *error)
{
    lom_device *device = lom_open_device(desc);
    struct lom_selftest_uniforms uniforms = make_uniforms(device);
    bool done = true;
    for (int depth = LOM_FORMAT_DEPTH16; done && depth <= LOM_FORMAT_DEPTH32F; depth++) {
        struct targets targets = make_targets(device, 3, LOM_FORMAT_RGBA32F, (lom_format)depth);
        lom_pass_desc pass = pass_into(&targets);
        lom_begin_pass(device, &pass);
        draw_strip(device, &lom_selftest_samples, &uniforms);
        done = finish(sum, device, &targets, error);
    }
    lom_close_device(device);
    return done;
}

static const char lake_scene[] =
    "[output]\nwidth = 72\nheight = 40\n[camera]\nposition = [0, 2, 9]\ntarget = [1, 0.5, 0]\n"
    "[light]\nazimuth = 30\nelevation = 12\n[sky]\ncolor = [0.3, 0.5, 0.9]\n"
    "[water]\nsize = [30, 20]\nshininess = 20\n[quality]\nwater = 'planar'\n";

bool lom_selftest_draw_lake(struct lom_selftest_sum *sum, const lom_device_desc *desc, lom_error *error)
{
    lom_scene *scene = lom_decode_scene(lake_scene, strlen(lake_scene), "selftest.toml", NULL, 0, error);
    lom_renderer *renderer = scene != NULL ? lom_create_renderer(scene, desc, error) : NULL;
    lom_frame frame = { .image = NULL };
    bool done = renderer != NULL && lom_render_frame(renderer, &(lom_frame_desc){ .frame = 7 }, &frame, error);
    done = done && add_image(sum, frame.image, error);
    lom_free_renderer(renderer);
    lom_free_scene(scene);
    return done;
}
