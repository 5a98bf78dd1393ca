/* lom/pipeline.h - the programmable pipeline: a device, shaders, and passes of draws into textures.
 *
 *   vertex -> clip -> setup -> bin -> raster -> fragment -> output
 *
 * Steps of use, in order: lom_open_device; lom_make_texture for each target and picture; then for every pass
 * lom_begin_pass, lom_draw as often as needed, lom_end_pass; lom_read_texture (lom/texture.h) for a picture to keep;
 * lom_close_device. Shaders are defined with LOM_SHADER in a file that lom-cc compiles. Calls after a failure do
 * nothing: it is enough to look at lom_end_pass or lom_device_error.
 *
 * Conventions: right-handed, column vectors; clip volume -w <= x, y <= w and 0 <= z <= w with reversed depth (1 at the
 * near plane) unless the pass says otherwise; window origin top left, pixel centres at .5; front faces
 * counter-clockwise as seen with y up.
 *
 * A pixel is a function of the draws and of its coordinates in the whole frame; not of threads, lanes, tile size, crop,
 * compiler or processor.
 */
#ifndef LOM_PIPELINE_H
#define LOM_PIPELINE_H

#include <lom/lanes.h>
#include <lom/texture.h>

LOM_API_BEGIN
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

/* ---- the device ---- */

typedef struct lom_device lom_device;

typedef struct lom_device_desc {
    int threads;             /* workers, 1..256; 0: as many as affinity and the cgroup quota allow */
    int lanes;               /* 4, 8 or 16; 0: the widest this processor has instructions for */
    bool plain;              /* lanes lowered to the baseline instructions even where the processor has wider ones */
    int tile;                /* tile edge in pixels: 16, 32 or 64; 0: 64 */
    int chunk;               /* triangles a unit of set-up work, 16..65536; 0: 8192 */
    int batch;               /* chunks between two sweeps over the tiles, 1..1024; 0: 32, of small draws up to 256 */
    lom_filtering filtering; /* FIXED: of all textures made with the device, whatever their samplers say */
} lom_device_desc;

/* Opens a device; the zero descriptor is a good one. Never NULL except when memory runs out: on another failure the
 * device holds the error and every call with it does nothing. Closed with lom_close_device. */
lom_device *lom_open_device(const lom_device_desc *desc);
/* Frees the device, its workers and everything made with it; NULL is allowed. */
void lom_close_device(lom_device *device);
/* The first error since the device was opened; code LOM_OK when there was none. */
const lom_error *lom_device_error(const lom_device *device);
/* What the device runs with: threads, lanes, plain, tile, chunk, batch, filtering, all resolved. */
lom_device_desc lom_describe_device(const lom_device *device);

/* lom_create_texture, owned by the device and freed with it; NULL (error on the device) on failure. */
lom_texture *lom_make_texture(lom_device *device, const lom_texture_desc *desc);
/* New pixels into a texture of the device, or into one of lom_create_texture, without allocating: as if it had been made
 * from them by the same descriptor, byte for byte (levels of LOM_MIPS_ALL too). pixels: level 0 in the texture's format,
 * tightly packed (cubes: face after face), copied; size: their bytes. False, with an error on the device and the
 * texture as it was: NULL, another size, a texture of another device, levels that were supplied, within a pass (whose
 * draws may read the texture). */
bool lom_update_texture(lom_device *device, lom_texture *texture, const void *pixels, size_t size);
/* Frees one texture before the device; NULL is allowed, one that the device did not make is an error on the device. */
void lom_release_texture(lom_device *device, lom_texture *texture);

/* Work done since the device was opened: what is not needed must show as zero here. */
typedef struct lom_counters {
    uint64_t passes, draws, vertices, triangles; /* triangles, sprites, points and lines submitted */
    uint64_t triangles_clipped;                  /* cut by near, far or the guard band */
    uint64_t triangles_binned; /* left after culling, with at least one pixel centre possibly inside */
    uint64_t fragments;        /* that passed the early depth test, or reached a shader */
    uint64_t packets;          /* calls of a fragment shader */
    uint64_t tiles;            /* tiles touched, a pass */
    uint64_t transforms;       /* Fourier transforms of a square, of a sea's fields */
} lom_counters;

lom_counters lom_device_counters(const lom_device *device);
/* Seconds by the clock in which two of the device's workers or more were at work, since it was opened: what is left of
 * a frame's time is its serial share, which bounds what more workers can gain. 0 with one thread, and for NULL. */
double lom_device_shared_seconds(const lom_device *device);

/* Occlusion queries: how many samples draws leave (OpenGL 4.6, 4.2.1). A query is named by draws (lom_draw_desc.query);
 * after lom_end_pass its result is the number of samples of all draws of that pass which name it, that passed stencil and
 * depth test and were not discarded; where nothing is tested, that were covered. It stays until another pass has such
 * draws. The same for any threads, lanes and tiles. */
typedef struct lom_query lom_query;

/* Owned by the device and freed with it; NULL (error on the device) on failure. */
lom_query *lom_make_query(lom_device *device);
/* Frees one before the device; NULL is allowed; within a pass, and of one of another device, it is an error. */
void lom_release_query(lom_device *device, lom_query *query);
/* False, and 0 samples, as long as no pass that ended had a draw with it. */
bool lom_query_result(const lom_query *query, uint64_t *samples);

/* ---- shaders ---- */

enum {
    LOM_MAX_ATTRIBUTES = 8,
    LOM_MAX_VARYINGS = 24,
    LOM_MAX_DISTANCES = 8, /* clip and cull distances together */
    LOM_MAX_COLORS = 4
};

/* What a vertex shader gets: LOM_LANES vertices. Missing components are 0, 0, 1 as in OpenGL (x, y, z, w = 0, 0, 0, 1).
 */
