/* Pictures from files and to files. In: a path or bytes; out: an image, or the reverse. A file is read by its content,
 * whatever its name; it is written by kind or ending. A codec is a row of one table, which says what it can do;
 * messages, options, helps and docs are made of it. */
#include "codec.h"

#include "foreign.h"

#include <stdio.h>
#include <string.h>

enum { MAX_FILE = 0x7fffffff };

static const struct codec {
    lom_codec_info info;
    const char *signatures[2]; /* its files begin with one of them */
    lom_image *(*decode)(const uint8_t *data, size_t size, const char *name, lom_error *error);
    lom_bytes (*encode)(const lom_image *image, lom_error *error); /* NULL: not written, or a video */
} codecs[] = {
    { { "png", "PNG", "png", true, true, false, false, 8 | 16, { 0, 1, 2, 3, 4 } },
      { "\x89PNG\r\n\x1a\n" },
      lom_decode_png,
      lom_encode_png },
    { { "pbm", "PBM", "pbm", true, false, false, false, 8, { 0, 1, 1, 1, 1 } }, { "P1", "P4" }, lom_decode_pnm, NULL },
    { { "pgm", "PGM", "pgm", true, true, false, false, 8 | 16, { 0, 1, 1, 1, 1 } },
      { "P2", "P5" },
      lom_decode_pnm,
      lom_encode_pgm },
    { { "ppm", "PPM", "ppm", true, true, false, false, 8 | 16, { 0, 3, 3, 3, 3 } },
      { "P3", "P6" },
      lom_decode_pnm,
      lom_encode_ppm },
    { { "pam", "PAM", "pam", true, true, false, false, 8 | 16, { 0, 1, 2, 3, 4 } },
      { "P7" },
      lom_decode_pam,
      lom_encode_pam },
    { { "pfm", "PFM", "pfm", true, true, false, false, 32, { 0, 1, 1, 3, 3 } },
      { "PF", "Pf" },
      lom_decode_pfm,
      lom_encode_pfm },
    { { "nrrd", "NRRD", "nrrd", true, true, false, true, 8 | 16 | 32, { 0, 1, 2, 3, 4 } },
      { "NRRD" },
      lom_decode_nrrd,
      lom_encode_nrrd },
    { { "qoi", "QOI", "qoi", true, true, false, false, 8, { 0, 3, 4, 3, 4 } },
      { "qoif" },
      lom_decode_qoi,
      lom_encode_qoi },
    { { "dds", "DDS", "dds", true, true, false, true, 8 | 16 | 32, { 0, 1, 2, 4, 4 } },
      { "DDS " },
      lom_decode_dds,
      lom_encode_dds },
    { { "ktx", "KTX", "ktx", true, false, false, true, 8 | 16 | 32, { 0, 1, 2, 3, 4 } },
      { "\xabKTX 11\xbb\r\n\x1a\n" },
      lom_decode_ktx,
      NULL },
    { { "npy", "NumPy", "npy", false, true, false, false, 8 | 16 | 32, { 0, 1, 2, 3, 4 } },
      { NULL },
      NULL,
      lom_encode_npy },
    { { "y4m", "YUV4MPEG2", "y4m", false, true, true, false, 8, { 0, 3, 3, 3, 3 } }, { NULL }, NULL, NULL },
};

enum { CODECS = sizeof codecs / sizeof *codecs };

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

const lom_codec_info *lom_describe_codec(size_t index)
{
    return index < CODECS ? &codecs[index].info : NULL;
}

const lom_codec_info *lom_find_codec(const char *path, const char *kind)
{
    const char *dot = strrchr(path, '.'), *slash = strrchr(path, '/');
    const char *ending = dot != NULL && (slash == NULL || dot > slash) ? dot + 1 : "";
    for (int i = 0; i < CODECS; i++)
        if (kind != NULL ? lom_is_word(kind, strlen(kind), codecs[i].info.name)
                         : lom_is_word(ending, strlen(ending), codecs[i].info.endings))
            return &codecs[i].info;
    return NULL;
}

