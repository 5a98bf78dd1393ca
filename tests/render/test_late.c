/* Late times and near planes. At 10^9 seconds, where a double holds a time to a ten-millionth of a second, everything
 * that moves is where it is one period, or the same time after its keys, before: within 2 of 255; it moves on, as
 * evenly as at the start; and any device draws the same bytes. What is beyond a near plane of a picometre is what is
 * beyond one of a centimetre. */
#include "drawn_pairs.h"

static const lom_device_desc one_thread = { .threads = 1, .lanes = 4 };

/* ---- keys ---- */

static void add_to_times(const lom_key_table *table, char *members, double seconds);

static void add_to_array(const lom_key *key, char *members, double seconds)
{
    char *first;
    size_t count;
    memcpy(&first, members + key->offset, sizeof first);
    memcpy(&count, members + key->length_offset, sizeof count);
    for (size_t i = 0; i < count; i++)
        add_to_times(key->table, first + i * key->table->size, seconds);
}

/* To every key frame's time, and to when shallow water starts and bodies dip in. */
static void add_to_times(const lom_key_table *table, char *members, double seconds)
{
    for (int i = 0; i < table->key_count; i++) {
        const lom_key *key = &table->keys[i];
        if (key->type == LOM_KEY_TABLES)
            add_to_array(key, members, seconds);
        else if (key->type == LOM_KEY_TABLE)
            add_to_times(key->table, members + key->offset, seconds);
        else if (strcmp(key->name, "time") == 0 || strcmp(key->name, "start") == 0)
            *(double *)(void *)(members + key->offset) += seconds;
    }
}

static void delay(lom_scene *scene, const void *how)
{
    add_to_times(&lom_scene_keys, (char *)scene, *(const double *)how);
}

static const struct base keyed[] = {
    { "followed", "",
      "[camera]\nposition = [0, 3, 9]\ntarget = [0, 1, -3]\nfollow = \"box\"\n[light]\nazimuth = 20\n"
      "elevation = 25\n" TERRAIN "[[entity]]\nname = \"box\"\nmesh = \"box.obj\"\nposition = [0, 3, 2]\n"
      "interpolation = \"smooth\"\n[[entity.key]]\ntime = 0\nposition = [0, 3, 2]\n[[entity.key]]\ntime = 1\n"
      "position = [3, 4, 5]\nrotation = [0, 40, 10]\n[[entity.key]]\ntime = 2.5\n[[lamp]]\nposition = [0, 2, 3]\n"
      "follow = \"box\"\nrange = 13\n[[lamp.key]]\ntime = 0\nposition = [0, 2, 3]\n[[lamp.key]]\ntime = 1\n"
      "position = [1, 2, 3]\n[quality]\nentity_shadows = 64\n" },
    { "keys", "", VIEW KEYS TERRAIN },
};

/* The same picture at 0.75 s and at `late` + 0.75 s. */
static void check_late(const char *text, const char *name, double late, changing_scene *change)
{
    lom_error error = { .code = LOM_OK };
    lom_image *early = draw_changed(text, NULL, NULL, 0.75, &one_thread, &error);
    lom_image *other = draw_changed(text, change, &late, late + 0.75, &one_thread, &error);
    CHECK(early != NULL && other != NULL, "%s: %s", name, error.text);
    if (early != NULL && other != NULL) {
        struct difference d = find_difference(early, other);
        CHECK(d.beyond == 0, "%s at %.17g s: %d pixels differ by more than 2, the most by %d", name, late, d.beyond,
              d.largest);
        printf("  %-14s %11.0f s late: %d of 255 at most\n", name, late, d.largest);
    }
    lom_free_image(early);
    lom_free_image(other);
}

static void find_text(char text[4096], const char *name)
{
    text[0] = 0;
    for (size_t i = 0; i < sizeof bases / sizeof *bases; i++)
        if (strcmp(bases[i].name, name) == 0)
            snprintf(text, 4096, "%s%s", head, bases[i].text);
    for (size_t i = 0; i < sizeof more_bases / sizeof *more_bases; i++)
        if (strcmp(more_bases[i].name, name) == 0)
            snprintf(text, 4096, "%s%s", head, more_bases[i].text);
    CHECK(text[0] != 0, "there is no scene %s", name);
}

static void keys_hold_when_they_are_late(void)
{
    static const char *const names[] = { "ground", "lamps", "views", "oblique", "shallow", "follower" };
    char text[4096];
    for (size_t i = 0; i < sizeof keyed / sizeof *keyed; i++) {
        snprintf(text, sizeof text, "%s%s", head, keyed[i].text);
        check_late(text, keyed[i].name, 1e9 - 16, delay);
    }
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        find_text(text, names[i]);
        check_late(text, names[i], 1e9 - 16, delay);
    }
}

/* ---- what repeats ---- */

/* The text of a scene that moves, without winds, which take clouds away. */
static void find_moving(char text[4096], const char *name)
{
    find_text(text, name);
    char *wind = strstr(text, "[[clouds.wind]]");
    if (wind != NULL) {
        const char *rest = strstr(wind, "[clouds]");
        memmove(wind, rest, strlen(rest) + 1);
    }
}

/* Whole numbers of all its periods: flow_speed 0.03 a second; surf of 8 s, in groups of 6.1 and 3.7 crests; ripples of
 * a river of 20 m at 0.6 m/s, whose cycles of 100/9 s jump by millionths; three fields of clouds that take 3 s each. */
