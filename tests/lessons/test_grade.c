/* Proves of what `lom grade` judges with (docs/lessons/grade): right stages are right; of the mistakes of the gallery each
 * is named by its answers alone, whichever stage it is in; cases are what they are on every run; and an answer that is cut
 * off, or no answer, is taken for what it is. */
#include "check.h"

#include "../../docs/lessons/grade/judge.c"

static unsigned char *bytes;

/* As run.c tells them; the number of bytes. */
static size_t write_answers(const struct stages *others, int stage)
{
    size_t size = 0;
    for (int i = 0; i < CASES; i++) {
        struct answer a;
        answer_by(others, stage, i, &a);
        size_t whole = offsetof(struct answer, number) + (size_t)a.count * sizeof a.number[0];
        memcpy(bytes + size, &a, whole);
        size += whole;
    }
    return size;
}

static int stage_of(const struct mistake *m)
{
    int stage = 0;
    while (strcmp(stage_names[stage], m->stage) != 0)
        stage++;
    return stage;
}

static void right_stages_are_right(void)
{
    for (int stage = 0; stage < STAGES; stage++) {
        lom_verdict v;
        lom_grade_answers(stage, bytes, write_answers(&right_stages, stage), &v);
        CHECK(v.right == CASES && v.right_corners == CORNERS && v.answered == CASES && v.first < 0 && v.rule == NULL,
              "%s: %d right", stage_names[stage], v.right);
    }
}

static void every_mistake_of_the_gallery_is_named(void)
{
    int named = 0;
    for (const struct mistake *m = mistakes; m < mistakes + MISTAKES; m++) {
        lom_verdict v;
        lom_grade_answers(stage_of(m), bytes, write_answers(&m->wrong, stage_of(m)), &v);
        bool is = v.mistake != NULL && strcmp(v.mistake, m->name) == 0;
        named += is;
        if (!is)
            printf("  %s is taken for %s (%.2f; first %d)\n", m->name, v.mistake != NULL ? v.mistake : "none", v.share,
                   v.first);
        CHECK(v.first >= 0 && v.asked[0] != '\0' && v.difference[0] != '\0', "%s is taken for right", m->name);
    }
    CHECK(named == MISTAKES, "%d of %d", named, MISTAKES);
}

static void corner_cases_come_first_and_show_most_mistakes(void)
{
    int shown = 0;
    for (const struct mistake *m = mistakes; m < mistakes + MISTAKES; m++) {
        lom_verdict v;
        lom_grade_answers(stage_of(m), bytes, write_answers(&m->wrong, stage_of(m)) / 8, &v);
        shown += v.first >= 0 && v.first < CORNERS;
    }
    CHECK(CASES >= 10000 && shown * 100 >= MISTAKES * 95, "%d of %d", shown, MISTAKES);
}

static void answers_that_are_cut_off_end_there(void)
{
    int stage = stage_of(&mistakes[MISTAKES - 1]);
    size_t size = write_answers(&right_stages, stage), one = size / CASES;
    lom_verdict v;
    for (size_t cut = 0; cut < 3 * one; cut++) {
        lom_grade_answers(stage, bytes, cut, &v);
        CHECK(v.answered == (int)(cut / one) && v.right == v.answered && v.last[0] != '\0', "%zu bytes: %d", cut,
              v.answered);
    }
    memset(bytes + 2 * one, 0xff, one); /* a count that none is */
    lom_grade_answers(stage, bytes, size, &v);
    CHECK(v.answered == 2, "%d", v.answered);
}

/* Answers whose last bit is another one here and there: no rule but that of rounding. */
static void roundings_are_told_from_mistakes(void)
{
    for (int stage = 0; stage < STAGES; stage++) {
        size_t size = 0;
        bool rounded = false;
        for (int i = 0; i < CASES; i++) {
            struct answer a;
            answer_by(&right_stages, stage, i, &a);
            double *last = &a.number[a.count - 1];
            if (i % 3 == 0 && *last != rint(*last) && fabs(*last) < 1e30) {
                *last *= 1 + 0x1p-24;
                rounded = true;
            }
            size_t whole = offsetof(struct answer, number) + (size_t)a.count * sizeof a.number[0];
            memcpy(bytes + size, &a, whole);
            size += whole;
        }
        lom_verdict v;
        lom_grade_answers(stage, bytes, size, &v);
        CHECK(!rounded || (v.mistake != NULL && strcmp(v.mistake, "rounding") == 0), "%s: %s", stage_names[stage],
              v.mistake != NULL ? v.mistake : "none");
    }
}

int main(int argc, char **argv)
{
    bytes = malloc(lom_grade_size());
    if (bytes == NULL)
        return 1;
    RUN(right_stages_are_right);
    RUN(every_mistake_of_the_gallery_is_named);
    RUN(corner_cases_come_first_and_show_most_mistakes);
    RUN(answers_that_are_cut_off_end_there);
    RUN(roundings_are_told_from_mistakes);
    free(bytes);
    return check_result();
}
