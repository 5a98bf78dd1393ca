/* The pattern of foam, made when a scene is loaded. */
#ifndef LOM_SPRAY_MAKE_FOAM_H
#define LOM_SPRAY_MAKE_FOAM_H

#include <lom/image.h>

/* size x size, R8; NULL on failure. Freed with lom_free_image. */
lom_image *lom_make_foam(int size, uint64_t seed, lom_error *error);

#endif
