/* Which dials act in a scene. In: the tables of keys, a scene. Out: keys with the places of their members; the values
 * there; whether a dial's conditions hold, and which does not. Invariant: what a dial needs is said by its row alone.
 */
#include "scene/scene_dials.h"

#include "base/numbers.h"
#include "scene/scene_keys.h"

#include <assert.h>
#include <stdio.h>
#include <string.h>

/* ---- keys by their paths ---- */

struct walk {
    lom_visit_scene_key *visit;
    void *context;
};

/* `outer` is the key of the table, with the member behind it; NULL: the root. */
static bool visit_table(const struct walk *walk, const lom_key_table *table, const lom_scene_key *outer)
{
    const size_t start = outer != NULL ? outer->offset : 0;
    for (int i = 0; i < table->key_count; i++) {
        lom_scene_key at = { .key = &table->keys[i], .table = start, .offset = start + table->keys[i].offset };
        const int length = snprintf(at.path, sizeof at.path, "%s%s%s", outer != NULL ? outer->path : "",
                                    outer != NULL ? "." : "", at.key->name);
        assert(length > 0 && (size_t)length < sizeof at.path);
        at.is_in_quality = strncmp(at.path, "quality.", 8) == 0;
        if (!walk->visit(walk->context, &at))
            return false;
        if (at.key->type == LOM_KEY_TABLE && !visit_table(walk, at.key->table, &at))
            return false;
    }
    return true;
}

void lom_visit_scene_keys(lom_visit_scene_key *visit, void *context)
{
    const struct walk walk = { visit, context };
    visit_table(&walk, &lom_scene_keys, NULL);
}

struct search {
    const char *path;
    lom_scene_key *found;
    bool done;
};

static bool compare(void *context, const lom_scene_key *key)
{
    struct search *search = context;
    search->done = strcmp(key->path, search->path) == 0;
    if (search->done)
        *search->found = *key;
    return !search->done;
}

bool lom_find_scene_key(const char *path, lom_scene_key *found)
{
    struct search search = { path, found, false };
    lom_visit_scene_keys(compare, &search);
    return search.done;
}

/* ---- values ---- */

static double number_at(const lom_key *key, const void *member)
{
    double number;
    memcpy(&number, member, sizeof number);
    if (key->type != LOM_KEY_ANGLE)
        return number;
    /* Degrees were turned to radians: what was written had no digit beyond these. */
    return lom_double_floor(number / lom_radians_per_degree * 1e9 + 0.5) / 1e9;
}

const char *lom_print_scene_value(char text[LOM_SCENE_VALUE], const lom_scene *scene, const lom_scene_key *at)
{
    const lom_key *key = at->key;
    const void *member = (const char *)scene + at->offset;
    char number[32];
    text[0] = 0;
    switch (key->type) {
    case LOM_KEY_BOOL:
        snprintf(text, LOM_SCENE_VALUE, "%s", *(const bool *)member ? "true" : "false");
        break;
    case LOM_KEY_INTEGER:
        snprintf(text, LOM_SCENE_VALUE, "%d", *(const int *)member);
        break;
    case LOM_KEY_CHOICE:
        snprintf(text, LOM_SCENE_VALUE, "%s", key->choices[*(const int *)member]);
        break;
    case LOM_KEY_NUMBER:
    case LOM_KEY_ANGLE:
    case LOM_KEY_COLOR:
        lom_print_double(number, number_at(key, member));
        snprintf(text, LOM_SCENE_VALUE, "%s", number);
        break;
    case LOM_KEY_STRING:
    case LOM_KEY_FILE:
    case LOM_KEY_TABLE:
    case LOM_KEY_TABLES:
        break;
    }
    return text;
}

const char *lom_print_scene_default(char text[LOM_SCENE_VALUE], const lom_scene_key *at)
{
    const lom_key *key = at->key;
    char number[32];
    lom_print_double(number, key->initial[0]);
    if (key->type == LOM_KEY_BOOL)
        snprintf(text, LOM_SCENE_VALUE, "%s", key->initial[0] != 0 ? "true" : "false");
    else if (key->type == LOM_KEY_CHOICE)
        snprintf(text, LOM_SCENE_VALUE, "%s", key->choices[lom_int_of(key->initial[0])]);
    else
        snprintf(text, LOM_SCENE_VALUE, "%s", number);
    return text;
}

