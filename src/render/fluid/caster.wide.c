/* Liquids as a light sees them. In: their surface as triangles. Out: optical depths of red, green and blue along the
 * light's rays, and the depth of what is nearest to it.
 *
 * A ray's way through closed surfaces is the sum of the ways to those that turn their backs less that to those that face
 * the light: exact in any order, by blending alone. */
#include "render/fluid/shaders.h"

enum { PLACE = 0, VARYINGS = 3 };

static void vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct lom_fluid_caster_uniforms *u = uniforms;
    lom_float3 place = { in->attribute[0].x, in->attribute[0].y, in->attribute[0].z };
    out->position = lom_transform4(&u->clip_from_mesh, place);
    out->varying[PLACE] = place.x;
    out->varying[PLACE + 1] = place.y;
    out->varying[PLACE + 2] = place.z;
}

static void fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct lom_fluid_caster_uniforms *u = uniforms;
    lom_float3 place = { in->varying[PLACE], in->varying[PLACE + 1], in->varying[PLACE + 2] };
    lom_float3 from = lom_add3(place, lom_uniform3(u->shift));
    lom_float way = u->parallel ? lom_transform_row(u->along, place) : lom_sqrt(lom_dot3(from, from));
    out->color[0] = (lom_float4){ way * u->extinction[0], way * u->extinction[1], way * u->extinction[2], in->z };
}

LOM_SHADER(lom_fluid_caster_shader, vertex, fragment, .attributes = 1, .varyings = VARYINGS,
           .reads = LOM_VARYINGS(0, VARYINGS), .reads_position = true, .colors = 1,
           .uniforms_size = sizeof(struct lom_fluid_caster_uniforms))
