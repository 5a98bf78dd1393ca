/* Running a pass: batches of chunks, a barrier between the two halves of the pipeline. Work is handed out in portions;
 * which worker takes what changes nothing, because a chunk and a tile each belong to one worker until they are done. */
#include "pipeline/expand.h"
#include "pipeline/record.h"
#include "pipeline/tally.h"
#include "pipeline/variants.h"
#include "pipeline/samples.h"

/* Of the many of small draws some at once, so that workers seldom meet. */
static void run_chunks(void *context, int worker)
{
    enum { TURNS = 32 };
    struct lom_pass *pass = context;
    const size_t count = pass->chunk_count, some = count / TURNS > 1 ? count / TURNS : 1;
    lom_portion *portions = lom_pool_portions(pass->device->pool);
    size_t first, taken;
    while ((taken = lom_take_portion(portions, pass->device->desc.threads, worker, some, &first)) > 0)
        for (size_t i = first; i < first + taken; i++)
            lom_run_chunk(pass, &pass->chunks[i], &pass->device->assemblies[worker]);
}

static void run_all(lom_device *device, lom_work *work, size_t count)
{
    lom_lay_portions(lom_pool_portions(device->pool), device->desc.threads, count);
    lom_offer_work(device->pool, work, &device->pass);
}

static void copy_feedback(void *context, size_t first, size_t end)
{
    const struct lom_pass *pass = context;
    for (size_t i = first; i < end; i++)
        lom_copy_feedback(&pass->chunks[i]);
}

/* What the caller takes from a chunk that has been run. */
static void take_chunk(lom_device *device, size_t i)
{
    const struct lom_pass *pass = &device->pass;
    struct lom_chunk *chunk = &pass->chunks[i];
    lom_raise_room(&device->room, pass, chunk);
    if (i >= (size_t)device->desc.batch)
        lom_raise_room(&device->small_room, pass, chunk);
    device->counters.vertices += chunk->vertices_shaded;
    device->counters.triangles += chunk->count;
    device->counters.triangles_clipped += chunk->triangles_clipped;
    device->counters.triangles_binned += chunk->triangle_count;
    if (chunk->draw->desc.feedback != NULL)
        lom_place_feedback(chunk);
}

/* Of small draws a pass has some more or some less than the last: room for a few more. */
static bool prepare_chunks(lom_device *device)
{
    enum { MORE = 32 };
    size_t first = device->pass.chunk_count, end = (first + MORE - 1) / MORE * MORE;
    bool done = true;
    for (size_t i = first; i < end && i < device->chunk_capacity && first > (size_t)device->desc.batch && done; i++)
        done = lom_prepare_chunk(&device->small_room, &device->chunks[i]);
    return done || lom_fail(&device->error, LOM_ERROR_MEMORY, "The system gave no memory for the draws of a pass.");
}

static bool run_batch(lom_device *device)
{
    struct lom_pass *pass = &device->pass;
    pass->chunks_left -= pass->chunk_count;
    pass->last_batch = pass->chunks_left == 0;
    if (pass->chunk_count > 0)
        run_all(device, run_chunks, pass->chunk_count);
    for (size_t i = 0; i < pass->chunk_count; i++) {
        const struct lom_chunk *chunk = &pass->chunks[i];
        if (chunk->failed)
            return lom_fail(&device->error, LOM_ERROR_MEMORY, "The system gave no memory for a draw of %s.",
                            chunk->draw->desc.shader->name);
        take_chunk(device, i);
    }
    if (!prepare_chunks(device))
        return false;
    if (pass->feeds_back)
        lom_share_out(device->pool, pass->chunk_count, 1, copy_feedback, pass);
    if (!pass->desc.feedback_only)
        run_all(device, lom_run_tiles, (size_t)pass->tiles_x * (size_t)pass->tiles_y);
    if (pass->recorder != NULL)
        lom_record_batch(device);
    pass->chunk_count = 0;
    return true;
}

static const void *uniforms_of(const lom_device *device, const struct lom_call *call)
{
    return device->uniforms + (size_t)call->uniforms * UNIFORMS_UNIT;
}

const void *lom_uniforms_of_part(const struct lom_pass *pass, const struct lom_chunk *chunk, size_t i)
{
    return uniforms_of(pass->device, &chunk->calls[i]);
}

