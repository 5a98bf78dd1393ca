/* Pictures from files and to files. In: a path or bytes; out: an image, or the reverse. A file is read by its content,
 * whatever its name; it is written by kind or extension. Formats are rows of two tables. */
#include "codec.h"

#include "foreign.h"

#include <string.h>

enum { MAX_FILE = 0x7fffffff };

static const struct {
    const char *signature;
    size_t length;
    lom_image *(*decode)(const uint8_t *data, size_t size, const char *name, lom_error *error);
} decoders[] = {
    { "\x89PNG\r\n\x1a\n", 8, lom_decode_png },
    { "P1", 2, lom_decode_pnm },
    { "P2", 2, lom_decode_pnm },
    { "P3", 2, lom_decode_pnm },
    { "P4", 2, lom_decode_pnm },
    { "P5", 2, lom_decode_pnm },
    { "P6", 2, lom_decode_pnm },
    { "P7", 2, lom_decode_pam },
    { "PF", 2, lom_decode_pfm },
    { "Pf", 2, lom_decode_pfm },
    { "NRRD", 4, lom_decode_nrrd },
};

static const struct {
    const char *kind;
    lom_bytes (*encode)(const lom_image *image, lom_error *error);
    bool holds_slices;
} encoders[] = {
    { "png", lom_encode_png, false }, { "ppm", lom_encode_ppm, false }, { "pgm", lom_encode_pgm, false },
    { "pam", lom_encode_pam, false }, { "pfm", lom_encode_pfm, false }, { "nrrd", lom_encode_nrrd, true },
};

static char in_small(char c)
{
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

bool lom_is_word(const char *text, size_t length, const char *list)
{
    while (*list != 0) {
        size_t word = strcspn(list, "|"), same = 0;
        while (same < word && same < length && in_small(text[same]) == in_small(list[same]))
            same++;
        if (same == word && same == length)
            return true;
        list += word + (list[word] == '|');
    }
    return false;
}

lom_format lom_unorm_format(int channels, int bits)
{
    return (lom_format)((bits == 16 ? LOM_FORMAT_R16 : LOM_FORMAT_R8) + channels - 1);
}

lom_image *lom_create_declared(const char *name, uint64_t width, uint64_t height, lom_format format,
                               uint64_t sample_bits, uint64_t ratio, uint64_t available, lom_error *error)
{
    if (width == 0 || height == 0) {
        lom_fail(error, LOM_ERROR_INPUT, "%s: the header declares an empty picture.", name);
        return NULL;
    }
    if (width > LOM_MAX_SIZE || height > LOM_MAX_SIZE) {
        lom_fail(error, LOM_ERROR_LIMIT, "%s: the header declares more than %d pixels a side.", name, LOM_MAX_SIZE);
        return NULL;
    }
    /* below 2^15 * 2^15 * 2^7, and a file's size times 2^11: no overflow */
    if ((width * height * sample_bits + 7) / 8 > available * ratio) {
        lom_fail(error, LOM_ERROR_INPUT, "%s: the header declares %d x %d pixels, which the file is too short for.",
                 name, (int)width, (int)height);
        return NULL;
    }
    return lom_create_image((int)width, (int)height, 1, format, error);
}

static lom_image *decode(const uint8_t *data, size_t size, const char *name, lom_error *error)
{
    for (size_t i = 0; i < sizeof decoders / sizeof *decoders; i++)
        if (size >= decoders[i].length && memcmp(data, decoders[i].signature, decoders[i].length) == 0)
            return decoders[i].decode(data, size, name, error);
    lom_fail(error, LOM_ERROR_INPUT, "%s: byte 0: this is no picture (PNG, PBM, PGM, PPM, PAM, PFM or NRRD)%s.", name,
             lom_foreign_kind(data, size, name));
    return NULL;
}

lom_image *lom_decode_image(const uint8_t *data, size_t size, const char *name, lom_error *error)
{
    lom_float_state state;
    lom_enter_float_state(&state);
    lom_image *image = decode(data, size, name, error);
    lom_leave_float_state(&state);
    return image;
}

lom_image *lom_read_image(const char *path, lom_error *error)
{
    lom_bytes file = lom_read_file(path, MAX_FILE, error);
    if (file.data == NULL)
        return NULL;
    lom_image *image = lom_decode_image(file.data, file.size, path, error);
    lom_release(file.data);
    return image;
}

static lom_bytes encode(const char *kind, const lom_image *image, lom_error *error)
{
    for (size_t i = 0; kind != NULL && i < sizeof encoders / sizeof *encoders; i++) {
        if (!lom_is_word(kind, strlen(kind), encoders[i].kind))
            continue;
        if (image->depth == 1 || encoders[i].holds_slices)
            return encoders[i].encode(image, error);
        lom_fail(error, LOM_ERROR_USAGE, "A picture file holds one slice, not %d.", image->depth);
        return (lom_bytes){ 0 };
    }
    lom_fail(error, LOM_ERROR_USAGE, "There is no picture kind \"%s\" to write; it is png, ppm, pgm, pam, pfm or nrrd.",
             kind != NULL ? kind : "");
    return (lom_bytes){ 0 };
}

lom_bytes lom_encode_image(const char *kind, const lom_image *image, lom_error *error)
{
    lom_float_state state;
    lom_enter_float_state(&state);
    lom_bytes bytes = encode(kind, image, error);
    lom_leave_float_state(&state);
    return bytes;
}

bool lom_write_image(const char *path, const char *kind, const lom_image *image, lom_error *error)
{
    if (kind == NULL) {
        const char *dot = strrchr(path, '.'), *slash = strrchr(path, '/');
        kind = dot != NULL && (slash == NULL || dot > slash) ? dot + 1 : NULL;
    }
    lom_error encoding = { 0 };
    lom_bytes file = lom_encode_image(kind, image, &encoding);
    if (file.data == NULL)
        return lom_fail(error, encoding.code, "%s: %s", path, encoding.text);
    bool written = lom_write_file(path, file.data, file.size, error);
    lom_release(file.data);
    return written;
}
