/* NRRD files (teem.sourceforge.net/nrrd/format.html): nearly raw rasters, with their data in the same file. In: a
 * header (nrrd_header.c), lines and bytes to skip, then samples, raw or gzip. Out: an image with depth: axes in the
 * order x, y, z, after an axis of channels where there is one (nrrd_axes.c). Invariant: nothing is allocated before the
 * declared sizes are known to fit the limits and the bytes that are there; no sample of the result is NaN. */
#include "codec.h"

#include "nrrd_header.h"
#include "zip.h"

#include <string.h>

static const uint64_t most_bytes = UINT64_C(1) << 31;

/* The lines to skip are lines of the file, before whatever compressed it. */
static bool skip_lines(const nrrd_header *h, const uint8_t *data, size_t size, size_t *at)
{
    for (uint64_t i = 0; i < h->line_skip; i++) {
        const uint8_t *newline = *at < size ? memchr(data + *at, '\n', size - *at) : NULL;
        if (newline == NULL)
            return lom_fail(h->error, LOM_ERROR_INPUT, "%s: the file ends in the lines that are to be skipped.",
                            h->name);
        *at = (size_t)(newline - data) + 1;
    }
    return true;
}

/* The bytes of all samples, known to fit the limit and what the file can hold; 0 after a failure. */
static uint64_t count_bytes(const nrrd_header *h, const nrrd_layout *l, uint64_t available)
{
    uint64_t samples = (uint64_t)l->channels * (uint64_t)l->width * (uint64_t)l->height * (uint64_t)l->depth;
    uint64_t bytes = samples * (uint64_t)h->bytes; /* below 2^3 * 2^2 * 2^45 */
    if (bytes > most_bytes) {
        lom_fail(h->error, LOM_ERROR_LIMIT, "%s: the header declares a volume of %.3g bytes, above the limit of 2^31.",
                 h->name, (double)bytes);
        return 0;
    }
    if (h->byte_skip > most_bytes || bytes + h->byte_skip > available * (h->is_gzip ? LOM_INFLATE_RATIO : 1)) {
        lom_fail(h->error, LOM_ERROR_INPUT,
                 "%s: the header declares %d x %d x %d voxels, which the file is too short for.", h->name, l->width,
                 l->height, l->depth);
        return 0;
    }
    return bytes;
}

static float to_float(uint64_t bits, int bytes)
{
    if (bytes == 4) {
        uint32_t word = (uint32_t)bits;
        float value;
        memcpy(&value, &word, sizeof value);
        return value;
    }
    double wide;
    memcpy(&wide, &bits, sizeof wide);
    return (float)wide;
}

static bool store_samples(const nrrd_header *h, uint64_t count, const uint8_t *from, lom_image *image)
{
    for (uint64_t i = 0; i < count; i++, from += h->bytes) {
        uint64_t bits = 0;
        for (int b = 0; b < h->bytes; b++)
            bits |= (uint64_t)from[b] << 8 * (h->is_big ? h->bytes - 1 - b : b);
        if (h->bytes == 1)
            image->pixels[i] = (uint8_t)bits;
        else if (h->bytes == 2)
            ((uint16_t *)image->pixels)[i] = (uint16_t)bits;
        else {
            float value = to_float(bits, h->bytes);
            if (value != value)
                return lom_fail(h->error, LOM_ERROR_INPUT, "%s: sample %llu is NaN, which is no density.", h->name,
                                (unsigned long long)i);
            ((float *)(void *)image->pixels)[i] = value;
        }
    }
    return true;
}

static lom_format format_of(const nrrd_header *h, int channels)
{
    if (h->is_float)
        return (lom_format)(LOM_FORMAT_R32F + channels - 1);
    return lom_unorm_format(channels, 8 * h->bytes);
}

lom_image *lom_decode_nrrd(const uint8_t *data, size_t size, const char *name, lom_error *error)
{
    nrrd_header h = { .name = name, .error = error };
    nrrd_layout l;
    size_t at = 0;
    if (!lom_read_nrrd_header(&h, data, size, &at) || !lom_find_nrrd_layout(&h, &l) || !skip_lines(&h, data, size, &at))
        return NULL;
    uint64_t available = size - at, bytes = count_bytes(&h, &l, available);
    if (bytes == 0)
        return NULL;
    const uint8_t *samples = data + at;
    lom_bytes inflated = { 0 };
    if (h.is_gzip) {
        inflated = lom_inflate_gzip(name, data + at, size - at, (size_t)(bytes + h.byte_skip), error);
        if (inflated.data == NULL)
            return NULL;
        samples = inflated.data;
        available = inflated.size;
    }
    lom_image *image = NULL;
    if (available < bytes + h.byte_skip)
        lom_fail(error, LOM_ERROR_INPUT, "%s: the volume has %llu bytes of samples instead of %llu.", name,
                 (unsigned long long)available, (unsigned long long)(bytes + h.byte_skip));
    else
        image = lom_create_image(l.width, l.height, l.depth, format_of(&h, l.channels), error);
    uint64_t first = h.at_end ? available - bytes : h.byte_skip;
    if (image != NULL && !store_samples(&h, bytes / (uint64_t)h.bytes, samples + first, image)) {
        lom_free_image(image);
        image = NULL;
    }
    lom_release(inflated.data);
    return image;
}
