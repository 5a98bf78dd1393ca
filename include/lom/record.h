/* lom/record.h - what happened to watched pixels: every triangle that touched them, every number on its way.
 *
 * Steps of use, in order: lom_watch names pixels of textures; passes into those textures are then drawn by the same
 * stages at 4 lanes, in the variant that records (their bytes are the same); lom_watched_pixel gives what was recorded,
 * until the next lom_watch. Other passes, and devices that watch nothing, are drawn as ever: recording costs nothing
 * there. Sprites and points are drawn, but not recorded; what is said of triangles holds for lines; of triangles that tessellation or a geometry function made
 * (lom/stages.h) the vertices have no index, no attributes and no notes, and the number is their primitive's. Named
 * values of a shader (lom/notes.h) are recorded where it was compiled in that variant, as lom's own are. Who wants to know of all triangles of a pass instead of some pixels
 * calls lom_listen; who wants to count at every texel of a target, lom_tally_target. A device does one of these; all
 * passes of one that does have one sample a pixel, its centre, but where tiles are timed.
 */
#ifndef LOM_RECORD_H
#define LOM_RECORD_H

#include <lom/notes.h>
#include <lom/pipeline.h>

LOM_API_BEGIN

enum { LOM_MAX_WATCHES = 64, LOM_MAX_TEXTURE_LABEL = 40 };

/* A rectangle of a texture's texels to watch. */
typedef struct lom_watch_desc {
    const lom_texture *target; /* watched in each pass that has it as a colour or as the depth attachment */
    int x, y;                  /* texel */
    int width, height;         /* 0: 1 */
    uint64_t before; /* only in passes with a smaller number, counted from 0 since lom_watch; 0: in all of them */
    const lom_texture
        *filtered; /* what a pass filters into the target (lom_find_filtered): its texels at the same places
                                    are watched as the target's own before that; NULL: nothing */
} lom_watch_desc;

/* What became of a triangle at the pixel. */
typedef enum lom_fate {
    LOM_FATE_STORED = 0,   /* it is in the attachments still */
    LOM_FATE_LOST,         /* stored, and overwritten by `lost_to` */
    LOM_FATE_BLENDED_OVER, /* stored, and a later triangle was blended over it */
    LOM_FATE_DEPTH,        /* failed the depth test */
    LOM_FATE_DISCARDED,    /* by its shader */
    LOM_FATE_DISTANCE,     /* outside a clip or cull distance here */
    LOM_FATE_FACING,       /* culled by its facing */
    LOM_FATE_SCISSOR,      /* outside the scissor */
    LOM_FATE_CLIPPED,      /* outside the near or far plane here */
    LOM_FATE_UNSHADED,     /* drawn, but its draw writes no colour and no depth here */
    LOM_FATE_STENCIL,      /* failed the stencil test */
    LOM_FATES
} lom_fate;
const char *lom_fate_text(lom_fate fate); /* a part of a sentence: "failed the depth test" */

/* ---- what a packet said of one fragment or vertex, in order ---- */

typedef struct lom_tap {
    int level, x, y, layer; /* texel; layer: of a cube or 3D texture; outside the level: as its wrap mode says */
    float weight;           /* of all taps of the lookup together 1 */
    float color[4];         /* decoded, linear light */
} lom_tap;

enum { LOM_MAX_TAPS = 16 };
typedef struct lom_note_record {
    lom_note_kind kind; /* VALUE, LOOKUP, TEXEL, RAY or STEP */
    const char *name;   /* VALUE: its name; LOOKUP, TEXEL: the texture's label, or NULL */
    int components;     /* VALUE */
    float value[8];     /* VALUE; LOOKUP: s, t, r, lod asked, level chosen; RAY: enters, leaves, step; STEP: distance,
                           length, density, share of the pixel, transmittance behind it, light of sun, sky, ground */
    const lom_texture *texture; /* LOOKUP, TEXEL */
    int face;                   /* of a cube */
    lom_tap tap[LOM_MAX_TAPS];
    int taps;
    float result[4]; /* LOOKUP, TEXEL */
    struct lom_note_record *next;
} lom_note_record;

