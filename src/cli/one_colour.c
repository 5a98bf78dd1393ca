/* Pictures that show nothing. In: a picture. Out: whether it is one single colour, bit for bit. Invariant: the picture is
 * only read. */
#include "one_colour.h"

#include <string.h>

bool lom_is_one_colour(const lom_image *image)
{
    size_t size = lom_format_size(image->format), count = lom_image_size(image) / size;
    bool same = count > 1;
    for (size_t i = 1; i < count && same; i++)
        same = memcmp(image->pixels, image->pixels + i * size, size) == 0;
    return same;
}
