/* The table of the scene file's [[fluid]] keys; it fills a lom_fluid_params of lom/fluid.h. */
#ifndef LOM_FLUID_FLUID_KEYS_H
#define LOM_FLUID_FLUID_KEYS_H

#include "base/keys.h"

extern const lom_key_table lom_fluid_keys;

#endif
