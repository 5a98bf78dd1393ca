/* Proves: volumes come back from NRRD files as they were written, in every format; headers of other programs are read
 * (types by any of their names, either byte order, comments, carriage returns, fields that say nothing here, lines and
 * bytes to skip); every kind of axis, at every place and in either case, is what the format says or refused; every
 * damaged or lying file is refused in one sentence. */
#include "check.h"

#include <lom/image.h>

#include <unistd.h>

static lom_image *decode(const char *header, const void *data, size_t size, lom_error *error)
{
    static uint8_t file[4096];
    size_t length = strlen(header);
    memcpy(file, header, length);
    memcpy(file + length, data, size);
    return lom_decode_image(file, length + size, "x.nrrd", error);
}

static void test_every_format_round_trips(void)
{
    static const lom_format formats[] = { LOM_FORMAT_R8,     LOM_FORMAT_RG8,  LOM_FORMAT_RGB8,
                                          LOM_FORMAT_RGBA8,  LOM_FORMAT_R16,  LOM_FORMAT_RG16,
                                          LOM_FORMAT_RGBA16, LOM_FORMAT_R32F, LOM_FORMAT_RGB32F };
    static const int sizes[][3] = { { 1, 1, 1 }, { 7, 3, 5 }, { 1, 40, 2 }, { 64, 2, 3 } };
    for (size_t f = 0; f < sizeof formats / sizeof *formats; f++)
        for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
            lom_image *image = lom_create_image(sizes[s][0], sizes[s][1], sizes[s][2], formats[f], NULL);
            for (size_t i = 0; i < lom_image_size(image); i++) /* no exponent of all ones, so no NaN */
                image->pixels[i] = (uint8_t)(lom_random_bits(f * 10 + s, i) & 0x3f);
            lom_error error = { 0 };
            lom_bytes file = lom_encode_image("nrrd", image, &error);
            lom_image *back = lom_decode_image(file.data, file.size, "back", &error);
            CHECK(back != NULL && lom_hash_image(back) == lom_hash_image(image), "format %zu size %zu: %s", f, s,
                  error.text);
            lom_free_image(back);
            lom_free_image(image);
            lom_release(file.data);
        }
}

static void test_headers_of_others(void)
{
    static const uint8_t little[] = { 1, 0, 2, 0, 3, 0, 255, 255 }, big[] = { 0, 1, 0, 2, 0, 3, 255, 255 };
    static const char *const headers[] = {
        "NRRD0001\ntype: unsigned short\ndimension: 3\nsizes: 2 2 1\nendian: little\nencoding: raw\n\n",
        "NRRD0005\r\n# a comment\r\ntype: uint16_t\r\ndimension: 3\r\nspace: left-posterior-superior\r\nsizes: 2 2 "
        "1\r\n"
        "spacings: 1 1 nan\r\nkinds: domain domain domain\r\nendian: little\r\nencoding: raw\r\nkey:=value\r\n\r\n",
        "NRRD0004\nsizes:   2\t2  1 \ntype: ushort\nencoding: raw\nendian: little\ndimension: 3\n\n",
        "NRRD0004\ntype: uint16\ndimension: 2\nsizes: 2 2\nendian: little\nencoding: raw\n\n",
    };
    for (size_t i = 0; i < sizeof headers / sizeof *headers; i++) {
        lom_error error = { 0 };
        lom_image *image = decode(headers[i], little, sizeof little, &error);
        CHECK(image != NULL && image->format == LOM_FORMAT_R16 && image->width == 2 && image->height == 2,
              "header %zu: %s", i, error.text);
        CHECK(image != NULL && ((uint16_t *)image->pixels)[2] == 3 && ((uint16_t *)image->pixels)[3] == 65535,
              "header %zu", i);
        lom_free_image(image);
    }
    lom_image *image = decode("NRRD0004\ntype: uint16\ndimension: 3\nsizes: 2 2 1\nendian: big\nencoding: raw\n\n", big,
                              sizeof big, NULL);
    CHECK(image != NULL && ((uint16_t *)image->pixels)[2] == 3, "big-endian");
    lom_free_image(image);
    static const uint8_t half[] = { 0, 0, 0, 0, 0, 0, 0xe0, 0x3f };
    image =
        decode("NRRD0004\ntype: double\ndimension: 3\nsizes: 1 1 1\nendian: little\nencoding: raw\n\n", half, 8, NULL);
    CHECK(image != NULL && image->format == LOM_FORMAT_R32F && *(float *)image->pixels == 0.5f, "double");
    lom_free_image(image);
}

