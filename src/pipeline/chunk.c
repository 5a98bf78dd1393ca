/* One chunk through the first half of the pipeline: which vertices it needs, shading them, assembling triangles
 * (cutting those that cross the clip volume), set-up in groups, bins. In: a chunk's range. Out: its triangles and bins,
 * in order. */
#include "pipeline/base_vertex.h"
#include "pipeline/device.h"
#include "pipeline/expand.h"
#include "pipeline/provoking.h"
#include "pipeline/record.h"
#include "pipeline/variants.h"

enum { GROUP = 16 }; /* triangles that are looked at together: a whole number of packets at every width */

/* The index at a place of the draw's index buffer, or the place itself; UINT32_MAX for the restart index. */
static uint32_t index_at(const lom_draw_desc *desc, size_t place)
{
    if (desc->indices == NULL)
        return (uint32_t)(desc->first + place);
    if (desc->index_bits == 16) {
        uint16_t index = ((const uint16_t *)desc->indices)[desc->first + place];
        return desc->restart && index == UINT16_MAX ? UINT32_MAX : index;
    }
    return ((const uint32_t *)desc->indices)[desc->first + place];
}

/* Places of triangle t's corners in the index buffer; the last is the provoking vertex. */
static void corner_places(lom_topology topology, size_t t, size_t place[3])
{
    switch (topology) {
    default:
        place[0] = 3 * t;
        place[1] = 3 * t + 1;
        place[2] = 3 * t + 2;
        break;
    case LOM_TRIANGLE_STRIP: /* every second triangle is turned round */
        place[0] = t + (t & 1);
        place[1] = t + 1 - (t & 1);
        place[2] = t + 2;
        break;
    case LOM_TRIANGLE_FAN:
        place[0] = 0;
        place[1] = t + 1;
        place[2] = t + 2;
        break;
    case LOM_LINES: /* both vertices of a line, the second one twice */
        place[0] = 2 * t;
        place[1] = place[2] = 2 * t + 1;
        break;
    case LOM_LINE_STRIP:
        place[0] = t;
        place[1] = place[2] = t + 1;
        break;
    }
}

/* Whether nothing is joined to what is before it. */
static bool is_list(lom_topology topology)
{
    return topology == LOM_TRIANGLES || topology == LOM_LINES;
}

/* In a strip or fan with restarts the corners count from its own start: the place after the last restart before t. */
static size_t strip_start(const lom_draw_desc *desc, size_t t)
{
    while (desc->restart && t > 0 && index_at(desc, t - 1) != UINT32_MAX)
        t--;
    return desc->restart ? t : 0;
}

/* Whether triangle t would begin with a restart: in a fan its corners are the centre before it and vertices behind it. */
static bool begins_nothing(const lom_draw_desc *desc, size_t t)
{
    return desc->restart && !is_list(desc->topology) && index_at(desc, t) == UINT32_MAX;
}

/* The vertex numbers of triangle t, or NO_VERTEX in the first where it has none (a restart index, an index out of
 * range). */
static void resolve_corners(const struct lom_chunk *chunk, size_t t, size_t start, uint32_t number[3])
{
    const struct lom_draw *draw = chunk->draw;
    const lom_draw_desc *desc = &draw->desc;
    size_t place[3];
    bool list = is_list(desc->topology);
    corner_places(desc->topology, list ? t : t - start, place);
    if (desc->provoking == LOM_PROVOKING_FIRST && !draw->lines)
        lom_provoke_first(desc->topology, list ? t : t - start, place);
    for (int k = 0; k < 3; k++) {
        uint32_t index = index_at(desc, place[k] + (list ? 0 : start));
        int64_t vertex = (int64_t)index + chunk->base_vertex;
        if ((index == UINT32_MAX && desc->restart) || vertex < 0 || vertex >= (int64_t)desc->vertex_count) {
            number[0] = NO_VERTEX;
            return;
        }
        number[k] = (uint32_t)vertex;
    }
}

static void resolve_all_corners(struct lom_chunk *chunk)
{
    const struct lom_draw *draw = chunk->draw;
    size_t start = strip_start(&draw->desc, chunk->first);
    for (size_t i = 0; i < chunk->count; i++) {
        size_t t = chunk->first + i;
        if (draw->desc.restart && t > 0 && index_at(&draw->desc, t - 1) == UINT32_MAX)
            start = t;
        if (begins_nothing(&draw->desc, t))
            chunk->assembly->corners[3 * i] = NO_VERTEX;
        else
            resolve_corners(chunk, t, start, chunk->assembly->corners + 3 * i);
    }
}

