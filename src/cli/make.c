/* `lom make`. In: the name of an asset, or a kind of picture with its parameters; out: files. Invariant: every asset of
 * the project stands in the table below with all its parameters, and is a function of them, so `lom make all` gives the
 * committed files again byte for byte. */
#include "base/numbers.h"
#include "commands.h"
#include "image/level_chart.h"
#include "make_sky.h"
#include "measure/dials.h"
#include "options.h"
#include "page.h"
#include "paths.h"
#include "picture_kinds.h"

#include <lom/cloud.h>
#include <lom/lom.h>
#include <lom/water.h>

#include <string.h>

struct values {
    const char *output;
    const char *bits;
    lom_option_integers size, seed, voxels;
    lom_option_number azimuth, elevation, haziness, cloudiness, roughness;
};

/* What a recipe needs, with the values of the committed asset, which options of the command line replace. */
typedef struct parameters {
    int size;
    uint64_t seed;
    double azimuth, elevation, haziness, cloudiness, roughness; /* of the sky and the waves; degrees */
} parameters;

typedef struct recipe {
    const char *kind, *name; /* name: of one among several of a kind, else NULL */
    const char *path;        /* below the assets' folder */
    bool (*make)(const struct recipe *recipe, const parameters *p, const char *path, lom_error *error);
    parameters parameters;
} recipe;

/* ---- what is made ---- */

static bool write_and_free(const char *path, lom_image *image, lom_error *error)
{
    bool written = image != NULL && lom_write_image(path, strcmp(path, "-") == 0 ? "png" : NULL, image, error);
    lom_free_image(image);
    return written;
}

static bool make_height_map(const recipe *r, const parameters *p, const char *path, lom_error *error)
{
    (void)r;
    return write_and_free(path, lom_make_height_map(&(lom_height_map_desc){ p->size, p->seed }, error), error);
}

static bool make_coast(const recipe *r, const parameters *p, const char *path, lom_error *error)
{
    return write_and_free(path, lom_make_coast(r->name, p->size, p->seed, error), error);
}

static bool make_normal_map(const recipe *r, const parameters *p, const char *path, lom_error *error)
{
    (void)r;
    lom_normal_map_desc desc = { p->size, p->seed, p->roughness };
    return write_and_free(path, lom_make_normal_map(&desc, error), error);
}

static bool make_flow_map(const recipe *r, const parameters *p, const char *path, lom_error *error)
{
    (void)r;
    lom_normal_map_desc desc = { p->size, p->seed, p->roughness };
    lom_image *normals = lom_make_normal_map(&desc, error);
    lom_image *flow = normals != NULL ? lom_make_flow_map(normals, error) : NULL;
    lom_free_image(normals);
    return write_and_free(path, flow, error);
}

static bool make_albedo(const recipe *r, const parameters *p, const char *path, lom_error *error)
{
    return write_and_free(path, lom_make_albedo(&(lom_albedo_desc){ r->name, p->size, p->seed }, error), error);
}

static bool write_bytes(const char *path, lom_bytes bytes, lom_error *error)
{
    bool written = bytes.data != NULL && lom_write_file(path, bytes.data, bytes.size, error);
    lom_release(bytes.data);
    return written;
}

static bool make_level_chart(const recipe *r, const parameters *p, const char *path, lom_error *error)
{
    (void)r;
    return write_bytes(path, lom_make_level_chart(p->size, error), error);
}

static bool make_sky_box(const recipe *r, const parameters *p, const char *path, lom_error *error)
{
    (void)r;
    return lom_write_sky_box(&(lom_sky_box_desc){ .size = p->size,
                                                  .sun_azimuth = p->azimuth * lom_radians_per_degree,
                                                  .sun_elevation = p->elevation * lom_radians_per_degree,
                                                  .haziness = p->haziness,
                                                  .cloudiness = p->cloudiness,
                                                  .seed = p->seed },
                             path, error);
}

/* The picture of a map that a mesh names, in the folder that is the first characters of path: the texture of that name,
 * which belongs to the seed of the table. */
static bool write_texture(const char *map, const char *path, int folder, lom_error *error)
{
    char *name = lom_path_print(error, "%.*s%s", folder, path, map);
    char *texture = lom_path_print(error, "%.*s", (int)strcspn(map, "."), map);
    lom_albedo_desc desc = { .name = texture, .seed = 1 };
    bool done = name != NULL && texture != NULL && write_and_free(name, lom_make_albedo(&desc, error), error);
    lom_release(name);
    lom_release(texture);
    return done;
}

