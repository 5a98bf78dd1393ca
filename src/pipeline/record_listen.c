/* Passes and their triangles, told to whoever listens. In: the candidates of a batch, which are all its triangles; its
 * bins. Out: each triangle with the pieces that set-up was given of it and how far they came. Invariant: what is told is
 * read from what the stages have left, in the order of the draws. */
#include "pipeline/project.h"
#include "pipeline/record.h"

#include "pipeline/check_device.h"

/* A triangle while it is told. */
struct telling {
    lom_device *device;
    const struct lom_chunk *chunk;
    const struct record_candidate *candidate;
};

bool lom_listen(lom_device *device, const lom_listener *listener)
{
    if (!lom_check_device(device, NULL))
        return false;
    if (device->in_pass)
        return lom_fail(&device->error, LOM_ERROR_USAGE, "A device is listened to from outside a pass on.");
    if (listener == NULL)
        return lom_watch(device, NULL, 0);
    struct lom_recorder *r = lom_renew_recorder(device);
    if (r != NULL)
        r->listener = *listener;
    return r != NULL;
}

const char *lom_reach_text(lom_reach reach)
{
    static const char *const texts[LOM_REACHES] = {
        [LOM_REACH_OUTSIDE] = "outside the near or the far plane or a distance",
        [LOM_REACH_FACING] = "culled by their facing",
        [LOM_REACH_BESIDE] = "beside the picture",
        [LOM_REACH_EMPTY] = "between the centres of pixels",
        [LOM_REACH_BINNED] = "drawn",
    };
    return (unsigned)reach < LOM_REACHES ? texts[reach] : "unknown";
}

/* ---- a triangle ---- */

static bool has_area(const int32_t v[3][2])
{
    return ((int64_t)v[1][0] - v[0][0]) * ((int64_t)v[2][1] - v[0][1]) !=
           ((int64_t)v[1][1] - v[0][1]) * ((int64_t)v[2][0] - v[0][0]);
}

/* Whether the box of three snapped vertices holds no pixel of the scissor at all. */
static bool is_beside(const struct telling *t, const int32_t v[3][2])
{
    const lom_rect *s = &t->chunk->draw->scissor, *view = &t->chunk->draw->desc.viewport;
    const int64_t low[2] = { s->x - view->x, s->y - view->y };
    const int64_t high[2] = { low[0] + s->width, low[1] + s->height };
    for (int i = 0; i < 2; i++) {
        bool before = true, behind = true;
        for (int k = 0; k < 3; k++) {
            before &= v[k][i] <= low[i] * SUBPIXELS;
            behind &= v[k][i] >= high[i] * SUBPIXELS;
        }
        if (before || behind)
            return true;
    }
    return false;
}

static lom_reach reach_of(const struct telling *t, const struct record_piece *piece, const int32_t v[3][2])
{
    if (piece->stage == RECORD_DONE)
        return LOM_REACH_BINNED;
    if (piece->stage == RECORD_SENT && has_area(v))
        return LOM_REACH_FACING;
    return is_beside(t, v) ? LOM_REACH_BESIDE : LOM_REACH_EMPTY;
}

static bool is_own(const struct record_candidate *c, const float clip[4])
{
    bool own = false;
    for (int k = 0; k < 3; k++)
        own |= memcmp(c->clip[k], clip, sizeof c->clip[k]) == 0;
    return own;
}

/* Of a point or sprite: its half sides, from its middle. */
static void tell_sides(const struct telling *t, const float *row, lom_told_piece *told)
{
    for (int k = 1; k < 3; k++)
        for (int i = 0; i < 2; i++)
            told->window[k][i] += row[t->chunk->draw->axis_offset + 2 * (k - 1) + i];
}

