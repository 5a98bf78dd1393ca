/* Pictures of declared codings. In: what a header says, and bytes. Out: an image and its smaller levels. Invariant:
 * nothing is allocated before the declared sizes are known to fit the limits and the bytes that are there. */
#include "coded_picture.h"

#include "bytes.h"

#include <string.h>

static int half_of(uint64_t size, int level)
{
    return size >> level > 1 ? (int)(size >> level) : 1;
}

int lom_coded_slices(const lom_coded_picture *p, int level)
{
    return p->slices == LOM_SLICES_VOLUME ? half_of(p->depth, level) : (int)p->depth;
}

/* Blocks along a side of so many texels. */
static uint64_t blocks_of(const lom_coded_picture *p, int texels)
{
    return ((uint64_t)texels + (uint64_t)p->coding.side - 1) / (uint64_t)p->coding.side;
}

static uint64_t row_bytes(const lom_coded_picture *p, int level)
{
    uint64_t bytes = blocks_of(p, half_of(p->width, level)) * (uint64_t)p->coding.size;
    return (bytes + p->row_unit - 1) / p->row_unit * p->row_unit;
}

uint64_t lom_coded_slice_bytes(const lom_coded_picture *p, int level)
{
    return row_bytes(p, level) * blocks_of(p, half_of(p->height, level)); /* below 2^15 * 2^15 * 2^4 */
}

/* With 2^15 slices and 16 levels below 2^54. */
uint64_t lom_coded_offset(const lom_coded_picture *p, int level, int slice)
{
    uint64_t before = p->by_slice ? 0 : p->before_level, chain = 0;
    for (int i = 0; i < (int)p->levels; i++) {
        uint64_t bytes = lom_coded_slice_bytes(p, i);
        chain += bytes;
        if (i < level)
            before += p->by_slice ? bytes : p->before_level + bytes * (uint64_t)lom_coded_slices(p, i);
    }
    return before + (uint64_t)slice * (p->by_slice ? chain : lom_coded_slice_bytes(p, level));
}

bool lom_check_coded_picture(const lom_coded_picture *p, lom_error *error)
{
    if (p->width == 0 || p->height == 0 || p->depth == 0)
        return lom_fail(error, LOM_ERROR_INPUT, "%s: the header declares an empty picture.", p->name);
    if (p->width > LOM_MAX_SIZE || p->height > LOM_MAX_SIZE || p->depth > LOM_MAX_SIZE)
        return lom_fail(error, LOM_ERROR_LIMIT, "%s: the header declares more than %d pixels a side.", p->name,
                        LOM_MAX_SIZE);
    if (p->slices == LOM_SLICES_CUBE && p->width != p->height)
        return lom_fail(error, LOM_ERROR_INPUT, "%s: the header declares a cube whose faces are %d x %d pixels.",
                        p->name, (int)p->width, (int)p->height);
    uint64_t largest = p->width > p->height ? p->width : p->height;
    if (p->slices == LOM_SLICES_VOLUME && p->depth > largest)
        largest = p->depth;
    if (p->levels == 0 || p->levels > 16 || largest >> (p->levels - 1) == 0)
        return lom_fail(error, LOM_ERROR_INPUT,
                        "%s: the header declares %.0f levels, which a picture of %d x %d pixels "
                        "does not have.",
                        p->name, (double)p->levels, (int)p->width, (int)p->height);
    int last_level = p->by_slice ? 0 : (int)p->levels - 1;
    uint64_t needed = lom_coded_offset(p, last_level, p->by_slice ? (int)p->depth : lom_coded_slices(p, last_level));
    if (p->start > p->size || needed > p->size - p->start)
        return lom_fail(error, LOM_ERROR_INPUT,
                        "%s: the header declares %d x %d pixels, which the file is too short for.", p->name,
                        (int)p->width, (int)p->height);
    return true;
}

/* ---- texels ---- */

static void read_masked(const lom_texel_coding *coding, int channels, const uint8_t *from, int width, uint8_t *to)
{
    for (int x = 0; x < width; x++, from += coding->size) {
        uint32_t texel = 0;
        for (int b = 0; b < coding->size; b++)
            texel |= (uint32_t)from[b] << 8 * b;
        for (int c = 0; c < channels; c++) {
            uint32_t lowest = coding->mask[c] & -coding->mask[c];
            uint32_t most = lowest == 0 ? 1 : coding->mask[c] / lowest; /* at most 255 */
            uint32_t code = lowest == 0 ? 0 : (texel & coding->mask[c]) / lowest;
            *to++ = (uint8_t)((2 * 255 * code + most) / (2 * most));
        }
    }
}

static void read_samples(const lom_format_info *info, bool is_big, const uint8_t *from, int width, uint8_t *to)
{
    int bytes = info->bits / 8;
    for (int i = 0; i < width * info->channels; i++, from += bytes, to += bytes) {
        uint32_t sample = 0;
        for (int b = 0; b < bytes; b++)
            sample |= (uint32_t)from[b] << 8 * (is_big ? bytes - 1 - b : b);
        if (bytes == 1)
            *to = (uint8_t)sample;
        else if (bytes == 2)
            memcpy(to, &(uint16_t){ (uint16_t)sample }, 2);
        else
            memcpy(to, &sample, 4);
    }
}

/* The texels of a block that lie within the picture. */
static void read_block(const lom_coded_picture *p, const uint8_t *block, int x, int y, int slice, lom_image *image)
{
    float texels[16 * 2]; /* 16 texels of at most 8 bytes */
    size_t size = lom_format_size(image->format);
    p->coding.decode(block, texels);
    int columns = image->width - x < 4 ? image->width - x : 4;
    for (int row = 0; row < 4 && y + row < image->height; row++) {
        int to = p->from_below ? image->height - 1 - y - row : y + row;
        memcpy(lom_image_pixel(image, x, to, slice), (const uint8_t *)texels + (size_t)row * 4 * size,
               (size_t)columns * size);
    }
}

static void read_slice(const lom_coded_picture *p, int level, int slice, lom_image *image)
{
    const lom_format_info *info = lom_describe_format(image->format);
    const lom_texel_coding *coding = &p->coding;
    bool masked = (coding->mask[0] | coding->mask[1] | coding->mask[2] | coding->mask[3]) != 0;
    const uint8_t *from = p->data + p->start + lom_coded_offset(p, level, slice);
    for (int y = 0; y < image->height; y += coding->side, from += row_bytes(p, level)) {
        uint8_t *to = lom_image_pixel(image, 0, p->from_below ? image->height - 1 - y : y, slice);
        if (coding->decode != NULL)
            for (int x = 0; x < image->width; x += 4)
                read_block(p, from + (size_t)(x / 4) * (size_t)coding->size, x, y, slice, image);
        else if (masked)
            read_masked(coding, info->channels, from, image->width, to);
        else
            read_samples(info, p->is_big, from, image->width, to);
    }
}

lom_image *lom_read_coded_picture(const lom_coded_picture *p, lom_error *error)
{
    lom_image *first = NULL, **next = &first;
    for (int level = 0; level < (int)p->levels; level++, next = &(*next)->smaller) {
        *next = lom_create_image(half_of(p->width, level), half_of(p->height, level), lom_coded_slices(p, level),
                                 p->coding.format, error);
        if (*next == NULL) {
            lom_free_image(first);
            return NULL;
        }
        (*next)->slices = p->slices;
        for (int slice = 0; slice < (*next)->depth; slice++)
            read_slice(p, level, slice, *next);
    }
    return first;
}
