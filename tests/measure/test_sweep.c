/* Proves of sweeps: a dial that claims to change speed alone and does not is caught; those of the program are equal;
 * the scene's own setting is not tried again; what cannot be drawn is told and ends nothing; the front holds no
 * trial that another beats; against a reference that a setting draws, that setting has no error; CSV has a line a
 * trial. */
#include "check.h"
#include "measure/sweep_front.h"

#include <stdlib.h>
#include <string.h>

static const char *const changes[] = { "output.format=rgb8" };

/* A subject that is drawn in a millisecond. */
static lom_subject small_subject(void)
{
    return (lom_subject){ .path = "assets/scenes/lake.toml",
                          .changes = changes,
                          .change_count = 1,
                          .frame = { .width = 32, .height = 18 },
                          .device = { .threads = 1, .lanes = 4 } };
}

static lom_image *draw(const lom_subject *subject, const lom_choices *choices)
{
    lom_error error = { 0 };
    lom_drawer drawer = { .scene = NULL };
    lom_image *picture =
        lom_set_drawer(&drawer, subject, choices, &error) ? lom_draw_subject(&drawer, subject, &error) : NULL;
    CHECK(picture != NULL, "%s", error.text);
    lom_end_drawer(&drawer);
    return picture;
}

/* Sweeps some dials against what `choices` draw. */
static bool sweep_dials(const lom_dial *const *dials, size_t count, const lom_choices *choices, int combined,
                        lom_sweep *sweep, lom_image **reference)
{
    lom_error error = { 0 };
    const lom_subject subject = small_subject();
    *reference = draw(&subject, choices);
    const lom_sweep_desc desc = { .subject = subject,
                                  .whole = subject,
                                  .reference = *reference,
                                  .reference_name = "test",
                                  .dials = dials,
                                  .dial_count = count,
                                  .pairs = 1,
                                  .combined = combined };
    const bool done = *reference != NULL && lom_run_sweep(&desc, sweep, &error);
    CHECK(done, "%s", error.text);
    return done;
}

static void a_dial_that_breaks_equality_is_caught(void)
{
    static const char *const names[] = { "scissor", "threads", "crop", "tile" };
    lom_dials dials;
    lom_error error = { 0 };
    const lom_choices none = { .count = 0 };
    lom_sweep sweep;
    lom_image *reference;
    const lom_trial *first = NULL;
    lom_list_dials(&dials);
    /* The exposure says of itself that it changes no byte. */
    lom_dial fake = { .name = "fake",
                      .row = { .approximates = "nothing", .settings = "0 1", .reference = LOM_DIAL_EQUAL } };
    CHECK(lom_find_scene_key("output.exposure", &fake.key));
    const lom_dial *chosen[5] = { &fake };
    for (int i = 0; i < 4; i++)
        chosen[1 + i] = lom_find_dial(&dials, names[i], &error);
    if (sweep_dials(chosen + 1, 4, &none, 0, &sweep, &reference)) {
        CHECK(lom_count_unequal(&sweep, &first) == 0 && sweep.count > 8, "%zu trials", sweep.count);
        lom_free_sweep(&sweep);
    }
    lom_free_image(reference);
    if (sweep_dials(chosen, 5, &none, 0, &sweep, &reference)) {
        CHECK(lom_count_unequal(&sweep, &first) == 1 && first != NULL && first->choices.choice[0].dial == &fake &&
              first->error.pixels > 0);
        lom_free_sweep(&sweep);
    }
    lom_free_image(reference);
}

static void the_reference_has_no_error(void)
{
    lom_dials dials;
    lom_error error = { 0 };
    lom_list_dials(&dials);
    const lom_dial *chosen[] = { lom_find_dial(&dials, "shading", &error), lom_find_dial(&dials, "water", &error) };
    const lom_choices flat = { .count = 1, .choice = { { chosen[0], "flat" } } };
    char text[LOM_LONGEST_TRIAL];
    lom_sweep sweep;
    lom_image *reference;
    int found = 0;
    if (!sweep_dials(chosen, 2, &flat, 2, &sweep, &reference))
        return;
    for (size_t i = 0; i < sweep.count; i++) {
        const lom_trial *t = &sweep.trial[i];
        lom_print_trial(text, t);
        CHECK(strstr(text, "phong") == NULL && strstr(text, "planar") == NULL, "%s is what the scene has", text);
        if (strcmp(text, "shading=flat") == 0) {
            found++;
            CHECK(t->error.pixels == 0 && t->error.flip == 0 && t->error.ssim == 1 && t->error.max_delta == 0);
        }
    }
    CHECK(found == 1 && sweep.trial[0].is_default && sweep.trial[0].error.pixels > 0);
    lom_free_sweep(&sweep);
    lom_free_image(reference);
}

static void what_is_refused_is_told(void)
{
    const lom_choices none = { .count = 0 };
    lom_sweep sweep;
    lom_image *reference;
    lom_dial fake = { .name = "samples", .row = { .approximates = "a pixel", .settings = "1 3 2" } };
    CHECK(lom_find_scene_key("output.samples", &fake.key));
    const lom_dial *chosen[] = { &fake };
    if (!sweep_dials(chosen, 1, &none, 0, &sweep, &reference))
        return;
    CHECK(sweep.count == 3 && strstr(sweep.trial[1].failed, "1, 2, 4, 8 or 16 samples") != NULL &&
              !sweep.trial[1].on_front && sweep.trial[2].failed[0] == 0,
          "%zu trials: %s", sweep.count, sweep.count > 1 ? sweep.trial[1].failed : "");
    char *csv = NULL;
    size_t size = 0, lines = 0;
    FILE *out = open_memstream(&csv, &size);
    if (out != NULL) {
        lom_print_sweep_csv(out, &sweep);
        fclose(out);
    }
    for (size_t i = 0; i < size; i++)
        lines += csv[i] == '\n';
    CHECK(lines == sweep.count + 1, "%zu lines", lines);
    free(csv);
    lom_free_sweep(&sweep);
    lom_free_image(reference);
}

/* Trials of known errors and times. */
static void the_front_is_what_nothing_beats(void)
{
    enum { N = 6 };
    static const struct {
        double flip, ratio;
        bool on_front, beats;
    } cases[N] = { { 0.2, 1.0, false, false },   /* the default, which the next one beats */
                   { 0.2, 0.5, true, true },     /* as exact, cheaper */
                   { 0.3, 0.4, true, false },    /* less exact, cheaper still */
                   { 0.3, 0.6, false, false },   /* beaten */
                   { 0.1, 2.0, true, false },    /* more exact, dearer */
                   { 0.1, 2.0, false, false } }; /* the same again */
    lom_trial trials[N] = { { .is_default = true } };
    lom_sweep sweep = { .count = N, .trial = trials };
    for (int i = 0; i < N; i++) {
        trials[i].reference = "test";
        trials[i].error.flip = cases[i].flip;
        trials[i].time = (lom_pair_time){ 1, 1, cases[i].ratio, cases[i].ratio * 0.99, cases[i].ratio * 1.01 };
    }
    trials[0].time.high = 1;
    lom_mark_front(&sweep);
    for (int i = 0; i < N; i++)
        CHECK(trials[i].on_front == cases[i].on_front && trials[i].beats_default == cases[i].beats, "trial %d", i);
}

int main(int argc, char **argv)
{
    RUN(a_dial_that_breaks_equality_is_caught);
    RUN(the_reference_has_no_error);
    RUN(what_is_refused_is_told);
    RUN(the_front_is_what_nothing_beats);
    return check_result();
}
