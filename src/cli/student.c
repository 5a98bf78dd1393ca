/* A student's file. In: C source that defines functions of docs/lessons/grade/student.h. Out: what `lom grade` says of
 * each. Invariant: the student's code runs in a process of its own, within bounds, and says nothing here but answers,
 * which are compared here. */
#include "student.h"

#include "lessons.h"
#include "options.h"
#include "paths.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MOST_WORDS = 48, MOST_SAID = 1 << 16, CLOCK = 10 }; /* CLOCK: seconds that may pass for one of processor time */

/* What pictures depend on (docs/numerics.md), and what makes a call of no function an error. */
static const char *const flags[] = { "-std=gnu11",
                                     "-O1",
                                     "-pipe",
                                     "-fwrapv",
                                     "-ffp-contract=off",
                                     "-fno-math-errno",
                                     "-fno-trapping-math",
                                     "-Werror=implicit-function-declaration" };
enum { FLAGS = sizeof flags / sizeof flags[0] };

/* $CC, which may be several words, or cc, and the flags; the number of words. */
static int begin_command(const char *words[MOST_WORDS], char compiler[1024])
{
    const char *given = getenv("CC");
    int count = 0;
    snprintf(compiler, 1024, "%s", given != NULL && given[0] != '\0' ? given : "cc");
    for (char *rest = compiler; count < MOST_WORDS / 2 && *(rest += strspn(rest, " ")) != '\0';) {
        words[count++] = rest;
        rest += strcspn(rest, " ");
        if (*rest != '\0')
            *rest++ = '\0';
    }
    for (int i = 0; i < FLAGS; i++)
        words[count++] = flags[i];
    return count;
}

/* Runs a command of the compiler's; *said: what it complained of, freed with free, NULL when it did its work. False,
 * having said why, when it could not be run. */
static bool compile(const char *const words[MOST_WORDS], char **said)
{
    const lom_bounds bounds = { .descriptor = 2, .seconds = 300, .bytes = MOST_SAID };
    lom_error error = { .code = LOM_OK };
    lom_ending ending;
    size_t size;
    char *argv[MOST_WORDS];
    unsigned char *output = malloc(MOST_SAID + 1);
    for (int i = 0; i < MOST_WORDS; i++)
        argv[i] = (char *)(uintptr_t)words[i];
    *said = NULL;
    if (output == NULL || !lom_run_process(argv, &bounds, output, &size, &ending, &error)) {
        free(output);
        lom_complain("%s.", output == NULL ? "no memory is left" : error.text);
        return false;
    }
    output[size] = '\0';
    if (ending.how == LOM_ENDED && ending.number == 0)
        free(output);
    else if (ending.how == LOM_ENDED && ending.number == 127 && size == 0) {
        free(output);
        lom_complain("there is no compiler \"%s\"; install one, or name it in CC.", words[0]);
        return false;
    } else
        *said = (char *)output;
    return true;
}

/* Compiles one file to an object beside the others. What asks runs as long as it compiles when it is not optimised. A
 * student's file gets student.h whether it includes it or not: else a function of other types would be called as if it
 * had the right ones. A main with which the student tries the function is one function more. */
static bool compile_file(const lom_bench_of_grading *bench, const char *file, const char *object, bool by_student,
                         char **said)
{
    const char *words[MOST_WORDS] = { NULL };
    char compiler[1024], out[640], own[4200];
    int count = begin_command(words, compiler);
    snprintf(out, sizeof out, "%s/%s", bench->folder.path, object);
    snprintf(own, sizeof own, "%s/grade", bench->lessons);
    const char *const student[] = { "-O1", "-include", "student.h", "-DLOM_GRADED" };
    const char *const more[] = { "-O0", "-I", bench->headers, "-I", own, "-c", "-o", out, "-x", "c", file };
    for (size_t i = 0; i < sizeof more / sizeof more[0]; i++)
        words[count++] = more[i];
    for (size_t i = 0; by_student && i < sizeof student / sizeof student[0]; i++)
        words[count++] = student[i];
    return compile(words, said);
}

static bool link_student(const lom_bench_of_grading *bench, char **said)
{
    const char *words[MOST_WORDS] = { NULL };
    char compiler[1024], path[3][640];
    static const char *const names[] = { "student", "run.o", "student.o" };
    int count = begin_command(words, compiler);
    for (int i = 0; i < 3; i++)
        snprintf(path[i], sizeof path[i], "%s/%s", bench->folder.path, names[i]);
    const char *const more[] = { "-o", path[0], path[1], path[2], bench->library, "-lm", "-lpthread" };
    for (size_t i = 0; i < sizeof more / sizeof more[0]; i++)
        words[count++] = more[i];
    return compile(words, said);
}

