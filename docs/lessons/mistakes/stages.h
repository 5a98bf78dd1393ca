/* The plain pipeline (../pipeline/pipeline.c) with stages that can be exchanged. In: a table of functions, a stage each, and
 * a scene. Out: a picture. With right_stages the bytes are those of pipeline.c; with one function of another's, a student's
 * or a mistake's, one can see what it changes. To be included by one file of a program, which has all of pipeline.c then. */
#ifndef LOM_LESSONS_STAGES_H
#define LOM_LESSONS_STAGES_H

static __attribute__((unused)) int draw_pipeline(int argc, char **argv);
#define main draw_pipeline /* the lesson is a program */
#include "../pipeline/pipeline.c"
#undef main

#include <lom/waves.h>

/* What is drawn: a mesh, where it is, and what of it. */
struct thing {
    const lom_mesh *mesh;
    lom_vec3 offset, turn, factor; /* model matrix T Rz Ry Rx S; metres, radians */
    float opacity, tiling;         /* below 1: blended */
    float clip_plane[4];           /* in the world; all 0: whole */
    int cull;                      /* as in struct draw */
    bool on_the_screen;            /* the model matrix alone takes it to clip space */
};

/* One function a stage, named as in pipeline.c, in the order in which data meets them. NULL stands for the right one. */
struct stages {
    float (*order)(const struct thing *thing, lom_vec3 eye); /* things are drawn by it, the least first */
    lom_mat4 (*model_matrix)(lom_vec3 offset, lom_vec3 turn, lom_vec3 factor);
    bool (*normal_matrix)(const lom_mat4 *model, lom_mat4 *normal);
    lom_matrix_uniform (*round_matrix)(const lom_mat4 *m); /* to what shaders multiply with */
    struct texture (*make_texture)(int width, int height, const uint8_t *rgba, float (*room)[4]);
    void (*shade_vertex)(const struct picture *p, const struct uniforms *u, const lom_mesh_vertex *in,
                         struct vertex *v);
    int (*clip)(const struct picture *p, unsigned codes, struct vertex polygon[10]);
    void (*project)(const struct picture *p, struct vertex *v);
    bool (*set_up)(int cull, struct triangle *t);
    bool (*covers)(const struct triangle *t, struct fragment *f); /* in: f->x, f->y; out: f->l */
    float (*depth_at)(const struct triangle *t, const float l[3]);
    bool (*is_nearer)(float depth, float before);
    void (*interpolate)(const struct triangle *t, struct fragment *f);             /* in: l; out: w, varying, ds, dt */
    float (*level_of_detail)(const struct level *whole, const struct fragment *f); /* in: ds, dt */
    void (*sample)(const struct texture *texture, struct fragment *f);             /* in: varying, lod; out: texel */
    void (*shade)(const struct uniforms *u, struct fragment *f);                   /* out: color */
    void (*write_pixel)(const float color[4], bool blends, uint8_t pixel[4]);
    /* What the pipeline has not, but water and clouds have. */
    void (*wave)(const lom_trochoid *w, float x, float z, float time, float moved[3]); /* out: by how much */
    void (*march)(float depth, float light, float ray[2]); /* a step: its optical depth, the light there; ray: below */
};
enum { STAGES = sizeof(struct stages) / sizeof(void (*)(void)) };

/* Their names, in the same order. */
static const char *const stage_names[STAGES] = {
    "order",   "model_matrix", "normal_matrix", "round_matrix", "make_texture", "shade_vertex", "clip",
    "project", "set_up",       "covers",        "depth_at",     "is_nearer",    "interpolate",  "level_of_detail",
    "sample",  "shade",        "write_pixel",   "wave",         "march",
};

/* A mistake: one stage with one rule broken. */
struct mistake {
    const char *name;   /* "perspective" */
    const char *stage;  /* one of stage_names: the one function in `wrong` that is not NULL */
    const char *rule;   /* that it breaks: a sentence */
    const char *source; /* where the rule stands */
    const char *looks;  /* what one sees: a sentence */
    struct stages wrong;
};

/* ---- the right ones that pipeline.c has no function for ---- */

/* Opaque things in any order; blended ones over them, the farthest first (Porter, Duff 1984: over does not commute). */
static float order(const struct thing *thing, lom_vec3 eye)
{
    return thing->opacity < 1 ? -(float)lom_vec3_length(lom_vec3_subtract(thing->offset, eye)) : -INFINITY;
}

static bool is_nearer(float depth, float before)
{
    return depth > before;
}

/* A trochoid (Gerstner 1809) as lom/waves.h defines it. */
static void wave(const lom_trochoid *w, float x, float z, float time, float moved[3])
{
    double phase = w->number * (w->direction[0] * (double)x + w->direction[1] * (double)z);
    double t = phase + 6.283185307179586 * w->phase - w->rate * (double)time, across = -w->across * lom_double_sin(t);
    moved[0] = (float)(across * w->direction[0]);
    moved[1] = (float)(w->amplitude * lom_double_cos(t));
    moved[2] = (float)(across * w->direction[1]);
}

