/* Pieces of which things are built. In: sizes and a texture's place; out: triangles in a mesh builder. Invariant: every
 * piece is closed, or has both its sides. */
#include "base/numbers.h"
#include "geometry/model.h"

#include <assert.h>
#include <string.h>

void lom_model_material(lom_mesh_builder *builder, const char *name, double specular, double shininess)
{
    lom_material material = { .ambient = { 1, 1, 1 }, .diffuse = { 1, 1, 1 }, .opacity = 1, .bump = 1 };
    size_t length = strlen(name);
    assert(length + 5 <= sizeof material.name);
    memcpy(material.name, name, length);
    memcpy(material.diffuse_map, name, length);
    memcpy(material.diffuse_map + length, ".png", 4);
    for (int k = 0; k < 3; k++)
        material.specular[k] = (float)specular;
    material.shininess = (float)shininess;
    lom_builder_material(builder, &material);
}

double lom_model_random(uint64_t seed, uint64_t index, double low, double high)
{
    return low + (high - low) * lom_random_uniform(seed, index);
}

/* ---- boxes ---- */

static double axis_of(lom_vec3 v, int axis)
{
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

static lom_vec3 vector_of(const double v[3])
{
    return (lom_vec3){ v[0], v[1], v[2] };
}

/* The face where `axis` is at `end` (0 low, 1 high); v runs along `along` unless the face is across it. */
static void box_face(lom_mesh_builder *builder, const double corner[2][3], int axis, int end, int along,
                     lom_model_map map)
{
    int v_axis = axis == along ? (axis + 1) % 3 : along;
    int u_axis = 3 - axis - v_axis;
    uint32_t vertex[4];
    for (int i = 0; i < 4; i++) {
        int a = i == 1 || i == 2, b = i >= 2;
        double p[3];
        p[axis] = corner[end][axis];
        p[u_axis] = corner[a][u_axis];
        p[v_axis] = corner[b][v_axis];
        double v = map.v + (corner[b][v_axis] - corner[0][v_axis]) / map.metres;
        vertex[i] = lom_builder_vertex(builder, vector_of(p), a ? map.u1 : map.u0, v);
    }
    bool right_handed = (axis + 1) % 3 == u_axis;
    if (right_handed == (end == 1))
        lom_builder_quad(builder, vertex[0], vertex[1], vertex[2], vertex[3]);
    else
        lom_builder_quad(builder, vertex[3], vertex[2], vertex[1], vertex[0]);
}

void lom_model_box(lom_mesh_builder *builder, lom_vec3 low, lom_vec3 high, lom_model_map map)
{
    double corner[2][3];
    int along = 0;
    for (int axis = 0; axis < 3; axis++) {
        corner[0][axis] = axis_of(low, axis);
        corner[1][axis] = axis_of(high, axis);
        if (corner[1][axis] - corner[0][axis] > corner[1][along] - corner[0][along])
            along = axis;
    }
    for (int axis = 0; axis < 3; axis++)
        for (int end = 0; end < 2; end++)
            box_face(builder, corner, axis, end, along, map);
}

/* ---- tubes ---- */

/* Two unit vectors across `along`. */
static void frame_across(lom_vec3 along, lom_vec3 *first, lom_vec3 *second)
{
    lom_vec3 guide = along.y * along.y < 0.8 ? (lom_vec3){ 0, 1, 0 } : (lom_vec3){ 1, 0, 0 };
    *first = lom_vec3_normalize(lom_vec3_cross(guide, along));
    *second = lom_vec3_cross(along, *first);
}

static void ring_vertices(lom_mesh_builder *builder, const lom_model_ring *ring, lom_vec3 along, int slices, double v,
                          lom_model_map map, uint32_t *vertices)
{
    lom_vec3 x, y;
    frame_across(along, &x, &y);
    for (int i = 0; i <= slices; i++) {
        double angle = i == slices ? 0 : lom_two_pi * i / slices;
        double c = ring->radius * lom_double_cos(angle), s = ring->radius * lom_double_sin(angle);
        lom_vec3 p = lom_vec3_add(ring->center, lom_vec3_add(lom_vec3_scale(x, c), lom_vec3_scale(y, s)));
        vertices[i] = lom_builder_vertex(builder, p, lom_mix_double(map.u0, map.u1, (double)i / slices), v);
    }
}

static void cap(lom_mesh_builder *builder, const lom_model_ring *ring, const uint32_t *vertices, int slices, bool top,
                lom_model_map map)
{
    if (ring->radius <= 0)
        return;
    uint32_t middle = lom_builder_vertex(builder, ring->center, 0.5 * (map.u0 + map.u1), map.v);
    for (int i = 0; i < slices; i++)
        if (top)
            lom_builder_triangle(builder, middle, vertices[i], vertices[i + 1]);
        else
            lom_builder_triangle(builder, middle, vertices[i + 1], vertices[i]);
}

enum { MAX_SLICES = 32 };

void lom_model_tube(lom_mesh_builder *builder, const lom_model_ring *rings, int count, int slices, lom_model_map map)
{
    uint32_t last[MAX_SLICES + 1], next[MAX_SLICES + 1];
    double v = map.v;
    int around = slices < MAX_SLICES ? slices : MAX_SLICES;
    for (int i = 0; i < count; i++) {
        lom_vec3 before = rings[i > 0 ? i - 1 : 0].center, after = rings[i + 1 < count ? i + 1 : i].center;
        lom_vec3 along = lom_vec3_normalize(lom_vec3_subtract(after, before));
        if (i > 0)
            v += lom_vec3_length(lom_vec3_subtract(rings[i].center, before)) / map.metres;
        ring_vertices(builder, &rings[i], along, around, v, map, next);
        if (i == 0)
            cap(builder, &rings[i], next, around, false, map);
        for (int k = 0; i > 0 && k < around; k++) {
            if (rings[i].radius > 0)
                lom_builder_quad(builder, last[k], last[k + 1], next[k + 1], next[k]);
            else
                lom_builder_triangle(builder, last[k], last[k + 1], next[k]);
        }
        if (i + 1 == count)
            cap(builder, &rings[i], next, around, true, map);
        memcpy(last, next, sizeof last);
    }
}

void lom_model_pole(lom_mesh_builder *builder, lom_vec3 from, lom_vec3 to, double radius0, double radius1, int slices,
                    lom_model_map map)
{
    lom_model_ring rings[2] = { { from, radius0 }, { to, radius1 } };
    lom_model_tube(builder, rings, 2, slices, map);
}

/* ---- leaves ---- */

enum { MAX_SEGMENTS = 8 };

void lom_model_leaf_at(lom_mesh_builder *builder, const lom_model_leaf *leaf)
{
    uint32_t left[MAX_SEGMENTS + 1], right[MAX_SEGMENTS + 1];
    int segments = leaf->segments < MAX_SEGMENTS ? leaf->segments : MAX_SEGMENTS;
    for (int i = 0; i <= segments; i++) {
        double t = (double)i / segments;
        lom_vec3 p = lom_vec3_add(leaf->foot, lom_vec3_scale(leaf->along, leaf->length * t));
        p.y -= leaf->droop * leaf->length * t * t;
        double half = 0.5 * leaf->width * (0.55 + 1.6 * t * (1 - t)) * (1 - t * t * t);
        double v = 0.03 + 0.94 * t, u = leaf->u;
        lom_vec3 a = lom_vec3_subtract(p, lom_vec3_scale(leaf->side, half));
        lom_vec3 b = lom_vec3_add(p, lom_vec3_scale(leaf->side, half));
        left[i] = lom_builder_vertex_normal(builder, a, leaf->normal, u, v);
        right[i] =
            i == segments ? left[i] : lom_builder_vertex_normal(builder, b, leaf->normal, u + leaf->width * 0.5, v);
    }
    for (int i = 0; i < segments; i++) {
        lom_builder_triangle(builder, left[i], right[i], left[i + 1]);
        lom_builder_triangle(builder, left[i], left[i + 1], right[i]);
        if (i + 1 < segments) {
            lom_builder_triangle(builder, right[i], right[i + 1], left[i + 1]);
            lom_builder_triangle(builder, right[i], left[i + 1], right[i + 1]);
        }
    }
}
