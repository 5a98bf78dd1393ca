/* The cases of every stage. In: stages, a stage, a problem. Out: what that stage answers, as a row of numbers; what was
 * asked, in words. Invariant: two answers are the same bits when their numbers are; all NaNs are one. */
#ifndef LOM_LESSONS_CASES_H
#define LOM_LESSONS_CASES_H

#include "problems.h"

enum { MOST_NUMBERS = 160 };

struct answer {
    int64_t count;
    double number[MOST_NUMBERS];
};

static void put(struct answer *a, double x)
{
    if (a->count < MOST_NUMBERS)
        a->number[a->count++] = x == x ? x : (double)NAN;
}

static void put_floats(struct answer *a, const float *x, int count)
{
    for (int i = 0; i < count; i++)
        put(a, x[i]);
}

/* ---- answers: the stage's outputs, and nothing of what it leaves undefined ---- */

static void answer_order(const struct stages *by, struct problem *p, struct answer *a)
{
    put(a, by->order(&p->thing, p->eye));
}

static void put_matrix(struct answer *a, const lom_mat4 *m, int size)
{
    for (int i = 0; i < size * size; i++)
        put(a, m->m[i / size][i % size]);
}

static void answer_model_matrix(const struct stages *by, struct problem *p, struct answer *a)
{
    lom_mat4 m = by->model_matrix(p->thing.offset, p->thing.turn, p->thing.factor);
    put_matrix(a, &m, 4);
}

static void answer_normal_matrix(const struct stages *by, struct problem *p, struct answer *a)
{
    lom_mat4 normal = lom_identity();
    bool done = by->normal_matrix(&p->matrix, &normal);
    put(a, done);
    if (done)
        put_matrix(a, &normal, 3);
}

static void answer_round_matrix(const struct stages *by, struct problem *p, struct answer *a)
{
    lom_matrix_uniform m = by->round_matrix(&p->matrix);
    put_floats(a, m.m[0], 16);
}

static void answer_make_texture(const struct stages *by, struct problem *p, struct answer *a)
{
    struct texture t = by->make_texture(p->level.width, p->level.height, p->rgba, p->room);
    put(a, t.levels);
    for (const struct level *l = t.level; l < t.level + t.levels && l < t.level + 16; l++) {
        bool sane = l->width > 0 && l->height > 0 && l->width <= TINY && l->height <= TINY && l->texel != NULL;
        put(a, l->width);
        put(a, l->height);
        for (int i = 0; sane && i < l->width * l->height; i++)
            put_floats(a, l->texel[i], 4);
    }
}

static void answer_shade_vertex(const struct stages *by, struct problem *p, struct answer *a)
{
    struct vertex v = { .code = 0 };
    by->shade_vertex(&p->picture, &p->uniforms, &p->in, &v);
    put(a, v.code);
    if ((v.code & NO_NUMBER) == 0)
        put_floats(a, v.value, VALUES);
}

static void answer_clip(const struct stages *by, struct problem *p, struct answer *a)
{
    int count = by->clip(&p->picture, p->codes, p->polygon);
    put(a, count < 3 ? 0 : count);
    for (int k = 0; k < count && k < 10 && count >= 3; k++) {
        put_floats(a, p->polygon[k].value, VALUES);
        put(a, p->polygon[k].code & OUT_DISTANCE);
    }
}

static void answer_project(const struct stages *by, struct problem *p, struct answer *a)
{
    struct vertex *v = &p->polygon[0];
    by->project(&p->picture, v);
    put(a, v->x);
    put(a, v->y);
    put(a, v->depth);
    put(a, v->one_over_w);
}

static void answer_set_up(const struct stages *by, struct problem *p, struct answer *a)
{
    struct triangle *t = &p->triangle;
    bool seen = by->set_up(p->cull, t);
    put(a, seen);
    for (int k = 0; k < 3 && seen; k++) {
        put(a, t->v[k].x);
        put(a, t->v[k].y);
        put(a, (double)t->right[k]);
        put(a, (double)t->down[k]);
        put(a, t->crosses ? t->distance[k] : 0);
    }
    if (seen) {
        put(a, t->inverse_area);
        put(a, t->crosses);
        put(a, t->crosses && t->keeps_zero);
    }
}

