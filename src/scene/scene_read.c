/* From the tree of TOML values to structs, by the tables of keys. In: values and a table. Out: a filled struct, or an
 * error that names the place. Invariant: every member the table describes holds a value inside its range. */
#include "base/numbers.h"
#include "scene/reader.h"

#include <string.h>
#include <sys/stat.h>

static void *member(void *target, size_t offset)
{
    return (char *)target + offset;
}

static size_t value_count(const lom_key *key)
{
    return key->count > 1 ? (size_t)key->count : 1;
}

/* ---- messages ---- */

static bool fail_type(lom_reader *reader, const lom_key *key, const lom_toml_value *value, const char *wanted)
{
    return lom_toml_fail(value->source, value->offset, LOM_ERROR_INPUT, reader->error, "\"%s\" must be %s, not %s.",
                         key->name, wanted, lom_toml_type_name(value->type));
}

static const char *key_name(const void *context, size_t index)
{
    return ((const lom_key *)context)[index].name;
}

static const char *choice_name(const void *context, size_t index)
{
    return ((const lom_key *)context)->choices[index];
}

static bool fail_unknown(lom_reader *reader, const lom_key_table *table, const lom_toml_value *value)
{
    char text[96];
    lom_suggestion_text(text,
                        lom_suggest(value->key, value->key_length, key_name, table->keys, (size_t)table->key_count));
    return lom_toml_fail(value->source, value->key_offset, LOM_ERROR_INPUT, reader->error, "unknown key \"%.80s\"%s",
                         value->key, text);
}

static bool fail_range(lom_reader *reader, const lom_key *key, const lom_toml_value *value, double number)
{
    char range[160], shown[32];
    lom_print_double(shown, number);
    lom_range_text(range, key);
    bool finite = range[0] != 0;
    return lom_toml_fail(value->source, value->offset, LOM_ERROR_INPUT, reader->error,
                         "\"%s\" is %s but must be %s%s%s.", key->name, shown, finite ? range : "finite",
                         finite && key->unit != NULL ? " " : "", finite && key->unit != NULL ? key->unit : "");
}

/* ---- numbers ---- */

static bool in_range(const lom_key *key, double number)
{
    if (!(number - number == 0)) /* infinite or NaN */
        return false;
    if (key->minimum == 0 && key->maximum == 0)
        return true;
    return number <= key->maximum && (key->flags & LOM_KEY_ABOVE ? number > key->minimum : number >= key->minimum);
}

static double to_member(const lom_key *key, double number)
{
    return key->type == LOM_KEY_ANGLE ? number * lom_radians_per_degree : number;
}

static bool read_number(lom_reader *reader, const lom_key *key, const lom_toml_value *value, double *target)
{
    if (value->type != LOM_TOML_INTEGER && value->type != LOM_TOML_FLOAT)
        return fail_type(reader, key, value, value_count(key) == 1 ? "a number" : "made of numbers");
    const double given = value->type == LOM_TOML_INTEGER ? (double)value->integer : value->number;
    const double number = lom_without_denormals(given);
    if (!in_range(key, number))
        return fail_range(reader, key, value, given);
    *target = to_member(key, number);
    return true;
}

static bool fail_count(lom_reader *reader, const lom_key *key, const lom_toml_value *value, const char *things)
{
    const char *or_one = key->flags & LOM_KEY_SPREAD ? "one number or " : "";
    if (value->type == LOM_TOML_ARRAY)
        return lom_toml_fail(value->source, value->offset, LOM_ERROR_INPUT, reader->error,
                             "\"%s\" must be %san array of %d %s, not of %zu.", key->name, or_one, key->count, things,
                             value->count);
    return lom_toml_fail(value->source, value->offset, LOM_ERROR_INPUT, reader->error,
                         "\"%s\" must be %san array of %d %s, not %s.", key->name, or_one, key->count, things,
                         lom_toml_type_name(value->type));
}

static bool read_numbers(lom_reader *reader, const lom_key *key, const lom_toml_value *value, void *target)
{
    double *numbers = target;
    size_t count = value_count(key);
    if (count == 1)
        return read_number(reader, key, value, numbers);
    if ((key->flags & LOM_KEY_SPREAD) && (value->type == LOM_TOML_INTEGER || value->type == LOM_TOML_FLOAT)) {
        for (size_t i = 0; i < count; i++)
            if (!read_number(reader, key, value, &numbers[i]))
                return false;
        return true;
    }
    if (value->type != LOM_TOML_ARRAY || value->count != count)
        return fail_count(reader, key, value, "numbers");
    for (size_t i = 0; i < count; i++)
        if (!read_number(reader, key, value->items[i], &numbers[i]))
            return false;
    return true;
}

