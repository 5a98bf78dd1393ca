/* The end of a batch, recorded. In: triangles that came near a watched pixel, fragments of it. Out: for every watched
 * pixel the triangles that cover it or would have, in order, each with its fragment or the stage that dropped it.
 * Invariant: whether a triangle that was dropped would have covered the pixel is decided by its exact edge functions;
 * where it has none, by its clip positions in double (Olano and Greer 1997). */
#include "pipeline/record.h"

struct joint { /* a candidate at a pixel */
    lom_device *device;
    const struct lom_chunk *chunk;
    const struct record_candidate *candidate;
    struct record_pixel *pixel;
    lom_pass_record *pass;
    int64_t x, y; /* its centre in 1/256 pixel from the viewport's origin */
};

/* ---- where the pixel lies ---- */

struct edges {
    int64_t e[3], area; /* in the stage's order; positive inside */
    int order[3];
    bool inside;
};

static bool is_before(const int32_t a[2], const int32_t b[2])
{
    return a[1] < b[1] || (a[1] == b[1] && a[0] < b[0]);
}

/* Edge functions of three snapped vertices, of the edge opposite to each in the order of (y, x). */
static struct edges find_edges(const int32_t v[3][2], int64_t x, int64_t y)
{
    struct edges r = { .order = { 0, 1, 2 } };
    static const int pairs[3][2] = { { 0, 1 }, { 1, 2 }, { 0, 1 } };
    for (int i = 0; i < 3; i++) {
        int *a = &r.order[pairs[i][0]], *b = &r.order[pairs[i][1]], swap = *a;
        if (is_before(v[*b], v[*a])) {
            *a = *b;
            *b = swap;
        }
    }
    for (int i = 0; i < 3; i++) {
        const int32_t *a = v[r.order[(i + 1) % 3]], *b = v[r.order[(i + 2) % 3]];
        r.e[i] = ((int64_t)b[0] - a[0]) * (y - a[1]) - ((int64_t)b[1] - a[1]) * (x - a[0]);
        r.area += r.e[i];
    }
    int64_t sign = r.area < 0 ? -1 : 1;
    r.inside = r.area != 0;
    for (int i = 0; i < 3; i++) {
        const int32_t *a = v[r.order[(i + 1) % 3]], *b = v[r.order[(i + 2) % 3]];
        int64_t ex = sign * ((int64_t)b[0] - a[0]), ey = sign * ((int64_t)b[1] - a[1]);
        r.e[i] *= sign;
        bool owns = ey < 0 || (ey == 0 && ex > 0); /* the top-left rule */
        r.inside &= r.e[i] > 0 || (r.e[i] == 0 && owns);
    }
    r.area *= sign;
    return r;
}

static void read_corners(const struct lom_chunk *chunk, const uint32_t corner[3], int32_t v[3][2])
{
    for (int k = 0; k < 3; k++)
        memcpy(v[k], chunk->rows + corner[k] * (size_t)chunk->draw->row_floats, sizeof v[k]);
}

/* Whether the ray of the pixel meets the triangle before the eye: q = sum of b_k (x, y, w)_k with all b_k >= 0. */
static bool meets_ray(const struct joint *j, const float clip[3][4])
{
    const lom_rect *v = &j->chunk->draw->desc.viewport;
    double q[3] = { 2.0 * (double)j->x / (v->width * (double)SUBPIXELS) - 1,
                    1 - 2.0 * (double)j->y / (v->height * (double)SUBPIXELS), 1 };
    double b[3], determinant = 0;
    for (int k = 0; k < 3; k++) {
        const float *m = clip[(k + 1) % 3], *n = clip[(k + 2) % 3];
        double c[3] = { (double)m[1] * n[3] - (double)m[3] * n[1], (double)m[3] * n[0] - (double)m[0] * n[3],
                        (double)m[0] * n[1] - (double)m[1] * n[0] };
        b[k] = c[0] * q[0] + c[1] * q[1] + c[2] * q[2];
        if (k == 0)
            determinant = c[0] * clip[0][0] + c[1] * clip[0][1] + c[2] * clip[0][3];
    }
    double sign = determinant < 0 ? -1 : 1;
    return determinant != 0 && sign * b[0] >= 0 && sign * b[1] >= 0 && sign * b[2] >= 0;
}

/* ---- what is kept ---- */

