/* What the targets of DDS and KTX do with the answer: a picture or an error, and a texture of it and of its levels, and
 * what is written of it as DDS is read again to the same samples. */
#ifndef LOM_TESTS_FUZZ_CODED_H
#define LOM_TESTS_FUZZ_CODED_H

#include <lom/texture.h>

#include <stdlib.h>

static inline void use_and_free(lom_image *image, const lom_error *error)
{
    if ((image == NULL) != (error->code != LOM_OK))
        abort();
    if (image != NULL && lom_image_size(image) < 1 << 20) {
        lom_error failure = { 0 };
        lom_texture *texture = lom_texture_of_image(image, true, LOM_MIPS_ALL, &failure);
        lom_image *back = texture != NULL ? lom_read_texture(texture, 0, -1, &failure) : NULL;
        if (back == NULL || back->width != image->width || back->depth != image->depth)
            abort();
        lom_free_image(back);
        lom_free_texture(texture);
        lom_bytes file = lom_encode_image("dds", image, &failure); /* three channels become four */
        back = lom_decode_image(file.data, file.size, "again", &failure);
        if (back == NULL || lom_image_levels(back) != lom_image_levels(image) ||
            (lom_describe_format(image->format)->channels != 3 && lom_hash_image(back) != lom_hash_image(image)))
            abort();
        lom_free_image(back);
        lom_release(file.data);
    }
    lom_free_image(image);
}

#endif
