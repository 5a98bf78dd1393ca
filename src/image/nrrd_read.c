/* NRRD files (teem.sourceforge.net/nrrd/format.html): nearly raw rasters, with their data in the same file. In: a
 * header of lines "field: value" up to an empty line, then samples, raw or gzip. Out: an image with depth: axes in the
 * order x, y, z, after an axis of channels where there is one. Invariant: nothing is allocated before the declared
 * sizes are known to fit the limits and the bytes that are there; no sample of the result is NaN. */
#include "codec.h"

#include "bytes.h"
#include "zip.h"

#include <string.h>

enum { MOST_DIMENSIONS = 4 };
static const uint64_t most_bytes = UINT64_C(1) << 31;

typedef struct header {
    const char *name;
    lom_error *error;
    int line;
    int dimensions;
    uint64_t sizes[MOST_DIMENSIONS];
    int size_count;
    int bytes; /* of a sample; 0: not given */
    bool is_float, is_big, has_endian, has_encoding, is_gzip, channels_first;
} header;

static bool bad_line(const header *h, const char *what)
{
    return lom_fail(h->error, LOM_ERROR_INPUT, "%s: line %d of the NRRD header: %s.", h->name, h->line, what);
}

/* Whether text is one of the words of a list separated by '|'. */
static bool is_word(const char *text, size_t length, const char *list)
{
    for (const char *at = list; *at != 0;) {
        size_t word = strcspn(at, "|");
        if (word == length && memcmp(at, text, length) == 0)
            return true;
        at += word + (at[word] == '|');
    }
    return false;
}

static bool read_type(header *h, const char *text, size_t length)
{
    h->is_float = false;
    if (is_word(text, length, "uchar|unsigned char|uint8|uint8_t"))
        h->bytes = 1;
    else if (is_word(text, length, "ushort|unsigned short|unsigned short int|uint16|uint16_t"))
        h->bytes = 2;
    else if (is_word(text, length, "float|double")) {
        h->bytes = length == 5 ? 4 : 8;
        h->is_float = true;
    } else
        return bad_line(h, "the type must be uint8, uint16, float or double");
    return true;
}

/* A decimal number, capped far above every limit. */
static size_t read_size(const char *text, size_t length, uint64_t *value)
{
    size_t at = 0;
    *value = 0;
    for (; at < length && text[at] >= '0' && text[at] <= '9'; at++)
        *value = *value < (UINT64_C(1) << 50) ? *value * 10 + (uint64_t)(text[at] - '0') : *value;
    return at;
}

static bool read_dimension(header *h, const char *text, size_t length)
{
    uint64_t value;
    if (read_size(text, length, &value) != length || length == 0 || value < 2 || value > MOST_DIMENSIONS)
        return bad_line(h, "the dimension must be 2, 3 or 4");
    h->dimensions = (int)value;
    return true;
}

static bool read_sizes(header *h, const char *text, size_t length)
{
    for (size_t at = 0; at < length;) {
        if (text[at] == ' ' || text[at] == '\t') {
            at++;
            continue;
        }
        uint64_t value;
        size_t used = read_size(text + at, length - at, &value);
        if (used == 0 || h->size_count == MOST_DIMENSIONS)
            return bad_line(h, "the sizes must be at most four whole numbers");
        h->sizes[h->size_count++] = value;
        at += used;
    }
    return true;
}

static bool read_encoding(header *h, const char *text, size_t length)
{
    h->is_gzip = is_word(text, length, "gzip|gz");
    h->has_encoding = true;
    return h->is_gzip || is_word(text, length, "raw") || bad_line(h, "the encoding must be raw or gzip");
}

static bool read_endian(header *h, const char *text, size_t length)
{
    h->is_big = is_word(text, length, "big");
    h->has_endian = true;
    return h->is_big || is_word(text, length, "little") || bad_line(h, "the endian must be little or big");
}

/* The kind of the first axis tells channels from space. */
static bool read_kinds(header *h, const char *text, size_t length)
{
    h->channels_first = is_word(text, strcspn(text, " \t\n") < length ? strcspn(text, " \t\n") : length,
                                "vector|covariant-vector|normal|stub|scalar|list|point|2-vector|3-vector|4-vector|"
                                "3-color|RGB-color|4-color|RGBA-color|none|???");
    return true;
}

static bool refuse(header *h, const char *text, size_t length)
{
    (void)text;
    (void)length;
    return bad_line(h, "data in another file, or after skipped lines or bytes, cannot be read");
}

static const struct {
    const char *field;
    bool (*read)(header *h, const char *text, size_t length);
} fields[] = {
    { "type", read_type },     { "dimension", read_dimension }, { "sizes", read_sizes }, { "encoding", read_encoding },
    { "endian", read_endian }, { "kinds", read_kinds },         { "data file", refuse }, { "datafile", refuse },
    { "line skip", refuse },   { "lineskip", refuse },          { "byte skip", refuse }, { "byteskip", refuse },
};

/* A line without its end. Comments, key/value pairs and fields that place the volume in space say nothing here. */
static bool read_line(header *h, const char *text, size_t length)
{
    const char *colon = memchr(text, ':', length);
    if (text[0] == '#')
        return true;
    if (colon == NULL)
        return bad_line(h, "there should be \"field: value\"");
    if (colon + 1 < text + length && colon[1] == '=')
        return true;
    const char *value = colon + 1, *end = text + length;
    while (value < end && (*value == ' ' || *value == '\t'))
        value++;
    while (end > value && (end[-1] == ' ' || end[-1] == '\t'))
        end--;
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++)
        if (is_word(text, (size_t)(colon - text), fields[i].field))
            return fields[i].read(h, value, (size_t)(end - value));
    return true;
}

