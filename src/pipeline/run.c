/* Running a pass: batches of chunks, a barrier between the two halves of the pipeline. Work is handed out by a counter;
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
    for (;;) {
        size_t first = atomic_fetch_add_explicit(&pass->next, some, memory_order_relaxed);
        for (size_t i = first; i < count && i < first + some; i++)
            lom_run_chunk(pass, &pass->chunks[i], &pass->device->assemblies[worker]);
        if (first >= count)
            return;
    }
}

/* A tile's memory lasts from batch to batch; in a pass of one batch a worker's serves all its tiles, and stays in its
 * cache. */
static uint8_t *memory_of(const struct lom_pass *pass, int number, int worker)
{
    return pass->tile_memory + (size_t)(pass->single_batch ? worker : number) * pass->tile_bytes;
}

static void place_tile(struct lom_pass *pass, struct lom_tile *tile, int number, uint8_t *memory)
{
    size_t pixels = (size_t)pass->tile * (size_t)pass->tile;
    tile->pass = pass;
    tile->draw = NULL;
    tile->edge = pass->tile;
    tile->x = pass->tile_x0 + number % pass->tiles_x * pass->tile;
    tile->y = pass->tile_y0 + number / pass->tiles_x * pass->tile;
    tile->depth = NULL;
    tile->stencil = NULL;
    tile->number = number;
    tile->memory = memory;
    for (int k = 0; k < 16; k++)
        tile->offset[k] = (k & 7) + (k >> 3) * 2 * pass->tile;
    if (pass->samples > 1) {
        lom_place_samples(pass, tile, memory);
        return;
    }
    if (pass->uses_depth) {
        tile->depth = (float *)(void *)memory;
        memory += pixels * 4;
    }
    if (pass->uses_stencil) {
        tile->stencil = (int32_t *)(void *)memory;
        memory += pixels * 4;
    }
    for (int i = 0; i < pass->colors; i++) {
        tile->color[i] = memory;
        memory += lom_image_bytes(pass, i);
    }
}

/* The chunk from `i` on that has a list for a tile, which may be empty; or the number of chunks. */
static size_t next_reaching(const struct lom_pass *pass, size_t i, int number)
{
    while (i < pass->chunk_count && (uint32_t)(number - pass->reaches[i].low) > pass->reaches[i].span)
        i++;
    return i;
}

/* Where the chunk's list for the tile begins, and behind it where it ends. */
static const uint32_t *ends_of_list(const struct lom_chunk *chunk, int number)
{
    return chunk->tile_first + (number - chunk->tile_low);
}

/* Brings a chunk's list of the tile near: another core may have written it. */
static void prefetch_list(const struct lom_pass *pass, size_t i, int number)
{
    if (i >= pass->chunk_count)
        return;
    const uint32_t *list = pass->chunks[i].tile_list + *ends_of_list(&pass->chunks[i], number);
    __builtin_prefetch(list);
    __builtin_prefetch(list + 16);
}

/* A tile that is drawn for the first time begins as the clear colour, in memory only where that is not one word. */
static void begin_tile(struct lom_pass *pass, struct lom_tile *tile)
{
    const struct lom_color_target *target = &pass->color[0];
    if (pass->samples > 1) {
        lom_begin_samples(pass, tile);
        return;
    }
    tile->is_whole = pass->single_batch && pass->colors == 1 && target->kind != COLOR_FLOAT && !target->keep;
    tile->whole = target->clear_bytes;
    if (!tile->is_whole)
        lom_load_tile(pass, tile->number, tile->memory);
}

