/* A surface with waves in double. In: the sea, or the wave vectors, amplitudes and phases that the water stands for,
 * surf and shallow water. Out: its surface as triangles for rays, and exact normals between their corners. A point at rest at (x, z) is
 * displaced by (-b k/|k| sin t, a cos t) summed over the waves, t = k.(x, z) + phase (A. Fournier, W. Reeves, SIGGRAPH
 * 1986). */
#include "base/numbers.h"
#include "reference/wave_surface.h"

#include "waves/wave_lanes.h"

static const double SPACING = 0.006;

static struct lom_wave_place displace(const struct lom_wave_surface *surface, double x, double z)
{
    struct lom_wave_place p = { .dx = 0 };
    const double from_x = x - surface->middle[0], from_z = z - surface->middle[1];
    for (int i = 0; i < surface->count; i++) {
        const struct lom_ray_wave *w = &surface->wave[i];
        double t = w->kx * from_x + w->kz * from_z + w->phase, s = lom_double_sin(t), c = lom_double_cos(t);
        p.dx -= w->across_x * s;
        p.dy += w->amplitude * c;
        p.dz -= w->across_z * s;
        p.sx -= w->amplitude * w->kx * s;
        p.sz -= w->amplitude * w->kz * s;
        p.xx -= w->across_x * w->kx * c;
        p.xz -= w->across_x * w->kz * c;
        p.zz -= w->across_z * w->kz * c;
    }
    lom_add_sea(&p, surface, from_x, from_z);
    lom_add_shore(&p, surface, x, z);
    return p;
}

double lom_wave_surface_height(const struct lom_wave_surface *surface, double x, double z)
{
    struct lom_wave_place p = { .dx = 0 };
    for (int i = 0; i < 40; i++)
        p = displace(surface, x - p.dx, z - p.dz);
    return surface->level + p.dy;
}

/* The cross product of the tangents (xz, sz, 1 + zz) and (1 + xx, sx, xz). */
static lom_vec3 normal_of(const struct lom_wave_place *p)
{
    double a = 1 + p->xx, b = 1 + p->zz;
    lom_vec3 n = { p->xz * p->sz - p->sx * b, a * b - p->xz * p->xz, p->xz * p->sx - p->sz * a };
    return n.y > 0 || (p->overturns && dot(n, n) > 1e-12) ? unit(n) : (lom_vec3){ 0, 1, 0 };
}

/* ---- making ---- */

/* What waves a scene has is its data; the water layer derives it from [water.waves]. */
static bool find_waves(struct lom_wave_surface *surface, const lom_reference *reference, double time, double *shortest,
                       lom_error *error)
{
    const lom_water_params *water = &reference->scene->water;
    struct lom_waves_uniform waves = { .trochoid_count = 0 };
    double greatest = 0;
    lom_fill_trochoids(&waves, &water->waves, &water->foam, (double[2]){ 0, 0 }, time);
    surface->level = water->level;
    surface->count = waves.trochoid_count;
    for (int i = 0; i < surface->count; i++) {
        const struct lom_trochoid_uniform *t = &waves.trochoid[i];
        double number = lom_double_sqrt((double)t->kx * t->kx + (double)t->kz * t->kz);
        surface->wave[i] = (struct lom_ray_wave){ t->kx, t->kz, t->phase, t->amplitude, t->across_x, t->across_z };
        greatest = lom_larger(number, greatest);
    }
    *shortest = greatest > 0 ? lom_two_pi / greatest : 0;
    return (surface->count > 0 || lom_make_ray_sea(surface, water, time, shortest, error)) &&
           lom_make_ray_shore(surface, reference, time, shortest, error);
}

struct mesh {
    int columns, rings;
    double fine; /* metres between the first rings */
    double low[2], high[2], middle[2];
};

static double next_radius(double fine, double radius)
{
    return radius + lom_larger(fine, radius * SPACING);
}

static struct mesh plan_mesh(const lom_reference_water *water, lom_vec3 eye, double shortest)
{
    struct mesh mesh = { .columns = lom_int_of(lom_two_pi / SPACING),
                         .fine = shortest / 12,
                         .middle = { eye.x, eye.z } };
    double far = 0;
    for (int i = 0; i < 2; i++) {
        mesh.low[i] = water->low[i];
        mesh.high[i] = water->high[i];
        double a = mesh.middle[i] - mesh.low[i], b = mesh.high[i] - mesh.middle[i];
        double away = lom_larger(__builtin_fabs(a), __builtin_fabs(b));
        far += away * away;
    }
    mesh.fine = lom_larger(mesh.fine, 1e-6 * lom_double_sqrt(far));
    for (double radius = mesh.fine / 4; radius < lom_double_sqrt(far); radius = next_radius(mesh.fine, radius))
        mesh.rings++;
    mesh.rings += 2;
    return mesh;
}

