/* The shader that copies. In: colour and depth of the frame's scene. Out: those of pixels whose surface lies inside a
 * plane, where the pass begins with them: the nearest surface of all is the nearest of those inside. Invariant: what is
 * copied is what the pass would draw there; near the plane, where rounding might decide, nothing is. */
#include "water/scene_copy.h"

#include <lom/lanes_mathematics.h>

static void vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    (void)uniforms;
    lom_float s = lom_to_float(in->vertex & 1), t = lom_to_float(in->vertex >> 1);
    out->position = (lom_float4){ 2.0f * s - 1.0f, 1.0f - 2.0f * t, { 0 }, lom_splat(1.0f) };
}

static void fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct lom_scene_copy_uniforms *u = uniforms;
    lom_int x = lom_to_int(in->x - u->origin[0]), y = lom_to_int(in->y - u->origin[1]);
    lom_float depth = lom_fetch(u->depth, x, y, 0).x;
    lom_float away = lom_depth_reach(&u->eye, depth);
    lom_float height = in->x * u->height[0] + in->y * u->height[1] + u->height[2];
    height = u->eye.parallel ? height + away * u->eye.along[1] : height * away;
    out->discard = ~((depth > 0.0f) & (height * u->side + u->over > u->margin));
    out->depth = depth;
    if (lom_any(in->covered & ~out->discard))
        out->color[0] = lom_fetch(u->color, x, y, 0);
}

LOM_SHADER(lom_scene_copy_shader, vertex, fragment, .reads_position = true, .discards = true, .writes_depth = true,
           .colors = 1, .uniforms_size = sizeof(struct lom_scene_copy_uniforms))
