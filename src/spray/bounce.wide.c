/* Drops that bounce (spray.bounce), a step: the vertex function of a pass for feedback alone. In: what a drop is before it.
 * Out: after it. Invariant: a drop's steps begin at its birth, whole ones first, and the last is what is left of its age; so
 * where it is at a time follows from its number and the time alone.
 *
 * The equation is that of particle_flight.c, dv/dt = g - drag (v - wind), by the implicit method of Euler, which no drag
 * upsets: v' = (v + dt (g + drag wind)) / (1 + drag dt), x' = x + dt v'. Below the ground the part of v' along its normal n is
 * turned round and shortened: v' - (1 + bounce) (v' n) n. */
#include "spray/spray.h"

#include <lom/stages.h>

static const float gravity = 9.80665f;

/* Height and upright normal of the ground; far below where there is none. */
struct floor {
    lom_float height;
    lom_float3 normal;
};

/* On the triangles of the map, a b c and d c b of each quad. */
static struct floor floor_at(const struct lom_bounce_uniforms *u, lom_float3 place)
{
    struct floor f = { lom_splat(u->level), { lom_splat(0), lom_splat(1), lom_splat(0) } };
    if (u->heights == NULL)
        return f;
    lom_float column = (place.x - u->corner[0]) * u->scale[0], row = (place.z - u->corner[1]) * u->scale[1];
    lom_mask over = (column >= 0.0f) & (column <= (float)u->columns) & (row >= 0.0f) & (row <= (float)u->rows);
    lom_float x = lom_select(over, column, lom_splat(0)), y = lom_select(over, row, lom_splat(0));
    lom_int i = lom_min_int(lom_to_int(x), lom_splat_int(u->columns - 1));
    lom_int j = lom_min_int(lom_to_int(y), lom_splat_int(u->rows - 1));
    lom_int at = j * (u->columns + 1) + i;
    lom_float s = x - lom_to_float(i), t = y - lom_to_float(j);
    lom_float a = lom_gather(u->heights, at), b = lom_gather(u->heights, at + 1);
    lom_float c = lom_gather(u->heights, at + u->columns + 1), d = lom_gather(u->heights, at + u->columns + 2);
    lom_mask upper = s + t <= 1.0f;
    lom_float across = lom_select(upper, b - a, d - c), down = lom_select(upper, c - a, d - b);
    lom_float height = lom_select(upper, a + s * across + t * down, d - (1.0f - s) * across - (1.0f - t) * down);
    f.height = lom_select(over, height + u->level, lom_splat(-1e30f));
    f.normal = lom_normalize3((lom_float3){ -across * u->scale[0], lom_splat(1), -down * u->scale[1] });
    return f;
}

static void step(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct lom_bounce_uniforms *u = uniforms;
    lom_float4 state = in->attribute[0];
    lom_float dt = lom_min(lom_splat(u->step), state.w), inverse = 1.0f / (1.0f + u->drag * dt);
    lom_float3 v = { in->attribute[1].x, in->attribute[1].y, in->attribute[1].z };
    v.x = (v.x + dt * (u->drag * u->wind[0])) * inverse;
    v.y = (v.y + dt * (u->drag * u->wind[1] - gravity)) * inverse;
    v.z = (v.z + dt * (u->drag * u->wind[2])) * inverse;
    lom_float3 place = { state.x + dt * v.x, state.y + dt * v.y, state.z + dt * v.z };
    struct floor f = floor_at(u, place);
    lom_mask below = place.y < f.height;
    lom_float into = lom_min(lom_dot3(v, f.normal), lom_splat(0));
    lom_float push = lom_select(below, into * (1.0f + u->bounce), lom_splat(0));
    v = lom_sub3(v, lom_scale3(f.normal, push));
    out->varying[LOM_BOUNCE_PLACE] = place.x;
    out->varying[LOM_BOUNCE_PLACE + 1] = lom_max(place.y, f.height);
    out->varying[LOM_BOUNCE_PLACE + 2] = place.z;
    out->varying[LOM_BOUNCE_LEFT] = state.w - dt;
    out->varying[LOM_BOUNCE_VELOCITY] = v.x;
    out->varying[LOM_BOUNCE_VELOCITY + 1] = v.y;
    out->varying[LOM_BOUNCE_VELOCITY + 2] = v.z;
}

LOM_DEPTH_SHADER(lom_bounce_shader, step, .attributes = 2, .varyings = LOM_BOUNCE_FLOATS,
                 .uniforms_size = sizeof(struct lom_bounce_uniforms))