typedef struct lom_vertex_record {
    uint32_t index; /* of the vertex; of one that clipping or a later stage made: UINT32_MAX */
    float attribute[LOM_MAX_ATTRIBUTES][4];
    float clip[4], ndc[3], window[3]; /* window: pixels of the frame and depth, before snapping */
    int32_t fixed[2];                 /* 1/256 pixel from the viewport's origin */
    float depth, one_over_w;          /* as the later stages have them */
    float varying[LOM_MAX_VARYINGS], distance[LOM_MAX_DISTANCES];
    unsigned code; /* outcode, bits of lom_outcode */
    lom_note_record *notes;
} lom_vertex_record;

typedef enum lom_outcode { /* bits 0..7: the distance of that number is below 0 */
                           LOM_OUT_NEAR = 1 << 8,
                           LOM_OUT_FAR = 1 << 9,
                           LOM_OUT_GUARD = 1 << 10,
                           LOM_OUT_W = 1 << 11,
                           LOM_OUT_INVALID = 1 << 12
} lom_outcode;

/* What was written to one colour attachment. Numbers are the attachment's: 0..255 of 8-bit formats, else floats. */
typedef struct lom_write_record {
    bool written;
    float source[4], before[4], after[4];
} lom_write_record;

typedef struct lom_fragment_record {
    float l[3];             /* screen-space weights in the stage's order: vertices by snapped (y, x) */
    float b[3];             /* perspective-correct, the same order */
    bool shaded, discarded; /* the fragment shader ran; and dropped it */
    bool inside_distances;
    bool stencil_failed; /* then it was not tested for depth */
    bool depth_tested, depth_passed, depth_written;
    float z;                   /* with the bias */
    float depth, depth_before; /* attachment units: tested, and stored until then */
    float varying[LOM_MAX_VARYINGS], dx[LOM_MAX_VARYINGS], dy[LOM_MAX_VARYINGS];
    float color[LOM_MAX_COLORS][4]; /* what the shader gave */
    lom_write_record write[LOM_MAX_COLORS];
    lom_note_record *notes;
} lom_fragment_record;

typedef struct lom_triangle_record { /* or a line: its second vertex twice, no edges, weights of its two ends and 0 */
    size_t number;                   /* of the draw's instance */
    int instance;
    int piece, pieces; /* of those that clipping left; pieces 0: nothing was left, or none was needed to be cut */
    lom_vertex_record vertex[3]; /* as submitted; the last is the provoking one */
    lom_vertex_record cut[3];    /* with pieces: the piece's own */
    int order[3];                /* the stage's order of them: order[0] is the first by snapped (y, x) */
    int64_t edge[3], area; /* edge functions at the pixel's centre, in that order, and their sum: 1/65536 pixel^2 */
    bool front;
    bool has_edges, covered;
    lom_fragment_record fragment; /* with covered */
    lom_fate fate;
    const struct lom_triangle_record *lost_to;
    const struct lom_draw_record *draw;
    struct lom_triangle_record *next;
} lom_triangle_record;

typedef struct lom_draw_record {
    size_t number; /* in the pass */
    const char *label;
    lom_draw_desc desc; /* pointers into the caller's data are dead after lom_end_pass; the shader's is not */
    bool recorded;      /* false: its shader was not built at 4 lanes, so nothing is known of it */
    bool depth_tested, depth_written;
    lom_compare compare;            /* resolved */
    lom_triangle_record *triangles; /* those that touch the pixel, in order */
    size_t near_misses;             /* whose box holds the pixel's centre, but that do not cover it */
    const struct lom_pass_record *pass;
    struct lom_draw_record *next;
} lom_draw_record;

