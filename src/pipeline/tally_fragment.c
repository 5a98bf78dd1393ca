/* The stages of a tile, tallied. In: what those stages hold, over 4 lanes. Out: counts at texels of the target, and what is
 * to be known of the last fragment that was stored there. This file is compiled once, as record_fragment.c is. */
#include "pipeline/packet.h"
#include "pipeline/tally.h"
#include "pipeline/window.h"

enum { NEAR_VERTEX = SUBPIXELS * 5 / 2 };

static struct tally_worker *worker_of(const struct lom_tile *tile)
{
    return &tile->pass->tallier->worker[tile - tile->pass->device->worker_tiles];
}

/* Tile memory is in blocks of 2x2, edge / 2 of them a row. */
static void find_pixel(const struct lom_tile *tile, int place, int *x, int *y)
{
    int block = place >> 2, half = tile->edge / 2;
    *x = tile->x + block % half * 2 + (place & 1);
    *y = tile->y + block / half * 2 + (place >> 1 & 1);
}

static lom_tally *tally_of(const struct lom_tile *tile, int place)
{
    int x, y;
    find_pixel(tile, place, &x, &y);
    return lom_tally_at(tile->pass, x, y);
}

/* ---- the early depth test ---- */

void lom_tally_inside(struct lom_tile *tile, const lom_mask *inside)
{
    worker_of(tile)->inside = *inside;
}

void lom_tally_tested(struct lom_tile *tile, int place, const lom_mask *passed)
{
    const lom_mask inside = worker_of(tile)->inside;
    for (uint32_t lanes = lom_bits(inside); lanes != 0; lanes &= lanes - 1) {
        int i = __builtin_ctz(lanes);
        lom_tally *tally = tally_of(tile, place + i);
        if (tally == NULL)
            continue;
        tally->fragments += (*passed)[i] != 0;
        tally->killed += (*passed)[i] == 0;
    }
}

/* ---- packets ---- */

/* The four fragments at hand are about to be shaded. */
static void begin_packet(struct lom_tile *tile, struct tally_worker *worker)
{
    const uint32_t covered = lom_bits(worker->covered);
    for (uint32_t lanes = covered; lanes != 0; lanes &= lanes - 1) {
        lom_tally *tally = tally_of(tile, worker->pixel[__builtin_ctz(lanes)]);
        if (tally == NULL)
            continue;
        tally->packets++;
        tally->lanes += lom_count_bits(covered);
    }
    lom_open_notes(worker->notes.skipped != ~0u ? &worker->notes : NULL);
}

void lom_tally_packet(struct lom_tile *tile, const struct lom_packet *packet)
{
    struct tally_worker *worker = worker_of(tile);
    worker->packet = packet;
    worker->covered = packet->covered;
    memcpy(worker->pixel, packet->places.pixel, sizeof worker->pixel);
    begin_packet(tile, worker);
}

void lom_tally_sprite(struct lom_tile *tile, int place, const lom_mask *covered)
{
    struct tally_worker *worker = worker_of(tile);
    worker->packet = NULL;
    worker->covered = *covered;
    for (int i = 0; i < LOM_LANES; i++)
        worker->pixel[i] = place + i;
    begin_packet(tile, worker);
}

static bool is_finite(float x)
{
    return x - x == 0;
}

static bool is_broken(const lom_shader *shader, const lom_fragment *out, int lane)
{
    bool whole = !shader->writes_depth || is_finite(out->depth[lane]);
    for (int c = 0; c < shader->colors; c++)
        whole &= is_finite(out->color[c].x[lane]) && is_finite(out->color[c].y[lane]) &&
                 is_finite(out->color[c].z[lane]) && is_finite(out->color[c].w[lane]);
    return !whole;
}

static bool is_mipped(const struct lom_note *note)
{
    const lom_texture *texture = note->object;
    return note->kind == LOM_NOTE_LOOKUP && texture->level_count > 1;
}

/* Counts of the notes by lane; which of them are asked for. */
static void read_notes(struct tally_worker *worker, const char *named, uint32_t lookups[4], uint32_t steps[4])
{
    const struct lom_notes *notes = &worker->notes;
    worker->named = worker->lookup = NULL;
    for (size_t i = 0; worker->notes.skipped != ~0u && i < notes->count; i++) {
        const struct lom_note *note = &notes->items[i];
        if (note->kind == LOM_NOTE_VALUE && strcmp(note->name, named) == 0)
            worker->named = note;
        if (is_mipped(note) && worker->lookup == NULL)
            worker->lookup = note;
        for (int lane = 0; lane < LOM_LANES; lane++) {
            int32_t there;
            memcpy(&there, &notes->rows[note->first + note->count - 1][lane], sizeof there);
            lookups[lane] += note->kind == LOM_NOTE_LOOKUP || note->kind == LOM_NOTE_TEXEL;
            steps[lane] += note->kind == LOM_NOTE_STEP && there != 0;
        }
    }
}

static bool reads_first(const struct lom_tile *tile)
{
    return (tile->draw->desc.shader->reads & 7) == 7;
}

void lom_tally_shaded(struct lom_tile *tile, const lom_varyings *in, const lom_fragment *out)
{
    struct tally_worker *worker = worker_of(tile);
    uint32_t lookups[LOM_LANES] = { 0 }, steps[LOM_LANES] = { 0 };
    lom_open_notes(NULL);
    worker->depth = out->depth;
    if (in != NULL && reads_first(tile))
        memcpy(worker->varying, in->varying, sizeof worker->varying);
    read_notes(worker, tile->pass->tallier->desc.named, lookups, steps);
    for (uint32_t lanes = lom_bits(worker->covered); lanes != 0; lanes &= lanes - 1) {
        int i = __builtin_ctz(lanes);
        lom_tally *tally = tally_of(tile, worker->pixel[i]);
        if (tally == NULL)
            continue;
        tally->lookups += lookups[i];
        tally->steps += steps[i];
        tally->broken += is_broken(tile->draw->desc.shader, out, i);
    }
}

