/* What the stages of the pipeline hand to one another.
 *
 *   pass.c      collects draws, cuts them into chunks, runs batches of chunks: chunks | barrier | tiles | barrier ...
 *   chunk:      vertex -> clip -> setup -> bin       one worker owns a chunk until its triangles are in its bins
 *   tile:       raster -> fragment -> output         one worker owns a tile until the batch is drained
 *   end:        resolve                              tile memory to the attachments' textures
 *
 * Order: chunks are in submission order, a chunk's bins keep the order of its triangles, and a tile walks the chunks in
 * order; so a pixel sees its fragments in submission order whatever the workers do. */
#ifndef LOM_PIPELINE_STAGES_H
#define LOM_PIPELINE_STAGES_H

#include "base/reserve.h"
#include "base/threads.h"
#include "image/texture.h"
#include "pipeline/tile.h"
#include "pipeline/triangle.h"

#include <lom/pipeline.h>

#include <stdatomic.h>

/* Snapped positions have 8 sub-pixel bits, relative to the viewport's origin. The guard band keeps |x|, |y| from the
 * viewport's centre at most 32760 pixels, so extents stay below 2^16 pixels = 2^24 units, an edge function below 2^49
 * (exact in double), and an edge that crosses a tile of 64 pixels below 2^31 in units of 256 (exact in int32). */
enum {
    SUBPIXEL_BITS = 8,
    SUBPIXELS = 1 << SUBPIXEL_BITS,
    GUARD_PIXELS = 32760,
    SMALL_EXTENT = 64 * SUBPIXELS, /* below this an edge function fits int32 */
    ROW_HEADER = 4                 /* floats of a vertex row before its varyings: x, y (int32 bits), depth, 1/w */
};

/* Outcodes: bits 0..7 the distances below 0. */
enum {
    CODE_NEAR = 1 << 8,
    CODE_FAR = 1 << 9,
    CODE_GUARD = 1 << 10,
    CODE_W = 1 << 11,
    CODE_INVALID = 1 << 12,
    CODE_CLIP = CODE_NEAR | CODE_FAR | CODE_GUARD | CODE_W,
    CODE_REJECT = 0xff | CODE_NEAR | CODE_FAR | CODE_W /* outside one of these with all vertices: nothing to see */
};

/* The colour of a draw whose shader reads nothing. Where `fills`, it goes to the only target as it is, or, with
 * `blends`, as (target * factor + add) / 255 rounded, channel by channel: two channels of 16 bits a word, red and blue,
 * green and alpha; `add` holds the 128 of the rounding. */
struct lom_paint {
    float color[LOM_MAX_COLORS][4];
    bool fills, blends;
    uint32_t bytes;
    uint32_t factor[2], add[2];
};

/* What a draw does to its targets. Those that have code of their own have one target and write all of its channels:
 * bytes, as they are or blended by source alpha + target (1 - alpha) or source + target (1 - alpha) in all channels
 * (blend_bytes.h); or floats, blended the second way. */
typedef enum lom_output_kind {
    OUTPUT_GENERAL = 0,
    OUTPUT_BYTES,
    OUTPUT_STRAIGHT,
    OUTPUT_MULTIPLIED,
    OUTPUT_FLOATS_MULTIPLIED
} lom_output_kind;

/* A draw as recorded. */
struct lom_draw {
    lom_draw_desc desc;
    lom_rect scissor; /* resolved, within viewport, pass and target, in frame pixels */
    int variant;
    int row_floats; /* of a vertex row: header, varyings, distances, padded to 4 */
    int distance_offset;
    int distances;   /* clip + cull */
    int axis_offset; /* of a sprite's half sides in its row: x and y of the one, of the other, in pixels, y down */
    bool sprites,
        lines;        /* what it is of, if not of triangles; sprites: or points, whose half sides are (h, 0), (0, h) */
    size_t triangles; /* or sprites, points, lines, of one instance */
    lom_compare compare;           /* LOM_COMPARE_NEVER + 1 ...; ALWAYS when depth is off */
    bool instanced, clamps_points; /* with attributes of instances; sprites or points with depth_clamp */
    bool depth_write, late_depth, blends, constant, biased;
    bool rare_factors; /* it blends by a constant or by a second source */
    bool two_sources;  /* by the latter */
    bool sampled;      /* several samples a pixel, alpha as coverage, or full_tests after the shader */
    bool marks_edges;  /* it says where its triangles end */
    bool full_tests;   /* a stencil test or a query besides the depth test: sample_tests.wide.c */
    size_t counter;    /* with a query: which of the pass's */
    lom_output_kind output;
    bool packs;             /* small triangles' fragments can be computed together, from their records alone */
    bool expands;           /* it has stages between vertices and clipping, or feedback */
    bool rasterizes;        /* something of it may be drawn */
    lom_topology drawn;     /* LOM_TRIANGLES, LOM_LINES, LOM_POINTS or LOM_SPRITES: what goes to clipping */
    int stage_pitch;        /* of rows between stages, in floats */
    size_t unit;            /* primitives that a chunk has at most */
    bool queues_depth;      /* the fragment stage needs the depth */
    struct lom_paint paint; /* with `constant`, once the pass runs */
    size_t first_run, run_count, chunk_count; /* with clusters: which of the device's runs; the chunks they make */
};

