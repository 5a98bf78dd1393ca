/* Normal maps of heights. In: a picture whose red is a height, which repeats. Out: normals, red to the right, green up the
 * picture, blue off the surface, as n / 2 + 1/2 in 16 bits. */
#include "base/numbers.h"
#include "world/materials.h"

#include <string.h>

bool lom_is_grey(const lom_image *image, lom_error *error)
{
    if (lom_describe_format(image->format)->channels < 3)
        return true;
    lom_image *bytes = lom_convert_image(image, LOM_FORMAT_RGBA8, error);
    bool grey = bytes != NULL;
    for (size_t i = 0; grey && i + 3 < lom_image_size(bytes); i += 4)
        grey = bytes->pixels[i] == bytes->pixels[i + 1] && bytes->pixels[i] == bytes->pixels[i + 2];
    lom_free_image(bytes);
    return grey;
}

static double height_at(const lom_image *image, int x, int y)
{
    uint16_t red;
    const int column = (x + image->width) % image->width, row = (y + image->height) % image->height;
    memcpy(&red, lom_image_pixel(image, column, row, 0), sizeof red);
    return red / 65535.0;
}

static uint16_t stored(double n)
{
    return (uint16_t)lom_int_of((n / 2 + 0.5) * 65535 + 0.5);
}

/* The slopes by central differences over two texels, which are squares of 1 / width of the picture's width. */
static void put_normal(const lom_image *from, lom_image *to, int x, int y, double scale)
{
    const double right = (height_at(from, x + 1, y) - height_at(from, x - 1, y)) * scale;
    const double up = (height_at(from, x, y - 1) - height_at(from, x, y + 1)) * scale;
    const double inverse = 1 / lom_double_sqrt(right * right + up * up + 1);
    const uint16_t texel[4] = { stored(-right * inverse), stored(-up * inverse), stored(inverse), 65535 };
    memcpy(lom_image_pixel(to, x, y, 0), texel, sizeof texel);
}

lom_image *lom_normals_of_heights(const lom_image *heights, float bump, lom_error *error)
{
    lom_image *from = lom_convert_image(heights, LOM_FORMAT_RGBA16, error);
    lom_image *to = from == NULL ? NULL : lom_create_image(from->width, from->height, 1, LOM_FORMAT_RGBA16, error);
    for (int y = 0; to != NULL && y < to->height; y++)
        for (int x = 0; x < to->width; x++)
            put_normal(from, to, x, y, (double)bump / 64 * to->width / 2);
    lom_free_image(from);
    return to;
}
