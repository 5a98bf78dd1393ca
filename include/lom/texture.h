/* lom/texture.h - textures: made from pixels or drawn into by a pass, and sampled over lanes.
 *
 * Coordinates: s runs right, t down, r back, each 0..1 over the texture; texel i of n has its centre at (i + 0.5) / n,
 * and (0, 0) is the outer corner of the first texel of the first row. Filtering is done in linear light (sRGB texels
 * are decoded first), in float, or 8-bit texels in fixed point where the sampler says so. The result
 * - lies within the range of the texels that contribute, and is the texel itself at its centre (where s * n is exact);
 * - is the same at every width, and defined for every coordinate: NaN samples as 0, and so does an infinite coordinate
 *   of a repeated or mirrored axis; on clamped axes infinities clamp.
 *
 * What filtering computes, per axis of n texels (* and + are rounded float operations):
 *   c = the wrapped coordinate (below); X = c * n + 0.5; k = trunc(X); f = min(X - k, 1 - 2^-23): texels k - 1 and k
 *   with weights 1 - f and f, as mix(a, b, f) = a + (b - a) f; first along s, then t, then r, then between levels.
 *   nearest: texel min(floor(c * n), n - 1).
 * 8-bit texels are filtered as the numbers 0..255; what comes out is divided by 255 at the very end.
 *
 * In fixed point (lom/fixed.h) X, k and the order of mixing are the same, and f is X - k. A byte counts as 128 times
 * itself and the light l of an sRGB code as round(32767 l) of 32767; what comes out is divided by 255 * 128 or 32767 at
 * the very end, so a texel at its centre is the same as in float, except for light, which is within 2^-16 of it. With n
 * mixes (one an axis, one between levels) the result is within n 2^-15 + 2^-16 + 2^-20 of the one in float, n 2^-15 +
 * 2^-20 where nothing is sRGB; the last covers the roundings of the float filter.
 */
#ifndef LOM_TEXTURE_H
#define LOM_TEXTURE_H

#include <lom/fixed.h>
#include <lom/image.h>
#include <lom/lanes.h>

LOM_API_BEGIN
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

typedef struct lom_texture lom_texture;

typedef enum lom_texture_kind {
    LOM_TEXTURE_2D = 0,
    LOM_TEXTURE_CUBE, /* six square faces: +X, -X, +Y, -Y, +Z, -Z, oriented as in OpenGL's table; seamless */
    LOM_TEXTURE_3D,
    LOM_TEXTURE_1D,       /* a row: a 2D texture of height 1 */
    LOM_TEXTURE_2D_ARRAY, /* layers of one size, with levels each; nothing is filtered from one layer to another */
    LOM_TEXTURE_1D_ARRAY, /* rows; a 2D array of height 1 */
    LOM_TEXTURE_KIND_COUNT
} lom_texture_kind;

typedef enum lom_mips {
    LOM_MIPS_NONE = 0, /* level 0 alone */
    LOM_MIPS_ALL,      /* every level down to 1 x 1, each the box-filtered one above it (rebuilt after a pass) */
    LOM_MIPS_SUPPLIED  /* level_pixels of the descriptor */
} lom_mips;

/* How texels are chosen within a level, and how levels are. */
typedef enum lom_filter {
    LOM_FILTER_DEFAULT = 0, /* linear; as the minification filter of a texture with levels: linear between levels too */
    LOM_FILTER_NEAREST,
    LOM_FILTER_LINEAR,
    LOM_FILTER_NEAREST_MIPMAP_NEAREST,
    LOM_FILTER_LINEAR_MIPMAP_NEAREST,
    LOM_FILTER_NEAREST_MIPMAP_LINEAR,
    LOM_FILTER_LINEAR_MIPMAP_LINEAR,
    LOM_FILTER_COUNT
} lom_filter;

/* What a coordinate outside 0..1 means. */
typedef enum lom_wrap {
    LOM_WRAP_REPEAT = 0, /* c = s - floor(s), exact (0 where that rounds to 1) */
    LOM_WRAP_MIRROR,     /* every second repetition is turned round: c = 1 - |1 - 2 fraction(|s| / 2)| */
    LOM_WRAP_CLAMP,      /* c = clamp(s, 0, 1): the edge texels go on */
    LOM_WRAP_BORDER,     /* beyond the edge everything is the border colour */
    LOM_WRAP_COUNT
} lom_wrap;

