/* The kinds of clouds. In: a name and a seed. Out: a volume of density. Invariant: a kind is a row of one table; its
 * heights are those of the World Meteorological Organization's genera. */
#include "cloud/cloud_kinds.h"

#include <string.h>

struct row {
    lom_cloud_kind kind;
    lom_cloud_maker *make;
    int variety;
};

static const struct row rows[] = {
    { { "hemisphere",
        "",
        "A ball cut flat below, with a noisy rim (the reference work's first cloud).",
        0,
        0,
        { 1000, 1000, 1000 },
        { 64, 64, 64 },
        0.03 },
      lom_make_hemisphere,
      0 },
    { { "hemisphere_perlin",
        "",
        "The same times five octaves of Perlin noise (the reference work's altocumulus).",
        0,
        0,
        { 1000, 1000, 1000 },
        { 64, 64, 64 },
        0.03 },
      lom_make_hemisphere,
      1 },
    { { "puffs",
        "",
        "Particles with Gaussian density in a flattened heap.",
        0,
        0,
        { 1200, 800, 1000 },
        { 96, 64, 80 },
        0.03 },
      lom_make_particles,
      0 },
    { { "wyvill", "", "Metaballs with Wyvill's falloff.", 0, 0, { 1200, 800, 1000 }, { 96, 64, 80 }, 0.03 },
      lom_make_particles,
      1 },
    { { "automaton",
        "",
        "Dobashi's cellular automaton of humidity, activation and cloud.",
        0,
        0,
        { 1600, 800, 1600 },
        { 96, 48, 96 },
        0.03 },
      lom_make_automaton,
      0 },
    { { "ball",
        "",
        "A formula, for transfer functions: 1 in the middle, falling evenly to 0 at the sides.",
        0,
        0,
        { 1000, 1000, 1000 },
        { 64, 64, 64 },
        0.03 },
      lom_make_formula,
      0 },
    { { "ripples",
        "",
        "A formula, for transfer functions: rings that Marschner and Lobb test filters with.",
        0,
        0,
        { 1000, 1000, 1000 },
        { 80, 80, 80 },
        0.03 },
      lom_make_formula,
      1 },
    { { "cumulus_fractus", "Cu fra", "Torn shreds of cumulus.", 100, 2000, { 700, 350, 600 }, { 112, 56, 96 }, 0.03 },
      lom_make_body,
      0 },
    { { "cumulus_humilis",
        "Cu hum",
        "Flat cumulus of fair weather.",
        200,
        2000,
        { 1100, 450, 1000 },
        { 128, 56, 120 },
        0.045 },
      lom_make_body,
      1 },
    { { "cumulus_mediocris",
        "Cu med",
        "Cumulus about as high as wide.",
        200,
        2000,
        { 1600, 1000, 1500 },
        { 144, 92, 136 },
        0.05 },
      lom_make_body,
      2 },
    { { "cumulus_congestus",
        "Cu con",
        "Towering cumulus, a cauliflower.",
        200,
        2000,
        { 2600, 3000, 2500 },
        { 160, 184, 152 },
        0.05 },
      lom_make_body,
      3 },
    { { "cumulonimbus",
        "Cb",
        "A thundercloud with its anvil.",
        200,
        2000,
        { 12000, 9000, 11000 },
        { 208, 160, 192 },
        0.02 },
      lom_make_body,
      4 },
    { { "stratocumulus", "Sc", "Rolls and pads of low cloud.", 100, 2000, { 9000, 700, 9000 }, { 288, 24, 288 }, 0.03 },
      lom_make_layer,
      0 },
    { { "stratus", "St", "Low, even cloud.", 0, 2000, { 9000, 500, 9000 }, { 160, 20, 160 }, 0.015 },
      lom_make_layer,
      1 },
    { { "nimbostratus",
        "Ns",
        "Thick, dark cloud of lasting rain.",
        2000,
        7000,
        { 12000, 2500, 12000 },
        { 160, 40, 160 },
        0.01 },
      lom_make_layer,
      2 },
    { { "altocumulus",
        "Ac",
        "Flocks of small pads at middle height.",
        1500,
        7000,
        { 12000, 500, 12000 },
        { 352, 16, 352 },
        0.012 },
      lom_make_layer,
      3 },
    { { "altostratus", "As", "A veil at middle height.", 2000, 7000, { 12000, 1500, 12000 }, { 160, 28, 160 }, 0.0012 },
      lom_make_layer,
      4 },
    { { "cirrus", "Ci", "Hair and hooks of ice.", 8000, 13000, { 20000, 1500, 20000 }, { 352, 24, 352 }, 0.0016 },
      lom_make_layer,
      5 },
    { { "cirrocumulus",
        "Cc",
        "Ripples of ice in grains.",
        5000,
        13000,
        { 12000, 400, 12000 },
        { 384, 12, 384 },
        0.003 },
      lom_make_layer,
      6 },
    { { "cirrostratus", "Cs", "A thin veil of ice.", 5000, 13000, { 20000, 1200, 20000 }, { 160, 20, 160 }, 0.0004 },
      lom_make_layer,
      7 },
};
enum { KINDS = sizeof rows / sizeof *rows };

