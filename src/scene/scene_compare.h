/* Which keys of two scenes differ. */
#ifndef LOM_SCENE_SCENE_COMPARE_H
#define LOM_SCENE_SCENE_COMPARE_H

#include "base/keys.h"

#include <lom/scene.h>

/* Bytes of the member behind a key's offset. */
size_t lom_key_size(const lom_key *key);

enum { LOM_LONGEST_KEY_PATH = 160 };

/* Calls `differs` for each key whose values differ, with its path without the numbers of elements ("cloud.size"), once
 * for each element. A table that only one scene has, or of which what the reader derived differs, and an array of
 * another length are told by the table's own path. Paths of files are compared as text, never what the files hold. */
typedef void lom_differing_key(void *context, const char *path);
void lom_compare_scenes(const lom_scene *a, const lom_scene *b, lom_differing_key *differs, void *context);

#endif
