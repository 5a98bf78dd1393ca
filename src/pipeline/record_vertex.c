/* The vertices of a recorded triangle. In: their indices, or the rows that clipping made. Out: what the vertex stage and
 * its shader say of them: the stage runs once more for these three, and a row is a function of the vertex alone. */
#include "pipeline/project.h"
#include "pipeline/record.h"
#include "pipeline/variants.h"

const char lom_attributes_note[] = "attributes";

void lom_record_attributes(const struct lom_attributes *in, int count)
{
    lom_note(LOM_NOTE_VALUE, lom_attributes_note, NULL, in->attribute, 4 * (size_t)count);
}

void lom_record_row(const struct lom_pass *pass, const struct lom_draw *draw, const float *row, const float clip[4],
                    lom_vertex_record *vertex)
{
    struct lom_projection f = lom_projection_of(pass, draw);
    const lom_shader *shader = draw->desc.shader;
    memcpy(vertex->clip, clip, sizeof vertex->clip);
    for (int i = 0; i < 3; i++)
        vertex->ndc[i] = clip[i] / clip[3];
    vertex->window[0] = (vertex->ndc[0] * f.x_scale + f.x_offset) / SUBPIXELS + (float)draw->desc.viewport.x;
    vertex->window[1] = (vertex->ndc[1] * f.y_scale + f.y_offset) / SUBPIXELS + (float)draw->desc.viewport.y;
    vertex->window[2] = vertex->ndc[2] * f.z_scale + f.z_offset;
    memcpy(vertex->fixed, row, sizeof vertex->fixed);
    vertex->depth = row[2];
    vertex->one_over_w = row[3];
    memcpy(vertex->varying, row + ROW_HEADER, (size_t)shader->varyings * sizeof *row);
    memcpy(vertex->distance, row + draw->distance_offset, (size_t)draw->distances * sizeof *row);
}

static void copy_attributes(const struct lom_notes *notes, int lane, lom_vertex_record *vertex)
{
    for (size_t i = 0; i < notes->count; i++)
        for (size_t k = 0; notes->items[i].name == lom_attributes_note && k < notes->items[i].count; k++)
            vertex->attribute[k / 4][k % 4] = notes->rows[notes->items[i].first + k][lane];
}

bool lom_record_vertices(const struct lom_pass *pass, const struct lom_chunk *chunk, const uint32_t index[3],
                         struct record_memory *memory, lom_vertex_record vertex[3])
{
    uint32_t list[3] = { index[0], index[1], index[2] };
    struct lom_notes *notes = &pass->recorder->worker[0].notes;
    struct lom_assembly assembly = { .vertex_list = list };
    struct lom_chunk three = { .draw = chunk->draw,
                               .uniforms = chunk->uniforms,
                               .instance = chunk->instance,
                               .assembly = &assembly,
                               .vertex_count = 3,
                               .listed = true };
    bool done = lom_reserve_rows(&three, 3);
    if (done) {
        lom_open_notes(notes);
        lom_stages_of(chunk->draw->variant)->shade_vertices(pass, &three);
        lom_open_notes(NULL);
    }
    for (int k = 0; done && k < 3; k++) {
        lom_record_row(pass, chunk->draw, three.rows + (size_t)k * (size_t)chunk->draw->row_floats,
                       assembly.clip + 4 * (size_t)k, &vertex[k]);
        vertex[k].index = index[k];
        vertex[k].code = assembly.codes[k];
        copy_attributes(notes, k, &vertex[k]);
        vertex[k].notes = lom_record_notes(memory, notes, k);
    }
    lom_release(three.rows);
    lom_release(assembly.clip);
    lom_release(assembly.codes);
    return done;
}

/* Of a triangle that tessellation or geometry made: no vertex of the draw, but a row that is still there. */
void lom_record_made_vertices(const struct lom_pass *pass, const struct lom_chunk *chunk,
                              const struct record_candidate *candidate, lom_vertex_record vertex[3])
{
    size_t pitch = (size_t)chunk->draw->row_floats;
    for (int k = 0; k < 3; k++) {
        lom_record_row(pass, chunk->draw, chunk->rows + candidate->corner[k] * pitch, candidate->clip[k], &vertex[k]);
        vertex[k].index = UINT32_MAX;
        vertex[k].code = candidate->code[k];
    }
}
