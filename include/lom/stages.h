/* lom/stages.h - the stages of a draw between its vertices and clipping, each of them optional:
 *
 *   vertex -> control -> generator -> evaluation -> geometry -> feedback -> clip ...
 *             \______ tessellation _____________/
 *
 * A draw names them beside its shader (lom_draw_desc: tessellation, geometry, feedback); one that names none pays for
 * none. Their functions get the shader's uniforms, and all of them hand on the varyings, distances and point size that
 * the shader declares, as its vertex function does. They run over lanes as shaders do: what is LOM_LANES patches or
 * primitives side by side is a number of them in order, and what each makes stands behind what the one before it made,
 * whatever the threads do.
 */
#ifndef LOM_STAGES_H
#define LOM_STAGES_H

#include <lom/pipeline.h>

LOM_API_BEGIN
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

enum {
    LOM_MAX_PATCH_POINTS = 32, /* vertices of a patch */
    LOM_MAX_LEVEL = 64,        /* segments of an edge */
    LOM_MAX_EMITTED = 64       /* vertices that a geometry function makes of a primitive */
};

/* ---- tessellation ---- */

/* What a patch is cut into. Triangles: u, v, w >= 0 with u + v + w = 1, the weights of three corners; outer level 0 cuts
 * the edge u = 0, level 1 v = 0, level 2 w = 0, inner level 0 the inside. Quads: u and v in 0..1; outer levels 0 to 3 cut
 * the edges u = 0, v = 0, u = 1, v = 1, inner level 0 the inside along u, level 1 along v. Isolines: outer level 0 is the
 * number n of lines, v = i / n for i = 0 .. n - 1, level 1 cuts each of them along u. OpenGL 4.6, 11.2.2.1 to 11.2.2.3. */
typedef enum lom_domain { LOM_DOMAIN_TRIANGLES = 0, LOM_DOMAIN_QUADS, LOM_DOMAIN_ISOLINES } lom_domain;

/* How an edge of level f has n segments (OpenGL 4.6, 11.2.2 "Tessellation Primitive Generation"). EQUAL: f is clamped to
 * 1..most, n is f rounded up, all are equal. FRACTIONAL_EVEN: clamped to 2..most, n the next even number; FRACTIONAL_ODD:
 * to 1..most, the next odd one: n - 2 segments of the length 1 / f and one at either end that is shorter. The lines of
 * isolines are equal always. An inner level of 1 whose patch is cut elsewhere counts as a little more than 1. Inner levels
 * that are NaN or below count as the least; a patch of which an outer level that matters is NaN, 0 or less makes nothing. */
typedef enum lom_spacing { LOM_SPACING_EQUAL = 0, LOM_SPACING_FRACTIONAL_EVEN, LOM_SPACING_FRACTIONAL_ODD } lom_spacing;

/* What control gets: LOM_LANES patches. Lanes behind the last patch repeat it. */
typedef struct lom_patch {
    const lom_vertex *point; /* `points` of them, as the vertex function gave them: point[i] is point i of each patch */
    int points;
    lom_int number; /* of the patch in its instance, from 0 */
    lom_int instance;
} lom_patch;

/* What it gives: how finely each patch is cut. */
typedef struct lom_levels {
    lom_float outer[4], inner[2];
} lom_levels;

/* What evaluation gets: LOM_LANES places of patches. Each coordinate is a multiple of 2^-24, so that u + v + w = 1 and
 * 1 - u are exact; those along an outer edge follow from its level alone, and with u there is 1 - u. So patches that
 * share an edge meet without a crack where the levels on it are one number, and what evaluation computes of the edge is
 * the same from both sides and for both directions (OpenGL 4.6, appendix A.4 "Tessellation Invariance"). */
typedef struct lom_domain_point {
    lom_float u, v, w; /* w: of triangles, else 0 */
    lom_patch patch;
    lom_levels levels;
} lom_domain_point;

typedef void lom_control_function(lom_levels *out, const lom_patch *in, const void *uniforms);
typedef void lom_evaluation_function(lom_vertex *out, const lom_domain_point *in, const void *uniforms);

/* Both functions and what lies between them; for draws of LOM_PATCHES. Made with LOM_TESSELLATION. */
typedef struct lom_tessellation {
    const char *name;
    lom_control_function *control[LOM_VARIANTS];
    lom_evaluation_function *evaluation[LOM_VARIANTS];
    lom_domain domain;
    lom_spacing spacing;
    bool clockwise; /* triangles are turned round: without, they are counter-clockwise where u points right and v up; of
                       triangles, where the corners of u, v, w are */
    bool points;    /* a point for each place instead of triangles or lines */
    int most; /* levels are at most that, 1..LOM_MAX_LEVEL; 0: LOM_MAX_LEVEL. Patches of low levels share a chunk */
} lom_tessellation;

