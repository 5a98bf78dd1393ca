/* Proves of the tuner: what it finds keeps the limit; no change of a single dial improves it; its answer is the
 * same for any threads, lanes and tiles; a limit that nothing keeps is said; and work grows
 * with what is drawn. */
#include "check.h"
#include "measure/tuner.h"
#include "measure/work.h"

#include <string.h>

static const char *const changes[] = { "output.format=rgb8" };

static lom_subject small_subject(const char *path, lom_device_desc device)
{
    return (lom_subject){
        .path = path, .changes = changes, .change_count = 1, .frame = { .width = 32, .height = 18 }, .device = device
    };
}

static lom_declared_work work_in(const char *path, const lom_choices *choices)
{
    const lom_subject subject = small_subject(path, lom_counting_device());
    lom_drawer drawer = { .scene = NULL };
    lom_declared_work work = { .count = { 0 } };
    lom_frame_desc after = subject.frame;
    lom_error error = { 0 };
    after.frame = 2;
    CHECK(lom_set_drawer(&drawer, &subject, choices, &error) &&
              lom_count_work(drawer.renderer, drawer.scene, &after, &work, &error),
          "%s", error.text);
    lom_end_drawer(&drawer);
    return work;
}

static uint64_t work_of(const lom_choices *choices)
{
    const lom_declared_work work = work_in("assets/scenes/lake.toml", choices);
    return lom_weigh_work(&work);
}

/* Every kind is counted where there is something of it, and nowhere else. */
static void every_kind_is_counted(void)
{
    static const char *const scenes[] = { "assets/scenes/lake.toml", "assets/scenes/cumulus.toml",
                                          "assets/scenes/wake.toml", "assets/scenes/features/splash.toml" };
    static const struct {
        const char *name;
        uint32_t scenes; /* bits */
    } expected[LOM_WORK_KINDS] = {
        [LOM_WORK_PIXELS] = { "pixels", 15 },    [LOM_WORK_VERTICES] = { "vertices", 15 },
        [LOM_WORK_TRIANGLES] = { "triang", 15 }, [LOM_WORK_FRAGMENTS] = { "fragments", 15 },
        [LOM_WORK_LOOKUPS] = { "texture", 15 },  [LOM_WORK_STEPS] = { "steps", 2 },
        [LOM_WORK_SAMPLES] = { "samples", 8 },   [LOM_WORK_TRANSFORMED] = { "N^2", 0 },
        [LOM_WORK_SHALLOW] = { "cells", 4 },     [LOM_WORK_PARTICLES] = { "particles", 8 },
    };
    const lom_choices none = { .count = 0 };
    for (int s = 0; s < 4; s++) {
        const lom_declared_work one = work_in(scenes[s], &none);
        uint64_t weight, sum = 0;
        for (size_t i = 0; i < LOM_WORK_KINDS; i++) {
            const char *name = lom_describe_work(i, &weight);
            CHECK(strncmp(name, expected[i].name, strlen(expected[i].name)) == 0 && weight > 0);
            CHECK((one.count[i] > 0) == (expected[i].scenes >> s & 1), "%s: %s", scenes[s], name);
            sum += weight * one.count[i];
        }
        CHECK(lom_weigh_work(&one) == sum / 10 && sum > 0);
    }
    CHECK(lom_describe_work(LOM_WORK_KINDS, &(uint64_t){ 0 }) == NULL);
}

static void work_is_the_same_again(void)
{
    const lom_choices none = { .count = 0 };
    CHECK(work_of(&none) == work_of(&none));
}

static void finer_is_more_work(void)
{
    lom_dials dials;
    lom_error error = { 0 };
    lom_list_dials(&dials);
    const lom_dial *samples = lom_find_dial(&dials, "output.samples", &error);
    const lom_dial *terrain = lom_find_dial(&dials, "terrain_error", &error);
    const lom_choices none = { .count = 0 }, smooth = { 1, { { samples, "4" } } }, fine = { 1, { { terrain, "0" } } };
    CHECK(work_of(&smooth) > work_of(&none));
    CHECK(work_of(&fine) > work_of(&none));
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
    *f = (struct found){
        .desc = { .subject = small_subject("assets/scenes/lake.toml", device), .goal = goal, .limit = limit }
    };
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
    static const lom_device_desc devices[] = { { .threads = 1, .lanes = 4 },
                                               { .threads = 2, .lanes = 16, .tile = 16 } };
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
    const double whole = (double)work_of(&none);
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
    RUN(every_kind_is_counted);
    RUN(work_is_the_same_again);
    RUN(finer_is_more_work);
    RUN(what_is_found_keeps_the_limit);
    RUN(a_budget_is_kept);
    return check_result();
}
