/* `lom info`. In: files. Out: what each one is, one line or JSON object a file. Invariant: what a kind does not have
 * (the triangles of an image) is null or absent, never 0; a file that cannot be read does not hide the others. */
#include "commands.h"
#include "json.h"
#include "options.h"
#include "paths.h"
#include "picture_kinds.h"

#include <lom/scene.h>

#include <inttypes.h>
#include <string.h>

#define LARGEST_FILE ((size_t)1 << 31)

struct values {
    bool json;
};

static const lom_option options[] = {
    { .name = "json",
      .kind = LOM_OPTION_FLAG,
      .field = offsetof(struct values, json),
      .help = "one JSON object a file" },
};

static const lom_command_line line = {
    .name = "info",
    .arguments = "FILE...",
    .summary = "Says what is in images, meshes and scenes",
    .details =
        "Meshes are *.obj, scenes *.toml, anything else is read as a picture, a volume, a cube (of six faces) or an\n"
        "array (of pictures of one size), with the mip levels that the file holds. Triangles count n - 2 a\n"
        "polygon, lines n - 1 a polyline; vertices are those left after equal corners became one; bounds are the\n"
        "lowest and the highest x, y and z. What a lenient reader passed over is told as warnings. The hash of an\n"
        "image covers its size, its format and its samples; that of a mesh its vertices, its triangles, lines and\n"
        "points and their materials; that of a scene the bytes of all its files.",
    .options = options,
    .option_count = sizeof options / sizeof options[0],
    .minimum_arguments = 1,
    .maximum_arguments = -1,
    .print_more = lom_print_picture_kinds,
};

/* What is known of a file; -1 is what its kind does not have. */
struct facts {
    const char *file, *kind, *format;
    int64_t width, height, depth, levels, channels, bits, vertices, triangles, lines, points, materials, warnings;
    lom_box bounds; /* of a mesh */
    uint64_t hash;
};

static uint64_t hash_word(uint64_t hash, uint32_t word)
{
    const uint8_t bytes[4] = { (uint8_t)word, (uint8_t)(word >> 8), (uint8_t)(word >> 16), (uint8_t)(word >> 24) };
    return lom_hash_bytes(hash, bytes, sizeof bytes);
}

static uint64_t hash_floats(uint64_t hash, const float *values, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        uint32_t word;
        memcpy(&word, &values[i], sizeof word);
        hash = hash_word(hash, word);
    }
    return hash;
}

static uint64_t hash_mesh(const lom_mesh *mesh)
{
    uint64_t hash = LOM_HASH_START;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        const lom_mesh_vertex *vertex = &mesh->vertices[i];
        hash = hash_floats(hash, vertex->position, 3);
        hash = hash_floats(hash, vertex->normal, 3);
        hash = hash_floats(hash, vertex->uv, 2);
        hash = hash_floats(hash, vertex->color, 4);
    }
    const size_t indices = mesh->index_count + mesh->line_index_count + mesh->point_count;
    for (size_t i = 0; i < indices; i++)
        hash = hash_word(hash, mesh->indices[i]);
    for (size_t i = 0; i < lom_mesh_parts(mesh); i++) {
        hash = hash_word(hash, mesh->parts[i].first_index);
        hash = hash_word(hash, mesh->parts[i].index_count);
        hash = hash_word(hash, (uint32_t)mesh->parts[i].material);
    }
    return hash;
}

static bool find_mesh_facts(const char *path, struct facts *facts, lom_error *error)
{
    lom_mesh *mesh = lom_read_obj(path, error);
    if (mesh == NULL)
        return false;
    facts->kind = "mesh";
    facts->vertices = (int64_t)mesh->vertex_count;
    facts->triangles = (int64_t)mesh->source_triangles;
    facts->lines = (int64_t)mesh->line_index_count / 2;
    facts->points = (int64_t)mesh->point_count;
    facts->materials = (int64_t)mesh->material_count;
    facts->warnings = (int64_t)mesh->warnings.count;
    facts->bounds = lom_mesh_bounds(mesh);
    lom_tell_warnings(mesh->warnings.text, mesh->warnings.count);
    facts->hash = hash_mesh(mesh);
    lom_free_mesh(mesh);
    return true;
}

static bool find_image_facts(const char *path, struct facts *facts, lom_error *error)
{
    lom_image *image = lom_read_image(path, error);
    if (image == NULL)
        return false;
    const lom_format_info *format = lom_describe_format(image->format);
    static const char *const slices[] = {
        [LOM_SLICES_VOLUME] = "volume", [LOM_SLICES_CUBE] = "cube", [LOM_SLICES_LAYERS] = "array"
    };
    facts->kind = image->depth > 1 ? slices[image->slices] : "image";
    facts->format = format->name;
    facts->width = image->width;
    facts->height = image->height;
    facts->depth = image->depth;
    facts->levels = lom_image_levels(image);
    facts->channels = format->channels;
    facts->bits = format->bits;
    facts->hash = lom_hash_image(image);
    lom_free_image(image);
    return true;
}

/* The hash of the bytes of every file the scene names, itself first: another text or another texture is another scene.
 */