/* The indices of the usual case, a list of 32-bit ones of vertices that are all there, with these' extremes; else NULL. */
static const uint32_t *find_plain_indices(const struct lom_chunk *chunk, uint32_t *low, uint32_t *high)
{
    const lom_draw_desc *desc = &chunk->draw->desc;
    if (desc->topology != LOM_TRIANGLES || desc->indices == NULL || desc->index_bits != 32 || desc->restart ||
        chunk->count == 0 || desc->provoking == LOM_PROVOKING_FIRST)
        return NULL;
    const uint32_t *index = (const uint32_t *)desc->indices + desc->first + 3 * chunk->first;
    lom_stages_of(chunk->draw->variant)->find_extremes(index, 3 * chunk->count, low, high);
    return lom_move_vertices(desc, chunk->base_vertex, low, high) ? index : NULL;
}

static void find_extremes(struct lom_chunk *chunk, uint32_t *low, uint32_t *high)
{
    struct lom_assembly *assembly = chunk->assembly;
    *low = UINT32_MAX;
    *high = 0;
    for (size_t i = 0; i < 3 * chunk->count; i++) {
        uint32_t number = assembly->corners[i];
        if (assembly->corners[i - i % 3] == NO_VERTEX) {
            chunk->has_gaps = true;
            continue;
        }
        *low = number < *low ? number : *low;
        *high = number > *high ? number : *high;
    }
}

/* A list with a vertex for each corner, for triangles that are scattered over many vertices. */
static bool list_vertices(const struct lom_room *room, struct lom_chunk *chunk)
{
    struct lom_assembly *assembly = chunk->assembly;
    if (!lom_renew(&assembly->vertex_list, &assembly->vertex_list_capacity,
                   lom_larger_size(3 * chunk->count, room->corners), sizeof(uint32_t), NULL))
        return false;
    chunk->vertex_count = 0;
    for (size_t i = 0; i < 3 * chunk->count; i++) {
        if (assembly->corners[i - i % 3] == NO_VERTEX)
            continue;
        assembly->vertex_list[chunk->vertex_count] = assembly->corners[i];
        assembly->corners[i] = (uint32_t)chunk->vertex_count++;
    }
    chunk->vertex_base = 0;
    return true;
}

/* Corners become numbers of rows. */
static void rebase_corners(struct lom_chunk *chunk)
{
    struct lom_assembly *assembly = chunk->assembly;
    uint32_t base = chunk->vertex_base;
    for (size_t i = 0; i < 3 * chunk->count && base != 0; i++)
        assembly->corners[i] =
            chunk->has_gaps && assembly->corners[i] == NO_VERTEX ? NO_VERTEX : assembly->corners[i] - base;
}

/* Corners that are plain indices, as row numbers. */
static void make_corners(struct lom_chunk *chunk)
{
    if (chunk->plain != NULL)
        lom_stages_of(chunk->draw->variant)
            ->rebase_indices(chunk->plain, 3 * chunk->count, lom_index_of(chunk->vertex_base, chunk->base_vertex),
                             chunk->assembly->corners);
    chunk->plain = NULL;
}

/* Which vertices the chunk needs: a range when it is dense (a mesh in order), else a list. */
bool lom_choose_vertices(const struct lom_room *room, struct lom_chunk *chunk)
{
    uint32_t low, high;
    struct lom_assembly *assembly = chunk->assembly;
    size_t corners = 3 * chunk->count;
    if (!lom_renew(&assembly->corners, &assembly->corners_capacity, lom_larger_size(corners, room->corners),
                   sizeof(uint32_t), NULL))
        return false;
    chunk->has_gaps = false;
    chunk->needed = NULL;
    if (chunk->run_count > 0 && !lom_gather_clusters(chunk, &low, &high))
        return false;
    const uint32_t *plain = chunk->run_count > 0 ? NULL : find_plain_indices(chunk, &low, &high);
    if (plain == NULL && chunk->run_count == 0) {
        resolve_all_corners(chunk);
        find_extremes(chunk, &low, &high);
    }
    chunk->vertex_count = low > high ? 0 : (size_t)(high - low) + 1;
    chunk->vertex_base = low;
    chunk->listed = chunk->vertex_count > MOST_ROWS * chunk->count;
    chunk->plain = chunk->listed ? NULL : plain;
    if (plain != NULL && chunk->listed)
        lom_stages_of(chunk->draw->variant)
            ->rebase_indices(plain, corners, lom_index_of(0, chunk->base_vertex), assembly->corners);
    else if (plain == NULL && !chunk->listed && chunk->run_count == 0)
        rebase_corners(chunk);
    if (chunk->draw->expands)
        make_corners(chunk);
    return !chunk->listed || list_vertices(room, chunk);
}