/* ---- conditions ---- */

bool lom_nth_word(const char *words, char between, size_t i, char *word, size_t size)
{
    const char *end;
    for (; i > 0; i--) {
        words = strchr(words, between);
        if (words == NULL)
            return false;
        words++;
    }
    end = strchr(words, between);
    const size_t length = end != NULL ? (size_t)(end - words) : strlen(words);
    if (length == 0)
        return false;
    snprintf(word, size, "%.*s", (int)(length < size ? length : size - 1), words);
    return true;
}

static size_t length_of(const lom_scene *scene, const lom_scene_key *at)
{
    size_t length;
    memcpy(&length, (const char *)scene + at->table + at->key->length_offset, sizeof length);
    return length;
}

/* Whether what `path` names is there, and not 0 or false. */
static bool is_there(const lom_scene *scene, const lom_scene_key *at)
{
    char value[LOM_SCENE_VALUE];
    if (at->key->type == LOM_KEY_TABLES)
        return length_of(scene, at) > 0;
    if (at->key->type == LOM_KEY_TABLE)
        return *((const char *)scene + at->offset) != 0;
    lom_print_scene_value(value, scene, at);
    return strcmp(value, "0") != 0 && strcmp(value, "false") != 0;
}

/* Adds why it is not there. */
static void tell_missing(char why[LOM_DIAL_REASON], const lom_scene *scene, const lom_scene_key *at)
{
    char value[LOM_SCENE_VALUE];
    const size_t length = strlen(why);
    const bool is_table = at->key->type == LOM_KEY_TABLE, is_array = at->key->type == LOM_KEY_TABLES;
    const char *and = length > 0 ? " and " : "";
    if (is_table || is_array)
        snprintf(why + length, LOM_DIAL_REASON - length, "%sthere is no %s%s%s", and, is_table ? "[" : "[[", at->path,
                 is_table ? "]" : "]]");
    else
        snprintf(why + length, LOM_DIAL_REASON - length, "%s%s is %s", and, at->path,
                 lom_print_scene_value(value, scene, at));
}

static lom_scene_key key_of(const char *path)
{
    lom_scene_key at = { .key = NULL };
    const bool found = lom_find_scene_key(path, &at);
    assert(found);
    (void)found;
    return at;
}

static bool is_any_there(const lom_scene *scene, const char *paths, char why[LOM_DIAL_REASON])
{
    char path[64];
    for (size_t i = 0; lom_nth_word(paths, '|', i, path, sizeof path); i++) {
        const lom_scene_key at = key_of(path);
        if (is_there(scene, &at)) {
            why[0] = 0;
            return true;
        }
        tell_missing(why, scene, &at);
    }
    return false;
}

static bool has_value(const lom_scene *scene, const char *path, const char *values, char why[LOM_DIAL_REASON])
{
    char wanted[LOM_SCENE_VALUE], value[LOM_SCENE_VALUE];
    const lom_scene_key at = key_of(path);
    lom_print_scene_value(value, scene, &at);
    for (size_t i = 0; lom_nth_word(values, '|', i, wanted, sizeof wanted); i++)
        if (strcmp(wanted, value) == 0)
            return true;
    tell_missing(why, scene, &at);
    return false;
}

bool lom_dial_acts(const lom_scene *scene, const lom_key_dial *dial, char why[LOM_DIAL_REASON])
{
    char condition[96], path[64];
    why[0] = 0;
    for (size_t i = 0; dial->needs != NULL && lom_nth_word(dial->needs, ' ', i, condition, sizeof condition); i++) {
        const char *values = strchr(condition, '=');
        if (values != NULL) {
            lom_nth_word(condition, '=', 0, path, sizeof path);
            if (!has_value(scene, path, values + 1, why))
                return false;
        } else if (!is_any_there(scene, condition, why)) {
            return false;
        }
    }
    return true;
}
