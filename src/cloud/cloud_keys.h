/* The tables of the scene file's [clouds] and [[cloud]] keys; they fill a lom_clouds and lom_clouds' entities. */
#ifndef LOM_CLOUD_KEYS_H
#define LOM_CLOUD_KEYS_H

#include "base/keys.h"

extern const lom_key_table lom_cloud_keys, lom_clouds_keys;
/* [quality.impostor] */
extern const lom_key_table lom_impostor_keys;

#endif
