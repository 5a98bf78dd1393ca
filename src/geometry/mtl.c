/* Reads MTL, the material files of OBJ (Advanced Visualizer manual, appendix B2). In: the bytes of a file. Out:
 * materials added to a set. A table of statements; what it does not name is passed over. Every number is finite. */
#include "materials.h"

#include <string.h>

struct mtl {
    struct lom_text text;
    struct lom_materials *materials;
    lom_material *material; /* the one being defined */
    lom_material nameless;  /* takes what belongs to no material that a face can name */
    lom_warnings *warnings;
    bool named;            /* after the first newmtl */
    const char *statement; /* its word */
    const char *folder;
    size_t folder_length;
};

static bool read_name(struct mtl *mtl, void *unused)
{
    (void)unused;
    struct lom_word name = lom_text_rest(&mtl->text);
    mtl->named = true;
    if (name.length == 0) {
        lom_warn(mtl->warnings, "%s:%zu: newmtl without a name: no face has this material.", mtl->text.name,
                 mtl->text.line);
        mtl->material = &mtl->nameless;
        return true;
    }
    int number = lom_text_material(mtl->materials, &mtl->text, name);
    if (number < 0)
        return false;
    struct lom_material_entry *entry = &mtl->materials->entries[number];
    mtl->material = &entry->material;
    char terminated[sizeof entry->material.name];
    memcpy(terminated, entry->material.name, sizeof terminated);
    entry->material = lom_default_material(terminated);
    entry->defined = true;
    return true;
}

/* r [g b], g and b being r when absent; colours given as a spectrum or in CIE XYZ are passed over. */
static bool read_color(struct mtl *mtl, void *target)
{
    struct lom_text start = mtl->text;
    struct lom_word word = lom_text_word(&start);
    float rgb[3];
    if (lom_word_is(word, "spectral") || lom_word_is(word, "xyz"))
        return true;
    int count = lom_text_floats(&mtl->text, rgb, 3);
    if (count < 0)
        return false;
    if (count != 1 && count != 3)
        return lom_text_fail(&mtl->text, LOM_ERROR_INPUT, "A colour has 1 or 3 numbers, not %d.", count);
    for (int i = 0; i < 3; i++)
        ((float *)target)[i] = rgb[count == 1 ? 0 : i];
    return true;
}

static bool read_shininess(struct mtl *mtl, void *target)
{
    float value;
    int count = lom_text_floats(&mtl->text, &value, 1);
    if (count < 0)
        return false;
    if (count == 0 || value < 0)
        return lom_text_fail(&mtl->text, LOM_ERROR_INPUT, "Ns needs a number of at least 0.");
    *(float *)target = value;
    return true;
}

static bool read_opacity(struct mtl *mtl, void *target)
{
    struct lom_text start = mtl->text;
    if (lom_word_is(lom_text_word(&start), "-halo"))
        mtl->text = start;
    float value;
    int count = lom_text_floats(&mtl->text, &value, 1);
    if (count < 0)
        return false;
    if (count == 0)
        return lom_text_fail(&mtl->text, LOM_ERROR_INPUT, "An opacity needs a number.");
    *(float *)target = value < 0 ? 0 : value > 1 ? 1 : value;
    return true;
}

static bool read_transparency(struct mtl *mtl, void *target)
{
    float value = 0;
    if (!read_opacity(mtl, &value))
        return false;
    *(float *)target = 1 - value;
    return true;
}

/* Options of map statements: how many arguments follow at least, and how many more may as long as they are numbers. */
static const struct {
    const char *word;
    int least, more;
} map_options[] = {
    { "-blendu", 1, 0 }, { "-blendv", 1, 0 },  { "-cc", 1, 0 },   { "-clamp", 1, 0 }, { "-mm", 2, 0 },
    { "-bm", 1, 0 },     { "-boost", 1, 0 },   { "-o", 1, 2 },    { "-s", 1, 2 },     { "-t", 1, 2 },
    { "-texres", 1, 0 }, { "-imfchan", 1, 0 }, { "-type", 1, 0 },
};

/* The number behind an option; *value stays where there is none. */
static void read_option(struct lom_text text, float *value)
{
    struct lom_word word = lom_text_word(&text);
    double number;
    if (word.length > 0 && lom_parse_double(word.start, word.length, &number) == word.length)
        *value = (float)number;
}