static void place_points(struct lom_wave_surface *surface, const struct mesh *mesh)
{
    double radius = mesh->fine / 4;
    for (int ring = 0; ring < mesh->rings; ring++, radius = next_radius(mesh->fine, radius))
        for (int column = 0; column < mesh->columns; column++) {
            size_t i = (size_t)ring * (size_t)mesh->columns + (size_t)column;
            double angle = lom_two_pi * column / mesh->columns;
            double x = mesh->middle[0] + radius * lom_double_cos(angle);
            double z = mesh->middle[1] + radius * lom_double_sin(angle);
            x = lom_smaller(lom_larger(x, mesh->low[0]), mesh->high[0]);
            z = lom_smaller(lom_larger(z, mesh->low[1]), mesh->high[1]);
            struct lom_wave_place p = displace(surface, x, z);
            surface->rest[i][0] = x;
            surface->rest[i][1] = z;
            surface->points[i] = (lom_vec3){ x + p.dx, surface->level + p.dy, z + p.dz };
        }
}

/* Points moved into the quad lie on its border: three on one side of it make no surface, only a curtain of folds. */
static void add_triangle(struct lom_wave_surface *surface, uint32_t a, uint32_t b, uint32_t c)
{
    const double *p = surface->rest[a], *q = surface->rest[b], *r = surface->rest[c];
    if ((q[0] - p[0]) * (r[1] - p[1]) != (q[1] - p[1]) * (r[0] - p[0]))
        surface->triangles[surface->above.count++] = (struct lom_ray_triangle){ .corner = { a, b, c } };
}

/* Angles run from +x towards +z, clockwise seen from above; the hole inside the first ring is filled by a fan. */
static void join_points(struct lom_wave_surface *surface, const struct mesh *mesh)
{
    uint32_t columns = (uint32_t)mesh->columns;
    for (uint32_t ring = 0; ring + 1 < (uint32_t)mesh->rings; ring++)
        for (uint32_t i = 0; i < columns; i++) {
            uint32_t j = (i + 1) % columns, a = ring * columns + i, b = ring * columns + j;
            add_triangle(surface, a, b, b + columns);
            add_triangle(surface, a, b + columns, a + columns);
        }
    for (uint32_t i = 1; i + 1 < columns; i++)
        add_triangle(surface, 0, i + 1, i);
}

bool lom_make_wave_surface(struct lom_wave_surface *surface, const lom_reference *reference, lom_vec3 eye, double time,
                           lom_error *error)
{
    *surface = (struct lom_wave_surface){ .count = 0 };
    if (reference->water.low[0] > reference->water.high[0] || reference->water.height != NULL)
        return true;
    double shortest;
    if (!find_waves(surface, reference, time, &shortest, error))
        return false;
    if (shortest == 0)
        return true;
    struct mesh mesh = plan_mesh(&reference->water, eye, shortest);
    size_t points = (size_t)mesh.rings * (size_t)mesh.columns;
    surface->points = lom_allocate(points, sizeof *surface->points, error);
    surface->rest = lom_allocate(points, sizeof *surface->rest, error);
    surface->triangles = lom_allocate(2 * points, sizeof *surface->triangles, error);
    if (surface->points == NULL || surface->rest == NULL || surface->triangles == NULL)
        return false;
    place_points(surface, &mesh);
    surface->fine = mesh.fine;
    surface->eye[0] = mesh.middle[0];
    surface->eye[1] = mesh.middle[1];
    surface->above = (struct lom_ray_triangles){ .points = surface->points, .triangles = surface->triangles };
    join_points(surface, &mesh);
    if (!lom_build_ray_triangles(&surface->above, error))
        return false;
    surface->below = surface->above;
    surface->below.inside_out = true;
    return true;
}

void lom_free_wave_surface(struct lom_wave_surface *surface)
{
    lom_free_sea(surface->sea);
    lom_free_ray_shore(surface);
    lom_free_ray_triangles(&surface->above);
    lom_release(surface->points);
    lom_release(surface->rest);
    lom_release(surface->triangles);
}

/* ---- meeting it ---- */

bool lom_hit_wave_surface(const struct lom_wave_surface *surface, const struct lom_ray *ray, bool from_below,
                          double low, double high, struct lom_crossing *c)
{
    struct lom_ray_hit hit = { .t = high };
    if (!lom_hit_triangles(from_below ? &surface->below : &surface->above, ray, low, &hit))
        return false;
    const uint32_t *corner = surface->triangles[hit.triangle].corner;
    lom_vec3 p[3];
    c->rest[0] = c->rest[1] = 0;
    for (int i = 0; i < 3; i++) {
        p[i] = surface->points[corner[i]];
        c->rest[0] += surface->rest[corner[i]][0] * hit.weight[i];
        c->rest[1] += surface->rest[corner[i]][1] * hit.weight[i];
    }
    c->t = hit.t;
    c->place = blended(p[0], p[1], p[2], hit.weight);
    c->facet = unit(cross(difference(p[1], p[0]), difference(p[2], p[0])));
    return true;
}

lom_vec3 lom_wave_surface_normal(const struct lom_wave_surface *surface, const double rest[2], double part)
{
    const lom_vec3 out = { rest[0] - surface->eye[0], 0, rest[1] - surface->eye[1] };
    const double radius = length(out), cell = next_radius(surface->fine, radius) - radius;
    const lom_vec3 moved = scaled(unit(out), part * cell);
    const struct lom_wave_place at = displace(surface, rest[0] + moved.x, rest[1] + moved.z);
    return normal_of(&at);
}
