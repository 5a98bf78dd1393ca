/* The stages between vertices and clipping of one chunk (lom/stages.h): vertices, tessellation, geometry, feedback. In: a
 * range of primitives. Out: the rows, corners and outcodes of what is drawn, as chunk.c has them of other draws; what
 * feedback keeps. Invariant: pieces stand in the order of the primitives that they come from, and those of one primitive in
 * the order in which it made them. */
#include "pipeline/expand.h"

#include "lanes/variants.h"
#include "pipeline/variants.h"

enum { PACKET = 16, VERTEX_FLOATS = sizeof(lom_vertex) / LOM_LANES / sizeof(float) };

/* Room for whole packets behind what there is. */
static bool reserve_rows(const struct lom_draw *draw, struct lom_stage_rows *rows, size_t count)
{
    return lom_reserve(&rows->row, &rows->capacity, (count + PACKET) * (size_t)draw->stage_pitch, sizeof(float), NULL);
}

static bool reserve_pieces(struct lom_pieces *pieces, size_t count)
{
    return lom_reserve(&pieces->vertex, &pieces->vertex_capacity, count * (size_t)pieces->vertices, sizeof(uint32_t),
                       NULL) &&
           lom_reserve(&pieces->number, &pieces->number_capacity, count, sizeof(uint32_t), NULL);
}

/* ---- vertices ---- */

/* Points and patches: a row for each corner; those with a vertex that is not there are left out. */
static bool list_corners(struct lom_chunk *chunk, struct lom_pieces *pieces)
{
    struct lom_assembly *assembly = chunk->assembly;
    size_t corners = (size_t)pieces->vertices, rows = 0;
    if (!lom_renew(&assembly->vertex_list, &assembly->vertex_list_capacity, chunk->count * corners, sizeof(uint32_t),
                   NULL))
        return false;
    for (size_t i = 0; i < chunk->count; i++) {
        bool whole = true;
        for (size_t k = 0; k < corners; k++) {
            size_t place = (chunk->first + i) * corners + k;
            whole &= lom_find_vertex(chunk, place, &assembly->vertex_list[rows + k]);
            pieces->vertex[pieces->count * corners + k] = (uint32_t)(rows + k);
        }
        if (!whole)
            continue;
        pieces->number[pieces->count++] = (uint32_t)(chunk->first + i);
        rows += corners;
    }
    chunk->vertex_count = rows;
    chunk->vertex_base = 0;
    chunk->listed = true;
    chunk->needed = NULL;
    return true;
}

/* Triangles and lines, of which chunk.c has found the corners. */
static void take_corners(const struct lom_chunk *chunk, struct lom_pieces *pieces)
{
    for (size_t i = 0; i < chunk->count; i++) {
        const uint32_t *corner = chunk->assembly->corners + 3 * i;
        if (corner[0] == NO_VERTEX)
            continue;
        for (int k = 0; k < pieces->vertices; k++)
            pieces->vertex[pieces->count * (size_t)pieces->vertices + (size_t)k] = corner[k];
        pieces->number[pieces->count++] = (uint32_t)(chunk->first + i);
    }
}

static int vertices_of(const lom_draw_desc *desc)
{
    switch (desc->topology) {
    case LOM_PATCHES:
        return desc->patch_points;
    case LOM_POINTS:
        return 1;
    case LOM_LINES:
    case LOM_LINE_STRIP:
        return 2;
    default:
        return 3;
    }
}

static bool run_vertices(const struct lom_pass *pass, struct lom_chunk *chunk)
{
    const lom_draw_desc *desc = &chunk->draw->desc;
    struct lom_expansion *e = &chunk->assembly->expansion;
    e->pieces[0].vertices = vertices_of(desc);
    e->pieces[0].count = 0;
    if (!reserve_pieces(&e->pieces[0], chunk->count))
        return false;
    bool listed = desc->topology == LOM_PATCHES || desc->topology == LOM_POINTS;
    if (!(listed ? list_corners(chunk, &e->pieces[0]) : lom_choose_vertices(&pass->device->room, chunk)))
        return false;
    if (!listed)
        take_corners(chunk, &e->pieces[0]);
    e->rows[0].count = chunk->vertex_count;
    if (!reserve_rows(chunk->draw, &e->rows[0], chunk->vertex_count))
        return false;
    chunk->kept_rows = e->rows[0].row;
    lom_stages_of(chunk->draw->variant)->shade_vertices(pass, chunk);
    chunk->kept_rows = NULL;
    return true;
}

/* ---- tessellation ---- */

