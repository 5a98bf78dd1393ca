/* What tests of recording draw: triangles at random, some far beyond the guard band, some with vertices behind the eye; a
 * geometry function that hands its triangles on; the evaluation of a patch that is a mix of its corners. */
#ifndef TESTS_INSPECT_SOUP_H
#define TESTS_INSPECT_SOUP_H

#include <lom/stages.h>

#include "../pipeline/stage.h"

static inline void make_soup(vertex *soup, int triangles)
{
    for (int i = 0; i < 3 * triangles; i++) {
        float reach = i / 3 % 4 == 0 ? 20.0f : 1.3f;
        for (int k = 0; k < 2; k++)
            soup[i].position[k] = random_float(-reach, reach);
        soup[i].position[2] = random_float(0.1f, 0.9f);
        soup[i].position[3] = i / 3 % 7 == 3 ? random_float(-0.5f, 2) : random_float(0.9f, 2);
        for (int k = 0; k < 4; k++)
            soup[i].value[k] = random_float(0, 1);
    }
}

static inline void hand_on(lom_primitive_stream *out, const lom_geometry_input *in, const void *uniforms)
{
    (void)uniforms;
    for (int i = 0; i < 3; i++)
        lom_emit_vertex(out, &in->vertex[i], lom_splat_int(-1));
}

/* Places are mixed; values are those of the first corner. */
static inline void mix_corners(lom_vertex *out, const lom_domain_point *in, const void *uniforms)
{
    (void)uniforms;
    const lom_vertex *p = in->patch.point;
    for (int k = 0; k < 4; k++)
        (&out->position.x)[k] =
            in->u * (&p[0].position.x)[k] + in->v * (&p[1].position.x)[k] + in->w * (&p[2].position.x)[k];
    for (int k = 0; k < 4; k++)
        out->varying[k] = p[0].varying[k];
}

#endif
