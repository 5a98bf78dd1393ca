/* What a stage is asked. In: a stage and the number of a case. Out: the inputs, a pure function of both: the first CORNERS
 * cases are made of corner cases (zeros, limits, pixel centres on edges, vertices on planes, ties, no numbers where they
 * are defined), the others of random numbers. Invariant: what stages before this one would never hand on is not asked. */
#ifndef LOM_LESSONS_PROBLEMS_H
#define LOM_LESSONS_PROBLEMS_H

#include "../mistakes/stages.h"

enum { CORNERS = 2048, CASES = 12288, ROLLS = 4096, TINY = 4, SIZE = 16 };

struct problem {
    struct picture picture;
    struct uniforms uniforms;
    struct thing thing;
    lom_vec3 eye;
    lom_mat4 matrix;
    lom_mesh_vertex in;
    struct vertex polygon[10];
    unsigned codes;
    int cull;
    struct triangle triangle;
    struct fragment fragment;
    struct level level;
    struct texture texture;
    uint8_t rgba[SIZE * SIZE * 4], pixel[4];
    float room[2 * TINY * TINY][4];
    float depth, before, color[4], x, z, time, light, ray[2];
    bool blends;
    lom_trochoid wave;
};

/* Counter-based random numbers: those of a case begin where its number says. */
struct dice {
    uint64_t key, counter;
    bool corner;
};

static uint64_t roll(struct dice *d, int sides)
{
    return lom_random_bits(d->key, d->counter++) % (uint64_t)sides;
}

/* Uniform; for corner cases every other time a special value of the range. */
static float between(struct dice *d, double low, double high)
{
    const double special[8] = { low, high, (low + high) / 2, 0, 1, -1, 0.5, -0.0 };
    double x = low + (high - low) * lom_random_uniform(d->key, d->counter++);
    if (d->corner && roll(d, 2) == 0) {
        double chosen = special[roll(d, 8)];
        x = chosen >= low && chosen <= high ? chosen : x;
    }
    return (float)x;
}

/* As between, but for corner cases sometimes far outside, or no number. */
static float wild(struct dice *d, double low, double high)
{
    static const float far[8] = { NAN, INFINITY, -INFINITY, 1e-40f, 1e30f, -1e30f, 0x1p24f, -1e-30f };
    float x = between(d, low, high);
    return d->corner && roll(d, 8) == 0 ? far[roll(d, 8)] : x;
}

static lom_vec3 some_vector(struct dice *d, double low, double high)
{
    float x = between(d, low, high), y = between(d, low, high), z = between(d, low, high);
    return (lom_vec3){ x, y, z };
}

static void ask_picture(struct dice *d, struct problem *p)
{
    static const int sizes[6] = { 1, 2, 64, 128, 320, 1920 };
    int width = sizes[roll(d, 6)], height = sizes[roll(d, 6)];
    p->picture = (struct picture){ width, height, { 2.0f * BAND / (float)width, 2.0f * BAND / (float)height },
                                   NULL,  NULL,   NULL };
}

static void ask_thing(struct dice *d, struct problem *p)
{
    p->thing.offset = some_vector(d, -10, 10);
    p->thing.turn = some_vector(d, -3, 3);
    p->thing.factor = some_vector(d, 0.25, 4);
    p->thing.opacity = between(d, 0, 1.5);
    p->eye = some_vector(d, -10, 10);
}

static void ask_matrix(struct dice *d, struct problem *p)
{
    for (int i = 0; i < 16; i++)
        p->matrix.m[i / 4][i % 4] = (double)between(d, -2, 2) / 3;
}

static void ask_model(struct dice *d, struct problem *p)
{
    ask_thing(d, p);
    if (d->corner && roll(d, 8) == 0)
        p->thing.factor.y = 0; /* it has no inverse */
    p->matrix = lom_model_matrix(p->thing.offset, p->thing.turn, p->thing.factor);
}

static void ask_pixels(struct dice *d, struct problem *p, int width, int height)
{
    p->level.width = width;
    p->level.height = height;
    for (int i = 0; i < 4 * width * height; i++)
        p->rgba[i] = (uint8_t)(d->corner ? roll(d, 2) * 255 : roll(d, 256));
}

static void ask_tiny_texture(struct dice *d, struct problem *p)
{
    int width = 1 << roll(d, 3), height = 1 << roll(d, 3);
    ask_pixels(d, p, width, height);
}

