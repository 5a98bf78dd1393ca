/* Feedback (lom/stages.h). In: the pieces of a chunk after the last of its stages. Out: what the buffer keeps of their
 * vertices, chunk after chunk in the order of the draws. Invariant: the buffer holds whole primitives, the first ones. */
#include "pipeline/expand.h"

static size_t stride_floats(const lom_feedback *feedback)
{
    return (size_t)__builtin_popcount(feedback->varyings) + (feedback->position ? 4 : 0);
}

size_t lom_feedback_stride(const lom_feedback *feedback)
{
    return stride_floats(feedback) * sizeof(float);
}

bool lom_capture(struct lom_chunk *chunk, const struct lom_stage_rows *rows, const struct lom_pieces *pieces)
{
    const lom_feedback *feedback = chunk->draw->desc.feedback;
    size_t pitch = (size_t)chunk->draw->stage_pitch, count = pieces->count * (size_t)pieces->vertices;
    if (!lom_renew(&chunk->captured, &chunk->captured_capacity, count * stride_floats(feedback), sizeof(float), NULL))
        return false;
    float *to = chunk->captured;
    for (size_t i = 0; i < count; i++) {
        const float *row = rows->row + pieces->vertex[i] * pitch;
        for (int k = 0; k < 4 && feedback->position; k++)
            *to++ = row[k];
        for (uint32_t left = feedback->varyings; left != 0; left &= left - 1)
            *to++ = row[LOM_ROW_VARYINGS + __builtin_ctz(left)];
    }
    chunk->captured_vertices = count;
    return true;
}

void lom_place_feedback(struct lom_chunk *chunk)
{
    lom_feedback *feedback = chunk->draw->desc.feedback;
    static const uint8_t vertices[] = { [LOM_TRIANGLES] = 3, [LOM_POINTS] = 1, [LOM_LINES] = 2 };
    size_t stride = lom_feedback_stride(feedback), piece = vertices[chunk->draw->drawn];
    size_t fits = feedback->size / stride - feedback->written, written = chunk->captured_vertices;
    if (feedback->needed > feedback->written)
        written = 0;
    else if (written > fits)
        written = fits / piece * piece;
    chunk->kept_bytes = written * stride;
    chunk->kept_from = feedback->written * stride;
    feedback->written += written;
    feedback->needed += chunk->captured_vertices;
}

void lom_copy_feedback(const struct lom_chunk *chunk)
{
    if (chunk->draw->desc.feedback != NULL && chunk->kept_bytes > 0)
        memcpy((char *)chunk->draw->desc.feedback->data + chunk->kept_from, chunk->captured, chunk->kept_bytes);
}
