/* Stage 4 of 7: bin. In: a chunk's triangles. Out: for each tile the list of those that may touch it, in their order (a
 * counting sort). Tiles are numbered row by row; a chunk has lists for the range of numbers that its triangles lie in, so
 * that a draw of a few triangles costs nothing elsewhere. */
#include "pipeline/stages.h"

struct span { /* tiles, inclusive */
    int x0, y0, x1, y1;
};

static inline struct span tiles_of(const struct lom_pass *pass, const lom_primitive *p)
{
    int shift = __builtin_ctz((unsigned)pass->tile);
    struct lom_bounds b = lom_bounds_of(p);
    return (struct span){ (b.left - pass->tile_x0) >> shift, (b.top - pass->tile_y0) >> shift,
                          (b.right - pass->tile_x0) >> shift, (b.bottom - pass->tile_y0) >> shift };
}

void lom_add_primitive(const struct lom_pass *pass, struct lom_chunk *chunk, const lom_primitive *primitive)
{
    struct span s = tiles_of(pass, primitive);
    int32_t first = s.y0 * pass->tiles_x + s.x0, last = s.y1 * pass->tiles_x + s.x1;
    chunk->assembly->tile[chunk->triangle_count] = first == last ? first : SEVERAL_TILES;
    chunk->primitives[chunk->triangle_count++] = *primitive;
    lom_widen_tiles(chunk, first, last);
}

/* Counts the triangles of each tile, into first[tile + 2]; returns the sum. */
static size_t count_triangles(const struct lom_pass *pass, const struct lom_chunk *chunk, uint32_t *first)
{
    const int32_t *tile = chunk->assembly->tile;
    int32_t low = chunk->tile_low;
    size_t total = chunk->triangle_count;
    for (size_t i = 0; i < chunk->triangle_count; i++) {
        if (tile[i] != SEVERAL_TILES) {
            first[tile[i] - low + 2]++;
            continue;
        }
        struct span s = tiles_of(pass, &chunk->primitives[i]);
        for (int y = s.y0; y <= s.y1; y++)
            for (int x = s.x0; x <= s.x1; x++)
                first[y * pass->tiles_x + x - low + 2]++;
        total += (size_t)(s.x1 - s.x0 + 1) * (size_t)(s.y1 - s.y0 + 1) - 1;
    }
    return total;
}

/* Writes them; first[tile + 1] moves from where a tile's list begins to where it ends. */
static void list_triangles(const struct lom_pass *pass, const struct lom_chunk *chunk, uint32_t *first)
{
    const int32_t *tile = chunk->assembly->tile;
    int32_t low = chunk->tile_low;
    uint32_t *list = chunk->tile_list;
    for (size_t i = 0; i < chunk->triangle_count; i++) {
        if (tile[i] != SEVERAL_TILES) {
            list[first[tile[i] - low + 1]++] = (uint32_t)i;
            continue;
        }
        struct span s = tiles_of(pass, &chunk->primitives[i]);
        for (int y = s.y0; y <= s.y1; y++)
            for (int x = s.x0; x <= s.x1; x++)
                list[first[y * pass->tiles_x + x - low + 1]++] = (uint32_t)i;
    }
}

/* Counts of tiles become where their lists begin; those that have one are noted. */
static void sum_up(const struct lom_pass *pass, const struct lom_chunk *chunk, uint32_t *first, size_t tiles)
{
    const size_t number = (size_t)(chunk - pass->chunks), words = pass->reached_words;
    const uint64_t bit = UINT64_C(1) << number % CHUNKS_WORD;
    _Atomic uint64_t *reached = pass->reached + (size_t)chunk->tile_low * words + number / CHUNKS_WORD;
    for (size_t i = 0; i < tiles; i++) {
        if (first[i + 2] != 0)
            atomic_fetch_or_explicit(&reached[i * words], bit, memory_order_relaxed);
        first[i + 2] += first[i + 1];
    }
}

void lom_bin_chunk(const struct lom_pass *pass, struct lom_chunk *chunk)
{
    if (chunk->tile_high < 0)
        return;
    size_t tiles = (size_t)(chunk->tile_high - chunk->tile_low) + 1;
    if (!lom_reserve(&chunk->tile_first, &chunk->tile_first_capacity, tiles + 2, sizeof(uint32_t), NULL)) {
        chunk->failed = true;
        return;
    }
    uint32_t *first = chunk->tile_first;
    memset(first, 0, (tiles + 2) * sizeof *first);
    size_t total = count_triangles(pass, chunk, first);
    if (!lom_reserve(&chunk->tile_list, &chunk->tile_list_capacity, total, sizeof(uint32_t), NULL)) {
        chunk->failed = true;
        return;
    }
    sum_up(pass, chunk, first, tiles);
    list_triangles(pass, chunk, first);
}
