/* Any bytes as an NRRD volume, and as raw voxels of some size: no crash; what is read can be written and read again to
 * the same voxels, and is marched without a crash. */
#include "again.h"

#include <lom/march.h>

#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size > 1 << 16)
        return 0;
    lom_error error = { 0 };
    bool is_raw = size < 4 || memcmp(data, "NRRD", 4) != 0;
    lom_image *image = is_raw ? lom_decode_raw_volume(data, size, (int)(size % 7), (int)(size % 5), 3, "fuzz", &error)
                              : lom_decode_image(data, size, "fuzz", &error);
    if (image != NULL && lom_image_size(image) < 1 << 18)
        lom_free_medium(lom_create_medium(image, NULL));
    check_and_free(image, &error, "nrrd");
    return 0;
}
