/* The codecs behind lom_decode_image and lom_encode_image, a pair of functions each. `name` is the file's name
 * for messages. Decoders get data that begins with their format's signature and return NULL on failure; encoders get a
 * picture of depth 1 and return data NULL on failure. */
#ifndef LOM_IMAGE_CODEC_H
#define LOM_IMAGE_CODEC_H

#include <lom/image.h>

lom_image *lom_decode_png(const uint8_t *data, size_t size, const char *name, lom_error *error);
lom_image *lom_decode_pnm(const uint8_t *data, size_t size, const char *name, lom_error *error); /* P1..P6 */
lom_image *lom_decode_pam(const uint8_t *data, size_t size, const char *name, lom_error *error);
lom_image *lom_decode_pfm(const uint8_t *data, size_t size, const char *name, lom_error *error);

lom_image *lom_decode_dds(const uint8_t *data, size_t size, const char *name, lom_error *error);
lom_image *lom_decode_ktx(const uint8_t *data, size_t size, const char *name, lom_error *error);
lom_image *lom_decode_nrrd(const uint8_t *data, size_t size, const char *name, lom_error *error);
lom_image *lom_decode_qoi(const uint8_t *data, size_t size, const char *name, lom_error *error);

lom_bytes lom_encode_png(const lom_image *image, lom_error *error);
lom_bytes lom_encode_ppm(const lom_image *image, lom_error *error);
lom_bytes lom_encode_pgm(const lom_image *image, lom_error *error);
lom_bytes lom_encode_pam(const lom_image *image, lom_error *error);
lom_bytes lom_encode_pfm(const lom_image *image, lom_error *error);
lom_bytes lom_encode_nrrd(const lom_image *image, lom_error *error); /* any depth */
lom_bytes lom_encode_dds(const lom_image *image, lom_error *error);  /* any depth and levels */
lom_bytes lom_encode_qoi(const lom_image *image, lom_error *error);
lom_bytes lom_encode_npy(const lom_image *image, lom_error *error);

/* Whether text is one of the words of a list separated by '|', in capitals or not, whatever the locale. */
bool lom_is_word(const char *text, size_t length, const char *list);

/* The codec whose file begins like this, NULL for none. */
const lom_codec_info *lom_recognize_codec(const uint8_t *data, size_t size);

/* The unorm format of 1..4 channels and 8 or 16 bits. */
lom_format lom_unorm_format(int channels, int bits);

/* Checks the declared sizes and that width * height * channels samples of sample_bits bits, compressed or not at most
 * 1 : ratio, can come out of `available` bytes; only then makes the picture. So a short file cannot ask for much. */
lom_image *lom_create_declared(const char *name, uint64_t width, uint64_t height, lom_format format,
                               uint64_t sample_bits, uint64_t ratio, uint64_t available, lom_error *error);

#endif