static bool read_integer(lom_reader *reader, const lom_key *key, const lom_toml_value *value, void *target)
{
    if (value->type != LOM_TOML_INTEGER)
        return fail_type(reader, key, value, "an integer");
    double number = (double)value->integer;
    if (!in_range(key, number) || number < INT32_MIN || number > INT32_MAX)
        return fail_range(reader, key, value, number);
    *(int *)target = (int)value->integer;
    return true;
}

static bool read_bool(lom_reader *reader, const lom_key *key, const lom_toml_value *value, void *target)
{
    if (value->type != LOM_TOML_BOOLEAN)
        return fail_type(reader, key, value, "true or false");
    *(bool *)target = value->boolean;
    return true;
}

/* ---- text ---- */

static bool read_choice(lom_reader *reader, const lom_key *key, const lom_toml_value *value, void *target)
{
    char range[160], suggestion[96];
    lom_range_text(range, key);
    if (value->type != LOM_TOML_STRING)
        return fail_type(reader, key, value, range);
    size_t count = 0;
    for (; count < sizeof key->choices / sizeof *key->choices && key->choices[count] != NULL; count++) {
        if (strlen(key->choices[count]) == value->length &&
            memcmp(key->choices[count], value->text, value->length) == 0) {
            *(int *)target = (int)count;
            return true;
        }
    }
    lom_suggestion_text(suggestion, lom_suggest(value->text, value->length, choice_name, key, count));
    return lom_toml_fail(value->source, value->offset, LOM_ERROR_INPUT, reader->error,
                         "\"%s\" is \"%.80s\" but must be %s%s.", key->name, value->text, range, suggestion);
}

bool lom_add_scene_file(lom_scene *scene, const char *path, lom_error *error)
{
    struct lom_scene_memory *memory = scene->memory;
    for (size_t i = 0; i < memory->file_count; i++)
        if (strcmp(memory->files[i], path) == 0)
            return true;
    const char **files =
        lom_arena_grow(&memory->arena, memory->files, memory->file_count, &memory->file_capacity, sizeof *files, error);
    if (files == NULL)
        return false;
    memory->files = files;
    memory->files[memory->file_count++] = path;
    return true;
}

const char *lom_read_path(lom_reader *reader, const lom_toml_value *value, const char *name, size_t length)
{
    const char *folder = name[0] == '/' ? "" : reader->folder;
    size_t folder_length = strlen(folder);
    char *path = lom_arena_take(&reader->scene->memory->arena, folder_length + length + 1, 1, reader->error);
    if (path == NULL)
        return NULL;
    memcpy(path, folder, folder_length);
    memcpy(path + folder_length, name, length);
    struct stat facts;
    bool there = stat(path, &facts) == 0;
    if (!there || S_ISDIR(facts.st_mode)) {
        lom_toml_fail(value->source, value->offset, LOM_ERROR_FILE, reader->error,
                      there ? "\"%.160s\" is a folder, not a file." : "there is no file \"%.160s\".", path);
        return NULL;
    }
    return lom_add_scene_file(reader->scene, path, reader->error) ? path : NULL;
}

/* An empty string is none, so that an override can take a file away. */
static bool read_text(lom_reader *reader, const lom_key *key, const lom_toml_value *value, const char **target)
{
    if (value->type != LOM_TOML_STRING)
        return fail_type(reader, key, value, key->count > 1 ? "made of strings" : "a string");
    if (memchr(value->text, 0, value->length) != NULL)
        return lom_toml_fail(value->source, value->offset, LOM_ERROR_INPUT, reader->error,
                             "\"%s\" may not hold the character U+0000.", key->name);
    if (value->length == 0)
        *target = NULL;
    else if (key->type == LOM_KEY_FILE)
        *target = lom_read_path(reader, value, value->text, value->length);
    else
        *target = lom_arena_text(&reader->scene->memory->arena, value->text, value->length, reader->error);
    return value->length == 0 || *target != NULL;
}

static bool read_texts(lom_reader *reader, const lom_key *key, const lom_toml_value *value, void *target)
{
    const char **texts = target;
    size_t count = value_count(key);
    if (count == 1)
        return read_text(reader, key, value, texts);
    if (value->type != LOM_TOML_ARRAY || value->count != count)
        return fail_count(reader, key, value, key->type == LOM_KEY_FILE ? "file names" : "strings");
    for (size_t i = 0; i < count; i++)
        if (!read_text(reader, key, value->items[i], &texts[i]))
            return false;
    return true;
}

/* ---- tables ---- */