static bool hash_scene(const lom_scene *scene, uint64_t *hash, lom_error *error)
{
    size_t count;
    const char *const *files = lom_scene_files(scene, &count);
    *hash = LOM_HASH_START;
    for (size_t i = 0; i < count; i++) {
        lom_bytes bytes = lom_read_file(files[i], LARGEST_FILE, error);
        if (bytes.data == NULL)
            return false;
        *hash = lom_hash_bytes(*hash, bytes.data, bytes.size);
        lom_release(bytes.data);
    }
    return true;
}

static bool find_scene_facts(const char *path, struct facts *facts, lom_error *error)
{
    lom_scene *scene = lom_read_scene(path, NULL, 0, error);
    if (scene == NULL)
        return false;
    static const int bits[] = { [LOM_OUTPUT_RGB8] = 8, [LOM_OUTPUT_RGB16] = 16, [LOM_OUTPUT_RGB32F] = 32 };
    facts->kind = "scene";
    facts->width = scene->output.width;
    facts->height = scene->output.height;
    facts->channels = 3;
    facts->bits = bits[scene->output.format];
    bool done = hash_scene(scene, &facts->hash, error);
    lom_free_scene(scene);
    return done;
}

/* Kinds by extension; the last one takes every path. */
static const struct {
    const char *extension;
    bool (*find)(const char *path, struct facts *facts, lom_error *error);
} kinds[] = {
    { "obj", find_mesh_facts },
    { "toml", find_scene_facts },
    { NULL, find_image_facts },
};

static bool find_facts(const char *path, struct facts *facts, lom_error *error)
{
    *facts = (struct facts){ .file = path };
    int64_t *const numbers[] = { &facts->width,    &facts->height, &facts->depth,     &facts->levels,
                                 &facts->channels, &facts->bits,   &facts->vertices,  &facts->triangles,
                                 &facts->lines,    &facts->points, &facts->materials, &facts->warnings };
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++)
        *numbers[i] = -1;
    size_t kind = 0;
    while (kinds[kind].extension != NULL && !lom_path_is(path, kinds[kind].extension))
        kind++;
    return kinds[kind].find(path, facts, error);
}

static void print_json(const struct facts *facts)
{
    const struct {
        const char *name;
        int64_t value;
    } numbers[] = {
        { "width", facts->width },       { "height", facts->height },       { "depth", facts->depth },
        { "levels", facts->levels },     { "channels", facts->channels },   { "bits", facts->bits },
        { "vertices", facts->vertices }, { "triangles", facts->triangles }, { "lines", facts->lines },
        { "points", facts->points },     { "materials", facts->materials }, { "warnings", facts->warnings },
    };
    lom_json json = lom_json_begin(stdout);
    lom_json_text(&json, "file", facts->file);
    lom_json_text(&json, "kind", facts->kind);
    lom_json_text(&json, "format", facts->format);
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        if (numbers[i].value >= 0)
            lom_json_integer(&json, numbers[i].name, numbers[i].value);
        else
            lom_json_null(&json, numbers[i].name);
    }
    if (facts->vertices >= 0)
        lom_json_points(&json, "bounds", (const lom_vec3[]){ facts->bounds.low, facts->bounds.high }, 2);
    else
        lom_json_null(&json, "bounds");
    lom_json_hash(&json, "hash", facts->hash);
    lom_json_end(&json);
}

static void print_point(const char *before, lom_vec3 point)
{
    const double values[3] = { point.x, point.y, point.z };
    char text[32];
    for (int i = 0; i < 3; i++) {
        lom_print_float(text, (float)values[i]);
        printf("%s %s", i == 0 ? before : "", text);
    }
}

static void print_line(const struct facts *facts)
{
    printf("%s: %s", facts->file, facts->kind);
    if (facts->width >= 0)
        printf(", %" PRId64 " x %" PRId64, facts->width, facts->height);
    if (facts->depth > 1)
        printf(" x %" PRId64, facts->depth);
    if (facts->format != NULL)
        printf(", %s", facts->format);
    if (facts->levels > 1)
        printf(", %" PRId64 " levels", facts->levels);
    if (facts->vertices >= 0) {
        print_point(", from", facts->bounds.low);
        print_point(" to", facts->bounds.high);
    }
    if (facts->vertices >= 0)
        printf(", %" PRId64 " vertices, %" PRId64 " triangles", facts->vertices, facts->triangles);
    if (facts->lines > 0)
        printf(", %" PRId64 " lines", facts->lines);
    if (facts->points > 0)
        printf(", %" PRId64 " points", facts->points);
    if (facts->vertices >= 0)
        printf(", %" PRId64 " materials", facts->materials);
    printf(", hash %016" PRIx64 "\n", facts->hash);
}

int lom_command_info(int argc, char **argv)
{
    struct values values = { .json = false };
    lom_arguments arguments;
    int status;
    if (!lom_parse_options(&line, argc, argv, &values, &arguments, &status))
        return status;
    for (int i = 0; i < arguments.count; i++) {
        struct facts facts;
        lom_error error = { .code = LOM_OK };
        if (!find_facts(arguments.items[i], &facts, &error))
            status = lom_complain_error(&error);
        else if (values.json)
            print_json(&facts);
        else
            print_line(&facts);
    }
    return status;
}
