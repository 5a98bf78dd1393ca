/* Pictures within a page that needs no other file. */
#ifndef LOM_IMAGE_DATA_URI_H
#define LOM_IMAGE_DATA_URI_H

#include <lom/image.h>

#include <stdio.h>

/* PNG of a picture as browsers show it: 8 and 16 bits as they are, floats as linear light in 8 bits of sRGB. Freed with
 * lom_release; data NULL on failure. */
lom_bytes lom_encode_shown_image(const lom_image *image, lom_error *error);

/* "data:image/png;base64," and the bytes (RFC 2397; RFC 4648, section 4): a value of src, without quotes around it. */
void lom_print_data_uri(FILE *out, lom_bytes png);

#endif
