/* The filter of lom_smooth_edges. In: a picture of one sample a pixel, the depths of it, and where the triangles that it
 * shows end (lom/pipeline.h, "edges"). Out: each pixel with the light of its four neighbours by the part of it that lies
 * beyond an edge.
 *
 * Two neighbours are told apart where their depths are: of the two the nearer one's triangle ends between their centres,
 * since the other one is seen behind it. Along the row or column the end is d pixels from the nearer centre, across it o, so
 * that the edge is the line x + r y = d with r = d / o, x towards the other pixel. For 0 <= r <= 1 the part of a pixel
 * beyond the line, d from its centre, is
 *
 *   1/2 - d                        for d <= (1 - r) / 2, where the line leaves it through two opposite sides,
 *   ((1 + r) / 2 - d)^2 / (2 r)    up to (1 + r) / 2, where it cuts a corner off,
 *   0                              from there on
 *
 * (the areas of a trapezium and of a triangle). Of the nearer pixel it shows the other one's light; of the farther one, from
 * whose centre the line is 1 - d away, the nearer one's. With r > 1 (of columns, r >= 1) the edge is the
 * other axis' own, where that has one.
 *
 * Invariant: a pixel beside which no depth jumps is the picture's, bit for bit. */
#include "image/sample_lanes.h"
#include "shading/smooth_edges.h"
#include "shading/window_texels.h"

#include <lom/lanes_components.h>
#include <lom/notes.h>

enum { NEIGHBOURS = 4, LOOKS = 2, FAR = 1024 }; /* to the right, left, down, up; what ends farther away does not end */

/* An end between two centres, by its distance from the one: as rounded as the texture has it. */
static const float between = 1 + 1.0f / 64;

static const int across[NEIGHBOURS] = { 1, -1, 0, 0 }, down[NEIGHBOURS] = { 0, 0, 1, -1 };

static void vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    (void)uniforms;
    lom_float s = lom_to_float(in->vertex & 1), t = lom_to_float(in->vertex >> 1);
    out->position = (lom_float4){ 2.0f * s - 1.0f, 1.0f - 2.0f * t, { 0 }, lom_splat(1.0f) };
}

/* The part of a pixel beyond the line, as above; d >= 0, 0 <= r <= 1. */
LOM_INLINE lom_float part_beyond(lom_float d, lom_float r)
{
    const lom_float zero = { 0 }, corner = lom_max((1.0f + r) * 0.5f - d, zero);
    return lom_select(d <= (1.0f - r) * 0.5f, 0.5f - d, corner * corner / (2.0f * lom_max(r, lom_splat(1.0f / FAR))));
}

/* Pixels from the centre, from the number that the texture has. */
LOM_INLINE lom_float distance_of(lom_float code)
{
    return code / lom_max(1.0f - code, lom_splat(1.0f / FAR));
}

/* What is around a pixel. */
struct place {
    lom_int x, y;
    bool window; /* these are pixels of a window, and so are those two pixels around them */
    lom_float depth, beside[NEIGHBOURS];
    lom_mask ends[NEIGHBOURS]; /* the depth jumps there */
};

/* Texels beside those of the place: of a window its own loads, to the same bytes. */
LOM_INLINE lom_float depth_beside(const lom_texture *depth, const struct place *p, int dx, int dy)
{
    if (p->window && depth->storage == LOM_STORAGE_R32F)
        return lom_as_float(lom_window_words(depth, p->x[0] + dx, p->y[0] + dy)) + 0.0f;
    return lom_fetch(depth, p->x + dx, p->y + dy, 0).x;
}

LOM_INLINE lom_float4 color_beside(const lom_texture *color, const struct place *p, int dx, int dy)
{
    if (p->window && color->storage == LOM_STORAGE_RGBA8) {
        const lom_int words = lom_window_words(color, p->x[0] + dx, p->y[0] + dy);
        return color->srgb ? sample_finish(LOM_STORAGE_RGBA8, true, sample_unpack(true, words))
                           : sample_finish(LOM_STORAGE_RGBA8, false, sample_unpack(false, words));
    }
    return lom_fetch(color, p->x + dx, p->y + dy, 0);
}

/* Depth at a place that may lie outside of the picture: there, as far from `near` as that is from `far`, behind it. */
LOM_INLINE lom_float depth_beyond(const lom_texture *depth, const struct place *p, int dx, int dy, lom_float near,
                                  lom_float far)
{
    if (p->window)
        return depth_beside(depth, p, dx, dy);
    const lom_int x = p->x + dx, y = p->y + dy;
    const lom_mask inside = (x >= 0) & (y >= 0) & (x < lom_texture_width(depth)) & (y < lom_texture_height(depth));
    return lom_select(inside, lom_fetch(depth, x, y, 0).x, near + (near - far));
}

/* Whether the depths of neighbours belong to different surfaces: they differ by more than a part of the nearer one, and
 * by more than what lies on either side of them would let expect. */
LOM_INLINE lom_mask is_gap(lom_float depth, lom_float next)
{
    return lom_abs(depth - next) > lom_max(depth, next) * LOM_EDGE_GAP;
}

LOM_INLINE lom_mask is_steep(lom_float depth, lom_float next, lom_float before, lom_float after)
{
    const lom_float slope = lom_min(lom_abs(depth - before), lom_abs(after - next));
    return lom_abs(depth - next) > LOM_EDGE_SLOPES * slope;
}

