/* Proves that no byte depends on the float state that the caller left behind (rounding in any direction, denormals
 * flushed, every exception a trap), and that the caller finds it again: for pictures, textures, files, meshes, and a
 * whole scene read, loaded and drawn, on one thread and on several. */
#include "check.h"
#include "hostile.h"
#include "small_scene.h"

#include <lom/cloud.h>
#include <lom/march.h>
#include <lom/fluid.h>
#include <lom/shallow.h>
#include <lom/sky.h>
#include <lom/texture.h>
#include <lom/waves.h>

/* A task gives a hash of what it made; 0 on failure. */
typedef uint64_t task(lom_error *error);

static uint64_t draw_alone(lom_error *error)
{
    uint64_t hash;
    draw_small_scene(&(lom_device_desc){ .threads = 1 }, &hash, error);
    return hash;
}

static uint64_t draw_with_workers(lom_error *error)
{
    uint64_t hash;
    draw_small_scene(&(lom_device_desc){ .threads = 3, .tile = 16 }, &hash, error);
    return hash;
}

/* Floats of all sizes, denormals among them; no arithmetic of floats here, which would trap. */
static lom_image *make_floats(lom_error *error)
{
    lom_image *image = lom_create_image(9, 7, 1, LOM_FORMAT_RGBA32F, error);
    for (size_t i = 0; image != NULL && i < 9 * 7 * 4; i++) {
        uint32_t exponent = (uint32_t)(i % 3 == 0 ? 120 + i % 9 : i % 140),
                 bits = exponent << 23 | (uint32_t)(i * 78901);
        memcpy(image->pixels + 4 * i, &bits, 4);
    }
    return image;
}

static uint64_t hash_and_free(lom_image *image, uint64_t hash)
{
    if (image != NULL) {
        uint64_t own = lom_hash_image(image);
        hash = lom_hash_bytes(hash, &own, sizeof own);
    }
    lom_free_image(image);
    return hash;
}

static uint64_t convert(lom_error *error)
{
    static const lom_format formats[] = { LOM_FORMAT_RGBA8, LOM_FORMAT_RGB8_SRGB, LOM_FORMAT_R16, LOM_FORMAT_RGBA16F,
                                          LOM_FORMAT_R32F };
    lom_image *image = make_floats(error);
    uint64_t hash = LOM_HASH_START;
    for (int i = 0; image != NULL && i < 5; i++)
        hash = hash_and_free(lom_convert_image(image, formats[i], error), hash);
    lom_free_image(image);
    return hash;
}

static uint64_t make_levels(lom_error *error)
{
    static const lom_format formats[] = { LOM_FORMAT_RGBA8, LOM_FORMAT_RGBA8_SRGB, LOM_FORMAT_RGBA16,
                                          LOM_FORMAT_RGBA16F, LOM_FORMAT_RGBA32F };
    lom_image *image = make_floats(error);
    uint64_t hash = LOM_HASH_START;
    for (int i = 0; image != NULL && i < 5; i++) {
        lom_image *same = lom_convert_image(image, formats[i], error);
        lom_texture *texture = lom_create_texture(&(lom_texture_desc){ .width = 9,
                                                                       .height = 7,
                                                                       .format = formats[i],
                                                                       .pixels = same == NULL ? NULL : same->pixels,
                                                                       .mips = LOM_MIPS_ALL },
                                                  error);
        for (int level = 0; texture != NULL && level < lom_texture_levels(texture); level++)
            hash = hash_and_free(lom_read_texture(texture, level, 0, error), hash);
        lom_free_texture(texture);
        lom_free_image(same);
    }
    lom_free_image(image);
    return hash;
}

static uint64_t code_pictures(lom_error *error)
{
    static const char *const kinds[] = { "png", "ppm", "pam", "pfm" };
    static const lom_format formats[] = { LOM_FORMAT_RGB8, LOM_FORMAT_RGB16, LOM_FORMAT_RGBA8, LOM_FORMAT_RGB32F };
    lom_image *image = make_floats(error);
    uint64_t hash = LOM_HASH_START;
    for (int i = 0; image != NULL && i < 4; i++) {
        lom_image *same = lom_convert_image(image, formats[i], error);
        lom_bytes bytes = same == NULL ? (lom_bytes){ 0 } : lom_encode_image(kinds[i], same, error);
        if (bytes.data != NULL) {
            hash = lom_hash_bytes(hash, bytes.data, bytes.size);
            hash = hash_and_free(lom_decode_image(bytes.data, bytes.size, "picture", error), hash);
        }
        lom_release(bytes.data);
        lom_free_image(same);
    }
    static const char scaled[] = "Pf 2 1 3.7\n\x3f\x80\x00\x00\x00\x00\x00\x07";
    hash = hash_and_free(lom_decode_image((const uint8_t *)scaled, sizeof scaled - 1, "scaled", error), hash);
    lom_free_image(image);
    return hash;
}

