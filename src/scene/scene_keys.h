/* The table of all keys of a scene file: the root, which leads to every other table. */
#ifndef LOM_SCENE_SCENE_KEYS_H
#define LOM_SCENE_SCENE_KEYS_H

#include "base/keys.h"

extern const lom_key_table lom_scene_keys;

#endif