typedef struct lom_attributes {
    lom_float4 attribute[LOM_MAX_ATTRIBUTES];
    lom_int vertex;   /* the index as it stands in the index buffer plus base_vertex */
    lom_int instance; /* 0 .. instances - 1 */
} lom_attributes;

/* What it gives. */
typedef struct lom_vertex {
    lom_float4 position; /* clip space */
    lom_float varying[LOM_MAX_VARYINGS];
    lom_float distance[LOM_MAX_DISTANCES]; /* clip distances first, then cull distances */
    lom_float4 axis[2];   /* only with sprites; clip space, what to add to the position for half a side */
    lom_float point_size; /* only with LOM_POINTS: the side of the square in pixels; 1 when the shader starts */
} lom_vertex;

/* What a fragment shader gets: LOM_LANES fragments of one triangle or of several, in submission order. Lanes that are
 * not covered hold the values of a covered one (finite, never stored); in a shader that asks for quads they are the
 * helpers of its 2x2 quad. Only varyings that the shader reads are filled. */
typedef struct lom_varyings {
    lom_float varying[LOM_MAX_VARYINGS];
    lom_float x, y; /* window position of the pixel centre in the whole frame; only with reads_position */
    lom_float z;    /* depth as the depth test sees it, before the attachment's rounding; only with reads_position */
    lom_float w;    /* clip w; only with reads_position */
    lom_mask front; /* front facing; only with reads_position */
    lom_mask covered;
    /* Derivatives: of the two perspective-correct weights along window x and y, and of each differentiated varying the
     * differences of the triangle's vertices: df/dx = dx[0] delta[0][f] + dx[1] delta[1][f]. */
    lom_float dx[2], dy[2];
    lom_float delta[2][LOM_MAX_VARYINGS];
    lom_float st[2]; /* only with sprites and points: where on them, -1 to 1 along their axes; dx and dy are theirs */
    lom_float target_depth;          /* only with reads_depth: what the attachment holds at the pixel */
    struct lom_known_levels *levels; /* the library's: where all of these derivatives are those of the whole triangle */
} lom_varyings;

/* What it gives. discard is clear and depth is z when the shader starts. */
typedef struct lom_fragment {
    lom_float4 color[LOM_MAX_COLORS]; /* linear light; clamped and encoded by the attachment's format */
    lom_float depth;                  /* only with writes_depth */
    lom_mask discard;                 /* only with discards */
} lom_fragment;

typedef void lom_vertex_function(lom_vertex *out, const lom_attributes *in, const void *uniforms);
typedef void lom_fragment_function(lom_fragment *out, const lom_varyings *in, const void *uniforms);

/* `count` varyings (1..LOM_MAX_VARYINGS) from `first` on, as a mask of bits: what reads, differentiates, flat and
 * screen_linear are made of. */
#define LOM_VARYINGS(first, count) (0xffffffffu >> (32 - (count)) << (first))

/* A shader and what it needs; what it does not declare it cannot do. Made with LOM_SHADER. */
typedef struct lom_shader {
    const char *name;
    lom_vertex_function *vertex[LOM_VARIANTS];     /* NULL where it was not built at that width */
    lom_fragment_function *fragment[LOM_VARIANTS]; /* all NULL: depth only */
    int attributes;                                /* read by the vertex shader: 0 .. attributes - 1 */
    int varyings;                                  /* written by the vertex shader */
    int clip_distances, cull_distances;
    uint32_t reads;          /* LOM_VARYINGS: the fragment shader reads them */
    uint32_t differentiates; /* it takes their derivatives; part of reads */
    uint32_t flat;           /* they are the provoking vertex's (lom_provoking), not interpolated */
    /* Interpolated linearly in the window, as depth is (GLSL's noperspective), where flat does not have them; none of them
     * in differentiates. With the weights l of the window f0 + l1 (f1 - f0) + l2 (f2 - f0), clamped to the three values.
     * Where near, far or the guard band cut an edge f w is linear in clip space, so f = ((1 - t) wa fa + t wb fb) / w:
     * the cut changes no value, whatever the signs of wa and wb. */
    uint32_t screen_linear;
    bool reads_position; /* x, y, z, w, front */
    bool discards, writes_depth;
    bool quads; /* general derivatives: packets of whole 2x2 quads aligned to even frame coordinates */
    int colors; /* outputs written */
    size_t uniforms_size;
    bool sprites;     /* for LOM_SPRITES */
    bool round;       /* of sprites and points: covers s^2 + t^2 < 1 alone */
    bool reads_depth; /* target_depth; in passes with depth, in draws that write none */
} lom_shader;

/* Analytic derivative of varying v along window x (right) and y (down); v in differentiates. */
LOM_INLINE lom_float lom_dx(const lom_varyings *in, int v)
{
    return in->dx[0] * in->delta[0][v] + in->dx[1] * in->delta[1][v];
}

LOM_INLINE lom_float lom_dy(const lom_varyings *in, int v)
{
    return in->dy[0] * in->delta[0][v] + in->dy[1] * in->delta[1][v];
}

/* What lom_lod calls. */
void LOM_WIDE(lom_find_level)(const lom_texture *texture, const lom_varyings *in, int s, int t, lom_float *lod);

/* Level of detail of a texture for coordinates that are the varyings s and t, both in differentiates: lom_lod_of of their
 * derivatives. */
LOM_INLINE lom_float lom_lod(const lom_texture *texture, const lom_varyings *in, int s, int t)
{
    lom_float lod;
    LOM_WIDE(lom_find_level)(texture, in, s, t, &lod);
    return lod;
}

/* Level of detail of a texture of which a sprite shows `width` x `height`, in texture coordinates: s + width st[0] / 2,
 * t + height st[1] / 2. */
