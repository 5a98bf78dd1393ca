/* What is left out of a comparison. In: two pictures of one size. Out: the same, white where nobody is to look.
 * Invariant: white is 1 in every channel of every format, alpha included, so that the pictures are equal there in
 * whichever format they are compared, and no measure that looks around a pixel sees an edge that only one of them has. */
#include "compare_ignore.h"

#include <string.h>

/* The bytes of a white pixel of a format: what a picture of one is converted to. */
static bool find_white(lom_format format, uint8_t bytes[16], lom_error *error)
{
    lom_image *one = lom_create_image(1, 1, 1, LOM_FORMAT_RGBA8, error);
    if (one == NULL)
        return false;
    memset(one->pixels, 255, lom_image_size(one));
    lom_image *white = lom_convert_image(one, format, error);
    if (white != NULL)
        memcpy(bytes, white->pixels, lom_image_size(white));
    lom_free_image(white);
    lom_free_image(one);
    return white != NULL;
}

/* Pixels that are ignored are written with the picture's own white. */
struct whites {
    lom_image *const *pictures;
    uint8_t bytes[2][16];
};

static void whiten(const struct whites *whites, int x, int y, int z)
{
    for (int i = 0; i < 2; i++)
        memcpy(lom_image_pixel(whites->pictures[i], x, y, z), whites->bytes[i],
               lom_format_size(whites->pictures[i]->format));
}

static int64_t clamped(int64_t value, int64_t most)
{
    return value < 0 ? 0 : value > most ? most : value;
}

static bool ignore_rectangle(const struct whites *whites, const char *word, lom_error *error)
{
    const lom_image *picture = whites->pictures[0];
    int64_t rect[4];
    if (lom_match_integers("X,Y,W,H", word, rect) == 0 || rect[2] <= 0 || rect[3] <= 0)
        return lom_fail(error, LOM_ERROR_USAGE,
                        "compare: --ignore takes X,Y,W,H in whole numbers with W and H above 0, not \"%s\".", word);
    int64_t x0 = clamped(rect[0], picture->width), x1 = clamped(rect[0] + rect[2], picture->width);
    int64_t y0 = clamped(rect[1], picture->height), y1 = clamped(rect[1] + rect[3], picture->height);
    if (x0 == x1 || y0 == y1)
        return lom_fail(error, LOM_ERROR_USAGE, "compare: --ignore %s has no pixel of the pictures, which are %d x %d.",
                        word, picture->width, picture->height);
    for (int z = 0; z < picture->depth; z++)
        for (int64_t y = y0; y < y1; y++)
            for (int64_t x = x0; x < x1; x++)
                whiten(whites, (int)x, (int)y, z);
    return true;
}

/* Luminance is 0 where all colours are, and nowhere else. */
static bool ignore_black(const struct whites *whites, const char *path, lom_error *error)
{
    const lom_image *picture = whites->pictures[0];
    lom_image *mask = lom_read_image(path, error);
    lom_image *light = mask != NULL ? lom_convert_image(mask, LOM_FORMAT_R32F, error) : NULL;
    bool same = light != NULL && light->width == picture->width && light->height == picture->height &&
                (light->depth == 1 || light->depth == picture->depth);
    if (light != NULL && !same)
        lom_fail(error, LOM_ERROR_USAGE, "compare: the mask %s is %d x %d and the pictures are %d x %d.", path,
                 light->width, light->height, picture->width, picture->height);
    for (int z = 0; same && z < picture->depth; z++)
        for (int y = 0; y < picture->height; y++) {
            const float *row = lom_image_pixel(light, 0, y, light->depth == 1 ? 0 : z);
            for (int x = 0; x < picture->width; x++)
                if (row[x] == 0)
                    whiten(whites, x, y, z);
        }
    lom_free_image(light);
    lom_free_image(mask);
    return same;
}

bool lom_ignore_pixels(lom_image *const pictures[2], const lom_option_list *rectangles, const char *mask,
                       lom_error *error)
{
    const lom_image *a = pictures[0], *b = pictures[1];
    if (a->width != b->width || a->height != b->height || a->depth != b->depth)
        return true;
    struct whites whites = { .pictures = pictures };
    for (int i = 0; i < 2; i++)
        if (!find_white(pictures[i]->format, whites.bytes[i], error))
            return false;
    for (int i = 0; i < rectangles->count; i++)
        if (!ignore_rectangle(&whites, rectangles->items[i], error))
            return false;
    return mask == NULL || ignore_black(&whites, mask, error);
}
