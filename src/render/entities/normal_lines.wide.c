/* The normals of entities' vertices as lines (quality.normals): each vertex is a point, of which a geometry function makes a
 * line from the surface to the normal's tip. */
#include "render/entities/shaders.h"

enum { TIP = 0, PLANE = 4, SHARE, VARYINGS };

static void vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct lom_normal_uniforms *u = uniforms;
    lom_float3 model = { in->attribute[0].x, in->attribute[0].y, in->attribute[0].z };
    lom_float3 normal =
        lom_rotate3(&u->normal_from_model, (lom_float3){ in->attribute[1].x, in->attribute[1].y, in->attribute[1].z });
    lom_float3 offset = lom_transform3(&u->offset_from_model, model);
    lom_float3 tip = lom_add3(offset, lom_scale3(lom_normalize3(normal), lom_splat(u->length)));
    lom_float4 at = lom_transform4(&u->clip_from_offset, tip);
    out->position = lom_transform4(&u->clip_from_offset, offset);
    out->distance[0] = lom_transform_row(u->plane, offset);
    out->varying[TIP] = at.x;
    out->varying[TIP + 1] = at.y;
    out->varying[TIP + 2] = at.z;
    out->varying[TIP + 3] = at.w;
    out->varying[PLANE] = lom_transform_row(u->plane, tip);
    out->varying[SHARE] = lom_splat(0);
}

static void line(lom_primitive_stream *out, const lom_geometry_input *in, const void *uniforms)
{
    (void)uniforms;
    lom_vertex end = in->vertex[0];
    lom_emit_vertex(out, &end, lom_splat_int(-1));
    end.position = (lom_float4){ end.varying[TIP], end.varying[TIP + 1], end.varying[TIP + 2], end.varying[TIP + 3] };
    end.distance[0] = end.varying[PLANE];
    end.varying[SHARE] = lom_splat(1);
    lom_emit_vertex(out, &end, lom_splat_int(-1));
}

/* From orange at the surface to light blue at the tip. */
static void fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)uniforms;
    lom_float share = in->varying[SHARE];
    out->color[0] = (lom_float4){ 0.9f - 0.6f * share, 0.25f + 0.5f * share, 0.05f + 0.95f * share, lom_splat(1) };
}

LOM_SHADER(lom_normal_shader, vertex, fragment, .attributes = 2, .varyings = VARYINGS, .clip_distances = 1,
           .reads = LOM_VARYINGS(SHARE, 1), .colors = 1, .uniforms_size = sizeof(struct lom_normal_uniforms))
LOM_GEOMETRY(lom_normal_lines, line, .in = LOM_POINTS, .out = LOM_LINE_STRIP, .vertices = 2)
