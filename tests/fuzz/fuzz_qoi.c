/* Any bytes as QOI, after its signature: no crash; what is read is written and read again to the same pixels. */
#include "again.h"

#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size < 4 || size > 1 << 16 || memcmp(data, "qoif", 4) != 0)
        return 0;
    lom_error error = { 0 };
    lom_image *image = lom_decode_image(data, size, "fuzz", &error);
    check_and_free(image, &error, "qoi");
    return 0;
}
