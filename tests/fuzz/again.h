/* What the targets of picture formats do with the answer: a picture or an error, and what is written of a picture is
 * read again to the same samples. Frees the picture. */
#ifndef LOM_TESTS_FUZZ_AGAIN_H
#define LOM_TESTS_FUZZ_AGAIN_H

#include <lom/image.h>

#include <stdlib.h>

static inline void check_and_free(lom_image *image, const lom_error *error, const char *kind)
{
    if ((image == NULL) != (error->code != LOM_OK))
        abort();
    if (image != NULL && lom_image_size(image) < 1 << 20) {
        lom_error failure = { 0 };
        lom_bytes file = lom_encode_image(kind, image, &failure);
        lom_image *back = lom_decode_image(file.data, file.size, "again", &failure);
        if (back == NULL || lom_hash_image(back) != lom_hash_image(image))
            abort();
        lom_free_image(back);
        lom_release(file.data);
    }
    lom_free_image(image);
}

#endif
