/* Proves what failing memory does to making, encoding, comparing and placing things: whichever allocation fails, once or
 * from there on, there is an error with a sentence or the same bytes as without the fault, and nothing leaks. What takes
 * long is tried at evenly spread allocations. */
#include "faults.h"

#include "cloud/cloud_draw.h"
#include "pipeline/check_device.h"
#include "spray/make_foam.h"
#include "waves/surf.h"
#include "world/world.h"

#include <lom/lom.h>

/* ---- what is made before the faults begin ---- */

static lom_image *color, *gray, *floats, *noise, *other;
static lom_mesh *mesh;

static bool prepare(void)
{
    lom_error error = { 0 };
    color = lom_read_image(small_path("color.png"), &error);
    gray = lom_convert_image(color, LOM_FORMAT_R8, &error);
    floats = lom_convert_image(color, LOM_FORMAT_RGB32F, &error);
    noise = lom_create_image(160, 160, 1, LOM_FORMAT_RGB8, &error); /* longer than a stored block */
    for (size_t i = 0; i < lom_image_size(noise); i++)
        noise->pixels[i] = (uint8_t)lom_random_bits(3, i);
    other = lom_convert_image(noise, LOM_FORMAT_RGB8, &error);
    other->pixels[500] ^= 9;
    mesh = lom_read_obj(small_path("box.obj"), &error);
    return mesh != NULL;
}

static bool hash_bytes(lom_bytes bytes, uint64_t *hash)
{
    *hash = lom_hash_bytes(LOM_HASH_START, bytes.data, bytes.size);
    lom_release(bytes.data);
    return bytes.data != NULL;
}

static bool hash_picture(lom_image *image, uint64_t *hash)
{
    *hash = image != NULL ? lom_hash_image(image) : 0;
    lom_free_image(image);
    return image != NULL;
}

static bool hash_mesh(lom_mesh *made, uint64_t *hash)
{
    *hash =
        made != NULL ? lom_hash_bytes(LOM_HASH_START, made->vertices, made->vertex_count * sizeof *made->vertices) : 0;
    lom_free_mesh(made);
    return made != NULL;
}

/* ---- tasks ---- */

static bool encode(const char *kind, uint64_t *hash, lom_error *error)
{
    const lom_image *image = strcmp(kind, "pgm") == 0 ? gray : strcmp(kind, "pfm") == 0 ? floats : color;
    return hash_bytes(lom_encode_image(kind, image, error), hash);
}

static bool encode_noise(const char *kind, uint64_t *hash, lom_error *error)
{
    return hash_bytes(lom_encode_image(kind, noise, error), hash);
}

static bool encode_video(const char *name, uint64_t *hash, lom_error *error)
{
    uint64_t header;
    (void)name;
    return hash_bytes(lom_encode_y4m_header(8, 8, 25, 1, error), &header) &&
           hash_bytes(lom_encode_y4m_frame(color, error), hash);
}

static bool convert(const char *name, uint64_t *hash, lom_error *error)
{
    (void)name;
    return hash_picture(lom_convert_image(color, LOM_FORMAT_RGBA16, error), hash);
}

static bool compare(const char *name, uint64_t *hash, lom_error *error)
{
    lom_comparison result;
    double numbers[2] = { 0, 0 };
    (void)name;
    if (!lom_compare_images(noise, other, &result, error) || !lom_compare_ssim(noise, other, &numbers[0], error) ||
        !lom_compare_flip(noise, other, &numbers[1], error) ||
        !hash_picture(lom_compare_picture(noise, other, error), hash))
        return false;
    *hash = lom_hash_bytes(*hash, numbers, sizeof numbers) + result.pixels;
    return true;
}

static bool encode_mesh(const char *name, uint64_t *hash, lom_error *error)
{
    uint64_t materials;
    (void)name;
    return hash_bytes(lom_encode_mtl(mesh, error), &materials) &&
           hash_bytes(lom_encode_obj(mesh, "box.mtl", error), hash);
}

static bool list_files(const char *name, uint64_t *hash, lom_error *error)
{
    lom_bytes list = lom_list_obj_files(small_path(name), error);
    bool listed = list.data != NULL && error->code == LOM_OK;
    *hash = lom_hash_bytes(LOM_HASH_START, list.data, list.size);
    lom_release(list.data);
    return listed;
}

static bool document(const char *name, uint64_t *hash, lom_error *error)
{
    (void)name;
    return hash_bytes(lom_write_scene_documentation(error), hash);
}

static bool make_entity(const char *name, uint64_t *hash, lom_error *error)
{
    return hash_mesh(lom_make_entity(name, 1, error), hash);
}

static bool copy_mesh(const char *name, uint64_t *hash, lom_error *error)
{
    (void)name;
    lom_mesh_builder *builder = lom_create_mesh_builder(error);
    if (builder == NULL)
        return false;
    lom_builder_mesh(builder, mesh);
    return hash_mesh(lom_finish_mesh(builder, 0.5, error), hash);
}

