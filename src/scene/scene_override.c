/* Overrides of a scene: KEY=VALUE, @FILE. In: the text and the tree of the file. Out: the tree with the values in their
 * places. Invariant: an override can say what the file could say and nothing else; what it says is checked where the
 * file is. */
#include "scene/reader.h"
#include "scene/scene_keys.h"

#include <stdio.h>
#include <string.h>

enum { SHOWN = 160 }; /* characters of an override that a message repeats */

static bool fail_at(lom_reader *reader, const lom_toml_value *part, const char *sentence, const char *detail)
{
    return lom_toml_fail(part->source, part->key_offset, LOM_ERROR_USAGE, reader->error, sentence, part->key, detail);
}

/* The "name" of an element of an array of tables; NULL when it has none. */
static const char *element_name(const void *context, size_t index)
{
    const lom_toml_value *name = lom_toml_find(((const lom_toml_value *)context)->items[index], "name", 4);
    return name != NULL && name->type == LOM_TOML_STRING ? name->text : NULL;
}

static bool is_index(const lom_toml_value *part)
{
    size_t digits = 0;
    while (digits < part->key_length && part->key[digits] >= '0' && part->key[digits] <= '9')
        digits++;
    return digits > 0 && digits == part->key_length;
}

/* The place in array that part means: an index, or the name of a table. NULL on failure. */
static lom_toml_value **find_element(lom_reader *reader, lom_toml_value *array, const lom_toml_value *part)
{
    for (size_t i = 0; i < array->count; i++) {
        const char *name = element_name(array, i);
        if (name != NULL && strcmp(name, part->key) == 0)
            return &array->items[i];
    }
    char text[96];
    if (!is_index(part)) {
        lom_suggestion_text(text, lom_suggest(part->key, part->key_length, element_name, array, array->count));
        fail_at(reader, part, "nothing here is named \"%.80s\"%s", text);
        return NULL;
    }
    size_t index = 0;
    for (size_t i = 0; i < part->key_length && index < array->count; i++)
        index = index * 10 + (size_t)(part->key[i] - '0');
    if (index < array->count)
        return &array->items[index];
    snprintf(text, sizeof text, "%zu", array->count);
    fail_at(reader, part, "there is no element %.80s: the array has %s, counted from 0.", text);
    return NULL;
}

static bool is_named(const lom_toml_value *array, const lom_toml_value *part)
{
    for (size_t i = 0; i < array->count; i++) {
        const char *name = element_name(array, i);
        if (name != NULL && strcmp(name, part->key) == 0)
            return true;
    }
    return false;
}

/* Where a file has an array of tables of which most have one, a key without a number is the first one's: water.level. */
static lom_toml_value *or_first(lom_toml_value *parent, const lom_toml_value *part)
{
    bool may_be_one = false;
    for (int i = 0; i < lom_scene_keys.key_count; i++)
        may_be_one = may_be_one || (lom_scene_keys.keys[i].others_offset != 0 && parent->key != NULL &&
                                    strcmp(lom_scene_keys.keys[i].name, parent->key) == 0);
    const bool is_first =
        may_be_one && parent->type == LOM_TOML_ARRAY && parent->count > 0 && !is_index(part) && !is_named(parent, part);
    return is_first ? parent->items[0] : parent;
}

/* The value that part leads to from parent, made as an empty table when a table does not have it. */
static lom_toml_value *step(lom_reader *reader, lom_toml_value *parent, const lom_toml_value *part)
{
    parent = or_first(parent, part);
    if (parent->type == LOM_TOML_ARRAY) {
        lom_toml_value **element = find_element(reader, parent, part);
        return element == NULL ? NULL : *element;
    }
    if (parent->type != LOM_TOML_TABLE) {
        fail_at(reader, part, "\"%.80s\" cannot be a key of %s.", lom_toml_type_name(parent->type));
        return NULL;
    }
    lom_toml_value *child = lom_toml_find(parent, part->key, part->key_length);
    if (child != NULL)
        return child;
    child = lom_arena_take(reader->tree, 1, sizeof *child, reader->error);
    if (child == NULL)
        return NULL;
    *child = *part;
    child->type = LOM_TOML_TABLE;
    child->offset = part->key_offset;
    return lom_toml_put(reader->tree, parent, child, reader->error) ? child : NULL;
}

