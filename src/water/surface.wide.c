/* The shaders of water with waves. In: the waves, pictures of the scene on both sides, the sky. Out: the colour of the
 * surface, opaque: what is seen through it is part of it. */
#include "water/surface_radiance.h"

enum { OFFSET = 0, FLAT_VARYINGS = 3, REST_X = 3, REST_Z = 4, VARYINGS = 5 };

static void store3(lom_float *varying, lom_float3 v)
{
    varying[0] = v.x;
    varying[1] = v.y;
    varying[2] = v.z;
}

static void shade(lom_fragment *out, const struct lom_surface_uniforms *u, struct lom_surface_point *p,
                  lom_float rest_x, lom_float rest_z, const struct lom_footprint *f)
{
    p->w = lom_place_reach(&u->eye, p->offset, p->w);
    p->slopes = lom_find_slopes(&u->waves, rest_x, rest_z, f);
    lom_finish_point(u, p);
    LOM_NAME_AS(normal, p->normal);
    lom_float3 color = lom_surface_radiance(u, p, f);
    out->color[0] = (lom_float4){ color.x, color.y, color.z, lom_splat(1.0f) };
}

/* ---- two triangles ---- */

static void flat_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct lom_surface_uniforms *u = uniforms;
    lom_mask right = (in->vertex & 1) != 0, low = (in->vertex & 2) != 0;
    lom_float3 offset = { lom_select(right, lom_splat(u->quad[2]), lom_splat(u->quad[0])), lom_splat(u->waves.level),
                          lom_select(low, lom_splat(u->quad[3]), lom_splat(u->quad[1])) };
    LOM_NAME_VALUE(offset);
    out->position = lom_transform4(&u->clip_from_offset, offset);
    store3(out->varying + OFFSET, offset);
}

static void flat_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct lom_surface_uniforms *u = uniforms;
    struct lom_surface_point p = { .x = in->x, .y = in->y, .w = in->w };
    struct lom_footprint f = { lom_dx(in, OFFSET), lom_dx(in, OFFSET + 2), lom_dy(in, OFFSET), lom_dy(in, OFFSET + 2) };
    p.offset = (lom_float3){ in->varying[OFFSET], in->varying[OFFSET + 1], in->varying[OFFSET + 2] };
    shade(out, u, &p, p.offset.x, p.offset.z, &f);
}

/* ---- a mesh ---- */

static void displaced_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct lom_surface_uniforms *u = uniforms;
    const struct lom_polar_mesh_uniform *m = &u->mesh;
    lom_int ring = in->vertex / m->columns, column = in->vertex - ring * m->columns;
    lom_float nearest = lom_gather(m->nearest, column), farthest = lom_gather(m->farthest, column);
    lom_float radius = lom_max(nearest, lom_min(lom_gather(m->radius, ring), farthest));
    lom_float spacing = lom_gather(m->spacing, ring);
    lom_float x = m->apex[0] + radius * lom_gather(m->cosine, column);
    lom_float z = m->apex[1] + radius * lom_gather(m->sine, column);
    x = lom_clamp(x, lom_splat(u->quad[0]), lom_splat(u->quad[2])); /* by what floats round */
    z = lom_clamp(z, lom_splat(u->quad[1]), lom_splat(u->quad[3]));
    struct lom_footprint f = { spacing, { 0 }, { 0 }, spacing };
    struct lom_wave_shift shift = lom_displace(&u->waves, x, z, &f);
    lom_float3 offset = { x + shift.dx, u->waves.level + shift.h, z + shift.dz };
    LOM_NAME_VALUE(offset);
    out->position = lom_transform4(&u->clip_from_offset, offset);
    store3(out->varying + OFFSET, offset);
    out->varying[REST_X] = x;
    out->varying[REST_Z] = z;
}

/* A triangle that is seen edge on covers more of the waves than its pixel shows, which has other triangles beside it: a
 * footprint is not longer than twice that of the level surface there. */
static void bound_footprint(const struct lom_surface_uniforms *u, lom_float3 offset, struct lom_footprint *f)
{
    lom_float3 path = lom_eye_path(&u->eye, offset);
    lom_float length = lom_sqrt(lom_dot3(path, path)), size = lom_splat(2.0f * u->eye.pixel);
    if (!u->eye.parallel)
        size = size * length;
    lom_float most = size * length / lom_max(lom_abs(path.y), 1e-3f * length);
    lom_float a = most / lom_max(lom_sqrt(f->ax * f->ax + f->az * f->az), most);
    lom_float b = most / lom_max(lom_sqrt(f->bx * f->bx + f->bz * f->bz), most);
    *f = (struct lom_footprint){ f->ax * a, f->az * a, f->bx * b, f->bz * b };
}

