/* The table of dials. In: the keys of scenes that are approximations. Out: these and the program's own, which change no
 * byte. Invariant: what is said of a dial anywhere (docs/dials.md, `lom plan`) comes from here. */
#include "measure/dials.h"

#include <assert.h>
#include <string.h>

static void set_threads(lom_device_desc *device, int *parts, int setting)
{
    (void)parts;
    device->threads = setting;
}
static void set_lanes(lom_device_desc *device, int *parts, int setting)
{
    (void)parts;
    device->lanes = setting;
}
static void set_tile(lom_device_desc *device, int *parts, int setting)
{
    (void)parts;
    device->tile = setting;
}
static void set_parts(lom_device_desc *device, int *parts, int setting)
{
    (void)device;
    *parts = setting;
}

/* None of them approximates anything. */
static const struct own_dial {
    const char *name, *settings, *how;
    void (*set)(lom_device_desc *device, int *parts, int setting);
} own[] = {
    { "threads", "1 2 3", "workers share the tiles of a frame (`--threads`)", set_threads },
    { "lanes", "4 8 16", "values side by side (`--lanes`)", set_lanes },
    { "tile", "16 32 64", "the edge of a tile in pixels (`lom_device_desc`)", set_tile },
    { "crop", "1 2 3", "so many crops each way, which together are the frame (`--crop`)", set_parts },
};

static bool add_dial(void *context, const lom_scene_key *key)
{
    lom_dials *dials = context;
    const lom_key_dial *row = key->key->dial;
    if (row == NULL || row->none != NULL)
        return true;
    assert(dials->count < LOM_MAX_DIALS);
    lom_dial *dial = &dials->dial[dials->count++];
    *dial = (lom_dial){ .row = *row, .key = *key };
    snprintf(dial->name, sizeof dial->name, "%s", key->path + (key->is_in_quality ? strlen("quality.") : 0));
    return true;
}

static void add_own(lom_dials *dials, const struct own_dial *own_dial)
{
    assert(dials->count < LOM_MAX_DIALS);
    lom_dial *dial = &dials->dial[dials->count++];
    *dial = (lom_dial){ .set = own_dial->set };
    dial->row =
        (lom_key_dial){ .approximates = own_dial->how, .settings = own_dial->settings, .reference = LOM_DIAL_EQUAL };
    snprintf(dial->name, sizeof dial->name, "%s", own_dial->name);
}

void lom_list_dials(lom_dials *dials)
{
    dials->count = 0;
    lom_visit_scene_keys(add_dial, dials);
    for (size_t i = 0; i < sizeof own / sizeof own[0]; i++)
        add_own(dials, &own[i]);
}

const lom_dial *lom_find_dial(const lom_dials *dials, const char *name, lom_error *error)
{
    const char *names[LOM_MAX_DIALS];
    const bool is_whole = strncmp(name, "quality.", strlen("quality.")) == 0;
    const char *shorter = name + (is_whole ? strlen("quality.") : 0);
    for (size_t i = 0; i < dials->count; i++) {
        names[i] = dials->dial[i].name;
        if (strcmp(names[i], shorter) == 0)
            return &dials->dial[i];
    }
    const char *near = lom_nearest_name(shorter, strlen(shorter), names, dials->count);
    if (near != NULL)
        lom_fail(error, LOM_ERROR_USAGE, "There is no dial \"%.80s\" (did you mean \"%s\"?).", name, near);
    else
        lom_fail(error, LOM_ERROR_USAGE, "There is no dial \"%.80s\"; docs/dials.md lists them.", name);
    return NULL;
}

bool lom_choose_dials(const lom_dials *dials, const char *names, const lom_dial **chosen, size_t *count,
                      lom_error *error)
{
    char name[80];
    *count = 0;
    for (size_t i = 0; names == NULL && i < dials->count; i++)
        chosen[(*count)++] = &dials->dial[i];
    for (size_t i = 0; names != NULL && lom_nth_word(names, ',', i, name, sizeof name); i++) {
        const lom_dial *dial = lom_find_dial(dials, name, error);
        if (dial == NULL)
            return false;
        if (*count == LOM_MAX_DIALS)
            return lom_fail(error, LOM_ERROR_USAGE, "More than %d dials are named.", LOM_MAX_DIALS);
        chosen[(*count)++] = dial;
    }
    return *count > 0 || lom_fail(error, LOM_ERROR_USAGE, "The list of dials names no dial.");
}

bool lom_dial_setting(const lom_dial *dial, size_t i, char setting[LOM_SCENE_VALUE])
{
    return lom_nth_word(dial->row.settings, ' ', i, setting, LOM_SCENE_VALUE);
}

void lom_print_dial_override(char text[128], const lom_dial *dial, const char *setting)
{
    snprintf(text, 128, "%s=%s", dial->key.path, setting);
}

/* The dials that do nothing for this reason, once; those after `first` that share it are marked as told. */
static void print_idle(FILE *out, const lom_dials *dials, size_t first, char (*why)[LOM_DIAL_REASON])
{
    fprintf(out, "-  %s", dials->dial[first].name);
    for (size_t i = first + 1; i < dials->count; i++)
        if (strcmp(why[i], why[first]) == 0) {
            fprintf(out, ", %s", dials->dial[i].name);
            why[i][0] = 0;
        }
    fprintf(out, ": %s\n", why[first]);
}

static void print_acting(FILE *out, const lom_dial *dial, const lom_scene *scene)
{
    char value[LOM_SCENE_VALUE], initial[LOM_SCENE_VALUE];
    lom_print_scene_value(value, scene, &dial->key);
    lom_print_scene_default(initial, &dial->key);
    const bool is_default = strcmp(value, initial) == 0;
    fprintf(out, "*  %-20s %s%s%s\n", dial->name, value, is_default ? "" : "; by default ", is_default ? "" : initial);
}

void lom_print_scene_dials(FILE *out, const lom_scene *scene)
{
    lom_dials dials;
    char why[LOM_MAX_DIALS][LOM_DIAL_REASON] = { { 0 } };
    lom_list_dials(&dials);
    fprintf(out, "dials\n");
    for (size_t i = 0; i < dials.count; i++)
        if (dials.dial[i].key.key != NULL && lom_dial_acts(scene, &dials.dial[i].row, why[i]))
            print_acting(out, &dials.dial[i], scene);
    for (size_t i = 0; i < dials.count; i++)
        if (why[i][0] != 0)
            print_idle(out, &dials, i, why);
}
