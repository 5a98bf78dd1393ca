/* `lom lesson`. In: the name of a lesson, an exercise and an answer. Out: the list of lessons; where a lesson's text is,
 * and its picture; whether an answer is right. Invariant: answers are known by their hashes alone, so nothing here gives
 * one away (lesson_answers.h, which tests/lessons/remake.sh makes from what tests/lessons/test_answers.c computes). */
#include "commands.h"
#include "lessons.h"
#include "options.h"
#include "paths.h"

#include <lom/image.h>

#include <string.h>
#include <unistd.h>

struct lesson {
    const char *name, *title;
    int (*draw)(int argc, char **argv);
};

/* In the order in which they are read. */
static const struct lesson lessons[] = {
    { "triangle", "a picture is a grid of numbers, and a triangle three lines", lom_lesson_triangle },
    { "transforms", "moving, turning and scaling, and their order", lom_lesson_transforms },
    { "clip_space", "how far things become small: x, y, z and w", lom_lesson_clip_space },
    { "rasterization", "which pixels are a triangle's: every one exactly once", lom_lesson_rasterization },
    { "interpolation", "what a pixel gets from three vertices", lom_lesson_interpolation },
    { "depth", "which is nearer, and how exactly one knows", lom_lesson_depth },
    { "textures", "pictures on surfaces, and their levels", lom_lesson_textures },
    { "normals", "which way a surface faces, and why its matrix is another one", lom_lesson_normals },
    { "lights", "ambient, diffuse, specular: what a material looks like", lom_lesson_lights },
    { "pipeline", "the whole pipeline in one plain file: the map", lom_lesson_pipeline },
    { "targets", "drawing into a texture; mirrors and clip planes", lom_lesson_targets },
    { "water", "a lake in nine steps", lom_lesson_water },
    { "waves", "from a wind's spectrum to a sea with foam", lom_lesson_waves },
    { "clouds", "density, transmittance, scattering, impostors", lom_lesson_clouds },
    { "lanes", "many pixels at once: lanes, packets, tiles", lom_lesson_lanes },
    { "determinism", "the same bytes everywhere, and what breaks them", lom_lesson_determinism },
    { "trade", "how much error a millisecond buys", lom_lesson_trade },
    { "stage", "a stage of your own", lom_lesson_stage },
};
enum { LESSONS = sizeof lessons / sizeof lessons[0], IS_PICTURE = -1 };

/* What is known of an answer: of a number, which is rounded to `decimals`, or of a picture. Exercise 0 is the lesson's
 * own picture, the answer to none. */
struct answer {
    const char *lesson;
    int exercise, decimals;
    uint64_t hash;
    bool right;
    const char *sentence;
};

static const struct answer answers[] = {
#include "lesson_answers.h"
};
enum { ANSWERS = sizeof answers / sizeof answers[0] };

struct values {
    const char *output;
};

static const lom_option options[] = {
    { "output", 'o', LOM_OPTION_TEXT, offsetof(struct values, output), "FILE", 0, 0, "write the lesson's picture" },
};

static const lom_command_line line = {
    .name = "lesson",
    .arguments = "[NAME [EXERCISE ANSWER]]",
    .summary = "list the lessons, draw one, check the answer to an exercise",
    .details = "Without a name it lists the lessons. An answer is a number, or the file of a picture, as the exercise\n"
               "says; exit status 0 when it is right, 1 when it is not.",
    .options = options,
    .option_count = sizeof options / sizeof options[0],
    .maximum_arguments = 3,
};

const char *lom_find_lessons(char path[4096])
{
    static const char *const beside[] = { "../share/lom/lessons", "../docs/lessons" };
    if (lom_path_by_program(beside, 2, path) != NULL)
        return path;
    snprintf(path, 4096, "docs/lessons");
    return access(path, R_OK) == 0 ? path : NULL;
}

