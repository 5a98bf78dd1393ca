/* The shaders of the wires of patches (quality.wireframe with quality.tessellation): what evaluation places, in one
 * colour or as depth alone, and a geometry function that makes lines of triangles. */
#include "render/ground/shaders.h"

/* A knot as it is: it is evaluation that knows places. */
static void knot(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    (void)uniforms;
    out->position = in->attribute[0];
}

static void cut_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct lom_cut_wire_uniforms *wire = uniforms;
    (void)in;
    out->color[0] = (lom_float4){ lom_splat(wire->color[0]), lom_splat(wire->color[1]), lom_splat(wire->color[2]),
                                  lom_splat(1.0f) };
}

/* Whether a comes behind b, coordinate by coordinate. */
static lom_mask is_greater(const lom_float4 *a, const lom_float4 *b)
{
    lom_mask greater = a->w > b->w;
    greater = (a->z > b->z) | ((a->z == b->z) & greater);
    greater = (a->y > b->y) | ((a->y == b->y) & greater);
    return (a->x > b->x) | ((a->x == b->x) & greater);
}

static lom_float4 choose(lom_mask which, const lom_float4 *a, const lom_float4 *b)
{
    return (lom_float4){ lom_select(which, a->x, b->x), lom_select(which, a->y, b->y), lom_select(which, a->z, b->z),
                         lom_select(which, a->w, b->w) };
}

static void edges(lom_primitive_stream *out, const lom_geometry_input *in, const void *uniforms)
{
    const lom_mask all = lom_splat_int(-1);
    (void)uniforms;
    for (int i = 0; i < 3; i++) {
        const lom_float4 *a = &in->vertex[i].position, *b = &in->vertex[(i + 1) % 3].position;
        const lom_mask turn = is_greater(a, b);
        lom_vertex end = { .position = choose(turn, b, a) };
        lom_emit_vertex(out, &end, all);
        end.position = choose(turn, a, b);
        lom_emit_vertex(out, &end, all);
        lom_end_strip(out, all);
    }
}

LOM_SHADER(lom_cut_wire_shader, knot, cut_fragment, .attributes = 1, .colors = 1,
           .uniforms_size = sizeof(struct lom_cut_wire_uniforms))
LOM_DEPTH_SHADER(lom_cut_wire_surface_shader, knot, .attributes = 1,
                 .uniforms_size = sizeof(struct lom_cut_wire_uniforms))
LOM_GEOMETRY(lom_triangle_edges, edges, .in = LOM_TRIANGLES, .out = LOM_LINE_STRIP, .vertices = 6)
