/* Proves what a world says of a scene: entities stand on the triangles of the ground, move by their keys and are the
 * same at a time whatever was asked before; an entity's material counts before its mesh's and that before the default;
 * a map that cannot be read is a warning, a picture that the scene names an error; and a file is read once. */
#include "world_case.h"

#include "geometry/terrain.h"

#include <fcntl.h>
#include <stdarg.h>
#include <sys/types.h>

/* ---- files that are opened to be read (openat is wrapped: Makefile) ---- */

static struct {
    char path[200];
    int count;
} opened[64];
static int opened_count = -1; /* below 0: nobody asks */

int __real_openat(int folder, const char *path, int flags, ...);
int __wrap_openat(int folder, const char *path, int flags, ...);

static void note_opened(const char *path)
{
    int i = 0;
    while (i < opened_count && strcmp(opened[i].path, path) != 0)
        i++;
    if (i == opened_count && opened_count < 64) {
        snprintf(opened[opened_count].path, sizeof opened[0].path, "%s", path);
        opened[opened_count++].count = 0;
    }
    opened[i].count++;
}

int __wrap_openat(int folder, const char *path, int flags, ...)
{
    va_list rest;
    va_start(rest, flags);
    mode_t mode = va_arg(rest, mode_t);
    va_end(rest);
    if (opened_count >= 0 && (flags & O_ACCMODE) == O_RDONLY && strstr(path, small_folder) != NULL)
        note_opened(path);
    return __real_openat(folder, path, flags, mode);
}

/* ---- places ---- */

static void entities_stand_on_the_ground(void)
{
    if (!open_good(LAND BOX "on_ground = true\nposition = [7.3, 0.25, -11]\n" BOX "position = [7.3, 0.25, -11]\n" BOX
                            "visible = false\n"))
        return;
    lom_error error = { 0 };
    lom_image *map = lom_read_image(small_path("height.png"), &error);
    double ground = lom_terrain_height(map, 40, 30, 6, -3, 7.3, -11);
    struct lom_moment moment = { .time = 1 };
    CHECK(world->entity_count == 2 && lom_world_at(world, 0, &moment, &error), "%s", error.text);
    CHECK(ground > -3 && ground < 3 && world->entities[0].home.y == 0.25 + ground, "%g on %g",
          world->entities[0].home.y, ground);
    CHECK(moment.placements[0].world_from_model.m[1][3] == 0.25 + ground, "%g on %g",
          moment.placements[0].world_from_model.m[1][3], ground);
    CHECK(moment.placements[1].world_from_model.m[1][3] == 0.25, "%g in the air",
          moment.placements[1].world_from_model.m[1][3]);
    CHECK(moment.placements[0].bounds.low.y == 0.25 + ground && moment.placements[0].bounds.high.y == 2.25 + ground,
          "the box is 2 m high");
    CHECK(__builtin_fabs(world->entities[0].home_size - 2) < 1e-12, "%g", world->entities[0].home_size);
    lom_free_moment(&moment);
    lom_free_image(map);
    close_world();
}

static void check_row(void *context, int row, const lom_mesh_vertex *vertices)
{
    const struct lom_bed *bed = context;
    for (int i = 0; i <= bed->columns; i++)
        CHECK(bed->heights[row * (bed->columns + 1) + i] == vertices[i].position[1], "vertex %d, %d", i, row);
}

static void the_bed_is_the_terrains_vertices(void)
{
    if (!open_good(LAND))
        return;
    lom_error error = { 0 };
    CHECK(world->bed.columns == 5 && world->bed.rows == 5 && world->bed.base == -3 && world->bed.size[0] == 40 &&
              world->bed.size[1] == 30,
          "the map has 6 x 6 samples");
    CHECK(lom_visit_terrain(world->height_map, 40, 30, 6, 0, check_row, &world->bed, &error), "%s", error.text);
    struct lom_wave_site site = lom_world_wave_site(world, 0);
    CHECK(site.bed.heights == world->bed.heights && site.waves == &scene->water.waves, "the waves stand on it");
    close_world();
    if (!open_good("[camera]\nposition = [0, 1, 5]\n"))
        return;
    CHECK(world->bed.heights == NULL && world->height_map == NULL && world->entity_count == 0, "there is no terrain");
    close_world();
}

