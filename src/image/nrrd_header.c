/* The header of NRRD files (teem.sourceforge.net/nrrd/format.html): lines "field: value" or "key:=value" up to an empty
 * one. In: a whole file; out: what its fields say. Invariant: a field that decides how samples are read is understood
 * or refused, whatever its case (descformat.html: "Most strings are case insensitive"); one that does not exist, or
 * stands there twice, is refused as teem does. */
#include "nrrd_header.h"

#include "codec.h"

#include <string.h>

static bool bad_line(const nrrd_header *h, const char *what)
{
    return lom_fail(h->error, LOM_ERROR_INPUT, "%s: line %d of the NRRD header: %s.", h->name, h->line, what);
}

static bool is_word(nrrd_text text, const char *list)
{
    return lom_is_word(text.start, text.length, list);
}

static bool read_type(nrrd_header *h, nrrd_text text)
{
    static const struct {
        const char *names;
        int bytes;
        bool is_float;
    } types[] = {
        { "uchar|unsigned char|uint8|uint8_t", 1, false },
        { "ushort|unsigned short|unsigned short int|uint16|uint16_t", 2, false },
        { "float", 4, true },
        { "double", 8, true },
    };
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        if (is_word(text, types[i].names)) {
            h->bytes = types[i].bytes;
            h->is_float = types[i].is_float;
            return true;
        }
    return bad_line(h, "the type must be uint8, uint16, float or double");
}

/* A decimal number, capped far above every limit; gives the digits used. */
static size_t read_number(const char *text, size_t length, uint64_t *value)
{
    size_t at = 0;
    *value = 0;
    for (; at < length && text[at] >= '0' && text[at] <= '9'; at++)
        *value = *value < (UINT64_C(1) << 50) ? *value * 10 + (uint64_t)(text[at] - '0') : *value;
    return at;
}

static bool read_dimension(nrrd_header *h, nrrd_text text)
{
    uint64_t value;
    if (read_number(text.start, text.length, &value) != text.length || text.length == 0 || value < 2 ||
        value > NRRD_MOST_DIMENSIONS)
        return bad_line(h, "the dimension must be 2, 3 or 4");
    h->dimensions = (int)value;
    return true;
}

static bool read_sizes(nrrd_header *h, nrrd_text text)
{
    for (size_t at = 0; at < text.length;) {
        if (text.start[at] == ' ' || text.start[at] == '\t') {
            at++;
            continue;
        }
        uint64_t value;
        size_t used = read_number(text.start + at, text.length - at, &value);
        bool ends = at + used == text.length || text.start[at + used] == ' ' || text.start[at + used] == '\t';
        if (used == 0 || !ends || h->size_count == NRRD_MOST_DIMENSIONS)
            return bad_line(h, "the sizes must be at most four whole numbers");
        h->sizes[h->size_count++] = value;
        at += used;
    }
    return true;
}

static bool read_encoding(nrrd_header *h, nrrd_text text)
{
    h->is_gzip = is_word(text, "gzip|gz");
    h->has_encoding = true;
    return h->is_gzip || is_word(text, "raw") || bad_line(h, "the encoding must be raw or gzip");
}

static bool read_endian(nrrd_header *h, nrrd_text text)
{
    h->is_big = is_word(text, "big");
    h->has_endian = true;
    return h->is_big || is_word(text, "little") || bad_line(h, "the endian must be little or big");
}

static bool read_line_skip(nrrd_header *h, nrrd_text text)
{
    return (text.length > 0 && read_number(text.start, text.length, &h->line_skip) == text.length) ||
           bad_line(h, "the lines to skip must be a whole number from 0");
}

static bool read_byte_skip(nrrd_header *h, nrrd_text text)
{
    h->at_end = is_word(text, "-1");
    return h->at_end || (text.length > 0 && read_number(text.start, text.length, &h->byte_skip) == text.length) ||
           bad_line(h, "the bytes to skip must be a whole number from 0, or -1");
}

static bool read_kinds(nrrd_header *h, nrrd_text text)
{
    h->kinds = text;
    return true;
}

static bool read_directions(nrrd_header *h, nrrd_text text)
{
    h->directions = text;
    return true;
}

