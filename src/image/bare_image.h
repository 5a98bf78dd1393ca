/* Images all of whose pixels are about to be written. */
#ifndef LOM_IMAGE_BARE_IMAGE_H
#define LOM_IMAGE_BARE_IMAGE_H

#include <lom/image.h>

/* lom_create_image, but its pixels are what was in memory: who writes them first, not who asks for them, is the one for whom the
 * system finds the memory. */
lom_image *lom_create_bare_image(int width, int height, int depth, lom_format format, lom_error *error);

#endif
