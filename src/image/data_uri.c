/* Pictures within a page. In: a picture. Out: text of letters that need no escape in HTML, an attribute of it, JSON or
 * XML. Invariant: four letters stand for three bytes, and the last ones are filled up with "=". */
#include "data_uri.h"

lom_bytes lom_encode_shown_image(const lom_image *image, lom_error *error)
{
    if (!lom_describe_format(image->format)->is_float)
        return lom_encode_image("png", image, error);
    lom_image *shown = lom_convert_image(image, LOM_FORMAT_RGB8_SRGB, error);
    lom_bytes png = shown != NULL ? lom_encode_image("png", shown, error) : (lom_bytes){ NULL, 0 };
    lom_free_image(shown);
    return png;
}

void lom_print_data_uri(FILE *out, lom_bytes png)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    fputs("data:image/png;base64,", out);
    for (size_t i = 0; i < png.size; i += 3) {
        uint32_t bits = 0;
        size_t count = png.size - i < 3 ? png.size - i : 3;
        for (size_t k = 0; k < 3; k++)
            bits = bits << 8 | (k < count ? png.data[i + k] : 0);
        for (size_t k = 0; k < 4; k++)
            fputc(k <= count ? digits[bits >> (18 - 6 * k) & 63] : '=', out);
    }
}