static const char moving[] =
    "[[camera.key]]\ntime = 0\nposition = [0, 3, 12]\n[[camera.key]]\ntime = 4\nposition = [8, 3, 12]\n"
    "[light]\n[[light.key]]\ntime = 0\nazimuth = 0\nelevation = 0\n[[light.key]]\ntime = 4\nazimuth = 0\n"
    "elevation = 60\n" BOX "name = 'still'\nposition = [5, 6, 7]\n" BOX
    "position = [1, 2, 3]\n[[entity.key]]\ntime = 0\nposition = [0, 1, 0]\n[[entity.key]]\ntime = 4\n"
    "position = [8, 1, 4]\nrotation = [0, 180, 0]\n";

static void what_moves_is_where_its_keys_say(void)
{
    if (!open_good(moving))
        return;
    lom_error error = { 0 };
    struct lom_moment moment = { .time = 0 }, alone = { .time = 0 };
    CHECK(lom_world_moves(world), "keys");
    CHECK(lom_world_at(world, 3.5, &moment, &error) && lom_world_at(world, 2, &moment, &error), "%s", error.text);
    const double(*m)[4] = moment.placements[1].world_from_model.m;
    CHECK(m[0][3] == 4 && m[1][3] == 1 && m[2][3] == 2, "%g %g %g", m[0][3], m[1][3], m[2][3]);
    CHECK(__builtin_fabs(m[0][2] - 1) < 1e-12 && __builtin_fabs(m[2][2]) < 1e-12, "turned by 90 degrees");
    const lom_mat4 *normals = &moment.placements[1].normal_from_model;
    CHECK(__builtin_fabs(normals->m[0][2] - 1) < 1e-12, "and its normals with it");
    CHECK(moment.placements[0].world_from_model.m[1][3] == 6, "the other stands still");
    CHECK(moment.camera.position.x == 4 && moment.time == 2, "%g", moment.camera.position.x);
    CHECK(__builtin_fabs(moment.to_light.y - 0.5) < 1e-12 && moment.to_light.y == -moment.scene.light.direction.y,
          "the sun is 30 degrees high: %g", moment.to_light.y);
    CHECK(world->entities[1].home.x == 1 && world->entities[1].home.y == 2, "it was put elsewhere");
    CHECK(lom_world_at(world, 2, &alone, &error), "%s", error.text);
    CHECK(memcmp(alone.placements, moment.placements, 2 * sizeof *moment.placements) == 0, "a time alone is the same");
    lom_free_moment(&alone);
    lom_free_moment(&moment);
    close_world();
    if (open_good(BOX))
        CHECK(!lom_world_moves(world), "no keys");
    close_world();
}

static void the_camera_in_an_entity_hides_it(void)
{
    for (int first = 0; first < 2; first++) {
        if (!open_good(first ? "[camera]\nfollow = 'me'\nperson = 'first'\n" BOX "name = 'other'\n" BOX "name = 'me'\n"
                             : "[camera]\nfollow = 'me'\n" BOX "name = 'other'\n" BOX "name = 'me'\n"))
            return;
        CHECK(!world->entities[0].is_hidden && world->entities[1].is_hidden == first, "person %d", first);
        close_world();
    }
}

/* ---- materials ---- */