/* What compares with what is stored: the new depth of a draw, the reference of lom_sample_compare. */
typedef enum lom_compare {
    LOM_COMPARE_DEFAULT = 0, /* greater: nearer in reversed depth */
    LOM_COMPARE_NEVER,
    LOM_COMPARE_LESS,
    LOM_COMPARE_EQUAL,
    LOM_COMPARE_LESS_EQUAL,
    LOM_COMPARE_GREATER,
    LOM_COMPARE_NOT_EQUAL,
    LOM_COMPARE_GREATER_EQUAL,
    LOM_COMPARE_ALWAYS
} lom_compare;

typedef struct lom_sampler_desc {
    lom_filter minify;               /* where the level of detail is above 0 */
    lom_filter magnify;              /* elsewhere: DEFAULT, NEAREST or LINEAR */
    lom_wrap wrap_s, wrap_t, wrap_r; /* cubes ignore them */
    float border[4];                 /* linear light; rounded to the texture's format */
    float lod_bias;                  /* added to every level of detail */
    float lod_min, lod_max;          /* bounds of the sum; both 0: every level */
    lom_filtering filtering;         /* of 8-bit formats where a filter is linear; all else is filtered in float */
    int anisotropy;                  /* the most probes of lom_sample_gradient, up to 16; 0 is 1: isotropic */
} lom_sampler_desc;

/* The zero descriptor with a width and height is an RGBA8 texture of zeros, repeated, linearly filtered. */
typedef struct lom_texture_desc {
    lom_texture_kind kind;
    int width, height; /* 1..LOM_MAX_SIZE; of a cube equal; the height of rows is 0 or 1 */
    int depth;         /* of a 3D texture, or the layers of an array; 0 or 1 otherwise */
    lom_format format; /* NONE: RGBA8 */
    /* Level 0, tightly packed as in a lom_image (face after face, layer after layer); copied. NULL: zeros, a render
     * target. */
    const void *pixels;
    lom_mips mips;
    /* LOM_MIPS_SUPPLIED: level i + 1 at level_pixels[i], tightly packed, sizes max(1, size >> (i + 1)). */
    const void *const *level_pixels;
    int level_count; /* LOM_MIPS_SUPPLIED: levels with level 0; at most floor(log2(largest size)) + 1 */
    lom_sampler_desc sampler;
    /* Of a 2D target: passes of so many samples a pixel (2, 4, 8, 16) keep them with the texture, for the passes that go on
     * with LOM_LOAD_KEEP. 0 and 1: those begin from the texel in each sample. */
    int samples;
    /* A 2D DEPTH24 or DEPTH32F texture has 8 bits of stencil for each texel besides, zeros at first: D24S8 and D32FS8. What
     * is sampled and read is the depth. */
    bool stencil;
    const char *label; /* what records (lom/record.h) call it; not copied, stays valid with the texture; may be NULL */
} lom_texture_desc;

/* Makes a texture: pixels are converted exactly to what is sampled. In float formats NaN becomes 0 and magnitudes
 * above 2^123 (about FLT_MAX / 32) become that, so that no filter makes infinities. At most 2^31 - 1 texels with all
 * levels and 2^33 bytes. NULL on failure; freed with lom_free_texture. */
lom_texture *lom_create_texture(const lom_texture_desc *desc, lom_error *error);
/* The texture of a picture, with the default sampler: 3D when its depth is above 1, a cube or a 2D array when its slices
 * are such, else 2D. srgb: the numbers of an 8-bit picture are sRGB-encoded, whatever its format says. Where mips are
 * asked for and the picture has smaller levels, those are supplied. */
lom_texture *lom_texture_of_image(const lom_image *image, bool srgb, lom_mips mips, lom_error *error);
void lom_free_texture(lom_texture *texture); /* NULL is allowed */

/* One level as a picture in the texture's format. layer: the face of a cube, the slice of a 3D texture or the layer of an
 * array; -1: all of them, as the image's depth. */
lom_image *lom_read_texture(const lom_texture *texture, int level, int layer, lom_error *error);

/* Its stencil as an R8 picture, which another texture can be made from. NULL with an error where it has none, or
 * without memory. */
lom_image *lom_read_stencil(const lom_texture *texture, lom_error *error);

/* What a texture is. */
int lom_texture_width(const lom_texture *texture);
int lom_texture_height(const lom_texture *texture);
int lom_texture_depth(const lom_texture *texture);  /* of a 3D texture; 1 otherwise */
int lom_texture_layers(const lom_texture *texture); /* of an array; 6 of a cube; 1 otherwise */
int lom_texture_levels(const lom_texture *texture);
lom_format lom_texture_format(const lom_texture *texture);
const char *lom_texture_label(const lom_texture *texture); /* NULL: none */