static void test_bad_volumes_are_refused(void)
{
    static const struct {
        const char *header;
        lom_code code;
        const char *says;
    } cases[] = {
        { "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 10000 10000 10000\nencoding: raw\n\n", LOM_ERROR_LIMIT,
          "limit" },
        { "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 99999999999999999999999 1 1\nencoding: raw\n\n", LOM_ERROR_LIMIT,
          "voxels a side" },
        { "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 1000 1000 1000\nencoding: gzip\n\n", LOM_ERROR_INPUT,
          "too short" },
        { "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 3 3 3\nencoding: raw\n\n", LOM_ERROR_INPUT, "too short" },
        { "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 0 3 3\nencoding: raw\n\n", LOM_ERROR_INPUT, "empty" },
        { "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 1\nencoding: raw\n\n", LOM_ERROR_INPUT, "2 sizes" },
        { "NRRD0004\ntype: uint8\ndimension: 3\nsizes: -2 1 1\nencoding: raw\n\n", LOM_ERROR_INPUT, "line 4" },
        { "NRRD0004\ntype: int16\ndimension: 3\nsizes: 2 1 1\nencoding: raw\n\n", LOM_ERROR_INPUT, "the type" },
        { "NRRD0004\ntype: uint16\ndimension: 3\nsizes: 2 1 1\nencoding: raw\n\n", LOM_ERROR_INPUT, "endian" },
        { "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 1 1\nencoding: bzip2\n\n", LOM_ERROR_INPUT, "encoding" },
        { "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 1 1\nencoding: raw\ndata file: x.raw\n\n", LOM_ERROR_INPUT,
          "another file" },
        { "NRRD0004\ntype: uint8\ndimension: 9\nsizes: 2 1 1\nencoding: raw\n\n", LOM_ERROR_INPUT, "dimension" },
        { "NRRD0004\ntype: uint8\nsizes: 2 1 1\nencoding: raw\n\n", LOM_ERROR_INPUT, "lacks" },
        { "NRRD0004\ntype: uint8\nnonsense\n\n", LOM_ERROR_INPUT, "field: value" },
        { "NRRD0004\ntype: uint8\ndimension: 3", LOM_ERROR_INPUT, "ends in the header" },
        { "NRRD0004\ntype: uint8\ndimension: 4\nsizes: 5 1 1 1\nencoding: raw\n\n", LOM_ERROR_INPUT, "channels" },
        { "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 1 1\nencoding: gzip\n\n", LOM_ERROR_INPUT, "gzip" },
    };
    static const uint8_t few[4] = { 1, 2, 3, 4 };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        lom_error error = { 0 };
        lom_image *image = decode(cases[i].header, few, sizeof few, &error);
        CHECK(image == NULL && error.code == cases[i].code && strstr(error.text, cases[i].says) != NULL,
              "case %zu: %d %s", i, error.code, error.text);
        lom_free_image(image);
    }
    static const uint8_t nan[] = { 0, 0, 0, 0, 0, 0, 0xc0, 0x7f };
    lom_error error = { 0 };
    CHECK(decode("NRRD0004\ntype: float\ndimension: 3\nsizes: 2 1 1\nendian: little\nencoding: raw\n\n", nan, 8,
                 &error) == NULL &&
              strstr(error.text, "sample 1 is NaN") != NULL,
          "%s", error.text);
}

static void test_truncated_at_every_byte(void)
{
    lom_image *image = lom_create_image(5, 4, 3, LOM_FORMAT_R16, NULL);
    for (int i = 0; i < 60; i++)
        ((uint16_t *)image->pixels)[i] = (uint16_t)(i * 997);
    lom_bytes file = lom_encode_image("nrrd", image, NULL);
    for (size_t size = 0; size < file.size; size++) {
        lom_error error = { 0 };
        lom_image *cut = lom_decode_image(file.data, size, "cut", &error);
        CHECK(cut == NULL && error.code != LOM_OK, "%zu bytes were enough", size);
        lom_free_image(cut);
    }
    lom_release(file.data);
    lom_free_image(image);
}

