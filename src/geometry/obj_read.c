/* Reads Wavefront OBJ (Advanced Visualizer manual, appendix B1), stage 1 of 2: text to arrays. In: bytes, and material
 * files from a callback. Out: struct lom_obj: every number finite, negative indices resolved, v flipped; positive
 * indices may still be out of range, since they may point forward. */
#include "base/pass_error.h"
#include "obj.h"
#include "base/reserve.h"
#include "polygon.h"

#include <string.h>

enum {
    CORNER_LIMIT = 1 << 28, /* of all faces: their indices fit 32 bits after triangulation */
    FILE_LIMIT = 1 << 30
};

/* ---- v, vt, vn ---- */

static bool read_position(struct lom_obj *obj)
{
    float number[7];
    int count = lom_text_floats(&obj->text, number, 7);
    if (count < 0)
        return false;
    if (count < 3 || count == 5)
        return lom_text_fail(&obj->text, LOM_ERROR_INPUT, "v has x y z [w] [r g b]: 3, 4, 6 or 7 numbers, not %d.",
                             count);
    if (!lom_reserve(&obj->positions, &obj->position_capacity, obj->position_count + 1, sizeof *obj->positions,
                     obj->text.error))
        return false;
    struct obj_position *position = &obj->positions[obj->position_count++];
    const float *color = count >= 6 ? number + count - 3 : NULL;
    for (int i = 0; i < 3; i++) {
        position->position[i] = number[i];
        position->color[i] = color != NULL ? color[i] : 1;
    }
    return true;
}

/* The flip is in double and rounded once, so that a writer that flips in double gets the same float back. */
static bool read_texture(struct lom_obj *obj)
{
    double number[3] = { 0, 0, 0 };
    int count = 0;
    for (struct lom_word word; (word = lom_text_word(&obj->text)).length > 0; count++) {
        if (count == 3)
            return lom_text_fail(&obj->text, LOM_ERROR_INPUT, "vt has u [v [w]]: at most 3 numbers.");
        if (!lom_text_number(&obj->text, word, &number[count]))
            return false;
    }
    if (count == 0)
        return lom_text_fail(&obj->text, LOM_ERROR_INPUT, "vt without a number.");
    if (!lom_reserve(&obj->texture, &obj->texture_capacity, obj->texture_count + 1, sizeof *obj->texture,
                     obj->text.error))
        return false;
    obj->texture[obj->texture_count++] = (struct obj_triple){ { (float)number[0], (float)(1 - number[1]), 0 } };
    return true;
}

static bool read_normal(struct lom_obj *obj)
{
    struct obj_triple normal;
    int count = lom_text_floats(&obj->text, normal.value, 3);
    if (count < 0)
        return false;
    if (count != 3)
        return lom_text_fail(&obj->text, LOM_ERROR_INPUT, "vn has x y z: 3 numbers, not %d.", count);
    if (!lom_reserve(&obj->normals, &obj->normal_capacity, obj->normal_count + 1, sizeof *obj->normals,
                     obj->text.error))
        return false;
    obj->normals[obj->normal_count++] = normal;
    return true;
}

/* ---- f, l, p ---- */

enum { LACKING = INT32_MAX }; /* an index that no file can hold */

/* One index of a corner at *at, moved past it; from 0, negative ones counted back from count. What a corner may leave
 * out may also be out of range. */