static void answer_covers(const struct stages *by, struct problem *p, struct answer *a)
{
    bool inside = by->covers(&p->triangle, &p->fragment);
    put(a, inside);
    if (inside)
        put_floats(a, p->fragment.l, 3);
}

static void answer_depth_at(const struct stages *by, struct problem *p, struct answer *a)
{
    put(a, by->depth_at(&p->triangle, p->fragment.l));
}

static void answer_is_nearer(const struct stages *by, struct problem *p, struct answer *a)
{
    put(a, by->is_nearer(p->depth, p->before));
}

static void answer_interpolate(const struct stages *by, struct problem *p, struct answer *a)
{
    struct fragment *f = &p->fragment;
    by->interpolate(&p->triangle, f);
    put(a, f->w);
    put_floats(a, f->varying, VARYINGS);
    put_floats(a, f->ds, 2);
    put_floats(a, f->dt, 2);
}

static void answer_level_of_detail(const struct stages *by, struct problem *p, struct answer *a)
{
    put(a, by->level_of_detail(&p->level, &p->fragment));
}

static void answer_sample(const struct stages *by, struct problem *p, struct answer *a)
{
    by->sample(&p->texture, &p->fragment);
    put_floats(a, p->fragment.texel, 4);
}

static void answer_shade(const struct stages *by, struct problem *p, struct answer *a)
{
    by->shade(&p->uniforms, &p->fragment);
    put_floats(a, p->fragment.color, 4);
}

static void answer_write_pixel(const struct stages *by, struct problem *p, struct answer *a)
{
    by->write_pixel(p->color, p->blends, p->pixel);
    for (int i = 0; i < 4; i++)
        put(a, p->pixel[i]);
}

static void answer_wave(const struct stages *by, struct problem *p, struct answer *a)
{
    float moved[3] = { 0, 0, 0 };
    by->wave(&p->wave, p->x, p->z, p->time, moved);
    put_floats(a, moved, 3);
}

static void answer_march(const struct stages *by, struct problem *p, struct answer *a)
{
    by->march(p->depth, p->light, p->ray);
    put_floats(a, p->ray, 2);
}

/* ---- in words ---- */

static void tell_thing(const struct problem *p, char *text, size_t room)
{
    const struct thing *t = &p->thing;
    snprintf(text, room, "offset (%g, %g, %g), turn (%g, %g, %g), factor (%g, %g, %g), opacity %g, eye (%g, %g, %g)",
             t->offset.x, t->offset.y, t->offset.z, t->turn.x, t->turn.y, t->turn.z, t->factor.x, t->factor.y,
             t->factor.z, (double)t->opacity, p->eye.x, p->eye.y, p->eye.z);
}

static void tell_matrix(const struct problem *p, char *text, size_t room)
{
    int at = snprintf(text, room, "matrix");
    for (int i = 0; i < 16 && at < (int)room; i++)
        at += snprintf(text + at, room - (size_t)at, "%s%.6g", i % 4 == 0 ? " | " : " ", p->matrix.m[i / 4][i % 4]);
}

static void tell_texture(const struct problem *p, char *text, size_t room)
{
    snprintf(text, room, "%d x %d texels, the first of them (%d, %d, %d, %d)", p->level.width, p->level.height,
             p->rgba[0], p->rgba[1], p->rgba[2], p->rgba[3]);
}

static void tell_vertex(const struct problem *p, char *text, size_t room)
{
    const float *at = p->in.position, *n = p->in.normal, *plane = p->uniforms.clip_plane;
    snprintf(text, room, "position (%g, %g, %g), normal (%g, %g, %g), clip plane (%g, %g, %g, %g)", (double)at[0],
             (double)at[1], (double)at[2], (double)n[0], (double)n[1], (double)n[2], (double)plane[0], (double)plane[1],
             (double)plane[2], (double)plane[3]);
}

