/* The tests of draws that have a stencil or a query (draw->full_tests), in place of the depth test of packet.h: stencil,
 * depth, count, one sample at a time (sample_tests.wide.c). */
#ifndef LOM_PIPELINE_SAMPLE_TESTS_H
#define LOM_PIPELINE_SAMPLE_TESTS_H

#include "pipeline/window.h"

/* Fragments at different pixels, of one sample: leaves of `covered` the lanes that pass. A place is that of sample 0 in
 * tile memory (of sample_pitch words a pixel); front: the lanes of triangles that face front; failed: gets the lanes that
 * failed the stencil test. */
void LOM_WIDE(lom_test_sample)(struct lom_tile *tile, const struct lom_places *places, int sample, lom_mask *covered,
                               const lom_float *depth, const lom_mask *front, lom_mask *failed);
/* Before the shader, of a pass of one sample: a part of a window. */
void LOM_WIDE(lom_test_part)(struct lom_tile *tile, const struct part *at, lom_mask *covered, const lom_float *depth);
/* Before the shader, of several samples: covered and depth are of each; pixel: places in tile memory. */
void LOM_WIDE(lom_test_samples)(struct lom_tile *tile, const lom_int *pixel, bool front, lom_mask *covered,
                                const lom_float *depth);
/* After the shader, of a pass of one sample: the lanes of mask through the tests and the output stage, in lane order. */
void LOM_WIDE(lom_write_tested)(struct lom_tile *tile, const struct lom_packet *packet, const lom_mask *mask,
                                const lom_fragment *out);
/* The lanes of a packet that are of triangles facing front. */
void LOM_WIDE(lom_find_front)(const struct lom_tile *tile, const struct lom_packet *packet, lom_mask *front);

/* Whether a primitive faces front; what is no triangle does. */
LOM_INLINE bool lom_faces_front(const struct lom_draw *draw, const lom_primitive *p)
{
    return draw->sprites || draw->lines || (p->state >> TRIANGLE_FRONT & 1) != 0;
}

#endif