static bool read_index(struct lom_obj *obj, struct lom_word word, const char **at, size_t count, int32_t *index)
{
    bool optional = *index == LACKING;
    const char *p = *at, *end = word.start + word.length;
    bool negative = p < end && *p == '-';
    p += p < end && (*p == '-' || *p == '+');
    int64_t value = 0;
    const char *digits = p;
    for (; p < end && *p >= '0' && *p <= '9'; p++)
        value = value > INT32_MAX ? value : value * 10 + (*p - '0');
    if (p == digits)
        return lom_text_fail(&obj->text, LOM_ERROR_INPUT, "\"%.*s\" is not a corner: v, v/vt, v//vn or v/vt/vn.",
                             lom_word_shown(word), word.start);
    *at = p;
    bool lacking = value == 0 || value > INT32_MAX || (negative && (uint64_t)value > count);
    if (optional && lacking)
        return true;
    if (value == 0)
        return lom_text_fail(&obj->text, LOM_ERROR_INPUT, "An index of 0 in \"%.*s\": they count from 1.",
                             lom_word_shown(word), word.start);
    if (lacking)
        return lom_text_fail(&obj->text, LOM_ERROR_INPUT, "An index in \"%.*s\" is out of range: there are %zu so far.",
                             lom_word_shown(word), word.start, count);
    *index = (int32_t)(negative ? (int64_t)count - value : value - 1);
    return true;
}

/* An index that a corner may leave out: LACKING when it is out of range. */
static bool read_optional(struct lom_obj *obj, struct lom_word word, const char **at, size_t count, int32_t *index)
{
    *index = LACKING;
    return read_index(obj, word, at, count, index);
}

static bool read_corner(struct lom_obj *obj, struct lom_word word, struct obj_corner *corner)
{
    const char *at = word.start, *end = word.start + word.length;
    *corner = (struct obj_corner){ -1, -1, -1 };
    if (!read_index(obj, word, &at, obj->position_count, &corner->v))
        return false;
    if (at == end)
        return true;
    bool slash = *at++ == '/';
    if (slash && (at == end || *at != '/') && !read_optional(obj, word, &at, obj->texture_count, &corner->vt))
        return false;
    if (slash && at == end)
        return true;
    slash = slash && *at++ == '/';
    if (slash && !read_optional(obj, word, &at, obj->normal_count, &corner->vn))
        return false;
    if (!slash || at != end)
        return lom_text_fail(&obj->text, LOM_ERROR_INPUT, "\"%.*s\" is not a corner: v, v/vt, v//vn or v/vt/vn.",
                             lom_word_shown(word), word.start);
    return true;
}

static bool add_corner(struct lom_obj *obj, const struct obj_face *face, enum obj_kind kind, struct obj_corner corner)
{
    if (kind == OBJ_FACES && face->count == LOM_POLYGON_CORNERS)
        return lom_text_fail(&obj->text, LOM_ERROR_LIMIT, "A polygon of more than %d corners.", LOM_POLYGON_CORNERS);
    if (obj->corner_count == CORNER_LIMIT)
        return lom_text_fail(&obj->text, LOM_ERROR_LIMIT, "More than %d corners.", CORNER_LIMIT);
    if (kind == OBJ_FACES && face->count > 0) {
        const struct obj_corner *first = &obj->corners[face->first];
        if ((first->vt < 0) != (corner.vt < 0) || (first->vn < 0) != (corner.vn < 0))
            return lom_text_fail(&obj->text, LOM_ERROR_INPUT, "The corners of one face have different forms.");
    }
    if (!lom_reserve(&obj->corners, &obj->corner_capacity, obj->corner_count + 1, sizeof *obj->corners,
                     obj->text.error))
        return false;
    obj->corners[obj->corner_count++] = corner;
    return true;
}

static bool read_element(struct lom_obj *obj, enum obj_kind kind)
{
    static const struct {
        uint32_t least, part, fewer; /* corners; an element of n has part (n - fewer) indices */
        enum obj_passed passed;
    } kinds[] = { [OBJ_FACES] = { 3, 3, 2, OBJ_FEW_CORNERS },
                  [OBJ_LINES] = { 2, 2, 1, OBJ_FEW_ENDS },
                  [OBJ_POINTS] = { 1, 1, 0, OBJ_FEW_ENDS } };
    struct obj_elements *elements = &obj->elements[kind];
    struct obj_face face = { .first = (uint32_t)obj->corner_count,
                             .line = (uint32_t)obj->text.line,
                             .material = obj->material };
    for (struct lom_word word; (word = lom_text_word(&obj->text)).length > 0; face.count++) {
        struct obj_corner corner;
        if (!read_corner(obj, word, &corner) || !add_corner(obj, &face, kind, corner))
            return false;
    }
    if (face.count < kinds[kind].least) {
        lom_pass_over(obj, kinds[kind].passed, face.line);
        obj->corner_count = face.first;
        return true;
    }
    if (!lom_reserve(&elements->items, &elements->capacity, elements->count + 1, sizeof *elements->items,
                     obj->text.error))
        return false;
    elements->items[elements->count++] = face;
    elements->indices += (size_t)kinds[kind].part * (face.count - kinds[kind].fewer);
    return true;
}

