/* What a worker holds of the tile that it owns: its memory, the fragments that wait in a queue for a whole packet, and the
 * small triangles that are drawn together. Invariant: one draw and one chunk at a time; a tile's fragments are written in
 * the order in which they were submitted. */
#ifndef LOM_PIPELINE_TILE_H
#define LOM_PIPELINE_TILE_H

#include "pipeline/triangle.h"

#include <lom/pipeline.h>

struct lom_chunk;
struct lom_draw;
struct lom_pass;

/* Fragments on their way into packets; all of one draw and chunk. Entry i of every array is one fragment. */
enum { MOST_LANES = 16, QUEUE_SIZE = 64, QUEUE_ROOM = QUEUE_SIZE + 2 * MOST_LANES };
struct lom_queue {
    float l[3][QUEUE_ROOM];       /* screen-space barycentric weights */
    float depth[QUEUE_ROOM];      /* only with draw->queues_depth */
    int32_t pixel[QUEUE_ROOM];    /* index into the tile's memory */
    int32_t covered[QUEUE_ROOM];  /* -1, or 0 for a helper; only in shaders that ask for quads */
    int32_t triangle[QUEUE_ROOM]; /* number of the fragment's triangle in the chunk's */
    int count;
};

/* Small triangles that are drawn together, and the pixels that they cover: a code is the index into the tile's memory, the
 * pixel of the tile, and which of the list's triangles. */
enum {
    CODE_X = 12,
    CODE_Y = 18,
    CODE_TRIANGLE = 24,
    LIST_SIZE = 512,     /* codes after which it is drained */
    LIST_PIXELS = 1024,  /* that one triangle's parts may have, covered or not */
    LIST_TRIANGLES = 64, /* of which some may be left from the last time */
    STRIPS_SIZE = 256,   /* strips of pixels of several samples after which they are tested (pack_samples.wide.c) */
    STRIPS_MOST = 512, /* that one triangle's parts may have, of two pixels; of four: 352, which is (w + 8) (h + 8) / 4
                            where (w + 4) (h + 4) is at most LIST_PIXELS, and w and h 64 */
    STRIPS_ROOM = STRIPS_SIZE + STRIPS_MOST + 16,
    LIST_ROOM = 4 * (STRIPS_SIZE + 352) + 32, /* at least LIST_SIZE + LIST_PIXELS + 16 */
    SLOT_PITCH = LIST_TRIANGLES + 16,
    SLOT_WORDS = 24,     /* slots.h */
    LIST_ONE_OVER_W = 0, /* of the values: words of the vertices' 1/w, of the others before the varyings, of a varying
                            (interpolate.wide.c) */
    LIST_HEADER = 8,
    LIST_VALUE = 5
};
struct lom_list {
    int32_t code[LIST_ROOM];
    uint32_t number[SLOT_PITCH];          /* of the triangles, in the chunk's */
    float slots[SLOT_WORDS * SLOT_PITCH]; /* what was found of them */
    float value[(LIST_HEADER + LIST_VALUE * LOM_MAX_VARYINGS) * SLOT_PITCH];
    int count, triangles;
    int kept;   /* triangles of which only the fragments that are there are left */
    int tested; /* codes whose early depth test is done */
};

/* Pixels side by side of one of the list's triangles, whose samples are tested together (pack_samples.wide.c): the code of the
 * first, its place from the tile's corner as a pair in 1/SUBPIXELS, what was found of the samples, up to four words a strip;
 * and where the strips of a slot end. */
struct lom_strips {
    int32_t code[STRIPS_ROOM], place[STRIPS_ROOM], found[4 * STRIPS_ROOM];
    int32_t end[LIST_TRIANGLES];
};

/* Levels of detail that were found for a packet of a triangle and hold for its others: of a texture by two varyings, one
 * number for all lanes. */
enum { KNOWN_LEVELS = 4 };
struct lom_known_levels {
    int count;
    struct lom_known_level {
        const lom_texture *texture;
        int s, t;
        float lod;
    } of[KNOWN_LEVELS];
};

/* What fragments need of one triangle, in the words of a slot's values (facet.wide.c). What is the same for all of them
 * waits in the varyings that its packets give to shaders: those which do not vary, and all differences. */