static uint64_t read_mesh(lom_error *error)
{
    lom_mesh *mesh = lom_read_obj(small_path("box.obj"), error);
    if (mesh == NULL)
        return 0;
    uint64_t hash = lom_hash_bytes(LOM_HASH_START, mesh->vertices, mesh->vertex_count * sizeof *mesh->vertices);
    lom_free_mesh(mesh);
    return hash;
}

static uint64_t compare(lom_error *error)
{
    lom_image *a = lom_read_image(small_path("color.png"), error), *b = lom_read_image(small_path("normal.png"), error);
    lom_comparison result;
    double ssim = 0, flip = 0;
    uint64_t hash = 0;
    memset(&result, 0, sizeof result);
    if (a != NULL && b != NULL && lom_compare_images(a, b, &result, error) && lom_compare_ssim(a, b, &ssim, error) &&
        lom_compare_flip(a, b, &flip, error)) {
        double found[] = { result.rmse, result.psnr, ssim, flip };
        hash = lom_hash_bytes(LOM_HASH_START, found, sizeof found);
    }
    lom_free_image(a);
    lom_free_image(b);
    return hash;
}

/* The sentence about a frame that is too large, with its numbers. */
static uint64_t refuse_frame(lom_error *error)
{
    lom_scene *scene = lom_read_scene(small_path("scene.toml"), NULL, 0, error);
    static const lom_frame_desc little = { .memory = 1e-6 };
    lom_error refused = { 0 };
    bool small = scene != NULL && lom_check_frame(scene, &little, &refused);
    lom_free_scene(scene);
    return small || refused.code != LOM_ERROR_LIMIT
               ? 0
               : lom_hash_bytes(LOM_HASH_START, refused.text, strlen(refused.text));
}

static uint64_t make_pictures(lom_error *error)
{
    static const double rays = 0.3;
    return hash_and_free(lom_make_sun_picture(16, rays, error),
                         hash_and_free(lom_make_cloud_picture(16, 3, error), LOM_HASH_START));
}

/* Densities of all sizes. */
static lom_image *make_density(lom_error *error)
{
    lom_image *image = lom_create_image(8, 7, 6, LOM_FORMAT_R8, error);
    for (size_t i = 0; image != NULL && i < lom_image_size(image); i++)
        image->pixels[i] = (uint8_t)(i * 37 % 256);
    return image;
}

static uint64_t light_volumes(lom_error *error)
{
    static const double to_light[3] = { 0.3, 1, 0.1 }, scale = 0.5, lighter = 0.7, dark = 0.3;
    static const lom_light_desc sun = {
        .size = { 9, 8, 7 }, .extinction = 0.3f, .to_light = { 0.6f, 0.8f, 0 }, .forward = 0.4f
    };
    float eroded[256];
    for (int i = 0; i < 256; i++)
        eroded[i] = (float)i / 256; /* exact */
    lom_image *density = make_density(error);
    if (density == NULL)
        return 0;
    uint64_t hash = hash_and_free(lom_light_cloud_in_advance(density, to_light, lighter, dark, error), LOM_HASH_START);
    lom_light_grid *grid = lom_create_light_grid(density, scale, eroded, error);
    if (grid != NULL && lom_sweep_sun(grid, &sun, error)) {
        lom_sweep_sky(grid, sun.size, sun.extinction);
        hash = lom_hash_bytes(hash, grid->light,
                              (size_t)grid->width * (size_t)grid->height * (size_t)grid->depth * sizeof *grid->light);
    }
    lom_free_light_grid(grid);
    lom_free_image(density);
    return hash;
}

