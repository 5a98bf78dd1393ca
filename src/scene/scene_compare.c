/* Two scenes, key by key. In: scenes as they were read. Out: the paths of the keys whose values differ. Invariant: what
 * is compared comes from the tables of keys, and what of a struct no key fills is compared as bytes, so nothing that the
 * reader wrote is passed over. */
#include "scene/scene_compare.h"

#include "scene/scene_keys.h"

#include <assert.h>
#include <stdio.h>
#include <string.h>

enum { LARGEST_TABLE = 4096 }; /* bytes of a struct */

struct comparison {
    lom_differing_key *differs;
    void *context;
    char path[LOM_LONGEST_KEY_PATH];
};

static size_t value_count(const lom_key *key)
{
    return key->count > 1 ? (size_t)key->count : 1;
}

size_t lom_key_size(const lom_key *key)
{
    switch (key->type) {
    case LOM_KEY_BOOL:
        return sizeof(bool);
    case LOM_KEY_INTEGER:
    case LOM_KEY_CHOICE:
        return sizeof(int);
    case LOM_KEY_NUMBER:
    case LOM_KEY_ANGLE:
    case LOM_KEY_COLOR:
        return value_count(key) * sizeof(double);
    case LOM_KEY_STRING:
    case LOM_KEY_FILE:
        return value_count(key) * sizeof(char *);
    case LOM_KEY_TABLE:
        return key->table->size;
    case LOM_KEY_TABLES:
        return sizeof(void *);
    }
    return 0;
}

static bool are_same_texts(const lom_key *key, const char *a, const char *b)
{
    for (size_t i = 0; i < value_count(key); i++) {
        const char *text[2];
        memcpy(&text[0], a + i * sizeof *text, sizeof *text);
        memcpy(&text[1], b + i * sizeof *text, sizeof *text);
        if (text[0] == NULL || text[1] == NULL ? text[0] != text[1] : strcmp(text[0], text[1]) != 0)
            return false;
    }
    return true;
}

/* Whether the bytes that no key fills are the same: whether the table is there, and what was derived. Of the root those
 * are the scene's own: its path and its memory. */
static bool is_rest_same(const lom_key_table *table, const char *a, const char *b)
{
    char mixed[LARGEST_TABLE];
    if (table == &lom_scene_keys)
        return true;
    if (table->size > sizeof mixed)
        return false;
    memcpy(mixed, a, table->size);
    for (int i = 0; i < table->key_count; i++) {
        const lom_key *key = &table->keys[i];
        memcpy(mixed + key->offset, b + key->offset, lom_key_size(key));
        if (key->type == LOM_KEY_TABLES)
            memcpy(mixed + key->length_offset, b + key->length_offset, sizeof(size_t));
    }
    return memcmp(mixed, b, table->size) == 0;
}

static void compare_tables(struct comparison *c, size_t length, const lom_key_table *table, const char *a,
                           const char *b);

static void compare_arrays(struct comparison *c, size_t length, const lom_key *key, size_t offset, const char *a,
                           const char *b)
{
    const char *first[2];
    size_t count[2];
    memcpy(&first[0], a + offset, sizeof *first);
    memcpy(&first[1], b + offset, sizeof *first);
    memcpy(&count[0], a + key->length_offset, sizeof *count);
    memcpy(&count[1], b + key->length_offset, sizeof *count);
    if (count[0] != count[1])
        c->differs(c->context, c->path);
    for (size_t i = 0; i < count[0] && i < count[1]; i++)
        compare_tables(c, length, key->table, first[0] + i * key->table->size, first[1] + i * key->table->size);
}

/* The path of the tables is in c->path, `length` bytes. */
static void compare_tables(struct comparison *c, size_t length, const lom_key_table *table, const char *a,
                           const char *b)
{
    if (!is_rest_same(table, a, b))
        c->differs(c->context, c->path);
    for (int i = 0; i < table->key_count; i++) {
        const lom_key *key = &table->keys[i];
        const char *at[2] = { a + key->offset, b + key->offset };
        int added = snprintf(c->path + length, sizeof c->path - length, "%s%s", length > 0 ? "." : "", key->name);
        size_t longer = length + (size_t)added;
        bool is_text = key->type == LOM_KEY_STRING || key->type == LOM_KEY_FILE;
        assert(longer < sizeof c->path);
        if (key->type == LOM_KEY_TABLES)
            compare_arrays(c, longer, key, key->offset, a, b);
        else if (key->type == LOM_KEY_TABLE)
            compare_tables(c, longer, key->table, at[0], at[1]);
        else if (is_text ? !are_same_texts(key, at[0], at[1]) : memcmp(at[0], at[1], lom_key_size(key)) != 0)
            c->differs(c->context, c->path);
        if (key->others_offset != 0)
            compare_arrays(c, longer, key, key->others_offset, a, b);
        c->path[length] = 0;
    }
}

void lom_compare_scenes(const lom_scene *a, const lom_scene *b, lom_differing_key *differs, void *context)
{
    struct comparison c = { .differs = differs, .context = context };
    compare_tables(&c, 0, &lom_scene_keys, (const char *)a, (const char *)b);
}