static void test_raw_volumes_by_their_size(void)
{
    static const uint8_t bytes[16] = { 0, 0, 0x80, 0x3f, 0, 0, 0, 0x3f, 0, 0, 0, 0, 0, 0, 0xc0, 0x7f };
    static const int voxels[] = { 16, 8, 3 };
    static const lom_format formats[] = { LOM_FORMAT_R8, LOM_FORMAT_R16, LOM_FORMAT_R32F };
    static const size_t sizes[] = { 16, 16, 12 };
    for (int i = 0; i < 3; i++) {
        lom_image *image = lom_decode_raw_volume(bytes, sizes[i], voxels[i], 1, 1, "raw", NULL);
        CHECK(image != NULL && image->format == formats[i] && image->width == voxels[i], "case %d", i);
        lom_free_image(image);
    }
    lom_error error = { 0 };
    CHECK(lom_decode_raw_volume(bytes, 16, 5, 1, 1, "raw", &error) == NULL && strstr(error.text, "has 16") != NULL,
          "%s", error.text);
    error = (lom_error){ 0 };
    CHECK(lom_decode_raw_volume(bytes, 16, 4, 1, 1, "raw", &error) == NULL && strstr(error.text, "NaN") != NULL, "%s",
          error.text);
    error = (lom_error){ 0 };
    CHECK(lom_decode_raw_volume(bytes, 16, 32768, 32768, 1024, "raw", &error) == NULL && error.code == LOM_ERROR_INPUT,
          "%s", error.text);
}

/* ---- what axes mean ---- */

/* The kinds of format.html, section 6, written down once more: what stands for each is S an axis of space, T time, C
 * channels, 1 a single sample, X what no image holds; and the size that the kind asks for, 0 for any. */
static const struct {
    const char *name;
    char meaning;
    int size;
} kinds[] = {
    { "domain", 'S', 0 },
    { "space", 'S', 0 },
    { "time", 'T', 0 },
    { "list", 'C', 0 },
    { "point", 'C', 0 },
    { "vector", 'C', 0 },
    { "covariant-vector", 'C', 0 },
    { "normal", 'C', 0 },
    { "stub", '1', 1 },
    { "scalar", '1', 1 },
    { "complex", 'X', 2 },
    { "2-vector", 'C', 2 },
    { "3-color", 'C', 3 },
    { "RGB-color", 'C', 3 },
    { "HSV-color", 'X', 3 },
    { "XYZ-color", 'X', 3 },
    { "4-color", 'C', 4 },
    { "RGBA-color", 'C', 4 },
    { "3-vector", 'C', 3 },
    { "3-gradient", 'C', 3 },
    { "3-normal", 'C', 3 },
    { "4-vector", 'C', 4 },
    { "quaternion", 'X', 4 },
    { "2D-symmetric-matrix", 'X', 3 },
    { "2D-masked-symmetric-matrix", 'X', 4 },
    { "2D-matrix", 'X', 4 },
    { "2D-masked-matrix", 'X', 5 },
    { "3D-symmetric-matrix", 'X', 6 },
    { "3D-masked-symmetric-matrix", 'X', 7 },
    { "3D-matrix", 'X', 9 },
    { "3D-masked-matrix", 'X', 10 },
};

/* The text in small letters (1), in capitals (2) or as it is. */
static void change_case(char *text, int how)
{
    for (; how != 0 && *text != 0; text++)
        if (how == 1 ? *text >= 'A' && *text <= 'Z' : *text >= 'a' && *text <= 'z')
            *text ^= 32;
}

