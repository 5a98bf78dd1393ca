/* The arrays of a chunk: room for what it needs, so that nothing is allocated once frames resemble those before them. */
#include "pipeline/stages.h"

enum { PADDING = 16 }; /* rows: the vertex stage writes whole packets; as many hold the pieces of a triangle */
enum { SPILLED = 17 }; /* primitives that set-up writes past the last one: a packet, and a part of another */

static void raise_to(size_t *most, size_t needed, size_t part)
{
    if (needed > *most)
        *most = needed + needed / part;
}

/* A chunk keeps at most as many triangles as it has, and a few more of those that are cut; how many tiles they touch
 * changes with every view, so there is room for half more. */
void lom_raise_room(struct lom_room *room, const struct lom_pass *pass, const struct lom_chunk *chunk)
{
    enum { FEW = 64 };
    size_t vertices = chunk->row_count + 2 * PADDING, tiles = (size_t)pass->tiles_x * (size_t)pass->tiles_y;
    raise_to(&room->corners, 3 * chunk->count, FEW);
    raise_to(&room->rows, vertices * (size_t)chunk->draw->row_floats, FEW);
    raise_to(&room->vertices, vertices, FEW);
    raise_to(&room->triangles, lom_larger_size(chunk->count, chunk->triangle_count) + SPILLED, FEW);
    raise_to(&room->tiles, tiles + 2, FEW);
    if (chunk->tile_high >= 0)
        raise_to(&room->listed, chunk->tile_first[chunk->tile_high - chunk->tile_low + 1], 2);
}

/* What a chunk itself holds. */
static bool renew_chunk(const struct lom_room *room, struct lom_chunk *chunk, size_t rows, size_t triangles)
{
    return lom_renew(&chunk->rows, &chunk->rows_capacity, rows, sizeof(float), NULL) &&
           lom_renew(&chunk->primitives, &chunk->primitives_capacity, triangles, sizeof(lom_primitive), NULL) &&
           lom_renew(&chunk->tile_first, &chunk->tile_first_capacity, room->tiles, sizeof(uint32_t), NULL) &&
           lom_renew(&chunk->tile_list, &chunk->tile_list_capacity, room->listed, sizeof(uint32_t), NULL);
}

bool lom_prepare_chunk(const struct lom_room *room, struct lom_chunk *chunk)
{
    return renew_chunk(room, chunk, room->rows, room->triangles);
}

/* The arrays of a chunk that begins, as long at least as any before: frames that resemble those before them ask for no
 * memory, whichever chunk has which triangles. */
bool lom_make_room(const struct lom_room *room, struct lom_chunk *chunk)
{
    struct lom_assembly *assembly = chunk->assembly;
    size_t needed = chunk->vertex_count + PADDING, vertices = lom_larger_size(needed, room->vertices);
    size_t rows = lom_larger_size(needed * (size_t)chunk->draw->row_floats, room->rows);
    size_t triangles = lom_larger_size(chunk->count + SPILLED, room->triangles);
    return renew_chunk(room, chunk, rows, triangles) &&
           lom_renew(&assembly->clip, &assembly->clip_capacity, vertices * 4, sizeof(float), NULL) &&
           lom_renew(&assembly->codes, &assembly->codes_capacity, vertices, sizeof(uint16_t), NULL) &&
           lom_renew(&assembly->tile, &assembly->tile_capacity, triangles, sizeof(int32_t), NULL);
}

bool lom_reserve_rows(struct lom_chunk *chunk, size_t rows)
{
    struct lom_assembly *assembly = chunk->assembly;
    size_t padded = rows + PADDING;
    if (!lom_reserve(&chunk->rows, &chunk->rows_capacity, padded * (size_t)chunk->draw->row_floats, sizeof(float),
                     NULL) ||
        !lom_reserve(&assembly->clip, &assembly->clip_capacity, padded * 4, sizeof(float), NULL) ||
        !lom_reserve(&assembly->codes, &assembly->codes_capacity, padded, sizeof(uint16_t), NULL)) {
        chunk->failed = true;
        return false;
    }
    return true;
}

bool lom_reserve_primitives(struct lom_chunk *chunk, size_t count)
{
    struct lom_assembly *assembly = chunk->assembly;
    bool done =
        lom_reserve(&chunk->primitives, &chunk->primitives_capacity, count + SPILLED, sizeof(lom_primitive), NULL) &&
        lom_reserve(&assembly->tile, &assembly->tile_capacity, count + SPILLED, sizeof(int32_t), NULL);
    chunk->failed |= !done;
    return done;
}
