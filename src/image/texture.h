/* How a texture lies in memory. Every level has an apron of one texel on all sides (what lies beyond the edge by the
 * wrap mode), so that a sampler needs one index for its 2 x 2 (x 2) texels: +0, +1, +pitch, +pitch + 1 (+ slice).
 * The apron's left column is the right end of the row before: pitch is at least width + 2, and level.offset leaves room
 * for the row, the texel (and in 3D the slice) before the first. Rows of what a pass draws into begin with a cache
 * line, so that tiles share no line; what lies between the aprons of two rows is never read for its value. */
#ifndef LOM_IMAGE_TEXTURE_H
#define LOM_IMAGE_TEXTURE_H

#include <lom/texture.h>

typedef enum lom_storage {
    LOM_STORAGE_RGBA8,  /* uint32_t: r | g << 8 | b << 16 | a << 24 (sRGB formats: as encoded) */
    LOM_STORAGE_R32F,   /* float */
    LOM_STORAGE_RGBA32F /* 4 floats */
} lom_storage;

typedef struct lom_level {
    int width, height, depth;
    size_t pitch;  /* texels from a row to the next */
    size_t slice;  /* texels from a slice or cube face to the next */
    size_t offset; /* texel (0, 0) of slice 0 in texels[] */
} lom_level;

/* What a sampler needs of a 2D level or of a cube's, four words that lanes of different levels gather. */
typedef struct lom_level_row {
    float width, height;
    int32_t pitch, offset; /* of texel (-1, -1) of slice 0 (in 3D: of slice -1) */
} lom_level_row;

enum { LOM_MAX_LEVELS = 16 };

struct lom_texture {
    lom_texture_kind kind;
    lom_format format;
    lom_storage storage;
    int level_count;
    int layers; /* 6 for a cube, those of an array, else 1 */
    lom_level level[LOM_MAX_LEVELS];
    void *texels;             /* what a pass writes must be finite; missing channels 0, missing alpha 255 or 1 */
    lom_sampler_desc sampler; /* no DEFAULT filters any more */
    const char *label;
    bool srgb;        /* RGBA8 storage holds sRGB codes in r, g, b */
    bool builds_mips; /* lom_finish_texture makes levels 1.. from level 0 */
    /* Filtered in fixed point: 8-bit texels that are not all taken as the nearest. */
    bool fixed;
    /* The texels of an sRGB texture once more, decoded, at the same indices: 4 floats each, linear light and alpha
     * 0..255; in fixed point two words each, red and blue, green and alpha in 15 bits (sample_fixed.h). NULL where the
     * samplers decode as they go. The results are the same bits. */
    void *decoded;
    size_t texel_count; /* in texels[] */
    const void *owner;  /* the device that it was made with; NULL: none, it belongs to the caller */
    /* For the samplers: */
    bool gathers;                         /* by the processor's own (lom_has_fast_gathers): the same bits */
    bool nearest_within[2];               /* magnified, minified */
    bool nearest_between, linear_between; /* levels */
    bool plain; /* 2D, fixed or four floats, linear within levels and between those there are, and no border */
    float lod_min, lod_max;     /* within 0 .. level_count - 1, and the smallest lod may be below 0 */
    float level_min, level_max; /* lod_min and lod_max within 0 .. level_count - 1 */
    lom_level_row row[LOM_MAX_LEVELS];
    uint8_t *stencil; /* rows of level 0, one after the other, without an apron; NULL: none */
    /* What passes of `samples` samples a pixel left of them; 0: they keep none (pipeline/samples.c). */
    int samples;
    struct lom_kept_samples {
        uint8_t *memory; /* of the grid's tiles */
        uint8_t *held; /* a flag a tile: memory holds it, its stencil in a flag apart; else every sample is the texel */
        size_t capacity, held_capacity; /* in bytes */
        int edge, x0, y0;               /* of a tile; where the grid begins, relative to the texture's first pixel */
    } kept;
};

/* The pixels of an image's smaller levels, level i + 1 at pixels[i]; returns how many levels there are with the first. */
int lom_list_levels(const lom_image *image, const void *pixels[LOM_MAX_LEVELS]);
/* Level `level` from tightly packed pixels of the texture's format (texture_pixels.c). */
void lom_store_level(lom_texture *texture, int level, const void *pixels);
/* The same for some of its rows, counted through all layers. */
void lom_store_rows(lom_texture *texture, int level, const void *pixels, int first, int end);
/* Whether level 0 can be renewed from `size` bytes of such pixels; false with a sentence. */
bool lom_check_update(const lom_texture *texture, const void *pixels, size_t size, lom_error *error);
/* Level 0 from `size` bytes of such pixels, and what is made of it. False, and nothing is changed, when that is not
 * their size. */
bool lom_store_texture(lom_texture *texture, const void *pixels, size_t size, lom_error *error);
/* After level 0 was written: rebuilds its apron and, if the texture was made with LOM_MIPS_ALL, all levels. */
void lom_finish_texture(lom_texture *texture);

/* Slices of a level: its depth for a 3D texture, else the layers. */
int lom_level_layers(const lom_texture *texture, int level);
/* Bytes of a texel: 4 or 16. */
size_t lom_texel_size(const lom_texture *texture);
/* The address of texel (x, y) of a slice; each coordinate may be one outside, within the apron. */
void *lom_texel(const lom_texture *texture, int level, int x, int y, int layer);
/* The parts of lom_finish_texture, for those who hand out rows: rows first to end (one past the last) of a layer of
 * level `level`, from the level above it (mipmap.c); the apron's columns beside such rows, then, when all of those are
 * there, its first and last row (apron.c). In cubes and 3D textures the whole apron of a level. */
void lom_shrink_rows(lom_texture *texture, int level, int layer, int first, int end);
void lom_fill_columns(lom_texture *texture, int level, int layer, int first, int end);
/* The part of that which is made of the rows' first texels, or of their last ones. */
void lom_fill_column(lom_texture *texture, int level, int layer, int first, int end, bool of_last);
void lom_fill_rows(lom_texture *texture, int level, int layer);
void lom_fill_apron(lom_texture *texture, int level);
/* Of an apron what lies beside a face of a cube's level; before and behind the slices of one in 3D, at last. */
void lom_fill_face(lom_texture *texture, int level, int face);
void lom_fill_slices(lom_texture *texture, int level);
/* Texels `first` to `end` of texels[], of all levels and aprons, into `decoded`. */
void lom_decode_texels(const lom_texture *texture, size_t first, size_t end);
/* lom_create_texture without its last steps: the pixels that it is given for its levels, if any, are still to be stored,
 * and then lom_finish_texture to come. */
lom_texture *lom_begin_texture(const lom_texture_desc *desc, lom_error *error);
const void *lom_pixels_of_level(const lom_texture_desc *desc, int level);

#endif