static uint64_t flow(lom_error *error)
{
    static const double bed[9] = { 0, 0.1, 0.3, 1.3, 1e-310, 0, 0.7, 0, 2 };
    static const lom_shallow_desc desc = {
        .columns = 3, .rows = 3, .cell = 0.7, .bed = bed, .level = 0.9, .step = 0.1
    };
    static const lom_shallow_source spring = { .x = 1.1, .z = 0.9, .radius = 0.8, .rate = 0.37 };
    static const lom_shallow_obstacle body = { .x = 1, .z = 1, .half = { 0.8, 0.9 }, .heading = 0.4, .draft = 0.3 };
    lom_shallow *water = lom_create_shallow(&desc, error);
    for (int i = 0; water != NULL && i < 5; i++)
        lom_step_shallow(water, &spring, 1, &body, 1, error);
    uint64_t hash = water != NULL ? lom_hash_bytes(LOM_HASH_START, lom_view_shallow(water).depth, sizeof bed) : 0;
    lom_free_shallow(water);
    return hash;
}

static uint64_t flow_freely(lom_error *error)
{
    static const lom_fluid_body block = { .high = { 0.5, 0.7, 1 }, .velocity = { 1e-310, 0.3, 0.1 } };
    lom_fluid *fluid = lom_create_fluid(&(lom_fluid_desc){ .high = { 1, 1, 0.4 },
                                                           .spacing = 0.1,
                                                           .gravity = { 0, -9.8, 0 },
                                                           .viscosity = 0.01,
                                                           .blocks = &block,
                                                           .block_count = 1 },
                                        error);
    for (int i = 0; fluid != NULL && i < 5; i++)
        lom_step_fluid(fluid, NULL, error);
    uint64_t hash = LOM_HASH_START;
    for (size_t i = 0; fluid != NULL && i < lom_view_fluid(fluid).particles; i++) {
        const lom_fluid_particle particle = lom_fluid_particle_at(fluid, i);
        hash = lom_hash_bytes(hash, particle.position, sizeof particle.position);
    }
    lom_free_fluid(fluid);
    return hash;
}

static uint64_t make_waves(lom_error *error)
{
    static const lom_water_waves waves = {
        .count = 4, .length = { 7, 1 }, .height = 0.3, .steepness = 0.6, .direction = 0.3, .spread = 0.5
    };
    lom_trochoid made[LOM_MAX_WAVES];
    memset(made, 0, sizeof made);
    return lom_make_trochoids(&waves, made, NULL, error) == 4 ? lom_hash_bytes(LOM_HASH_START, made, 4 * sizeof *made)
                                                              : 0;
}

static void check_task(task *run, const char *name)
{
    lom_error error = { 0 };
    uint64_t first = run(&error);
    CHECK(error.code == LOM_OK && first != 0, "%s: %s", name, error.text);
    for (int i = 0; i < HOSTILE_MODES; i++) {
        hostile_state state = enter_hostile_state(hostile_modes[i]);
        uint64_t hash = run(&error);
        CHECK(leave_hostile_state(&state), "%s, mode %d: the caller's state is another", name, i);
        CHECK(hash == first, "%s, mode %d: %016llx, not %016llx; %s", name, i, (unsigned long long)hash,
              (unsigned long long)first, error.text);
    }
}

static void pictures_do_not_see_it(void)
{
    check_task(convert, "conversions");
    check_task(code_pictures, "files");
    check_task(compare, "comparison");
}

static void textures_do_not_see_it(void)
{
    check_task(make_levels, "levels");
}

static void meshes_do_not_see_it(void)
{
    check_task(read_mesh, "a mesh");
}

static void what_is_made_does_not_see_it(void)
{
    check_task(make_pictures, "the sun and a flat cloud");
    check_task(light_volumes, "light in a volume");
    check_task(flow, "shallow water");
    check_task(flow_freely, "a liquid of particles");
    check_task(make_waves, "trochoids");
}

static void scenes_do_not_see_it(void)
{
    check_task(refuse_frame, "the limit of a frame");
    check_task(draw_alone, "a scene");
    check_task(draw_with_workers, "a scene with workers");
}

int main(int argc, char **argv)
{
    if (!make_small_scene())
        return 1;
    RUN(pictures_do_not_see_it);
    RUN(textures_do_not_see_it);
    RUN(meshes_do_not_see_it);
    RUN(what_is_made_does_not_see_it);
    RUN(scenes_do_not_see_it);
    remove_small_scene();
    return check_result();
}
