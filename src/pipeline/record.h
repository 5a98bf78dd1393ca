/* Recording: what the stages say of watched pixels, and who keeps it. A pass with a watched attachment has
 * pass->recorder, is drawn in the variant 4_recorded, every triangle by itself and no colour as a whole; then the macros
 * below are calls. In all other variants they are nothing.
 *
 *   chunk.c, line.c   name each triangle or line that comes near a watched pixel (lom_triangle_record)
 *   setup.wide.c      says how far its pieces came
 *   early, fragment   begin a fragment and add to it; one worker owns a pixel as it owns the tile
 *   run.c             joins them when the batch is drained, while its chunks are there (record_join.c)
 *
 * Invariant: recording reads what the stages have computed and changes none of it. */
#ifndef LOM_PIPELINE_RECORD_H
#define LOM_PIPELINE_RECORD_H

#include "lanes/notes.h"
#include "pipeline/device.h"

#include <lom/record.h>

enum { MAX_PIECES = LOM_MAX_FAN + 6 };
/* How far set-up took a piece. */
enum record_stage { RECORD_SENT = 0, RECORD_FACES, RECORD_IN_BOUNDS, RECORD_DONE };

struct record_piece {
    uint32_t corner[3]; /* rows of the chunk */
    int stage;          /* enum record_stage; RECORD_DONE: it has a number in the chunk */
    size_t number;
    float clip[3][4];
};

/* A triangle of a chunk that comes near a watched pixel. */
struct record_candidate {
    size_t number;
    uint32_t corner[3]; /* rows */
    uint32_t index[3];  /* vertices */
    unsigned code[3];
    float clip[3][4];
    int pieces, packet;         /* packet: pieces before the packet that is set up */
    size_t first_piece;         /* of the chunk's */
    struct record_piece *piece; /* the same, while the triangle is set up and when the batch is joined */
    bool has_box;               /* of the snapped vertices: its corners, 1/256 pixel from the viewport's origin */
    int32_t low[2], high[2];
};

struct record_chunk {
    struct record_candidate *items;
    struct record_piece *pieces;
    size_t count, capacity, piece_count, piece_capacity;
    bool failed;
};

/* A fragment of the batch at hand. */
struct record_raw {
    lom_fragment_record fragment;
    const struct lom_chunk *chunk;
    int32_t triangle; /* in the chunk */
    struct record_raw *next;
};

struct record_block;
struct record_memory { /* addresses stay; freed as a whole */
    struct record_block *first;
    bool failed;
};

struct record_pixel {
    lom_pixel_record pixel;
    struct record_memory memory;
    struct record_raw *raw; /* the last one first */
};

struct record_watch {
    lom_watch_desc desc;
    struct record_pixel *pixels;
    bool active;                        /* in the pass at hand, whose pixels */
    const lom_texture *texture;         /* which of the two that are watched, in that pass */
    int attachment, origin_x, origin_y; /* frame pixel = texel + origin */
};

/* What a worker has at hand: its notes, and the packet that it shades. */
struct record_worker {
    struct lom_notes notes;
    const struct lom_packet *packet;
    bool watches; /* a fragment of the packet is watched */
};

struct record_written {
    const lom_texture *texture, *filtered; /* filtered: what the pass makes it of, at the same places, or NULL */
    uint64_t pass;
};

struct lom_recorder {
    struct record_watch watch[LOM_MAX_WATCHES];
    size_t watch_count;
    struct lom_bounds bounds; /* of all watched pixels of the pass at hand, in the frame */
    uint64_t passes;          /* begun since lom_watch */
    struct record_written *written;
    size_t written_count, written_capacity;
    struct record_chunk *chunks; /* one for each of a batch */
    struct record_worker *worker;
    size_t chunk_count;
    int workers;
    bool failed; /* memory ran out: something is missing */
    lom_listener listener;
    struct record_memory told; /* of the triangle at hand */
    bool tells;                /* the pass at hand */
};

/* ---- record_memory.c ---- */
void *lom_record_allocate(struct record_memory *memory, size_t size);
void lom_free_record_memory(struct record_memory *memory);
/* ---- record.c ---- */
/* Whether the recorded variant is built (RECORDED of the Makefile); fails where it is not. */
bool lom_has_recorded(lom_device *device);
/* A new one in place of the device's; NULL without memory or that variant. */
struct lom_recorder *lom_renew_recorder(lom_device *device);
/* What the device recorded, or tallied (tally.h), is no more. */
void lom_forget_records(lom_device *device);
/* The pass has begun: pass->recorder is set where it draws into a watched texture. */
void lom_record_begin(lom_device *device);
/* The pass at hand draws its colour 0 from that of `filtered`, each texel from the one at its place and those around. */
void lom_record_filter(lom_device *device, const lom_texture *filtered);
/* The attachments are complete. */
bool lom_record_end(lom_device *device);
/* The watched pixels of the pass at a pixel of the frame, one after the other: NULL behind the last. *next begins as 0.
 */
