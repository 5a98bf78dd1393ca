/* What the checks of tables of keys ask and say. In: the value that a table was read from. Out: whether keys stand in
 * it, and errors at their places. */
#include "scene/reader.h"
#include "scene/scene_keys.h"

#include <string.h>

static const double least_interval = 1e-6; /* seconds between key frames, so that slopes stay finite */

static const lom_toml_value *child(const lom_toml_value *table, const char *key)
{
    return lom_toml_find(table, key, strlen(key));
}

static bool is_given(const lom_key_check *check, const char *key)
{
    return child(check->table, key) != NULL;
}

/* At the value of the key, or where the table is, or at the start of the file. */
static bool fail(const lom_key_check *check, const char *key, const char *sentence)
{
    const lom_reader *reader = check->reader;
    const lom_toml_value *table = check->table, *value = child(table, key);
    value = value != NULL ? value : table != NULL ? table : reader->root;
    return lom_toml_fail(value->source, value->offset, LOM_ERROR_INPUT, reader->error, "%s", sentence);
}

static lom_key_check element(const lom_key_check *check, const char *key, size_t i)
{
    const lom_toml_value *list = child(check->table, key);
    return lom_check_of(check->reader,
                        list != NULL && list->type == LOM_TOML_ARRAY && i < list->count ? list->items[i] : NULL);
}

static const char *path(const lom_key_check *check, const char *key, const char *name)
{
    return lom_read_path(check->reader, child(check->table, key), name, strlen(name));
}

lom_key_check lom_check_of(lom_reader *reader, const lom_toml_value *table)
{
    return (lom_key_check){ is_given, fail, element, path, reader->error, reader, table };
}

lom_key_check lom_check_inside(const lom_key_check *check, const char *key)
{
    const lom_toml_value *value = child(check->table, key);
    if (value != NULL && value->type == LOM_TOML_ARRAY)
        return element(check, key, 0);
    return lom_check_of(check->reader, value);
}

bool lom_check_rising_time(const lom_key_check *check, double before, double time)
{
    return time - before >= least_interval ||
           check->fail(check, "time", "the times of keys must rise, by a millionth of a second or more.");
}
