/* The first half of the pipeline, recorded. In: triangles of a chunk, one by one. Out: for those that come near a watched
 * pixel what they were before set-up, the pieces that clipping left, and how far set-up took each. Invariant: a triangle
 * that could cover, or would have covered, a watched pixel is never passed over. */
#include "pipeline/record.h"

/* The range of the centres of a watch's pixels in 1/256 pixel from the viewport's origin. */
struct range {
    int64_t low[2], high[2];
};

static struct range range_of(const struct lom_draw *draw, const struct record_watch *watch)
{
    const int at[2] = { watch->desc.x + watch->origin_x - draw->desc.viewport.x,
                        watch->desc.y + watch->origin_y - draw->desc.viewport.y };
    const int size[2] = { watch->desc.width, watch->desc.height };
    struct range r;
    for (int i = 0; i < 2; i++) {
        r.low[i] = (int64_t)at[i] * SUBPIXELS + SUBPIXELS / 2;
        r.high[i] = r.low[i] + (int64_t)(size[i] - 1) * SUBPIXELS;
    }
    return r;
}

/* How far from a triangle or line the centres of its pixels may lie, in 1/256 pixel: of a line of width 1 half a pixel. */
static int32_t reach_of(const struct lom_draw *draw)
{
    return draw->lines ? (draw->desc.line_width + 1) * (SUBPIXELS / 2) : 0;
}

/* Whether all three vertices lie beyond one side of the range, grown by a pixel and the draw's reach: in clip space,
 * where that holds for every point of the triangle with w > 0. */
static bool is_beside(const struct lom_draw *draw, const struct range *r, const float clip[3][4])
{
    const int32_t more = SUBPIXELS + reach_of(draw);
    const double size[2] = { draw->desc.viewport.width * (double)SUBPIXELS,
                             draw->desc.viewport.height * (double)SUBPIXELS };
    for (int axis = 0; axis < 2; axis++)
        for (int side = 0; side < 2; side++) {
            double at = side == 0 ? (double)(r->low[axis] - more) : (double)(r->high[axis] + more);
            double ndc = 2 * at / size[axis] - 1, sign = side == 0 ? 1 : -1;
            int beyond = 0;
            for (int k = 0; k < 3; k++) {
                double along = axis == 0 ? clip[k][0] : -(double)clip[k][1];
                beyond += sign * (along - ndc * clip[k][3]) < 0;
            }
            if (beyond == 3)
                return true;
        }
    return false;
}

/* The box of three snapped vertices, and of a line's width: low x, y, high x, y. */
static void find_box(const struct lom_chunk *chunk, const uint32_t corner[3], int32_t low[2], int32_t high[2])
{
    size_t pitch = (size_t)chunk->draw->row_floats;
    for (int k = 0; k < 3; k++) {
        int32_t at[2];
        memcpy(at, chunk->rows + corner[k] * pitch, sizeof at);
        for (int i = 0; i < 2; i++) {
            low[i] = k == 0 || at[i] < low[i] ? at[i] : low[i];
            high[i] = k == 0 || at[i] > high[i] ? at[i] : high[i];
        }
    }
    for (int i = 0; i < 2; i++) {
        low[i] -= reach_of(chunk->draw);
        high[i] += reach_of(chunk->draw);
    }
}

/* Most triangles lie beside the bounds of all watches. */
static bool box_comes_near(const struct lom_pass *pass, const struct lom_draw *draw, const int32_t low[2],
                           const int32_t high[2])
{
    const struct lom_bounds *b = &pass->recorder->bounds;
    int64_t x = draw->desc.viewport.x, y = draw->desc.viewport.y, middle = SUBPIXELS / 2;
    if (low[0] > (b->right - x) * SUBPIXELS + middle || high[0] < (b->left - x) * SUBPIXELS + middle ||
        low[1] > (b->bottom - y) * SUBPIXELS + middle || high[1] < (b->top - y) * SUBPIXELS + middle)
        return false;
    for (size_t i = 0; i < pass->recorder->watch_count; i++) {
        const struct record_watch *watch = &pass->recorder->watch[i];
        struct range r = range_of(draw, watch);
        if (watch->active && low[0] <= r.high[0] && high[0] >= r.low[0] && low[1] <= r.high[1] && high[1] >= r.low[1])
            return true;
    }
    return false;
}

static bool clip_comes_near(const struct lom_pass *pass, const struct lom_draw *draw, const float clip[3][4])
{
    for (size_t i = 0; i < pass->recorder->watch_count; i++) {
        const struct record_watch *watch = &pass->recorder->watch[i];
        struct range r = range_of(draw, watch);
        if (watch->active && !is_beside(draw, &r, clip))
            return true;
    }
    return false;
}

static struct record_chunk *record_of(const struct lom_pass *pass, const struct lom_chunk *chunk)
{
    return &pass->recorder->chunks[chunk - pass->chunks];
}

