/* Proves of the table of dials: every key of [quality] is one or says why it is none; every setting is one that the
 * reader takes and prints as it is written, so that scenes can be compared with it; the default is among the settings;
 * what a dial needs is a key that is there; and docs/dials.md is what the table makes. */
#include "check.h"
#include "measure/dials.h"

#include <stdlib.h>
#include <string.h>

static bool is_told(void *context, const lom_scene_key *key)
{
    int *dials = context;
    const lom_key_dial *row = key->key->dial;
    const bool is_table = key->key->type == LOM_KEY_TABLE;
    CHECK(!key->is_in_quality || is_table || row != NULL, "%s is neither a dial nor named as none", key->path);
    if (row != NULL && row->none == NULL) {
        CHECK(row->approximates != NULL && row->settings != NULL, "%s", key->path);
        (*dials)++;
    }
    return true;
}

static void every_key_of_quality_is_told(void)
{
    int dials = 0;
    lom_visit_scene_keys(is_told, &dials);
    CHECK(dials > 30, "%d", dials);
}

static void check_setting(const lom_dial *dial, const char *setting)
{
    static const char scene_text[] = "[water.waves]\nkind = \"gerstner\"\n";
    char change[128], value[LOM_SCENE_VALUE];
    lom_error error = { 0 };
    lom_print_dial_override(change, dial, setting);
    const char *const changes[] = { change };
    lom_scene *scene = lom_decode_scene(scene_text, strlen(scene_text), "dials.toml", changes, 1, &error);
    CHECK(scene != NULL, "%s: %s", change, error.text);
    if (scene == NULL)
        return;
    CHECK(strcmp(lom_print_scene_value(value, scene, &dial->key), setting) == 0, "%s is read as %s", change, value);
    lom_free_scene(scene);
}

static void settings_are_values_of_their_keys(void)
{
    lom_dials dials;
    char setting[LOM_SCENE_VALUE], initial[LOM_SCENE_VALUE];
    lom_list_dials(&dials);
    for (size_t i = 0; i < dials.count; i++) {
        const lom_dial *dial = &dials.dial[i];
        bool has_default = dial->key.key == NULL;
        size_t count = 0;
        for (; lom_dial_setting(dial, count, setting); count++) {
            if (dial->key.key == NULL)
                continue;
            check_setting(dial, setting);
            has_default |= strcmp(setting, lom_print_scene_default(initial, &dial->key)) == 0;
        }
        const bool is_off = strcmp(dial->name, "entity_shadows") == 0; /* its default is no shadow */
        CHECK(count >= 2 && (has_default || is_off), "%s: %s is not among its %zu settings", dial->name, initial,
              count);
    }
}

static void conditions_are_told(void)
{
    static const struct {
        const char *text, *dial, *why;
    } cases[] = {
        { "", "cloud_error", "there is no [[cloud]]" },
        { "", "terrain_error", "there is no [terrain]" },
        { "", "shading", "there is no [terrain] and there is no [[entity]]" },
        { "[[cloud]]\nkind = \"cumulus_humilis\"\n[quality]\nclouds = \"billboard\"\n", "cloud_error",
          "quality.clouds is billboard" },
        { "[[cloud]]\nkind = \"cumulus_humilis\"\n", "cloud_error", "" },
        { "[[cloud]]\nkind = \"cumulus_humilis\"\n", "impostor.sun", "quality.impostors is off" },
        { "", "water.optics.steps", "there is no [water]" },
        { "[water]\nenabled = false\n", "water", "water.enabled is false" },
        { "[water]\n", "water", "" },
        { "[water]\n[quality]\nwater = \"planar\"\n", "water.waves.cell", "quality.water is planar" },
        { "[water]\n", "water.waves.cell", "" },
        { "", "output.sample_shading", "output.samples is 1" },
        { "[output]\nsamples = 4\n", "output.sample_shading", "" },
        { "[water]\n", "refraction_samples", "output.samples is 1" },
        { "[output]\nsamples = 4\n[water]\n", "refraction_samples", "" },
        { "", "filtering", "" },
    };
    lom_dials dials;
    lom_list_dials(&dials);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        lom_error error = { 0 };
        char why[LOM_DIAL_REASON];
        const lom_dial *dial = lom_find_dial(&dials, cases[i].dial, &error);
        lom_scene *scene = lom_decode_scene(cases[i].text, strlen(cases[i].text), "dials.toml", NULL, 0, &error);
        CHECK(dial != NULL && scene != NULL, "case %zu: %s", i, error.text);
        if (dial == NULL || scene == NULL)
            continue;
        const bool acts = lom_dial_acts(scene, &dial->row, why);
        CHECK(acts == (cases[i].why[0] == 0) && strcmp(why, cases[i].why) == 0, "case %zu: %s", i, why);
        lom_free_scene(scene);
    }
}

static bool has_known_conditions(void *context, const lom_scene_key *key)
{
    const lom_key_dial *row = key->key->dial;
    char condition[96], name[64];
    lom_scene_key found;
    (void)context;
    for (size_t i = 0;
         row != NULL && row->needs != NULL && lom_nth_word(row->needs, ' ', i, condition, sizeof condition); i++) {
        char *values = strchr(condition, '=');
        if (values != NULL)
            *values = 0;
        for (size_t k = 0; lom_nth_word(condition, '|', k, name, sizeof name); k++)
            CHECK(lom_find_scene_key(name, &found), "%s needs %s, which is no key", key->path, name);
    }
    return true;
}

static void conditions_are_keys(void)
{
    lom_visit_scene_keys(has_known_conditions, NULL);
}

static void names_are_found(void)
{
    lom_dials dials;
    lom_error error = { 0 };
    lom_list_dials(&dials);
    CHECK(lom_find_dial(&dials, "quality.cloud_error", &error) == lom_find_dial(&dials, "cloud_error", &error));
    CHECK(lom_find_dial(&dials, "threads", &error) != NULL);
    CHECK(lom_find_dial(&dials, "cloud_eror", &error) == NULL &&
              strstr(error.text, "did you mean \"cloud_error\"") != NULL,
          "%s", error.text);
}

static void documentation_is_current(void)
{
    lom_error error = { 0 };
    lom_bytes kept = lom_read_file("docs/dials.md", 1 << 24, &error);
    char *made = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&made, &size);
    if (out != NULL) {
        lom_print_dial_documentation(out);
        fclose(out);
    }
    CHECK(made != NULL && kept.data != NULL && kept.size == size && memcmp(kept.data, made, size) == 0,
          "docs/dials.md is not what the table makes; run: lom make dial-docs -o docs/dials.md");
    free(made);
    lom_release(kept.data);
}

int main(int argc, char **argv)
{
    RUN(every_key_of_quality_is_told);
    RUN(settings_are_values_of_their_keys);
    RUN(conditions_are_told);
    RUN(conditions_are_keys);
    RUN(names_are_found);
    RUN(documentation_is_current);
    return check_result();
}