/* Front to back; ray: the share of light that comes through all steps so far (1 at first), and the light so far (0). */
static void march(float depth, float light, float ray[2])
{
    float through = (float)lom_double_exp(-(double)depth);
    ray[1] = ray[1] + ray[0] * (1 - through) * light;
    ray[0] = ray[0] * through;
}

static const struct stages right_stages = {
    order,
    lom_model_matrix,
    lom_normal_matrix,
    lom_round_matrix,
    make_texture,
    shade_vertex,
    clip,
    project,
    set_up,
    covers,
    depth_at,
    is_nearer,
    interpolate,
    level_of_detail,
    sample,
    shade,
    write_pixel,
    wave,
    march,
};

/* Right stages where the others are NULL. */
static struct stages complete_stages(const struct stages *others)
{
    void (*function[STAGES])(void), (*right[STAGES])(void);
    struct stages result;
    memcpy(function, others, sizeof function);
    memcpy(right, &right_stages, sizeof right);
    for (int i = 0; i < STAGES; i++)
        function[i] = function[i] != NULL ? function[i] : right[i];
    memcpy(&result, function, sizeof result);
    return result;
}

/* ---- drawing: as in pipeline.c ---- */

static void draw_pixel_by(const struct stages *by, struct picture *p, const struct draw *draw, const struct triangle *t,
                          int x, int y)
{
    struct fragment f = { .x = x, .y = y };
    size_t place = (size_t)y * (size_t)p->width + (size_t)x;
    if (!by->covers(t, &f))
        return;
    f.depth = by->depth_at(t, f.l);
    if (!by->is_nearer(f.depth, p->depth[place]))
        return;
    p->depth[place] = f.depth;
    by->interpolate(t, &f);
    f.lod = by->level_of_detail(&draw->texture->level[0], &f);
    by->sample(draw->texture, &f);
    by->shade(&draw->uniforms, &f);
    by->write_pixel(f.color, draw->blends, p->color[place]);
}

/* Of each triangle the pixels of its bounds, and one more around them, which a stage may take. */
static void draw_triangle_by(const struct stages *by, struct picture *p, const struct draw *draw, struct triangle *t)
{
    if (!by->set_up(draw->cull, t))
        return;
    int32_t low[2] = { INT32_MAX, INT32_MAX }, high[2] = { INT32_MIN, INT32_MIN };
    for (int k = 0; k < 3; k++) {
        const int32_t at[2] = { t->v[k].x, t->v[k].y };
        for (int i = 0; i < 2; i++) {
            low[i] = at[i] < low[i] ? at[i] : low[i];
            high[i] = at[i] > high[i] ? at[i] : high[i];
        }
    }
    for (int y = low[1] > UNITS ? low[1] / UNITS - 1 : 0; y < p->height && y - 1 < high[1] / UNITS; y++)
        for (int x = low[0] > UNITS ? low[0] / UNITS - 1 : 0; x < p->width && x - 1 < high[0] / UNITS; x++)
            draw_pixel_by(by, p, draw, t, x, y);
}

static void draw_mesh_by(const struct stages *by, struct picture *p, const struct draw *draw)
{
    for (size_t i = 0; i + 2 < draw->mesh->index_count; i += 3) {
        struct vertex v[10];
        unsigned all = ~0u, any = 0;
        for (int k = 0; k < 3; k++) {
            by->shade_vertex(p, &draw->uniforms, &draw->mesh->vertices[draw->mesh->indices[i + (size_t)k]], &v[k]);
            all &= v[k].code;
            any |= v[k].code;
        }
        if ((all & ~OUT_BAND) != 0 || (any & NO_NUMBER) != 0)
            continue;
        int count = by->clip(p, any, v);
        for (int k = 0; k < count; k++)
            by->project(p, &v[k]);
        for (int k = 0; k + 2 < count; k++)
            draw_triangle_by(by, p, draw, &(struct triangle){ .v = { v[0], v[k + 1], v[k + 2] } });
    }
}

/* A thing, through `by` from its model matrix on. */
static void draw_thing_by(const struct stages *by, struct picture *p, const struct thing *thing,
                          const struct texture *texture, const lom_mat4 *camera, lom_vec3 eye)
{
    lom_mat4 model = by->model_matrix(thing->offset, thing->turn, thing->factor), normals;
    lom_mat4 to_clip = thing->on_the_screen ? model : lom_multiply(camera, &model);
    by->normal_matrix(&model, &normals);
    struct draw draw = { .mesh = thing->mesh, .texture = texture, .cull = thing->cull, .blends = thing->opacity < 1 };
    struct uniforms *u = &draw.uniforms;
    u->to_clip = by->round_matrix(&to_clip);
    u->to_world = by->round_matrix(&model);
    u->normal_to_world = by->round_matrix(&normals);
    memcpy(u->clip_plane, thing->clip_plane, sizeof u->clip_plane);
    u->opacity = thing->opacity;
    u->shininess = 40;
    u->tiling[0] = u->tiling[1] = thing->tiling;
    memcpy(u->eye, (const float[3]){ (float)eye.x, (float)eye.y, (float)eye.z }, sizeof u->eye);
    draw_mesh_by(by, p, &draw);
}

#endif