/* Whether a chunk of the draw may follow `chunks` others in a batch. Batches of small draws are longer: what a tile and a
 * barrier cost does not depend on how much a chunk holds. Their memory is little, since large ones never come there. */
static bool fits(const lom_device *device, size_t chunks, const struct lom_draw *draw, size_t triangles)
{
    bool small = triangles <= SMALL_DRAW && !draw->expands && draw->desc.culling.clusters == NULL;
    return chunks < (size_t)device->desc.batch || (small && chunks < device->most_chunks);
}

/* The next chunk, of a call that has so many triangles, or of several that have; NULL when a batch failed before it. */
static struct lom_chunk *add_chunk(lom_device *device, const struct lom_call *call, size_t triangles)
{
    struct lom_pass *pass = &device->pass;
    const struct lom_draw *draw = &device->draws[call->draw];
    if (!fits(device, pass->chunk_count, draw, triangles) && !run_batch(device))
        return NULL;
    struct lom_chunk *chunk = &device->chunks[pass->chunk_count++];
    chunk->draw = draw;
    chunk->uniforms = uniforms_of(device, call);
    chunk->instance = 0;
    chunk->base_vertex = call->base_vertex;
    chunk->first = call->first;
    chunk->count = triangles;
    chunk->runs = NULL;
    chunk->run_count = 0;
    chunk->parts = NULL;
    return chunk;
}

/* Clusters of a draw: the runs of each chunk. */
static bool run_clusters(lom_device *device, const struct lom_call *call)
{
    const struct lom_draw *draw = &device->draws[call->draw];
    const struct lom_run *run = device->runs + draw->first_run, *end = run + draw->run_count;
    while (run < end) {
        const struct lom_run *first = run;
        size_t count = 0;
        for (; run < end && run->chunk == first->chunk; run++)
            count += lom_triangles_of_run(draw->desc.culling.clusters, run);
        struct lom_chunk *chunk = add_chunk(device, call, call->triangles);
        if (chunk == NULL)
            return false;
        chunk->count = count;
        chunk->runs = first;
        chunk->run_count = (size_t)(run - first);
    }
    return true;
}

static bool run_call(lom_device *device, const struct lom_call *call)
{
    const struct lom_draw *draw = &device->draws[call->draw];
    size_t limit = draw->unit;
    if (draw->desc.culling.clusters != NULL)
        return run_clusters(device, call);
    if (!draw->rasterizes && draw->desc.feedback == NULL)
        return true;
    for (int instance = 0; instance < draw->desc.instances; instance++)
        for (size_t first = 0; first < call->triangles; first += limit) {
            struct lom_chunk *chunk = add_chunk(device, call, call->triangles);
            if (chunk == NULL)
                return false;
            chunk->instance = instance;
            chunk->first = call->first + first;
            chunk->count = call->triangles - first < limit ? call->triangles - first : limit;
        }
    return true;
}

/* Calls from number i on that share a chunk. */
static bool run_joined(lom_device *device, size_t i, size_t count)
{
    const struct lom_call *calls = device->calls + i;
    struct lom_chunk *chunk = add_chunk(device, calls, lom_joined_triangles(calls, count));
    if (chunk == NULL)
        return false;
    chunk->calls = calls;
    chunk->parts = device->pass.parts + i;
    chunk->part_count = count;
    return true;
}

static void count_work(lom_device *device)
{
    size_t tiles = (size_t)device->pass.tiles_x * (size_t)device->pass.tiles_y;
    for (size_t i = 0; i < tiles; i++)
        device->counters.tiles += device->pass.tile_touched[i];
    for (int i = 0; i < device->desc.threads; i++) {
        device->counters.fragments += device->worker_tiles[i].fragments;
        device->counters.packets += device->worker_tiles[i].packets;
        device->worker_tiles[i].fragments = device->worker_tiles[i].packets = 0;
    }
}

/* Chunks that run_call or run_joined will make. */
static size_t count_chunks(const struct lom_draw *draw, size_t triangles, size_t joined)
{
    size_t limit = draw->unit;
    if (joined > 1)
        return 1;
    if (!draw->rasterizes && draw->desc.feedback == NULL)
        return 0;
    if (draw->desc.culling.clusters != NULL)
        return draw->chunk_count;
    return (triangles + limit - 1) / limit * (size_t)draw->desc.instances;
}

