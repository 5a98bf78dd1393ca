/* The table of the scene file's [water] keys; it fills a lom_water_params. */
#ifndef LOM_WATER_WATER_KEYS_H
#define LOM_WATER_WATER_KEYS_H

#include "base/keys.h"

extern const lom_key_table lom_water_keys;
/* [water.optics], inside it; [water.waves] and [water.foam] are in waves/wave_keys.h. */
extern const lom_key_table lom_water_optics_keys;

#endif