/* False: no depth jumps. */
static bool look_around(const struct lom_smooth_uniforms *u, struct place *p)
{
    lom_mask ends = { 0 };
    p->depth = depth_beside(u->depth, p, 0, 0);
    for (int i = 0; i < NEIGHBOURS; i++) {
        p->beside[i] = depth_beside(u->depth, p, across[i], down[i]);
        p->ends[i] = is_gap(p->depth, p->beside[i]);
        ends |= p->ends[i];
    }
    if (!lom_any(ends))
        return false;
    ends = (lom_mask){ 0 };
    for (int i = 0; i < NEIGHBOURS; i++) {
        const lom_float before = depth_beyond(u->depth, p, -across[i], -down[i], p->depth, p->beside[i]);
        const lom_float after = depth_beyond(u->depth, p, 2 * across[i], 2 * down[i], p->beside[i], p->depth);
        p->ends[i] &= is_steep(p->depth, p->beside[i], before, after);
        ends |= p->ends[i];
    }
    return lom_any(ends);
}

/* Distances to the right, left, down, up of what a pixel beside shows. */
static void find_reach(const lom_texture *edges, const struct place *p, int dx, int dy, lom_float reach[NEIGHBOURS])
{
    const lom_float4 code = color_beside(edges, p, dx, dy);
    reach[0] = distance_of(code.x);
    reach[1] = distance_of(code.y);
    reach[2] = distance_of(code.z);
    reach[3] = distance_of(code.w);
}

/* Where the surface ends whose triangle ends d pixels ahead of a centre and `back` pixels behind it. A triangle that is
 * longer than a pixel is taken for the last one; of one that is shorter, others of its surface may follow, whose centres
 * were missed: the shorter it is, the nearer to the middle of all places that are left. So what is thinner than a pixel
 * keeps its light on average. */
LOM_INLINE lom_float end_of_surface(lom_float d, lom_float back)
{
    const lom_float zero = { 0 };
    return d + lom_max(1.0f - d - back, zero) * lom_max(1.0f - d, zero) * 0.5f;
}

/* The part that has the light of neighbour i. */
static lom_float part_of(const struct lom_smooth_uniforms *u, const struct place *p, const lom_float own[NEIGHBOURS],
                         int i)
{
    const lom_float zero = { 0 };
    if (!lom_any(p->ends[i]))
        return zero;
    const lom_mask is_nearer = p->depth > p->beside[i];
    const int side = (i ^ 2) & 2; /* the first of the two directions across */
    lom_float other[NEIGHBOURS];
    find_reach(u->edges, p, across[i], down[i], other);
    const lom_float d = lom_select(is_nearer, own[i], other[i ^ 1]), back = lom_select(is_nearer, own[i ^ 1], other[i]);
    const lom_float o = lom_select(is_nearer, lom_min(own[side], own[side + 1]), lom_min(other[side], other[side + 1]));
    const lom_float end = end_of_surface(d, back);
    const lom_float from = lom_select(is_nearer, end, lom_max(1.0f - end, zero));
    const lom_mask steep = side == 0 ? d >= o : d > o, taken = steep & (p->ends[side] | p->ends[side + 1]);
    const lom_float r = lom_select(steep, zero, d / lom_max(o, lom_splat(1.0f / FAR)));
    return lom_select(p->ends[i] & ~taken & (d <= between), part_beyond(from, r), zero);
}

static void fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct lom_smooth_uniforms *u = uniforms;
    struct place p;
    p.x = lom_to_int(in->x - u->origin[0]);
    p.y = lom_to_int(in->y - u->origin[1]);
    p.window = lom_is_window(u->depth, p.x, p.y, LOOKS);
    lom_float4 color = color_beside(u->color, &p, 0, 0);
    out->color[0] = color;
    if (!look_around(u, &p))
        return;
    lom_float own[NEIGHBOURS], part[NEIGHBOURS], sum = { 0 };
    const lom_mask ends = p.ends[0] | p.ends[1] | p.ends[2] | p.ends[3];
    find_reach(u->edges, &p, 0, 0, own);
    for (int i = 0; i < NEIGHBOURS; i++) {
        part[i] = part_of(u, &p, own, i);
        sum += part[i];
    }
    const lom_float scale = 1.0f / lom_max(sum, lom_splat(1.0f));
    const lom_float4 beyond_edges = { part[0] * scale, part[1] * scale, part[2] * scale, part[3] * scale };
    LOM_NAME_VALUE(beyond_edges);
    lom_float4 mixed = lom_scale4(color, 1.0f - sum * scale);
    for (int i = 0; i < NEIGHBOURS; i++) {
        const lom_float4 beyond = color_beside(u->color, &p, across[i], down[i]);
        mixed = lom_add4(mixed, lom_scale4(beyond, part[i] * scale));
    }
    /* none of a neighbour that is infinite would be no number */
    out->color[0] = (lom_float4){ lom_select(ends, mixed.x, color.x), lom_select(ends, mixed.y, color.y),
                                  lom_select(ends, mixed.z, color.z), lom_select(ends, mixed.w, color.w) };
}

LOM_SHADER(lom_smooth_shader, vertex, fragment, .reads_position = true, .colors = 1,
           .uniforms_size = sizeof(struct lom_smooth_uniforms))