bool lom_open_grading(lom_bench_of_grading *bench, int seconds)
{
    static const char *const headers[] = { "../include" };
    static const char *const libraries[] = { "liblom.a", "../lib/liblom.a" };
    lom_error error = { .code = LOM_OK };
    char source[4200], *said;
    bench->folder.held = -1;
    bench->seconds = seconds;
    if (lom_find_lessons(bench->lessons) == NULL)
        return lom_complain("the lessons are not installed (share/lom/lessons), by which stages are graded.") ==
               LOM_EXIT_DONE;
    if (lom_path_by_program(headers, 1, bench->headers) == NULL)
        snprintf(bench->headers, sizeof bench->headers, "include");
    if (lom_path_by_program(libraries, 2, bench->library) == NULL)
        snprintf(bench->library, sizeof bench->library, "-llom");
    if (!lom_open_temporary_folder(&bench->folder, &error))
        return lom_complain_error(&error) == LOM_EXIT_DONE;
    snprintf(source, sizeof source, "%s/grade/run.c", bench->lessons);
    bool done = compile_file(bench, source, "run.o", false, &said);
    if (said != NULL)
        done = lom_complain("%s does not compile:\n%s", source, said) == LOM_EXIT_DONE;
    free(said);
    if (!done)
        lom_close_grading(bench);
    return done;
}

void lom_close_grading(lom_bench_of_grading *bench)
{
    lom_close_temporary_folder(&bench->folder);
}

/* Runs the student's program with at most two words; output: of at most `bytes`, freed with free, NULL, having said
 * why, on failure. */
static unsigned char *ask_student(const lom_bench_of_grading *bench, int stage, const char *what, size_t bytes,
                                  size_t *size, lom_ending *ending)
{
    const lom_bounds bounds = {
        .descriptor = 3, .seconds = bench->seconds * CLOCK, .processor_time = bench->seconds, .bytes = bytes
    };
    lom_error error = { .code = LOM_OK };
    char path[640], number[16], word[16];
    snprintf(path, sizeof path, "%s/student", bench->folder.path);
    snprintf(number, sizeof number, "%d", stage);
    snprintf(word, sizeof word, "%s", what != NULL ? what : "");
    char *argv[] = { path, stage >= 0 ? number : NULL, what != NULL ? word : NULL, NULL };
    unsigned char *output = malloc(bytes);
    if (output != NULL && lom_run_process(argv, &bounds, output, size, ending, &error))
        return output;
    lom_complain("%s.", output == NULL ? "no memory is left" : error.text);
    free(output);
    return NULL;
}

/* The verdict in words. */
static void put_in_words(lom_graded *g, int seconds)
{
    const lom_verdict *v = &g->verdict;
    size_t size;
    FILE *out = open_memstream(&g->text, &size);
    if (out == NULL)
        return;
    if (g->right)
        fprintf(out, "right in all %d cases, bit for bit\n", v->cases);
    else
        fprintf(out, "right in %d of %d cases, in %d of the %d corner cases\n", v->right, v->cases, v->right_corners,
                v->corners);
    if (v->answered < v->cases) {
        if (g->ending.how == LOM_ENDLESS)
            fprintf(out, "did not end within %d s in case %d", seconds, v->answered);
        else if (g->ending.how == LOM_KILLED)
            fprintf(out, "crashed with %s in case %d", lom_name_signal(g->ending.number), v->answered);
        else
            fprintf(out, "ended the program with status %d in case %d", g->ending.number, v->answered);
        fprintf(out, ": %s\n", v->last);
    }
    if (v->first >= 0)
        fprintf(out, "first difference in case %d: %s\n  asked: %s\n", v->first, v->difference, v->asked);
    if (v->mistake != NULL)
        fprintf(out, "probably broken: %s\n  %s (%s; so in %.0f %% of the cases that show it). %s\n", v->rule,
                v->mistake, v->source, v->share * 100, v->looks);
    else if (v->first >= 0)
        fprintf(out, "probably broken: no rule that is known; begin with the case above\n");
    fclose(out);
}

static bool grade_stage(const lom_bench_of_grading *bench, int stage, lom_student *student)
{
    lom_graded *g = calloc(1, sizeof *g);
    size_t size;
    if (g == NULL)
        return lom_complain("no memory is left.") == LOM_EXIT_DONE;
    student->stages[student->count++] = g;
    g->stage = stage;
    unsigned char *answers = ask_student(bench, stage, NULL, lom_grade_size(), &size, &g->ending);
    if (answers == NULL)
        return false;
    lom_grade_answers(stage, answers, size, &g->verdict);
    free(answers);
    g->right = g->verdict.right == g->verdict.cases && g->ending.how == LOM_ENDED;
    put_in_words(g, bench->seconds);
    return g->text != NULL || lom_complain("no memory is left.") == LOM_EXIT_DONE;
}