static bool refuse_file(nrrd_header *h, nrrd_text text)
{
    (void)text;
    return bad_line(h, "data in another file cannot be read");
}

/* Every field of the format; those without a function place the samples in the world or describe them, and change none.
 */
static const struct {
    const char *names;
    bool (*read)(nrrd_header *h, nrrd_text text);
} fields[] = {
    { "type", read_type },
    { "dimension", read_dimension },
    { "sizes", read_sizes },
    { "encoding", read_encoding },
    { "endian", read_endian },
    { "kinds", read_kinds },
    { "space directions|spacedirections", read_directions },
    { "line skip|lineskip", read_line_skip },
    { "byte skip|byteskip", read_byte_skip },
    { "data file|datafile", refuse_file },
    { "block size|blocksize", NULL },
    { "content", NULL },
    { "number", NULL },
    { "min", NULL },
    { "max", NULL },
    { "old min|oldmin", NULL },
    { "old max|oldmax", NULL },
    { "sample units|sampleunits", NULL },
    { "spacings", NULL },
    { "thicknesses", NULL },
    { "axis mins|axismins", NULL },
    { "axis maxs|axismaxs", NULL },
    { "centers|centerings", NULL },
    { "labels", NULL },
    { "units", NULL },
    { "space", NULL },
    { "space dimension|spacedimension", NULL },
    { "space units|spaceunits", NULL },
    { "space origin|spaceorigin", NULL },
    { "measurement frame|measurementframe", NULL },
};

/* A value without the blanks around it. */
static nrrd_text trim(const char *start, const char *end)
{
    while (start < end && (*start == ' ' || *start == '\t'))
        start++;
    while (end > start && (end[-1] == ' ' || end[-1] == '\t'))
        end--;
    return (nrrd_text){ start, (size_t)(end - start) };
}

static bool is_key_and_value(const char *text, size_t length)
{
    for (size_t i = 0; i + 1 < length; i++)
        if (text[i] == ':' && text[i + 1] == '=')
            return true;
    return false;
}

/* A line without its end. The name of a field goes up to the first colon; a key may hold colons, too. */
static bool read_line(nrrd_header *h, const char *text, size_t length)
{
    if (text[0] == '#')
        return true;
    const char *colon = memchr(text, ':', length);
    nrrd_text field = { text, colon != NULL ? (size_t)(colon - text) : 0 };
    bool is_field = colon != NULL && (colon + 1 == text + length || colon[1] != '=');
    for (size_t i = 0; is_field && i < sizeof fields / sizeof *fields; i++) {
        if (!is_word(field, fields[i].names))
            continue;
        if (h->seen >> i & 1)
            return bad_line(h, "the field was there before");
        h->seen |= UINT32_C(1) << i;
        return fields[i].read == NULL || fields[i].read(h, trim(colon + 1, text + length));
    }
    if (is_key_and_value(text, length))
        return true;
    return bad_line(h, is_field ? "NRRD has no such field" : "there should be \"field: value\"");
}

static bool read_magic(nrrd_header *h, const char *text, size_t length)
{
    nrrd_text magic = trim(text, text + length);
    static const char *const versions[] = { "NRRD0001", "NRRD0002", "NRRD0003", "NRRD0004", "NRRD0005", "NRRD00.01" };
    for (size_t i = 0; i < sizeof versions / sizeof *versions; i++)
        if (text == magic.start && magic.length == strlen(versions[i]) && memcmp(text, versions[i], magic.length) == 0)
            return true;
    return bad_line(h, "the magic must be NRRD0001 to NRRD0005");
}

static bool check_header(const nrrd_header *h)
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
    if (h->at_end && h->is_gzip)
        return lom_fail(h->error, LOM_ERROR_INPUT, "%s: a byte skip of -1 is for raw samples, not for gzip.", h->name);
    return true;
}

bool lom_read_nrrd_header(nrrd_header *h, const uint8_t *data, size_t size, size_t *at)
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
        if (length == 0 && h->line > 1)
            return check_header(h);
        if (!(h->line == 1 ? read_magic(h, text, length) : read_line(h, text, length)))
            return false;
    }
}
