/* Rows of pixels of any format from and to four doubles a pixel (convert_rows.c). */
#ifndef LOM_IMAGE_CONVERT_ROWS_H
#define LOM_IMAGE_CONVERT_ROWS_H

#include <lom/image.h>

/* count pixels at from; missing channels 0, missing alpha 1; sRGB colour decoded to linear light. */
void lom_decode_row(lom_format format, const void *from, size_t count, double (*rgba)[4]);
/* The first channels of each pixel, rounded once to the format; NaN becomes 0 in unorm and depth formats and the one
 * quiet NaN (sign clear) in float formats. */
void lom_encode_row(lom_format format, const double (*rgba)[4], size_t count, void *to);

#endif