static void ask_vertex(struct dice *d, struct problem *p)
{
    struct uniforms *u = &p->uniforms;
    bool plain = d->corner && roll(d, 2) == 0;
    ask_picture(d, p);
    ask_matrix(d, p);
    u->to_clip = lom_round_matrix(&p->matrix);
    ask_thing(d, p);
    lom_mat4 model = plain ? lom_identity() : lom_model_matrix(p->thing.offset, p->thing.turn, p->thing.factor),
             normals;
    lom_normal_matrix(&model, &normals);
    u->to_world = lom_round_matrix(&model);
    u->normal_to_world = lom_round_matrix(&normals);
    for (int i = 0; i < 4; i++)
        u->clip_plane[i] = roll(d, 4) == 0 ? 0 : between(d, -1, 1);
    for (int i = 0; i < 2; i++) {
        u->tiling[i] = between(d, 0.5, 20);
        p->in.uv[i] = between(d, -1, 2);
    }
    for (int i = 0; i < 3; i++) {
        p->in.position[i] = wild(d, -4, 4);
        p->in.normal[i] = between(d, -1, 1);
    }
}

/* A vertex at a place in clip space, by the right stage. */
static void place_vertex(struct dice *d, struct problem *p, struct vertex *v)
{
    static const float reach[4] = { 1.5f, 3, 40000, 1 };
    float w = between(d, -1, 5), r = reach[roll(d, 4)];
    struct uniforms u = { .tiling = { 1, 1 }, .clip_plane = { 0, 0, 0, 0 } };
    lom_mesh_vertex in = { .position = { r * between(d, -2, 2), r * between(d, -2, 2), between(d, -1, 6) } };
    if (d->corner && roll(d, 4) == 0)
        in.position[2] = w; /* on the near plane */
    for (int i = 0; i < 3; i++) {
        u.to_clip.m[i][i] = u.to_world.m[i][i] = u.normal_to_world.m[i][i] = 1;
        in.normal[i] = between(d, -1, 1);
    }
    u.to_clip.m[3][3] = w;
    u.clip_plane[1] = roll(d, 2) == 0 ? 0 : 1;
    in.uv[0] = between(d, 0, 1);
    in.uv[1] = between(d, 0, 1);
    shade_vertex(&p->picture, &u, &in, v);
}

/* A triangle that is cut, or would be: not outside of one plane as a whole. */
static void ask_polygon(struct dice *d, struct problem *p)
{
    unsigned all = ~0u;
    ask_picture(d, p);
    for (int tries = 0; tries < 64 && ((all & ~(unsigned)OUT_BAND) != 0 || p->codes == 0); tries++) {
        all = ~0u;
        p->codes = 0;
        for (int k = 0; k < 3; k++) {
            place_vertex(d, p, &p->polygon[k]);
            all &= p->polygon[k].code;
            p->codes |= p->polygon[k].code;
        }
    }
}

/* A vertex as clipping leaves it: inside; for corner cases on a border, or between two places of the window. */
static void ask_projection(struct dice *d, struct problem *p)
{
    static const float near_zero[4] = { 1e-30f, 1, 0.5f, 2 };
    struct vertex *v = &p->polygon[0];
    ask_picture(d, p);
    float w = d->corner ? near_zero[roll(d, 4)] : between(d, 0.1, 30), *at = v->value + CLIP;
    for (int i = 0; i < 2; i++) {
        float size = (float)(i == 0 ? p->picture.width : p->picture.height);
        float tie = (float)(2 * (int)roll(d, 4096) - 4095) / (256 * size),
              reach = roll(d, 8) == 0 ? p->picture.band[i] : 2;
        at[i] = w * (d->corner && roll(d, 2) == 0 ? tie : between(d, -reach, reach));
    }
    at[2] = w * between(d, 0, 1);
    at[3] = w;
}

/* Three vertices in the window. Corner cases: upon pixel centres, 4 pixels apart or a multiple. */
static void place_triangle(struct dice *d, struct problem *p)
{
    static const int spans[8] = { 1, 2, 8, 8, 40, 40, 40, 2000 };
    struct triangle *t = &p->triangle;
    int span = spans[roll(d, 8)], left = (int)roll(d, 64) - 4, top = (int)roll(d, 64) - 4;
    bool aligned = d->corner && roll(d, 4) != 0, crosses = roll(d, 3) == 0, beyond = true;
    *t = (struct triangle){ .crosses = false };
    for (int k = 0; k < 3; k++) {
        struct vertex *v = &t->v[k];
        v->x = left * UNITS + (aligned ? UNITS / 2 + 4 * UNITS * (int)roll(d, 6) : (int)roll(d, span * UNITS));
        v->y = top * UNITS + (aligned ? UNITS / 2 + 4 * UNITS * (int)roll(d, 6) : (int)roll(d, span * UNITS));
        for (int i = 0; i < VALUES; i++)
            v->value[i] = between(d, -4, 4);
        v->value[DISTANCE] = crosses ? between(d, -1, 1) : 1;
        v->code = v->value[DISTANCE] < 0 ? OUT_DISTANCE : 0;
        v->depth = between(d, 0, 1) * (roll(d, 2) == 0 ? 1 : 1e-3f);
        v->one_over_w = 1 / between(d, 0.1, 20);
        beyond = beyond && v->code != 0;
    }
    if (beyond) { /* such a triangle goes no further */
        t->v[0].value[DISTANCE] = 0.5f;
        t->v[0].code = 0;
    }
}

