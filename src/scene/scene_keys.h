/* The tables of the scene layer's own keys; those of a model are with the model. */
#ifndef LOM_SCENE_SCENE_KEYS_H
#define LOM_SCENE_SCENE_KEYS_H

#include "base/keys.h"

extern const lom_key_table lom_scene_keys; /* of the whole file */
extern const lom_key_table lom_camera_keys, lom_light_keys, lom_terrain_keys, lom_entity_keys, lom_lamp_keys;
extern const lom_key_table lom_view_keys, lom_quality_keys;
extern const lom_key_table lom_entity_material_keys, lom_entity_back_keys, lom_terrain_material_keys;

/* Whether a key frame comes after the one before it; fails at its time when not. */
bool lom_check_rising_time(const lom_key_check *check, double before, double time);

#endif