typedef struct lom_pass_record {
    uint64_t number; /* since lom_watch */
    const char *label;
    lom_pass_desc desc;
    int x, y;               /* the pixel in the frame */
    int attachment;         /* of the watched texture: a colour's number, -1 the depth */
    bool filters;           /* it drew the watched texture from the one that it filters: nothing before is lost to it */
    float end[4];           /* what the texture holds after the pass: the attachment's numbers, or the depth */
    lom_draw_record *draws; /* those of the pass that touched the pixel, in order, and all that are not recorded */
    struct lom_pass_record *next;
} lom_pass_record;

/* A watched pixel: its passes from the last one on that cleared it. */
typedef struct lom_pixel_record {
    int x, y; /* texel */
    lom_format format;
    lom_pass_record *passes;
} lom_pixel_record;

/* Watches these pixels from the next pass on, and forgets what was recorded; count 0: nothing any more. Copied; the
 * targets are textures of this device. False, with an error on the device: too many, outside their texture, in a pass. */
bool lom_watch(lom_device *device, const lom_watch_desc *watches, size_t count);
/* What was recorded of texel (x, y) of a watch so far; owned by the device; NULL outside of its rectangle. */
const lom_pixel_record *lom_watched_pixel(const lom_device *device, size_t watch, int x, int y);
/* The pass, counted since lom_watch, that last drew into a texture before the pass `before`; false: none did. */
bool lom_find_drawn(const lom_device *device, const lom_texture *texture, uint64_t before, uint64_t *pass);
/* The texture that the last such pass made it of, as lom_smooth_edges does, each texel of the one at its place and those
 * around; NULL: it is drawn as it is. */
const lom_texture *lom_find_filtered(const lom_device *device, const lom_texture *texture, uint64_t before);
/* Passes since lom_watch. */
uint64_t lom_count_watched_passes(const lom_device *device);

/* ---- every triangle of a pass ---- */

/* How far a triangle came, or a piece of one that was cut. */
typedef enum lom_reach {
    LOM_REACH_OUTSIDE = 0, /* all its vertices lie outside one plane or distance, or one is no number */
    LOM_REACH_FACING,      /* culled by its facing */
    LOM_REACH_BESIDE,      /* beside the scissor */
    LOM_REACH_EMPTY,       /* holds no pixel's centre, or has no area */
    LOM_REACH_BINNED,      /* in the list of at least one tile */
    LOM_REACHES
} lom_reach;
const char *lom_reach_text(lom_reach reach); /* a part of a sentence: "culled by their facing" */

/* What set-up was given: the triangle itself, or a piece that clipping left of it. */
typedef struct lom_told_piece {
    float clip[3][4];
    /* Pixels of the frame, as they were snapped, and depth. Of a point or sprite: its middle, and the middles of two
     * sides. */
    float window[3][3];
    bool made[3];    /* by clipping: none of the triangle's own vertices */
    lom_reach reach; /* FACING or more */
} lom_told_piece;

enum { LOM_MAX_TOLD_PIECES = 16 };
typedef struct lom_told_triangle { /* or a line, a point, a sprite */
    size_t draw;                   /* in the pass */
    const lom_draw_desc *desc;
    int corners;   /* 3; of a line 2, of a point or sprite 1: the last of them stands in for those that are missing */
    bool made;     /* by the draw's stages of lom/stages.h: no vertex has an index */
    size_t number; /* of the draw's instance; of what is made, of the patch or primitive that it was made of */
    int instance;
    uint32_t index[3]; /* of vertices; UINT32_MAX: of none */
    float clip[3][4];
    unsigned code[3]; /* bits of lom_outcode */
    bool cut;         /* it crossed a plane, so the pieces are not itself; never of points and sprites */
    int pieces;       /* 0: it was outside */
    lom_told_piece piece[LOM_MAX_TOLD_PIECES];
    lom_reach reach;  /* the farthest of its pieces' */
    const void *from; /* for lom_tell_vertices */
} lom_told_triangle;

/* Who listens; each function may be NULL. They are called by the thread that calls the device, between the stages of a
 * pass: what is told depends on the draws alone, in their order. */