static void ask_triangle(struct dice *d, struct problem *p)
{
    place_triangle(d, p);
    p->cull = (int)roll(d, 3) - 1;
}

/* A triangle that is set up, a point of it or near it, and the pixel there. */
static void ask_fragment(struct dice *d, struct problem *p)
{
    bool seen = false;
    for (int tries = 0; tries < 64 && !seen; tries++) {
        place_triangle(d, p);
        seen = set_up(0, &p->triangle);
    }
    const struct vertex *v = p->triangle.v;
    struct fragment *f = &p->fragment;
    float a = (float)roll(d, 5) / 4, b = 0; /* upon an edge */
    if (!d->corner || roll(d, 3) == 0) {
        a = between(d, 0, 1);
        b = between(d, 0, 1) * (1 - a);
    }
    float x = (float)v[0].x + a * (float)(v[1].x - v[0].x) + b * (float)(v[2].x - v[0].x);
    float y = (float)v[0].y + a * (float)(v[1].y - v[0].y) + b * (float)(v[2].y - v[0].y);
    f->x = lom_int_of(greater(x / UNITS + (float)((int)roll(d, 6) / 5), 0));
    f->y = lom_int_of(greater(y / UNITS, 0));
    f->l[0] = 1 - a - b;
    f->l[1] = a;
    f->l[2] = b;
}

static void ask_depths(struct dice *d, struct problem *p)
{
    p->depth = wild(d, 0, 1);
    p->before = roll(d, 8) == 0 ? p->depth : between(d, 0, 1);
}

static void ask_steps(struct dice *d, struct problem *p)
{
    p->level.width = 1 << roll(d, 12);
    p->level.height = 1 << roll(d, 12);
    for (int k = 0; k < 2; k++) {
        p->fragment.ds[k] = wild(d, -1, 1) / (float)(1 << roll(d, 14));
        p->fragment.dt[k] = wild(d, -1, 1) / (float)(1 << roll(d, 14));
    }
}

static void ask_sample(struct dice *d, struct problem *p)
{
    static float room[2 * SIZE * SIZE][4];
    static struct texture same; /* made once */
    if (same.levels == 0) {
        struct dice own = { 99, 0, false };
        ask_pixels(&own, p, SIZE, SIZE / 2);
        same = make_texture(SIZE, SIZE / 2, p->rgba, room);
    }
    p->texture = same;
    for (int i = S; i <= T; i++)
        p->fragment.varying[i] =
            d->corner && roll(d, 2) == 0 ? (float)((int)roll(d, 128) - 64) / (2 * SIZE) : wild(d, -3, 3);
    p->fragment.lod = wild(d, -1, p->texture.levels + 1);
}

static void ask_light(struct dice *d, struct problem *p)
{
    float length = between(d, 0.2, 3);
    p->uniforms.shininess = (int)roll(d, 64);
    p->uniforms.opacity = between(d, 0, 1);
    for (int i = 0; i < 3; i++) {
        p->fragment.varying[NORMAL + i] = length * between(d, -1, 1);
        p->fragment.varying[WORLD + i] = between(d, -5, 5);
        p->uniforms.eye[i] = between(d, -5, 5);
    }
    for (int i = 0; i < 3 && roll(d, 4) == 0; i++) { /* where the highlight is */
        p->fragment.varying[NORMAL + i] = to_light[i] * length + 0.2f * between(d, -1, 1);
        p->uniforms.eye[i] = p->fragment.varying[WORLD + i] + to_light[i] * 3 + between(d, -1, 1);
    }
    for (int i = 0; i < 4; i++)
        p->fragment.texel[i] = between(d, 0, 1);
}

static void ask_output(struct dice *d, struct problem *p)
{
    p->blends = roll(d, 2) == 0;
    for (int i = 0; i < 4; i++) {
        p->color[i] = i < 3 ? wild(d, -0.2, 1.2) : wild(d, 0, 1);
        p->pixel[i] = (uint8_t)(d->corner ? roll(d, 2) * 255 : roll(d, 256));
    }
}

static void ask_wave(struct dice *d, struct problem *p)
{
    double angle = between(d, -3, 3), number = between(d, 0.05, 10);
    p->wave = (lom_trochoid){
        { lom_double_cos(angle), lom_double_sin(angle) }, number, lom_double_sqrt(9.80665 * number), 0, 0, 0
    };
    p->wave.phase = lesser(between(d, 0, 1), most_weight);
    p->wave.amplitude = between(d, 0, 2);
    p->wave.across = p->wave.amplitude * (double)between(d, 0, 1);
    p->x = between(d, -50, 50);
    p->z = between(d, -50, 50);
    p->time = between(d, 0, 100);
}

static void ask_step(struct dice *d, struct problem *p)
{
    p->depth = between(d, 0, 1) * (float)(1 << roll(d, 4));
    p->light = between(d, 0, 2);
    p->ray[0] = between(d, 0, 1);
    p->ray[1] = between(d, 0, 2);
}

#endif