struct record_pixel *lom_record_next(struct lom_recorder *recorder, int x, int y, size_t *next);

/* ---- record_chunk.c ---- */
/* Whether primitive i of the chunk comes near a watched pixel, or is told: then it becomes the chunk's candidate at
 * hand. */
bool lom_record_triangle(const struct lom_pass *pass, struct lom_chunk *chunk, size_t i);
/* It has been through set-up, alone, since the chunk had `before` triangles. */
void lom_record_set_up(const struct lom_pass *pass, struct lom_chunk *chunk, size_t before);
/* A piece of the line at hand, or the point or sprite, both of whose ends are its row; drawn: set-up has left a
 * record of it. */
void lom_record_line(struct lom_chunk *chunk, const uint32_t end[2], bool drawn);
void lom_record_stage(struct lom_chunk *chunk, const uint32_t *corners, int stage, const lom_mask *alive);

/* ---- record_listen.c ---- */
/* The batch's triangles to whoever listens. */
void lom_record_tell(lom_device *device);
/* The pass has ended, or failed. */
void lom_record_ended(lom_device *device);

/* ---- record_join.c ---- */
void lom_record_batch(lom_device *device);
/* record_note.c: what was noted of a lane, as it is kept. */
lom_note_record *lom_record_notes(struct record_memory *memory, const struct lom_notes *notes, int lane);
/* record_vertex.c: the draw's vertices once more, by the vertex stage: of three indices (of instance) what the stage and
 * its shader say. False: memory ran out. */
void lom_record_made_vertices(const struct lom_pass *pass, const struct lom_chunk *chunk,
                              const struct record_candidate *candidate, lom_vertex_record vertex[3]);
bool lom_record_vertices(const struct lom_pass *pass, const struct lom_chunk *chunk, const uint32_t index[3],
                         struct record_memory *memory, lom_vertex_record vertex[3]);
/* From a clip position and a row of the chunk's to the numbers of a vertex. */
void lom_record_row(const struct lom_pass *pass, const struct lom_draw *draw, const float *row, const float clip[4],
                    lom_vertex_record *vertex);
extern const char lom_attributes_note[]; /* the name of the note that holds the attributes */

/* ---- the stages of a tile: record_fragment.c ---- */
struct lom_packet;
struct lom_places;
struct part;
void lom_record_attributes(const struct lom_attributes *in, int count);
void lom_record_covered(struct lom_tile *tile, const struct part *at, const lom_mask *covered, const lom_mask *inside,
                        const lom_float l[3], const lom_float *z);
void lom_record_tested(struct lom_tile *tile, const struct part *at, const lom_mask *passed);
void lom_record_stencil(struct lom_tile *tile, const struct part *at, const lom_mask *failed);
void lom_record_packet(struct lom_tile *tile, const struct lom_packet *packet);
/* What follows is shaded without packets, and not recorded, but tallied (tally.h): a block of 2x2 pixels at a time, which
 * begins at `place` in tile memory. */
void lom_record_sprites(struct lom_tile *tile);
void lom_record_sprite_covered(struct lom_tile *tile, const lom_mask *covered);
void lom_record_sprite_tested(struct lom_tile *tile, int place, const lom_mask *passed);
void lom_record_sprite(struct lom_tile *tile, int place, const lom_mask *covered);
void lom_record_sprite_shaded(struct lom_tile *tile, const lom_fragment *out);
void lom_record_weights(struct lom_tile *tile, const lom_float *b1, const lom_float *b2);
void lom_record_shaded(struct lom_tile *tile, const lom_varyings *in, const lom_fragment *out);
/* A round of the packet at hand, whose lanes lie at different pixels: those of the others are left as they are. */
void lom_record_late(struct lom_tile *tile, const lom_float *units, const lom_float *stored, const lom_mask *tested,
                     const lom_mask *passed);
/* The same with draw->full_tests: the lanes that are about to be tested; those that passed, and that failed for stencil. */
void lom_record_late_begins(struct lom_tile *tile, const lom_float *depth, const lom_mask *tested);
void lom_record_late_ends(struct lom_tile *tile, const lom_mask *passed, const lom_mask *failed);
void lom_record_write_begins(struct lom_tile *tile, const struct lom_places *places, const lom_mask *mask);
void lom_record_write_ends(struct lom_tile *tile, const struct lom_places *places, const lom_mask *mask,
                           const lom_float4 *color);

#ifdef LOM_RECORD
#define LOM_RECORD_HOOK(function, ...) function(__VA_ARGS__)
enum { LOM_RECORDS = true };
#else
#define LOM_RECORD_HOOK(function, ...) ((void)0)
enum { LOM_RECORDS = false };
#endif

#endif