/* One axis of the kind, of `size` samples at `place`, among axes of space of 5, 6, 7 samples. */
static void expect_kind(size_t k, int size, int place, int dimensions, int how)
{
    static const uint8_t samples[4096];
    static const int others[] = { 5, 6, 7 };
    char header[512], sizes[64] = "", words[256] = "";
    int space[4] = { 1, 1, 1, 1 }, count = 0;
    for (int i = 0, other = 0; i < dimensions; i++) {
        int n = i == place ? size : others[other++];
        sprintf(sizes + strlen(sizes), " %d", n);
        sprintf(words + strlen(words), " %s", i == place ? kinds[k].name : "domain");
        if (i != place || kinds[k].meaning == 'S')
            space[count++] = n;
    }
    sprintf(header, "Type: uint8\ndimension: %d\nsizes:%s\nkinds:%s\nencoding: raw", dimensions, sizes, words);
    change_case(header, how);
    char file[600];
    sprintf(file, "NRRD0004\n%s\n\n", header);
    bool takes_channels = kinds[k].meaning == 'C' && place == 0 && size <= 4;
    bool reads = (kinds[k].size == 0 || kinds[k].size == size) && kinds[k].meaning != 'X' &&
                 (size == 1 || takes_channels || kinds[k].meaning == 'S') && count <= 3;
    lom_error error = { 0 };
    lom_image *image = decode(file, samples, 5 * 6 * 7 * 11, &error);
    CHECK((image != NULL) == reads, "%s of size %d, axis %d of %d: %s", kinds[k].name, size, place + 1, dimensions,
          error.text);
    if (image != NULL && reads)
        CHECK(image->width == space[0] && image->height == space[1] && image->depth == space[2] &&
                  lom_describe_format(image->format)->channels == (takes_channels ? size : 1),
              "%s of size %d, axis %d of %d: %d x %d x %d", kinds[k].name, size, place + 1, dimensions, image->width,
              image->height, image->depth);
    lom_free_image(image);
}

static void test_every_kind_at_every_place(void)
{
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++)
        for (int dimensions = 2; dimensions <= 4; dimensions++)
            for (int place = 0; place < dimensions; place++)
                for (int size = 1; size <= 11; size++)
                    expect_kind(k, size, place, dimensions, (int)(k + (size_t)size) % 3);
}

/* Axes without kinds, and those that only their directions tell. */
static void test_unknown_kinds(void)
{
    static const struct {
        const char *fields;
        int width, height, depth, channels; /* width 0: refused */
    } cases[] = {
        { "dimension: 3\nsizes: 3 4 5", 3, 4, 5, 1 },
        { "dimension: 4\nsizes: 3 4 5 2", 4, 5, 2, 3 },
        { "dimension: 3\nsizes: 3 4 5\nkinds: ??? ??? ???", 3, 4, 5, 1 },
        { "dimension: 3\nsizes: 3 4 5\nkinds: none NONE none", 3, 4, 5, 1 },
        { "dimension: 3\nsizes: 3 4 5\nkinds: ??? domain domain", 4, 5, 1, 3 },
        { "dimension: 3\nsizes: 4 5 3\nkinds: domain domain ???", 0, 0, 0, 0 },
        { "dimension: 3\nsizes: 4 5 1\nkinds: domain domain ???", 4, 5, 1, 1 },
        { "dimension: 3\nsizes: 4 5 3\nkinds: domain domain", 0, 0, 0, 0 },
        { "dimension: 3\nsizes: 4 5 3\nkinds: domain domain domain domain", 0, 0, 0, 0 },
        { "dimension: 3\nsizes: 4 5 3\nkinds: domain domain colour", 0, 0, 0, 0 },
        { "dimension: 3\nsizes: 3 4 5\nkinds: domain vector domain", 0, 0, 0, 0 },
        { "dimension: 4\nsizes: 2 3 4 5\nkinds: vector vector domain domain", 0, 0, 0, 0 },
        { "dimension: 4\nsizes: 2 3 4 5\nkinds: space space space space", 0, 0, 0, 0 },
        { "dimension: 3\nsizes: 3 4 5\nspace dimension: 2\nspace directions: none (1,0) (0, 1)", 4, 5, 1, 3 },
        { "dimension: 3\nsizes: 4 5 3\nspace dimension: 2\nspace directions: (1,0) (0,1) none", 0, 0, 0, 0 },
        { "dimension: 3\nsizes: 3 4 5\nspace dimension: 3\nspace directions: (1,0,0) (0,1,0) (0,0,1)", 3, 4, 5, 1 },
        { "dimension: 3\nsizes: 3 4 5\nspace directions: (1,0,0) (0,1,0)", 0, 0, 0, 0 },
        { "dimension: 3\nsizes: 3 4 5\nspace directions: (1,0,0) 1 (0,0,1)", 0, 0, 0, 0 },
        { "dimension: 4\nsizes: 3 4 5 2\nspace directions: none (1,0,0) (0,1,0) (0,0,1)\nkinds: ??? domain domain "
          "domain",
          4, 5, 2, 3 },
    };
    static const uint8_t samples[512];
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char file[512];
        lom_error error = { 0 };
        sprintf(file, "NRRD0005\ntype: uint8\n%s\nencoding: raw\n\n", cases[i].fields);
        lom_image *image = decode(file, samples, 120, &error);
        CHECK((image != NULL) == (cases[i].width > 0), "case %zu: %s", i, error.text);
        if (image != NULL)
            CHECK(image->width == cases[i].width && image->height == cases[i].height &&
                      image->depth == cases[i].depth &&
                      lom_describe_format(image->format)->channels == cases[i].channels,
                  "case %zu: %d x %d x %d", i, image->width, image->height, image->depth);
        lom_free_image(image);
    }
}