static void tell_polygon(const struct problem *p, char *text, size_t room)
{
    int at =
        snprintf(text, room, "picture %d x %d, codes %u, clip space", p->picture.width, p->picture.height, p->codes);
    for (int k = 0; k < 3 && at < (int)room; k++) {
        const float *v = p->polygon[k].value + CLIP;
        at += snprintf(text + at, room - (size_t)at, " (%.9g, %.9g, %.9g, %.9g)", (double)v[0], (double)v[1],
                       (double)v[2], (double)v[3]);
    }
}

static void tell_projection(const struct problem *p, char *text, size_t room)
{
    const float *v = p->polygon[0].value + CLIP;
    snprintf(text, room, "picture %d x %d, clip space (%.9g, %.9g, %.9g, %.9g)", p->picture.width, p->picture.height,
             (double)v[0], (double)v[1], (double)v[2], (double)v[3]);
}

static void tell_triangle(const struct problem *p, char *text, size_t room)
{
    const struct vertex *v = p->triangle.v;
    const struct fragment *f = &p->fragment;
    snprintf(text, room,
             "vertices in 1/256 pixel (%d, %d) (%d, %d) (%d, %d), 1/w %g %g %g, depth %g %g %g, distance %g %g %g, "
             "cull %d, pixel (%d, %d), weights %g %g %g",
             v[0].x, v[0].y, v[1].x, v[1].y, v[2].x, v[2].y, (double)v[0].one_over_w, (double)v[1].one_over_w,
             (double)v[2].one_over_w, (double)v[0].depth, (double)v[1].depth, (double)v[2].depth,
             (double)v[0].value[DISTANCE], (double)v[1].value[DISTANCE], (double)v[2].value[DISTANCE], p->cull, f->x,
             f->y, (double)f->l[0], (double)f->l[1], (double)f->l[2]);
}

static void tell_depths(const struct problem *p, char *text, size_t room)
{
    snprintf(text, room, "depth %.9g, before %.9g", (double)p->depth, (double)p->before);
}

static void tell_sample(const struct problem *p, char *text, size_t room)
{
    const struct fragment *f = &p->fragment;
    snprintf(text, room, "s %.9g, t %.9g, level of detail %.9g of a texture of 16 x 8", (double)f->varying[S],
             (double)f->varying[T], (double)f->lod);
}

static void tell_steps(const struct problem *p, char *text, size_t room)
{
    const struct fragment *f = &p->fragment;
    snprintf(text, room, "ds (%.9g, %.9g), dt (%.9g, %.9g), texture %d x %d", (double)f->ds[0], (double)f->ds[1],
             (double)f->dt[0], (double)f->dt[1], p->level.width, p->level.height);
}

static void tell_light(const struct problem *p, char *text, size_t room)
{
    const float *n = p->fragment.varying + NORMAL, *at = p->fragment.varying + WORLD, *eye = p->uniforms.eye;
    snprintf(text, room, "normal (%g, %g, %g), place (%g, %g, %g), eye (%g, %g, %g), shininess %d", (double)n[0],
             (double)n[1], (double)n[2], (double)at[0], (double)at[1], (double)at[2], (double)eye[0], (double)eye[1],
             (double)eye[2], p->uniforms.shininess);
}

static void tell_output(const struct problem *p, char *text, size_t room)
{
    snprintf(text, room, "color (%.9g, %.9g, %.9g, %.9g), %s, on pixel (%d, %d, %d, %d)", (double)p->color[0],
             (double)p->color[1], (double)p->color[2], (double)p->color[3], p->blends ? "blended" : "not blended",
             p->pixel[0], p->pixel[1], p->pixel[2], p->pixel[3]);
}