/* ---- geometry ---- */

/* What a geometry function gets: LOM_LANES primitives, of a list, a strip, a fan or tessellation. Lanes behind the last
 * one repeat it. */
typedef struct lom_geometry_input {
    const lom_vertex *vertex; /* vertex[k] is vertex k of each: 1 of points, 2 of lines, 3 of triangles */
    lom_int number;           /* of the primitive in its instance, from 0; of what tessellation made, the patch's */
    lom_int instance;
} lom_geometry_input;

/* Where a geometry function puts its vertices (lom_emit_vertex, lom_end_strip). */
typedef struct lom_primitive_stream {
    float *rows; /* LOM_LANES * most rows, lane by lane, and one that nobody reads */
    int pitch, most, varyings, distances;
    lom_mask alive; /* lanes that are primitives */
    lom_mask begun; /* lanes whose next vertex joins a strip */
    lom_int count;  /* vertices a lane */
} lom_primitive_stream;

/* It runs LOM_LANES primitives at a time since what a primitive makes is mostly the same work with other numbers; a
 * lane that makes less is left out by the mask of lom_emit_vertex. */
typedef void lom_geometry_function(lom_primitive_stream *out, const lom_geometry_input *in, const void *uniforms);

/* A geometry function and what it turns into what. Made with LOM_GEOMETRY. */
typedef struct lom_geometry {
    const char *name;
    lom_geometry_function *geometry[LOM_VARIANTS];
    lom_topology in;  /* LOM_POINTS, LOM_LINES or LOM_TRIANGLES: what strips and fans are of, too */
    lom_topology out; /* LOM_POINTS, LOM_LINE_STRIP or LOM_TRIANGLE_STRIP */
    int vertices;     /* emitted of a primitive at most, 1..LOM_MAX_EMITTED; those beyond are dropped */
} lom_geometry;

/* Words of a row of what the stages hand to one another: position, then point size and whether it joins a strip, then the
 * varyings and the distances, each padded to 4. */
enum { LOM_ROW_SIZE = 4, LOM_ROW_VARYINGS = 8 };

/* Appends a vertex to what the primitives in the lanes of `which` make. */
LOM_INLINE void lom_emit_vertex(lom_primitive_stream *to, const lom_vertex *vertex, lom_mask which)
{
    which &= to->alive & (to->count < to->most);
    lom_int row = lom_select_int(which, lom_lane_index() * to->most + to->count, lom_splat_int(LOM_LANES * to->most));
    lom_int at = row * to->pitch;
    lom_float zero = { 0 }, joins = lom_select(to->begun, lom_splat(1), zero);
    lom_float4 size = { vertex->point_size, joins, zero, zero };
    lom_scatter_rows(to->rows, at, vertex->position);
    lom_scatter_rows(to->rows + LOM_ROW_SIZE, at, size);
    float *rest = to->rows + LOM_ROW_VARYINGS;
    for (int i = 0; i < to->varyings; i += 4) {
        const lom_float *v = vertex->varying + i;
        lom_float4 four = { v[0], v[1], v[2], v[3] };
        lom_scatter_rows(rest + i, at, four);
    }
    rest += (to->varyings + 3) & ~3;
    for (int i = 0; i < to->distances; i += 4) {
        const lom_float *d = vertex->distance + i;
        lom_float4 four = { d[0], d[1], d[2], d[3] };
        lom_scatter_rows(rest + i, at, four);
    }
    to->count -= which; /* a mask is -1 where it is set */
    to->begun |= which;
}

/* The next vertex of the lanes begins a strip of its own. */
LOM_INLINE void lom_end_strip(lom_primitive_stream *to, lom_mask which)
{
    to->begun &= ~which;
}

/* ---- feedback ---- */

/* Keeps the vertices of the primitives of a draw (three a triangle, two a line, one a point), as the last of its stages
 * left them and before clipping, in the order of the primitives (OpenGL 4.6, 13.3 "Transform Feedback"). Strips and
 * fans become lists. The draws of a pass that name one buffer fill it one after the other, from its start; the first primitive
 * that does not fit, and all after it, are counted alone. Without lom_pass_desc.feedback_only they are drawn as well. */
