/* A picture of the differences. In: two images of any sizes. Out: an image as large as both. Invariant: a pixel is
 * black where both are equal, at least 64 in a channel where they differ, and OUTSIDE, which is neither, where one has
 * none. Compiled for speed. */
#include "base/numbers.h"
#include "compare.h"

#include <string.h>

enum { OUTSIDE = 32 };

/* The least difference can be seen by the square root; what has no difference is the largest, but for two NaN. */
static uint8_t shade(double a, double b, double peak)
{
    double delta = lom_sample_delta(a, b) / peak;
    if (delta == 0)
        return 0;
    return (uint8_t)lom_count_of(64 + 191 * __builtin_sqrt(delta < 1 ? delta : 1) + 0.5, 255);
}

static void shade_pixel(const lom_common_format *common, const double *a, const double *b, uint8_t out[3])
{
    uint8_t alpha = common->channels > common->colors ? shade(a[common->colors], b[common->colors], common->peak) : 0;
    for (int c = 0; c < 3; c++) {
        int at = common->colors == 3 ? c : 0;
        uint8_t color = shade(a[at], b[at], common->peak);
        out[c] = color > alpha ? color : alpha;
    }
}

lom_image *lom_compare_picture(const lom_image *a, const lom_image *b, lom_error *error)
{
    lom_common_format common;
    if (!lom_find_common_format(a, b, &common, error))
        return NULL;
    int width = a->width < b->width ? a->width : b->width, height = a->height < b->height ? a->height : b->height;
    size_t row_a = (size_t)a->width * (size_t)common.channels, row_b = (size_t)b->width * (size_t)common.channels;
    double *rows = lom_allocate(row_a + row_b, sizeof *rows, error);
    lom_image *picture =
        rows == NULL ? NULL
                     : lom_create_image(lom_larger_int(a->width, b->width), lom_larger_int(a->height, b->height),
                                        lom_larger_int(a->depth, b->depth), LOM_FORMAT_RGB8, error);
    if (picture == NULL) {
        lom_release(rows);
        return NULL;
    }
    lom_float_state state;
    lom_enter_float_state(&state);
    memset(picture->pixels, OUTSIDE, lom_image_size(picture));
    for (int z = 0; z < a->depth && z < b->depth; z++)
        for (int y = 0; y < height; y++) {
            lom_read_common_row(a, &common, y, z, rows);
            lom_read_common_row(b, &common, y, z, rows + row_a);
            uint8_t *out = lom_image_pixel(picture, 0, y, z);
            for (size_t x = 0, at = 0; x < (size_t)width; x++, at += (size_t)common.channels)
                shade_pixel(&common, rows + at, rows + row_a + at, out + 3 * x);
        }
    lom_leave_float_state(&state);
    lom_release(rows);
    return picture;
}
