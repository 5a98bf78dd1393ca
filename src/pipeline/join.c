/* Calls of one draw that share a chunk. In: the calls of a pass. Out: which of them do; in a chunk of them, its corners and
 * shaded vertices. Thousands of boxes are as many triangles of one mesh then: set-up, coverage and tests of depths take
 * them together, and only packets of a shader, which has one call's uniforms, end where a call does.
 * Invariant: triangles stay in the order of their calls, so what they draw is what chunks of their own would. */
#include "pipeline/base_vertex.h"
#include "pipeline/device.h"
#include "pipeline/variants.h"

/* Lists of triangles by plain indices, whose fragments wait for others in the tile's list alone. */
static bool joins(const struct lom_draw *draw)
{
    const lom_draw_desc *desc = &draw->desc;
    return draw->packs && draw->rasterizes && !draw->expands && desc->topology == LOM_TRIANGLES &&
           desc->indices != NULL && desc->index_bits == 32 && !desc->restart &&
           desc->provoking != LOM_PROVOKING_FIRST && desc->instances == 1 && desc->culling.clusters == NULL;
}

static const uint32_t *indices_of(const struct lom_draw *draw, const struct lom_call *call)
{
    return (const uint32_t *)draw->desc.indices + draw->desc.first + 3 * (size_t)call->first;
}

/* Indices that calls of a draw have had, and the extremes of them. */
enum { KNOWN_BITS = 6, PIECE = 512 /* calls that a worker looks at, at a time */ };
struct known_indices {
    uint32_t first, triangles; /* 0: none */
    uint32_t low, high;
};

/* Calls have the same few lists of indices time and again (boxes of one mesh, blocks of terrain): each is read once. */
static const struct known_indices *find_extremes(const struct lom_draw *draw, const struct lom_call *call,
                                                 struct known_indices known[1 << KNOWN_BITS])
{
    struct known_indices *of = &known[(call->first ^ call->triangles) * UINT32_C(2654435769) >> (32 - KNOWN_BITS)];
    if (of->first != call->first || of->triangles != call->triangles) {
        *of = (struct known_indices){ .first = call->first, .triangles = call->triangles };
        lom_stages_of(draw->variant)
            ->find_extremes(indices_of(draw, call), 3 * (size_t)call->triangles, &of->low, &of->high);
    }
    return of;
}

/* The vertices of a call, a range or, where that is too long, one for each corner; false where they are not all there, or of
 * more triangles than a small draw: a chunk of such costs little more than what finding them here would. */
static bool find_vertices(const struct lom_draw *draw, const struct lom_call *call, struct known_indices *known,
                          struct lom_part *part)
{
    if (call->triangles == 0 || call->triangles > SMALL_DRAW)
        return call->triangles == 0;
    const struct known_indices *extremes = find_extremes(draw, call, known);
    uint32_t low = extremes->low, high = extremes->high;
    if (!lom_move_vertices(&draw->desc, call->base_vertex, &low, &high))
        return false;
    const bool is_range = high - low < MOST_ROWS * call->triangles;
    part->base = is_range ? low : NO_VERTEX;
    part->vertices = is_range ? high - low + 1 : 3 * call->triangles;
    return true;
}

/* Whether a call stands beside another of its draw. */
static bool has_neighbour(const struct lom_pass *pass, const struct lom_call *calls, size_t i)
{
    return (i > 0 && calls[i - 1].draw == calls[i].draw) ||
           (i + 1 < pass->call_count && calls[i + 1].draw == calls[i].draw);
}

/* The vertices of calls that may share a chunk; none of the others. */
static void find_parts(void *context, size_t first, size_t end)
{
    const lom_device *device = context;
    const struct lom_draw *draw = NULL;
    struct known_indices known[1 << KNOWN_BITS];
    bool may_join = false;
    for (size_t i = first; i < end; i++) {
        struct lom_part *part = &device->parts[i];
        *part = (struct lom_part){ .joined = 1 };
        if (!has_neighbour(&device->pass, device->calls, i))
            continue;
        if (draw != &device->draws[device->calls[i].draw]) {
            draw = &device->draws[device->calls[i].draw];
            may_join = joins(draw);
            memset(known, 0, sizeof known);
        }
        if (may_join && !find_vertices(draw, &device->calls[i], known, part))
            part->vertices = 0;
    }
}