/* ---- fields and skips ---- */

static void expect_samples(const char *header, const void *data, size_t size, const char *samples)
{
    lom_error error = { 0 };
    lom_image *image = decode(header, data, size, &error);
    CHECK(image != NULL, "%s: %s", header, error.text);
    CHECK(image == NULL || memcmp(image->pixels, samples, lom_image_size(image)) == 0, "%s: other samples", header);
    lom_free_image(image);
}

static void test_fields_in_every_case(void)
{
    for (int how = 0; how < 3; how++) {
        char fields[] =
            "Type: UInt16\nDimension: 3\nSizes: 2 1 1\nEndian: Big\nEncoding: Raw\nLine Skip: 0\nLineSkip2:=x\n"
            "Byte Skip: 0\nKinds: Domain Space Space\nSpace Directions: None None None\nContent: a: b\n"
            "Old Min: 0\nOldMax: 1\na key: with a colon:=value: 1\nMeasurement Frame: (1)\nSample Units: K";
        char file[512];
        change_case(fields, how);
        sprintf(file, "NRRD0005\n%s\n\n", fields);
        lom_error error = { 0 };
        lom_image *image = decode(file, "\1\0\2\0", 4, &error);
        CHECK(image != NULL && image->width == 2 && ((uint16_t *)image->pixels)[1] == 512, "%s", error.text);
        lom_free_image(image);
    }
    static const char *const magics[] = { "NRRD0001", "NRRD0002", "NRRD0003", "NRRD0004", "NRRD0005", "NRRD00.01",
                                          "NRRD0006", "NRRD0000", "NRRDABCD", "NRRD",     "nrrd0004", "NRRD00040" };
    for (size_t i = 0; i < sizeof magics / sizeof *magics; i++) {
        char file[128];
        lom_error error = { 0 };
        sprintf(file, "%s\ntype: uint8\ndimension: 2\nsizes: 1 1\nencoding: raw\n\n", magics[i]);
        lom_image *image = decode(file, "\1", 1, &error);
        CHECK((image != NULL) == (i < 6), "%s: %s", magics[i], error.text);
        lom_free_image(image);
    }
}

