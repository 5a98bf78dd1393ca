/* `lom grade`. In: students' files. Out: a verdict on each of their stages, in words, and in the forms that autograders
 * take. Invariant: nothing is written but what was asked for, whatever a student's code does. */
#include "commands.h"
#include "options.h"
#include "report.h"
#include "student.h"

struct values {
    const char *output, *json, *junit;
    lom_option_integers seconds;
};

static const lom_option options[] = {
    { "output", 'o', LOM_OPTION_TEXT, offsetof(struct values, output), "FILE", 0, 0,
      "write a picture, of one student: right, the student's, where they differ" },
    { "json", 0, LOM_OPTION_TEXT, offsetof(struct values, json), "FILE", 0, 0,
      "write Gradescope's results.json; of several students, an object a line" },
    { "junit", 0, LOM_OPTION_TEXT, offsetof(struct values, junit), "FILE", 0, 0, "write JUnit's XML" },
    { "seconds", 0, LOM_OPTION_INTEGER, offsetof(struct values, seconds), "N", 1, 3600,
      "processor time a stage may take (2)" },
};

static const lom_command_line line = {
    .name = "grade",
    .arguments = "STUDENT.c...",
    .summary = "compare a student's stage of the pipeline with the right one, name the broken rule",
    .details =
        "A student's file includes \"student.h\" and defines student_covers, or another function that is declared\n"
        "there (docs/lessons/grade). It is compiled with $CC or cc, runs in a process of its own, and answers more\n"
        "than 10000 cases, corner cases first, which are compared bit for bit. Several students make a table.\n"
        "Exit status 0 when all is right, 1 when something is not, 2 when a file could not be graded.",
    .options = options,
    .option_count = sizeof options / sizeof options[0],
    .minimum_arguments = 1,
    .maximum_arguments = -1,
};

/* The status that a student's file gives; what is said of it is printed. */
static int report_student(const lom_student *student, bool in_table)
{
    int status = LOM_EXIT_DONE;
    for (int i = 0; i < student->count; i++)
        status = student->stages[i]->right ? status : LOM_EXIT_DIFFERS;
    if (in_table)
        lom_report_row(stdout, student);
    else
        lom_report_text(stdout, student);
    if (student->refusal == NULL)
        return status;
    fflush(stdout);
    return lom_complain("%s %s", student->file, student->refusal);
}

static int grade_all(const lom_bench_of_grading *bench, const lom_arguments *files, const struct values *values,
                     struct lom_report reports[2])
{
    int worst = LOM_EXIT_DONE, count[LOM_EXIT_FAILED + 1] = { 0 };
    if (files->count > 1)
        printf("%-24s %-16s %-10s %14s  %s\n", "student", "stage", "verdict", "right cases",
               "rule that is probably broken, or what happened");
    if (reports[1].out != NULL)
        lom_begin_junit(reports[1].out);
    for (int i = 0; i < files->count; i++) {
        lom_student student;
        bool done = lom_grade_student(bench, files->items[i], values->output, &student);
        int status = done ? report_student(&student, files->count > 1) : LOM_EXIT_FAILED;
        if (done && reports[0].out != NULL)
            lom_report_json(reports[0].out, &student);
        if (done && reports[1].out != NULL)
            lom_report_junit(reports[1].out, &student);
        lom_free_student(&student);
        worst = status > worst ? status : worst;
        count[status]++;
        fflush(stdout);
        if (!done)
            return worst;
    }
    if (files->count > 1)
        printf("%d files: %d right, %d wrong, %d could not be graded\n", files->count, count[LOM_EXIT_DONE],
               count[LOM_EXIT_DIFFERS], count[LOM_EXIT_FAILED]);
    if (reports[1].out != NULL)
        lom_end_junit(reports[1].out);
    return lom_write_report(&reports[0]) && lom_write_report(&reports[1]) ? worst : LOM_EXIT_FAILED;
}

int lom_command_grade(int argc, char **argv)
{
    struct values values = { .output = NULL };
    lom_arguments arguments;
    lom_bench_of_grading bench;
    int status;
    if (!lom_parse_options(&line, argc, argv, &values, &arguments, &status))
        return status;
    if (values.output != NULL && arguments.count > 1)
        return lom_complain("-o draws the picture of one student; %d files were given.", arguments.count);
    struct lom_report reports[2] = { { .path = values.json }, { .path = values.junit } };
    status = LOM_EXIT_FAILED;
    if (lom_open_report(&reports[0]) && lom_open_report(&reports[1]) &&
        lom_open_grading(&bench, values.seconds.given ? (int)values.seconds.value[0] : 2)) {
        status = grade_all(&bench, &arguments, &values, reports);
        lom_close_grading(&bench);
    }
    lom_drop_report(&reports[0]);
    lom_drop_report(&reports[1]);
    return status;
}
