/* Boulders and stones. In: sizes and a seed; out: closed meshes with the rock's texture laid on from the side that each
 * triangle faces. */
#include "geometry/builder.h"
#include "geometry/model.h"

/* ---- an icosahedron, subdivided ---- */

typedef struct sphere {
    lom_vec3 *points; /* of unit length; three in a row are a triangle */
    size_t count;
} sphere;

static const double icosahedron[12][3] = { { -1, 0, 1.618033988749895 },  { 1, 0, 1.618033988749895 },
                                           { -1, 0, -1.618033988749895 }, { 1, 0, -1.618033988749895 },
                                           { 0, 1.618033988749895, 1 },   { 0, 1.618033988749895, -1 },
                                           { 0, -1.618033988749895, 1 },  { 0, -1.618033988749895, -1 },
                                           { 1.618033988749895, 1, 0 },   { -1.618033988749895, 1, 0 },
                                           { 1.618033988749895, -1, 0 },  { -1.618033988749895, -1, 0 } };
static const uint8_t faces[20][3] = { { 0, 1, 4 },  { 0, 4, 9 },  { 9, 4, 5 },  { 4, 8, 5 },  { 4, 1, 8 },
                                      { 8, 1, 10 }, { 8, 10, 3 }, { 5, 8, 3 },  { 5, 3, 2 },  { 2, 3, 7 },
                                      { 7, 3, 10 }, { 7, 10, 6 }, { 7, 6, 11 }, { 11, 6, 0 }, { 0, 6, 1 },
                                      { 6, 10, 1 }, { 9, 11, 0 }, { 9, 2, 11 }, { 9, 5, 2 },  { 7, 11, 2 } };

static lom_vec3 middle(lom_vec3 a, lom_vec3 b)
{
    return lom_vec3_normalize(lom_vec3_add(a, b)); /* a + b = b + a: neighbours agree bit for bit */
}

static sphere make_sphere(int detail, lom_error *error)
{
    sphere s = { .count = 60 };
    for (int i = 0; i < detail; i++)
        s.count *= 4;
    s.points = lom_allocate(s.count, sizeof *s.points, error);
    if (s.points == NULL)
        return s;
    for (int i = 0; i < 20; i++)
        for (int k = 0; k < 3; k++) {
            const double *p = icosahedron[faces[i][k]];
            s.points[3 * i + k] = lom_vec3_normalize((lom_vec3){ p[0], p[1], p[2] });
        }
    for (size_t count = 60; count < s.count; count *= 4)
        for (size_t i = count; i > 0; i -= 3) { /* from the end, so that the four new ones overwrite nothing unread */
            lom_vec3 a = s.points[i - 3], b = s.points[i - 2], c = s.points[i - 1];
            lom_vec3 ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            const lom_vec3 four[12] = { a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca };
            for (size_t k = 0; k < 12; k++)
                s.points[4 * (i - 3) + k] = four[k];
        }
    return s;
}

/* ---- stones ---- */

enum { CUTS = 9 };

typedef struct shape {
    lom_noise noise;
    lom_vec3 cut[CUTS];
    double depth[CUTS];
} shape;

static shape shape_of(uint64_t seed)
{
    shape s;
    lom_seed_noise(&s.noise, seed);
    for (uint64_t i = 0; i < CUTS; i++) {
        lom_vec3 n = { lom_model_random(seed, 4 * i, -1, 1), lom_model_random(seed, 4 * i + 1, -0.6, 1),
                       lom_model_random(seed, 4 * i + 2, -1, 1) };
        s.cut[i] = lom_vec3_normalize(n);
        s.depth[i] = lom_model_random(seed, 4 * i + 3, 0.52, 0.86);
    }
    return s;
}

/* The stone's surface in direction d: the nearest plane or the sphere, worn smooth where they meet, and rough. */
static lom_vec3 point_towards(const shape *s, lom_vec3 d)
{
    double radius = 1;
    for (int i = 0; i < CUTS; i++) {
        double facing = lom_vec3_dot(d, s->cut[i]);
        double reach = facing > 0.2 ? s->depth[i] / facing : 9;
        double overlap = lom_clamp_double(1 - (reach > radius ? reach - radius : radius - reach) / 0.08, 0, 1);
        radius = (reach < radius ? reach : radius) - overlap * overlap * 0.02;
    }
    lom_octaves octaves = { .count = 4, .period = 256, .gain = 0.5 };
    double rough = lom_fractal3(&s->noise, d.x * 2.2 + 20, d.y * 2.2 + 20, d.z * 2.2 + 20, octaves);
    return lom_vec3_scale(d, radius * (1 + 0.14 * rough));
}

void lom_model_stone_at(lom_mesh_builder *builder, const lom_model_stone *stone)
{
    if (builder == NULL)
        return;
    sphere s = make_sphere(stone->detail, &builder->error);
    if (s.points == NULL)
        return;
    shape form = shape_of(stone->seed);
    for (size_t i = 0; i < s.count; i += 3) {
        lom_vec3 p[3];
        for (int k = 0; k < 3; k++) {
            p[k] = point_towards(&form, s.points[i + (size_t)k]);
            p[k] = (lom_vec3){ p[k].x * stone->radii.x, p[k].y * stone->radii.y, p[k].z * stone->radii.z };
            p[k] = lom_vec3_add(p[k], stone->center);
        }
        lom_vec3 n = lom_vec3_cross(lom_vec3_subtract(p[1], p[0]), lom_vec3_subtract(p[2], p[0]));
        double x = n.x * n.x, y = n.y * n.y, z = n.z * n.z;
        const double metres = 3.0;
        uint32_t vertex[3];
        for (int k = 0; k < 3; k++) {
            double u = y >= x && y >= z ? p[k].x : x >= z ? p[k].z : p[k].x;
            double v = y >= x && y >= z ? p[k].z : p[k].y;
            vertex[k] = lom_builder_vertex(builder, p[k], u / metres, v / metres);
        }
        lom_builder_triangle(builder, vertex[0], vertex[1], vertex[2]);
    }
    lom_release(s.points);
}

void lom_build_boulder(lom_mesh_builder *builder, uint64_t seed)
{
    lom_model_material(builder, "stone", 0.04, 12);
    lom_model_stone stone = { { 0, 0.35, 0 }, { 1.35, 0.95, 1.1 }, seed, 3 };
    lom_model_stone_at(builder, &stone);
}

void lom_build_stones(lom_mesh_builder *builder, uint64_t seed)
{
    lom_model_material(builder, "stone", 0.04, 12);
    for (uint64_t i = 0; i < 11; i++) {
        double size = i < 2 ? lom_model_random(seed, 5 * i, 0.45, 0.7) : lom_model_random(seed, 5 * i, 0.12, 0.34);
        double distance = lom_model_random(seed, 5 * i + 1, 0.2, 1.9), angle = 2.4 * (double)i;
        lom_model_stone stone = {
            .center = { distance * lom_double_cos(angle), 0.25 * size, distance * lom_double_sin(angle) },
            .radii = { size * lom_model_random(seed, 5 * i + 2, 0.9, 1.4),
                       size * lom_model_random(seed, 5 * i + 3, 0.6, 0.9), size },
            .seed = seed + 100 + i,
            .detail = i < 2 ? 2 : 1,
        };
        lom_model_stone_at(builder, &stone);
    }
}