/* A call of lom_draw: a draw that others may share, which of its triangles (or sprites, points, lines) of one instance,
 * where its uniforms lie in the device's, and what is added to its indices. */
struct lom_call {
    uint32_t draw, first, triangles;
    uint32_t uniforms; /* in UNIFORMS_UNIT */
    int32_t base_vertex;
};
enum { UNIFORMS_UNIT = 64 };

/* What is found of a call before its pass runs (join.c): how many calls the chunk has that begins with it, itself included;
 * where there are several, its vertices, where its rows begin in the chunk's, and where its primitives end. */
struct lom_part {
    uint32_t joined;
    uint32_t base, vertices; /* the number of the first, how many from that on; NO_VERTEX: as many as are listed */
    uint32_t row;
    uint32_t end; /* one more than the last of the chunk's primitives that is the call's */
};
enum { CHUNKS_WORD = 64 }; /* of lom_pass.reached */
enum { SMALL_DRAW = 256 }; /* triangles at most */

enum { SEVERAL_TILES = -1 };
enum { NEEDED_VERTICES = 16 }; /* a whole number of packets at every width */
enum { MOST_ROWS = 6 };        /* a triangle: a range of vertices that is longer becomes a list */

#define NO_VERTEX UINT32_MAX

enum { LEVEL_WORDS = 6 }; /* of a patch: outer, inner */

/* Rows of vertices between stages that are not projected yet (lom/stages.h), of draw->stage_pitch floats. */
struct lom_stage_rows {
    float *row;
    size_t count, capacity;
};

/* Points, lines, triangles or patches that are made of them. */
struct lom_pieces {
    uint32_t *vertex; /* row numbers, `vertices` a piece */
    uint32_t *number; /* which primitive of the draw each comes from */
    size_t count, vertex_capacity, number_capacity;
    int vertices;
};

/* What the stages between vertices and clipping need of the chunk at hand (expand.c); zeros where no draw has any. */
struct lom_expansion {
    struct lom_stage_rows rows[3]; /* of vertices, of tessellation, of geometry */
    struct lom_pieces pieces[3];
    struct lom_pattern *pattern; /* what the patch at hand is cut into */
    float *point;                /* packets of vertices: of a patch, of a primitive */
    float *emitted;              /* rows of a packet of primitives */
    size_t point_capacity, emitted_capacity;
};

/* What the first half of the pipeline needs of the chunk at hand and nobody after it; a worker's, so that it stays in
 * its cache. */
struct lom_assembly {
    uint32_t *corners;     /* three row numbers a triangle, or NO_VERTEX in the first */
    uint32_t *vertex_list; /* the index of each row, in a chunk that is listed */
    float *clip;           /* clip positions, 4 floats a row */
    uint16_t *codes;
    int32_t *tile;                      /* that each triangle of the chunk lies in, or SEVERAL_TILES */
    struct record_candidate *candidate; /* the triangle at hand where it is recorded (record.h) */
    uint8_t *needed;                    /* a flag for NEEDED_VERTICES of them, in a chunk of clusters */
    size_t corners_capacity, vertex_list_capacity, clip_capacity, codes_capacity, tile_capacity,
        needed_capacity; /* in elements */
    struct lom_expansion expansion;
};

/* The most elements that an array of a chunk or of its assembly has needed in the batches before, and a part more. */
struct lom_room {
    size_t corners, rows, vertices, triangles, tiles, listed;
};

