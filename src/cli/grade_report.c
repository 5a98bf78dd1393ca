/* Reports on students. In: what was found. Out: words, a table, JSON as Gradescope takes it, JUnit. Invariant: JSON and
 * XML are well formed whatever a compiler or a file's name says; a stage has two tests, its corner cases and the others. */
#include "json.h"
#include "paths.h"
#include "report.h"
#include "student.h"

#include <string.h>

enum { SCORE = 5 }; /* of each test */

/* Of a stage: part 0, the corner cases; part 1, the others. */
static bool is_right(const lom_graded *g, int part)
{
    const lom_verdict *v = &g->verdict;
    int others = v->right - v->right_corners;
    return part == 0 ? v->right_corners == v->corners : others == v->cases - v->corners && g->ending.how == LOM_ENDED;
}

static const char *const parts[2] = { "corner cases", "other cases" };

static void indent(FILE *out, const char *text)
{
    for (const char *line = text; *line != '\0'; line += strcspn(line, "\n"), line += *line == '\n')
        fprintf(out, "    %.*s\n", (int)strcspn(line, "\n"), line);
}

void lom_report_text(FILE *out, const lom_student *student)
{
    for (int i = 0; i < student->count; i++) {
        fprintf(out, "%s: %s: %s\n", student->file, lom_grade_stage(student->stages[i]->stage),
                student->stages[i]->right ? "right" : "not right");
        indent(out, student->stages[i]->text);
    }
}

/* Why a file could not be graded, in a line: the first thing that the compiler or the linker calls an error. */
static void put_refusal(FILE *out, const char *refusal)
{
    static const char *const signs[] = { "undefined reference", "multiple definition", "error: " };
    const char *found = NULL;
    for (int i = 0; i < 3 && found == NULL; i++)
        found = strstr(refusal, signs[i]);
    const char *line = found;
    while (line > refusal && line[-1] != '\n')
        line--;
    const char *place = line != NULL ? strchr(line, ':') : NULL; /* the file's name, which the row begins with */
    if (found != NULL && (place == NULL || place + 1 > found || *place == '\0'))
        place = found - 1;
    fprintf(out, "%.*s", (int)strcspn(refusal, "\n"), refusal);
    if (found != NULL)
        fprintf(out, " %.*s", (int)strcspn(place + 1, "\n"), place + 1);
    fputc('\n', out);
}

/* Of a stage that is not right: the rule, or else what the verdict's second line says of the crash or the case. */
static void put_cause(FILE *out, const lom_graded *g)
{
    const char *line = strchr(g->text, '\n');
    if (g->right)
        fputc('\n', out);
    else if (g->verdict.rule != NULL && g->verdict.answered == g->verdict.cases)
        fprintf(out, "%s\n", g->verdict.rule);
    else
        fprintf(out, "%.*s\n", line != NULL ? (int)strcspn(line + 1, "\n") : 0, line != NULL ? line + 1 : "");
}

void lom_report_row(FILE *out, const lom_student *student)
{
    if (student->count == 0) {
        fprintf(out, "%-24s %-16s %-10s %14s  ", lom_path_file(student->file), "-", "ungraded", "-");
        put_refusal(out, student->refusal);
    }
    for (int i = 0; i < student->count; i++) {
        const lom_graded *g = student->stages[i];
        const lom_verdict *v = &g->verdict;
        bool whole = v->answered == v->cases;
        const char *word = g->right                       ? "right"
                           : whole                        ? "not right"
                           : g->ending.how == LOM_ENDLESS ? "endless"
                                                          : "crashed";
        char cases[32];
        snprintf(cases, sizeof cases, "%d/%d", v->right, v->cases);
        fprintf(out, "%-24s %-16s %-10s %14s  ", lom_path_file(student->file), lom_grade_stage(g->stage), word, cases);
        put_cause(out, g);
    }
}

void lom_report_json(FILE *out, const lom_student *student)
{
    lom_json json = lom_json_begin(out);
    char *output =
        lom_path_print(NULL, "%s %s", student->file, student->refusal != NULL ? student->refusal : "was graded");
    int score = 0;
    for (int i = 0; i < student->count; i++)
        score += SCORE * (is_right(student->stages[i], 0) + is_right(student->stages[i], 1));
    lom_json_integer(&json, "score", score);
    lom_json_text(&json, "output", output != NULL ? output : student->file);
    lom_release(output);
    lom_json_nest(&json, "tests", '[');
    for (int i = 0; i < student->count; i++)
        for (int part = 0; part < 2; part++) {
            char name[64];
            const lom_graded *g = student->stages[i];
            bool right = is_right(g, part);
            lom_json_nest(&json, NULL, '{');
            snprintf(name, sizeof name, "%s: %s", lom_grade_stage(g->stage), parts[part]);
            lom_json_text(&json, "name", name);
            lom_json_integer(&json, "score", right ? SCORE : 0);
            lom_json_integer(&json, "max_score", SCORE);
            lom_json_text(&json, "status", right ? "passed" : "failed");
            lom_json_text(&json, "output", right ? "right, bit for bit" : g->text);
            lom_json_unnest(&json, '}');
        }
    lom_json_unnest(&json, ']');
    lom_json_nest(&json, "extra_data", '{'); /* by which a line of a class is found again */
    lom_json_text(&json, "file", student->file);
    lom_json_unnest(&json, '}');
    lom_json_end(&json);
}

void lom_report_junit(FILE *out, const lom_student *student)
{
    int failures = 0;
    for (int i = 0; i < 2 * student->count; i++)
        failures += !is_right(student->stages[i / 2], i % 2);
    fputs("  <testsuite name=\"", out);
    lom_put_escaped(out, student->file);
    fprintf(out, "\" tests=\"%d\" failures=\"%d\" errors=\"%d\">\n", student->count > 0 ? 2 * student->count : 1,
            failures, student->refusal != NULL);
    if (student->refusal != NULL) {
        fputs("    <testcase name=\"compiles\"><error message=\"", out);
        lom_put_escaped(out, student->refusal);
        fputs("\"/></testcase>\n", out);
    }
    for (int i = 0; i < 2 * student->count; i++) {
        const lom_graded *g = student->stages[i / 2];
        bool right = is_right(g, i % 2);
        fprintf(out, "    <testcase classname=\"%s\" name=\"%s\"%s", lom_grade_stage(g->stage), parts[i % 2],
                right ? "/>\n" : "><failure message=\"");
        if (!right) {
            lom_put_escaped(out, g->text);
            fputs("\"/></testcase>\n", out);
        }
    }
    fputs("  </testsuite>\n", out);
}
