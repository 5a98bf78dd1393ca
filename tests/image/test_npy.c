/* Proves that an NPY file is what numpy.lib.format says of version 1.0: magic, a header that is a dictionary, padded so that
 * the data begin on 64 bytes; then the samples, little-endian, the top row first. */
#include "check.h"

#include <lom/lom.h>

static void check_file(lom_format format, const char *dictionary, const void *samples, size_t size,
                       const uint8_t *expected)
{
    lom_image *image = lom_create_image(3, 2, 1, format, NULL);
    CHECK(lom_image_size(image) == size);
    memcpy(image->pixels, samples, size);
    lom_bytes file = lom_encode_image("npy", image, NULL);
    CHECK(file.data != NULL && file.size > size && (file.size - size) % 64 == 0);
    size_t start = file.size - size, length = file.data[8] | (size_t)file.data[9] << 8;
    CHECK(memcmp(file.data, "\x93NUMPY\x01\x00", 8) == 0 && length + 10 == start && file.data[start - 1] == '\n');
    CHECK(memcmp(file.data + 10, dictionary, strlen(dictionary)) == 0, "%.60s", (const char *)file.data + 10);
    for (size_t i = 10 + strlen(dictionary); i + 1 < start; i++)
        CHECK(file.data[i] == ' ', "byte %zu", i);
    CHECK(memcmp(file.data + start, expected, size) == 0);
    lom_release(file.data);
    lom_free_image(image);
}

static void arrays_have_the_samples_in_order(void)
{
    const uint8_t bytes[6] = { 0, 1, 2, 253, 254, 255 };
    const uint16_t deep[6] = { 0, 1, 0x1234, 0xabcd, 0xfffe, 0xffff };
    const uint8_t deep_bytes[12] = { 0, 0, 1, 0, 0x34, 0x12, 0xcd, 0xab, 0xfe, 0xff, 0xff, 0xff };
    float floats[18];
    uint8_t float_bytes[72];
    for (int i = 0; i < 18; i++) { /* 1.0 is 0x3f800000; the next powers of two add 0x00800000 */
        uint32_t bits = 0x3f800000u + 0x00800000u * (uint32_t)i;
        memcpy(&floats[i], &bits, sizeof bits);
        for (int k = 0; k < 4; k++)
            float_bytes[4 * i + k] = (uint8_t)(bits >> 8 * k);
    }
    check_file(LOM_FORMAT_R8, "{'descr': '|u1', 'fortran_order': False, 'shape': (2, 3), }", bytes, 6, bytes);
    check_file(LOM_FORMAT_R16, "{'descr': '<u2', 'fortran_order': False, 'shape': (2, 3), }", deep, 12, deep_bytes);
    check_file(LOM_FORMAT_RGB32F, "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3, 3), }", floats, 72,
               float_bytes);
}

int main(int argc, char **argv)
{
    RUN(arrays_have_the_samples_in_order);
    return check_result();
}