static bool lay_tile_memory(lom_device *device)
{
    struct lom_pass *pass = &device->pass;
    size_t tiles = (size_t)pass->tiles_x * (size_t)pass->tiles_y;
    pass->chunks_left = 0;
    pass->single_batch = true;
    for (size_t i = 0, joined; i < pass->call_count; i += joined) {
        const struct lom_call *call = &device->calls[i];
        const struct lom_draw *draw = &device->draws[call->draw];
        joined = lom_joined_calls(pass, i);
        size_t triangles = lom_joined_triangles(call, joined), chunks = count_chunks(draw, triangles, joined);
        pass->chunks_left += chunks;
        pass->single_batch &= chunks == 0 || fits(device, pass->chunks_left - 1, draw, triangles);
    }
    if (!lom_lay_chunks(device, pass->chunks_left))
        return false;
    size_t threads = (size_t)device->desc.threads, count = pass->single_batch ? threads : tiles;
    size_t scratch = pass->samples > 1 ? lom_scratch_bytes(pass) : 0;
    if (!lom_renew_bare(&device->tile_memory, &device->tile_memory_capacity,
                        count * pass->tile_bytes + threads * scratch, 1, NULL))
        return lom_fail(&device->error, LOM_ERROR_MEMORY, "The system gave no memory for the tiles of a %dx%d pass.",
                        pass->width, pass->height);
    pass->tile_memory = device->tile_memory;
    for (size_t i = 0; i < threads && scratch != 0; i++)
        device->worker_tiles[i].scratch = device->tile_memory + count * pass->tile_bytes + i * scratch;
    return true;
}

/* A draw whose shader reads nothing runs it once. */
static void find_paint(lom_device *device, struct lom_draw *draw, const void *uniforms)
{
    lom_stages_of(draw->variant)->find_paint(&device->pass, draw, uniforms);
    device->counters.packets++;
}

static void note_depth(struct lom_pass *pass, const struct lom_draw *draw)
{
    pass->writes_depth |= draw->depth_write;
    pass->uses_stencil |= draw->desc.stencil.enabled;
    pass->uses_depth |= draw->depth_write || draw->compare != LOM_COMPARE_ALWAYS || draw->desc.shader->reads_depth;
}

/* Which clusters of the pass's draws may be seen. */
static bool cull_draws(lom_device *device)
{
    device->run_count = 0;
    for (size_t i = 0; i < device->pass.draw_count; i++) {
        struct lom_draw *draw = &device->draws[i];
        if (draw->rasterizes && draw->desc.culling.clusters != NULL && !lom_find_runs(device, draw))
            return lom_fail(&device->error, LOM_ERROR_MEMORY, "The system gave no memory for the clusters of %s.",
                            draw->desc.shader->name);
    }
    return true;
}

static bool run_calls(lom_device *device)
{
    const struct lom_pass *pass = &device->pass;
    for (size_t i = 0, joined; i < pass->call_count; i += joined) {
        const struct lom_call *call = &device->calls[i];
        struct lom_draw *draw = &device->draws[call->draw];
        joined = lom_joined_calls(pass, i);
        if (draw->constant)
            find_paint(device, draw, uniforms_of(device, call));
        if (joined > 1 ? !run_joined(device, i, joined) : !run_call(device, call))
            return false;
    }
    return true;
}

bool lom_run_pass(lom_device *device)
{
    struct lom_pass *pass = &device->pass;
    pass->reached = device->reached;
    pass->chunk_count = 0;
    for (size_t i = 0; i < pass->draw_count; i++) {
        note_depth(pass, &device->draws[i]);
        if (device->draws[i].desc.feedback != NULL)
            device->draws[i].desc.feedback->written = device->draws[i].desc.feedback->needed = 0;
    }
    lom_forget_other_samples(pass);
    if (!cull_draws(device) || !lom_begin_counting(device))
        return false;
    if (!lom_join_calls(device) || !lay_tile_memory(device) || !run_calls(device) || !run_batch(device))
        return false;
    count_work(device);
    lom_end_counting(device);
    for (int i = 0; i < pass->colors; i++)
        lom_finish_slice(device, pass->color[i].texture, pass->color[i].slice);
    if (pass->depth != NULL)
        lom_finish_slice(device, pass->depth, pass->depth_slice);
    if (pass->tallier != NULL && !lom_tally_end(device))
        return false;
    return pass->recorder == NULL || lom_record_end(device);
}
