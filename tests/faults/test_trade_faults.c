/* Proves what failing memory and files do to `lom trade` and `lom tune`: whichever allocation or call fails, once or from
 * there on, what is found is the same as without the fault, or there is an error with a sentence, and nothing leaks. */
#include "faults.h"

#include "measure/sweep.h"
#include "measure/tuner.h"

static lom_dials all;
static const lom_dial *chosen[LOM_MAX_DIALS];
static size_t chosen_count;
static lom_image *reference;

static lom_subject subject_of(void)
{
    return (lom_subject){ .path = small_path("scene.toml"),
                          .frame = { .width = 32, .height = 18 },
                          .device = { .threads = 1, .lanes = 4 } };
}

/* The dials and the picture that all is measured against: nothing of it fails. */
static bool prepare(void)
{
    const lom_subject subject = subject_of();
    const lom_choices none = { .count = 0 };
    lom_drawer drawer = { .scene = NULL };
    lom_list_dials(&all);
    if (lom_choose_dials(&all, "reflection_scale", chosen, &chosen_count, NULL) &&
        lom_set_drawer(&drawer, &subject, &none, NULL))
        reference = lom_draw_subject(&drawer, &subject, NULL);
    lom_end_drawer(&drawer);
    return reference != NULL;
}

static bool sweep_dial(const char *name, uint64_t *hash, lom_error *error)
{
    const lom_subject subject = subject_of();
    const lom_sweep_desc desc = { .subject = subject,
                                  .whole = subject,
                                  .reference = reference,
                                  .reference_name = "a picture",
                                  .dials = chosen,
                                  .dial_count = chosen_count,
                                  .pairs = 1 };
    const lom_sweep_head head = { .scene = name, .command = name, .clock = "clock time", .width = 32, .height = 18 };
    lom_sweep sweep = { .count = 0 };
    FILE *out = fopen("/dev/null", "w");
    const bool done =
        out != NULL && lom_run_sweep(&desc, &sweep, error) && lom_print_sweep_page(out, &sweep, &head, error);
    *hash = LOM_HASH_START;
    for (size_t i = 0; done && i < sweep.count; i++) {
        CHECK(sweep.trial[i].picture != NULL && sweep.trial[i].failed[0] == '\0', "%s", sweep.trial[i].failed);
        *hash = lom_hash_bytes(*hash, &sweep.trial[i].error.flip, sizeof(double));
    }
    lom_free_sweep(&sweep);
    if (out != NULL)
        fclose(out);
    return done;
}

static bool tune_dial(const char *name, uint64_t *hash, lom_error *error)
{
    const lom_tuner_desc desc = { .subject = subject_of(),
                                  .reference = reference,
                                  .dials = chosen,
                                  .dial_count = chosen_count,
                                  .goal = LOM_GOAL_FLIP,
                                  .limit = 0.2 };
    lom_tuning tuning;
    const bool done = lom_tune(&desc, &tuning, error);
    (void)name;
    *hash = done ? lom_hash_bytes(LOM_HASH_START, &tuning.best.cost, sizeof(double)) : 0;
    return done;
}

static void every_failing_allocation_of_a_sweep_is_an_error(void)
{
    fail_memory(sweep_dial, "sweep", 20, 100, 24);
}

static void every_failing_allocation_of_the_tuner_is_an_error(void)
{
    fail_memory(tune_dial, "tune", 20, 100, 24);
}

static void every_failing_file_of_both_is_an_error(void)
{
    fault.file_error = EIO;
    for (int lasting = 0; lasting < 2; lasting++) {
        const fault_plan plan = { .kind = FILES, .lasting = lasting, .tries = 12 };
        CHECK(fail_each(sweep_dial, "sweep", &plan) > 10, "a sweep reads no file");
        CHECK(fail_each(tune_dial, "tune", &plan) > 10, "the tuner reads no file");
    }
}

int main(int argc, char **argv)
{
    if (!make_small_scene() || !prepare())
        return 1;
    RUN(every_failing_allocation_of_a_sweep_is_an_error);
    RUN(every_failing_allocation_of_the_tuner_is_an_error);
    RUN(every_failing_file_of_both_is_an_error);
    lom_free_image(reference);
    remove_small_scene();
    return check_result();
}