static bool write_textures(const lom_mesh *mesh, const char *path, int folder, lom_error *error)
{
    bool done = true;
    for (size_t i = 0; i < mesh->material_count; i++) {
        const lom_material *m = &mesh->materials[i];
        done = done && (m->diffuse_map[0] == 0 || write_texture(m->diffuse_map, path, folder, error)) &&
               (m->emissive_map[0] == 0 || write_texture(m->emissive_map, path, folder, error)) &&
               (m->opacity_map[0] == 0 || write_texture(m->opacity_map, path, folder, error));
    }
    return done;
}

/* NAME.obj, NAME.mtl and the pictures. */
static bool make_entity(const recipe *r, const parameters *p, const char *path, lom_error *error)
{
    if (!lom_path_is(path, "obj"))
        return lom_fail(error, LOM_ERROR_USAGE, "%s: an entity is written to a file that ends in .obj.", path);
    int folder = (int)(lom_path_file(path) - path), stem = (int)(lom_path_extension(path) - path);
    char *material = lom_path_print(error, "%.*smtl", stem, path);
    lom_mesh *mesh = material != NULL ? lom_make_entity(r->name, p->seed, error) : NULL;
    bool done = mesh != NULL && write_textures(mesh, path, folder, error) &&
                write_bytes(material, lom_encode_mtl(mesh, error), error) &&
                write_bytes(path, lom_encode_obj(mesh, lom_path_file(material), error), error);
    lom_free_mesh(mesh);
    lom_release(material);
    return done;
}

static const recipe recipes[] = {
    { "height-map", NULL, "terrain/height.png", make_height_map, { .size = 1024, .seed = 3 } },
    { "coast", "lagoon", "terrain/lagoon.png", make_coast, { .size = 512, .seed = 1 } },
    { "coast", "cove", "terrain/cove.png", make_coast, { .size = 512, .seed = 1 } },
    { "coast", "river", "terrain/river.png", make_coast, { .size = 512, .seed = 1 } },
    { "coast", "falls", "terrain/falls.png", make_coast, { .size = 1024, .seed = 1 } },
    { "coast", "strand", "terrain/strand.png", make_coast, { .size = 512, .seed = 1 } },
    { "albedo", "grass", "terrain/grass.png", make_albedo, { .seed = 1 } },
    { "albedo", "forest", "terrain/forest.png", make_albedo, { .seed = 1 } },
    { "albedo", "rock", "terrain/rock.png", make_albedo, { .seed = 1 } },
    { "albedo", "shore", "terrain/shore.png", make_albedo, { .seed = 1 } },
    { "albedo", "snow", "terrain/snow.png", make_albedo, { .seed = 1 } },
    { "normal-map", NULL, "water/normal.png", make_normal_map, { .size = 512, .seed = 1 } },
    { "flow-map", NULL, "water/flow.png", make_flow_map, { .size = 512, .seed = 1 } },
    { "level-chart", NULL, "textures/levels.dds", make_level_chart, { .size = 64 } },
    { "sky-box",
      NULL,
      "sky/%s.png",
      make_sky_box,
      { .size = 1024, .seed = 2, .azimuth = 62, .elevation = 26, .haziness = 0.8, .cloudiness = 0.7 } },
    { "sky-box",
      "sunset",
      "sky/sunset/%s.png",
      make_sky_box,
      { .size = 512, .seed = 5, .azimuth = 20, .elevation = 5, .haziness = 1.6, .cloudiness = 0.6 } },
    { "sky-box",
      "noon",
      "sky/noon/%s.png",
      make_sky_box,
      { .size = 512, .seed = 4, .azimuth = 150, .elevation = 60, .haziness = 0.7, .cloudiness = 0.35 } },
    { "sky-box",
      "gale",
      "sky/gale/%s.png",
      make_sky_box,
      { .size = 512, .seed = 9, .azimuth = 300, .elevation = 30, .haziness = 3, .cloudiness = 1 } },
    { "sky-box",
      "evening",
      "sky/evening.dds",
      make_sky_box,
      { .size = 256, .seed = 7, .azimuth = 298, .elevation = 7, .haziness = 1.2, .cloudiness = 0.8 } },
    { "entity", "boat", "entities/boat.obj", make_entity, { .seed = 1 } },
    { "entity", "jetty", "entities/jetty.obj", make_entity, { .seed = 1 } },
    { "entity", "cabin", "entities/cabin.obj", make_entity, { .seed = 1 } },
    { "entity", "spruce", "entities/spruce.obj", make_entity, { .seed = 1 } },
    { "entity", "pine", "entities/pine.obj", make_entity, { .seed = 1 } },
    { "entity", "boulder", "entities/boulder.obj", make_entity, { .seed = 1 } },
    { "entity", "stones", "entities/stones.obj", make_entity, { .seed = 1 } },
    { "entity", "reeds", "entities/reeds.obj", make_entity, { .seed = 1 } },
    { "entity", "floats", "entities/floats.obj", make_entity, { .seed = 1 } },
    { "entity", "aircraft", "entities/aircraft.obj", make_entity, { .seed = 1 } },
    { "entity", "lit_cabin", "entities/lit_cabin.obj", make_entity, { .seed = 1 } },
    { "entity", "lantern", "entities/lantern.obj", make_entity, { .seed = 1 } },
    { "entity", "lamp_post", "entities/lamp_post.obj", make_entity, { .seed = 1 } },
    { "entity", "fire", "entities/fire.obj", make_entity, { .seed = 1 } },
    { "entity", "ball", "entities/ball.obj", make_entity, { .seed = 1 } },
    { "entity", "bowl", "entities/bowl.obj", make_entity, { .seed = 1 } },
    { "entity", "slab", "entities/slab.obj", make_entity, { .seed = 1 } },
};
enum { RECIPE_COUNT = sizeof recipes / sizeof recipes[0] };