/* The table's row of what lom_describe_codec gives. */
static const struct codec *codec_of(const lom_codec_info *info)
{
    for (int i = 0; i < CODECS; i++)
        if (info == &codecs[i].info)
            return &codecs[i];
    return NULL;
}

static bool is_decoded(const struct codec *codec)
{
    return codec->decode != NULL;
}

static bool is_encoded(const struct codec *codec)
{
    return codec->encode != NULL;
}

/* "PNG, PBM or PGM": the titles (or names) of those that can do it. */
static void list_codecs(bool (*can)(const struct codec *codec), bool titles, char *text, size_t room)
{
    int left = 0;
    size_t length = 0;
    text[0] = 0;
    for (int i = 0; i < CODECS; i++)
        left += can(&codecs[i]);
    for (int i = 0; i < CODECS; i++) {
        if (!can(&codecs[i]) || length >= room)
            continue;
        int added = snprintf(text + length, room - length, "%s%s", titles ? codecs[i].info.title : codecs[i].info.name,
                             left > 2   ? ", "
                             : left > 1 ? " or "
                                        : "");
        length += added > 0 ? (size_t)added : 0;
        left--;
    }
}

const lom_codec_info *lom_recognize_codec(const uint8_t *data, size_t size)
{
    for (int i = 0; i < CODECS; i++)
        for (int k = 0; k < 2 && codecs[i].signatures[k] != NULL; k++) {
            size_t length = strlen(codecs[i].signatures[k]);
            if (size >= length && memcmp(data, codecs[i].signatures[k], length) == 0)
                return &codecs[i].info;
        }
    return NULL;
}

static lom_image *decode(const uint8_t *data, size_t size, const char *name, lom_error *error)
{
    const struct codec *codec = codec_of(lom_recognize_codec(data, size));
    if (codec != NULL)
        return codec->decode(data, size, name, error);
    char kinds[200];
    list_codecs(is_decoded, true, kinds, sizeof kinds);
    lom_fail(error, LOM_ERROR_INPUT, "%s: byte 0: this is no picture (%s)%s.", name, kinds,
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

static lom_bytes encode(const char *path, const char *kind, const lom_image *image, lom_error *error)
{
    const lom_codec_info *info = lom_find_codec(path, kind);
    const struct codec *codec = codec_of(info);
    if (codec != NULL && is_encoded(codec)) {
        if (image->depth == 1 || info->holds_slices)
            return codec->encode(image, error);
        lom_fail(error, LOM_ERROR_USAGE, "A picture file holds one slice, not %d.", image->depth);
        return (lom_bytes){ 0 };
    }
    char kinds[200];
    const char *dot = strrchr(path, '.');
    list_codecs(is_encoded, false, kinds, sizeof kinds);
    lom_fail(error, LOM_ERROR_USAGE, "There is no picture kind \"%s\" to write; it is %s.",
             kind != NULL  ? kind
             : dot != NULL ? dot + 1
                           : "",
             kinds);
    return (lom_bytes){ 0 };
}

static lom_bytes encode_for(const char *path, const char *kind, const lom_image *image, lom_error *error)
{
    lom_float_state state;
    lom_enter_float_state(&state);
    lom_bytes bytes = encode(path, kind, image, error);
    lom_leave_float_state(&state);
    return bytes;
}

lom_bytes lom_encode_image(const char *kind, const lom_image *image, lom_error *error)
{
    return encode_for("", kind, image, error);
}

bool lom_write_image(const char *path, const char *kind, const lom_image *image, lom_error *error)
{
    lom_error encoding = { 0 };
    lom_bytes file = encode_for(path, kind, image, &encoding);
    if (file.data == NULL)
        return lom_fail(error, encoding.code, "%s: %s", path, encoding.text);
    bool written = lom_write_file(path, file.data, file.size, error);
    lom_release(file.data);
    return written;
}