/* The batch's triangles of one tile. */
static void run_tile(struct lom_pass *pass, struct lom_tile *tile, int number, uint8_t *memory)
{
    bool placed = false;
    tile->is_whole = false;
    for (size_t i = next_reaching(pass, 0, number), next; i < pass->chunk_count; i = next) {
        const struct lom_chunk *chunk = &pass->chunks[i];
        next = next_reaching(pass, i + 1, number);
        prefetch_list(pass, next, number);
        const uint32_t *begin = ends_of_list(chunk, number);
        uint32_t first = begin[0], end = begin[1];
        if (first == end)
            continue;
        if (!placed) {
            place_tile(pass, tile, number, memory);
            if (!pass->tile_touched[number])
                begin_tile(pass, tile);
            pass->tile_touched[number] = 1;
            placed = true;
        }
        if (tile->draw != NULL && tile->draw != chunk->draw)
            lom_stages_of(tile->draw->variant)->flush(tile);
        tile->draw = chunk->draw;
        lom_stages_of(chunk->draw->variant)->raster(tile, chunk, chunk->tile_list + first, end - first);
    }
    if (placed)
        lom_stages_of(tile->draw->variant)->flush(tile);
}

/* After the last batch a tile is resolved at once; one that no triangle came near holds its clear values, or keeps what
 * the attachments hold. */
static void finish_tile(struct lom_pass *pass, struct lom_tile *tile, int number, uint8_t *memory)
{
    if (pass->samples > 1) {
        place_tile(pass, tile, number, memory);
        lom_end_samples(pass, tile, pass->tile_touched[number]);
    } else if (tile->is_whole)
        lom_resolve_whole_tile(pass, number, tile->whole);
    else if (pass->tile_touched[number])
        lom_resolve_tile(pass, number, memory);
    else
        lom_clear_tile(pass, number, memory);
}

static void run_tiles(void *context, int worker)
{
    struct lom_pass *pass = context;
    struct lom_tile *tile = &pass->device->worker_tiles[worker];
    size_t tiles = (size_t)pass->tiles_x * (size_t)pass->tiles_y;
    for (;;) {
        size_t i = atomic_fetch_add_explicit(&pass->next, 1, memory_order_relaxed);
        if (i >= tiles)
            return;
        uint8_t *memory = memory_of(pass, (int)i, worker);
        bool clocked = pass->tallier != NULL && pass->tallier->desc.clock;
        int64_t since = clocked ? lom_tally_clock() : 0;
        run_tile(pass, tile, (int)i, memory);
        if (pass->last_batch)
            finish_tile(pass, tile, (int)i, memory);
        if (clocked)
            lom_tally_time(pass, (int)i, since);
    }
}

static void run_all(lom_device *device, lom_work *work)
{
    atomic_store_explicit(&device->pass.next, 0, memory_order_relaxed);
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
    device->reaches[i] =
        chunk->tile_high < 0
            ? (struct lom_tile_range){ .low = INT32_MAX }
            : (struct lom_tile_range){ chunk->tile_low, (uint32_t)(chunk->tile_high - chunk->tile_low) };
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
        run_all(device, run_chunks);
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
        run_all(device, run_tiles);
    if (pass->recorder != NULL)
        lom_record_batch(device);
    pass->chunk_count = 0;
    return true;
}

/* Whether a chunk of the draw may follow `chunks` others in a batch. Batches of small draws are longer: what a tile and a
 * barrier cost does not depend on how much a chunk holds. Their memory is little, since large ones never come there. */
static bool fits(const lom_device *device, size_t chunks, const struct lom_draw *draw)
{
    enum { SMALL = 256 };
    bool small = draw->triangles <= SMALL && !draw->expands && draw->desc.culling.clusters == NULL;
    return chunks < (size_t)device->desc.batch || (small && chunks < device->most_chunks);
}

static bool add_chunk(lom_device *device, const struct lom_draw *draw, int instance, size_t first, size_t count,
                      const struct lom_run *runs, size_t run_count)
{
    struct lom_pass *pass = &device->pass;
    if (!fits(device, pass->chunk_count, draw) && !run_batch(device))
        return false;
    struct lom_chunk *chunk = &device->chunks[pass->chunk_count++];
    chunk->draw = draw;
    chunk->instance = instance;
    chunk->first = first;
    chunk->count = count;
    chunk->runs = runs;
    chunk->run_count = run_count;
    return true;
}

