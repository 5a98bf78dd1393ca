/* The device: its workers, the memory that passes reuse, and what it owns. */
#ifndef LOM_PIPELINE_DEVICE_H
#define LOM_PIPELINE_DEVICE_H

#include "pipeline/clusters.h"
#include "pipeline/stages.h"

/* A descriptor, to know it again, and the draw that was made of it; copied uniforms likewise. */
enum { KNOWN_DRAWS = 4 };
struct lom_known_draw {
    lom_draw_desc desc;
    uint32_t draw;
};
struct lom_known_uniforms {
    uint32_t place; /* lom_call.uniforms */
    size_t size;
};

struct lom_device {
    lom_error error;
    lom_device_desc desc; /* resolved */
    int variant;
    size_t cache_bytes; /* of the last level; 0: unknown */
    lom_pool *pool;
    lom_counters counters;
    lom_texture **textures;
    size_t texture_count, texture_capacity;

    bool one_by_one; /* small triangles are drawn by themselves and no values are kept for a triangle's next packet: the
                      specification of what does so, for tests */
    bool in_pass;
    struct lom_recorder *recorder; /* watches something (record.h) */
    struct lom_tallier *tallier;   /* tallies a target (tally.h) */
    struct lom_pass pass;
    struct lom_tile *worker_tiles;   /* one for each worker */
    struct lom_assembly *assemblies; /* likewise */
    struct lom_sample_room *sampled; /* likewise, once a pass had several samples */
    struct lom_chunk *chunks;        /* as many as the longest batch so far had, at most most_chunks */
    size_t chunk_capacity;
    size_t most_chunks;         /* of a batch: desc.batch, and behind those only ones of small draws (run.c) */
    struct lom_room room;       /* of the batches before this one */
    struct lom_room small_room; /* of chunks behind the first desc.batch */
    uint8_t *tile_memory, *tile_touched;
    _Atomic uint64_t *reached; /* zeros between batches */
    size_t tile_memory_capacity, tile_touched_capacity, reached_capacity;
    struct lom_draw *draws;
    struct lom_call *calls;
    size_t draw_capacity, call_capacity;
    struct lom_part *parts; /* of the calls, where some share chunks */
    size_t part_capacity;
    struct lom_known_draw known_draw[KNOWN_DRAWS];         /* the last of the pass, in turn */
    struct lom_known_uniforms known_uniforms[KNOWN_DRAWS]; /* likewise */
    struct lom_run *runs;                                  /* of the pass's draws that have clusters */
    size_t run_count, run_capacity;
    lom_query **queries; /* all; those that draws of the pass name come first */
    size_t query_count, query_capacity;
    uint64_t *counted; /* a row of numbers for each worker */
    size_t counted_capacity;
    uint8_t *uniforms; /* copies, 64 bytes aligned; offsets are kept while it grows */
    size_t uniforms_size, uniforms_capacity;
};

/* Checks a descriptor and records it; false with an error on the device. */
bool lom_record_draw(lom_device *device, const lom_draw_desc *desc);
/* Chunks for the batches of a pass that has so many: those of a batch, or all that a device may have, since a pass that
 * once has more than a batch has some more in another frame. */
bool lom_lay_chunks(lom_device *device, size_t count);
/* Whether a draw that the pass has already is what a descriptor asks for but for its triangles and its uniforms: which, and
 * which triangles of it (call.c). */
bool lom_find_draw(const lom_device *device, const lom_draw_desc *desc, struct lom_call *call);
/* Keeps a descriptor of which the pass's last draw was made, where others may be like it. */
void lom_note_draw(lom_device *device, const lom_draw_desc *desc);
/* Whether calls may name a draw of the descriptor again, so far as that says. */
bool lom_may_be_shared(const lom_device *device, const lom_draw_desc *desc);
/* Copies the descriptor's uniforms, for the call to name; the same, and adds the call to the pass. */
bool lom_copy_uniforms(lom_device *device, const lom_draw_desc *desc, struct lom_call *call);
bool lom_add_call(lom_device *device, const lom_draw_desc *desc, struct lom_call *call);
/* Finds which calls of the pass share a chunk; false without memory (join.c). How many there are from call i on; the
 * triangles of so many. */
bool lom_join_calls(lom_device *device);
size_t lom_joined_calls(const struct lom_pass *pass, size_t i);
size_t lom_joined_triangles(const struct lom_call *calls, size_t count);
/* Triangles of a chunk of a draw, or of several calls, that have so many (check_stages.c). */
size_t lom_even_share(size_t triangles, size_t chunk);
/* Whether a draw's stencil can be, or an error; the same with its defaults resolved (stencil.c). */
bool lom_check_stencil(lom_device *device, const lom_draw_desc *desc);
void lom_resolve_stencil_state(lom_stencil *stencil);
/* Queries (query.c): whether a draw's can be, or an error; whether its condition lets it be drawn; room to count those of
 * the pass; their results; and their end with the device. */
bool lom_check_queries(lom_device *device, const lom_draw_desc *desc);
bool lom_meets_condition(const lom_draw_desc *desc);
size_t lom_name_query(lom_device *device, lom_query *query);
bool lom_begin_counting(lom_device *device);
void lom_end_counting(lom_device *device);
void lom_free_queries(lom_device *device);
/* Whether the pass's targets can take what a draw does to them, or an error; and what follows from that (draw_output.c). */
bool lom_check_output(lom_device *device, const lom_draw_desc *desc);
/* Whether a viewport of the frame and a range of depths are any; those of a draw, and its scissor (viewport.c). */
bool lom_check_viewport(lom_device *device, const lom_rect *viewport, float min_depth, float max_depth);
bool lom_check_draw_viewport(lom_device *device, const lom_draw_desc *desc);
void lom_derive_viewport(const struct lom_pass *pass, struct lom_draw *draw);
void lom_derive_output(const struct lom_pass *pass, struct lom_draw *draw);
/* The runs of a draw's clusters of which something may be seen, and how many chunks they make; false without memory. */
bool lom_find_runs(lom_device *device, struct lom_draw *draw);
/* What both rectangles cover. */
lom_rect lom_intersect_rects(lom_rect a, lom_rect b);
/* lom_finish_texture of an attachment, by all workers. */
void lom_finish_attachment(lom_device *device, lom_texture *texture);
/* The same where a pass has drawn into a slice of it alone. */
void lom_finish_slice(lom_device *device, lom_texture *texture, lom_slice slice);
/* Runs every recorded draw into tile memory and resolves it. */
bool lom_run_pass(lom_device *device);

#endif
