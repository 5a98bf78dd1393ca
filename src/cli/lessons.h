/* The lessons of docs/lessons, which the program contains: each is a program of its own whose main got another name (the
 * Makefile). In: the path of the picture to write; out: an exit status. A lesson is one row of lesson.c. */
#ifndef LOM_CLI_LESSONS_H
#define LOM_CLI_LESSONS_H

int lom_lesson_clip_space(int argc, char **argv);
int lom_lesson_clouds(int argc, char **argv);
int lom_lesson_depth(int argc, char **argv);
int lom_lesson_determinism(int argc, char **argv);
int lom_lesson_interpolation(int argc, char **argv);
int lom_lesson_lanes(int argc, char **argv);
int lom_lesson_lights(int argc, char **argv);
int lom_lesson_normals(int argc, char **argv);
int lom_lesson_pipeline(int argc, char **argv);
int lom_lesson_rasterization(int argc, char **argv);
int lom_lesson_stage(int argc, char **argv);
int lom_lesson_targets(int argc, char **argv);
int lom_lesson_textures(int argc, char **argv);
int lom_lesson_trade(int argc, char **argv);
int lom_lesson_transforms(int argc, char **argv);
int lom_lesson_triangle(int argc, char **argv);
int lom_lesson_water(int argc, char **argv);
int lom_lesson_waves(int argc, char **argv);

/* The folder of the lessons: installed beside the program, or in the tree that it was built in; NULL: neither. */
const char *lom_find_lessons(char path[4096]);

#endif