static void what_repeats_is_where_it_was(void)
{
    static const struct {
        const char *name;
        double late;
    } scenes[] = { { "lake", 1e9 - 100 },
                   { "surf", 8.0 * 610 * 370 * 553 },
                   { "flow", 1e9 - 100.0 / 9 * 1e6 },
                   { "evolve", 18.0 * 55555555 } };
    char text[4096];
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        find_moving(text, scenes[i].name);
        check_late(text, scenes[i].name, scenes[i].late, NULL);
    }
}

/* ---- what never repeats ---- */

/* The mean difference of pictures `step` seconds apart, and that picture. */
static double step_of(const char *text, const char *name, double time, double step)
{
    lom_error error = { .code = LOM_OK };
    lom_image *now = draw_changed(text, NULL, NULL, time, &one_thread, &error);
    lom_image *next = draw_changed(text, NULL, NULL, time + step, &one_thread, &error);
    CHECK(now != NULL && next != NULL, "%s: %s", name, error.text);
    double mean = now != NULL && next != NULL ? find_difference(now, next).mean : 0;
    lom_free_image(now);
    lom_free_image(next);
    return mean;
}

/* The sum of six steps from a time on. */
static double motion_of(const char *text, const char *name, double time, double step)
{
    double sum = 0;
    for (int i = 0; i < 6; i++)
        sum += step_of(text, name, time + 2.5 * i, step);
    return sum;
}

/* Over a 60th and over half a second: neither frozen nor torn. */
static void everything_moves_on_as_evenly_as_at_the_start(void)
{
    static const char *const names[] = { "lake",    "gerstner", "sea",   "flow", "surf",
                                         "marched", "spray",    "falls", "hits", "evolve" };
    static const double steps[] = { 1.0 / 60, 0.5 };
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char text[4096];
        find_moving(text, names[i]);
        for (int k = 0; k < 2; k++) {
            double early = motion_of(text, names[i], 40, steps[k]);
            double late = motion_of(text, names[i], 999999900, steps[k]);
            CHECK(early > 0 && late > early / 2 && late < early * 2, "%s moves by %g in %g s, late by %g", names[i],
                  early, steps[k], late);
            printf("  %-10s in %.3f s: %.3f of 255 early, %.3f late\n", names[i], steps[k], early / 6, late / 6);
        }
    }
}

static void any_device_draws_the_same_late(void)
{
    static const char *const names[] = { "gerstner", "sea", "foam", "surf", "spray", "evolve", "flow" };
    char text[4096];
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        lom_error error = { .code = LOM_OK };
        find_text(text, names[i]);
        lom_image *one = draw_changed(text, NULL, NULL, 1e9, &one_thread, &error);
        lom_image *two = draw_changed(text, NULL, NULL, 1e9, &(lom_device_desc){ .threads = 2 }, &error);
        CHECK(one != NULL && two != NULL && memcmp(one->pixels, two->pixels, lom_image_size(one)) == 0, "%s: %s",
              names[i], error.text);
        lom_free_image(one);
        lom_free_image(two);
    }
}

/* ---- near planes ---- */

static void set_near(lom_scene *scene, const void *how)
{
    scene->camera.near_plane = *(const double *)how;
    for (size_t i = 0; i < scene->view_count; i++)
        scene->views[i].camera.near_plane = *(const double *)how;
}

/* The mesh of waves begins some near planes behind the eye, so another plane is another mesh until it is small; depths of
 * parallel rays are shares of the way between the planes, so surfaces that meet do so a rounding elsewhere. With either,
 * one pixel may show another of two surfaces that meet. */
static bool needs_small_planes(const struct base *base)
{
    return strstr(base->text, "\"displaced\"") != NULL || strcmp(base->name, "orthographic") == 0;
}

static void try_near(const struct base *base)
{
    static const double planes[] = { 1e-2, 1e-9, 1e-12 };
    char text[4096];
    lom_error error = { .code = LOM_OK };
    lom_image *image[3];
    const int first = needs_small_planes(base) ? 1 : 0;
    snprintf(text, sizeof text, "%s%s", head, base->text);
    for (int i = first; i < 3; i++) {
        image[i] = draw_changed(text, set_near, &planes[i], 0.75, &one_thread, &error);
        CHECK(image[i] != NULL, "%s: %s", base->name, error.text);
        if (i > first && image[first] != NULL && image[i] != NULL) {
            struct difference d = find_difference(image[first], image[i]);
            CHECK(d.beyond <= first, "%s, near %g: %d pixels differ by more than 2, the most by %d", base->name,
                  planes[i], d.beyond, d.largest);
        }
    }
    for (int i = first; i < 3; i++)
        lom_free_image(image[i]);
}

static void near_planes_of_a_picometre_show_the_same(void)
{
    for (size_t i = 0; i < sizeof bases / sizeof *bases; i++)
        try_near(&bases[i]);
    for (size_t i = 0; i < sizeof more_bases / sizeof *more_bases; i++)
        try_near(&more_bases[i]);
}

int main(int argc, char **argv)
{
    if (!make_small_scene())
        return 1;
    RUN(keys_hold_when_they_are_late);
    RUN(what_repeats_is_where_it_was);
    RUN(everything_moves_on_as_evenly_as_at_the_start);
    RUN(any_device_draws_the_same_late);
    RUN(near_planes_of_a_picometre_show_the_same);
    remove_small_scene();
    return check_result();
}
