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

void lom_run_tiles(void *context, int worker)
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