typedef struct lom_listener {
    void *context;
    /* A pass begins, the number counted from 0 since lom_listen: whether its triangles are told. */
    bool (*begins)(void *context, uint64_t number, const lom_pass_desc *pass);
    void (*triangle)(void *context, const lom_told_triangle *triangle);
    /* So many primitives went into the list of a tile (a rectangle of the frame), in a part of a draw. */
    void (*bin)(void *context, const lom_rect *tile, size_t triangles);
    /* Its attachments are complete and may be read. draws: how many it had; blends: one of them blends. */
    void (*ended)(void *context, uint64_t number, const lom_pass_desc *pass, size_t draws, bool blends);
} lom_listener;

/* Listens from the next pass on; NULL: nobody does. Copied. Instead of whatever was watched: a device watches or is
 * listened to. A pass that is told is drawn as a watched one is, its clusters (lom_culling) with it; triangles and
 * lines of shaders that were not built at 4 lanes are not told. False, with an error on the device: in a pass. */
bool lom_listen(lom_device *device, const lom_listener *listener);
/* Of a triangle while it is told: its vertices, by the vertex stage, with what their shader names. False: no memory. */
bool lom_tell_vertices(const lom_told_triangle *triangle, lom_vertex_record vertex[3]);

/* ---- tallies: a few numbers for each texel of a target, at a small part of what records cost ---- */

typedef struct lom_tally_desc {
    const lom_texture *target; /* colour; tallied in each pass that has it as an attachment */
    bool lookups, steps;       /* whether these are tallied, too (and the levels of detail) */
    const char *named;         /* the values of this name (lom/notes.h), or NULL */
    bool clock; /* only the time of tiles: passes are drawn by the usual variant, nothing else is tallied */
} lom_tally_desc;

/* What the passes into a target did at one texel, from the last one on that cleared it. Packets are of 4 lanes. Of
 * sprites and points the counts alone are tallied; shaders that were not built in the recorded variant are
 * drawn and not tallied. */
typedef struct lom_tally {
    uint32_t fragments;      /* drawn: covered, and left by clip distances and an early depth test */
    uint32_t killed;         /* dropped by the depth test before their shader ran */
    uint32_t packets, lanes; /* that shaded the fragments; the lanes in use of them */
    uint32_t lookups;        /* of textures, and single texels read */
    uint32_t steps;          /* of rays through media */
    uint32_t broken;         /* fragments whose shader gave a colour or a depth that is NaN or infinite */
    double seconds;          /* with clock: of the tile that the texel lies in; differs from run to run */
    /* The last fragment that was stored without blending, or blended by a draw of an object (lom_draw_desc): */
    bool is_stored;     /* false: there is none, and what follows is 0 */
    int object;         /* the draw's */
    float depth;        /* 0..1, as it was tested, less a bias */
    float edge;         /* pixels from the centre to the nearest edge of its triangle */
    float area;         /* of the triangle after clipping and snapping, square pixels */
    int made;           /* of its vertices, those that clipping made; */
    bool at_made;       /* the centre lies within 2.5 pixels of one */
    bool is_mipped;     /* its shader looked up a texture with mipmaps, the first of these: */
    float level, asked; /* the level of detail that was chosen; that was asked for, before bias and bounds */
    bool has_varyings;  /* its shader reads the first three varyings: */
    float varying[3];
    /* The last value of the name that a fragment stored since then had, blended or not; a NaN counts as none: */
    int named_components; /* 0: none */
    float named[4];
} lom_tally;

/* Tallies a target from the next pass on, and forgets what was tallied or watched; NULL: nothing any more. False, with an
 * error on the device: no colour texture of the device, in a pass, no memory. */
bool lom_tally_target(lom_device *device, const lom_tally_desc *desc);
/* What was tallied at texel (x, y) so far; owned by the device; NULL outside of the target. */
const lom_tally *lom_tallied(const lom_device *device, int x, int y);

LOM_API_END

#endif