static void test_lines_and_bytes_to_skip(void)
{
#define SKIPS(fields) "NRRD0004\ntype: uint8\ndimension: 2\nsizes: 2 1\nencoding: raw\n" fields "\n\n"
    expect_samples(SKIPS("line skip: 0\nbyte skip: 0"), "ab", 2, "ab");
    expect_samples(SKIPS("lineskip: 0\nbyteskip: 0"), "abc", 3, "ab");
    expect_samples(SKIPS("line skip: 2"), "x\n\r\nab", 6, "ab");
    expect_samples(SKIPS("byte skip: 3"), "xyzab", 5, "ab");
    expect_samples(SKIPS("byte skip: 1\nline skip: 1"), "xyz\nwab", 7, "ab");
    expect_samples(SKIPS("byte skip: -1"), "xyzab", 5, "ab");
    static const struct {
        const char *header, *says;
    } bad[] = {
        { SKIPS("line skip: 3"), "lines that are to be skipped" },
        { SKIPS("byte skip: 4"), "too short" },
        { SKIPS("byte skip: -2"), "bytes to skip" },
        { SKIPS("byte skip: 1x"), "bytes to skip" },
        { SKIPS("line skip: -1"), "lines to skip" },
        { SKIPS("line skip:"), "lines to skip" },
        { SKIPS("byte skip: 99999999999999999999999"), "too short" },
        { SKIPS("byteskip : 1"), "no such field" },
        { SKIPS("skip: 1"), "no such field" },
        { SKIPS("type: uint8"), "before" },
        { SKIPS("byte skip: 1\nbyteskip: 1"), "before" },
        { SKIPS("data file: x"), "another file" },
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        lom_error error = { 0 };
        lom_image *image = decode(bad[i].header, "x\ny\nz", 5, &error);
        CHECK(image == NULL && strstr(error.text, bad[i].says) != NULL, "case %zu: %s", i, error.text);
        lom_free_image(image);
    }
#undef SKIPS
    /* "xyzab" as one stored block: bytes are skipped in what was decompressed, lines before it */
    static const char zipped[] = "line\n\x1f\x8b\x08\0\0\0\0\0\0\3\1\5\0\xfa\xff"
                                 "xyzab";
    uint32_t crc = 0xffffffff;
    for (int i = 0; i < 5; i++)
        for (int bit = 0; bit < 8; bit++)
            crc = crc >> 1 ^ (0xedb88320 & -((crc ^ (uint32_t)(uint8_t) "xyzab"[i] >> bit) & 1));
    crc = ~crc;
    uint8_t file[sizeof zipped - 1 + 8] = { 0 };
    memcpy(file, zipped, sizeof zipped - 1);
    for (int i = 0; i < 4; i++)
        file[sizeof zipped - 1 + i] = (uint8_t)(crc >> 8 * i);
    file[sizeof zipped - 1 + 4] = 5;
    expect_samples("NRRD0004\ntype: uint8\ndimension: 2\nsizes: 2 1\nencoding: GZ\nline skip: 1\nbyte skip: 3\n\n",
                   file, sizeof file, "ab");
    static const struct {
        const char *fields, *says;
    } bad_zipped[] = { { "sizes: 2 1\nline skip: 1\nbyte skip: -1", "for raw samples, not for gzip" },
                       { "sizes: 2 3\nline skip: 1", "has 5 bytes of samples instead of 6" },
                       { "sizes: 2 1\nline skip: 1\nbyte skip: 4", "has 5 bytes of samples instead of 6" } };
    for (size_t i = 0; i < sizeof bad_zipped / sizeof *bad_zipped; i++) {
        char header[200];
        lom_error error = { 0 };
        snprintf(header, sizeof header, "NRRD0004\ntype: uint8\ndimension: 2\nencoding: gzip\n%s\n\n",
                 bad_zipped[i].fields);
        lom_image *image = decode(header, file, sizeof file, &error);
        CHECK(image == NULL && strstr(error.text, bad_zipped[i].says) != NULL, "case %zu: %s", i, error.text);
        lom_free_image(image);
    }
}

/* Written to a file of this kind and read back as a volume of density: NULL with the reason in error. */
static lom_image *volume_of(lom_image *image, const char *name, const int size[3], lom_error *error)
{
    char path[120];
    const char *base = getenv("TMPDIR");
    snprintf(path, sizeof path, "%.60s/lom-volume-%ld-%s", base != NULL ? base : "/tmp", (long)getpid(), name);
    lom_image *volume = lom_write_image(path, NULL, image, error) ? lom_read_volume(path, size, error) : NULL;
    unlink(path);
    return volume;
}

/* Of every format with a density, that alone is read: one channel, or the last of two and four. */
static void test_volumes_are_densities(void)
{
    static const struct {
        lom_format format, density;
        int channel; /* -1: refused */
    } cases[] = { { LOM_FORMAT_R8, LOM_FORMAT_R8, 0 },        { LOM_FORMAT_RG8, LOM_FORMAT_R8, 1 },
                  { LOM_FORMAT_RGBA8, LOM_FORMAT_R8, 3 },     { LOM_FORMAT_R16, LOM_FORMAT_R16, 0 },
                  { LOM_FORMAT_RG16, LOM_FORMAT_R16, 1 },     { LOM_FORMAT_RGBA16, LOM_FORMAT_R16, 3 },
                  { LOM_FORMAT_R32F, LOM_FORMAT_R32F, 0 },    { LOM_FORMAT_RG32F, LOM_FORMAT_R32F, 1 },
                  { LOM_FORMAT_RGBA32F, LOM_FORMAT_R32F, 3 }, { LOM_FORMAT_RGB8, LOM_FORMAT_NONE, -1 },
                  { LOM_FORMAT_RGB32F, LOM_FORMAT_NONE, -1 } };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        lom_error error = { 0 };
        lom_image *image = lom_create_image(3, 4, 5, cases[i].format, NULL);
        for (size_t k = 0; k < lom_image_size(image); k++) /* no exponent of all ones, so no NaN */
            image->pixels[k] = (uint8_t)(lom_random_bits(i, k) & 0x3f);
        lom_image *volume = volume_of(image, "v.nrrd", NULL, &error);
        CHECK((volume != NULL) == (cases[i].channel >= 0), "case %zu: %s", i, error.text);
        CHECK(volume != NULL || strstr(error.text, "no density among them") != NULL, "case %zu: %s", i, error.text);
        size_t pixel = lom_format_size(cases[i].format), sample = lom_format_size(cases[i].density), same = 0;
        for (size_t k = 0; volume != NULL && k < 60; k++)
            same += memcmp(volume->pixels + k * sample, image->pixels + k * pixel + (size_t)cases[i].channel * sample,
                           sample) == 0;
        CHECK(volume == NULL || (volume->format == cases[i].density && volume->depth == 5 && same == 60),
              "case %zu: %zu of 60 voxels", i, same);
        lom_free_image(volume);
        lom_free_image(image);
    }
}