/* A range of triangles of one instance of a draw, and what the first half of the pipeline made of it. */
struct lom_chunk {
    const struct lom_draw *draw;
    const void *uniforms;
    int instance;
    int32_t base_vertex;        /* of one call; those of several have theirs */
    size_t first, count;        /* triangles */
    const struct lom_run *runs; /* with clusters: where the triangles are, in place of `first` */
    size_t run_count;
    const struct lom_call *calls; /* of a chunk of several: whose triangles these are, and what is known of each; */
    struct lom_part *parts;       /* NULL: a chunk of one call */
    size_t part_count;
    size_t first_row; /* where the rows of the vertices at hand go */

    struct lom_assembly *assembly; /* of the worker that has the chunk */
    uint32_t vertex_base;          /* index of row 0 unless listed */
    const uint32_t *plain; /* indices that are the corners less vertex_base, where those are not made; or NULL */
    size_t vertex_count;   /* rows that were shaded (clipping appends) */
    bool listed;
    const uint8_t *needed;  /* the assembly's, or NULL: all */
    const float *made_rows; /* vertices that a later stage has made (expand.c); NULL: they are to be shaded */
    float *kept_rows;       /* where shaded ones go for a later stage; NULL: they are projected */

    float *rows; /* vertex rows */
    lom_primitive *primitives;
    int tile_low, tile_high; /* the tiles that they lie in have numbers between these; none: tile_high < 0 */
    uint32_t *tile_first;    /* one more than those: where the list of tile_low + i begins */
    uint32_t *tile_list;     /* numbers of primitives */
    size_t row_count, triangle_count;
    unsigned any_code; /* all outcodes together */
    bool has_gaps;     /* a triangle has no corners (a restart index, an index out of range) */
    bool all_listed;   /* all of its primitives are TRIANGLE_LISTED */
    size_t rows_capacity, primitives_capacity, tile_first_capacity, tile_list_capacity; /* in elements */
    uint64_t triangles_clipped, vertices_shaded;
    float *captured; /* with feedback: what it keeps of each vertex */
    size_t captured_capacity, captured_vertices;
    size_t kept_from, kept_bytes; /* of that in the buffer */
    bool failed;                  /* memory ran out */
};

typedef enum lom_color_kind { COLOR_UNORM8 = 0, COLOR_SRGB8, COLOR_FLOAT } lom_color_kind;

struct lom_color_target {
    lom_texture *texture;
    lom_slice slice;
    lom_format format;
    lom_color_kind kind;
    float clear[4];
    uint32_t clear_bytes;
    bool keep;
};

/* What is watched or tallied of a texture. */
static inline bool lom_is_first_slice(lom_slice slice)
{
    return slice.level == 0 && slice.layer == 0;
}

/* A sample's place from its pixel's centre, in 1/16 of a pixel. */
struct lom_sample_offset {
    int8_t x, y;
};

struct lom_pass {
    lom_device *device;
    struct lom_recorder *recorder; /* with a watched attachment (record.h) */
    lom_pass_desc desc;
    int width, height;             /* of the attachments */
    int frame_width, frame_height; /* of the whole frame */
    lom_rect scissor;              /* resolved, within the attachments' part of the frame */
    int colors;
    int edges; /* which of them keeps where triangles end, the last one; 0: none */
    struct lom_color_target color[LOM_MAX_COLORS];
    lom_texture *depth;
    lom_slice depth_slice;
    double depth_scale; /* 65535, 16777215, or 0 for float depth */
    float clear_depth;  /* in tile units */
    int samples;        /* of a pixel */
    int sample_pitch;   /* words from the samples of a pixel to the next one's, where they lie side by side */
    const struct lom_sample_offset *offset; /* of each */
    int32_t
        offset_pair[LOM_MAX_SAMPLES + 1]; /* of the centre, then of each, as pairs of 16 bits (lanes/pair_products.h) */
    int32_t strip_pair
        [4 * LOM_MAX_SAMPLES]; /* of a block of 2x2 pixels, a word after the other, from its corner, in 1/SUBPIXELS */
    int reach_low, reach_high; /* how far they lie from centres along x and y, in 1/SUBPIXELS; <= 0, >= 0 */
    bool uses_depth, writes_depth;                /* a draw tests, reads or writes depth; one writes it */
    bool has_stencil, uses_stencil;               /* the depth attachment has one; a draw tests it */
    size_t queries;                               /* that its draws name: the first of the device's */
    bool one_by_one;                              /* as lom_device's */
    bool streams;                                 /* the attachments are larger than the caches */
    int tile, tiles_x, tiles_y, tile_x0, tile_y0; /* tile grid, aligned to the frame */
    size_t tile_bytes;
    uint8_t *tile_memory;  /* tile_bytes for each tile, or for each worker when there is a single batch */
    uint8_t *tile_touched; /* a flag for each tile */