typedef struct lom_feedback {
    float *data;       /* the caller's, valid until lom_end_pass; no draw of the same pass reads it */
    size_t size;       /* bytes */
    bool position;     /* each vertex begins with its clip position, x, y, z, w */
    uint32_t varyings; /* LOM_VARYINGS: then these follow, tightly packed */
    size_t written;    /* vertices in data, of whole primitives: set when the pass has run */
    size_t needed;     /* vertices that there were: more than `written` where the buffer is too small for a primitive */
} lom_feedback;

/* Bytes of a vertex in the buffer: the stride of attributes that read it. */
size_t lom_feedback_stride(const lom_feedback *feedback);

/* ---- definitions ---- */

/* LOM_TESSELLATION(name, control, evaluation, .domain = ..., ...) and LOM_GEOMETRY(name, function, .in = ..., ...) define
 * stages from static functions of this file, as LOM_SHADER does shaders. */
#define LOM_CONTROL_ENTRY(name, variant)    LOM_SHADER_EXTERN lom_control_function name##_control_entry_##variant;
#define LOM_EVALUATION_ENTRY(name, variant) LOM_SHADER_EXTERN lom_evaluation_function name##_evaluation_entry_##variant;
#define LOM_GEOMETRY_ENTRY(name, variant)   LOM_SHADER_EXTERN lom_geometry_function name##_geometry_entry_##variant;
#define LOM_CONTROL_SLOT(name, variant)     LOM_SHADER_OTHER(LOM_SLOT_##variant, control, name##_control_entry_##variant)
#define LOM_EVALUATION_SLOT(name, variant)                                                                             \
    LOM_SHADER_OTHER(LOM_SLOT_##variant, evaluation, name##_evaluation_entry_##variant)
#define LOM_GEOMETRY_SLOT(name, variant) LOM_SHADER_OTHER(LOM_SLOT_##variant, geometry, name##_geometry_entry_##variant)
#if defined LOM_ALL_LANES && (LOM_LANES != 4 || defined LOM_RECORD)
#define LOM_STAGE_DEFINE(type, stage_name, slots, ...)
#elif defined __cplusplus
#define LOM_STAGE_DEFINE(type, stage_name, slots, ...)                                                                 \
    extern const type stage_name;                                                                                      \
    const type stage_name = [] {                                                                                       \
        type shader = {};                                                                                              \
        shader.name = #stage_name;                                                                                     \
        slots LOM_SHADER_MEMBERS(__VA_ARGS__) return shader;                                                           \
    }();
#else
#define LOM_STAGE_DEFINE(type, stage_name, slots, ...)                                                                 \
    extern const type stage_name;                                                                                      \
    const type stage_name = { .name = #stage_name, slots __VA_ARGS__ };
#endif
#ifdef LOM_SHADER_OTHER_SLOT
#define LOM_STAGE_OTHER(kind, name) LOM_SHADER_OTHER(LOM_SHADER_OTHER_SLOT, kind, LOM_WIDE(name##_##kind##_entry))
#else
#define LOM_STAGE_OTHER(kind, name)
#endif
#define LOM_TESSELLATION(name, control_function, evaluation_function, ...)                                             \
    LOM_SHADER_ENTRY(control, name, control_function, lom_levels, lom_patch)                                           \
    LOM_SHADER_ENTRY(evaluation, name, evaluation_function, lom_vertex, lom_domain_point)                              \
    LOM_SHADER_DECLARE(LOM_CONTROL_ENTRY, name)                                                                        \
    LOM_SHADER_DECLARE(LOM_EVALUATION_ENTRY, name)                                                                     \
    LOM_STAGE_DEFINE(lom_tessellation, name,                                                                           \
                     LOM_SHADER_EACH(LOM_CONTROL_SLOT, name) LOM_SHADER_EACH(LOM_EVALUATION_SLOT, name)                \
                         LOM_STAGE_OTHER(control, name) LOM_STAGE_OTHER(evaluation, name),                             \
                     __VA_ARGS__)
#define LOM_GEOMETRY(name, function, ...)                                                                              \
    LOM_SHADER_ENTRY(geometry, name, function, lom_primitive_stream, lom_geometry_input)                               \
    LOM_SHADER_DECLARE(LOM_GEOMETRY_ENTRY, name)                                                                       \
    LOM_STAGE_DEFINE(lom_geometry, name, LOM_SHADER_EACH(LOM_GEOMETRY_SLOT, name) LOM_STAGE_OTHER(geometry, name),     \
                     __VA_ARGS__)

#pragma GCC diagnostic pop
LOM_API_END

#endif