enum {
    LARGEST_VARYINGS = 64 * (3 * LOM_MAX_VARYINGS + 16), /* bytes of lom_varyings at 16 lanes, at most */
    LARGEST_FRAGMENT = 64 * (4 * LOM_MAX_COLORS + 2),    /* likewise of lom_fragment */
    WINDOWS_PACKETS = 8,                                 /* of whole windows that are shaded together */
    ENTRY_PACKETS = 4                                    /* of small triangles likewise */
};
struct lom_facet {
    const lom_primitive *primitive; /* whose they are; NULL: nobody's */
    uint32_t varies;                /* varyings that are not the same at all vertices, a bit each */
    bool level;                     /* 1/w is 1 at all vertices: slopes are the steps over the sum of the weights */
    float slope[2][3];              /* along x and y: of l1 / w1, of l2 / w2, of the sum */
    struct lom_known_levels levels; /* with slopes that are those alone */
    float value[LIST_HEADER + LIST_VALUE * LOM_MAX_VARYINGS];
    int filled; /* of the varyings: how many hold what is the same */
    _Alignas(64) unsigned char varyings[WINDOWS_PACKETS][LARGEST_VARYINGS];
};

/* What packets of small triangles get and what all that are shaded together give: too much for the stack of a host that made
 * it small. */
struct lom_together {
    _Alignas(64) unsigned char varyings[ENTRY_PACKETS][LARGEST_VARYINGS];
    _Alignas(64) unsigned char fragments[WINDOWS_PACKETS][LARGEST_FRAGMENT];
};

/* What the queue holds of fragments besides, where pixels have several samples: which they are written to, a bit each; where
 * they are shaded (0: the centre, i + 1: sample i); the depth at each sample, only with draw->late_depth. */
struct lom_sample_queue {
    int32_t samples[QUEUE_ROOM], place[QUEUE_ROOM];
    float depth[LOM_MAX_SAMPLES][QUEUE_ROOM];
};

/* What a worker holds besides once a pass had several samples. */
struct lom_sample_room {
    struct lom_sample_queue queue;
    int32_t list[LIST_ROOM]; /* with the list's codes (packed.h) */
    struct lom_strips strips;
};

/* A worker's view of the tile it owns. Tile memory is in blocks of 2x2 pixels, rows of blocks from the top. */
struct lom_tile {
    struct lom_pass *pass;
    uint64_t fragments, packets;   /* counted */
    const struct lom_draw *draw;   /* of the fragments in the queue */
    const struct lom_chunk *chunk; /* likewise */
    const void *uniforms;          /* likewise, of their call */
    uint32_t call_end;             /* one more than the last of the chunk's primitives that is of that call */
    bool tests_early;              /* the draw's depth test comes before its fragment shader */
    bool rejects_early;            /* it comes after, but who fails before would fail then, and is not shaded */
    bool tests_all;                /* all tests come before it, those of sample_tests.wide.c */
    int x, y;                      /* frame pixel of the tile's first pixel */
    int edge;
    int32_t offset[16];          /* of the pixels of a 4x4 window to its first, in tile memory */
    float *depth;                /* attachment units; NULL where no draw of the pass uses depth */
    int32_t *stencil;            /* as depth; NULL where no draw of the pass tests it */
    uint64_t *counted;           /* samples that passed, for each of the pass's queries */
    void *color[LOM_MAX_COLORS]; /* uint32_t for 8-bit formats, else 4 planes of floats */
    int number;
    uint8_t *memory;
    bool is_whole; /* tile memory holds nothing yet: every pixel of the only colour target is `whole` */
    uint32_t whole;
    struct lom_queue queue;
    struct lom_list list;
    struct lom_facet facet;
    struct lom_together together;
    float reach[4][MOST_LANES]; /* of the packet at hand, with draw->marks_edges: how far its triangles reach to the
                                       right, left, down, up, as the texture of edges has it (mark_edges.h) */
    uint8_t owner[64 * 64];     /* scratch: which lane of a packet comes first to a pixel; last, so that what workers
                                 write often lies far apart */
    /* Where pixels have several samples (samples.c): depth is of samples, side by side. A block of 2x2 pixels has one colour for
     * all samples, in the image color, unless its flag is set: then they are in sample_color, codes side by side, floats in
     * an image for each sample. */
    uint8_t *several[LOM_MAX_COLORS];
    void *sample_color[LOM_MAX_COLORS];
    uint8_t *scratch;                /* an image */
    struct lom_sample_room *sampled; /* NULL before the device's first pass of several samples */
};

#endif
