/* lom/image.h - pictures, textures and how they are sampled; reading, writing and comparing pictures. */
#ifndef LOM_IMAGE_H
#define LOM_IMAGE_H

#include <lom/base.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- formats ---- */

/* Channels and the storage of each: unsigned normalised (8, 16), sRGB-encoded unsigned normalised (SRGB, alpha linear),
 * IEEE half (16F) and single (32F) floats. Missing channels read as 0, a missing alpha as 1. */
typedef enum lom_format {
    LOM_FORMAT_NONE = 0,
    LOM_FORMAT_R8,
    LOM_FORMAT_RG8,
    LOM_FORMAT_RGB8,
    LOM_FORMAT_RGBA8,
    LOM_FORMAT_R8_SRGB,
    LOM_FORMAT_RG8_SRGB,
    LOM_FORMAT_RGB8_SRGB,
    LOM_FORMAT_RGBA8_SRGB,
    LOM_FORMAT_R16,
    LOM_FORMAT_RG16,
    LOM_FORMAT_RGB16,
    LOM_FORMAT_RGBA16,
    LOM_FORMAT_R16F,
    LOM_FORMAT_RG16F,
    LOM_FORMAT_RGB16F,
    LOM_FORMAT_RGBA16F,
    LOM_FORMAT_R32F,
    LOM_FORMAT_RG32F,
    LOM_FORMAT_RGB32F,
    LOM_FORMAT_RGBA32F,
    LOM_FORMAT_DEPTH16,
    LOM_FORMAT_DEPTH24,
    LOM_FORMAT_DEPTH32F,
    LOM_FORMAT_COUNT
} lom_format;

typedef struct lom_format_info {
    const char *name; /* "RGBA8 sRGB" */
    int channels;     /* 1..4; 1 for depth */
    int bits;         /* of one sample in memory and in files: 8, 16, 32 (DEPTH24: 32 in memory, the low 24 used) */
    bool is_float, is_srgb, is_depth;
} lom_format_info;

/* The facts of a format; NULL when it is not one. */
const lom_format_info *lom_describe_format(lom_format format);
/* Bytes of one pixel in an image: channels * bits / 8. */
size_t lom_format_size(lom_format format);

/* ---- images: plain pixels in memory ---- */

/* Rows from the top, tightly packed, samples in the machine's byte order, slices (depth > 1) from z = 0.
 * A gray picture is R, gray with alpha is RG as far as files go. */
typedef struct lom_image {
    int width, height, depth;
    lom_format format;
    uint8_t *pixels; /* width * height * depth * lom_format_size(format) bytes */
} lom_image;

enum { LOM_MAX_SIZE = 32768 }; /* the largest width, height or depth of an image */

/* A black (all bytes 0) image; sizes 1..LOM_MAX_SIZE, at most 2^31 bytes. NULL on failure. Freed with lom_free_image.
 */
lom_image *lom_create_image(int width, int height, int depth, lom_format format, lom_error *error);
void lom_free_image(lom_image *image);
/* Bytes of all pixels. */
size_t lom_image_size(const lom_image *image);
/* The address of pixel (x, y) of slice z; inside the image. */
void *lom_image_pixel(const lom_image *image, int x, int y, int z);
/* Any format to any other, correctly rounded, sRGB decoded and encoded; a new image, NULL on failure. Missing channels
 * are 0, missing alpha 1; one channel to three is replicated, three to one is Rec. 709 luminance of linear light. */
lom_image *lom_convert_image(const lom_image *image, lom_format format, lom_error *error);
/* FNV-1a of "width height depth format" as 32-bit little-endian numbers and then the samples, little-endian, top row
 * first: the hash that `lom render --hash` and the golden tests print. */
uint64_t lom_hash_image(const lom_image *image);

/* Reads a picture from a file, by its content: PNG, PPM/PGM/PBM, PAM, PFM. Colour of 8 and 16 bits is stored as the
 * file has it (the _SRGB formats are never chosen; the caller says what the numbers mean with lom_reinterpret_image).
 */
lom_image *lom_read_image(const char *path, lom_error *error);
/* The same from memory; name is used in messages. */
lom_image *lom_decode_image(const uint8_t *data, size_t size, const char *name, lom_error *error);
/* Writes by the extension of path, or by kind ("png", "ppm", "pgm", "pam", "pfm") when that is not NULL. 8-bit and
 * 16-bit formats as they are, floats only to pfm (others need lom_convert_image first); ppm and pgm drop alpha. */
bool lom_write_image(const char *path, const char *kind, const lom_image *image, lom_error *error);
/* The same into memory; data is NULL on failure. */
lom_bytes lom_encode_image(const char *kind, const lom_image *image, lom_error *error);
/* Changes what the stored numbers mean, without touching them: between formats of equal channels and bits. */
bool lom_reinterpret_image(lom_image *image, lom_format format, lom_error *error);

#ifdef __cplusplus
}
#endif

#endif
