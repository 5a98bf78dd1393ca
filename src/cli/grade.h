/* What `lom grade` takes of docs/lessons/grade/judge.c, which knows the cases of every stage and the gallery of mistakes. */
#ifndef LOM_CLI_GRADE_H
#define LOM_CLI_GRADE_H

#include <lom/base.h>

/* What is said of one stage of a student's. Texts of mistakes are the table's, NULL where none agrees. */
typedef struct lom_verdict {
    int cases, corners;                          /* how many there are; the corner cases, which come first */
    int answered;                                /* below cases: the process ended, or was ended, in case `answered` */
    int right, right_corners;                    /* bit for bit */
    int first;                                   /* case that differs, -1: none */
    char asked[768], difference[192], last[768]; /* of the first one that differs; what was asked when it ended */
    const char *mistake, *rule, *source, *looks;
    double share; /* of the cases that show the mistake those in which the student's answer is the mistake's */
} lom_verdict;

int lom_grade_stages(void);
const char *lom_grade_stage(int stage); /* its name */
size_t lom_grade_size(void);            /* bytes that the answers of all cases have at most */
size_t lom_grade_picture_size(void);    /* bytes of the scene that a student's stage drew */

/* Compares the answers of docs/lessons/grade/run.c with the right ones. Any bytes are allowed. */
void lom_grade_answers(int stage, const unsigned char *bytes, size_t size, lom_verdict *verdict);
/* Writes a picture: the right scene, the student's, where they differ, in how many pixels. */
bool lom_grade_write_picture(const char *path, const uint8_t *student, size_t *pixels, lom_error *error);

#endif