static bool make_picture(const char *name, uint64_t *hash, lom_error *error)
{
    const lom_cloud_desc cloud = { name, 8, 8, 8, 3 };
    if (strcmp(name, "normal-map") == 0)
        return hash_picture(lom_make_normal_map(&(lom_normal_map_desc){ .size = 128 }, error), hash);
    if (strcmp(name, "flow-map") == 0)
        return hash_picture(lom_make_flow_map(color, error), hash);
    if (strcmp(name, "cove") == 0)
        return hash_picture(lom_make_coast(name, 9, 1, error), hash);
    if (strcmp(name, "foam") == 0)
        return hash_picture(lom_make_foam(8, 1, error), hash);
    if (strcmp(name, "sun") == 0)
        return hash_picture(lom_make_sun_picture(8, 0.5, error), hash);
    if (strcmp(name, "flat-cloud") == 0)
        return hash_picture(lom_make_cloud_picture(8, 1, error), hash);
    if (strcmp(name, "rock") == 0)
        return hash_picture(lom_make_albedo(&(lom_albedo_desc){ .name = name, .size = 64 }, error), hash);
    return hash_picture(lom_make_cloud(&cloud, error), hash);
}

static bool make_sky(const char *name, uint64_t *hash, lom_error *error)
{
    lom_image *faces[6];
    (void)name;
    bool made = lom_make_sky_box(&(lom_sky_box_desc){ .size = 8 }, faces, error);
    *hash = made ? lom_hash_image(faces[5]) : 0;
    for (int i = 0; i < 6; i++)
        lom_free_image(faces[i]);
    return made;
}

static bool make_cube(const char *name, uint64_t *hash, lom_error *error)
{
    (void)name;
    return hash_picture(lom_make_sky_cube(&(lom_sky_box_desc){ .size = 8 }, error), hash);
}

static bool make_blue_noise(const char *name, uint64_t *hash, lom_error *error)
{
    (void)name;
    float *ranks = lom_make_blue_noise(8, 1, error);
    *hash = ranks != NULL ? lom_hash_bytes(LOM_HASH_START, ranks, 64 * sizeof *ranks) : 0;
    lom_release(ranks);
    return ranks != NULL;
}

static bool make_volumes(const char *name, uint64_t *hash, lom_error *error)
{
    (void)name;
    static const float linear[256];
    lom_image *density = lom_create_image(4, 4, 4, LOM_FORMAT_R8, error);
    lom_medium *medium = density != NULL ? lom_create_medium(density, error) : NULL;
    lom_detail *detail = medium != NULL ? lom_create_detail(density, error) : NULL;
    lom_volume *colors = detail != NULL ? lom_create_volume(density, error) : NULL;
    lom_light_grid *grid = colors != NULL ? lom_create_light_grid(density, 1, linear, error) : NULL;
    lom_reference_volume *volume =
        grid != NULL ? lom_create_reference_volume(
                           &(lom_reference_volume_desc){ .density = density, .high = { 1, 1, 1 } }, error)
                     : NULL;
    *hash = 1;
    lom_free_reference_volume(volume);
    lom_free_light_grid(grid);
    lom_free_volume(colors);
    lom_free_detail(detail);
    lom_free_medium(medium);
    lom_free_image(density);
    return volume != NULL;
}

/* A sea of two cascades, advanced and frozen; the waves are of no interest here. */
static bool make_sea(const char *name, uint64_t *hash, lom_error *error)
{
    const lom_sea_desc desc = { .cascade_count = 2, .cascade = { { .size = 16 }, { .size = 16 } } };
    (void)name;
    lom_device *device = lom_open_device(&(lom_device_desc){ .threads = 1 });
    lom_sea *sea = lom_check_device(device, error) ? lom_create_sea(&desc, device, error) : NULL;
    lom_sea_moment *moment =
        sea != NULL && lom_advance_sea(sea, device, 1, error) ? lom_freeze_sea(sea, 1, error) : NULL;
    *hash = moment != NULL ? (uint64_t)lom_view_cascade(sea, 0).waves : 0;
    lom_free_sea_moment(moment);
    lom_free_sea(sea);
    lom_close_device(device);
    return moment != NULL;
}

static double slope(const void *context, double x, double z)
{
    (void)context;
    return 0.1 + 0.3 * x + 0.1 * z;
}

static bool make_fluid(const char *name, uint64_t *hash, lom_error *error)
{
    static const lom_fluid_body block = { .high = { 0.5, 0.5, 1 } }, plate = { .high = { 1, 0.2, 1 }, .heats = true };
    (void)name;
    lom_fluid *fluid = lom_create_fluid(&(lom_fluid_desc){ .high = { 1, 1, 1 },
                                                           .ground = slope,
                                                           .spacing = 0.1,
                                                           .gravity = { 0, -9.8, 0 },
                                                           .viscosity = 0.01,
                                                           .conductivity = 0.01,
                                                           .blocks = &block,
                                                           .block_count = 1,
                                                           .solids = &plate,
                                                           .solid_count = 1 },
                                        error);
    bool done = fluid != NULL;
    for (int i = 0; done && i < 3; i++)
        done = lom_step_fluid(fluid, NULL, error);
    const lom_fluid_particle particle =
        done ? lom_fluid_particle_at(fluid, 7) : (lom_fluid_particle){ .temperature = 0 };
    *hash = lom_hash_bytes(LOM_HASH_START, particle.position, sizeof particle.position);
    lom_free_fluid(fluid);
    return done;
}