/* ---- sampling: the functions of this width; use the inline ones below ---- */

void LOM_WIDE(lom_sample_lanes)(const lom_texture *texture, const lom_float2 *at, const lom_float *lod,
                                lom_float4 *out);
void LOM_WIDE(lom_sample_cube_lanes)(const lom_texture *texture, const lom_float3 *direction, const lom_float *lod,
                                     lom_float4 *out);
void LOM_WIDE(lom_sample_3d_lanes)(const lom_texture *texture, const lom_float3 *at, const lom_float *lod,
                                   lom_float4 *out);
void LOM_WIDE(lom_sample_array_lanes)(const lom_texture *texture, const lom_float3 *at, const lom_float *lod,
                                      lom_float4 *out);
void LOM_WIDE(lom_sample_gradient_lanes)(const lom_texture *texture, const lom_float2 *at,
                                         const lom_float derivative[4], lom_float4 *out);
void LOM_WIDE(lom_sample_gather_lanes)(const lom_texture *texture, const lom_float2 *at, int channel, lom_float4 *out);
void LOM_WIDE(lom_sample_compare_lanes)(const lom_texture *texture, const lom_float2 *at, const lom_float *reference,
                                        lom_compare compare, lom_float *out);
void LOM_WIDE(lom_sample_depth_lanes)(const lom_texture *texture, const lom_float2 *at, lom_float *out);
void LOM_WIDE(lom_fetch_lanes)(const lom_texture *texture, const lom_int *x, const lom_int *y, int level,
                               lom_float4 *out);
void LOM_WIDE(lom_lod_lanes)(const lom_texture *texture, const lom_float derivative[4], lom_float *lod);
void LOM_WIDE(lom_lod_3d_lanes)(const lom_texture *texture, const lom_float3 *dx, const lom_float3 *dy, lom_float *lod);

/* A 2D texture at (s, t). lod: 0 is level 0, each 1 more a level of half the size; the sampler's bias is added, then it
 * is clamped (NaN gives the smallest) and the magnification filter is used up to 0. Without mips lod only chooses
 * between the two filters. */
LOM_INLINE lom_float4 lom_sample(const lom_texture *texture, lom_float s, lom_float t, lom_float lod)
{
    lom_float2 at = { s, t };
    lom_float4 out;
    LOM_WIDE(lom_sample_lanes)(texture, &at, &lod, &out);
    return out;
}

/* A cube in a direction of any length from its centre: the axis of the largest magnitude is the face (ties: x before y
 * before z; a component that is 0 counts as positive), (0, 0, 0) and what divides to NaN the middle of its face. */
LOM_INLINE lom_float4 lom_sample_cube(const lom_texture *texture, lom_float3 direction, lom_float lod)
{
    lom_float4 out;
    LOM_WIDE(lom_sample_cube_lanes)(texture, &direction, &lod, &out);
    return out;
}

/* A 3D texture at (s, t, r). */
LOM_INLINE lom_float4 lom_sample_3d(const lom_texture *texture, lom_float s, lom_float t, lom_float r, lom_float lod)
{
    lom_float3 at = { s, t, r };
    lom_float4 out;
    LOM_WIDE(lom_sample_3d_lanes)(texture, &at, &lod, &out);
    return out;
}

/* A 2D array at (s, t) of a layer: the nearest whole number, ties to the even one, clamped to the first and last; NaN is
 * layer 0. */
LOM_INLINE lom_float4 lom_sample_array(const lom_texture *texture, lom_float s, lom_float t, lom_float layer,
                                       lom_float lod)
{
    lom_float3 at = { s, t, layer };
    lom_float4 out;
    LOM_WIDE(lom_sample_array_lanes)(texture, &at, &lod, &out);
    return out;
}

/* A 1D texture at s, and a layer of a 1D array: what 2D textures of height 1 give in the middle. */
LOM_INLINE lom_float4 lom_sample_1d(const lom_texture *texture, lom_float s, lom_float lod)
{
    return lom_sample(texture, s, lom_splat(0.5f), lod);
}

LOM_INLINE lom_float4 lom_sample_1d_array(const lom_texture *texture, lom_float s, lom_float layer, lom_float lod)
{
    return lom_sample_array(texture, s, lom_splat(0.5f), layer, lod);
}