/* The number of the chunk's primitive i; of points and sprites i counts those that have a vertex. */
static size_t number_of(const struct lom_chunk *chunk, size_t i)
{
    const struct lom_draw *draw = chunk->draw;
    uint32_t vertex;
    if (draw->expands)
        return i < chunk->count ? lom_made_from(chunk, i) : chunk->first + i;
    if (!draw->sprites || chunk->vertex_count == chunk->count)
        return chunk->first + i;
    size_t place = 0;
    while (!lom_find_vertex(chunk, chunk->first + place, &vertex) || i-- > 0)
        place++;
    return chunk->first + place;
}

/* Points and sprites are told, but not watched: any variant will do. */
static bool is_recorded(const struct lom_pass *pass, const struct lom_draw *draw)
{
    return draw->sprites ? pass->recorder->tells : draw->variant == LOM_SLOT_4_recorded;
}

bool lom_record_triangle(const struct lom_pass *pass, struct lom_chunk *chunk, size_t i)
{
    struct record_chunk *record = record_of(pass, chunk);
    struct lom_assembly *assembly = chunk->assembly;
    const uint32_t point[3] = { (uint32_t)i, (uint32_t)i, (uint32_t)i };
    const uint32_t *corner = chunk->draw->sprites ? point : assembly->corners + 3 * i;
    if (i == 0)
        record->count = record->piece_count = 0;
    assembly->candidate = NULL;
    if (corner[0] == NO_VERTEX || !is_recorded(pass, chunk->draw))
        return false;
    unsigned any = assembly->codes[corner[0]] | assembly->codes[corner[1]] | assembly->codes[corner[2]];
    bool has_box = (any & (CODE_CLIP | CODE_INVALID)) == 0;
    int32_t low[2] = { 0, 0 }, high[2] = { 0, 0 };
    float clip[3][4];
    if ((any & CODE_INVALID) != 0 && !pass->recorder->tells)
        return false;
    if (has_box)
        find_box(chunk, corner, low, high);
    for (int k = 0; k < 3; k++)
        memcpy(clip[k], assembly->clip + (size_t)corner[k] * 4, sizeof clip[k]);
    if (!pass->recorder->tells &&
        (has_box ? !box_comes_near(pass, chunk->draw, low, high) : !clip_comes_near(pass, chunk->draw, clip)))
        return false;
    struct record_candidate c = { .number = number_of(chunk, i),
                                  .has_box = has_box,
                                  .first_piece = record->piece_count };
    for (int k = 0; k < 3; k++) {
        c.corner[k] = corner[k];
        c.index[k] = chunk->draw->expands ? UINT32_MAX
                     : chunk->listed      ? assembly->vertex_list[corner[k]]
                                          : chunk->vertex_base + corner[k];
        c.code[k] = assembly->codes[corner[k]];
    }
    memcpy(c.clip, clip, sizeof c.clip);
    memcpy(c.low, low, has_box ? sizeof low : 0);
    memcpy(c.high, high, has_box ? sizeof high : 0);
    if (!lom_reserve(&record->items, &record->capacity, record->count + 1, sizeof c, NULL) ||
        !lom_reserve(&record->pieces, &record->piece_capacity, record->piece_count + MAX_PIECES, sizeof *record->pieces,
                     NULL)) {
        record->failed = true;
        return false;
    }
    c.piece = record->pieces + c.first_piece;
    record->items[record->count] = c;
    assembly->candidate = &record->items[record->count++];
    return true;
}

void lom_record_stage(struct lom_chunk *chunk, const uint32_t *corners, int stage, const lom_mask *alive)
{
    struct record_candidate *c = chunk->assembly->candidate;
    if (c == NULL)
        return;
    uint32_t lanes = lom_bits(*alive);
    if (stage == RECORD_SENT)
        c->packet = c->pieces;
    for (int i = 0; i < 4 && c->packet + i < MAX_PIECES; i++) {
        struct record_piece *piece = &c->piece[c->packet + i];
        if ((lanes >> i & 1) == 0)
            continue;
        piece->stage = stage;
        if (stage == RECORD_SENT) {
            memcpy(piece->corner, corners + 3 * i, sizeof piece->corner);
            c->pieces = c->packet + i + 1;
        }
    }
}

void lom_record_line(struct lom_chunk *chunk, const uint32_t end[2], bool drawn)
{
    struct record_candidate *c = chunk->assembly->candidate;
    if (c != NULL)
        c->piece[c->pieces++] =
            (struct record_piece){ .corner = { end[0], end[1], end[1] }, .stage = drawn ? RECORD_DONE : RECORD_SENT };
}

void lom_record_set_up(const struct lom_pass *pass, struct lom_chunk *chunk, size_t before)
{
    struct record_candidate *c = chunk->assembly->candidate;
    record_of(pass, chunk)->piece_count += (size_t)c->pieces;
    for (int i = 0; i < c->pieces; i++) {
        struct record_piece *piece = &c->piece[i];
        for (int k = 0; k < 3; k++)
            memcpy(piece->clip[k], chunk->assembly->clip + (size_t)piece->corner[k] * 4, sizeof piece->clip[k]);
        if (piece->stage == RECORD_DONE)
            piece->number = before++;
    }
    chunk->assembly->candidate = NULL;
}
