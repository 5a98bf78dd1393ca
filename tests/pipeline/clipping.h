/* What the tests of clipping share: shaders that count, and the oracle. It clips nothing: the weights of a pixel are
 * solved from the homogeneous positions (Olano and Greer, Triangle Scan Conversion using 2D Homogeneous Coordinates,
 * 1997), so every condition of being visible is a linear function of the window position. Pixels further than a
 * pixel's 1/256 from every zero line must agree. */
#ifndef LOM_TESTS_CLIPPING_H
#define LOM_TESTS_CLIPPING_H

#include "stage.h"

enum { SIZE = 96, MAX_CONDITIONS = 13 };

static void place(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const float *sign = uniforms;
    out->position = in->attribute[0];
    out->varying[0] = in->attribute[1].x;
    for (int i = 0; i < 8; i++)
        out->distance[i] = (&in->attribute[3 + i / 4].x)[i % 4] * sign[i];
}

static void count(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)in;
    (void)uniforms;
    lom_float one = lom_splat(1.0f / 255.0f);
    out->color[0] = (lom_float4){ one, one, one, one };
}
LOM_SHADER(counter, place, count, .attributes = 5, .colors = 1, .uniforms_size = 32)
LOM_SHADER(clipped, place, count, .attributes = 5, .clip_distances = 8, .colors = 1, .uniforms_size = 32)
LOM_SHADER(culled, place, count, .attributes = 5, .cull_distances = 8, .colors = 1, .uniforms_size = 32)

static const float plus[8] = { 1, 1, 1, 1, 1, 1, 1, 1 };
static vertex vertices[16384];

static inline void draw_counting(stage *s, const lom_shader *shader, const float *signs, size_t triangles)
{
    lom_draw_desc desc = draw_of(shader, vertices, 3 * triangles);
    desc.uniforms = signs;
    desc.blend[0] = adding();
    lom_draw(s->device, &desc);
}

static inline void put(size_t i, float x, float y, float z, float w)
{
    vertices[i] = (vertex){ .position = { x, y, z, w }, .distance = { 1, 1, 1, 1, 1, 1, 1, 1 } };
}

/* ---- the oracle ---- */

typedef struct linear { /* x X + y Y + c of the pixel's window position; visible where >= 0 */
    long double x, y, c;
    long double noise; /* of float arithmetic on it */
} linear;

typedef struct oracle {
    linear condition[MAX_CONDITIONS];
    int conditions;
    linear weight[3]; /* of the vertices, so that their sum weighted by w is 1 */
    bool empty;       /* edge-on */
} oracle;

static inline linear combine(const oracle *o, const long double f[3])
{
    linear sum = { 0 };
    for (int k = 0; k < 3; k++) {
        sum.x += o->weight[k].x * f[k];
        sum.y += o->weight[k].y * f[k];
        sum.c += o->weight[k].c * f[k];
    }
    return sum;
}

static inline void add_condition(oracle *o, linear condition)
{
    o->condition[o->conditions++] = condition;
}

/* Rows of the inverse of the matrix of the three (x, y, w), with x and y in pixels; then near, far and distances. */
static inline oracle solve(const vertex *v, int width, int height, int distances)
{
    oracle o = { .empty = false };
    long double p[3][3];
    for (int k = 0; k < 3; k++) {
        long double w = v[k].position[3];
        p[k][0] = (v[k].position[0] + w) * width / 2;
        p[k][1] = (w - v[k].position[1]) * height / 2;
        p[k][2] = w;
    }
    long double cross[3][3], det = 0;
    for (int k = 0; k < 3; k++) {
        const long double *a = p[(k + 1) % 3], *b = p[(k + 2) % 3];
        for (int i = 0; i < 3; i++)
            cross[k][i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
    }
    for (int i = 0; i < 3; i++)
        det += p[0][i] * cross[0][i];
    o.empty = det == 0;
    for (int k = 0; k < 3 && !o.empty; k++) {
        o.weight[k] = (linear){ cross[k][0] / det, cross[k][1] / det, cross[k][2] / det, 0 };
        add_condition(&o, o.weight[k]);
    }
    long double near[3], far[3];
    for (int k = 0; k < 3; k++) {
        near[k] = (long double)v[k].position[3] - v[k].position[2];
        far[k] = v[k].position[2];
    }
    add_condition(&o, combine(&o, near));
    add_condition(&o, combine(&o, far));
    for (int i = 0; i < distances; i++) {
        long double d[3], largest = 0;
        for (int k = 0; k < 3; k++) {
            d[k] = v[k].distance[i];
            long double size = __builtin_fabsl(d[k] / v[k].position[3]);
            largest = size > largest ? size : largest;
        }
        linear condition = combine(&o, d);
        condition.noise = largest * 0x1p-21L;
        add_condition(&o, condition);
    }
    return o;
}

static inline long double value_of(const linear *f, double x, double y)
{
    return f->x * x + f->y * y + f->c;
}

/* 1 visible, 0 not, -1 within `slack` pixels of a zero line that decides. */
static inline int visibility(const oracle *o, double x, double y, double slack)
{
    int result = 1;
    for (int i = 0; i < o->conditions; i++) {
        const linear *f = &o->condition[i];
        long double slope = __builtin_sqrtl(f->x * f->x + f->y * f->y);
        long double value = value_of(f, x, y), margin = slope * slack + f->noise;
        if (value < -margin)
            return 0;
        if (value <= margin)
            result = -1;
    }
    return o->empty ? 0 : result;
}

/* Draws the first triangle alone and compares; how many pixels the oracle left open. */
static inline int compare_triangle(stage *s, const lom_shader *shader, int distances, const char *what, int round)
{
    int open = 0;
    oracle o = solve(vertices, SIZE, SIZE, distances);
    begin(s, (lom_pass_desc){ 0 });
    draw_counting(s, shader, plus, 1);
    finish(s);
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++) {
            int expected = visibility(&o, x + 0.5, y + 0.5, 1.5 / 256), hits = bytes_at(s, x, y)[0];
            open += expected < 0;
            CHECK(hits <= 1 && (expected < 0 || hits == expected), "%s %d: pixel %d,%d has %d hits, not %d", what,
                  round, x, y, hits, expected);
        }
    return open;
}

static inline stage open_counting(void)
{
    return open_stage((lom_device_desc){ .threads = 1 }, SIZE, SIZE, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE);
}

#endif