/* The rows and pieces of one patch; patches that are cut alike, side by side, share the pattern. */
static bool cut_patch(struct lom_chunk *chunk, size_t patch, const float levels[LEVEL_WORDS],
                      struct lom_pattern_key *before)
{
    const struct lom_draw *draw = chunk->draw;
    const lom_tessellation *t = draw->desc.tessellation;
    struct lom_expansion *e = &chunk->assembly->expansion;
    struct lom_stage_rows *rows = &e->rows[1];
    struct lom_pieces *pieces = &e->pieces[1];
    struct lom_pattern_key key = lom_pattern_key_of(t, levels, levels + 4);
    bool same = memcmp(&key, before, sizeof key) == 0;
    if (key.level[0] == 0)
        return true;
    if (!same && !lom_make_pattern(t, &key, e->pattern))
        return false;
    *before = key;
    size_t made = e->pattern->corners / (size_t)pieces->vertices;
    if (!reserve_rows(draw, rows, rows->count + e->pattern->places) || !reserve_pieces(pieces, pieces->count + made))
        return false;
    lom_stages_of(draw->variant)
        ->evaluate_patch(chunk, patch, levels, rows->row + rows->count * (size_t)draw->stage_pitch);
    uint32_t *vertex = pieces->vertex + pieces->count * (size_t)pieces->vertices;
    for (size_t i = 0; i < e->pattern->corners; i++)
        vertex[i] = (uint32_t)rows->count + e->pattern->corner[i];
    for (size_t i = 0; i < made; i++)
        pieces->number[pieces->count + i] = e->pieces[0].number[patch];
    pieces->count += made;
    rows->count += e->pattern->places;
    chunk->vertices_shaded += e->pattern->places;
    return true;
}

static bool run_tessellation(struct lom_chunk *chunk)
{
    const struct lom_draw *draw = chunk->draw;
    struct lom_expansion *e = &chunk->assembly->expansion;
    struct lom_pattern_key before = { { 0 } };
    float levels[MOST_LANES][LEVEL_WORDS];
    size_t lanes = (size_t)lom_variants[draw->variant].lanes;
    e->rows[1].count = e->pieces[1].count = 0;
    e->pieces[1].vertices = lom_piece_vertices(draw->desc.tessellation);
    if (e->pattern == NULL && (e->pattern = lom_allocate(1, sizeof *e->pattern, NULL)) == NULL)
        return false;
    for (size_t first = 0; first < e->pieces[0].count; first += lanes) {
        lom_stages_of(draw->variant)->control_patches(chunk, first, levels);
        for (size_t i = 0; i < lanes && first + i < e->pieces[0].count; i++)
            if (!cut_patch(chunk, first + i, levels[i], &before))
                return false;
    }
    return true;
}

/* ---- geometry ---- */

/* The pieces of the rows that one primitive has emitted. */
static bool join_strips(const struct lom_draw *draw, struct lom_expansion *e, size_t first, uint32_t number)
{
    struct lom_stage_rows *rows = &e->rows[2];
    struct lom_pieces *pieces = &e->pieces[2];
    uint32_t length = 0, corners = (uint32_t)pieces->vertices;
    if (!reserve_pieces(pieces, pieces->count + rows->count - first))
        return false;
    for (size_t i = first; i < rows->count; i++) {
        bool joins = rows->row[i * (size_t)draw->stage_pitch + LOM_ROW_SIZE + 1] != 0;
        length = joins ? length + 1 : 1;
        if (length < corners)
            continue;
        uint32_t *vertex = pieces->vertex + pieces->count * corners, last = (uint32_t)i;
        uint32_t turned = corners == 3 ? (length - 3) & 1 : 0; /* every second triangle of a strip */
        vertex[corners - 1] = last;
        if (corners > 1)
            vertex[corners - 2] = last - 1 - turned;
        if (corners > 2)
            vertex[0] = last - 2 + turned;
        pieces->number[pieces->count++] = number;
        length = corners == 1 ? 0 : length;
    }
    return true;
}

/* What a packet of primitives has emitted, lane after lane. */
static bool take_emitted(struct lom_chunk *chunk, const struct lom_pieces *from, size_t first, const int32_t *count)
{
    const struct lom_draw *draw = chunk->draw;
    struct lom_expansion *e = &chunk->assembly->expansion;
    struct lom_stage_rows *rows = &e->rows[2];
    size_t pitch = (size_t)draw->stage_pitch, most = (size_t)draw->desc.geometry->vertices;
    size_t lanes = (size_t)lom_variants[draw->variant].lanes;
    if (!reserve_rows(draw, rows, rows->count + lanes * most))
        return false;
    for (size_t i = 0; i < lanes && first + i < from->count; i++) {
        size_t start = rows->count;
        memcpy(rows->row + start * pitch, e->emitted + i * most * pitch, (size_t)count[i] * pitch * sizeof(float));
        rows->count += (size_t)count[i];
        if (!join_strips(draw, e, start, from->number[first + i]))
            return false;
    }
    return true;
}

