/* Running a pass: batches of chunks, a barrier between the two halves of the pipeline. Work is handed out by a counter;
 * which worker takes what changes nothing, because a chunk and a tile each belong to one worker until they are done. */
#include "pipeline/device.h"

static void run_chunks(void *context, int worker)
{
    struct lom_pass *pass = context;
    (void)worker;
    for (;;) {
        size_t i = atomic_fetch_add_explicit(&pass->next, 1, memory_order_relaxed);
        if (i >= pass->chunk_count)
            return;
        lom_run_chunk(pass, &pass->chunks[i]);
    }
}

static void place_tile(struct lom_pass *pass, struct lom_tile *tile, int number)
{
    uint8_t *memory = pass->tile_memory + (size_t)number * pass->tile_bytes;
    size_t pixels = (size_t)pass->tile * (size_t)pass->tile;
    tile->pass = pass;
    tile->draw = NULL;
    tile->edge = pass->tile;
    tile->x = pass->tile_x0 + number % pass->tiles_x * pass->tile;
    tile->y = pass->tile_y0 + number / pass->tiles_x * pass->tile;
    tile->depth = NULL;
    if (pass->depth != NULL) {
        tile->depth = (float *)(void *)memory;
        memory += pixels * 4;
    }
    for (int i = 0; i < pass->colors; i++) {
        tile->color[i] = memory;
        memory += pixels * (pass->color[i].kind == COLOR_FLOAT ? 16 : 4);
    }
    for (int k = 0; k < 16; k++)
        tile->offset[k] = (k & 7) + (k >> 3) * 2 * pass->tile;
}

void lom_run_tile(struct lom_pass *pass, struct lom_tile *tile, int number)
{
    bool placed = false;
    for (size_t i = 0; i < pass->chunk_count; i++) {
        const struct lom_chunk *chunk = &pass->chunks[i];
        uint32_t first = chunk->tile_first[number], end = chunk->tile_first[number + 1];
        if (chunk->failed || first == end)
            continue;
        if (!placed) {
            place_tile(pass, tile, number);
            if (!pass->tile_touched[number])
                lom_load_tile(pass, number);
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

static void run_tiles(void *context, int worker)
{
    struct lom_pass *pass = context;
    struct lom_tile *tile = &pass->device->worker_tiles[worker];
    size_t tiles = (size_t)pass->tiles_x * (size_t)pass->tiles_y;
    for (;;) {
        size_t i = atomic_fetch_add_explicit(&pass->next, 1, memory_order_relaxed);
        if (i >= tiles)
            return;
        lom_run_tile(pass, tile, (int)i);
    }
}

static void resolve_tiles(void *context, int worker)
{
    struct lom_pass *pass = context;
    size_t tiles = (size_t)pass->tiles_x * (size_t)pass->tiles_y;
    (void)worker;
    for (;;) {
        size_t i = atomic_fetch_add_explicit(&pass->next, 1, memory_order_relaxed);
        if (i >= tiles)
            return;
        lom_resolve_tile(pass, (int)i);
    }
}

static void run_all(lom_device *device, lom_work *work)
{
    atomic_store_explicit(&device->pass.next, 0, memory_order_relaxed);
    lom_run_pool(device->pool, work, &device->pass);
}

static bool run_batch(lom_device *device)
{
    struct lom_pass *pass = &device->pass;
    if (pass->chunk_count == 0)
        return true;
    run_all(device, run_chunks);
    for (size_t i = 0; i < pass->chunk_count; i++) {
        const struct lom_chunk *chunk = &pass->chunks[i];
        if (chunk->failed)
            return lom_fail(&device->error, LOM_ERROR_MEMORY, "The system gave no memory for a draw of %s.",
                            chunk->draw->desc.shader->name);
        device->counters.vertices += chunk->vertex_count;
        device->counters.triangles += chunk->count;
        device->counters.triangles_clipped += chunk->triangles_clipped;
        device->counters.triangles_binned += chunk->triangle_count;
    }
    run_all(device, run_tiles);
    pass->chunk_count = 0;
    return true;
}

static bool add_chunk(lom_device *device, const struct lom_draw *draw, int instance, size_t first, size_t count)
{
    struct lom_pass *pass = &device->pass;
    struct lom_chunk *chunk = &device->chunks[pass->chunk_count++];
    chunk->draw = draw;
    chunk->instance = instance;
    chunk->first = first;
    chunk->count = count;
    return pass->chunk_count < (size_t)device->desc.batch || run_batch(device);
}

static bool run_draw(lom_device *device, const struct lom_draw *draw)
{
    size_t limit = (size_t)device->desc.chunk;
    if (draw->scissor.width == 0 || draw->scissor.height == 0)
        return true;
    for (int instance = 0; instance < draw->desc.instances; instance++)
        for (size_t first = 0; first < draw->triangles; first += limit) {
            size_t count = draw->triangles - first < limit ? draw->triangles - first : limit;
            if (!add_chunk(device, draw, instance, first, count))
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

bool lom_run_pass(lom_device *device)
{
    struct lom_pass *pass = &device->pass;
    pass->chunks = device->chunks;
    pass->chunk_count = 0;
    for (int i = 0; i < device->desc.threads; i++)
        device->worker_tiles[i].constant_draw = NULL;
    for (size_t i = 0; i < pass->draw_count; i++) {
        device->draws[i].uniforms = device->uniforms + device->draws[i].uniforms_offset;
        if (!run_draw(device, &device->draws[i]))
            return false;
    }
    if (!run_batch(device))
        return false;
    run_all(device, resolve_tiles);
    count_work(device);
    for (int i = 0; i < pass->colors; i++)
        lom_finish_texture(pass->color[i].texture);
    if (pass->depth != NULL)
        lom_finish_texture(pass->depth);
    return true;
}