const lom_cloud_kind *lom_cloud_kind_at(size_t index)
{
    return index < KINDS ? &rows[index].kind : NULL;
}

static const struct row *find_row(const char *name, lom_error *error)
{
    const char *names[KINDS];
    for (size_t i = 0; i < KINDS; i++) {
        names[i] = rows[i].kind.name;
        if (strcmp(name, names[i]) == 0 || (name[0] != 0 && strcmp(name, rows[i].kind.abbreviation) == 0))
            return &rows[i];
    }
    const char *near = lom_nearest_name(name, strlen(name), names, KINDS);
    if (near != NULL)
        lom_fail(error, LOM_ERROR_USAGE, "There is no kind of cloud \"%.80s\" (did you mean \"%s\"?).", name, near);
    else
        lom_fail(error, LOM_ERROR_USAGE, "There is no kind of cloud \"%.80s\".", name);
    return NULL;
}

const lom_cloud_kind *lom_find_cloud_kind(const char *name, lom_error *error)
{
    const struct row *row = find_row(name, error);
    return row != NULL ? &row->kind : NULL;
}

double lom_base_of_kind(const lom_cloud_kind *kind)
{
    return (kind->low + kind->high) / 2;
}

double lom_shrink_of_kind(const lom_cloud_kind *kind, const double size[3])
{
    double share = 1;
    for (int i = 0; i < 3; i++)
        share *= size[i] / kind->size[i];
    return share < 1 ? lom_double_cbrt(share) : 1;
}

void lom_store_density(lom_image *volume, int x, int y, int z, double density)
{
    double bounded = density > 0 ? density < 1 ? density : 1 : 0;
    *(uint16_t *)lom_image_pixel(volume, x, y, z) = (uint16_t)lom_count_of(bounded * 65535 + 0.5, 65535);
}

lom_image *lom_make_cloud(const lom_cloud_desc *desc, lom_error *error)
{
    if (desc == NULL || desc->kind == NULL) {
        lom_fail(error, LOM_ERROR_USAGE, "A cloud that is made has a kind.");
        return NULL;
    }
    const struct row *row = find_row(desc->kind, error);
    if (row == NULL)
        return NULL;
    const int asked[3] = { desc->width, desc->height, desc->depth };
    int size[3];
    for (int i = 0; i < 3; i++) {
        size[i] = asked[i] != 0 ? asked[i] : row->kind.voxels[i];
        if (size[i] < 1 || size[i] > LOM_MAX_VOLUME) {
            lom_fail(error, LOM_ERROR_USAGE, "A cloud has 1 to %d voxels a side, not %d.", LOM_MAX_VOLUME, size[i]);
            return NULL;
        }
    }
    lom_image *volume = lom_create_image(size[0], size[1], size[2], LOM_FORMAT_R16, error);
    lom_float_state state;
    lom_enter_float_state(&state);
    if (volume != NULL && !row->make(volume, row->variety, desc->seed, error)) {
        lom_free_image(volume);
        volume = NULL;
    }
    lom_leave_float_state(&state);
    return volume;
}