/* The tables of an array from `first` on, to where offset and the key's length_offset say. */
static bool read_tables(lom_reader *reader, const lom_key *key, const lom_toml_value *value, size_t first,
                        size_t offset, void *target)
{
    if (value->type != LOM_TOML_ARRAY)
        return fail_type(reader, key, value, "an array of tables");
    if (value->count > LOM_SCENE_MAX_TABLES)
        return lom_toml_fail(value->source, value->offset, LOM_ERROR_LIMIT, reader->error,
                             "\"%s\" has %zu tables, more than the limit of %d.", key->name, value->count,
                             LOM_SCENE_MAX_TABLES);
    const size_t count = value->count - first, size = key->table->size;
    char *structs = lom_arena_take(&reader->scene->memory->arena, count, size, reader->error);
    if (structs == NULL)
        return false;
    for (size_t i = 0; i < count; i++) {
        if (value->items[first + i]->type != LOM_TOML_TABLE)
            return fail_type(reader, key, value->items[first + i], "made of tables");
        if (!lom_read_table(reader, key->table, value->items[first + i], structs + i * size))
            return false;
    }
    memcpy(member(target, offset), &structs, sizeof structs);
    memcpy(member(target, key->length_offset), &count, sizeof count);
    return true;
}

/* One table, or where there may be others an array of them. */
static bool read_one_table(lom_reader *reader, const lom_key *key, const lom_toml_value *value, void *target)
{
    const lom_toml_value *one = value;
    if (key->others_offset != 0 && value->type == LOM_TOML_ARRAY && value->count > 0) {
        one = value->items[0];
        if (!read_tables(reader, key, value, 1, key->others_offset, target))
            return false;
    }
    if (one->type != LOM_TOML_TABLE)
        return fail_type(reader, key, one, "a table");
    return lom_read_table(reader, key->table, one, member(target, key->offset));
}

static bool read_value(lom_reader *reader, const lom_key *key, const lom_toml_value *value, void *target)
{
    void *place = member(target, key->offset);
    switch (key->type) {
    case LOM_KEY_BOOL:
        return read_bool(reader, key, value, place);
    case LOM_KEY_INTEGER:
        return read_integer(reader, key, value, place);
    case LOM_KEY_NUMBER:
    case LOM_KEY_ANGLE:
    case LOM_KEY_COLOR:
        return read_numbers(reader, key, value, place);
    case LOM_KEY_STRING:
    case LOM_KEY_FILE:
        return read_texts(reader, key, value, place);
    case LOM_KEY_CHOICE:
        return read_choice(reader, key, value, place);
    case LOM_KEY_TABLE:
        return read_one_table(reader, key, value, target);
    case LOM_KEY_TABLES:
        return read_tables(reader, key, value, 0, key->offset, target);
    }
    return false;
}

/* A struct starts as zero bytes; what else a default is, is written here. */
static bool set_default(lom_reader *reader, const lom_key *key, void *target)
{
    void *place = member(target, key->offset);
    if (key->type == LOM_KEY_BOOL)
        *(bool *)place = key->initial[0] != 0;
    else if (key->type == LOM_KEY_INTEGER || key->type == LOM_KEY_CHOICE)
        *(int *)place = lom_int_of(key->initial[0]);
    else if (key->type == LOM_KEY_NUMBER || key->type == LOM_KEY_ANGLE || key->type == LOM_KEY_COLOR)
        for (size_t i = 0; i < value_count(key); i++)
            ((double *)place)[i] = to_member(key, key->initial[i]);
    else if (key->type == LOM_KEY_TABLE)
        return lom_read_table(reader, key->table, NULL, place);
    return true;
}

static int find_key(const lom_key_table *table, const lom_toml_value *value)
{
    for (int i = 0; i < table->key_count; i++)
        if (strlen(table->keys[i].name) == value->key_length &&
            memcmp(table->keys[i].name, value->key, value->key_length) == 0)
            return i;
    return -1;
}

static bool read_keys(lom_reader *reader, const lom_key_table *table, const lom_toml_value *value, void *target)
{
    const bool present = true;
    for (size_t i = 0; i < value->count; i++) {
        int index = find_key(table, value->items[i]);
        if (index < 0)
            return fail_unknown(reader, table, value->items[i]);
        if (!read_value(reader, &table->keys[index], value->items[i], target))
            return false;
    }
    memcpy(target, &present, sizeof present);
    for (int i = 0; i < table->key_count; i++)
        if ((table->keys[i].flags & LOM_KEY_REQUIRED) &&
            lom_toml_find(value, table->keys[i].name, strlen(table->keys[i].name)) == NULL)
            return lom_toml_fail(value->source, value->offset, LOM_ERROR_INPUT, reader->error,
                                 "the key \"%s\" is missing in this table.", table->keys[i].name);
    return true;
}

/* Tables that are not in the file are checked when the one that holds them is: defaults are derived there, too. */
bool lom_read_table(lom_reader *reader, const lom_key_table *table, const lom_toml_value *value, void *target)
{
    for (int i = 0; i < table->key_count; i++)
        if (!set_default(reader, &table->keys[i], target))
            return false;
    if (value != NULL && !read_keys(reader, table, value, target))
        return false;
    const lom_key_check check = lom_check_of(reader, value);
    return table->check == NULL || table->check(target, &check);
}
