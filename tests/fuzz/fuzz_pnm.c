/* Any bytes as PNM, PAM or PFM: no crash; what is read can be written and read again to the same pixels. */
#include "again.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size > 1 << 16 || (size > 0 && data[0] != 'P'))
        return 0;
    lom_error error = { 0 };
    lom_image *image = lom_decode_image(data, size, "fuzz", &error);
    bool is_float = image != NULL && lom_describe_format(image->format)->is_float;
    check_and_free(image, &error, is_float ? "pfm" : "pam");
    return 0;
}