LOM_INLINE lom_float lom_sprite_lod(const lom_texture *texture, const lom_varyings *in, float width, float height)
{
    const float s = 0.5f * width, t = 0.5f * height;
    return lom_lod_of(texture, in->dx[0] * s, in->dx[1] * t, in->dy[0] * s, in->dy[1] * t);
}

/* Differences of any value within each 2x2 quad (right minus left, lower minus upper); only in shaders with quads. */
LOM_INLINE lom_float lom_quad_dx(lom_float value)
{
    lom_float difference = { 0 };
    for (int i = 0; i < LOM_LANES; i++)
        difference[i] = value[i | 1] - value[i & ~1];
    return difference;
}

LOM_INLINE lom_float lom_quad_dy(lom_float value)
{
    lom_float difference = { 0 };
    for (int i = 0; i < LOM_LANES; i++)
        difference[i] = value[i | 2] - value[i & ~2];
    return difference;
}

/* LOM_SHADER(name, vertex, fragment, .varyings = 2, ...) defines the shader `name` from two static functions of this
 * file. LOM_DEPTH_SHADER has no fragment function. A file that is compiled once (at LOM_LANES) gives a shader of that
 * width; the command lom-cc compiles it at every width (-DLOM_ALL_LANES) and joins the objects: the 4-lane one defines
 * the shader. In C++ (17 or newer), too, outside of namespaces. */
