/* The second half of the pipeline: every tile through the chunks of a batch. In: their lists. Out: tile memory, and after
 * the last batch the attachments. Invariant: a tile belongs to one worker until the batch is drained. */
#include "pipeline/device.h"
#include "pipeline/samples.h"
#include "pipeline/tally.h"
#include "pipeline/variants.h"

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

/* Where the chunk's list for the tile begins, and behind it where it ends. */
static const uint32_t *ends_of_list(const struct lom_chunk *chunk, int number)
{
    return chunk->tile_first + (number - chunk->tile_low);
}

/* Brings a chunk's list of the tile near: another core may have written it. */
static void prefetch_list(const struct lom_chunk *chunk, int number)
{
    const uint32_t *list = chunk->tile_list + *ends_of_list(chunk, number);
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

/* A chunk's triangles of the tile at hand. */
static void run_list(struct lom_tile *tile, const struct lom_chunk *chunk)
{
    const uint32_t *end = ends_of_list(chunk, tile->number);
    if (tile->draw != NULL && tile->draw != chunk->draw)
        lom_stages_of(tile->draw->variant)->flush(tile);
    tile->draw = chunk->draw;
    lom_stages_of(chunk->draw->variant)->raster(tile, chunk, chunk->tile_list + end[0], end[1] - end[0]);
}

/* The batch's triangles of one tile; its bits are zeros again for the next batch. */
static void run_tile(struct lom_pass *pass, struct lom_tile *tile, int number, uint8_t *memory)
{
    _Atomic uint64_t *reached = pass->reached + (size_t)number * pass->reached_words;
    bool placed = false;
    tile->is_whole = false;
    for (size_t first = 0; first < pass->chunk_count; first += CHUNKS_WORD, reached++) {
        uint64_t bits = atomic_load_explicit(reached, memory_order_relaxed);
        if (bits == 0)
            continue;
        atomic_store_explicit(reached, 0, memory_order_relaxed);
        if (!placed) {
            place_tile(pass, tile, number, memory);
            if (!pass->tile_touched[number])
                begin_tile(pass, tile);
            pass->tile_touched[number] = 1;
            placed = true;
        }
        while (bits != 0) {
            const struct lom_chunk *chunk = &pass->chunks[first + (size_t)__builtin_ctzll(bits)];
            bits &= bits - 1;
            if (bits != 0)
                prefetch_list(&pass->chunks[first + (size_t)__builtin_ctzll(bits)], number);
            run_list(tile, chunk);
        }
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
        lom_clear_tile(pass, number);
    lom_fill_tile_columns(pass, number);
}

void lom_run_tiles(void *context, int worker)
{
    struct lom_pass *pass = context;
    struct lom_tile *tile = &pass->device->worker_tiles[worker];
    lom_portion *portions = lom_pool_portions(pass->device->pool);
    size_t i;
    while (lom_take_portion(portions, pass->device->desc.threads, worker, 1, &i) > 0) {
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