static bool read_face(struct lom_obj *obj)
{
    return read_element(obj, OBJ_FACES);
}

static bool read_line(struct lom_obj *obj)
{
    return read_element(obj, OBJ_LINES);
}

static bool read_points(struct lom_obj *obj)
{
    return read_element(obj, OBJ_POINTS);
}

/* ---- materials ---- */

/* A name is all of its line; but a comment behind the name of a material that is defined is a comment, and so is a '#'
 * with a blank behind it alone. */
static bool read_usemtl(struct lom_obj *obj)
{
    struct lom_word name = lom_text_rest(&obj->text), shorter = lom_before_comment(name);
    obj->material = -1;
    if (shorter.length < name.length && lom_known_material(&obj->materials, name.start, name.length) < 0) {
        int known = lom_known_material(&obj->materials, shorter.start, shorter.length);
        bool comment = shorter.length == 0 && (name.length == 1 || name.start[1] == ' ' || name.start[1] == '\t');
        if (comment || (known >= 0 && obj->materials.entries[known].defined))
            name = shorter;
    }
    if (name.length == 0)
        return true;
    obj->material = lom_text_material(&obj->materials, &obj->text, name);
    return obj->material >= 0;
}

enum found { FOUND, MISSING, FAILED };

/* Reads one material file; in messages it is called by the OBJ's folder and its own name. */
static enum found read_library(struct lom_obj *obj, struct lom_word word)
{
    lom_error error = { 0 };
    const char *name = obj->text.name;
    size_t folder = lom_folder_length(name, strlen(name)), length = folder + word.length;
    char *path = lom_allocate(length + 1, 1, obj->text.error);
    if (path == NULL)
        return FAILED;
    memcpy(path, name, folder);
    for (size_t i = 0; i < word.length; i++)
        path[folder + i] = word.start[i] == '\\' ? '/' : word.start[i];
    lom_bytes file = obj->read_material(obj->context, path + folder, &error);
    enum found found = FOUND;
    if (file.data == NULL) {
        found = error.code == LOM_ERROR_FILE ? MISSING : FAILED;
        if (found == FAILED)
            lom_text_fail(&obj->text, error.code == LOM_OK ? LOM_ERROR_FILE : error.code, "%s",
                          error.code == LOM_OK ? "A material file gave nothing." : error.text);
    } else if (!lom_decode_mtl(&obj->materials, file, path[folder] == '/' ? path + folder : path, path + folder,
                               lom_folder_length(path + folder, word.length), &obj->warnings, obj->text.error)) {
        found = FAILED;
    }
    lom_release(file.data);
    lom_release(path);
    return found;
}

/* One name with blanks (and '#') in it when there is such a file, or before a comment; otherwise several names. */
static bool read_mtllib(struct lom_obj *obj)
{
    struct lom_text start = obj->text;
    struct lom_word rest = lom_text_rest(&obj->text), shorter = lom_before_comment(rest);
    if (obj->read_material == NULL || shorter.length == 0)
        return true;
    enum found found = read_library(obj, rest);
    if (found == MISSING && shorter.length < rest.length)
        found = read_library(obj, rest = shorter);
    if (found != MISSING)
        return found == FOUND;
    obj->text = start;
    for (struct lom_word word; (word = lom_text_word(&obj->text)).length > 0;) {
        found = word.length == rest.length ? MISSING : read_library(obj, word);
        if (found == FAILED)
            return false;
        if (found == MISSING)
            lom_warn(&obj->warnings, "%s:%zu: the material file \"%.*s\" could not be opened.", obj->text.name,
                     obj->text.line, lom_word_shown(word), word.start);
    }
    return true;
}