/* ---- the command line ---- */

static const lom_option options[] = {
    { "output", 'o', LOM_OPTION_TEXT, offsetof(struct values, output), "OUT", 0, 0,
      "where to: a file, or a folder for all" },
    { "size", 0, LOM_OPTION_INTEGER, offsetof(struct values, size), "N", 8, 4096, "pixels a side" },
    { "seed", 0, LOM_OPTION_INTEGER, offsetof(struct values, seed), "N", 0, 1e15,
      "another seed gives another one of its kind" },
    { "voxels", 0, LOM_OPTION_INTEGER, offsetof(struct values, voxels), "WxHxD", 1, LOM_MAX_VOLUME,
      "cloud: voxels along x, y (up) and z" },
    { "bits", 0, LOM_OPTION_CHOICE, offsetof(struct values, bits), "8|16|32", 0, 0,
      "cloud: bits a voxel, 32 are floats; 16 by default" },
    { "azimuth", 0, LOM_OPTION_NUMBER, offsetof(struct values, azimuth), "DEGREES", -360, 360,
      "sky-box: where the sun stands, 0 north (-z), 90 east (+x)" },
    { "elevation", 0, LOM_OPTION_NUMBER, offsetof(struct values, elevation), "DEGREES", 0, 90,
      "sky-box: the sun's height" },
    { "haziness", 0, LOM_OPTION_NUMBER, offsetof(struct values, haziness), "H", 0, 10,
      "sky-box: 0 clean air, 1 a fine day" },
    { "cloudiness", 0, LOM_OPTION_NUMBER, offsetof(struct values, cloudiness), "C", 0, 1,
      "sky-box: 0 clear, 1 many clouds" },
    { "roughness", 0, LOM_OPTION_NUMBER, offsetof(struct values, roughness), "R", 0.01, 4,
      "normal-map, flow-map: root of the mean squared slope" },
};

static const lom_command_line line = {
    .name = "make",
    .arguments = "KIND [NAME]",
    .summary = "Makes a picture, a mesh or a volume of the project",
    .details =
        "KIND is height-map, coast NAME, normal-map, flow-map, level-chart, sky-box, albedo NAME, entity NAME, cloud "
        "NAME or\n"
        "all. A level-chart is a DDS file whose mip levels have a colour each.\n"
        "`lom make all -o assets` writes every asset of the project, byte for byte as it is committed; without "
        "options a\n"
        "kind is made with the parameters of the committed asset. A sky box is six files: its OUT has a %s for\n"
        "right, left, top, bottom, front and back; or one, a cube in a .dds. `lom make list` prints the kinds and\n"
        "names. `lom make scene-docs -o docs/scene.md` writes the page of all keys of a scene file, dial-docs that of\n"
        "what trades accuracy for time, format-docs that of the kinds of picture files.",
    .options = options,
    .option_count = sizeof options / sizeof options[0],
    .minimum_arguments = 1,
    .maximum_arguments = 2,
};

static bool is_recipe(const recipe *r, const char *kind, const char *name)
{
    if (strcmp(r->kind, kind) != 0)
        return false;
    return r->name == NULL ? name == NULL : name != NULL && strcmp(r->name, name) == 0;
}

static const recipe *find_recipe(const lom_arguments *arguments)
{
    for (size_t i = 0; i < RECIPE_COUNT; i++)
        if (is_recipe(&recipes[i], arguments->items[0], arguments->count > 1 ? arguments->items[1] : NULL))
            return &recipes[i];
    return NULL;
}

static void replace(double *value, const lom_option_number *option)
{
    if (option->given)
        *value = option->value;
}

static parameters merge(const recipe *r, const struct values *v)
{
    parameters p = r->parameters;
    if (v->size.given)
        p.size = (int)v->size.value[0];
    if (v->seed.given)
        p.seed = (uint64_t)v->seed.value[0];
    replace(&p.azimuth, &v->azimuth);
    replace(&p.elevation, &v->elevation);
    replace(&p.haziness, &v->haziness);
    replace(&p.cloudiness, &v->cloudiness);
    replace(&p.roughness, &v->roughness);
    return p;
}