static bool put(lom_reader *reader, lom_toml_value *parent, const lom_toml_value *part, lom_toml_value *value)
{
    parent = or_first(parent, part);
    if (parent->type == LOM_TOML_TABLE)
        return lom_toml_put(reader->tree, parent, value, reader->error);
    if (parent->type != LOM_TOML_ARRAY)
        return fail_at(reader, part, "\"%.80s\" cannot be a key of %s.", lom_toml_type_name(parent->type));
    lom_toml_value **element = find_element(reader, parent, part);
    if (element == NULL)
        return false;
    *element = value;
    return true;
}

/* Puts what `over` holds into `table`: tables into tables, anything else in the place of what is there. */
static bool merge(lom_reader *reader, lom_toml_value *table, const lom_toml_value *over)
{
    for (size_t i = 0; i < over->count; i++) {
        lom_toml_value *value = over->items[i], *there = lom_toml_find(table, value->key, value->key_length);
        const bool both = there != NULL && there->type == LOM_TOML_TABLE && value->type == LOM_TOML_TABLE;
        if (both ? !merge(reader, there, value) : !lom_toml_put(reader->tree, table, value, reader->error))
            return false;
    }
    return true;
}

/* A file of settings. Its text lives as long as the tree, whose messages name places in it. */
static bool apply_file(lom_reader *reader, lom_toml_value *root, const char *name)
{
    lom_bytes bytes = lom_read_file(name, LOM_TOML_MAX_SIZE, reader->error);
    if (bytes.data == NULL)
        return false;
    const char *path = lom_arena_text(&reader->scene->memory->arena, name, strlen(name), reader->error);
    const char *text = lom_arena_text(reader->tree, (const char *)bytes.data, bytes.size, reader->error);
    const size_t size = bytes.size;
    lom_release(bytes.data);
    lom_toml_source *source = lom_arena_take(reader->tree, 1, sizeof *source, reader->error);
    if (path == NULL || text == NULL || source == NULL)
        return false;
    *source = (lom_toml_source){ .name = path, .text = text, .size = size };
    if (strcmp(name, "-") != 0 && !lom_add_scene_file(reader->scene, path, reader->error))
        return false;
    const lom_toml_value *over = lom_toml_parse(reader->tree, source, reader->error);
    return over != NULL && merge(reader, root, over);
}

bool lom_apply_override(lom_reader *reader, lom_toml_value *root, const char *text)
{
    if (text[0] == '@')
        return apply_file(reader, root, text + 1);
    lom_toml_source *source = lom_arena_take(reader->tree, 1, sizeof *source, reader->error);
    char *name = lom_arena_take(reader->tree, SHOWN + 16, 1, reader->error);
    lom_toml_value *parts = lom_arena_take(reader->tree, LOM_TOML_MAX_DEPTH, sizeof *parts, reader->error);
    if (source == NULL || name == NULL || parts == NULL)
        return false;
    snprintf(name, SHOWN + 16, "--set %.*s%s", SHOWN, text, strlen(text) > SHOWN ? "..." : "");
    *source = (lom_toml_source){ .name = name, .text = text, .size = strlen(text), .is_override = true };
    size_t count;
    lom_toml_value *value;
    if (!lom_toml_parse_assignment(reader->tree, source, parts, &count, &value, reader->error))
        return false;
    lom_toml_value *at = root;
    for (size_t i = 0; i + 1 < count; i++) {
        at = step(reader, at, &parts[i]);
        if (at == NULL)
            return false;
    }
    return put(reader, at, &parts[count - 1], value);
}
