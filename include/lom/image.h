/* lom/image.h - pictures, textures and how they are sampled; reading, writing and comparing pictures. */
#ifndef LOM_IMAGE_H
#define LOM_IMAGE_H

#include <lom/base.h>

LOM_API_BEGIN

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

/* What the slices of an image are. */
typedef enum lom_slices {
    LOM_SLICES_VOLUME = 0, /* of a volume, from z = 0; the one of a plain picture */
    LOM_SLICES_CUBE,       /* the faces of a cube: +X, -X, +Y, -Y, +Z, -Z */
    LOM_SLICES_LAYERS      /* pictures of one size */
} lom_slices;

/* Rows from the top, tightly packed, samples in the machine's byte order, slices (depth > 1) one behind the other.
 * A gray picture is R, gray with alpha is RG as far as files go. */
typedef struct lom_image {
    int width, height, depth;
    lom_format format;
    uint8_t *pixels; /* width * height * depth * lom_format_size(format) bytes */
    lom_slices slices;
    /* The next level of the mip chain that a file held (half the size, rounded down, at least 1; of a volume its depth,
     * too); belongs to this image. NULL: the last, or none were held. */
    struct lom_image *smaller;
} lom_image;

enum { LOM_MAX_SIZE = 32768 }; /* the largest width, height or depth of an image */
#define LOM_MAX_IMAGE_BYTES (UINT64_C(1) << 31)

/* A black (all bytes 0) image; sizes 1..LOM_MAX_SIZE, at most LOM_MAX_IMAGE_BYTES. NULL on failure. Freed with
 * lom_free_image, with its smaller levels. */
lom_image *lom_create_image(int width, int height, int depth, lom_format format, lom_error *error);
void lom_free_image(lom_image *image);
/* Levels with this one: 1 and those that are smaller. */
int lom_image_levels(const lom_image *image);
/* Bytes of all pixels of this level. */
size_t lom_image_size(const lom_image *image);
/* The address of pixel (x, y) of slice z; inside the image. */
void *lom_image_pixel(const lom_image *image, int x, int y, int z);
/* Any format to any other, correctly rounded, sRGB decoded and encoded; a new image with all levels, NULL on failure.
 * Missing channels are 0, missing alpha 1; one channel to three is replicated, three to one is Rec. 709 luminance of
 * linear light. */
lom_image *lom_convert_image(const lom_image *image, lom_format format, lom_error *error);
/* Of this level: FNV-1a of "width height depth format" as 32-bit little-endian numbers and then the samples, little-endian, top row
 * first: the hash that `lom render --hash` and the golden tests print. */
uint64_t lom_hash_image(const lom_image *image);

/* ---- files: a kind of picture file is a codec; docs/formats.md lists them ---- */

typedef struct lom_codec_info {
    const char *name;    /* in small letters: "png"; what `kind` is in the functions below */
    const char *title;   /* as it is spelled: "PNG" */
    const char *endings; /* of the names of its files, in small letters, separated by '|' */
    bool reads, writes;  /* lom_read_image takes it, lom_write_image makes it (a video: the functions of its own) */
    bool is_video;       /* frames one behind the other */
    bool holds_slices;   /* volumes, too */
    unsigned bits;       /* which samples it holds: the sum of 8 and 16 (unsigned normalised) and 32 (floats) */
    int channels[5];     /* [n]: how many n channels become in such a file; [0] is 0 */
} lom_codec_info;

/* The codecs from 0 on; NULL behind the last. */
const lom_codec_info *lom_describe_codec(size_t index);
/* The codec called kind, in capitals or not; the one of the path's ending when kind is NULL. NULL when there is none.
 */
const lom_codec_info *lom_find_codec(const char *path, const char *kind);

/* Reads a picture from a file, by its content: any codec that reads. Colour of 8 and 16 bits is stored as the file has
 * it (the _SRGB formats are never chosen; the caller says what the numbers mean with lom_reinterpret_image). */
lom_image *lom_read_image(const char *path, lom_error *error);
/* The same from memory; name is used in messages. */
lom_image *lom_decode_image(const uint8_t *data, size_t size, const char *name, lom_error *error);
/* Writes by the ending of path, or by the codec called kind when that is not NULL. The samples must be of bits that the
 * codec holds (else lom_convert_image comes first); alpha is dropped and gray made three equal channels where it has no
 * others. */
bool lom_write_image(const char *path, const char *kind, const lom_image *image, lom_error *error);
/* The same into memory; data is NULL on failure. */
lom_bytes lom_encode_image(const char *kind, const lom_image *image, lom_error *error);
/* A volume of density from a file: NRRD (raw or gzip; of several channels the last), or raw little-endian voxels, x
 * first, of 1, 2 or 4 (float) bytes each, whose size says how many there are (NULL or 0: none, NRRD only). R8, R16 or
 * R32F; floats are never NaN. NULL on failure; nothing is allocated for what a file only declares. */
lom_image *lom_read_volume(const char *path, const int size[3], lom_error *error);
/* The same from memory, raw. */
lom_image *lom_decode_raw_volume(const uint8_t *data, size_t size, int width, int height, int depth, const char *name,
                                 lom_error *error);