/* A cloud's density as a volume (.nrrd); no asset of the project, since scenes name clouds by kind. */
static bool make_cloud(const char *kind, const struct values *v, lom_error *error)
{
    static const lom_format formats[] = { LOM_FORMAT_R8, LOM_FORMAT_R16, LOM_FORMAT_R32F };
    int format = v->bits == NULL || strcmp(v->bits, "16") == 0 ? 1 : strcmp(v->bits, "8") == 0 ? 0 : 2;
    lom_image *made = lom_make_cloud(&(lom_cloud_desc){ .kind = kind,
                                                        .width = (int)v->voxels.value[0],
                                                        .height = (int)v->voxels.value[1],
                                                        .depth = (int)v->voxels.value[2],
                                                        .seed = v->seed.given ? (uint64_t)v->seed.value[0] : 1 },
                                     error);
    lom_image *volume = made != NULL ? lom_convert_image(made, formats[format], error) : NULL;
    bool written = volume != NULL && lom_write_image(v->output, "nrrd", volume, error);
    lom_free_image(made);
    lom_free_image(volume);
    return written;
}

static void print_list(void)
{
    for (size_t i = 0; lom_cloud_kind_at(i) != NULL; i++)
        printf("%-10s %-18s %-7s %s\n", "cloud", lom_cloud_kind_at(i)->name, lom_cloud_kind_at(i)->abbreviation,
               lom_cloud_kind_at(i)->text);
    for (size_t i = 0; i < RECIPE_COUNT; i++)
        printf("%-10s %-10s %s\n", recipes[i].kind, recipes[i].name != NULL ? recipes[i].name : "", recipes[i].path);
}

static bool make_all(const struct values *v, lom_error *error)
{
    bool done = true;
    for (size_t i = 0; done && i < RECIPE_COUNT; i++) {
        char *path = lom_path_print(error, "%s/%s", v->output, recipes[i].path);
        parameters p = merge(&recipes[i], &(struct values){ 0 });
        done = path != NULL && lom_make_folders(path, strlen(v->output), error) &&
               recipes[i].make(&recipes[i], &p, path, error);
        lom_release(path);
    }
    return done;
}

static bool make_scene_docs(const char *path, lom_error *error)
{
    return write_bytes(path, lom_write_scene_documentation(error), error);
}

static bool make_dial_docs(const char *path, lom_error *error)
{
    struct lom_page page;
    lom_begin_page(&page);
    if (page.out != NULL)
        lom_print_dial_documentation(page.out);
    return write_bytes(path, lom_end_page(&page, error), error);
}

/* The pages that are made from tables. */
static const struct documentation {
    const char *kind;
    bool (*make)(const char *path, lom_error *error);
} pages[] = { { "scene-docs", make_scene_docs },
              { "dial-docs", make_dial_docs },
              { "format-docs", lom_write_format_documentation } };

static const struct documentation *find_page(const char *kind)
{
    for (size_t i = 0; i < sizeof pages / sizeof pages[0]; i++)
        if (strcmp(pages[i].kind, kind) == 0)
            return &pages[i];
    return NULL;
}

int lom_command_make(int argc, char **argv)
{
    struct values v = { 0 };
    lom_arguments arguments;
    lom_error error = { 0 };
    int status;
    if (!lom_parse_options(&line, argc, argv, &v, &arguments, &status))
        return status;
    if (strcmp(arguments.items[0], "list") == 0 && arguments.count == 1) {
        print_list();
        return LOM_EXIT_DONE;
    }
    if (v.output == NULL)
        return lom_complain("make: -o OUT says where to.");
    if (strcmp(arguments.items[0], "all") == 0 && arguments.count == 1)
        return make_all(&v, &error) ? LOM_EXIT_DONE : lom_complain_error(&error);
    const struct documentation *page = arguments.count == 1 ? find_page(arguments.items[0]) : NULL;
    if (page != NULL)
        return page->make(v.output, &error) ? LOM_EXIT_DONE : lom_complain_error(&error);
    if (strcmp(arguments.items[0], "cloud") == 0 && arguments.count == 2)
        return make_cloud(arguments.items[1], &v, &error) ? LOM_EXIT_DONE : lom_complain_error(&error);
    const recipe *found = find_recipe(&arguments);
    if (found == NULL)
        return lom_complain("make: there is no %s%s%s; `lom make list` prints what there is.", arguments.items[0],
                            arguments.count > 1 ? " " : "", arguments.count > 1 ? arguments.items[1] : "");
    parameters p = merge(found, &v);
    return found->make(found, &p, v.output, &error) ? LOM_EXIT_DONE : lom_complain_error(&error);
}
