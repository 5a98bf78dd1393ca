/* What compares a student's answers with the right ones, and names the rule that was broken. In: the answers of run.c, of
 * a process that may have ended too soon or written anything. Out: a verdict. Invariant: a stage is right when each of its
 * answers has the right bits; the rule is that of the mistake whose answers are the student's most often. */
#include "../mistakes/gallery.h"
#include "../mistakes/mistakes.h"
#include "cases.h"

#include <cli/grade.h>

/* Floats that differ by less than this, of 1 + their sizes, differ by the order of roundings alone. */
static const double rounding = 3e-7;

int lom_grade_stages(void)
{
    return STAGES;
}

const char *lom_grade_stage(int stage)
{
    return stage_names[stage];
}

size_t lom_grade_size(void)
{
    return CASES * sizeof(struct answer);
}

size_t lom_grade_picture_size(void)
{
    return (size_t)GALLERY_WIDTH * GALLERY_HEIGHT * 3;
}

/* The next answer of what the student's process wrote; false where it is not whole. */
static bool take_answer(const unsigned char **at, const unsigned char *end, struct answer *a)
{
    size_t head = offsetof(struct answer, number), left = (size_t)(end - *at);
    if (left < head)
        return false;
    memcpy(&a->count, *at, sizeof a->count);
    if (a->count < 0 || a->count > MOST_NUMBERS || left < head + (size_t)a->count * sizeof a->number[0])
        return false;
    memcpy(a->number, *at + head, (size_t)a->count * sizeof a->number[0]);
    *at += head + (size_t)a->count * sizeof a->number[0];
    return true;
}

static bool is_same_number(double a, double b)
{
    return memcmp(&a, &b, sizeof a) == 0 || (a != a && b != b);
}

/* The place of the first number that differs; -1: none. */
static int find_difference(const struct answer *a, const struct answer *b)
{
    for (int i = 0; i < a->count && i < b->count; i++)
        if (!is_same_number(a->number[i], b->number[i]))
            return i;
    return a->count == b->count ? -1 : (int)(a->count < b->count ? a->count : b->count);
}

/* Of the numbers at a place, 0: the same, 1: nothing in common; also where only one answer has a number there. */
static double distance_at(const struct answer *a, const struct answer *b, int i)
{
    if (i >= a->count || i >= b->count)
        return i >= a->count && i >= b->count ? 0 : 1;
    double x = a->number[i], y = b->number[i], d = fabs(x - y) / (1 + fabs(x) + fabs(y));
    return x == y || is_same_number(x, y) ? 0 : d <= 1 ? d : 1; /* not finite: 1 */
}

static double distance_between(const struct answer *a, const struct answer *b)
{
    double largest = 0;
    for (int i = 0; i < a->count || i < b->count; i++) {
        double d = distance_at(a, b, i);
        largest = d > largest ? d : largest;
    }
    return largest;
}

static void answer_by(const struct stages *others, int stage, int number, struct answer *a)
{
    static struct problem problem;
    const struct stages by = complete_stages(others);
    ask_case(stage, number, &problem);
    answer_case(&by, stage, &problem, a);
}

/* What is told of a number: its name, or its place behind those that have one. */
static void name_number(const char *names, int place, char *name, size_t room)
{
    int skipped = 0;
    for (; skipped < place && strchr(names, ' ') != NULL; skipped++)
        names = strchr(names, ' ') + 1;
    if (skipped < place)
        snprintf(name, room, "number %d of the answer", place + 1);
    else
        snprintf(name, room, "%.*s", (int)strcspn(names, " "), names);
}

static void tell_difference(int stage, int number, const struct answer *student, const struct answer *right,
                            lom_verdict *v)
{
    static struct problem problem;
    char name[64];
    int place = find_difference(student, right);
    name_number(questions[stage].numbers, place, name, sizeof name);
    v->first = number;
    if (place < student->count && place < right->count)
        snprintf(v->difference, sizeof v->difference, "%s is %.9g, right is %.9g", name, student->number[place],
                 right->number[place]);
    else
        snprintf(v->difference, sizeof v->difference, "the answer has %d numbers, the right one %d",
                 (int)student->count, (int)right->count);
    ask_case(stage, number, &problem);
    questions[stage].tell(&problem, v->asked, sizeof v->asked);
}

/* Of the numbers in which the student or the mistake is not right, the share in which both are alike; -1: there are none. */
static double agree_in_case(const struct answer *student, const struct answer *wrong, const struct answer *right)
{
    int agreed = 0, all = 0;
    for (int i = 0; i < student->count || i < wrong->count || i < right->count; i++) {
        double own = distance_at(student, right, i), apart = distance_at(student, wrong, i);
        if (own <= rounding && distance_at(wrong, right, i) <= rounding)
            continue;
        all++;
        agreed += own > rounding && (apart <= rounding || apart <= own / 4);
    }
    return all > 0 ? (double)agreed / all : -1;
}

