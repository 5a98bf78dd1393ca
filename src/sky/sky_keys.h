/* The table of the scene file's [sky] keys; it fills a lom_sky_params. */
#ifndef LOM_SKY_SKY_KEYS_H
#define LOM_SKY_SKY_KEYS_H

#include "base/keys.h"

extern const lom_key_table lom_sky_keys;

#endif
