/* The lessons of docs/lessons, which the program contains: each is a program of its own whose main got another name (the
 * Makefile). In: the path of the picture to write; out: an exit status. A lesson is one row of lesson.c. */
#ifndef LOM_CLI_LESSONS_H
#define LOM_CLI_LESSONS_H

int lom_lesson_clip_space(int argc, char **argv);
int lom_lesson_pipeline(int argc, char **argv);
int lom_lesson_rasterization(int argc, char **argv);
int lom_lesson_transforms(int argc, char **argv);
int lom_lesson_triangle(int argc, char **argv);

#endif