static bool make_shallow(const char *name, uint64_t *hash, lom_error *error)
{
    (void)name;
    static const double bed[20];
    lom_shallow *water =
        lom_create_shallow(&(lom_shallow_desc){ .columns = 5, .rows = 4, .cell = 1, .bed = bed, .level = 1 }, error);
    lom_shallow *copy = water != NULL ? lom_copy_shallow(water, error) : NULL;
    *hash = copy != NULL ? (uint64_t)lom_view_shallow(copy).columns : 0;
    lom_free_shallow(copy);
    lom_free_shallow(water);
    return copy != NULL;
}

static bool make_surf(const char *name, uint64_t *hash, lom_error *error)
{
    static double depth[8 * 8];
    for (int k = 0; k < 64; k++)
        depth[k] = 4 - 0.5 * (k / 8);
    const struct lom_surf_desc desc = { .width = 8,
                                        .height = 8,
                                        .spacing = { 2, 2 },
                                        .depth = depth,
                                        .surf = { .height = 0.3, .period = 3, .direction = 1.5 } };
    struct lom_surf_map map;
    (void)name;
    bool made = lom_make_surf_map(&map, &desc, error);
    *hash = made ? lom_hash_bytes(LOM_HASH_START, map.cells, 64 * sizeof *map.cells) : 0;
    if (made)
        lom_free_surf_map(&map);
    return made;
}

/* The scene as the reference sees it. */
static bool make_reference(const char *name, uint64_t *hash, lom_error *error)
{
    lom_scene *scene = lom_read_scene(small_path(name), NULL, 0, error);
    lom_reference *reference = scene != NULL ? lom_create_reference(scene, error) : NULL;
    *hash = 1;
    lom_free_reference(reference);
    lom_free_scene(scene);
    return reference != NULL;
}

/* The scene at two moments; its box moves. */
static bool place(const char *name, uint64_t *hash, lom_error *error)
{
    static const char *const moves[] = { "entity.box.key=[{time=0, position=[0,1,0]}, {time=1, position=[2,1,0]}]" };
    lom_scene *scene = lom_read_scene(small_path(name), moves, 1, error);
    struct lom_world *world = scene != NULL ? lom_create_world(scene, NULL, error) : NULL;
    struct lom_moment moment = { .placements = NULL };
    bool done = world != NULL && lom_world_at(world, 0, &moment, error) && lom_world_at(world, 0.5, &moment, error);
    *hash = 1;
    lom_free_moment(&moment);
    lom_free_world(world);
    lom_free_scene(scene);
    return done;
}

/* ---- tests ---- */

static void encoding(void)
{
    static const char *const kinds[] = { "png", "ppm", "pgm", "pam", "pfm", "qoi", "nrrd" };
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++)
        fail_memory(encode, kinds[i], 1, 0, 0);
    fail_memory(encode_noise, "png", 3, 0, 0);
    fail_memory(encode_video, "video", 2, 0, 0);
    fail_memory(encode_mesh, "mesh", 2, 0, 0);
    fail_memory(document, "documentation", 2, 0, 0);
}

static void comparing(void)
{
    fail_memory(convert, "convert", 2, 0, 0);
    fail_memory(compare, "compare", 5, 2, 0);
}

static void listing_and_placing(void)
{
    fail_memory(list_files, "box.obj", 5, 0, 0);
    fail_memory(place, "scene.toml", 10, 0, 0);
    fail_memory(make_reference, "scene.toml", 10, 0, 0);
}

static void making(void)
{
    static const char *const pictures[] = {
        "foam",       "normal-map",      "flow-map",  "cove",  "sun",    "flat-cloud", "rock",
        "hemisphere", "cumulus_humilis", "automaton", "puffs", "wyvill", "cirrus"
    };
    for (size_t i = 0; i < sizeof pictures / sizeof pictures[0]; i++)
        fail_memory(make_picture, pictures[i], 1, 0, 4);
    fail_memory(make_sky, "sky", 6, 0, 8);
    fail_memory(make_cube, "sky", 7, 0, 8);
    fail_memory(make_blue_noise, "blue noise", 2, 0, 0);
    fail_memory(make_volumes, "volumes", 5, 0, 0);
    fail_memory(make_sea, "sea", 10, 0, 0);
    fail_memory(make_shallow, "shallow", 8, 0, 0);
    fail_memory(make_fluid, "fluid", 25, 0, 0);
    fail_memory(make_surf, "surf", 4, 0, 0);
    fail_memory(copy_mesh, "mesh", 5, 0, 0);
    fail_memory(make_entity, "boat", 10, 0, 8);
    fail_memory(make_entity, "stones", 5, 0, 8);
}

int main(int argc, char **argv)
{
    if (!make_small_scene())
        return 1;
    if (!prepare())
        return 1;
    RUN(encoding);
    RUN(comparing);
    RUN(listing_and_placing);
    RUN(making);
    remove_small_scene();
    return check_result();
}
