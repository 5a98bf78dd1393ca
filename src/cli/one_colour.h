/* Pictures that show nothing. */
#ifndef LOM_CLI_ONE_COLOUR_H
#define LOM_CLI_ONE_COLOUR_H

#include <lom/image.h>

/* Whether all pixels are the same, and there are several. */
bool lom_is_one_colour(const lom_image *image);

#endif