/* Reads lines up to the empty one and moves *at behind it. */
static bool read_header(header *h, const uint8_t *data, size_t size, size_t *at)
{
    for (;;) {
        const uint8_t *newline = memchr(data + *at, '\n', size - *at);
        h->line++;
        if (newline == NULL)
            return bad_line(h, "the file ends in the header");
        const char *text = (const char *)data + *at;
        size_t length = (size_t)(newline - data) - *at;
        *at = (size_t)(newline - data) + 1;
        if (length > 0 && text[length - 1] == '\r')
            length--;
        if (length == 0)
            return true;
        if (h->line > 1 && !read_line(h, text, length))
            return false;
    }
}

static bool check_header(header *h)
{
    if (h->bytes == 0 || h->dimensions == 0 || h->size_count == 0 || !h->has_encoding)
        return lom_fail(h->error, LOM_ERROR_INPUT, "%s: the NRRD header lacks its type, dimension, sizes or encoding.",
                        h->name);
    if (h->size_count != h->dimensions)
        return lom_fail(h->error, LOM_ERROR_INPUT, "%s: the NRRD header declares %d dimensions but %d sizes.", h->name,
                        h->dimensions, h->size_count);
    if (h->bytes > 1 && !h->has_endian)
        return lom_fail(h->error, LOM_ERROR_INPUT, "%s: the NRRD header does not name the endian of its samples.",
                        h->name);
    return true;
}

typedef struct layout {
    int channels, width, height, depth;
    uint64_t samples, bytes;
} layout;

static bool find_layout(const header *h, uint64_t available, layout *l)
{
    bool has_channels = h->dimensions == 4 || h->channels_first;
    int first = has_channels ? 1 : 0;
    uint64_t axis[3] = { 1, 1, 1 }, channels = has_channels ? h->sizes[0] : 1;
    for (int i = first; i < h->dimensions; i++)
        axis[i - first] = h->sizes[i];
    if (channels < 1 || channels > 4)
        return lom_fail(h->error, LOM_ERROR_INPUT, "%s: a volume has 1 to 4 channels.", h->name);
    l->samples = channels;
    for (int i = 0; i < 3; i++) {
        if (axis[i] == 0)
            return lom_fail(h->error, LOM_ERROR_INPUT, "%s: the header declares an empty volume.", h->name);
        if (axis[i] > LOM_MAX_SIZE)
            return lom_fail(h->error, LOM_ERROR_LIMIT, "%s: the header declares more than %d voxels a side.", h->name,
                            LOM_MAX_SIZE);
        l->samples *= axis[i]; /* below 2^2 * 2^45 */
    }
    l->bytes = l->samples * (uint64_t)h->bytes;
    if (l->bytes > most_bytes)
        return lom_fail(h->error, LOM_ERROR_LIMIT,
                        "%s: the header declares a volume of %.3g bytes, above the limit of 2^31.", h->name,
                        (double)l->bytes);
    if (l->bytes > available * (h->is_gzip ? LOM_INFLATE_RATIO : 1))
        return lom_fail(h->error, LOM_ERROR_INPUT,
                        "%s: the header declares %d x %d x %d voxels, which the file is too short for.", h->name,
                        (int)axis[0], (int)axis[1], (int)axis[2]);
    l->channels = (int)channels;
    l->width = (int)axis[0];
    l->height = (int)axis[1];
    l->depth = (int)axis[2];
    return true;
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

static bool store_samples(const header *h, const layout *l, const uint8_t *from, lom_image *image)
{
    for (uint64_t i = 0; i < l->samples; i++, from += h->bytes) {
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

static lom_format format_of(const header *h, int channels)
{
    if (h->is_float)
        return (lom_format)(LOM_FORMAT_R32F + channels - 1);
    return lom_unorm_format(channels, 8 * h->bytes);
}

lom_image *lom_decode_nrrd(const uint8_t *data, size_t size, const char *name, lom_error *error)
{
    header h = { .name = name, .error = error };
    layout l;
    size_t at = 0;
    if (!read_header(&h, data, size, &at) || !check_header(&h) || !find_layout(&h, size - at, &l))
        return NULL;
    const uint8_t *samples = data + at;
    lom_bytes inflated = { 0 };
    uint64_t available = size - at;
    if (h.is_gzip) {
        inflated = lom_inflate_gzip(name, data + at, size - at, (size_t)l.bytes, error);
        if (inflated.data == NULL)
            return NULL;
        samples = inflated.data;
        available = inflated.size;
    }
    lom_image *image = NULL;
    if (available < l.bytes)
        lom_fail(error, LOM_ERROR_INPUT, "%s: the volume has %llu bytes of samples instead of %llu.", name,
                 (unsigned long long)available, (unsigned long long)l.bytes);
    else
        image = lom_create_image(l.width, l.height, l.depth, format_of(&h, l.channels), error);
    if (image != NULL && !store_samples(&h, &l, samples, image)) {
        lom_free_image(image);
        image = NULL;
    }
    lom_release(inflated.data);
    return image;
}