#ifdef __cplusplus
#define LOM_SHADER_EXTERN extern "C"
#else
#define LOM_SHADER_EXTERN extern
#endif
#define LOM_SHADER_ENTRY(kind, name, function, out_type, in_type)                                                      \
    LOM_SHADER_EXTERN void LOM_WIDE(name##_##kind##_entry)(out_type * out, const in_type *in, const void *uniforms);   \
    void LOM_WIDE(name##_##kind##_entry)(out_type * out, const in_type *in, const void *uniforms)                      \
    {                                                                                                                  \
        function(out, in, uniforms);                                                                                   \
    }
#define LOM_SHADER_VERTEX_ENTRY(name, variant) LOM_SHADER_EXTERN lom_vertex_function name##_vertex_entry_##variant;
#define LOM_SHADER_FRAGMENT_ENTRY(name, variant)                                                                       \
    LOM_SHADER_EXTERN lom_fragment_function name##_fragment_entry_##variant;
#define LOM_SHADER_EXPAND(X, name, variant) X(name, variant)
#if !defined LOM_ALL_LANES
#define LOM_SHADER_EACH(X, name) LOM_SHADER_EXPAND(X, name, LOM_VARIANT)
#elif defined LOM_HAS_RECORDED
#define LOM_SHADER_EACH(X, name) LOM_EACH_VARIANT(X, name) X(name, 4_recorded)
#else
#define LOM_SHADER_EACH(X, name) LOM_EACH_VARIANT(X, name)
#endif
/* Where there is no recorded variant, watched passes are drawn with the 4 lanes, which name no values; a file that is
 * compiled in that variant alone is drawn with it. */
#if LOM_LANES == 4 && defined LOM_RECORD
#define LOM_SHADER_OTHER_SLOT LOM_SLOT_4
#elif LOM_LANES == 4 && !(defined LOM_ALL_LANES && defined LOM_HAS_RECORDED)
#define LOM_SHADER_OTHER_SLOT LOM_SLOT_4_recorded
#endif
#if defined LOM_ALL_LANES && (LOM_LANES != 4 || defined LOM_RECORD)
#define LOM_SHADER_DEFINE(name, slots, ...)
#define LOM_SHADER_DECLARE(X, name)
#else
#define LOM_SHADER_DECLARE(X, name) LOM_SHADER_EACH(X, name)
#ifdef __cplusplus
/* C++ has no designators of array elements, nor any in any order: there members are assigned, up to 16, each `.member =
 * value` after the name of a shader. The initialiser is a constant all the same. */
#define LOM_SHADER_VERTEX_SLOT(name, variant)   shader.vertex[LOM_SLOT_##variant] = name##_vertex_entry_##variant;
#define LOM_SHADER_FRAGMENT_SLOT(name, variant) shader.fragment[LOM_SLOT_##variant] = name##_fragment_entry_##variant;
#define LOM_SHADER_OTHER(slot, kind, entry)     shader.kind[slot] = entry;
#define LOM_SHADER_DEFINE(shader_name, slots, ...)                                                                     \
    extern const lom_shader shader_name;                                                                               \
    const lom_shader shader_name = [] {                                                                                \
        lom_shader shader = {};                                                                                        \
        shader.name = #shader_name;                                                                                    \
        slots LOM_SHADER_MEMBERS(__VA_ARGS__) return shader;                                                           \
    }();
/* clang-format off */
#define LOM_SHADER_MEMBERS(...) LOM_SHADER_MEMBERS_OF(__VA_ARGS__, \
    LOM_SHADER_16, LOM_SHADER_15, LOM_SHADER_14, LOM_SHADER_13, LOM_SHADER_12, LOM_SHADER_11, LOM_SHADER_10, LOM_SHADER_9, \
    LOM_SHADER_8, LOM_SHADER_7, LOM_SHADER_6, LOM_SHADER_5, LOM_SHADER_4, LOM_SHADER_3, LOM_SHADER_2, LOM_SHADER_1, )(__VA_ARGS__)
#define LOM_SHADER_MEMBERS_OF(_1, _2, _3, _4, _5, _6, _7, _8, _9, _10, _11, _12, _13, _14, _15, _16, assign, ...) assign
#define LOM_SHADER_1(member) shader member;
#define LOM_SHADER_2(member, ...) shader member; LOM_SHADER_1(__VA_ARGS__)
#define LOM_SHADER_3(member, ...) shader member; LOM_SHADER_2(__VA_ARGS__)
#define LOM_SHADER_4(member, ...) shader member; LOM_SHADER_3(__VA_ARGS__)
#define LOM_SHADER_5(member, ...) shader member; LOM_SHADER_4(__VA_ARGS__)
#define LOM_SHADER_6(member, ...) shader member; LOM_SHADER_5(__VA_ARGS__)
#define LOM_SHADER_7(member, ...) shader member; LOM_SHADER_6(__VA_ARGS__)
#define LOM_SHADER_8(member, ...) shader member; LOM_SHADER_7(__VA_ARGS__)
#define LOM_SHADER_9(member, ...) shader member; LOM_SHADER_8(__VA_ARGS__)
#define LOM_SHADER_10(member, ...) shader member; LOM_SHADER_9(__VA_ARGS__)
#define LOM_SHADER_11(member, ...) shader member; LOM_SHADER_10(__VA_ARGS__)
#define LOM_SHADER_12(member, ...) shader member; LOM_SHADER_11(__VA_ARGS__)
#define LOM_SHADER_13(member, ...) shader member; LOM_SHADER_12(__VA_ARGS__)
#define LOM_SHADER_14(member, ...) shader member; LOM_SHADER_13(__VA_ARGS__)
#define LOM_SHADER_15(member, ...) shader member; LOM_SHADER_14(__VA_ARGS__)
#define LOM_SHADER_16(member, ...) shader member; LOM_SHADER_15(__VA_ARGS__)
/* clang-format on */
#else
#define LOM_SHADER_VERTEX_SLOT(name, variant)   .vertex[LOM_SLOT_##variant] = name##_vertex_entry_##variant,
#define LOM_SHADER_FRAGMENT_SLOT(name, variant) .fragment[LOM_SLOT_##variant] = name##_fragment_entry_##variant,
#define LOM_SHADER_OTHER(slot, kind, entry)     .kind[slot] = entry,
#define LOM_SHADER_DEFINE(shader_name, slots, ...)                                                                     \
    extern const lom_shader shader_name;                                                                               \
    const lom_shader shader_name = { .name = #shader_name, slots __VA_ARGS__ };
#endif
#endif
#ifdef LOM_SHADER_OTHER_SLOT
#define LOM_SHADER_OTHER_VERTEX(name) LOM_SHADER_OTHER(LOM_SHADER_OTHER_SLOT, vertex, LOM_WIDE(name##_vertex_entry))
#define LOM_SHADER_OTHER_FRAGMENT(name)                                                                                \
    LOM_SHADER_OTHER(LOM_SHADER_OTHER_SLOT, fragment, LOM_WIDE(name##_fragment_entry))
#else
#define LOM_SHADER_OTHER_VERTEX(name)
#define LOM_SHADER_OTHER_FRAGMENT(name)
#endif
#define LOM_SHADER(name, vertex_function, fragment_function, ...)                                                      \
    LOM_SHADER_ENTRY(vertex, name, vertex_function, lom_vertex, lom_attributes)                                        \
    LOM_SHADER_ENTRY(fragment, name, fragment_function, lom_fragment, lom_varyings)                                    \
    LOM_SHADER_DECLARE(LOM_SHADER_VERTEX_ENTRY, name)                                                                  \
    LOM_SHADER_DECLARE(LOM_SHADER_FRAGMENT_ENTRY, name)                                                                \
    LOM_SHADER_DEFINE(name,                                                                                            \
                      LOM_SHADER_EACH(LOM_SHADER_VERTEX_SLOT, name) LOM_SHADER_EACH(LOM_SHADER_FRAGMENT_SLOT, name)    \
                          LOM_SHADER_OTHER_VERTEX(name) LOM_SHADER_OTHER_FRAGMENT(name),                               \
                      __VA_ARGS__)
#define LOM_DEPTH_SHADER(name, vertex_function, ...)                                                                   \
    LOM_SHADER_ENTRY(vertex, name, vertex_function, lom_vertex, lom_attributes)                                        \
    LOM_SHADER_DECLARE(LOM_SHADER_VERTEX_ENTRY, name)                                                                  \
    LOM_SHADER_DEFINE(name, LOM_SHADER_EACH(LOM_SHADER_VERTEX_SLOT, name) LOM_SHADER_OTHER_VERTEX(name), __VA_ARGS__)

/* ---- samples ---- */

enum { LOM_MAX_SAMPLES = 16 };

/* Where sample `i` of `samples` lies in its pixel, from the centre, right and down, in 1/16 of a pixel (-8..7): the
 * standard patterns of Direct3D 11.3 (19.2.4, D3D11_STANDARD_MULTISAMPLE_PATTERN), which are Vulkan's standard sample
 * locations. samples: 1 (the centre), 2, 4, 8, 16. False, and the centre, for others and for an i that is none. */
bool lom_sample_position(int samples, int i, int position[2]);

/* A pass of n samples tests coverage, clip distances and depth at each of them, exactly as at centres (a primitive that
 * covers a sample of a pixel owns it by the same top-left rule), and keeps n colours and depths a pixel.
 * - Shading: the fragment shader runs once for a pixel that the primitive covers a sample of, at the centre where the
 *   primitive covers that, else at its first sample that the primitive covers (before the depth test); in shaders that
 *   ask for quads at the centre always. Its colours go to all samples that are covered and pass. Varyings, window
 *   position, depth and target_depth are those of the place of shading, target_depth of the centre is sample 0's. With
 *   draw.per_sample it runs for each sample, at the sample.
 * - Depths are the triangle's at each sample; one that the shader writes counts for all samples of the fragment.
 * - Resolve: a texel is the mean of the pixel's samples in linear light: 8-bit codes the whole number nearest to the mean
 *   (the upper one of two); sRGB codes are decoded, and the mean is encoded, each rounded to nearest; floats are added in
 *   pairs, (s0 + s1) + (s2 + s3) and so on, and rounded to the format. The depth is that of sample 0. */

/* ---- edges ---- */

/* The other way to smooth edges, beside samples: what a pass draws with one sample a pixel says where its triangles end
 * (lom_pass_desc.edges), and lom_smooth_edges mixes each pixel with what lies beyond. After Malan, "Edge Anti-aliasing by
 * Post-Processing" (GPU Pro, 2010), and Persson's geometric anti-aliasing (2011).
 *
 * Where the fragment that a pixel shows belongs to a triangle, its texel of `edges` says how far the triangle reaches from
 * the pixel's centre to the right (red), left (green), down (blue) and up (alpha), along the row and the column of centres:
 * a distance of d pixels is the number d / (1 + d), rounded to nearest in 255 steps, so that none is too long and those
 * below a pixel are known to 1/255 to 4/255 of it. d is the least l / -s of the triangle's weights l, s what they change by a pixel
 * that way, those below 0, and of the sums of clip distances that cut the triangle. 1 is nothing: of clear values, and of
 * sprites, points and lines. Draws that write depth write it, under the same tests and discards as their colours; others
 * leave it. */

/* ---- passes ---- */

typedef struct lom_rect {
    int x, y, width, height; /* in pixels of the whole frame; width 0: everything */
} lom_rect;

typedef enum lom_load_action {
    LOM_LOAD_CLEAR = 0, /* start from the clear value */
    LOM_LOAD_KEEP       /* start from what the attachment holds */
} lom_load_action;

typedef enum lom_clip_range {
    LOM_CLIP_ZERO_TO_W = 0, /* 0 <= z <= w, depth = z / w */
    LOM_CLIP_MINUS_W_TO_W   /* -w <= z <= w, depth = (z / w + 1) / 2 (OpenGL) */
} lom_clip_range;

/* What of a texture a pass draws into: a level of a 2D texture, of a layer of an array, or of a face of a cube (+x,
 * -x, +y, -y, +z, -z). */
typedef struct lom_slice {
    int level, layer;
} lom_slice;

typedef struct lom_pass_desc {
    lom_texture *color
        [LOM_MAX_COLORS]; /* 2D textures, arrays or cubes, made without pixels; NULL from the first unused one on */
    lom_texture *depth;   /* depth format; NULL: no depth test */
    lom_texture
        *edges; /* 2D, RGBA8, at least one colour unused; 1 sample: where triangles end, above; NULL: not kept */
    lom_slice color_slice[LOM_MAX_COLORS], depth_slice; /* all of one size; zero: level 0 of the first layer */
    int samples;                                        /* of a pixel, lom_sample_position; 0: 1 */
    bool per_sample;                                    /* of all its draws */
    int frame_width, frame_height;                      /* the whole frame; 0: the attachments' size */
    int origin_x, origin_y;                             /* the frame's pixel that the attachments' pixel (0, 0) is */
    lom_rect viewport; /* of the frame, of draws that name none; empty: the whole frame; at most 32768 x 32768 */
    lom_rect scissor;  /* of the frame: pixels outside keep their clear value (or their content) */
    lom_clip_range clip_range;
    float min_depth, max_depth; /* of draws that name none; both 0: 0 and 1 */
    lom_load_action color_load[LOM_MAX_COLORS], depth_load, stencil_load;
    lom_load_action edges_load;           /* cleared, edges are 1 */
    float clear_color[LOM_MAX_COLORS][4]; /* linear light */
    float clear_depth;                    /* 0 is the far plane of reversed depth */
    uint8_t clear_stencil;                /* of depth attachments that have a stencil */
    bool feedback_only; /* no attachments: its draws fill feedback (lom/stages.h) and nothing is rasterized */
    const char *label;  /* what records (lom/record.h) call the pass; not copied; may be NULL */
} lom_pass_desc;

/* Begins a pass, ended by lom_end_pass; one at a time a device. A texture of another device is no attachment of it. */
void lom_begin_pass(lom_device *device, const lom_pass_desc *desc);
/* Runs the pass: when it returns the attachments are complete, and of those drawn into at level 0 the other levels
 * of the same layer are built (LOM_MIPS_ALL); a pass into another level changes that level alone. False when the
 * device holds an error; attachments are then unspecified. */
bool lom_end_pass(lom_device *device);

/* ---- draws ---- */

/* LOM_SPRITES: a parallelogram a vertex, for what faces the eye: particles, icons, glyphs. Its middle m is the vertex'
 * window position, snapped to 1/256 of a pixel as those of triangles are; its half sides a and b are the images of
 * axis[0] and axis[1] by the derivative of the projection at the middle, in pixels. A pixel centre p = m + s a + t b is
 * covered where -1 <= s, t < 1, less than a pixel from m - |a| - |b| to m + |a| + |b| along x and y. With D = a.x b.y - a.y b.x, in float and in this order, s = (p.x - m.x) (b.y / D) +
 * (p.y - m.y) (-b.x / D), t = (p.x - m.x) (-a.y / D) + (p.y - m.y) (a.x / D). Depth and all varyings are the vertex'
 * own. Nothing is clipped: a vertex that lies outside near, far, the guard band or a clip or cull distance is not
 * drawn, nor is a sprite with |D| below 2^-16 or half sides above 2^16 pixels. Facing, culling and depth bias do not
 * apply.
 *
 * LOM_POINTS: a square a vertex, of any shader that is not for sprites. Its side is point_size, rounded to 1/256 of a
 * pixel (to even), at most 32768; 1/512 and less, and NaN: nothing. A pixel centre p is covered where m - size / 2 <= p <
 * m + size / 2 along x and y, exactly, m the snapped window position; so a point of size 1 is one pixel. With `round` s^2
 * + t^2 < 1, too. s points right, t down: (st + 1) / 2 is OpenGL's gl_PointCoord. With h = size / 2, in float: s = (p.x -
 * m.x) (h / (h h)), t likewise. Depth, varyings, samples and what is not drawn: as of sprites. Derivatives of varyings
 * are 0. OpenGL 4.6, 14.4 "Points" and 13.7 (a point is clipped by its centre).
 *
 * LOM_LINES, two vertices each, and LOM_LINE_STRIP, each vertex joined to the one before it. Lines are cut by near, far
 * and the guard band as the edges of triangles are, and by clip distances pixel by pixel. The two ends a, b are snapped to
 * 1/256 of a pixel and moved by (-e, -e^2), e > 0 smaller than all else. Exactly those pixels are covered whose diamond,
 * |x - x0| + |y - y0| < 1/2 about the centre, the segment from a to b meets, but does not end in: OpenGL 4.6, 14.5.1
 * "Basic Line Segment Rasterization", here with y down. So each vertex inside a strip has its pixel once. A line is
 * x-major where |b.x - a.x| >= |b.y - a.y|; of width k an x-major one is moved up by (k - 1) / 2 pixels, and each
 * pixel becomes the first of k that lie under one another; a y-major one is moved to the left, and they lie side by side
 * (14.5.2.1 "Wide Lines"). At the pixel centre p is t = (p - a) (b - a) / |b - a|^2, clamped to 0..1, from exact whole
 * numbers, rounded to float by one product with the rounded reciprocal of |b - a|^2; depth is z_a + t (z_b - z_a),
 * varyings are perspective-correct as those of triangles are, with the weights 1 - t and t; flat ones are b's (lom_provoking). In passes of
 * several samples a covered pixel has all of them, with what the centre has; per_sample does not apply. Front facing;
 * culling does not apply, nor does depth bias. */
typedef enum lom_topology {
    LOM_TRIANGLES = 0,
    LOM_TRIANGLE_STRIP,
    LOM_TRIANGLE_FAN,
    LOM_SPRITES,
    LOM_POINTS,
    LOM_LINES,
    LOM_LINE_STRIP,
    LOM_PATCHES /* patch_points vertices each, for tessellation (lom/stages.h) */
} lom_topology;

typedef enum lom_attribute_kind {
    LOM_ATTRIBUTE_NONE = 0,
    LOM_ATTRIBUTE_FLOAT1,
    LOM_ATTRIBUTE_FLOAT2,
    LOM_ATTRIBUTE_FLOAT3,
    LOM_ATTRIBUTE_FLOAT4,
    LOM_ATTRIBUTE_UNORM8X4
} lom_attribute_kind;

/* The vertex whose flat varyings a primitive has: its first or its last, of places in the index buffer from 0 on (OpenGL
 * 4.6, table 13.2 "Provoking vertex selection"; Vulkan 1.3, 27.5 "Provoking Vertex").
 *
 *   primitive i of                            first     last
 *   points, sprites                           i         i
 *   lines                                     2i        2i + 1
 *   line strip                                i         i + 1
 *   triangles                                 3i        3i + 2
 *   triangle strip                            i         i + 2
 *   triangle fan (its centre is 0)            i + 1     i + 2
 *
 * Of what stages of lom/stages.h make it is the last one; their draws are refused the first. */
typedef enum lom_provoking { LOM_PROVOKING_LAST = 0, LOM_PROVOKING_FIRST } lom_provoking;

typedef struct lom_attribute {
    const void *data; /* of vertex 0; not copied: stays valid until lom_end_pass */
    size_t size;      /* bytes readable from data */
    size_t stride;    /* bytes from vertex to vertex; 0: one value for all vertices */
    lom_attribute_kind kind;
} lom_attribute;

typedef enum lom_cull { LOM_CULL_NONE = 0, LOM_CULL_BACK, LOM_CULL_FRONT } lom_cull;

typedef enum lom_factor {
    LOM_FACTOR_ZERO = 0,
    LOM_FACTOR_ONE,
    LOM_FACTOR_SOURCE_COLOR,
    LOM_FACTOR_ONE_MINUS_SOURCE_COLOR,
    LOM_FACTOR_SOURCE_ALPHA,
    LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA,
    LOM_FACTOR_TARGET_COLOR,
    LOM_FACTOR_ONE_MINUS_TARGET_COLOR,
    LOM_FACTOR_TARGET_ALPHA,
    LOM_FACTOR_ONE_MINUS_TARGET_ALPHA,
    LOM_FACTOR_CONSTANT_COLOR, /* of the draw's blend_constant */
    LOM_FACTOR_ONE_MINUS_CONSTANT_COLOR,
    LOM_FACTOR_CONSTANT_ALPHA,
    LOM_FACTOR_ONE_MINUS_CONSTANT_ALPHA,
    LOM_FACTOR_SOURCE_ALPHA_SATURATE, /* colours: min(source alpha, 1 - target alpha); alpha: 1 */
    LOM_FACTOR_SECOND_COLOR,          /* of the second source: the shader's color[1] */
    LOM_FACTOR_ONE_MINUS_SECOND_COLOR,
    LOM_FACTOR_SECOND_ALPHA,
    LOM_FACTOR_ONE_MINUS_SECOND_ALPHA,
    LOM_FACTOR_COUNT
} lom_factor;

typedef enum lom_blend_operation {
    LOM_BLEND_ADD = 0,
    LOM_BLEND_SUBTRACT,         /* source - target */
    LOM_BLEND_REVERSE_SUBTRACT, /* target - source */
    LOM_BLEND_MIN,              /* factors ignored */
    LOM_BLEND_MAX,
    LOM_BLEND_OPERATION_COUNT
} lom_blend_operation;

/* result = source * source_factor (operation) target * target_factor, for colour and for alpha. Into 8-bit unorm the
 * source, the second source and the constant are rounded to the format first and the sum is rounded once (exact); into
 * sRGB they are clamped to 0..1, and sRGB and float attachments blend in float. Two sources: the pass has one colour
 * attachment and the shader two colours, of which the second is stored nowhere. OpenGL 4.6, 17.3.6 "Blending". */
typedef struct lom_blend {
    bool enabled;
    lom_factor source_color, target_color, source_alpha, target_alpha;
    lom_blend_operation color_operation, alpha_operation;
} lom_blend;

/* Logical operations on the bits of source s and target d, in place of blending: OpenGL 4.6, 17.3.9, table 17.3. Of
 * 8-bit unorm attachments alone; the source is rounded to the format first. */
typedef enum lom_logic {
    LOM_LOGIC_OFF = 0,
    LOM_LOGIC_CLEAR,         /* 0 */
    LOM_LOGIC_AND,           /* s & d */
    LOM_LOGIC_AND_REVERSE,   /* s & ~d */
    LOM_LOGIC_COPY,          /* s */
    LOM_LOGIC_AND_INVERTED,  /* ~s & d */
    LOM_LOGIC_NOTHING,       /* d */
    LOM_LOGIC_XOR,           /* s ^ d */
    LOM_LOGIC_OR,            /* s | d */
    LOM_LOGIC_NOR,           /* ~(s | d) */
    LOM_LOGIC_EQUIVALENT,    /* ~(s ^ d) */
    LOM_LOGIC_INVERT,        /* ~d */
    LOM_LOGIC_OR_REVERSE,    /* s | ~d */
    LOM_LOGIC_COPY_INVERTED, /* ~s */
    LOM_LOGIC_OR_INVERTED,   /* ~s | d */
    LOM_LOGIC_NAND,          /* ~(s & d) */
    LOM_LOGIC_SET,           /* all ones */
    LOM_LOGIC_COUNT
} lom_logic;

/* What becomes of the stored s: OpenGL 4.6, 17.3.3 "Stencil Test". */
typedef enum lom_stencil_operation {
    LOM_STENCIL_KEEP = 0,
    LOM_STENCIL_ZERO,
    LOM_STENCIL_REPLACE,        /* the reference */
    LOM_STENCIL_INCREMENT,      /* min(s + 1, 255) */
    LOM_STENCIL_DECREMENT,      /* max(s - 1, 0) */
    LOM_STENCIL_INVERT,         /* ~s */
    LOM_STENCIL_INCREMENT_WRAP, /* (s + 1) modulo 256 */
    LOM_STENCIL_DECREMENT_WRAP, /* (s - 1) modulo 256 */
    LOM_STENCIL_OPERATION_COUNT
} lom_stencil_operation;

/* The test passes where the reference compares with what is stored, both without the bits of read_off. */
typedef struct lom_stencil_face {
    lom_compare compare;                          /* DEFAULT: always */
    lom_stencil_operation fail, depth_fail, pass; /* where it fails; where depth does after it; where both pass */
    uint8_t reference;
    uint8_t read_off, write_off; /* bits that are not compared, not written */
} lom_stencil_face;

/* Of each sample, after the shader's discard and alpha to coverage, before the depth test. A sample that fails writes
 * neither colour nor depth. Where depth is not tested it passes. Needs a depth attachment with stencil. */
typedef struct lom_stencil {
    bool enabled;
    bool two_sided;               /* triangles that face back have `back`; else all have `front` */
    lom_stencil_face front, back; /* sprites, points and lines face front */
} lom_stencil;

/* Clusters of a mesh: its triangles in runs, with the box around the vertices of each. A draw that has them leaves out
 * those of which nothing can be seen before it touches a vertex; no pixel changes. */
typedef struct lom_clusters lom_clusters;

/* Of positions (LOM_ATTRIBUTE_FLOAT3) and `count` indices of 32 bits, three a triangle, all of vertices that exist;
 * neither is kept. NULL with an error for others, or without memory. Freed with lom_free_clusters, after the passes that
 * draw them. */
lom_clusters *lom_create_clusters(const lom_attribute *positions, const uint32_t *indices, size_t count,
                                  lom_error *error);
void lom_free_clusters(lom_clusters *clusters); /* NULL is allowed */

/* What a draw says of its shader so that clusters can be left out; it is relied on. */
typedef struct lom_culling {
    const lom_clusters *clusters;          /* of the draw's indices, all of them; NULL: nothing is left out */
    lom_matrix_uniform clip_from_position; /* a vertex lies at its product with (p, 1), p the position that the clusters
                                              were made of, up to 8 roundings of a float, relative to the sum of the terms */
    float distance[4]; /* likewise clip distance 0: the sum of distance[i] p[i] and distance[3]; zeros: none */
} lom_culling;

/* Polygon offset. Every fragment's depth gets, before it is tested, m depth_bias_slope + r depth_bias, and is clamped
 * to 0..1; both factors 0: nothing is added. Positive moves towards depth 1, which is nearer in reversed depth. m =
 * max(|dz/dx|, |dz/dy|) of the triangle, a pixel; r is the step of the attachment: 1 / 65535 for DEPTH16, 1 / 16777215
 * for DEPTH24, 2^(e - 23) for DEPTH32F where e is the exponent of the triangle's largest depth. Formulas, clamp and its
 * NaN: OpenGL 4.6, 14.6.5 "Depth Offset"; Vulkan 1.3 "Depth Bias"; Direct3D 11.3, 15.10. A depth that the shader writes
 * gets nothing. Bit for bit the nearest depth to (z + offset), rounded once. */
typedef struct lom_draw_desc {
    const lom_shader *shader;
    const void *uniforms; /* uniforms_size bytes, copied */
    lom_attribute attribute[LOM_MAX_ATTRIBUTES];
    const void *indices; /* NULL: 0, 1, 2 ..., all of them vertices that exist; not copied: valid until lom_end_pass */
    int index_bits;      /* 16 or 32; 0: 32 */
    size_t count;        /* indices (or vertices) to draw; a rest that makes no triangle is ignored */
    size_t first;        /* first index (or vertex) */
    int32_t base_vertex; /* added to every index */
    bool restart;        /* the largest index value starts a new strip or fan; of sprites and points it is no vertex */
    size_t vertex_count; /* vertices that exist: a larger index drops its triangle; 0: what the attributes hold */
    int instances;       /* 0: 1; each draws all of the indices, one after the other */
    /* Of each attribute. 0: a value a vertex. n > 0: a value for n instances, for all their vertices: that of instance i is
     * number i / n, and there are enough of them (glVertexAttribDivisor). */
    int divisor[LOM_MAX_ATTRIBUTES];
    lom_topology topology;
    lom_provoking provoking;
    int line_width; /* of lines, in pixels: 1..64; 0: 1 */
    lom_cull cull;
    bool front_clockwise;
    lom_compare depth_compare;
    bool depth_test_off; /* nothing tested, nothing written */
    bool depth_write_off;
    /* Near and far do not cut: what lies before or behind them has the depth of the one or the other (then the depth bias).
     * w > 0 still cuts. OpenGL 4.6, 13.7 and 17.3.5 (DEPTH_CLAMP). Sprites and points are drawn if w > 0. */
    bool depth_clamp;
    lom_stencil stencil;
    lom_query *query; /* counts its samples; NULL: none */
    /* The draw is left out where this query's result is 0 when lom_draw is called (`condition_inverted`: is not 0), that is,
     * as a pass that has ended left it; an error where none has. OpenGL 4.6, 10.9 "Conditional Rendering". NULL: none. */
    const lom_query *condition;
    bool condition_inverted;
    float depth_bias;       /* units r; finite */
    float depth_bias_slope; /* times the slope m; finite */
    float depth_bias_clamp; /* most (or, negative, least) that is added; 0 and NaN: no limit */
    lom_blend blend[LOM_MAX_COLORS];
    float blend_constant[4];          /* linear light; finite */
    lom_logic logic;                  /* of all attachments, which are then not blended; OFF: none */
    uint8_t mask_off[LOM_MAX_COLORS]; /* bit 0 red .. bit 3 alpha: not written */
    lom_rect scissor;                 /* of the frame, within the pass's; width 0: the pass's */
    /* Where -w <= x, y <= w lies in the frame, and which depths 0 <= z <= w has (or -w <= z: lom_clip_range), in
     * 0..1 and in either order. Draws of one pass may have several: OpenGL 4.6, 13.8.1 "Controlling the Viewport".
     * Triangles and lines end at its edges; of sprites, points and wide lines, too, what lies beside it is not
     * drawn. As large and as far off as the pass's may be; a draw of another is an error. Width 0: the pass's; both
     * depths 0: the pass's. */
    lom_rect viewport;
    float min_depth, max_depth;
    bool per_sample; /* the fragment shader runs for each sample */
    /* Of a fragment the samples 0..k - 1 alone may be written, k = floor(n a + 1/2) of the pass's n samples, a the first
     * colour's alpha, clamped to 0..1 (NaN: 0). With one sample: where a is 1/2 or more. Depth is tested after the shader. */
    bool alpha_to_coverage;
    const char *label; /* what records (lom/record.h) say is drawn; not copied; may be NULL */
    int object;        /* a number of the caller's for it, in records */
    lom_culling
        culling; /* with clusters: LOM_TRIANGLES, indices of 32 bits, no first, base_vertex, restart; 1 instance. Not used
                    with depth_clamp, nor by a shader with flat varyings where the first vertex is provoking */
    /* lom/stages.h; NULL: none. Not copied: valid until lom_end_pass. */
    const struct lom_tessellation *tessellation; /* with LOM_PATCHES, and no patches without it */
    int patch_points;                            /* vertices of a patch, 1..32 */
    const struct lom_geometry *geometry;
    struct lom_feedback *feedback;
    /* In place of count: the vertices that an earlier pass has written into it, when this pass runs. */
    const struct lom_feedback *count_from;
} lom_draw_desc;

/* Adds a draw to the pass. A bad descriptor is an error on the device and draws nothing. */
void lom_draw(lom_device *device, const lom_draw_desc *desc);

/* What a pass with `edges` has left, of one size: level 0 of 2D textures. */
typedef struct lom_edge_filter {
    const lom_texture *color, *edges, *depth; /* the depth reversed: 0 is the farthest */
    int origin_x, origin_y;                   /* the frame's pixel that pixel (0, 0) of these is */
} lom_edge_filter;

/* Adds a draw to the pass at hand, into another texture, of whose pixels each gets the filter's colour with the light of its
 * four neighbours, by the part of the pixel that lies beyond an edge between the two: exactly, for one straight edge of a
 * known triangle before something farther. An edge is where depths of neighbours jump by more than 1/64 of the nearer one
 * and by more than twice the lesser of the slopes on either side; of all other pixels the colour is the filter's. A pixel depends on those that are
 * up to two pixels away. The filter is not copied: its textures live until lom_end_pass. Formulas: docs/samples.md. */
void lom_smooth_edges(lom_device *device, const lom_edge_filter *filter);

#pragma GCC diagnostic pop
LOM_API_END

#endif