static int list_lessons(void)
{
    char path[4096];
    const char *folder = lom_find_lessons(path);
    for (int i = 0; i < LESSONS; i++)
        printf("  %-14s %s\n", lessons[i].name, lessons[i].title);
    printf("\n`lom lesson NAME` says where its text is, `lom lesson NAME -o OUT.png` draws its picture, and\n"
           "`lom lesson NAME EXERCISE ANSWER` checks an answer.%s%s%s\n",
           folder != NULL ? " Begin with " : "", folder != NULL ? folder : "", folder != NULL ? "/README.md." : "");
    return LOM_EXIT_DONE;
}

static const struct lesson *find_lesson(const char *name)
{
    const char *names[LESSONS];
    for (int i = 0; i < LESSONS; i++) {
        names[i] = lessons[i].name;
        if (strcmp(name, names[i]) == 0)
            return &lessons[i];
    }
    const char *near = lom_nearest_name(name, strlen(name), names, LESSONS);
    lom_complain(near != NULL ? "there is no lesson \"%s\" (did you mean \"%s\"?)"
                              : "there is no lesson \"%s\"; `lom lesson` lists them.",
                 name, near);
    return NULL;
}

static int count_exercises(const char *lesson)
{
    int count = 0;
    for (int i = 0; i < ANSWERS; i++)
        if (strcmp(answers[i].lesson, lesson) == 0 && answers[i].exercise > count)
            count = answers[i].exercise;
    return count;
}

/* The line that compiles a changed program: beside a build in lom's source, which pkg-config does not know, by its files. */
static void tell_compiling(void)
{
    static const char *const archives[] = { "liblom.a" }, *const headers[] = { "../include" };
    char archive[4096], include[4096];
    if (lom_path_by_program(archives, 1, archive) != NULL && lom_path_by_program(headers, 1, include) != NULL)
        printf("  compile    cc -O2 -ffp-contract=off -I%s mine.c %s -lm -lpthread -o mine\n", include, archive);
    else
        printf("  compile    cc -O2 mine.c $(pkg-config --cflags --libs lom) -lm -o mine\n");
    printf("  run        ./mine mine.png\n");
}

static int tell_lesson(const struct lesson *lesson)
{
    char path[4096];
    const char *folder = lom_find_lessons(path), *name = lesson->name;
    int count = count_exercises(name);
    printf("%s: %s\n\n", name, lesson->title);
    if (folder != NULL)
        printf("  text       %s/%s/README.md\n  program    %s/%s/%s.c\n", folder, name, folder, name, name);
    else
        printf("  text       docs/lessons/%s/README.md of lom's source, which is not installed here\n", name);
    printf("  picture    lom lesson %s -o %s.png\n", name, name);
    if (folder != NULL)
        printf("  copy       cp %s/%s/%s.c mine.c\n", folder, name, name);
    tell_compiling();
    if (count > 0)
        printf("  exercises  %d, at the end of the text: lom lesson %s 1 ANSWER\n", count, name);
    return LOM_EXIT_DONE;
}

/* The hash of what was answered; false, having said why, when it is no answer. */
static bool hash_answer(const struct answer *asked, const char *text, uint64_t *hash)
{
    double value;
    if (asked->decimals == IS_PICTURE) {
        lom_error error = { .code = LOM_OK };
        lom_image *image = lom_read_image(text, &error);
        *hash = image == NULL ? 0 : lom_hash_image(image);
        lom_free_image(image);
        if (image == NULL)
            lom_complain("the answer is the file of a picture: %s", error.text);
        return image != NULL;
    }
    if (text[0] == '\0' || lom_parse_double(text, strlen(text), &value) != strlen(text) || !(value * value < 1e24)) {
        if (asked->decimals == 0)
            lom_complain("\"%s\" is no number; the answer to this exercise is a whole one.", text);
        else
            lom_complain("\"%s\" is no number; the answer to this exercise is one with %d decimals behind a point, "
                         "like %.*f.",
                         text, asked->decimals, asked->decimals, 12.345678);
        return false;
    }
    for (int i = 0; i < asked->decimals; i++)
        value *= 10;
    char rounded[96];
    snprintf(rounded, sizeof rounded, "%.20s %d %lld", asked->lesson, asked->exercise,
             (long long)lom_int64_of(lom_double_floor(value + 0.5)));
    *hash = lom_hash_bytes(LOM_HASH_START, rounded, strlen(rounded));
    return true;
}

