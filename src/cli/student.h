/* A student's file: compiled, run, and what is to be said of it. student.c; the reports: grade_report.c. */
#ifndef LOM_CLI_STUDENT_H
#define LOM_CLI_STUDENT_H

#include "grade.h"
#include "processes.h"

#include <stdio.h>

/* One stage of a student's. */
typedef struct lom_graded {
    int stage;
    lom_ending ending;
    lom_verdict verdict;
    bool right;
    char *text; /* the verdict in words, a line each; freed with free */
} lom_graded;

enum { LOM_MOST_GRADED = 32 };

typedef struct lom_student {
    const char *file;
    char *refusal; /* why it could not be graded, NULL when it was; freed with free */
    int count;
    lom_graded *stages[LOM_MOST_GRADED];
} lom_student;

/* What compiles and what is compiled with. */
typedef struct lom_bench_of_grading {
    lom_temporary_folder folder;
    char lessons[4096], headers[4096], library[4096];
    int seconds; /* of processor time, a stage */
} lom_bench_of_grading;

/* Finds the lessons, and compiles what asks a student's stage. False, having said why, when it cannot be done. */
bool lom_open_grading(lom_bench_of_grading *bench, int seconds);
void lom_close_grading(lom_bench_of_grading *bench);

/* Grades a file; picture: of the first stage that is not right, else of the first, NULL for none. False, having said why,
 * when this machine does not let it; what is wrong with the file is in student. */
bool lom_grade_student(const lom_bench_of_grading *bench, const char *file, const char *picture, lom_student *student);
void lom_free_student(lom_student *student);

/* Reports: a student in words; a row a stage of a table; what Gradescope takes; JUnit's element of a file. */
void lom_report_text(FILE *out, const lom_student *student);
void lom_report_row(FILE *out, const lom_student *student);
void lom_report_json(FILE *out, const lom_student *student);
void lom_report_junit(FILE *out, const lom_student *student);

#endif
