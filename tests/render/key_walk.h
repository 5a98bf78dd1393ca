/* The keys of the scene file, one after the other, for tests that try values of all of them. */
#ifndef LOM_TESTS_KEY_WALK_H
#define LOM_TESTS_KEY_WALK_H

#include "check.h"
#include "scene/scene_keys.h"

/* Whether the path is one of the names, or below one. */
static inline bool is_tried(const char *names, const char *path)
{
    while (*names != 0) {
        size_t length = strcspn(names, " ");
        if (strncmp(names, path, length) == 0 && (path[length] == 0 || path[length] == '.'))
            return true;
        names += length + (names[length] == ' ');
    }
    return false;
}

typedef void visit_key(void *context, const char *path, const lom_key *key, const void *member);

enum { LONGEST_PATH = 200 };

/* Every key that holds numbers, truths or choices: its path, of the first element of an array of tables, and its place
 * in the scene, NULL where the scene has no such element. path: that of the table, `length` bytes. */
static inline void walk_keys(const lom_key_table *table, char path[LONGEST_PATH], size_t length, const void *at,
                             visit_key *visit, void *context)
{
    for (int i = 0; i < table->key_count; i++) {
        const lom_key *key = &table->keys[i];
        const char *member = at != NULL ? (const char *)at + key->offset : NULL;
        bool array = key->type == LOM_KEY_TABLES;
        size_t longer = length + (size_t)snprintf(path + length, LONGEST_PATH - length, "%s%s%s", length > 0 ? "." : "",
                                                  key->name, array ? ".0" : "");
        if (longer >= LONGEST_PATH) {
            CHECK(false, "%s... is too long", path);
        } else if (array) {
            size_t there = 0;
            if (at != NULL)
                memcpy(&there, (const char *)at + key->length_offset, sizeof there);
            walk_keys(key->table, path, longer, there > 0 ? *(const void *const *)(const void *)member : NULL, visit,
                      context);
        } else if (key->type == LOM_KEY_TABLE) {
            walk_keys(key->table, path, longer, member, visit, context);
        } else if (key->type != LOM_KEY_STRING && key->type != LOM_KEY_FILE) {
            visit(context, path, key, member);
        }
    }
}

#endif
