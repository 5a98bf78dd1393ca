/* What becomes of a draw's fragments, from the input of fuzz_draw: rectangles, blending, stencil, queries. */
#ifndef LOM_TESTS_FUZZ_DRAW_OUTPUT_H
#define LOM_TESTS_FUZZ_DRAW_OUTPUT_H

#include <lom/pipeline.h>

#include "bytes.h"

enum { QUERIES = 2 };

/* An enumerator, or a value that is none. */
static int take_enum(fuzz_bytes *in, int count)
{
    unsigned byte = take_byte(in);
    return byte == 255 ? -1 : byte == 254 ? count : (int)byte % count;
}

/* All of it, a part, or any. */
static lom_rect take_rect(fuzz_bytes *in)
{
    int choice = take_choice(in, 16);
    if (choice < 8)
        return (lom_rect){ 0 };
    if (choice < 15)
        return (lom_rect){ take_choice(in, 30) - 4, take_choice(in, 30) - 4, 1 + take_choice(in, 60),
                           1 + take_choice(in, 60) };
    int x = take_int(in), y = take_int(in), width = take_int(in), height = take_int(in);
    return (lom_rect){ x, y, width, height };
}

static void take_floats(fuzz_bytes *in, float *out, int count)
{
    for (int i = 0; i < count; i++)
        out[i] = take_float(in);
}

static lom_blend take_blend(fuzz_bytes *in)
{
    return (lom_blend){ .enabled = take_bool(in),
                        .source_color = (lom_factor)take_enum(in, LOM_FACTOR_COUNT),
                        .target_color = (lom_factor)take_enum(in, LOM_FACTOR_COUNT),
                        .source_alpha = (lom_factor)take_enum(in, LOM_FACTOR_COUNT),
                        .target_alpha = (lom_factor)take_enum(in, LOM_FACTOR_COUNT),
                        .color_operation = (lom_blend_operation)take_enum(in, LOM_BLEND_OPERATION_COUNT),
                        .alpha_operation = (lom_blend_operation)take_enum(in, LOM_BLEND_OPERATION_COUNT) };
}

static lom_stencil_face take_stencil_face(fuzz_bytes *in)
{
    lom_stencil_face face = { .compare = (lom_compare)take_enum(in, 9),
                              .fail = (lom_stencil_operation)take_enum(in, LOM_STENCIL_OPERATION_COUNT),
                              .depth_fail = (lom_stencil_operation)take_enum(in, LOM_STENCIL_OPERATION_COUNT),
                              .pass = (lom_stencil_operation)take_enum(in, LOM_STENCIL_OPERATION_COUNT) };
    face.reference = (uint8_t)take_byte(in);
    face.read_off = (uint8_t)(take_bool(in) ? take_byte(in) : 0);
    face.write_off = (uint8_t)(take_bool(in) ? take_byte(in) : 0);
    return face;
}

/* Stencil, queries and conditions, blending by constants and two sources, logical operations, coverage by alpha. */
static void take_output(fuzz_bytes *in, lom_query *const queries[QUERIES], lom_draw_desc *draw)
{
    const int which = take_byte(in) & 63;
    if ((which & 1) != 0) {
        draw->stencil.enabled = true;
        draw->stencil.two_sided = take_bool(in);
        draw->stencil.front = take_stencil_face(in);
        if (draw->stencil.two_sided)
            draw->stencil.back = take_stencil_face(in);
    }
    if ((which & 2) != 0)
        draw->query = queries[take_choice(in, QUERIES)];
    if ((which & 4) != 0) {
        draw->condition = queries[take_choice(in, QUERIES)];
        draw->condition_inverted = take_bool(in);
    }
    if ((which & 8) != 0)
        draw->logic = (lom_logic)take_enum(in, LOM_LOGIC_COUNT);
    if ((which & 16) != 0) {
        draw->blend[0] = take_blend(in);
        take_floats(in, draw->blend_constant, 4);
    }
    if ((which & 32) != 0) {
        draw->per_sample = take_bool(in);
        draw->alpha_to_coverage = take_bool(in);
        draw->viewport = take_rect(in);
        draw->max_depth = take_bool(in) ? take_float(in) : 0;
        draw->min_depth = take_bool(in) ? take_float(in) : 0;
    }
}

#endif