static bool draw_difference(const lom_bench_of_grading *bench, const lom_student *student, const char *path)
{
    int shown = 0;
    while (shown < student->count - 1 && student->stages[shown]->right)
        shown++;
    lom_graded *g = student->stages[shown]->right ? student->stages[0] : student->stages[shown];
    lom_error error = { .code = LOM_OK };
    lom_ending ending;
    size_t size, pixels, old = strlen(g->text);
    char line[512];
    unsigned char *scene = ask_student(bench, g->stage, "draw", lom_grade_picture_size(), &size, &ending);
    if (scene == NULL)
        return false;
    if (size < lom_grade_picture_size())
        snprintf(line, sizeof line, "no picture: the scene was not drawn to its end\n");
    else if (!lom_grade_write_picture(path, scene, &pixels, &error)) {
        free(scene);
        return lom_complain_error(&error) == LOM_EXIT_DONE;
    } else
        snprintf(line, sizeof line, "picture: %.400s: the right scene, yours, and where they differ: %zu pixels\n",
                 path, pixels);
    free(scene);
    char *longer = realloc(g->text, old + strlen(line) + 1);
    if (longer == NULL)
        return lom_complain("no memory is left.") == LOM_EXIT_DONE;
    memcpy(longer + old, line, strlen(line) + 1);
    g->text = longer;
    return true;
}

static char *refuse(const char *format, const char *text)
{
    size_t room = strlen(format) + strlen(text) + 1;
    char *refusal = malloc(room);
    if (refusal != NULL)
        snprintf(refusal, room, "%s%s", format, text);
    return refusal;
}

static bool is_of_name(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/* The stage that a name before a bracket in the source was probably meant for: a stage's own name, or nearly one behind
 * "student_"; NULL for none. found: the name as it stands there. */
static const char *meant_stage(const char *source, char found[64])
{
    static const char prefix[] = "student_";
    const char *names[LOM_MOST_GRADED];
    int count = lom_grade_stages();
    for (int i = 0; i < count; i++)
        names[i] = lom_grade_stage(i);
    for (const char *p = source; *p != '\0'; p += *p != '\0') {
        size_t length = 0;
        while (is_of_name(p[length]))
            length++;
        const char *behind = p + length + strspn(p + length, " "), *meant = NULL;
        bool prefixed = length >= sizeof prefix && strncmp(p, prefix, sizeof prefix - 1) == 0;
        for (int i = 0; i < count && !prefixed; i++)
            if (strlen(names[i]) == length && strncmp(names[i], p, length) == 0)
                meant = names[i];
        if (prefixed)
            meant = lom_nearest_name(p + sizeof prefix - 1, length - (sizeof prefix - 1), names, (size_t)count);
        if (*behind == '(' && meant != NULL) {
            snprintf(found, 64, "%.*s", (int)(length < 63 ? length : 63), p);
            return meant;
        }
        p += length;
    }
    return NULL;
}

/* Why a file without a stage could not be graded. */
static char *refuse_without_stage(const char *path)
{
    char found[64] = "", hint[256];
    lom_bytes source = lom_read_file(path, 1 << 24, NULL);
    const char *meant = source.data != NULL ? meant_stage((const char *)source.data, found) : NULL;
    if (meant != NULL)
        snprintf(hint, sizeof hint, "call %s student_%s", found, meant);
    else
        snprintf(hint, sizeof hint, "name it student_covers, student_clip ... as docs/lessons/grade/student.h does");
    lom_release(source.data);
    return refuse("has no function whose stage is known: ", hint);
}

bool lom_grade_student(const lom_bench_of_grading *bench, const char *file, const char *picture, lom_student *student)
{
    char *said = NULL, path[4200];
    size_t size = 0;
    lom_ending ending;
    *student = (lom_student){ .file = file };
    snprintf(path, sizeof path, "%s%s", file[0] == '-' ? "./" : "", file);
    if (access(path, R_OK) != 0) {
        student->refusal = refuse("cannot be read", "");
        return student->refusal != NULL;
    }
    if (!compile_file(bench, path, "student.o", true, &said) || (said == NULL && !link_student(bench, &said)))
        return false;
    if (said != NULL) {
        student->refusal = refuse("does not compile:\n", said);
        free(said);
        return student->refusal != NULL;
    }
    unsigned char *written = ask_student(bench, -1, NULL, (size_t)lom_grade_stages(), &size, &ending);
    bool done = written != NULL;
    for (int i = 0; done && i < lom_grade_stages() && size == (size_t)lom_grade_stages(); i++)
        if (written[i] != 0)
            done = grade_stage(bench, i, student);
    free(written);
    if (done && student->count == 0)
        student->refusal = refuse_without_stage(path);
    return done && (student->count == 0 || picture == NULL || draw_difference(bench, student, picture));
}

void lom_free_student(lom_student *student)
{
    for (int i = 0; i < student->count; i++) {
        free(student->stages[i]->text);
        free(student->stages[i]);
    }
    free(student->refusal);
}