/* Passes over one option, whose number is *bump where it is -bm; false when the next word is none. */
static bool skip_option(struct lom_text *text, float *bump)
{
    struct lom_text ahead = *text;
    struct lom_word word = lom_text_word(&ahead);
    for (size_t i = 0; i < sizeof map_options / sizeof *map_options; i++) {
        if (!lom_word_is(word, map_options[i].word))
            continue;
        if (lom_word_is(word, "-bm"))
            read_option(ahead, bump);
        for (int k = 0; k < map_options[i].least; k++)
            lom_text_word(&ahead);
        for (int k = 0; k < map_options[i].more; k++) {
            struct lom_text further = ahead;
            struct lom_word argument = lom_text_word(&further);
            double value;
            if (argument.length == 0 || lom_parse_double(argument.start, argument.length, &value) != argument.length)
                break;
            ahead = further;
        }
        *text = ahead;
        return true;
    }
    return false;
}

static bool read_map(struct mtl *mtl, void *target)
{
    size_t limit = sizeof mtl->material->diffuse_map, folder_length = mtl->folder_length;
    float bump = 1;
    while (skip_option(&mtl->text, &bump)) {
    }
    struct lom_word name = lom_file_name(lom_text_rest(&mtl->text));
    if (name.length == 0) {
        lom_warn(mtl->warnings, "%s:%zu: %s without a file name.", mtl->text.name, mtl->text.line, mtl->statement);
        return true;
    }
    if (name.start[0] == '/')
        folder_length = 0;
    if (name.length >= limit || folder_length >= limit - name.length)
        return lom_text_fail(&mtl->text, LOM_ERROR_LIMIT, "The map's path is longer than %zu bytes.", limit - 1);
    char *path = target;
    memset(path, 0, limit);
    memcpy(path, mtl->folder, folder_length);
    for (size_t i = 0; i < name.length; i++) /* as written on Windows, too */
        path[folder_length + i] = name.start[i] == '\\' ? '/' : name.start[i];
    if (path == mtl->material->normal_map)
        mtl->material->bump = bump;
    return true;
}

static const struct {
    const char *word;
    bool (*read)(struct mtl *mtl, void *target);
    size_t offset; /* of the target in lom_material */
} statements[] = {
    { "newmtl", read_name, 0 },
    { "Ka", read_color, offsetof(lom_material, ambient) },
    { "Kd", read_color, offsetof(lom_material, diffuse) },
    { "Ks", read_color, offsetof(lom_material, specular) },
    { "Ns", read_shininess, offsetof(lom_material, shininess) },
    { "d", read_opacity, offsetof(lom_material, opacity) },
    { "Tr", read_transparency, offsetof(lom_material, opacity) },
    { "Ke", read_color, offsetof(lom_material, emissive) },
    { "map_Kd", read_map, offsetof(lom_material, diffuse_map) },
    { "map_Ke", read_map, offsetof(lom_material, emissive_map) },
    { "map_Ks", read_map, offsetof(lom_material, specular_map) },
    { "map_Ns", read_map, offsetof(lom_material, gloss_map) },
    { "map_Bump", read_map, offsetof(lom_material, normal_map) },
    { "map_bump", read_map, offsetof(lom_material, normal_map) },
    { "bump", read_map, offsetof(lom_material, normal_map) },
    { "norm", read_map, offsetof(lom_material, normal_map) },
    { "map_d", read_map, offsetof(lom_material, opacity_map) },
};

static bool read_statement(struct mtl *mtl)
{
    struct lom_word word = lom_text_word(&mtl->text);
    for (size_t i = 0; i < sizeof statements / sizeof *statements; i++) {
        if (!lom_word_is(word, statements[i].word))
            continue;
        mtl->statement = statements[i].word;
        if (!mtl->named && statements[i].read != read_name) {
            lom_warn(mtl->warnings, "%s:%zu: %s before the first newmtl belongs to no material.", mtl->text.name,
                     mtl->text.line, statements[i].word);
            mtl->named = true;
        }
        return statements[i].read(mtl, (char *)mtl->material + statements[i].offset);
    }
    return true;
}

bool lom_decode_mtl(struct lom_materials *materials, lom_bytes file, const char *name, const char *folder,
                    size_t folder_length, lom_warnings *warnings, lom_error *error)
{
    struct mtl mtl = { .materials = materials, .folder = folder, .folder_length = folder_length, .warnings = warnings };
    mtl.nameless = lom_default_material("");
    mtl.material = &mtl.nameless;
    if (!lom_text_open(&mtl.text, (const char *)file.data, file.size, name, error))
        return false;
    do {
        if (!read_statement(&mtl))
            return false;
    } while (lom_text_next(&mtl.text));
    return true;
}