static lom_draw_record *draw_record(const struct joint *j)
{
    const struct lom_draw *draw = j->chunk->draw;
    size_t number = (size_t)(draw - j->device->draws);
    lom_draw_record **last = &j->pass->draws;
    while (*last != NULL && (*last)->number != number)
        last = &(*last)->next;
    if (*last == NULL) {
        *last = lom_record_allocate(&j->pixel->memory, sizeof **last);
        if (*last != NULL)
            **last = (lom_draw_record){ .number = number,
                                        .label = draw->desc.label,
                                        .desc = draw->desc,
                                        .recorded = true,
                                        .depth_tested = draw->compare != LOM_COMPARE_ALWAYS,
                                        .depth_written = draw->depth_write,
                                        .compare = draw->compare,
                                        .pass = j->pass };
    }
    return *last;
}

static lom_triangle_record *add_triangle(const struct joint *j, lom_fate fate)
{
    lom_draw_record *draw = draw_record(j);
    lom_triangle_record *t = draw != NULL ? lom_record_allocate(&j->pixel->memory, sizeof *t) : NULL;
    if (t == NULL)
        return NULL;
    *t = (lom_triangle_record){
        .number = j->candidate->number, .instance = j->chunk->instance, .draw = draw, .fate = fate
    };
    if (j->chunk->draw->expands)
        lom_record_made_vertices(&j->device->pass, j->chunk, j->candidate, t->vertex);
    else if (!lom_record_vertices(&j->device->pass, j->chunk, j->candidate->index, &j->pixel->memory, t->vertex))
        j->pixel->memory.failed = true;
    lom_triangle_record **last = &draw->triangles;
    while (*last != NULL)
        last = &(*last)->next;
    *last = t;
    return t;
}

static bool is_cut(const struct record_candidate *c)
{
    return ((c->code[0] | c->code[1] | c->code[2]) & CODE_CLIP) != 0;
}

static void add_piece(const struct joint *j, int number, const struct edges *edges, bool turned, lom_fate fate,
                      const lom_fragment_record *fragment)
{
    const struct record_candidate *c = j->candidate;
    const struct record_piece *piece = &c->piece[number];
    const struct lom_draw *draw = j->chunk->draw;
    lom_triangle_record *t = add_triangle(j, fate);
    if (t == NULL)
        return;
    if (is_cut(c)) {
        t->piece = number;
        t->pieces = c->pieces;
        for (int k = 0; k < 3; k++) {
            t->cut[k].index = UINT32_MAX;
            lom_record_row(&j->device->pass, draw, j->chunk->rows + piece->corner[k] * (size_t)draw->row_floats,
                           piece->clip[k], &t->cut[k]);
        }
    }
    t->has_edges = !draw->lines;
    memcpy(t->order, edges->order, sizeof t->order);
    memcpy(t->edge, edges->e, sizeof t->edge);
    t->area = edges->area;
    t->front = draw->lines || turned == !draw->desc.front_clockwise;
    t->covered = fragment != NULL;
    if (fragment != NULL)
        t->fragment = *fragment;
}

static const struct record_raw *find_raw(const struct joint *j, size_t number)
{
    for (const struct record_raw *raw = j->pixel->raw; raw != NULL; raw = raw->next)
        if (raw->chunk == j->chunk && (size_t)raw->triangle == number)
            return raw;
    return NULL;
}

static lom_fate fate_of(const struct joint *j, const lom_fragment_record *f)
{
    int a = j->pass->attachment;
    if (!f->inside_distances)
        return LOM_FATE_DISTANCE;
    if (f->discarded)
        return LOM_FATE_DISCARDED;
    if (f->stencil_failed)
        return LOM_FATE_STENCIL;
    if (!f->depth_passed)
        return LOM_FATE_DEPTH;
    return (a < 0 ? f->depth_written : f->write[a].written) ? LOM_FATE_STORED : LOM_FATE_UNSHADED;
}

/* Whether the vertices run counter-clockwise as seen with y up. */
static bool is_counter_clockwise(const int32_t v[3][2])
{
    return ((int64_t)v[1][0] - v[0][0]) * ((int64_t)v[2][1] - v[0][1]) -
               ((int64_t)v[1][1] - v[0][1]) * ((int64_t)v[2][0] - v[0][0]) <
           0;
}