static void displaced_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct lom_surface_uniforms *u = uniforms;
    struct lom_surface_point p = { .x = in->x, .y = in->y, .w = in->w };
    struct lom_footprint f = { lom_dx(in, REST_X), lom_dx(in, REST_Z), lom_dy(in, REST_X), lom_dy(in, REST_Z) };
    p.offset = (lom_float3){ in->varying[OFFSET], in->varying[OFFSET + 1], in->varying[OFFSET + 2] };
    bound_footprint(u, p.offset, &f);
    shade(out, u, &p, in->varying[REST_X], in->varying[REST_Z], &f);
}

/* ---- a ray for each pixel ---- */

static void screen_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    (void)uniforms;
    lom_float x = lom_select(in->vertex == 1, lom_splat(3.0f), lom_splat(-1.0f));
    lom_float y = lom_select(in->vertex == 2, lom_splat(3.0f), lom_splat(-1.0f));
    out->position = (lom_float4){ x, y, lom_splat(0.5f), lom_splat(1.0f) };
}

/* The ray through a window position: where it starts, less the eye, and its direction, as long as makes its length
 * along the view axis 1, or its own where rays are parallel. */
struct ray {
    lom_float3 start, direction;
};

static struct ray pixel_ray(const struct lom_surface_uniforms *u, lom_float x, lom_float y)
{
    lom_float a = 2.0f * x * u->pixel[0] - 1.0f, b = 1.0f - 2.0f * y * u->pixel[1];
    lom_float3 v = { a * u->ray[0][0] + b * u->ray[0][1] + u->ray[0][2],
                     a * u->ray[1][0] + b * u->ray[1][1] + u->ray[1][2],
                     a * u->ray[2][0] + b * u->ray[2][1] + u->ray[2][2] };
    if (u->eye.parallel)
        return (struct ray){ v, lom_uniform3(u->eye.along) };
    return (struct ray){ lom_splat3(0, 0, 0), v };
}

LOM_INLINE lom_float3 along_ray(const struct ray *ray, lom_float t)
{
    return lom_add3(ray->start, lom_scale3(ray->direction, t));
}

/* Narrows [from, to] to where start + t direction is in [low, high]; a ray that does not move is in or out for good.
 */
static void cut_range(lom_float start, lom_float direction, float low, float high, lom_float *from, lom_float *to)
{
    lom_mask moves = lom_abs(direction) > 1e-12f;
    lom_float inverse = 1.0f / lom_select(moves, direction, lom_splat(1.0f));
    lom_float a = (low - start) * inverse, b = (high - start) * inverse;
    lom_float nearer = lom_min(a, b), further = lom_max(a, b);
    lom_float never = lom_select((low <= start) & (high >= start), lom_splat(1e30f), lom_splat(-1e30f));
    *from = lom_max(*from, lom_select(moves, nearer, (lom_float){ 0 }));
    *to = lom_min(*to, lom_select(moves, further, never));
}

struct meeting {
    lom_mask found;
    lom_float t, rest_x, rest_z;
};

/* The height of a point over the surface. The rest position under it is found by iteration from the last one's shift,
 * in the lanes of the mask: a lane's result depends on that lane alone. */
static lom_float height_over(const struct lom_surface_uniforms *u, lom_float3 point, lom_float size, lom_mask mask,
                             lom_float2 *shift)
{
    struct lom_footprint f = { size, { 0 }, { 0 }, size };
    struct lom_wave_shift s = { { 0 }, { 0 }, { 0 } };
    for (int i = 0; i < 2; i++) {
        s = lom_displace(&u->waves, point.x - shift->x, point.z - shift->y, &f);
        shift->x = lom_select(mask, s.dx, shift->x);
        shift->y = lom_select(mask, s.dz, shift->y);
    }
    return point.y - (u->waves.level + s.h);
}

/* Steps along the ray as far as the surface cannot rise to meet it, were it nowhere steeper than 1; at least half a
 * pixel's size there, over its slope. Then halves the last step. */