/* A 2D texture at (s, t), whose change from a pixel to the next is (dsdx, dtdx) along x and (dsdy, dtdy) along y.
 * Where the sampler's anisotropy A is at most 1 it is lom_sample at the level of lom_lod_of. Else, after EXT_texture_-
 * filter_anisotropic and McCormack et al. (Feline, SIGGRAPH 1999), with P and p the longer and the shorter change in
 * texels of level 0 (squares clamped as by lom_lod_of; equal: x is the longer):
 *   the level of detail is log2(q), q = max(p, P / A), so that the shorter change decides unless P is A times longer;
 *   w = max(q, 1), and N = min(ceil(P / w), A) probes at that level lie along the longer change, evenly, the first and
 *   the last (P - w) / 2 from (s, t); the result is their mean, from the first to the last: m = mix(m, probe, 1 / (k + 1)).
 * So a round footprint is lom_sample, bit for bit, a constant stays one, and the result is in the range of the texels. */
LOM_INLINE lom_float4 lom_sample_gradient(const lom_texture *texture, lom_float s, lom_float t, lom_float dsdx,
                                          lom_float dtdx, lom_float dsdy, lom_float dtdy)
{
    const lom_float derivative[4] = { dsdx, dtdx, dsdy, dtdy };
    lom_float2 at = { s, t };
    lom_float4 out;
    LOM_WIDE(lom_sample_gradient_lanes)(texture, &at, derivative, &out);
    return out;
}

/* One channel (0..3; others are 0) of the four texels of level 0 of a 2D texture that a linear filter would mix at
 * (s, t), decoded: x left below, y right below, z right above, w left above, below being the greater t (the order of
 * OpenGL's and Direct3D's gather). */
LOM_INLINE lom_float4 lom_sample_gather(const lom_texture *texture, lom_float s, lom_float t, int channel)
{
    lom_float2 at = { s, t };
    lom_float4 out;
    LOM_WIDE(lom_sample_gather_lanes)(texture, &at, channel, &out);
    return out;
}

/* How much of a 2D texture's first channel around (s, t) `reference` compares with, at level 0: each texel counts 1
 * where (reference compare texel) holds, else 0, and these are filtered as the texels would be, with the magnification
 * filter in float. NaN compares as unequal. For shadow maps of reversed depth: LOM_COMPARE_GREATER_EQUAL is the light. */
LOM_INLINE lom_float lom_sample_compare(const lom_texture *texture, lom_float s, lom_float t, lom_float reference,
                                        lom_compare compare)
{
    lom_float2 at = { s, t };
    lom_float out;
    LOM_WIDE(lom_sample_compare_lanes)(texture, &at, &reference, compare, &out);
    return out;
}

/* The first channel of level 0 of a 2D texture, with the magnification filter. */
LOM_INLINE lom_float lom_sample_depth(const lom_texture *texture, lom_float s, lom_float t)
{
    lom_float2 at = { s, t };
    lom_float out;
    LOM_WIDE(lom_sample_depth_lanes)(texture, &at, &out);
    return out;
}

/* Texel (x, y) of a level of a 2D texture, decoded; indices outside are clamped to the edge, so is the level. */
LOM_INLINE lom_float4 lom_fetch(const lom_texture *texture, lom_int x, lom_int y, int level)
{
    lom_float4 out;
    LOM_WIDE(lom_fetch_lanes)(texture, &x, &y, level, &out);
    return out;
}

/* log2 of the larger of |d(s, t)/dx| and |d(s, t)/dy|, in texels of level 0 (OpenGL's isotropic rule; no bias). With
 * rho^2 = m 2^e clamped to [2^-126, FLT_MAX] (NaN: 2^-126) it is (e + P(m)) / 2, P a polynomial within 5e-5 of log2(m)
 * that is 0 at 1 and 1 at 2: exact at powers of two, within 2^-14 elsewhere. */
LOM_INLINE lom_float lom_lod_of(const lom_texture *texture, lom_float dsdx, lom_float dtdx, lom_float dsdy,
                                lom_float dtdy)
{
    const lom_float derivative[4] = { dsdx, dtdx, dsdy, dtdy };
    lom_float lod;
    LOM_WIDE(lom_lod_lanes)(texture, derivative, &lod);
    return lod;
}

/* The same of a 3D texture: dx and dy are the changes of (s, t, r). */
LOM_INLINE lom_float lom_lod_of_3d(const lom_texture *texture, lom_float3 dx, lom_float3 dy)
{
    lom_float lod;
    LOM_WIDE(lom_lod_3d_lanes)(texture, &dx, &dy, &lod);
    return lod;
}

#pragma GCC diagnostic pop
LOM_API_END

#endif