/* ---- what is stored ---- */

/* The least distance of the weights' place to an edge, in pixels: weight k is edge function k over the area, and changes
 * by its steps over the area a pixel right and down. */
static float edge_distance(const lom_triangle *t, const struct lom_packet *packet, int lane)
{
    const double dx[3] = { -((double)t->step_x1 + t->step_x2), t->step_x1, t->step_x2 };
    const double dy[3] = { -((double)t->step_y1 + t->step_y2), t->step_y1, t->step_y2 };
    double least = 1e30;
    for (int k = 0; k < 3; k++) {
        double slope = lom_double_sqrt(dx[k] * dx[k] + dy[k] * dy[k]) * t->inverse_area;
        double distance = packet->l[k][lane] / slope;
        least = distance < least ? distance : least;
    }
    return (float)least;
}

/* Edge functions add up to twice the area in 1/65536 square pixels. */
static float area_of(const lom_triangle *t)
{
    double twice = lom_kind_of(&t->primitive) == TRIANGLE_LARGE ? 1 / (double)t->inverse_area : (double)t->area;
    return (float)(twice / (2.0 * SUBPIXELS * SUBPIXELS));
}

/* Clipping appends its vertices to the chunk's rows. */
static void find_made(const struct lom_tile *tile, const lom_primitive *p, int place, lom_tally *tally)
{
    const struct lom_chunk *chunk = tile->chunk;
    const lom_rect *v = &tile->draw->desc.viewport;
    int x, y;
    find_pixel(tile, place, &x, &y);
    for (int k = 0; k < (tile->draw->lines ? 2 : 3); k++) {
        if (p->row[k] / (uint32_t)tile->draw->row_floats < chunk->vertex_count)
            continue;
        int32_t at[2];
        memcpy(at, chunk->rows + p->row[k], sizeof at);
        int64_t dx = (int64_t)(x - v->x) * SUBPIXELS + SUBPIXELS / 2 - at[0];
        int64_t dy = (int64_t)(y - v->y) * SUBPIXELS + SUBPIXELS / 2 - at[1];
        tally->made++;
        tally->at_made |= dx * dx + dy * dy <= NEAR_VERTEX * NEAR_VERTEX;
    }
}

static float note_value(const struct tally_worker *worker, const struct lom_note *note, size_t row, int lane)
{
    return worker->notes.rows[note->first + row][lane];
}

static void store(const struct lom_tile *tile, lom_tally *tally, int place, int lane)
{
    const struct tally_worker *worker = worker_of(tile);
    const struct lom_packet *packet = worker->packet;
    const lom_primitive *p = &tile->chunk->primitives[packet->triangle[packet->which[lane]]];
    lom_triangle t;
    lom_find_triangle(tile->chunk, p, &t);
    const lom_float l[3] = { packet->l[0], packet->l[1], packet->l[2] };
    const struct depth_plane plane = find_depth(&t);
    tally->is_stored = true;
    tally->object = tile->draw->desc.object;
    tally->depth = tile->draw->desc.shader->writes_depth ? worker->depth[lane] : interpolate_depth(&plane, l)[lane];
    tally->edge = tile->draw->lines ? 0 : edge_distance(&t, packet, lane);
    tally->area = tile->draw->lines ? 0 : area_of(&t);
    tally->made = 0;
    tally->at_made = false;
    find_made(tile, p, place, tally);
    tally->is_mipped = worker->lookup != NULL;
    tally->asked = tally->is_mipped ? note_value(worker, worker->lookup, 3, lane) : 0;
    tally->level = tally->is_mipped ? note_value(worker, worker->lookup, 4, lane) : 0;
    tally->named_components = 0;
    tally->has_varyings = reads_first(tile);
    for (int k = 0; k < 3; k++)
        tally->varying[k] = tally->has_varyings ? worker->varying[k][lane] : 0;
}

static void store_named(const struct tally_worker *worker, lom_tally *tally, int lane)
{
    const struct lom_note *note = worker->named;
    float value[4] = { 0 };
    bool is_number = note != NULL && note->count <= 4;
    for (size_t c = 0; is_number && c < note->count; c++) {
        value[c] = note_value(worker, note, c, lane);
        is_number = value[c] == value[c];
    }
    if (!is_number)
        return;
    memcpy(tally->named, value, sizeof value);
    tally->named_components = (int)note->count;
}

void lom_tally_written(struct lom_tile *tile, const struct lom_places *places, const lom_mask *mask)
{
    const struct lom_draw_desc *desc = &tile->draw->desc;
    int attachment = tile->pass->tallier->attachment;
    bool writes = attachment < desc->shader->colors && desc->mask_off[attachment] != 15;
    if (worker_of(tile)->packet == NULL || !writes)
        return;
    for (uint32_t lanes = lom_bits(*mask); lanes != 0; lanes &= lanes - 1) {
        int i = __builtin_ctz(lanes);
        lom_tally *tally = tally_of(tile, places->pixel[i]);
        if (tally == NULL)
            continue;
        if (!desc->blend[attachment].enabled || desc->object != 0)
            store(tile, tally, places->pixel[i], i);
        store_named(worker_of(tile), tally, i);
    }
}