static void the_entitys_own_material_counts_first(void)
{
    if (!open_good(BOX "material = { ambient = [0.1, 0.2, 0.3], shininess = 7 }\n" BOX
                       "material = { diffuse = [0.5, 0.6, 0.7], specular = [1, 0, 0], texture = 'layer.ppm' }\n"))
        return;
    CHECK(world->entities[0].mesh->part_count == 2, "skin and plain");
    for (int i = 0; i < 2; i++) {
        const lom_mesh *mesh = world->entities[i].mesh;
        for (size_t k = 0; k < mesh->part_count; k++) {
            const struct lom_world_part *part = &world->entities[i].parts[k];
            const lom_material *base = &mesh->materials[mesh->parts[k].material];
            const struct lom_world_material *m = &part->material;
            CHECK(part->first == mesh->parts[k].first_index && part->count == mesh->parts[k].index_count, "part %d",
                  (int)k);
            for (int c = 0; c < 3; c++) {
                const double ambient[3] = { 0.1, 0.2, 0.3 }, diffuse[3] = { 0.5, 0.6, 0.7 }, specular[3] = { 1, 0, 0 };
                CHECK(m->ambient[c] == (i == 0 ? ambient[c] : (double)base->ambient[c]), "%d ambient", i);
                CHECK(m->diffuse[c] == (i == 1 ? diffuse[c] : (double)base->diffuse[c]), "%d diffuse", i);
                CHECK(m->specular[c] == (i == 1 ? specular[c] : (double)base->specular[c]), "%d specular", i);
            }
            CHECK(m->shininess == (i == 0 ? 7 : (double)base->shininess), "%d shininess", i);
        }
        const char *texture = world->entities[i].parts[0].material.texture;
        CHECK(texture != NULL && strcmp(texture, small_path(i == 0 ? "color.png" : "layer.ppm")) == 0,
              "beside the mesh, or the scene's: %s", texture);
    }
    CHECK(world->entities[0].parts[1].material.texture == NULL, "plain has no map");
    close_world();
}

static void a_mesh_without_materials_is_white(void)
{
    const lom_material white = lom_default_material("");
    lom_error error = { 0 };
    CHECK(small_text("bare.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", &error), "%s", error.text);
    if (!open_good("[[entity]]\nmesh = 'bare.obj'\n"))
        return;
    const struct lom_world_material *m = &world->entities[0].parts[0].material;
    for (int c = 0; c < 3; c++)
        CHECK(m->ambient[c] == (double)white.ambient[c] && m->diffuse[c] == (double)white.diffuse[c], "channel %d", c);
    CHECK(m->texture == NULL, "and has no picture");
    close_world();
}

static void a_map_that_cannot_be_read_is_a_warning(void)
{
    lom_error error = { 0 };
    CHECK(small_text("lost.mtl", "newmtl a\nmap_Kd nowhere.png\nnewmtl b\nKd 1 0 0\nmap_Kd nowhere.png\n", &error) &&
              small_text("lost.obj",
                         "mtllib lost.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\nusemtl b\nf 1 3 2\n", &error),
          "%s", error.text);
    if (!open_good("[[entity]]\nmesh = 'lost.obj'\n"))
        return;
    CHECK(world->entities[0].parts[0].material.texture == NULL && world->entities[0].parts[1].material.texture == NULL,
          "left out");
    CHECK(world->warnings.count == 1 && strstr(world->warnings.text, "nowhere.png") != NULL, "%d: %s",
          (int)world->warnings.count, world->warnings.text);
    close_world();
    if (open_good("[[entity]]\nmesh = 'lost.obj'\nmaterial = { texture = 'color.png' }\n"))
        CHECK(world->warnings.count == 0, "a map that does not count is not looked for: %s", world->warnings.text);
    close_world();
}

/* ---- files ---- */

static void a_file_is_read_once(void)
{
    if (!open_good(LAND BOX BOX "[sky]\npattern = 'sky_%s.png'\n"))
        return;
    lom_error error = { 0 };
    CHECK(world->mesh_count == 1 && world->entities[0].mesh == world->entities[1].mesh, "one mesh");
    CHECK(world->entities[0].parts[0].material.texture == world->entities[1].parts[0].material.texture, "one path");
    CHECK(world->picture_count == 1, "%d pictures: no map is decoded twice", (int)world->picture_count);
    const lom_image *layer = lom_world_picture(world, small_path("layer.ppm"), &error);
    remove(small_path("layer.ppm"));
    remove(small_path("color.png"));
    const lom_image *color = lom_world_picture(world, small_path("color.png"), &error);
    CHECK(color != NULL && color->width == 8 && color->format == LOM_FORMAT_RGBA8, "decoded with the mesh: %s",
          error.text);
    CHECK(layer != NULL && lom_world_picture(world, small_path("layer.ppm"), &error) == layer, "%s", error.text);
    lom_release_world_picture(world, small_path("layer.ppm"));
    CHECK(lom_world_picture(world, small_path("layer.ppm"), &error) == NULL && error.code == LOM_ERROR_FILE,
          "released, it is read again");
    lom_release_world_picture(world, NULL);
    lom_release_world_picture(world, "never.png");
    lom_release_world_files(world);
    CHECK(world->height_map == NULL && world->bed.heights != NULL && world->pictures[0].image == NULL,
          "the bed stays when the files go");
    CHECK(strcmp(world->entities[0].parts[0].material.texture, small_path("color.png")) == 0, "and so do the paths");
    close_world();
    CHECK(small_picture("color.png", 8, LOM_FORMAT_RGB8, NULL) && small_picture("layer.ppm", 4, LOM_FORMAT_RGB8, NULL),
          "put back");
}