/* Raw voxels are read by the size that is given, and by none other; what is no volume is named. */
static void test_volumes_of_other_files(void)
{
    static const int size[3] = { 2, 2, 3 }, other[3] = { 2, 2, 2 }, empty[3] = { 2, 0, 2 };
    static const struct {
        const char *name, *begin, *says;
    } foreign[] = { { "x.nii.gz", "\x1f\x8b", "NIfTI" },
                    { "X.NII.GZ", "\x1f\x8b", "NIfTI" },
                    { "x.gz", "\x1f\x8b", "compressed by gzip" },
                    { "gz", "\x1f\x8b", "compressed by gzip" },
                    { "x.raw", "xy", "raw voxels need their size" } };
    char path[120];
    const char *base = getenv("TMPDIR");
    for (size_t i = 0; i < sizeof foreign / sizeof *foreign; i++) {
        lom_error error = { 0 };
        snprintf(path, sizeof path, "%.60s/lom-%ld-%s", base != NULL ? base : "/tmp", (long)getpid(), foreign[i].name);
        CHECK(lom_write_file(path, foreign[i].begin, 2, &error), "%s", error.text);
        CHECK(lom_read_volume(path, NULL, &error) == NULL && error.code == LOM_ERROR_INPUT &&
                  strstr(error.text, foreign[i].says) != NULL,
              "%s: %s", foreign[i].name, error.text);
        unlink(path);
    }
    lom_error error = { 0 };
    CHECK(lom_write_file(path, "abcdefghijkl", 12, &error), "%s", error.text);
    lom_image *volume = lom_read_volume(path, size, &error);
    CHECK(volume != NULL && volume->depth == 3 && memcmp(volume->pixels, "abcdefghijkl", 12) == 0, "%s", error.text);
    lom_free_image(volume);
    CHECK(lom_read_volume(path, other, &error) == NULL && strstr(error.text, "the file has 12") != NULL, "%s",
          error.text);
    error = (lom_error){ 0 };
    CHECK(lom_read_volume(path, empty, &error) == NULL && error.code == LOM_ERROR_USAGE, "%s", error.text);
    unlink(path);
    error = (lom_error){ 0 };
    CHECK(lom_read_volume(path, size, &error) == NULL && error.code == LOM_ERROR_FILE, "%s", error.text);
}

static void test_what_is_not_written(void)
{
    static const lom_format others[] = { LOM_FORMAT_R16F, LOM_FORMAT_DEPTH16, LOM_FORMAT_DEPTH32F };
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        lom_error error = { 0 };
        lom_image *image = lom_create_image(2, 2, 2, others[i], NULL);
        CHECK(lom_encode_image("nrrd", image, &error).data == NULL && error.code == LOM_ERROR_USAGE, "%s", error.text);
        lom_free_image(image);
    }
}

int main(int argc, char **argv)
{
    RUN(test_every_format_round_trips);
    RUN(test_headers_of_others);
    RUN(test_bad_volumes_are_refused);
    RUN(test_truncated_at_every_byte);
    RUN(test_raw_volumes_by_their_size);
    RUN(test_every_kind_at_every_place);
    RUN(test_unknown_kinds);
    RUN(test_fields_in_every_case);
    RUN(test_lines_and_bytes_to_skip);
    RUN(test_volumes_are_densities);
    RUN(test_volumes_of_other_files);
    RUN(test_what_is_not_written);
    return check_result();
}
