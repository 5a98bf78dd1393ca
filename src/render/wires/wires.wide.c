/* The shaders of wires: places, and one colour. */
#include "render/wires/shaders.h"

static void vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct lom_wire_uniforms *wire = uniforms;
    out->position = lom_transform4(&wire->clip_from_model,
                                   (lom_float3){ in->attribute[0].x, in->attribute[0].y, in->attribute[0].z });
}

static void fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct lom_wire_uniforms *wire = uniforms;
    (void)in;
    out->color[0] = (lom_float4){ lom_splat(wire->color[0]), lom_splat(wire->color[1]), lom_splat(wire->color[2]),
                                  lom_splat(1.0f) };
}

LOM_SHADER(lom_wire_shader, vertex, fragment, .attributes = 1, .colors = 1,
           .uniforms_size = sizeof(struct lom_wire_uniforms))
LOM_DEPTH_SHADER(lom_wire_surface_shader, vertex, .attributes = 1, .uniforms_size = sizeof(struct lom_wire_uniforms))