/* By the pipeline and by the reference, on the ground, with keys, whether one thing or several name it. */
static void frames_read_each_file_once(void)
{
    static const char *const models[] = { "'planar'", "'reference'" };
    static const char text[] =
        LAND "texture = 'color.png'\n[[terrain.layer]]\nmap = 'layer.ppm'\n[sky]\npattern = 'sky_%s.png'\n"
             "[water]\nnormal_map = 'normal.png'\n" BOX "on_ground = true\n" BOX
             "[[entity.key]]\ntime = 0\n[[entity.key]]\ntime = 1\nposition = [1, 1, 2]\n"
             "[output]\nwidth = 8\nheight = 8\n[quality.reference]\nsamples = 1\ndepth = 1\n[quality]\nwater = ";
    for (int i = 0; i < 2; i++) {
        char whole[1200];
        lom_error error = { 0 };
        snprintf(whole, sizeof whole, "%s%s\n", text, models[i]);
        scene = lom_decode_scene(whole, strlen(whole), small_path("scene.toml"), NULL, 0, &error);
        opened_count = 0;
        lom_renderer *renderer = scene == NULL ? NULL : lom_create_renderer(scene, NULL, &error);
        for (int frame = 0; renderer != NULL && frame < 2; frame++) {
            lom_frame drawn;
            CHECK(lom_render_frame(renderer, &(lom_frame_desc){ .frame = frame }, &drawn, &error), "%s", error.text);
            lom_free_image(drawn.image);
        }
        CHECK(renderer != NULL && opened_count == 12, "%s: %d files: %s", models[i], opened_count, error.text);
        for (int k = 0; k < opened_count; k++)
            CHECK(opened[k].count == 1, "%s: %s is read %d times", models[i], opened[k].path, opened[k].count);
        opened_count = -1;
        lom_free_renderer(renderer);
        lom_free_scene(scene);
        scene = NULL;
    }
}

static void what_cannot_be_had_is_an_error(void)
{
    static const struct {
        const char *text, *says;
    } cases[] = {
        { "[[entity]]\nmesh = 'color.png'\n", "color.png" },
        { "[terrain]\nheight_map = 'box.obj'\n", "box.obj" },
        { "[terrain]\nheight_map = 'dot.png'\n", "2 x 2" },
    };
    CHECK(small_picture("dot.png", 1, LOM_FORMAT_R8, NULL), "a map of one sample");
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        lom_error error = { 0 };
        CHECK(!open_world(cases[i].text, &error) && scene != NULL, "%s is refused", cases[i].text);
        CHECK(error.code != LOM_OK && strstr(error.text, cases[i].says) != NULL, "%s", error.text);
        close_world();
    }
}

int main(int argc, char **argv)
{
    if (!make_small_scene())
        return 1;
    RUN(entities_stand_on_the_ground);
    RUN(the_bed_is_the_terrains_vertices);
    RUN(what_moves_is_where_its_keys_say);
    RUN(the_camera_in_an_entity_hides_it);
    RUN(the_entitys_own_material_counts_first);
    RUN(a_mesh_without_materials_is_white);
    RUN(a_map_that_cannot_be_read_is_a_warning);
    RUN(a_file_is_read_once);
    RUN(frames_read_each_file_once);
    RUN(what_cannot_be_had_is_an_error);
    remove_small_scene();
    return check_result();
}