static bool run_geometry(struct lom_chunk *chunk, int from)
{
    const struct lom_draw *draw = chunk->draw;
    const lom_geometry *geometry = draw->desc.geometry;
    struct lom_expansion *e = &chunk->assembly->expansion;
    const struct lom_pieces *pieces = &e->pieces[from];
    int32_t count[MOST_LANES];
    size_t lanes = (size_t)lom_variants[draw->variant].lanes;
    size_t emitted = (lanes * (size_t)geometry->vertices + 1) * (size_t)draw->stage_pitch;
    e->rows[2].count = e->pieces[2].count = 0;
    e->pieces[2].vertices = geometry->out == LOM_POINTS ? 1 : geometry->out == LOM_LINE_STRIP ? 2 : 3;
    if (!lom_renew(&e->emitted, &e->emitted_capacity, emitted, sizeof(float), NULL))
        return false;
    for (size_t first = 0; first < pieces->count; first += lanes) {
        lom_stages_of(draw->variant)->emit_pieces(chunk, from, first, count);
        if (!take_emitted(chunk, pieces, first, count))
            return false;
    }
    return true;
}

/* ---- what is drawn ---- */

static bool project_pieces(const struct lom_pass *pass, struct lom_chunk *chunk, int from)
{
    struct lom_assembly *assembly = chunk->assembly;
    const struct lom_pieces *pieces = &assembly->expansion.pieces[from];
    const struct lom_stage_rows *rows = &assembly->expansion.rows[from];
    chunk->vertex_count = rows->count;
    chunk->count = pieces->count;
    chunk->has_gaps = false;
    if (!lom_renew(&assembly->corners, &assembly->corners_capacity, 3 * pieces->count, sizeof(uint32_t), NULL) ||
        !lom_make_room(&pass->device->room, chunk))
        return false;
    for (size_t i = 0; i < pieces->count; i++) /* of a line the second one twice */
        for (int k = 0; k < 3; k++)
            assembly->corners[3 * i + (size_t)k] =
                pieces
                    ->vertex[i * (size_t)pieces->vertices + (size_t)(k < pieces->vertices ? k : pieces->vertices - 1)];
    chunk->needed = NULL;
    chunk->made_rows = rows->row;
    lom_stages_of(chunk->draw->variant)->shade_vertices(pass, chunk);
    chunk->made_rows = NULL;
    return true;
}

bool lom_expand_chunk(const struct lom_pass *pass, struct lom_chunk *chunk)
{
    const lom_draw_desc *desc = &chunk->draw->desc;
    struct lom_expansion *e = &chunk->assembly->expansion;
    int last = 0;
    if (!lom_reserve(&e->point, &e->point_capacity, (size_t)LOM_MAX_PATCH_POINTS * VERTEX_FLOATS * MOST_LANES,
                     sizeof(float), NULL) ||
        !run_vertices(pass, chunk))
        return false;
    if (desc->tessellation != NULL) {
        if (!run_tessellation(chunk))
            return false;
        last = 1;
    }
    if (desc->geometry != NULL) {
        if (!run_geometry(chunk, last))
            return false;
        last = 2;
    }
    if (desc->feedback != NULL && !lom_capture(chunk, &e->rows[last], &e->pieces[last]))
        return false;
    return !chunk->draw->rasterizes || project_pieces(pass, chunk, last);
}

size_t lom_made_from(const struct lom_chunk *chunk, size_t i)
{
    const lom_draw_desc *desc = &chunk->draw->desc;
    return chunk->assembly->expansion.pieces[desc->geometry != NULL ? 2 : desc->tessellation != NULL ? 1 : 0].number[i];
}

void lom_free_expansion(struct lom_expansion *expansion)
{
    for (int i = 0; i < 3; i++) {
        lom_release(expansion->rows[i].row);
        lom_release(expansion->pieces[i].vertex);
        lom_release(expansion->pieces[i].number);
    }
    if (expansion->pattern != NULL) {
        lom_release(expansion->pattern->place);
        lom_release(expansion->pattern->corner);
    }
    lom_release(expansion->pattern);
    lom_release(expansion->point);
    lom_release(expansion->emitted);
}