static void tell_wave(const struct problem *p, char *text, size_t room)
{
    const lom_trochoid *w = &p->wave;
    snprintf(text, room,
             "direction (%g, %g), number %g, rate %g, phase %g, amplitude %g, across %g, at x %g, z %g, time %g",
             w->direction[0], w->direction[1], w->number, w->rate, w->phase, w->amplitude, w->across, (double)p->x,
             (double)p->z, (double)p->time);
}

static void tell_step(const struct problem *p, char *text, size_t room)
{
    snprintf(text, room, "optical depth %.9g, light %.9g, ray (%.9g, %.9g)", (double)p->depth, (double)p->light,
             (double)p->ray[0], (double)p->ray[1]);
}

/* ---- a row a stage, in the order of struct stages ---- */

#define A_VERTEX "s t normal.x normal.y normal.z world.x world.y world.z distance clip.x clip.y clip.z clip.w"
struct question {
    void (*ask)(struct dice *d, struct problem *p);
    void (*answer)(const struct stages *by, struct problem *p, struct answer *a);
    void (*tell)(const struct problem *p, char *text, size_t room);
    const char *numbers; /* names of the first numbers of an answer; the others are told by their places */
};

static const struct question questions[STAGES] = {
    { ask_thing, answer_order, tell_thing, "order" },
    { ask_thing, answer_model_matrix, tell_thing,
      "m[0][0] m[0][1] m[0][2] m[0][3] m[1][0] m[1][1] m[1][2] m[1][3] m[2][0] m[2][1] m[2][2] m[2][3]" },
    { ask_model, answer_normal_matrix, tell_matrix,
      "invertible m[0][0] m[0][1] m[0][2] m[1][0] m[1][1] m[1][2] m[2][0] m[2][1] m[2][2]" },
    { ask_matrix, answer_round_matrix, tell_matrix,
      "m[0][0] m[0][1] m[0][2] m[0][3] m[1][0] m[1][1] m[1][2] m[1][3] m[2][0] m[2][1] m[2][2] m[2][3]" },
    { ask_tiny_texture, answer_make_texture, tell_texture, "levels width height red green blue alpha" },
    { ask_vertex, answer_shade_vertex, tell_vertex, "code " A_VERTEX },
    { ask_polygon, answer_clip, tell_polygon, "corners " A_VERTEX " code" },
    { ask_projection, answer_project, tell_projection, "x y depth one_over_w" },
    { ask_triangle, answer_set_up, tell_triangle,
      "seen x[0] y[0] right[0] down[0] distance[0] x[1] y[1] right[1] down[1] distance[1] x[2] y[2] right[2] down[2] "
      "distance[2] inverse_area crosses keeps_zero" },
    { ask_fragment, answer_covers, tell_triangle, "covered l[0] l[1] l[2]" },
    { ask_fragment, answer_depth_at, tell_triangle, "depth" },
    { ask_depths, answer_is_nearer, tell_depths, "nearer" },
    { ask_fragment, answer_interpolate, tell_triangle,
      "w s t normal.x normal.y normal.z world.x world.y world.z ds/dx ds/dy dt/dx dt/dy" },
    { ask_steps, answer_level_of_detail, tell_steps, "level" },
    { ask_sample, answer_sample, tell_sample, "red green blue alpha" },
    { ask_light, answer_shade, tell_light, "red green blue alpha" },
    { ask_output, answer_write_pixel, tell_output, "red green blue alpha" },
    { ask_wave, answer_wave, tell_wave, "moved[0] moved[1] moved[2]" },
    { ask_step, answer_march, tell_step, "ray[0] ray[1]" },
};

static void ask_case(int stage, int number, struct problem *p)
{
    struct dice d = { (uint64_t)stage + 1, (uint64_t)number * ROLLS, number < CORNERS };
    memset(p, 0, sizeof *p);
    questions[stage].ask(&d, p);
}

/* The problem is spent: stages write into it. */
static void answer_case(const struct stages *by, int stage, struct problem *p, struct answer *a)
{
    a->count = 0;
    questions[stage].answer(by, p, a);
}

#endif
