/* What the steps from scene text to lom_scene share: the memory of the scene, and the steps. */
#ifndef LOM_SCENE_READER_H
#define LOM_SCENE_READER_H

#include "base/keys.h"
#include "scene/toml/toml.h"

#include <lom/scene.h>

enum { LOM_SCENE_MAX_TABLES = 16384 }; /* of one array: entities, layers, key frames; names are compared in pairs */

struct lom_scene_memory {
    lom_arena arena;
    const char **files; /* every file the scene names, each once */
    size_t file_count, file_capacity;
};

typedef struct lom_reader {
    lom_arena *tree;    /* of the TOML values; gone when the scene is read */
    lom_scene *scene;   /* strings and arrays go into its memory */
    const char *folder; /* of the scene file, with its last slash; "" for the working folder */
    const lom_toml_value *root;
    lom_error *error;
} lom_reader;

/* scene_read.c: defaults for every member of a table's struct, then what value (may be NULL) says. */
bool lom_read_table(lom_reader *reader, const lom_key_table *table, const lom_toml_value *value, void *target);
/* The path of a file the scene names at value; NULL when it is not there. It joins the scene's list of files. */
const char *lom_read_path(lom_reader *reader, const lom_toml_value *value, const char *name, size_t length);
bool lom_add_scene_file(lom_scene *scene, const char *path, lom_error *error);

/* key_check.c: what the check of a table that was read from this value (NULL: it is not in the file) asks and says. */
lom_key_check lom_check_of(lom_reader *reader, const lom_toml_value *table);
/* The check of the table under a key of a checked table; of an array of them the first. */
lom_key_check lom_check_inside(const lom_key_check *check, const char *key);

/* scene_override.c: puts the value of "KEY=VALUE", or what "@FILE" holds, into the tree under root. */
bool lom_apply_override(lom_reader *reader, lom_toml_value *root, const char *text);

/* scene_places.c: takes terrain.position off every place of a scene that was read from this root. */
void lom_measure_from_terrain(lom_scene *scene, const lom_key_check *root);

/* scene_check.c: what concerns several tables at once. */
bool lom_check_scene(lom_reader *reader, const lom_toml_value *root);

/* suggest.c: the name most like an unknown one, NULL when none is near enough. name(context, i) gives name i of count,
 * or NULL to skip it. */
typedef const char *lom_name_at(const void *context, size_t index);
const char *lom_suggest(const char *unknown, size_t length, lom_name_at *name, const void *context, size_t count);
/* The text of a suggestion: " (did you mean \"water\"?)", or "". */
const char *lom_suggestion_text(char text[96], const char *suggestion);

/* range_text.c: the values a key may have, "from 1 to 32768 pixels"; "" when any number will do. */
const char *lom_range_text(char text[160], const lom_key *key);

#endif