    size_t draw_count, call_count;      /* recorded in the device */
    size_t known_draws, known_uniforms; /* of them that the device has noted (call.c) */
    struct lom_part *parts;             /* of the calls; NULL: each has chunks of its own */

    struct lom_chunk *chunks; /* the batch's */
    _Atomic uint64_t
        *reached; /* of each tile reached_words, a bit for each of the batch's chunks that has a list for it */
    size_t reached_words;
    size_t chunk_count;
    size_t chunks_left;            /* of the pass, the batch's included until it runs */
    bool feeds_back;               /* a draw has feedback */
    bool single_batch, last_batch; /* the pass is one batch; this is its last one */

    struct lom_tallier *tallier; /* with a tallied attachment (tally.h) */
    bool is_recorded;            /* with a recorder or a tallier: drawn in the variant 4_recorded */
};

/* A rectangle of a tile and of an attachment. */
struct lom_rectangle {
    int edge, x, y, width, height; /* of the tile; the rectangle in it, in pixels */
    uint32_t *texels;              /* of its first pixel in the attachment */
    size_t pitch;                  /* words from a row of the attachment to the next */
    float divisor;                 /* of depths that are whole numbers; 0: words are stored as */
    int32_t keep, set;             /* (word & keep) | set */
    bool streams;                  /* texels and pitch are whole cache lines, and nobody reads them soon */
};

static inline size_t lom_larger_size(size_t a, size_t b)
{
    return a > b ? a : b;
}

/* Room for `rows` vertex rows in the chunk (rows, clip, codes). */
bool lom_reserve_rows(struct lom_chunk *chunk, size_t rows);
/* Room in the arrays of a chunk that begins, whose vertex_count is known. */
bool lom_make_room(const struct lom_room *room, struct lom_chunk *chunk);
/* Room in those of one that may come in a later batch. */
bool lom_prepare_chunk(const struct lom_room *room, struct lom_chunk *chunk);
/* Raises room to what the chunk has needed. */
void lom_raise_room(struct lom_room *room, const struct lom_pass *pass, const struct lom_chunk *chunk);

/* The triangles of a run; a chunk's corners from those of its runs, less `low` unless it is to be a list, the extremes of
 * their numbers, and which vertices are needed (clusters.c). */
size_t lom_triangles_of_run(const lom_clusters *clusters, const struct lom_run *run);
bool lom_gather_clusters(struct lom_chunk *chunk, uint32_t *low, uint32_t *high);

/* The vertices of a chunk of several calls, as lom_choose_vertices chooses those of one; makes those of part i the ones at
 * hand, in order, since packets write past their rows; finds where the calls' primitives end, of which none was clipped.
 * The uniforms of part i. */
bool lom_choose_parts(const struct lom_room *room, struct lom_chunk *chunk);
void lom_begin_part(const struct lom_pass *pass, struct lom_chunk *chunk, size_t i);
void lom_end_parts(struct lom_chunk *chunk);
const void *lom_uniforms_of_part(const struct lom_pass *pass, const struct lom_chunk *chunk, size_t i);

/* First half of the pipeline for one chunk: its triangles end up in its bins. */
void lom_run_chunk(struct lom_pass *pass, struct lom_chunk *chunk, struct lom_assembly *assembly);
/* Who has one of these codes at all vertices is outside. */
static inline unsigned lom_reject_codes(const struct lom_draw *draw)
{
    return draw->desc.depth_clamp ? CODE_REJECT & ~(CODE_NEAR | CODE_FAR) : CODE_REJECT;
}
/* Stage 2: cuts a triangle of three rows by the planes named in `codes`; appends rows; gives the fan's corners and
 * returns how many triangles it has (0..LOM_MAX_FAN). With depth_clamp what lies before near and behind far are fans, too,
 * their depths those of the planes. */
enum { LOM_MAX_FAN = 24 };
int lom_clip_triangle(const struct lom_pass *pass, struct lom_chunk *chunk, const uint32_t corner[3], unsigned codes,
                      uint32_t fan[LOM_MAX_FAN][3]);
/* Stage 2 of a line of two rows: the ends of what is left, how many pieces that is (more than one with depth_clamp alone).
 * Stages 2 and 3 of a chunk of lines: a record for each that may cover a pixel. */
