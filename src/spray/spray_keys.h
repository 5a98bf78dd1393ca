/* The table of the scene file's [[spray]] keys; it fills a lom_spray of lom/particles.h. */
#ifndef LOM_SPRAY_SPRAY_KEYS_H
#define LOM_SPRAY_SPRAY_KEYS_H

#include "base/keys.h"

extern const lom_key_table lom_spray_keys;

#endif
