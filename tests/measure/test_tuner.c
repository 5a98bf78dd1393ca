/* Proves of the tuner: what it finds keeps the limit; no change of a single dial improves it; its answer is the
 * same for any threads, lanes and tiles; a limit that nothing keeps is said; and work grows
 * with what is drawn. */
#include "check.h"
#include "measure/tuner.h"

#include <string.h>

static const char *const changes[] = { "output.format=rgb8" };

static lom_subject small_subject(lom_device_desc device)
{
    return (lom_subject){ .path = "assets/scenes/lake.toml",
                          .changes = changes,
                          .change_count = 1,
                          .frame = { .width = 32, .height = 18 },
                          .device = device };
}

static lom_dial_work work_of(const lom_choices *choices, lom_device_desc device)
{
    const lom_subject subject = small_subject(device);
    lom_drawer drawer = { .scene = NULL };
    lom_dial_work work = { .work = 0 };
    lom_error error = { 0 };
    CHECK(lom_set_drawer(&drawer, &subject, choices, &error) && lom_measure_dial_work(&drawer, &subject, &work, &error),
          "%s", error.text);
    lom_end_drawer(&drawer);
    return work;
}

static void work_is_the_sum_of_its_weights(void)
{
    const lom_choices none = { .count = 0 };
    const lom_device_desc device = { .threads = 1, .lanes = 4 };
    const lom_dial_work one = work_of(&none, device), again = work_of(&none, device);
    uint64_t weight, sum = 0;
    for (size_t i = 0; lom_dial_work_kind(i, &weight) != NULL; i++)
        sum += weight * lom_dial_work_count(&one, i);
    CHECK(one.work > 0 && sum / 10 == one.work && one.work == again.work);
}

static void finer_is_more_work(void)
{
    lom_dials dials;
    lom_error error = { 0 };
    lom_list_dials(&dials);
    const lom_dial *samples = lom_find_dial(&dials, "output.samples", &error);
    const lom_dial *terrain = lom_find_dial(&dials, "terrain_error", &error);
    const lom_device_desc device = { .threads = 1, .lanes = 4 };
    const lom_choices none = { .count = 0 }, smooth = { 1, { { samples, "4" } } }, fine = { 1, { { terrain, "0" } } };
    CHECK(work_of(&smooth, device).work > work_of(&none, device).work);
    CHECK(work_of(&fine, device).work > work_of(&none, device).work);
}

struct found {
    lom_tuning tuning;
    lom_image *reference;
    lom_dials dials;
    const lom_dial *chosen[LOM_MAX_DIALS];
    lom_tuner_desc desc;
};

/* Against the scene with flat shading. */
static bool tune(struct found *f, lom_goal goal, double limit, lom_device_desc device)
{
    lom_error error = { 0 };
    lom_drawer drawer = { .scene = NULL };
    *f = (struct found){ .desc = { .subject = small_subject(device), .goal = goal, .limit = limit } };
    lom_list_dials(&f->dials);
    CHECK(lom_choose_dials(&f->dials, "shading,texture_filter,terrain_error,scissor", f->chosen, &f->desc.dial_count,
                           &error));
    const lom_choices flat = { 1, { { f->chosen[0], "flat" } } };
    if (lom_set_drawer(&drawer, &f->desc.subject, &flat, &error))
        f->desc.reference = f->reference = lom_draw_subject(&drawer, &f->desc.subject, &error);
    lom_end_drawer(&drawer);
    f->desc.dials = f->chosen;
    const bool done = f->reference != NULL && lom_tune(&f->desc, &f->tuning, &error);
    CHECK(done, "%s", error.text);
    return done;
}

static void what_is_found_keeps_the_limit(void)
{
    static const lom_device_desc devices[] = { { .threads = 1, .lanes = 4 }, { .threads = 2, .lanes = 8, .tile = 16 } };
    struct found f[2];
    for (int i = 0; i < 2; i++)
        if (!tune(&f[i], LOM_GOAL_FLIP, 0.01, devices[i]))
            return;
    const lom_tuning *a = &f[0].tuning, *b = &f[1].tuning;
    CHECK(a->met && a->best.error.flip <= 0.01 && a->standard.error.flip > 0.01);
    CHECK(a->best.choices.count >= 1 && strcmp(a->best.choices.choice[0].setting, "flat") == 0);
    CHECK(a->best.cost == b->best.cost && a->best.error.flip == b->best.error.flip &&
          a->best.choices.count == b->best.choices.count && a->tried == b->tried);
    for (int i = 0; i < a->best.choices.count; i++)
        CHECK(strcmp(a->best.choices.choice[i].setting, b->best.choices.choice[i].setting) == 0);
    for (int i = 0; i < 2; i++)
        lom_free_image(f[i].reference);
}

static void a_budget_is_kept(void)
{
    const lom_device_desc device = { .threads = 1, .lanes = 4 };
    struct found f;
    const lom_choices none = { .count = 0 };
    const double whole = (double)work_of(&none, device).work;
    if (tune(&f, LOM_GOAL_BUDGET, whole, device))
        CHECK(f.tuning.met && f.tuning.best.cost <= whole && f.tuning.best.error.flip <= f.tuning.standard.error.flip);
    lom_free_image(f.reference);
    if (tune(&f, LOM_GOAL_BUDGET, 1, device))
        CHECK(!f.tuning.met && f.tuning.best.cost > 1);
    lom_free_image(f.reference);
    if (tune(&f, LOM_GOAL_PSNR, 1e9, device))
        CHECK(f.tuning.met == (f.tuning.best.error.psnr > 1e9));
    lom_free_image(f.reference);
}

int main(int argc, char **argv)
{
    RUN(work_is_the_sum_of_its_weights);
    RUN(finer_is_more_work);
    RUN(what_is_found_keeps_the_limit);
    RUN(a_budget_is_kept);
    return check_result();
}