static void tell_piece(const struct telling *t, const struct record_piece *piece, lom_told_piece *told)
{
    const lom_rect *view = &t->chunk->draw->desc.viewport;
    int32_t v[3][2];
    for (int k = 0; k < 3; k++) {
        const float *row = t->chunk->rows + piece->corner[k] * (size_t)t->chunk->draw->row_floats;
        memcpy(v[k], row, sizeof v[k]);
        memcpy(told->clip[k], piece->clip[k], sizeof told->clip[k]);
        told->window[k][0] = (float)v[k][0] / SUBPIXELS + (float)view->x;
        told->window[k][1] = (float)v[k][1] / SUBPIXELS + (float)view->y;
        told->window[k][2] = row[2];
        told->made[k] = !is_own(t->candidate, piece->clip[k]);
    }
    if (t->chunk->draw->sprites)
        tell_sides(t, t->chunk->rows + piece->corner[0] * (size_t)t->chunk->draw->row_floats, told);
    told->reach = reach_of(t, piece, v);
}

static void tell(const struct telling *t)
{
    const struct record_candidate *c = t->candidate;
    struct lom_recorder *r = t->device->recorder;
    lom_told_triangle told = { .draw = (size_t)(t->chunk->draw - t->device->draws),
                               .desc = &t->chunk->draw->desc,
                               .number = c->number,
                               .instance = t->chunk->instance,
                               .corners = t->chunk->draw->sprites ? 1
                                          : t->chunk->draw->lines ? 2
                                                                  : 3,
                               .made = t->chunk->draw->expands,
                               .pieces = c->pieces,
                               .reach = LOM_REACH_OUTSIDE,
                               .from = t };
    memcpy(told.index, c->index, sizeof told.index);
    memcpy(told.clip, c->clip, sizeof told.clip);
    memcpy(told.code, c->code, sizeof told.code);
    told.cut = c->pieces > 0 && told.corners > 1 && ((c->code[0] | c->code[1] | c->code[2]) & CODE_CLIP) != 0;
    for (int i = 0; i < c->pieces; i++) {
        tell_piece(t, &c->piece[i], &told.piece[i]);
        told.reach = told.piece[i].reach > told.reach ? told.piece[i].reach : told.reach;
    }
    r->listener.triangle(r->listener.context, &told);
    lom_free_record_memory(&r->told);
}

bool lom_tell_vertices(const lom_told_triangle *triangle, lom_vertex_record vertex[3])
{
    const struct telling *t = triangle->from;
    for (int k = 0; k < 3; k++)
        vertex[k] = (lom_vertex_record){ .index = 0 };
    if (triangle->made) {
        lom_record_made_vertices(&t->device->pass, t->chunk, t->candidate, vertex);
        return true;
    }
    return lom_record_vertices(&t->device->pass, t->chunk, triangle->index, &t->device->recorder->told, vertex);
}

/* ---- a batch, a pass ---- */

static void tell_bins(lom_device *device, const struct lom_chunk *chunk)
{
    const struct lom_pass *pass = &device->pass;
    const lom_listener *listener = &device->recorder->listener;
    for (int number = chunk->tile_low; number <= chunk->tile_high; number++) {
        int i = number - chunk->tile_low;
        lom_rect tile = { pass->tile_x0 + number % pass->tiles_x * pass->tile,
                          pass->tile_y0 + number / pass->tiles_x * pass->tile, pass->tile, pass->tile };
        if (chunk->tile_first[i + 1] != chunk->tile_first[i])
            listener->bin(listener->context, &tile, chunk->tile_first[i + 1] - chunk->tile_first[i]);
    }
}

void lom_record_tell(lom_device *device)
{
    const struct lom_pass *pass = &device->pass;
    const struct lom_recorder *r = device->recorder;
    for (size_t i = 0; i < pass->chunk_count; i++) {
        struct telling t = { .device = device, .chunk = &pass->chunks[i] };
        for (size_t k = 0; k < r->chunks[i].count && r->listener.triangle != NULL; k++) {
            t.candidate = &r->chunks[i].items[k];
            tell(&t);
        }
        if (r->listener.bin != NULL)
            tell_bins(device, t.chunk);
    }
}

void lom_record_ended(lom_device *device)
{
    const struct lom_recorder *r = device->recorder;
    const struct lom_pass *pass = &device->pass;
    bool blends = false;
    for (size_t i = 0; i < pass->draw_count; i++)
        for (int c = 0; c < pass->colors; c++)
            blends |= device->draws[i].desc.blend[c].enabled;
    if (r->listener.ended != NULL)
        r->listener.ended(r->listener.context, r->passes - 1, &pass->desc, pass->draw_count, blends);
}
