/* The tables of the scene file's keys of waves. */
#ifndef LOM_WAVES_WAVE_KEYS_H
#define LOM_WAVES_WAVE_KEYS_H

#include "base/keys.h"

/* [water.waves]: lom_water_waves. */
extern const lom_key_table lom_water_waves_keys;
/* [water.foam]: lom_water_foam. */
extern const lom_key_table lom_water_foam_keys;
/* [surf]: lom_water_surf. */
extern const lom_key_table lom_water_surf_keys;
/* [[wake]]: lom_water_wake. */
extern const lom_key_table lom_water_wake_keys;
/* [shallow]: lom_shallow_water. */
extern const lom_key_table lom_shallow_keys;

#endif