static int check_answer(const struct lesson *lesson, const char *exercise, const char *text)
{
    const struct answer *asked = NULL;
    double number;
    size_t length = lom_parse_double(exercise, strlen(exercise), &number);
    bool is_number = length > 0 && exercise[length] == '\0' && number >= 1;
    for (int i = 0; i < ANSWERS && is_number && asked == NULL; i++)
        if (strcmp(answers[i].lesson, lesson->name) == 0 && answers[i].exercise == number)
            asked = &answers[i];
    if (asked == NULL)
        return lom_complain("the lesson %s has no exercise %s; it has %d.", lesson->name, exercise,
                            count_exercises(lesson->name));
    uint64_t hash;
    if (!hash_answer(asked, text, &hash))
        return LOM_EXIT_FAILED;
    for (const struct answer *a = answers; a < answers + ANSWERS; a++)
        if (strcmp(a->lesson, asked->lesson) == 0 && a->hash == hash &&
            (a->exercise == asked->exercise || (a->exercise == 0 && asked->decimals == IS_PICTURE))) {
            printf("%s %s\n", a->right ? "Right." : "Not right.", a->sentence);
            return a->right ? LOM_EXIT_DONE : LOM_EXIT_DIFFERS;
        }
    printf("Not right.\n");
    return LOM_EXIT_DIFFERS;
}

/* Tells whether a lesson's picture is the recorded one. */
static int draw_lesson(const struct lesson *lesson, const char *path)
{
    static const struct answer own = { .decimals = IS_PICTURE };
    char *argv[] = { (char *)(uintptr_t)lesson->name, (char *)(uintptr_t)path, NULL };
    uint64_t hash;
    int status = lesson->draw(2, argv);
    if (status != LOM_EXIT_DONE || !hash_answer(&own, path, &hash))
        return LOM_EXIT_FAILED;
    printf("%s: the picture of the lesson %s, hash %016llx\n", path, lesson->name, (unsigned long long)hash);
    for (int i = 0; i < ANSWERS; i++)
        if (strcmp(answers[i].lesson, lesson->name) == 0 && answers[i].exercise == 0 && answers[i].hash == hash)
            return LOM_EXIT_DONE;
    lom_complain("%s is another picture than the one of picture version %d.", path, LOM_PICTURE_VERSION);
    return LOM_EXIT_DIFFERS;
}

int lom_command_lesson(int argc, char **argv)
{
    struct values values = { .output = NULL };
    lom_arguments arguments;
    int status;
    if (!lom_parse_options(&line, argc, argv, &values, &arguments, &status))
        return status;
    if (arguments.count == 0)
        return values.output == NULL ? list_lessons() : lom_complain("-o needs the name of a lesson.");
    const struct lesson *lesson = find_lesson(arguments.items[0]);
    if (lesson == NULL)
        return LOM_EXIT_FAILED;
    if (arguments.count == 2)
        return lom_complain("exercise %s needs an answer: lom lesson %s %s ANSWER.", arguments.items[1], lesson->name,
                            arguments.items[1]);
    if (arguments.count == 3)
        return values.output == NULL ? check_answer(lesson, arguments.items[1], arguments.items[2])
                                     : lom_complain("-o draws the lesson's picture; an answer is none.");
    return values.output == NULL ? tell_lesson(lesson) : draw_lesson(lesson, values.output);
}
