/* What is left out of a comparison: rectangles of pixels, and the black pixels of a mask. */
#ifndef LOM_CLI_COMPARE_IGNORE_H
#define LOM_CLI_COMPARE_IGNORE_H

#include "options.h"

#include <lom/image.h>

/* Makes both pictures white and opaque in each of the rectangles "X,Y,W,H" (cut to the pictures) and, unless mask is
 * NULL, where the picture of that file is black. Pictures of different sizes are left as they are: they differ anyway.
 * False for words that are no rectangles of whole numbers, a rectangle without a pixel of the pictures, and a mask of
 * another size. */
bool lom_ignore_pixels(lom_image *const pictures[2], const lom_option_list *rectangles, const char *mask,
                       lom_error *error);

#endif
