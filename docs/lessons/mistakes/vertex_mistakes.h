/* Stages with one rule broken each, from the order of things to set-up. In and out: as the right stage's. They differ from
 * it in what the name says, and in nothing else; the table in gallery.c says which rule that is. */
#ifndef LOM_LESSONS_VERTEX_MISTAKES_H
#define LOM_LESSONS_VERTEX_MISTAKES_H

#include "stages.h"

/* ---- order ---- */

static float order_as_given(const struct thing *thing, lom_vec3 eye)
{
    (void)eye;
    return thing->opacity < 1 ? 0 : -INFINITY;
}

/* ---- model_matrix ---- */

static lom_mat4 scale_after_turning(lom_vec3 offset, lom_vec3 turn, lom_vec3 factor)
{
    lom_mat4 t = lom_translation(offset), r = lom_rotation(turn), s = lom_scaling(factor), sr = lom_multiply(&s, &r);
    return lom_multiply(&t, &sr);
}

static lom_mat4 move_before_turning(lom_vec3 offset, lom_vec3 turn, lom_vec3 factor)
{
    lom_mat4 t = lom_translation(offset), r = lom_rotation(turn), s = lom_scaling(factor), ts = lom_multiply(&t, &s);
    return lom_multiply(&r, &ts);
}

static lom_mat4 turn_z_first(lom_vec3 offset, lom_vec3 turn, lom_vec3 factor)
{
    lom_mat4 t = lom_translation(offset), s = lom_scaling(factor);
    lom_mat4 x = lom_rotation((lom_vec3){ turn.x, 0, 0 }), y = lom_rotation((lom_vec3){ 0, turn.y, 0 });
    lom_mat4 z = lom_rotation((lom_vec3){ 0, 0, turn.z }), zs = lom_multiply(&z, &s), yzs = lom_multiply(&y, &zs);
    lom_mat4 xyzs = lom_multiply(&x, &yzs);
    return lom_multiply(&t, &xyzs);
}

static lom_mat4 turn_by_degrees(lom_vec3 offset, lom_vec3 turn, lom_vec3 factor)
{
    return lom_model_matrix(offset, lom_vec3_scale(turn, 3.14159265358979323846 / 180), factor);
}

/* ---- normal_matrix ---- */

static bool normals_by_model_matrix(const lom_mat4 *model, lom_mat4 *normal)
{
    *normal = *model;
    return true;
}

static bool normals_of_the_object(const lom_mat4 *model, lom_mat4 *normal)
{
    (void)model;
    *normal = lom_identity();
    return true;
}

static bool normals_by_inverse(const lom_mat4 *model, lom_mat4 *normal)
{
    bool done = lom_normal_matrix(model, normal);
    *normal = lom_transpose(normal);
    return done;
}

/* ---- round_matrix ---- */

static lom_matrix_uniform exchange_rows_and_columns(const lom_mat4 *m)
{
    lom_mat4 other = lom_transpose(m);
    return lom_round_matrix(&other);
}

/* ---- make_texture ---- */

static struct texture use_codes_as_light(int width, int height, const uint8_t *rgba, float (*room)[4])
{
    struct texture t = make_texture(width, height, rgba, room);
    for (int i = 0; i < t.levels; i++)
        for (int k = 0; k < t.level[i].width * t.level[i].height; k++)
            for (int c = 0; c < 3; c++)
                t.level[i].texel[k][c] = (float)encode(t.level[i].texel[k][c]) / 255;
    return t;
}

static struct texture average_codes(int width, int height, const uint8_t *rgba, float (*room)[4])
{
    struct texture t = make_texture(width, height, rgba, room);
    for (struct level *l = t.level + 1; l < t.level + t.levels; l++)
        for (int i = 0; i < 3 * l->width * l->height; i++) {
            int texel = i / 3, x = texel % l->width, y = texel / l->width, sum = 0, wide = l[-1].width > 1,
                high = l[-1].height > 1;
            for (int k = 0; k < 4; k++)
                sum +=
                    encode(l[-1].texel[((y << high) + (k / 2 & high)) * l[-1].width + (x << wide) + (k & wide)][i % 3]);
            l->texel[texel][i % 3] = decode((sum + 2) / 4);
        }
    return t;
}