struct group { /* triangles on their way to set-up */
    uint32_t corner[GROUP][3];
    int count;
};

static void send(const struct lom_pass *pass, struct lom_chunk *chunk, struct group *group)
{
    if (group->count > 0 && !chunk->failed)
        lom_stages_of(chunk->draw->variant)->set_up(pass, chunk, group->corner[0], 0, (size_t)group->count);
    group->count = 0;
}

static void add(const struct lom_pass *pass, struct lom_chunk *chunk, struct group *group, const uint32_t corner[3])
{
    memcpy(group->corner[group->count], corner, 3 * sizeof corner[0]);
    group->count++;
    if (group->count == GROUP)
        send(pass, chunk, group);
}

/* A cut triangle keeps its flat varyings: they are written to the provoking vertex of each piece. */
static void add_clipped(const struct lom_pass *pass, struct lom_chunk *chunk, struct group *group,
                        const uint32_t corner[3], unsigned codes)
{
    struct lom_assembly *assembly = chunk->assembly;
    uint32_t fan[LOM_MAX_FAN][3];
    int pieces = lom_clip_triangle(pass, chunk, corner, codes, fan);
    size_t pitch = (size_t)chunk->draw->row_floats;
    uint32_t flat = chunk->draw->desc.shader->flat;
    for (int i = 0; i < pieces; i++) {
        uint32_t provoking = fan[i][2];
        if (flat != 0 && provoking != corner[2]) {
            if (!lom_reserve_rows(chunk, chunk->row_count + 1))
                return;
            uint32_t copy = (uint32_t)chunk->row_count++;
            memcpy(chunk->rows + copy * pitch, chunk->rows + provoking * pitch, pitch * sizeof(float));
            memcpy(assembly->clip + copy * 4, assembly->clip + provoking * 4, 4 * sizeof(float));
            assembly->codes[copy] = assembly->codes[provoking];
            for (int v = 0; v < chunk->draw->desc.shader->varyings; v++)
                if (flat >> v & 1)
                    chunk->rows[copy * pitch + ROW_HEADER + (size_t)v] =
                        chunk->rows[corner[2] * pitch + ROW_HEADER + (size_t)v];
            fan[i][2] = copy;
        }
        add(pass, chunk, group, fan[i]);
    }
}

/* One triangle on its way: dropped when it lies outside one plane or holds a position that is no number, cut when it
 * crosses a plane. */
static void sort_out(const struct lom_pass *pass, struct lom_chunk *chunk, struct group *group, const uint32_t *corner)
{
    struct lom_assembly *assembly = chunk->assembly;
    if (corner[0] == NO_VERTEX)
        return;
    unsigned a = assembly->codes[corner[0]], b = assembly->codes[corner[1]], c = assembly->codes[corner[2]];
    unsigned any = a | b | c;
    if ((a & b & c & lom_reject_codes(chunk->draw)) != 0 || (any & CODE_INVALID) != 0)
        return;
    if ((any & CODE_CLIP) != 0)
        add_clipped(pass, chunk, group, corner, any);
    else
        add(pass, chunk, group, corner);
}

/* Whether no vertex of `count` triangles has an outcode. */
static bool are_inside(const struct lom_chunk *chunk, const uint32_t *corners, size_t count)
{
    unsigned any = 0;
    for (size_t i = 0; i < 3 * count; i++)
        any |= chunk->assembly->codes[corners[i]];
    return any == 0;
}

/* In a recorded pass: those that come near a watched pixel go by themselves. */
static void assemble_recorded(const struct lom_pass *pass, struct lom_chunk *chunk)
{
    struct group group = { .count = 0 };
    for (size_t i = 0; i < chunk->count; i++) {
        bool near = lom_record_triangle(pass, chunk, i);
        if (near) { /* those before it are not it */
            struct record_candidate *candidate = chunk->assembly->candidate;
            chunk->assembly->candidate = NULL;
            send(pass, chunk, &group);
            chunk->assembly->candidate = candidate;
        }
        size_t before = chunk->triangle_count;
        sort_out(pass, chunk, &group, chunk->assembly->corners + 3 * i);
        if (!near)
            continue;
        send(pass, chunk, &group);
        lom_record_set_up(pass, chunk, before);
    }
    send(pass, chunk, &group);
}