enum { LOM_LINE_PIECES = 3 };
int lom_clip_line(const struct lom_pass *pass, struct lom_chunk *chunk, const uint32_t end[2], unsigned codes,
                  uint32_t piece[LOM_LINE_PIECES][2]);
void lom_set_up_lines(const struct lom_pass *pass, struct lom_chunk *chunk);
/* Room for `count` primitives and the tiles that they lie in, and for what set-up writes past them. */
bool lom_reserve_primitives(struct lom_chunk *chunk, size_t count);
/* Appends one, for which there is room. */
void lom_add_primitive(const struct lom_pass *pass, struct lom_chunk *chunk, const lom_primitive *primitive);
/* The vertex at a place of its draw's index buffer; false where there is none. */
bool lom_find_vertex(const struct lom_chunk *chunk, size_t place, uint32_t *number);
/* The corners of a chunk's triangles or lines and which vertices they need. */
bool lom_choose_vertices(const struct lom_room *room, struct lom_chunk *chunk);
/* Of a chunk whose draw expands: the primitive that its triangle i was made of. */
size_t lom_made_from(const struct lom_chunk *chunk, size_t i);
/* Stages 1 and 3 of a chunk of sprites or points: which vertices it needs; a record for each that may cover a pixel centre. */
bool lom_choose_sprites(const struct lom_room *room, struct lom_chunk *chunk);
void lom_set_up_sprites(const struct lom_pass *pass, struct lom_chunk *chunk);
/* The chunk has primitives in tiles with numbers between these. */
static inline void lom_widen_tiles(struct lom_chunk *chunk, int32_t low, int32_t high)
{
    chunk->tile_low = low < chunk->tile_low ? low : chunk->tile_low;
    chunk->tile_high = high > chunk->tile_high ? high : chunk->tile_high;
}

/* The second half for the batch's tiles, which workers take. */
void lom_run_tiles(void *context, int worker);

/* Stage 4: sorts the chunk's triangles into its bins, and says in pass->reached which tiles have one. */
void lom_bin_chunk(const struct lom_pass *pass, struct lom_chunk *chunk);

/* What a draw's depth bias adds to the depths of a triangle (draw->biased). */
double lom_depth_offset(const struct lom_pass *pass, const struct lom_chunk *chunk, const lom_primitive *primitive);

/* What a tile's stages need of a triangle or line; of a sprite or point; of a line (triangle.c, sprite.c, line.c). */
void lom_find_triangle(const struct lom_chunk *chunk, const lom_primitive *primitive, lom_triangle *t);
void lom_find_sprite(const struct lom_chunk *chunk, const lom_primitive *primitive, lom_triangle *t);
void lom_find_line(const struct lom_chunk *chunk, const lom_primitive *primitive, lom_triangle *t);

/* Tile memory from the clear values or the attachments, and to the attachments. */
void lom_load_tile(const struct lom_pass *pass, int number, uint8_t *memory);
void lom_resolve_tile(const struct lom_pass *pass, int number, const uint8_t *memory);
/* One attachment of it. The depth without memory ends as it began. */
void lom_load_depth(const struct lom_pass *pass, int number, float *memory);
void lom_load_color(const struct lom_pass *pass, int i, int number, void *memory);
void lom_resolve_depth(const struct lom_pass *pass, int number, const void *memory);
void lom_resolve_color(const struct lom_pass *pass, int i, int number, const void *memory);
/* The same of its stencil, a word a pixel; NULL: it ends as it began (stencil.c). */
void lom_load_stencil(const struct lom_pass *pass, int number, int32_t *memory);
void lom_resolve_stencil(const struct lom_pass *pass, int number, const int32_t *memory);
/* Bytes of an image of colour attachment i in tile memory. */
size_t lom_image_bytes(const struct lom_pass *pass, int i);
/* The same for a tile that is one colour; and tile memory of such a tile, which then is none any more. */
void lom_resolve_whole_tile(const struct lom_pass *pass, int number, uint32_t color);
void lom_load_whole_tile(struct lom_tile *tile);
/* The clear values to the attachments that do not keep their texels. */
void lom_clear_tile(const struct lom_pass *pass, int number);
/* The apron's columns beside a tile at the left or right end of the attachments, made of its texels while they are in the
 * worker's cache; and whether a slice's are filled so (else at the end of the pass, finish.c). */
void lom_fill_tile_columns(const struct lom_pass *pass, int number);
bool lom_fills_columns(const lom_texture *texture, lom_slice slice);

#endif
