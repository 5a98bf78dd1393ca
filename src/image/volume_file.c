/* Volumes of density from users' files. In: NRRD, or raw samples and their size. Out: one channel of 8 or 16 bits or
 * floats. Invariant: a raw file has exactly the bytes of its size, at 1, 2 or 4 bytes a voxel. */
#include "codec.h"

#include "bytes.h"
#include "foreign.h"

#include <string.h>

static const size_t most_file = (size_t)1 << 31;

lom_image *lom_decode_raw_volume(const uint8_t *data, size_t size, int width, int height, int depth, const char *name,
                                 lom_error *error)
{
    if (width < 1 || height < 1 || depth < 1 || width > LOM_MAX_SIZE || height > LOM_MAX_SIZE || depth > LOM_MAX_SIZE) {
        lom_fail(error, LOM_ERROR_USAGE, "%s: raw voxels need a size of 1 to %d a side.", name, LOM_MAX_SIZE);
        return NULL;
    }
    uint64_t voxels = (uint64_t)width * (uint64_t)height * (uint64_t)depth;
    int bytes = size == voxels ? 1 : size == 2 * voxels ? 2 : size == 4 * voxels ? 4 : 0;
    if (bytes == 0) {
        lom_fail(error, LOM_ERROR_INPUT,
                 "%s: %d x %d x %d voxels are %llu bytes, or twice or four times that, but the file has %zu.", name,
                 width, height, depth, (unsigned long long)voxels, size);
        return NULL;
    }
    static const lom_format formats[5] = { [1] = LOM_FORMAT_R8, [2] = LOM_FORMAT_R16, [4] = LOM_FORMAT_R32F };
    lom_image *image = lom_create_image(width, height, depth, formats[bytes], error);
    for (uint64_t i = 0; image != NULL && i < voxels; i++, data += bytes) {
        if (bytes == 1)
            image->pixels[i] = data[0];
        else if (bytes == 2)
            ((uint16_t *)image->pixels)[i] = (uint16_t)(data[0] | data[1] << 8);
        else {
            uint32_t word = load_32_little(data);
            float value;
            memcpy(&value, &word, sizeof value);
            if (value != value) {
                lom_fail(error, LOM_ERROR_INPUT, "%s: voxel %llu is NaN, which is no density.", name,
                         (unsigned long long)i);
                lom_free_image(image);
                return NULL;
            }
            ((float *)(void *)image->pixels)[i] = value;
        }
    }
    return image;
}

/* Of colours and density, the density; of one channel, itself. */
static lom_image *density_of(lom_image *image, const char *name, lom_error *error)
{
    const lom_format_info *info = lom_describe_format(image->format);
    if (info->channels == 1)
        return image;
    size_t bytes = (size_t)info->bits / 8, pixel = lom_format_size(image->format);
    lom_image *alone = NULL;
    if (info->channels != 2 && info->channels != 4)
        lom_fail(error, LOM_ERROR_INPUT, "%s: a volume of %d channels has no density among them.", name,
                 info->channels);
    else
        alone = lom_create_image(image->width, image->height, image->depth,
                                 info->is_float ? LOM_FORMAT_R32F : lom_unorm_format(1, info->bits), error);
    for (size_t i = 0; alone != NULL && i < lom_image_size(image) / pixel; i++)
        memcpy(alone->pixels + i * bytes, image->pixels + (i + 1) * pixel - bytes, bytes);
    lom_free_image(image);
    return alone;
}

lom_image *lom_read_volume(const char *path, const int size[3], lom_error *error)
{
    lom_bytes file = lom_read_file(path, most_file, error);
    if (file.data == NULL)
        return NULL;
    lom_image *image;
    const lom_codec_info *codec = lom_recognize_codec(file.data, file.size);
    if (codec != NULL && codec->holds_slices)
        image = lom_decode_image(file.data, file.size, path, error);
    else if (size != NULL && size[0] > 0)
        image = lom_decode_raw_volume(file.data, file.size, size[0], size[1], size[2], path, error);
    else {
        lom_fail(error, LOM_ERROR_INPUT, "%s: this is no NRRD file, and raw voxels need their size%s.", path,
                 lom_foreign_kind(file.data, file.size, path));
        image = NULL;
    }
    lom_release(file.data);
    return image != NULL ? density_of(image, path, error) : NULL;
}
