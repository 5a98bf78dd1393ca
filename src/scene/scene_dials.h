/* Keys of a scene by their paths, and which of its dials act in it. */
#ifndef LOM_SCENE_SCENE_DIALS_H
#define LOM_SCENE_SCENE_DIALS_H

#include "base/keys.h"

#include <lom/scene.h>

/* A key that stands in no array of tables: there is one member behind it in a scene. */
typedef struct lom_scene_key {
    const lom_key *key;
    char path[64];      /* "water.optics.steps" */
    size_t offset;      /* of its member in lom_scene */
    size_t table;       /* of the struct that it stands in, against which length_offset counts */
    bool is_in_quality; /* below [quality] */
} lom_scene_key;

/* Calls `visit` for each of them in the order of the tables, tables before what they hold, until it returns false. */
typedef bool lom_visit_scene_key(void *context, const lom_scene_key *key);
void lom_visit_scene_keys(lom_visit_scene_key *visit, void *context);
/* The one with this path; false: there is none. */
bool lom_find_scene_key(const char *path, lom_scene_key *found);

enum { LOM_SCENE_VALUE = 48 };
/* The value of a key in a scene as lom_key_dial writes settings: "0.05", "true", "octaves"; of arrays the first number;
 * "" of tables and texts. */
const char *lom_print_scene_value(char text[LOM_SCENE_VALUE], const lom_scene *scene, const lom_scene_key *key);
/* Its default, likewise. */
const char *lom_print_scene_default(char text[LOM_SCENE_VALUE], const lom_scene_key *key);

enum { LOM_DIAL_REASON = 160 };
/* Whether a dial acts in a scene, by its conditions; why is empty then, else the first that does not hold:
 * "quality.clouds is off", "there is no [terrain]". */
bool lom_dial_acts(const lom_scene *scene, const lom_key_dial *dial, char why[LOM_DIAL_REASON]);

/* Word i of words that are separated by single characters `between`, as far as it fits; false behind the last. */
bool lom_nth_word(const char *words, char between, size_t i, char *word, size_t size);

#endif