/* Changes what the stored numbers mean, without touching them: between formats of equal channels and bits. */
bool lom_reinterpret_image(lom_image *image, lom_format format, lom_error *error);

/* ---- comparison ----
 * Two pictures are compared in the format that holds both without loss: the wider of the bit depths (8-bit n becomes
 * 16-bit 257 n), floats when either is float or only one is sRGB-encoded, three colours when either has three (gray is
 * replicated; two channels are gray and alpha, as in files), alpha when either has it (missing alpha is 1). Unsigned
 * normalised formats differ in *steps*, 0 .. 2^bits - 1; floats in plain numbers. Equal means equal as numbers: -0 is
 * 0, a NaN equals a NaN and is infinitely far from any number. Large pictures are compared by lom_default_threads()
 * threads, which end with the call; the results depend neither on their number nor on the machine. */

typedef struct lom_comparison {
    bool same_size;     /* width, height and depth agree; if not, nothing below is set but format */
    bool identical;     /* no pixel differs */
    bool is_float;      /* the common format: floats, else steps */
    int channels, bits; /* of the common format */
    size_t pixels;      /* pixels with any differing sample, alpha included */
    double max_delta;   /* the largest difference of two samples: steps, or plain for floats; infinite with one NaN */
    int max_at[3];      /* x, y, z of its first place */
    int max_channel;    /* 0.. in the common format */
    int box[4];         /* x, y, width, height around all differing pixels of all slices; zeros when identical */
    double rmse;        /* root of the mean squared difference over the colour channels, in the unit of max_delta */
    double psnr;        /* 20 log10(peak / rmse) in decibels, peak 2^bits - 1 or 1.0; infinite when rmse is 0 */
} lom_comparison;

/* Compares every sample. False only when it could not be done (no memory, a format that is none); pictures of different
 * sizes are a result. */
bool lom_compare_images(const lom_image *a, const lom_image *b, lom_comparison *result, lom_error *error);

/* How many pixels have a sample that differs by more than `tolerance` (in the unit of max_delta), alpha included: with
 * 0 these are lom_comparison.pixels. Sizes must agree. */
bool lom_count_differing_pixels(const lom_image *a, const lom_image *b, double tolerance, size_t *pixels,
                                lom_error *error);

/* Structural similarity, 1 for equal pictures (Wang, Bovik, Sheikh, Simoncelli: Image Quality Assessment, IEEE TIP
 * 13(4), 2004): Gaussian window 11x11 with sigma 1.5, K1 0.01, K2 0.03, no downsampling, of the luma 0.299 R + 0.587 G
 * + 0.114 B of encoded samples. Only windows wholly inside the picture count, as in the authors' program; along a side
 * shorter than 11 every window counts, cut at the borders and its weights scaled back to a sum of 1. Floats are taken
 * as linear light, clamped to 0..1 (NaN is 0) and sRGB-encoded first. The mean over all slices. Sizes must agree. */
bool lom_compare_ssim(const lom_image *a, const lom_image *b, double *ssim, lom_error *error);

/* The mean of LDR FLIP, 0 for equal pictures, towards 1 for what nobody mistakes (Andersson, Nilsson, Akenine-Moller,
 * Oskarsson, Astrom, Fairchild: FLIP, Proc. ACM CGIT 3(2), 2020), at 67 pixels a degree (the paper's 0.7 m from a 0.7 m
 * wide monitor of 3840 pixels). Unsigned normalised samples are taken as sRGB-encoded, floats as linear light clamped
 * to 0..1 (NaN is 0). Beyond the border the nearest pixel is repeated. Alpha does not count. The mean over all slices.
 * Sizes must agree. */
bool lom_compare_flip(const lom_image *a, const lom_image *b, double *flip, lom_error *error);

/* A picture of the differences, RGB8: a channel is 0 where the samples are equal and 64 + 191 sqrt(d) where they differ
 * by d of the range (floats: by d, at most 1), so that one step in 65535 can be seen. A difference in alpha is shown in
 * all three channels. Pictures of different sizes are laid upon one another at the top left of the first slice: the
 * picture is as large as both together, and its pixels are (32, 32, 32), which no difference is, where only one of them
 * has a pixel, or none. NULL on failure, freed with lom_free_image. */
lom_image *lom_compare_picture(const lom_image *a, const lom_image *b, lom_error *error);

/* ---- video ---- */

/* YUV4MPEG2: the header once, then every frame, one behind the other in one file or pipe. 4:4:4, BT.601 in the
 * limited range, correctly rounded; alpha is dropped, gray is shown as gray. frames : seconds is the rate (30 : 1).
 * Frames are 8-bit pictures of the header's size whose numbers are sRGB-encoded. data is NULL on failure. */
lom_bytes lom_encode_y4m_header(int width, int height, int frames, int seconds, lom_error *error);
lom_bytes lom_encode_y4m_frame(const lom_image *image, lom_error *error);

LOM_API_END

#endif
