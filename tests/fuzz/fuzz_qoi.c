/* Any bytes as QOI, after its signature: no crash; what is read is written and read again to the same pixels. */
#include <lom/image.h>

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size < 4 || size > 1 << 16 || memcmp(data, "qoif", 4) != 0)
        return 0;
    lom_error error = { 0 };
    lom_image *image = lom_decode_image(data, size, "fuzz", &error);
    if ((image == NULL) != (error.code != LOM_OK))
        abort();
    if (image != NULL && lom_image_size(image) < 1 << 20) {
        lom_bytes file = lom_encode_image("qoi", image, &error);
        lom_image *back = lom_decode_image(file.data, file.size, "fuzz", &error);
        if (back == NULL || lom_hash_image(back) != lom_hash_image(image))
            abort();
        lom_free_image(back);
        lom_release(file.data);
    }
    lom_free_image(image);
    return 0;
}