/* Triangles without outcodes go to set-up as they stand, as many as follow one another; the others one by one, in order. */
static void assemble_runs(const struct lom_pass *pass, struct lom_chunk *chunk, size_t first, size_t end)
{
    const uint32_t *corners = chunk->assembly->corners;
    void (*set_up)(const struct lom_pass *, struct lom_chunk *, const uint32_t *, uint32_t, size_t) =
        lom_stages_of(chunk->draw->variant)->set_up;
    struct group group = { .count = 0 };
    for (size_t run = 0; first < end;) {
        size_t left = end - first - run, count = left < GROUP ? left : GROUP;
        bool inside = count > 0 && !chunk->has_gaps && are_inside(chunk, corners + 3 * (first + run), count);
        if (inside) {
            run += count;
            continue;
        }
        if (run > 0) {
            send(pass, chunk, &group);
            if (!chunk->failed)
                set_up(pass, chunk, corners + 3 * first, 0, run);
        }
        first += run;
        for (size_t i = 0; i < count; i++)
            sort_out(pass, chunk, &group, corners + 3 * (first + i));
        first += count;
        run = 0;
    }
    send(pass, chunk, &group);
}

static void assemble(const struct lom_pass *pass, struct lom_chunk *chunk)
{
    if (chunk->any_code == 0 && !chunk->has_gaps && pass->recorder == NULL) {
        const uint32_t *corners = chunk->plain != NULL ? chunk->plain : chunk->assembly->corners;
        lom_stages_of(chunk->draw->variant)
            ->set_up(pass, chunk, corners,
                     chunk->plain != NULL ? lom_index_of(chunk->vertex_base, chunk->base_vertex) : 0, chunk->count);
        return;
    }
    make_corners(chunk);
    if (pass->recorder != NULL)
        assemble_recorded(pass, chunk);
    else
        assemble_runs(pass, chunk, 0, chunk->count);
}

/* The same of several calls, where nothing is clipped at once. */
static void assemble_parts(const struct lom_pass *pass, struct lom_chunk *chunk)
{
    if (chunk->any_code == 0) {
        assemble(pass, chunk);
        lom_end_parts(chunk);
        return;
    }
    for (size_t i = 0, first = 0; i < chunk->part_count; first += chunk->calls[i++].triangles) {
        assemble_runs(pass, chunk, first, first + chunk->calls[i].triangles);
        chunk->parts[i].end = (uint32_t)chunk->triangle_count;
    }
}

void lom_run_chunk(struct lom_pass *pass, struct lom_chunk *chunk, struct lom_assembly *assembly)
{
    chunk->assembly = assembly;
    chunk->triangle_count = chunk->triangles_clipped = chunk->vertices_shaded = 0;
    chunk->any_code = 0;
    chunk->all_listed = true;
    chunk->plain = NULL;
    chunk->first_row = 0;
    chunk->tile_low = INT32_MAX;
    chunk->tile_high = -1;
    const struct lom_draw *draw = chunk->draw;
    const lom_device *device = pass->device;
    const struct lom_room *room = chunk - device->chunks < device->desc.batch ? &device->room : &device->small_room;
    if (draw->expands)
        chunk->failed = !lom_expand_chunk(pass, chunk);
    else
        chunk->failed = !(draw->sprites          ? lom_choose_sprites(room, chunk)
                          : chunk->parts != NULL ? lom_choose_parts(room, chunk)
                                                 : lom_choose_vertices(room, chunk)) ||
                        !lom_make_room(room, chunk);
    if (chunk->failed || !draw->rasterizes)
        return;
    chunk->row_count = chunk->vertex_count;
    if (!draw->expands)
        lom_stages_of(draw->variant)->shade_vertices(pass, chunk);
    if (draw->sprites)
        lom_set_up_sprites(pass, chunk);
    else if (draw->lines)
        lom_set_up_lines(pass, chunk);
    else if (chunk->parts != NULL)
        assemble_parts(pass, chunk);
    else
        assemble(pass, chunk);
    if (!chunk->failed)
        lom_bin_chunk(pass, chunk);
}