/* `count` calls of a draw: chunks of about as many triangles as those of one mesh would have. */
static void join_calls(const struct lom_call *calls, size_t count, size_t limit, struct lom_part *parts)
{
    size_t begin = 0, triangles = 0, rows = 0; /* of the chunk at hand */
    bool is_whole = false;                     /* the call before is */
    for (size_t i = 0; i < count; i++) {
        bool starts = !is_whole || triangles + calls[i].triangles > limit;
        is_whole = calls[i].triangles == 0 || parts[i].vertices > 0;
        if (starts || !is_whole) {
            begin = i;
            triangles = rows = 0;
        }
        parts[begin].joined = (uint32_t)(i - begin + 1);
        parts[i].row = (uint32_t)rows;
        rows += parts[i].vertices;
        triangles += calls[i].triangles;
    }
}

bool lom_join_calls(lom_device *device)
{
    struct lom_pass *pass = &device->pass;
    if (pass->call_count == pass->draw_count || pass->one_by_one || pass->is_recorded)
        return true;
    if (!lom_reserve(&device->parts, &device->part_capacity, pass->call_count, sizeof *device->parts, NULL))
        return lom_fail(&device->error, LOM_ERROR_MEMORY, "The system gave no memory for the draws of a pass.");
    pass->parts = device->parts;
    lom_share_out(device->pool, pass->call_count, PIECE, find_parts, device);
    for (size_t i = 0, count; i < pass->call_count; i += count) {
        const struct lom_call *calls = device->calls + i;
        const struct lom_draw *draw = &device->draws[calls->draw];
        for (count = 1; i + count < pass->call_count && calls[count].draw == calls->draw;)
            count++;
        size_t limit = lom_even_share(lom_joined_triangles(calls, count), (size_t)device->desc.chunk);
        if (count > 1 && joins(draw))
            join_calls(calls, count, limit, pass->parts + i);
    }
    return true;
}

size_t lom_joined_calls(const struct lom_pass *pass, size_t i)
{
    return pass->parts != NULL ? pass->parts[i].joined : 1;
}

size_t lom_joined_triangles(const struct lom_call *calls, size_t count)
{
    size_t triangles = 0;
    for (size_t i = 0; i < count; i++)
        triangles += calls[i].triangles;
    return triangles;
}

/* The vertices of a part that is listed, from its first row on, and the rows as its corners. */
static void list_vertices(uint32_t *list, const uint32_t *index, const struct lom_part *part, int32_t base_vertex,
                          uint32_t *corners)
{
    for (uint32_t k = 0; k < part->vertices; k++) {
        list[part->row + k] = index[k] + (uint32_t)base_vertex;
        corners[k] = part->row + k;
    }
}

bool lom_choose_parts(const struct lom_room *room, struct lom_chunk *chunk)
{
    struct lom_assembly *assembly = chunk->assembly;
    const struct lom_part *last = &chunk->parts[chunk->part_count - 1];
    chunk->vertex_count = last->row + last->vertices;
    if (!lom_renew(&assembly->corners, &assembly->corners_capacity, lom_larger_size(3 * chunk->count, room->corners),
                   sizeof(uint32_t), NULL) ||
        !lom_renew(&assembly->vertex_list, &assembly->vertex_list_capacity,
                   lom_larger_size(chunk->vertex_count, room->vertices), sizeof(uint32_t), NULL))
        return false;
    chunk->has_gaps = false;
    chunk->needed = NULL;
    uint32_t *corners = assembly->corners;
    for (size_t i = 0; i < chunk->part_count; i++) {
        const struct lom_part *part = &chunk->parts[i];
        const struct lom_call *call = &chunk->calls[i];
        const uint32_t *index = indices_of(chunk->draw, call);
        size_t count = 3 * (size_t)call->triangles;
        if (part->base == NO_VERTEX)
            list_vertices(assembly->vertex_list, index, part, call->base_vertex, corners);
        else
            lom_stages_of(chunk->draw->variant)
                ->rebase_indices(index, count, lom_index_of(part->base, call->base_vertex) - part->row, corners);
        corners += count;
    }
    return true;
}

void lom_begin_part(const struct lom_pass *pass, struct lom_chunk *chunk, size_t i)
{
    const struct lom_part *part = &chunk->parts[i];
    chunk->uniforms = lom_uniforms_of_part(pass, chunk, i);
    chunk->listed = part->base == NO_VERTEX;
    chunk->vertex_base = part->base;
    chunk->vertex_count = part->vertices;
    chunk->first_row = part->row;
}

void lom_end_parts(struct lom_chunk *chunk)
{
    const size_t pitch = (size_t)chunk->draw->row_floats;
    size_t at = 0;
    for (size_t i = 0; i < chunk->part_count; i++) {
        const struct lom_part *part = &chunk->parts[i];
        const size_t rows = (part->row + part->vertices) * pitch;
        while (at < chunk->triangle_count && chunk->primitives[at].row[0] < rows)
            at++;
        chunk->parts[i].end = (uint32_t)at;
    }
}
