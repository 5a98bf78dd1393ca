/* What a student's file includes, and all of it: the types and numbers of the plain pipeline (../pipeline/pipeline.c),
 * and the functions that a student can write. In: one of them, or more, in the student's file. Out: `lom grade` compares
 * each with the right one. The right ones themselves are not given: who calls covers(...) is told so by the compiler. */
#ifndef LOM_LESSONS_STUDENT_H
#define LOM_LESSONS_STUDENT_H

#include "../mistakes/stages.h"

/* A function a stage, as in struct stages. */
float student_order(const struct thing *thing, lom_vec3 eye);
lom_mat4 student_model_matrix(lom_vec3 offset, lom_vec3 turn, lom_vec3 factor);
bool student_normal_matrix(const lom_mat4 *model, lom_mat4 *normal);
lom_matrix_uniform student_round_matrix(const lom_mat4 *m);
struct texture student_make_texture(int width, int height, const uint8_t *rgba, float (*room)[4]);
void student_shade_vertex(const struct picture *p, const struct uniforms *u, const lom_mesh_vertex *in,
                          struct vertex *v);
int student_clip(const struct picture *p, unsigned codes, struct vertex polygon[10]);
void student_project(const struct picture *p, struct vertex *v);
bool student_set_up(int cull, struct triangle *t);
bool student_covers(const struct triangle *t, struct fragment *f);
float student_depth_at(const struct triangle *t, const float l[3]);
bool student_is_nearer(float depth, float before);
void student_interpolate(const struct triangle *t, struct fragment *f);
float student_level_of_detail(const struct level *whole, const struct fragment *f);
void student_sample(const struct texture *texture, struct fragment *f);
void student_shade(const struct uniforms *u, struct fragment *f);
void student_write_pixel(const float color[4], bool blends, uint8_t pixel[4]);
void student_wave(const lom_trochoid *w, float x, float z, float time, float moved[3]);
void student_march(float depth, float light, float ray[2]);

#ifdef LOM_GRADED /* by lom grade, which has a main of its own: the student's, for trying, is not run */
#define main main_of_student
#endif

#ifndef LOM_GRADER
#define order(...)             order_is_for_you_to_write(__VA_ARGS__)
#define lom_model_matrix(...)  model_matrix_is_for_you_to_write(__VA_ARGS__)
#define lom_normal_matrix(...) normal_matrix_is_for_you_to_write(__VA_ARGS__)
#define lom_round_matrix(...)  round_matrix_is_for_you_to_write(__VA_ARGS__)
#define make_texture(...)      make_texture_is_for_you_to_write(__VA_ARGS__)
#define shade_vertex(...)      shade_vertex_is_for_you_to_write(__VA_ARGS__)
#define clip(...)              clip_is_for_you_to_write(__VA_ARGS__)
#define project(...)           project_is_for_you_to_write(__VA_ARGS__)
#define set_up(...)            set_up_is_for_you_to_write(__VA_ARGS__)
#define covers(...)            covers_is_for_you_to_write(__VA_ARGS__)
#define depth_at(...)          depth_at_is_for_you_to_write(__VA_ARGS__)
#define is_nearer(...)         is_nearer_is_for_you_to_write(__VA_ARGS__)
#define interpolate(...)       interpolate_is_for_you_to_write(__VA_ARGS__)
#define level_of_detail(...)   level_of_detail_is_for_you_to_write(__VA_ARGS__)
#define sample(...)            sample_is_for_you_to_write(__VA_ARGS__)
#define shade(...)             shade_is_for_you_to_write(__VA_ARGS__)
#define write_pixel(...)       write_pixel_is_for_you_to_write(__VA_ARGS__)
#define wave(...)              wave_is_for_you_to_write(__VA_ARGS__)
#define march(...)             march_is_for_you_to_write(__VA_ARGS__)
#endif

#endif