static struct texture flip_v(int width, int height, const uint8_t *rgba, float (*room)[4])
{
    struct texture t = make_texture(width, height, rgba, room);
    for (struct level *l = t.level; l < t.level + t.levels; l++)
        for (int y = 0; y < l->height / 2; y++)
            for (int x = 0; x < l->width; x++) {
                float *upper = l->texel[y * l->width + x], *lower = l->texel[(l->height - 1 - y) * l->width + x],
                      swap[4];
                memcpy(swap, upper, sizeof swap);
                memcpy(upper, lower, sizeof swap);
                memcpy(lower, swap, sizeof swap);
            }
    return t;
}

/* ---- shade_vertex ---- */

static void move_clip_plane(const struct picture *p, const struct uniforms *u, const lom_mesh_vertex *in,
                            struct vertex *v)
{
    struct uniforms moved = *u;
    moved.clip_plane[3] = dot(u->clip_plane, u->clip_plane) > 0 ? u->clip_plane[3] + 0.08f : 0;
    shade_vertex(p, &moved, in, v);
}

static void keep_other_side(const struct picture *p, const struct uniforms *u, const lom_mesh_vertex *in,
                            struct vertex *v)
{
    struct uniforms other = *u;
    for (int i = 0; i < 4; i++)
        other.clip_plane[i] = -u->clip_plane[i];
    shade_vertex(p, &other, in, v);
}

/* The clip plane is the world's, the place the object's. */
static void clip_in_object_space(const struct picture *p, const struct uniforms *u, const lom_mesh_vertex *in,
                                 struct vertex *v)
{
    shade_vertex(p, u, in, v);
    float distance = dot(in->position, u->clip_plane) + u->clip_plane[3];
    v->value[DISTANCE] = distance;
    v->code = (v->code & ~(unsigned)OUT_DISTANCE) | (distance < 0 ? OUT_DISTANCE : 0);
}

static void move_normals(const struct picture *p, const struct uniforms *u, const lom_mesh_vertex *in, struct vertex *v)
{
    shade_vertex(p, u, in, v);
    for (int i = 0; i < 3; i++) /* a normal with w = 1 */
        v->value[NORMAL + i] = v->value[NORMAL + i] + u->to_world.m[i][3];
}

/* ---- clip ---- */

static int clip_nothing(const struct picture *p, unsigned codes, struct vertex polygon[10])
{
    (void)p;
    (void)codes;
    (void)polygon;
    return 3;
}

static int drop_what_crosses(const struct picture *p, unsigned codes, struct vertex polygon[10])
{
    return (codes & (OUT_NEAR | OUT_W | OUT_FAR)) != 0 ? 0 : clip(p, codes, polygon);
}

/* The polygon that clipping leaves has up to four corners here; only its first triangle is drawn. */
static int keep_one_triangle(const struct picture *p, unsigned codes, struct vertex polygon[10])
{
    int count = clip(p, codes, polygon);
    return count > 3 ? 3 : count;
}

/* ---- project ---- */

static void divide_twice(const struct picture *p, struct vertex *v)
{
    struct vertex divided = *v;
    for (int i = 0; i < 3; i++)
        divided.value[CLIP + i] = v->value[CLIP + i] / v->value[CLIP + 3];
    project(p, &divided);
    v->x = divided.x;
    v->y = divided.y;
    v->depth = divided.depth;
    v->one_over_w = divided.one_over_w;
}

static void divide_nothing(const struct picture *p, struct vertex *v)
{
    struct vertex flat = *v;
    flat.value[CLIP + 3] = 4;
    project(p, &flat);
    v->x = flat.x;
    v->y = flat.y;
    v->depth = flat.depth;
    v->one_over_w = flat.one_over_w;
}

static void flip_y(const struct picture *p, struct vertex *v)
{
    project(p, v);
    v->y = p->height * UNITS - v->y;
}

static void snap_to_pixels(const struct picture *p, struct vertex *v)
{
    project(p, v);
    v->x = (v->x + UNITS / 2) / UNITS * UNITS;
    v->y = (v->y + UNITS / 2) / UNITS * UNITS;
}

static void snap_downwards(const struct picture *p, struct vertex *v)
{
    const float *at = v->value + CLIP;
    float half_width = (float)p->width * (UNITS / 2), half_height = (float)p->height * (UNITS / 2);
    project(p, v);
    v->x = lom_int_of(clamp(at[0] / at[3], -p->band[0], p->band[0]) * half_width + half_width);
    v->y = lom_int_of(clamp(at[1] / at[3], -p->band[1], p->band[1]) * -half_height + half_height);
}

/* ---- set_up ---- */

static bool cull_the_front(int cull, struct triangle *t)
{
    return set_up(-cull, t);
}

static bool cull_nothing(int cull, struct triangle *t)
{
    (void)cull;
    return set_up(0, t);
}

#endif