/* Clusters of a draw: the runs of each chunk. */
static bool run_clusters(lom_device *device, const struct lom_draw *draw)
{
    const struct lom_run *run = device->runs + draw->first_run, *end = run + draw->run_count;
    while (run < end) {
        const struct lom_run *first = run;
        size_t count = 0;
        for (; run < end && run->chunk == first->chunk; run++)
            count += lom_triangles_of_run(draw->desc.culling.clusters, run);
        if (!add_chunk(device, draw, 0, 0, count, first, (size_t)(run - first)))
            return false;
    }
    return true;
}

static bool run_draw(lom_device *device, const struct lom_draw *draw)
{
    size_t limit = draw->unit;
    if (draw->desc.culling.clusters != NULL)
        return run_clusters(device, draw);
    if (!draw->rasterizes && draw->desc.feedback == NULL)
        return true;
    for (int instance = 0; instance < draw->desc.instances; instance++)
        for (size_t first = 0; first < draw->triangles; first += limit) {
            size_t count = draw->triangles - first < limit ? draw->triangles - first : limit;
            if (!add_chunk(device, draw, instance, first, count, NULL, 0))
                return false;
        }
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

/* Chunks that run_draw will make of a draw. */
static size_t count_chunks(const struct lom_draw *draw)
{
    size_t limit = draw->unit;
    if (!draw->rasterizes && draw->desc.feedback == NULL)
        return 0;
    if (draw->desc.culling.clusters != NULL)
        return draw->chunk_count;
    return (draw->triangles + limit - 1) / limit * (size_t)draw->desc.instances;
}

static bool lay_tile_memory(lom_device *device)
{
    struct lom_pass *pass = &device->pass;
    size_t tiles = (size_t)pass->tiles_x * (size_t)pass->tiles_y;
    pass->chunks_left = 0;
    pass->single_batch = true;
    for (size_t i = 0; i < pass->draw_count; i++) {
        size_t chunks = count_chunks(&device->draws[i]);
        pass->chunks_left += chunks;
        pass->single_batch &= chunks == 0 || fits(device, pass->chunks_left - 1, &device->draws[i]);
    }
    if (!lom_lay_chunks(device, pass->chunks_left))
        return false;
    size_t threads = (size_t)device->desc.threads, count = pass->single_batch ? threads : tiles;
    size_t scratch = pass->samples > 1 ? lom_scratch_bytes(pass) : 0;
    if (!lom_reserve(&device->tile_memory, &device->tile_memory_capacity, count * pass->tile_bytes + threads * scratch,
                     1, NULL))
        return lom_fail(&device->error, LOM_ERROR_MEMORY, "The system gave no memory for the tiles of a %dx%d pass.",
                        pass->width, pass->height);
    pass->tile_memory = device->tile_memory;
    for (size_t i = 0; i < threads && scratch != 0; i++)
        device->worker_tiles[i].scratch = device->tile_memory + count * pass->tile_bytes + i * scratch;
    return true;
}

/* A draw whose shader reads nothing runs it once. */
static void find_paint(lom_device *device, struct lom_draw *draw)
{
    lom_stages_of(draw->variant)->find_paint(&device->pass, draw);
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

bool lom_run_pass(lom_device *device)
{
    struct lom_pass *pass = &device->pass;
    pass->chunk_count = 0;
    for (size_t i = 0; i < pass->draw_count; i++) {
        note_depth(pass, &device->draws[i]);
        if (device->draws[i].desc.feedback != NULL)
            device->draws[i].desc.feedback->written = device->draws[i].desc.feedback->needed = 0;
    }
    lom_forget_other_samples(pass);
    if (!cull_draws(device) || !lom_begin_counting(device))
        return false;
    if (!lay_tile_memory(device))
        return false;
    for (size_t i = 0; i < pass->draw_count; i++) {
        struct lom_draw *draw = &device->draws[i];
        draw->uniforms = device->uniforms + draw->uniforms_offset;
        if (draw->constant)
            find_paint(device, draw);
        if (!run_draw(device, draw))
            return false;
    }
    if (!run_batch(device))
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