/* Returns whether the piece covers the pixel, or would have. */
static bool join_piece(const struct joint *j, int number)
{
    const struct record_piece *piece = &j->candidate->piece[number];
    const struct record_raw *raw = piece->stage == RECORD_DONE ? find_raw(j, piece->number) : NULL;
    int32_t v[3][2];
    read_corners(j->chunk, piece->corner, v);
    struct edges edges = { .order = { 0, 1, 2 } }; /* a line has none */
    if (!j->chunk->draw->lines)
        edges = find_edges(v, j->x, j->y);
    bool turned = is_counter_clockwise(v);
    if (raw != NULL)
        add_piece(j, number, &edges, turned, fate_of(j, &raw->fragment), &raw->fragment);
    else if (edges.inside)
        add_piece(j, number, &edges, turned, piece->stage == RECORD_SENT ? LOM_FATE_FACING : LOM_FATE_SCISSOR, NULL);
    return raw != NULL || edges.inside;
}

static void join(const struct joint *j)
{
    const struct record_candidate *c = j->candidate;
    bool touches = false;
    for (int i = 0; i < c->pieces; i++)
        touches |= join_piece(j, i);
    if (touches)
        return;
    if ((c->pieces == 0 || is_cut(c)) && meets_ray(j, c->clip)) {
        unsigned all = c->code[0] & c->code[1] & c->code[2];
        add_triangle(j, (all & 0xff) != 0 && (all & CODE_CLIP) == 0 ? LOM_FATE_DISTANCE : LOM_FATE_CLIPPED);
    } else if (c->has_box) {
        lom_draw_record *draw = draw_record(j);
        if (draw != NULL)
            draw->near_misses++;
    }
}

static void join_pixel(struct joint *j, struct record_pixel *pixel)
{
    const lom_rect *v = &j->chunk->draw->desc.viewport;
    j->pixel = pixel;
    j->pass = pixel->pixel.passes;
    while (j->pass != NULL && j->pass->next != NULL)
        j->pass = j->pass->next;
    if (j->pass == NULL)
        return;
    j->x = (int64_t)(j->pass->x - v->x) * SUBPIXELS + SUBPIXELS / 2;
    j->y = (int64_t)(j->pass->y - v->y) * SUBPIXELS + SUBPIXELS / 2;
    join(j);
}

/* The columns (or rows) of `count` from `first` on, in pixels of the viewport, whose centres lie in low..high. */
static void cut_range(int64_t low, int64_t high, int64_t first, int *from, int *to)
{
    int64_t least = ((low + SUBPIXELS / 2 - 1) >> SUBPIXEL_BITS) - first;
    int64_t most = ((high - SUBPIXELS / 2) >> SUBPIXEL_BITS) - first;
    *from = least > *from ? (int)least : *from;
    *to = most < *to ? (int)most : *to;
}

/* The pixels of a watch that the candidate's box holds. */
static void join_watch(struct joint *j, const struct record_watch *watch)
{
    const struct record_candidate *c = j->candidate;
    const lom_rect *v = &j->chunk->draw->desc.viewport;
    int left = 0, top = 0, right = watch->desc.width - 1, bottom = watch->desc.height - 1;
    if (c->has_box) {
        cut_range(c->low[0], c->high[0], watch->desc.x + watch->origin_x - v->x, &left, &right);
        cut_range(c->low[1], c->high[1], watch->desc.y + watch->origin_y - v->y, &top, &bottom);
    }
    for (int y = top; y <= bottom; y++)
        for (int x = left; x <= right; x++)
            join_pixel(j, &watch->pixels[y * watch->desc.width + x]);
}

void lom_record_batch(lom_device *device)
{
    struct lom_recorder *r = device->recorder;
    struct lom_pass *pass = &device->pass;
    struct joint j = { .device = device };
    for (size_t i = 0; i < pass->chunk_count; i++) {
        struct record_chunk *record = &r->chunks[i];
        j.chunk = &pass->chunks[i];
        r->failed |= record->failed;
        for (size_t k = 0; k < record->count; k++) {
            record->items[k].piece = record->pieces + record->items[k].first_piece;
            j.candidate = &record->items[k];
            for (size_t w = 0; w < r->watch_count; w++)
                if (r->watch[w].active)
                    join_watch(&j, &r->watch[w]);
        }
    }
    if (r->tells)
        lom_record_tell(device);
    for (size_t i = 0; i < pass->chunk_count; i++)
        r->chunks[i].count = 0;
    for (size_t w = 0; w < r->watch_count; w++)
        for (int i = 0; i < r->watch[w].desc.width * r->watch[w].desc.height; i++)
            r->watch[w].pixels[i].raw = NULL;
}
