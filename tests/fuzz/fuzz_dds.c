/* Any bytes as DDS, after its signature: no crash; what is read makes a texture with its levels. */
#include "coded.h"

#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size < 4 || size > 1 << 16 || memcmp(data, "DDS ", 4) != 0)
        return 0;
    lom_error error = { 0 };
    use_and_free(lom_decode_image(data, size, "fuzz", &error), &error);
    return 0;
}
