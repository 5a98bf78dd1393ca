/* The stages between vertices and clipping (lom/stages.h), a packet of patches, places or primitives at a time. In: rows
 * that are not projected. Out: such rows; at last the rows, clip positions and outcodes that the vertex stage writes.
 * Invariant: a row is a function of its piece and its place alone. */
#include "pipeline/stage_rows.h"
#include "pipeline/variants.h"

static void load_pieces(const struct lom_draw *draw, const struct lom_stage_rows *rows, const struct lom_pieces *pieces,
                        lom_int piece, lom_vertex *vertex)
{
    for (int k = 0; k < pieces->vertices; k++)
        load_vertex(draw, rows->row, lom_gather_int((const int32_t *)pieces->vertex, piece * pieces->vertices + k),
                    &vertex[k]);
}

/* ---- tessellation ---- */

void LOM_WIDE(lom_control_patches)(const struct lom_chunk *chunk, size_t first, float (*levels)[LEVEL_WORDS])
{
    const struct lom_draw *draw = chunk->draw;
    const struct lom_expansion *e = &chunk->assembly->expansion;
    lom_int piece = lanes_from(first, e->pieces[0].count);
    lom_levels out = { .inner = { { 0 } } };
    lom_patch in = { .point = (const lom_vertex *)(const void *)e->point,
                     .points = e->pieces[0].vertices,
                     .number = lom_gather_int((const int32_t *)e->pieces[0].number, piece),
                     .instance = lom_splat_int(chunk->instance) };
    load_pieces(draw, &e->rows[0], &e->pieces[0], piece, (lom_vertex *)(void *)e->point);
    draw->desc.tessellation->control[draw->variant](&out, &in, chunk->uniforms);
    for (int i = 0; i < LOM_LANES; i++)
        for (int k = 0; k < LEVEL_WORDS; k++)
            levels[i][k] = k < 4 ? out.outer[k][i] : out.inner[k - 4][i];
}

static void place_points(const struct lom_pattern *pattern, lom_domain domain, lom_int place, lom_domain_point *in)
{
    const int32_t *from = (const int32_t *)pattern->place;
    lom_int u = lom_gather_int(from, 2 * place), v = lom_gather_int(from, 2 * place + 1);
    in->u = lom_to_float(u) * (1.0f / DOMAIN_ONE);
    in->v = lom_to_float(v) * (1.0f / DOMAIN_ONE);
    if (domain == LOM_DOMAIN_TRIANGLES)
        in->w = lom_to_float(DOMAIN_ONE - u - v) * (1.0f / DOMAIN_ONE);
}

void LOM_WIDE(lom_evaluate_patch)(const struct lom_chunk *chunk, size_t patch, const float levels[LEVEL_WORDS],
                                  float *rows)
{
    const struct lom_draw *draw = chunk->draw;
    const lom_tessellation *t = draw->desc.tessellation;
    const struct lom_expansion *e = &chunk->assembly->expansion;
    lom_int piece = lom_splat_int((int32_t)patch);
    lom_domain_point in = { .patch = { .point = (const lom_vertex *)(const void *)e->point,
                                       .points = e->pieces[0].vertices,
                                       .number = lom_splat_int((int32_t)e->pieces[0].number[patch]),
                                       .instance = lom_splat_int(chunk->instance) } };
    lom_vertex vertex;
    memset(&vertex, 0, sizeof vertex);
    load_pieces(draw, &e->rows[0], &e->pieces[0], piece, (lom_vertex *)(void *)e->point);
    for (int k = 0; k < LEVEL_WORDS; k++)
        *(k < 4 ? &in.levels.outer[k] : &in.levels.inner[k - 4]) = lom_splat(levels[k]);
    for (size_t first = 0; first < e->pattern->places; first += LOM_LANES) {
        place_points(e->pattern, t->domain, lanes_from(first, e->pattern->places), &in);
        vertex.point_size = lom_splat(1);
        t->evaluation[draw->variant](&vertex, &in, chunk->uniforms);
        store_vertex(draw, rows + first * (size_t)draw->stage_pitch, &vertex);
    }
}

/* ---- geometry ---- */

void LOM_WIDE(lom_emit_pieces)(const struct lom_chunk *chunk, int from, size_t first, int32_t *count)
{
    const struct lom_draw *draw = chunk->draw;
    const lom_geometry *geometry = draw->desc.geometry;
    const struct lom_expansion *e = &chunk->assembly->expansion;
    const struct lom_pieces *pieces = &e->pieces[from];
    lom_int piece = lanes_from(first, pieces->count);
    lom_geometry_input in = { .vertex = (const lom_vertex *)(const void *)e->point,
                              .number = lom_gather_int((const int32_t *)pieces->number, piece),
                              .instance = lom_splat_int(chunk->instance) };
    lom_primitive_stream out = { .rows = e->emitted,
                                 .pitch = draw->stage_pitch,
                                 .most = geometry->vertices,
                                 .varyings = draw->desc.shader->varyings,
                                 .distances = draw->distances,
                                 .alive = piece == lom_lane_index() + (int32_t)first };
    load_pieces(draw, &e->rows[from], pieces, piece, (lom_vertex *)(void *)e->point);
    geometry->geometry[draw->variant](&out, &in, chunk->uniforms);
    lom_store_int(count, out.count);
}
