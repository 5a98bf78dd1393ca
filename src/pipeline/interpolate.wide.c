/* Stage 6 of 7 for small triangles that are drawn together. In: their fragments, and those triangles' slots. Out: shaded
 * colours, on to the output stage. What fragments need of a triangle's vertices is found once a slot, for LOM_LANES
 * triangles at a time: fragment.wide.c, which is plainer, finds it again for each packet.
 *
 * Invariant: varyings are those of fragment.wide.c, by the same arithmetic. */
#include "pipeline/slots.h"

#if LOM_LANES > 4 /* SLOTS_BY_WORD: at 4 lanes a slot's words would be more than the vertices' rows */

#include "pipeline/values.h"

LOM_INLINE void store_value(struct lom_list *list, int word, int slot, lom_float x)
{
    lom_store(list->value + word * SLOT_PITCH + slot, x);
}

/* Where the rows of the vertices of LOM_LANES triangles begin, and that of the provoking one. */
struct vertex_rows {
    lom_int row[3], provoking;
};

static void fill_varying(struct lom_list *list, int word, int slot, const lom_float f[3], bool flat,
                         lom_float provoking)
{
    if (flat) {
        store_value(list, word + VALUE, slot, provoking);
        return;
    }
    store_value(list, word + VALUE, slot, f[0]);
    store_value(list, word + DELTA1, slot, f[1] - f[0]);
    store_value(list, word + DELTA2, slot, f[2] - f[0]);
    store_value(list, word + LOWEST, slot, lom_min(f[0], lom_min(f[1], f[2])));
    store_value(list, word + HIGHEST, slot, lom_max(f[0], lom_max(f[1], f[2])));
}

/* The varyings that are read, four of a row at a time. */
static void fill_varyings(struct lom_tile *tile, const struct vertex_rows *v, int slot)
{
    const lom_shader *shader = tile->draw->desc.shader;
    int word = VALUES;
    for (int first = 0; first < shader->varyings; first += 4) {
        uint32_t reads = shader->reads >> first & 15, flat = shader->flat >> first & reads;
        const float *from = tile->chunk->rows + ROW_HEADER + first;
        if (reads == 0)
            continue;
        lom_float4 a = lom_gather_rows(from, v->row[0]), b = lom_gather_rows(from, v->row[1]),
                   c = lom_gather_rows(from, v->row[2]), last = { a.x, a.y, a.z, a.w };
        if (flat != 0)
            last = lom_gather_rows(from, v->provoking);
        const lom_float f[4][3] = { { a.x, b.x, c.x }, { a.y, b.y, c.y }, { a.z, b.z, c.z }, { a.w, b.w, c.w } };
        const lom_float provoking[4] = { last.x, last.y, last.z, last.w };
        for (int k = 0; k < 4; k++)
            if (reads >> k & 1) {
                fill_varying(&tile->list, word, slot, f[k], flat >> k & 1, provoking[k]);
                word += VALUE_WORDS;
            }
    }
}

/* The steps of the weights: those of the edge functions over the area, both of which are in the slots. */
static void fill_steps(struct lom_list *list, int slot)
{
    const float *from = list->slots + slot;
    lom_float scale = lom_splat(SUBPIXELS), inverse = lom_load(from + SLOT_INVERSE * SLOT_PITCH);
    for (int i = 0; i < 2; i++) {
        lom_int pair = lom_load_int((const int32_t *)from + (SLOT_STEP1 + i) * SLOT_PITCH);
        store_value(list, STEPS + 2 * i, slot, lom_to_float(pair << 16 >> 16) * scale * inverse);
        store_value(list, STEPS + 2 * i + 1, slot, lom_to_float(pair >> 16) * scale * inverse);
    }
}

/* LOM_LANES slots; the words are those of lom_primitive. 1/w is there already. */
static void fill_packet(struct lom_tile *tile, int slot)
{
    struct lom_list *list = &tile->list;
    const float *words = (const float *)(const void *)tile->chunk->primitives;
    lom_int at = lom_load_int((const int32_t *)list->number + slot) * (int32_t)(sizeof(lom_primitive) / 4);
    lom_float4 last = lom_gather_rows(words, at);
    struct vertex_rows v = { .row = { lom_as_int(last.x), lom_as_int(last.y), lom_as_int(last.z) } };
    lom_int state = lom_as_int(last.w), provoking = state >> TRIANGLE_PROVOKING & 3;
    v.provoking = lom_select_int(provoking == 0, v.row[0], lom_select_int(provoking == 1, v.row[1], v.row[2]));
    store_value(list, FACING, slot, lom_as_float(-(state >> TRIANGLE_FRONT & 1)));
    if (tile->draw->desc.shader->differentiates != 0 || tile->draw->marks_edges)
        fill_steps(list, slot);
    fill_varyings(tile, &v, slot);
}

void LOM_WIDE(lom_fill_values)(struct lom_tile *tile)
{
    for (int slot = 0; slot < tile->list.triangles; slot += LOM_LANES)
        fill_packet(tile, slot);
}

LOM_INLINE void find_entry_varyings(struct lom_tile *tile, const struct packed *p, const struct lom_packet *packet,
                                    lom_varyings *in)
{
    const lom_shader *shader = tile->draw->desc.shader;
    const struct values values = { tile->list.value + p->first, p->which, NULL };
    in->levels = NULL;
    find_varyings(&values, shader, packet, false, in);
    if (shader->reads_position) {
        in->x = lom_to_float((p->code >> CODE_X & 63) + tile->x) + 0.5f;
        in->y = lom_to_float((p->code >> CODE_Y & 63) + tile->y) + 0.5f;
    }
    if (tile->draw->marks_edges) /* what clip distances cut is in no slot */
        mark_edges(tile, &values, packet, false);
}

void LOM_WIDE(lom_shade_slots)(struct lom_tile *tile, const struct packed *p, const struct lom_packet *packet,
                               int count)
{
    struct lom_together *together = &tile->together;
    for (int i = 0; i < count; i++)
        find_entry_varyings(tile, &p[i], &packet[i], varyings_in(together->varyings, i));
    if (tile->draw->sampled) { /* one packet */
        LOM_WIDE(lom_run_sampled)(tile, packet, varyings_in(together->varyings, 0));
        return;
    }
    for (int i = 0; i < count; i++)
        lom_call_shader(tile, &packet[i], varyings_in(together->varyings, i), fragment_in(together, i));
    for (int i = 0; i < count; i++)
        lom_write_shaded(tile, &packet[i], fragment_in(together, i));
}

#endif
