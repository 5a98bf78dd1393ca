/* The table of the scene file's [water] keys; it fills a lom_water_params. */
#ifndef LOM_WATER_KEYS_H
#define LOM_WATER_KEYS_H

#include "base/keys.h"

extern const lom_key_table lom_water_keys;
/* The tables inside it. */
extern const lom_key_table lom_water_waves_keys, lom_water_optics_keys, lom_water_foam_keys;
/* [surf]: lom_water_surf. */
extern const lom_key_table lom_water_surf_keys;
/* [shallow]: lom_shallow_water. */
extern const lom_key_table lom_shallow_keys;
/* [[spray]]: lom_spray of lom/particles.h. */
extern const lom_key_table lom_spray_keys;

#endif
