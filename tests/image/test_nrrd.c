/* Proves: volumes come back from NRRD files as they were written, in every format; headers of other programs are read
 * (types by any of their names, either byte order, comments, carriage returns, fields that say nothing here); every
 * damaged or lying file is refused in one sentence. */
#include "check.h"

#include <lom/image.h>

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

int main(int argc, char **argv)
{
    RUN(test_every_format_round_trips);
    RUN(test_headers_of_others);
    RUN(test_bad_volumes_are_refused);
    RUN(test_truncated_at_every_byte);
    RUN(test_raw_volumes_by_their_size);
    return check_result();
}