/* ---- the file ---- */

void lom_pass_over(struct lom_obj *obj, enum obj_passed what, size_t line)
{
    if (obj->passed[what].count++ == 0)
        obj->passed[what].line = line;
}

static bool pass_over_curve(struct lom_obj *obj)
{
    lom_pass_over(obj, OBJ_CURVES, obj->text.line);
    return true;
}

/* Without faces, lines and points every position is a vertex. */
static bool keep_positions(struct lom_obj *obj)
{
    if (obj->position_count == 0)
        return lom_text_fail(&obj->text, LOM_ERROR_INPUT, "The file ends without a face, and without a vertex.");
    obj->corner_count = 0;
    for (size_t i = 0; i < obj->position_count; i++)
        if (!add_corner(obj, &(struct obj_face){ .count = 0 }, OBJ_POINTS, (struct obj_corner){ (int32_t)i, -1, -1 }))
            return false;
    lom_pass_over(obj, OBJ_NO_FACES, obj->text.line);
    return true;
}

static const struct {
    const char *word;
    bool (*read)(struct lom_obj *obj);
} statements[] = {
    { "v", read_position }, { "vt", read_texture },      { "vn", read_normal },        { "f", read_face },
    { "fo", read_face },    { "usemtl", read_usemtl },   { "mtllib", read_mtllib },    { "p", read_points },
    { "l", read_line },     { "curv", pass_over_curve }, { "curv2", pass_over_curve }, { "surf", pass_over_curve },
};

static bool read_statement(struct lom_obj *obj)
{
    struct lom_word word = lom_text_word(&obj->text);
    for (size_t i = 0; i < sizeof statements / sizeof *statements; i++)
        if (lom_word_is(word, statements[i].word))
            return statements[i].read(obj);
    return true;
}

static bool read_statements(struct lom_obj *obj)
{
    do {
        if (!read_statement(obj))
            return false;
    } while (lom_text_next(&obj->text));
    bool any = false;
    for (int kind = 0; kind < OBJ_KINDS; kind++)
        any = any || obj->elements[kind].count > 0;
    return any || keep_positions(obj);
}

lom_mesh *lom_decode_obj_with(const char *text, size_t size, const char *name, lom_read_material read_material,
                              void *context, lom_error *error)
{
    struct lom_obj obj = { .read_material = read_material, .context = context, .material = -1 };
    lom_error own = { 0 };
    lom_float_state state;
    lom_mesh *mesh = NULL;
    if (size > FILE_LIMIT) {
        lom_fail(error, LOM_ERROR_LIMIT, "%s: %zu bytes are more than the limit of %d.", name, size, FILE_LIMIT);
        return NULL;
    }
    lom_enter_float_state(&state);
    if (lom_text_open(&obj.text, text, size, name, &own) && read_statements(&obj))
        mesh = lom_build_obj(&obj);
    lom_leave_float_state(&state);
    lom_release(obj.positions);
    lom_release(obj.texture);
    lom_release(obj.normals);
    lom_release(obj.corners);
    for (int kind = 0; kind < OBJ_KINDS; kind++)
        lom_release(obj.elements[kind].items);
    lom_free_materials(&obj.materials);
    lom_pass_error(&own, error);
    return mesh;
}

lom_mesh *lom_decode_obj(const char *text, size_t size, const char *name, lom_error *error)
{
    return lom_decode_obj_with(text, size, name, NULL, NULL, error);
}

lom_mesh *lom_read_obj(const char *path, lom_error *error)
{
    lom_bytes file = lom_read_file(path, FILE_LIMIT, error);
    if (file.data == NULL)
        return NULL;
    lom_mesh *mesh = lom_decode_obj_with((const char *)file.data, file.size, path, lom_read_beside, &path, error);
    lom_release(file.data);
    return mesh;
}