/* The mean of that over the cases that show the mistake: 0 to 1. */
static double agree(const struct mistake *m, int stage, const unsigned char *bytes, size_t size)
{
    const unsigned char *at = bytes;
    struct answer student, right, wrong;
    double agreed = 0;
    int all = 0;
    for (int i = 0; i < CASES && take_answer(&at, bytes + size, &student); i++) {
        answer_by(&right_stages, stage, i, &right);
        answer_by(&m->wrong, stage, i, &wrong);
        double share = agree_in_case(&student, &wrong, &right);
        agreed += share > 0 ? share : 0;
        all += share >= 0;
    }
    return all > 0 ? agreed / all : 0;
}

static void name_rule(int stage, const unsigned char *bytes, size_t size, double largest, lom_verdict *v)
{
    for (const struct mistake *m = mistakes; m < mistakes + MISTAKES; m++) {
        double share = strcmp(m->stage, stage_names[stage]) == 0 ? agree(m, stage, bytes, size) : 0;
        if (share > v->share && share >= 0.5) {
            v->share = share;
            v->mistake = m->name;
            v->rule = m->rule;
            v->source = m->source;
            v->looks = m->looks;
        }
    }
    if (v->mistake == NULL && largest <= 10 * rounding) {
        v->mistake = "rounding";
        v->rule = "Each operation rounds once: the same bits come of the same operations in the same order.";
        v->source = "lesson determinism";
        v->looks = "Nothing to see; other bytes here and there.";
        v->share = 1;
    }
}

void lom_grade_answers(int stage, const unsigned char *bytes, size_t size, lom_verdict *v)
{
    const unsigned char *at = bytes;
    struct answer student, right;
    double largest = 0;
    *v = (lom_verdict){ .cases = CASES, .corners = CORNERS, .first = -1 };
    for (; v->answered < CASES && take_answer(&at, bytes + size, &student); v->answered++) {
        answer_by(&right_stages, stage, v->answered, &right);
        if (find_difference(&student, &right) < 0) {
            v->right_corners += v->answered < CORNERS;
            v->right++;
            continue;
        }
        double distance = distance_between(&student, &right);
        largest = distance > largest ? distance : largest;
        if (v->first < 0)
            tell_difference(stage, v->answered, &student, &right, v);
    }
    if (v->first >= 0)
        name_rule(stage, bytes, size, largest, v);
    if (v->answered < CASES) {
        static struct problem problem;
        ask_case(stage, v->answered, &problem);
        questions[stage].tell(&problem, v->last, sizeof v->last);
    }
}

/* The scene by the right stages, by the student's, and dark where they are alike and bright where not. */
bool lom_grade_write_picture(const char *path, const uint8_t *student, size_t *pixels, lom_error *error)
{
    enum { SCALE = 2, GAP = 8, WIDE = 3 * SCALE * GALLERY_WIDTH + 2 * GAP, HIGH = SCALE * GALLERY_HEIGHT };
    static uint8_t out[WIDE * HIGH][3];
    const lom_image image = {
        .width = WIDE, .height = HIGH, .depth = 1, .format = LOM_FORMAT_RGB8_SRGB, .pixels = out[0]
    };
    lom_image *scene = draw_gallery_image(&right_stages, error);
    *pixels = 0;
    memset(out, 255, sizeof out);
    for (int i = 0; i < WIDE * HIGH && scene != NULL; i++) {
        int part = i % WIDE / (SCALE * GALLERY_WIDTH + GAP), x = i % WIDE % (SCALE * GALLERY_WIDTH + GAP) / SCALE;
        size_t place = 3 * ((size_t)(i / WIDE / SCALE) * GALLERY_WIDTH + (size_t)x);
        if (x >= GALLERY_WIDTH)
            continue;
        const uint8_t *right = (const uint8_t *)scene->pixels + place, *own = student + place;
        bool differs = memcmp(right, own, 3) != 0;
        for (int c = 0; c < 3; c++)
            out[i][c] = part == 0 ? right[c] : part == 1 ? own[c] : differs ? 255 : right[c] / 4;
        *pixels +=
            part == 2 && differs && i % WIDE % (SCALE * GALLERY_WIDTH + GAP) % SCALE == 0 && i / WIDE % SCALE == 0;
    }
    bool done = scene != NULL && lom_write_image(path, NULL, &image, error);
    lom_free_image(scene);
    return done;
}