static struct meeting meet_surface(const struct lom_surface_uniforms *u, const struct ray *ray)
{
    const lom_float3 d = ray->direction;
    lom_float from = lom_depth_reach(&u->eye, lom_splat(1.0f)), to = lom_splat(1e30f);
    const float level = u->waves.level, low = level + u->waves.lowest, high = level + u->waves.highest;
    const float margin = 1e-3f * (u->waves.highest - u->waves.lowest) + 1e-5f * (level < 0 ? -level : level);
    cut_range(ray->start.y, d.y, low - margin, high + margin, &from, &to);
    cut_range(ray->start.x, d.x, u->quad[0], u->quad[2], &from, &to);
    cut_range(ray->start.z, d.z, u->quad[1], u->quad[3], &from, &to);
    struct meeting m = { { 0 }, from, { 0 }, { 0 } };
    lom_mask going = from < to;
    lom_float before = from, flat = lom_sqrt(d.x * d.x + d.z * d.z);
    lom_float2 shift = { { 0 }, { 0 } };
    for (int i = 0; i < u->surface_steps && lom_any(going); i++) {
        lom_float size = lom_pixel_size(&u->eye, m.t);
        lom_float gap = u->side * height_over(u, along_ray(ray, m.t), size, going, &shift);
        lom_mask behind = going & (gap < 0.0f);
        m.found = m.found | behind;
        going = going & ~behind;
        lom_float step = lom_max(lom_abs(gap) / (lom_abs(d.y) + flat), size * 2.0f);
        before = lom_select(going, m.t, before);
        m.t = lom_select(going, lom_min(m.t + step, to), m.t);
        going = going & (before < to);
    }
    m.found = m.found | going; /* a ray along the surface: it is there within what its steps can tell */
    lom_float near = before, far = m.t;
    for (int i = 0; i < 5; i++) {
        lom_float middle = 0.5f * (near + far);
        lom_float size = lom_pixel_size(&u->eye, middle);
        lom_float gap = u->side * height_over(u, along_ray(ray, middle), size, m.found, &shift);
        far = lom_select(gap < 0.0f, middle, far);
        near = lom_select(gap < 0.0f, near, middle);
    }
    m.t = far;
    lom_float3 point = along_ray(ray, m.t);
    height_over(u, point, lom_pixel_size(&u->eye, m.t), m.found, &shift);
    m.rest_x = point.x - shift.x;
    m.rest_z = point.z - shift.y;
    return m;
}

/* Where the neighbour's ray meets the level of a point, less the point: what a pixel covers of the surface. Rays that
 * do not come down stay within 16 pixels' sizes. */
static void neighbour(const struct lom_surface_uniforms *u, lom_float3 point, lom_float t, struct ray ray, lom_float *x,
                      lom_float *z)
{
    const lom_float3 d = ray.direction;
    lom_float fall = point.y - ray.start.y, most = lom_pixel_size(&u->eye, t * 16.0f);
    lom_mask meets = fall * d.y > 0.0f;
    if (u->eye.parallel)
        most = most * 16.0f;
    lom_float at = lom_select(meets, fall / lom_select(meets, d.y, lom_splat(1.0f)), t + most);
    lom_float3 there = along_ray(&ray, at);
    *x = lom_clamp(there.x - point.x, -most, most);
    *z = lom_clamp(there.z - point.z, -most, most);
}

static void marched_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct lom_surface_uniforms *u = uniforms;
    const struct ray ray = pixel_ray(u, in->x, in->y);
    struct meeting m = meet_surface(u, &ray);
    out->discard = ~m.found;
    out->depth = lom_reach_depth(&u->eye, m.t);
    struct lom_surface_point p = { .x = in->x, .y = in->y, .w = m.t };
    p.offset = along_ray(&ray, m.t);
    struct lom_footprint f;
    neighbour(u, p.offset, m.t, pixel_ray(u, in->x + 1.0f, in->y), &f.ax, &f.az);
    neighbour(u, p.offset, m.t, pixel_ray(u, in->x, in->y + 1.0f), &f.bx, &f.bz);
    shade(out, u, &p, m.rest_x, m.rest_z, &f);
}

/* ---- where it may be ---- */

static void bounds_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct lom_surface_uniforms *u = uniforms;
    lom_float3 offset = { in->attribute[0].x, in->attribute[0].y, in->attribute[0].z };
    out->position = lom_transform4(&u->clip_from_offset, offset);
}

static void bounds_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)in;
    (void)uniforms;
    out->color[0] = (lom_float4){ lom_splat(1.0f), lom_splat(1.0f), lom_splat(1.0f), lom_splat(1.0f) };
}

LOM_SHADER(lom_surface_flat_shader, flat_vertex, flat_fragment, .varyings = FLAT_VARYINGS,
           .reads = LOM_VARYINGS(OFFSET, 3), .differentiates = 1u << OFFSET | 1u << (OFFSET + 2),
           .reads_position = true, .colors = 1, .uniforms_size = sizeof(struct lom_surface_uniforms))
LOM_SHADER(lom_surface_displaced_shader, displaced_vertex, displaced_fragment, .varyings = VARYINGS,
           .reads = LOM_VARYINGS(0, VARYINGS), .differentiates = 1u << REST_X | 1u << REST_Z, .reads_position = true,
           .colors = 1, .uniforms_size = sizeof(struct lom_surface_uniforms))
LOM_SHADER(lom_surface_marched_shader, screen_vertex, marched_fragment, .reads_position = true, .discards = true,
           .writes_depth = true, .colors = 1, .uniforms_size = sizeof(struct lom_surface_uniforms))
LOM_SHADER(lom_surface_bounds_shader, bounds_vertex, bounds_fragment, .attributes = 1, .colors = 1,
           .uniforms_size = sizeof(struct lom_surface_uniforms))
