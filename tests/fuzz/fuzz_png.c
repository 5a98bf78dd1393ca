/* Any bytes as a PNG: no crash; what is read can be written and read again to the same pixels. The CRCs are made right
 * first, and the signature put in front, so that the fuzzer gets behind them. */
#include "again.h"

#include "image/bytes.h"
#include "image/zip.h"

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void mend(uint8_t *png, size_t size)
{
    memcpy(png, "\x89PNG\r\n\x1a\n", 8);
    for (size_t at = 8; size - at >= 12;) {
        size_t length = load_32_big(png + at);
        if (length > size - at - 12)
            return;
        store_32_big(png + at + 8 + length, lom_crc32(0, png + at + 4, length + 4));
        at += 12 + length;
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size < 8 || size > 1 << 16)
        return 0;
    uint8_t *png = malloc(size);
    memcpy(png, data, size);
    mend(png, size);
    lom_error error = { 0 };
    lom_image *image = lom_decode_image(png, size, "fuzz", &error);
    check_and_free(image, &error, "png");
    free(png);
    return 0;
}
