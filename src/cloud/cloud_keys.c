/* The tables of the scene file's [clouds] and [[cloud]] keys. In: nothing. Out: names, ranges, defaults and
 * documentation of every member of lom_clouds and lom_cloud. */
#include "cloud/cloud_keys.h"

#include "base/numbers.h"
#include "cloud/cloud_kinds.h"

#include <lom/cloud.h>

#include <string.h>

#define AT(member)     offsetof(lom_cloud, member)
#define OF_ALL(member) offsetof(lom_clouds, member)

#define OF_POINT(member) offsetof(lom_cloud_transfer, member)
static const lom_key transfer[] = {
    { "value", LOM_KEY_NUMBER, OF_POINT(value), .flags = LOM_KEY_REQUIRED, .maximum = 1,
      .text = "Of the volume; not below that of the point before. Two points of one value are a step." },
    { "extinction", LOM_KEY_NUMBER, OF_POINT(extinction), .maximum = 1, .initial = { 1 },
      .text = "There, in parts of the cloud's `extinction`." },
    { "color", LOM_KEY_COLOR, OF_POINT(color), 3, .maximum = 1000, .initial = { 1, 1, 1 },
      .text = "There: the share of the light that is sent on, or the light that is sent, by `look`." },
};
static const lom_key_table transfer_table = {
    .size = sizeof(lom_cloud_transfer),
    .keys = transfer,
    .key_count = sizeof transfer / sizeof *transfer,
    .text =
        "A point of the transfer function: what values of the volume look like. Between points it is linear, below "
        "the first and above the last constant. Of it `octaves`, `forward` and `single` integrate what a ray passes "
        "between two samples in closed form (docs/clouds.md)."
};

static const lom_key cloud[] = {
    { "name", LOM_KEY_STRING, AT(name), .text = "A name of its own, for overrides and messages." },
    { "kind", LOM_KEY_STRING, AT(kind),
      .text = "What it is: a name or abbreviation that `lom make list` prints. Genera of the atmosphere: `cirrus`, "
              "`cirrocumulus`, `cirrostratus`, `altocumulus`, `altostratus`, `stratocumulus`, `stratus`, "
              "`nimbostratus`, `cumulonimbus`; species of cumulus: `cumulus_fractus`, `cumulus_humilis`, "
              "`cumulus_mediocris`, `cumulus_congestus`; earlier models: `hemisphere`, `hemisphere_perlin`, `puffs`, "
              "`automaton`, `wyvill`.",
      .initial_text = "`cumulus_mediocris`" },
    { "file", LOM_KEY_FILE, AT(file),
      .text = "A volume of density of your own instead of `kind`: NRRD, or raw voxels of 8 bits with `voxels`." },
    { "voxels", LOM_KEY_NUMBER, AT(voxels), 3, .minimum = 0, .maximum = LOM_MAX_VOLUME,
      .text = "Voxels along x, y and z.", .initial_text = "the kind's" },
    { "seed", LOM_KEY_INTEGER, AT(seed), .minimum = 0, .maximum = 2147483647, .initial = { 1 },
      .text = "Another seed gives another cloud of the kind." },
    { "position", LOM_KEY_NUMBER, AT(position), 3, .minimum = -1e9, .maximum = 1e9, .unit = "m",
      .text = "Where the middle of its base is.", .initial_text = "the origin, halfway up the heights of its genus" },
    { "middle", LOM_KEY_NUMBER, AT(middle), 2, .minimum = -1e9, .maximum = 1e9, .unit = "m",
      .text = "x and z of the middle of its base, instead of those of `position`.", .initial_text = "those of it" },
    { "size", LOM_KEY_NUMBER, AT(size), 3, .flags = LOM_KEY_SPREAD, .minimum = 1e-6, .maximum = 1e6, .unit = "m",
      .initial = { 1000, 1000, 1000 }, .text = "Extent of its box along x, y and z.", .initial_text = "the kind's" },
    { "yaw", LOM_KEY_ANGLE, AT(yaw), .minimum = -360, .maximum = 360, .unit = "degrees",
      .text = "Turns it about the y axis, counter-clockwise seen from above." },
    { "density", LOM_KEY_NUMBER, AT(density), .maximum = 1000, .initial = { 1 },
      .text = "Factor on the volume's density." },
    { "extinction", LOM_KEY_NUMBER, AT(extinction), .maximum = 1000, .initial = { 0.04 }, .unit = "1/m",
      .text = "Share of the light that a metre takes where the density is 1.",
      .initial_text = "the kind's; of a smaller cloud so much more that as much of the light comes through" },
    { "detail", LOM_KEY_NUMBER, AT(detail), .maximum = 1, .initial = { 0.35 },
      .text = "How far noise finer than the voxels eats into thin parts when it is marched." },
    { "detail_size", LOM_KEY_NUMBER, AT(detail_size), .flags = LOM_KEY_ABOVE, .maximum = 1e6, .initial = { 180 },
      .unit = "m", .text = "Length of one repetition of that noise.",
      .initial_text = "180, of a cloud smaller than its kind so much shorter" },
    { "visible", LOM_KEY_BOOL, AT(visible), .initial = { 1 }, .text = "Whether it is drawn." },
    { "transfer_function", LOM_KEY_TABLES, AT(transfer), .table = &transfer_table, .length_offset = AT(transfer_count),
      .text = "Colour and extinction by value, at most 16 points; with them `detail` is 0 if it is not given." },
    { "look", LOM_KEY_CHOICE, AT(look), .choices = { "scattered", "surface", "glowing" },
      .text = "With a transfer function: its colours are shares of the light that a cloud scatters, those of Lambert's "
              "surfaces across the gradient of the value, or light that the volume sends by itself." },
};
static bool check_transfer(lom_cloud *it, const lom_key_check *check)
{
    if (it->transfer_count == 0)
        return true;
    if (!check->is_given(check, "detail"))
        it->detail = 0;
    if (it->transfer_count > LOM_MAX_TRANSFER)
        return check->fail(check, "transfer_function", "a transfer function has at most 16 points.");
    for (size_t i = 0; i < it->transfer_count; i++) {
        const lom_key_check at = check->element(check, "transfer_function", i);
        const double *color = it->transfer[i].color;
        if (i > 0 && it->transfer[i].value < it->transfer[i - 1].value)
            return at.fail(&at, "value", "the values of a transfer function must not fall.");
        if (it->look != LOM_LOOK_GLOWING && lom_larger(lom_larger(color[0], color[1]), color[2]) > 1)
            return at.fail(&at, "color", "more light than there is would be sent on: only what glows is above 1.");
    }
    return true;
}

/* What the file leaves to the kind. */
static bool check_cloud(void *members, const lom_key_check *check)
{
    lom_cloud *it = members;
    if (it->file != NULL && it->kind != NULL)
        return check->fail(check, "file", "a cloud has either a kind or a file, not both.");
    if (check->is_given(check, "middle")) {
        it->position.x = it->middle[0];
        it->position.z = it->middle[1];
    }
    if (!check_transfer(it, check))
        return false;
    if (it->file != NULL)
        return true;
    if (it->kind == NULL)
        it->kind = "cumulus_mediocris";
    lom_error unknown = { 0 };
    const lom_cloud_kind *kind = lom_find_cloud_kind(it->kind, &unknown);
    if (kind == NULL)
        return check->fail(check, "kind", unknown.text);
    if (!check->is_given(check, "position"))
        it->position.y = lom_base_of_kind(kind);
    if (!check->is_given(check, "size"))
        memcpy(it->size, kind->size, sizeof it->size);
    const double shrink = lom_shrink_of_kind(kind, it->size);
    if (!check->is_given(check, "extinction"))
        it->extinction = lom_smaller(kind->extinction / shrink, 1000);
    if (!check->is_given(check, "detail_size"))
        it->detail_size *= shrink;
    for (int i = 0; i < 3; i++) {
        if (it->voxels[i] != lom_double_floor(it->voxels[i]))
            return check->fail(check, "voxels", "\"voxels\" must be made of whole numbers.");
        if (it->voxels[i] == 0)
            it->voxels[i] = kind->voxels[i];
    }
    return true;
}

const lom_key_table lom_cloud_keys = { .size = sizeof(lom_cloud),
                                       .keys = cloud,
                                       .key_count = sizeof cloud / sizeof *cloud,
                                       .text = "A cloud: a box of density. Boxes should not overlap.",
                                       .check = check_cloud };

#define OF_WIND(member) offsetof(lom_cloud_wind, member)
static const lom_key wind[] = {
    { "height", LOM_KEY_NUMBER, OF_WIND(height), .minimum = -1e5, .maximum = 1e5, .unit = "m",
      .text = "Where it blows (y); above the height of the wind before." },
    { "speed", LOM_KEY_NUMBER, OF_WIND(speed), .maximum = 1000, .unit = "m/s", .text = "How fast." },
    { "direction", LOM_KEY_ANGLE, OF_WIND(direction), .minimum = -360, .maximum = 360, .unit = "degrees",
      .text = "Where it blows to: 0 is +x, 90 is +z." },
    { "gust", LOM_KEY_NUMBER, OF_WIND(gust), .maximum = 1000, .unit = "m/s",
      .text = "How much the speed swings about that, as a sine of the time." },
    { "gust_period", LOM_KEY_NUMBER, OF_WIND(gust_period), .flags = LOM_KEY_ABOVE, .maximum = 1e6, .initial = { 20 },
      .unit = "s", .text = "Period of that sine." },
};
static const lom_key_table wind_table = {
    .size = sizeof(lom_cloud_wind),
    .keys = wind,
    .key_count = sizeof wind / sizeof *wind,
    .text = "The wind at a height: it takes the clouds there along. Between two heights "
            "their ways are mixed."
};

#define OF_MIX(member) offsetof(lom_cloud_mix, member)
static const lom_key mix[] = {
    { "kind", LOM_KEY_STRING, OF_MIX(kind), .flags = LOM_KEY_REQUIRED, .text = "A kind, as in `[[cloud]]`." },
    { "share", LOM_KEY_NUMBER, OF_MIX(share), .flags = LOM_KEY_ABOVE, .maximum = 1e6, .initial = { 1 },
      .text = "How many of the clouds are of it, in parts of the sum of all shares." },
};
static bool check_mix(void *members, const lom_key_check *check)
{
    const lom_cloud_mix *it = members;
    lom_error unknown = { 0 };
    return lom_find_cloud_kind(it->kind, &unknown) != NULL || check->fail(check, "kind", unknown.text);
}
static const lom_key_table mix_table = { .size = sizeof(lom_cloud_mix),
                                         .keys = mix,
                                         .key_count = sizeof mix / sizeof *mix,
                                         .text = "A kind of cloud in the sky that `count` or `oktas` makes.",
                                         .check = check_mix };

static const lom_key clouds[] = {
    { "phase", LOM_KEY_CHOICE, OF_ALL(phase), .choices = { "dual", "henyey_greenstein", "rayleigh", "isotropic" },
      .text = "Where light goes that is scattered: two Henyey-Greenstein lobes, the forward one alone, Rayleigh's "
              "function, or everywhere." },
    { "forward", LOM_KEY_NUMBER, OF_ALL(forward), .minimum = -0.99, .maximum = 0.99, .initial = { 0.8 },
      .text = "Mean cosine of the forward lobe." },
    { "backward", LOM_KEY_NUMBER, OF_ALL(backward), .minimum = -0.99, .maximum = 0.99, .initial = { -0.3 },
      .text = "Mean cosine of the backward lobe." },
    { "blend", LOM_KEY_NUMBER, OF_ALL(blend), .maximum = 1, .initial = { 0.35 },
      .text = "Share of the backward lobe." },
    { "silver", LOM_KEY_NUMBER, OF_ALL(silver), .maximum = 100, .initial = { 0.1 },
      .text = "Strength of the silver lining: a narrow lobe around the sun, seen through thin edges." },
    { "silver_spread", LOM_KEY_NUMBER, OF_ALL(silver_spread), .minimum = 0.01, .maximum = 1, .initial = { 0.1 },
      .text = "How wide that lobe is: 1 less its mean cosine." },
    { "albedo", LOM_KEY_NUMBER, OF_ALL(albedo), .maximum = 1, .initial = { 1 },
      .text = "Share of the light that a droplet scatters; the rest is absorbed." },
    { "brightness", LOM_KEY_NUMBER, OF_ALL(brightness), .maximum = 1000, .initial = { 1 },
      .text = "Factor on the sun's light in clouds." },
    { "sky", LOM_KEY_COLOR, OF_ALL(sky), 3, .maximum = 1000, .initial = { 0.28, 0.4, 0.6 },
      .text = "Light that reaches clouds from the sky above." },
    { "ground", LOM_KEY_COLOR, OF_ALL(ground), 3, .maximum = 1000, .initial = { 0.1, 0.11, 0.1 },
      .text = "Light that reaches clouds from below." },
    { "haze_color", LOM_KEY_COLOR, OF_ALL(haze_color), 3, .maximum = 1000, .initial = { 0.55, 0.66, 0.78 },
      .text = "Colour of the air that far clouds turn to." },
    { "haze_distance", LOM_KEY_NUMBER, OF_ALL(haze_distance), .maximum = 1e9, .unit = "m",
      .text = "Distance at which 1/e of a cloud is left; 0 is clear air." },
    { "shadows", LOM_KEY_BOOL, OF_ALL(shadows), .initial = { 1 },
      .text = "Whether clouds shadow one another, the ground and the water." },
    { "shadow_strength", LOM_KEY_NUMBER, OF_ALL(shadow_strength), .maximum = 1, .initial = { 0.85 },
      .text = "How dark the shadows on the ground and the water are." },
    { "original_light", LOM_KEY_CHOICE, OF_ALL(original_light),
      .choices = { "combined", "advance", "real_time", "none" },
      .text = "With `quality.clouds = \"original\"`: which of its two kinds of light." },
    { "lighter", LOM_KEY_NUMBER, OF_ALL(lighter), .maximum = 100, .initial = { 0.6 },
      .text =
          "The original's factor on the densities (0 to 255) met towards the sun. Its value was never published; with "
          "ours the sum passes 250 behind ten voxels of full density." },
    { "dark_light", LOM_KEY_NUMBER, OF_ALL(dark_light), .flags = LOM_KEY_ABOVE, .maximum = 1000, .initial = { 0.17 },
      .text = "The original's factor on the number of voxels met when their sum is above 250. Its value was never "
              "published; with ours a voxel behind ten of full density gets the gray 105 of 255." },
    { "wind", LOM_KEY_TABLES, OF_ALL(winds), .table = &wind_table, .length_offset = OF_ALL(wind_count),
      .text = "Winds by height, the lowest first." },
    { "evolve", LOM_KEY_NUMBER, OF_ALL(evolve), .maximum = 1e6, .unit = "s",
      .text = "Time in which the small shapes of clouds become others; 0: they stay as they are." },
    { "swell", LOM_KEY_NUMBER, OF_ALL(swell), .maximum = 1, .initial = { 0.3 },
      .text = "With `evolve`: how much the clouds grow and shrink meanwhile, each in a phase of its own." },
    { "count", LOM_KEY_INTEGER, OF_ALL(count), .maximum = LOM_MAX_SKY,
      .text = "A sky of many: so many clouds, beside those of `[[cloud]]`. Each is put where it overlaps least of the "
              "others." },
    { "oktas", LOM_KEY_NUMBER, OF_ALL(oktas), .maximum = 8,
      .text = "Instead of `count`: eighths of the area that clouds cover, seen from above." },
    { "metar", LOM_KEY_STRING, OF_ALL(metar),
      .text =
          "Instead of both: the clouds of a report, `\"FEW030 BKN120CB\"`, in layers; amounts FEW (1.5 oktas), SCT "
          "(3.5), BKN (6), OVC and VV (8), heights of bases in hundreds of feet, CB and TCU; other kinds follow from "
          "height and amount. A whole report begins with METAR or SPECI." },
    { "seed", LOM_KEY_INTEGER, OF_ALL(seed), .maximum = 2147483647, .initial = { 1 },
      .text = "Another seed puts other clouds in other places." },
    { "shapes", LOM_KEY_INTEGER, OF_ALL(shapes), .minimum = 1, .maximum = LOM_MAX_SKY_SHAPES, .initial = { 3 },
      .text = "How many volumes of each kind are made; clouds of one shape differ in size and turn." },
    { "area", LOM_KEY_NUMBER, OF_ALL(area), 2, .flags = LOM_KEY_SPREAD, .minimum = 1, .maximum = 1e6,
      .initial = { 16000, 16000 }, .unit = "m", .text = "Along x and z: where the middles of clouds are." },
    { "middle", LOM_KEY_NUMBER, OF_ALL(middle), 2, .minimum = -1e9, .maximum = 1e9, .unit = "m",
      .initial_text = "the terrain's, else 0", .text = "x and z of the middle of that area." },
    { "sizes", LOM_KEY_NUMBER, OF_ALL(sizes), 2, .minimum = 0.001, .maximum = 100, .initial = { 0.7, 1.3 },
      .text = "The least and the largest cloud, in parts of its kind's size. A cover that is nearly reached may be "
              "ended by "
              "smaller ones." },
    { "voxels", LOM_KEY_NUMBER, OF_ALL(voxels), .minimum = 0.01, .maximum = 1, .initial = { 0.5 },
      .text =
          "Voxels of these clouds along each axis, in parts of the kind's. Each cloud has a grid of light as fine as "
          "that times `quality.cloud_light_scale`." },
    { "base", LOM_KEY_NUMBER, OF_ALL(base), .maximum = 20000, .unit = "m", .text = "Height of all bases (y).",
      .initial_text = "one of the kind's range of heights" },
    { "mix", LOM_KEY_TABLES, OF_ALL(mix), .table = &mix_table, .length_offset = OF_ALL(mix_count),
      .text = "What the sky is made of; without it `cumulus_humilis`, `_mediocris` and `_fractus` as 3 : 2 : 1." },
};
static bool check_sky(lom_clouds *all, const lom_key_check *check)
{
    static const char *const told[] = { "count", "oktas", "base", "mix" }; /* by a report */
    lom_metar_layer layer[LOM_MAX_METAR_LAYERS];
    lom_error wrong = { 0 };
    if (!check->is_given(check, "base"))
        all->base = -1;
    if (all->count > 0 && all->oktas > 0)
        return check->fail(check, "oktas", "a sky has either a count of clouds or a cover.");
    if (all->sizes[0] > all->sizes[1])
        return check->fail(check, "sizes", "the least size of clouds is above the largest.");
    if (all->mix_count > LOM_MAX_MIX)
        return check->fail(check, "mix", "a sky is mixed of at most 16 kinds.");
    for (size_t i = 0; i < sizeof told / sizeof *told; i++)
        if (all->metar != NULL && check->is_given(check, told[i]))
            return check->fail(check, told[i], "a report of clouds (metar) tells this itself.");
    if (all->metar != NULL && lom_parse_metar(all->metar, layer, &wrong) < 0)
        return check->fail(check, "metar", wrong.text);
    return true;
}

static bool check_clouds(void *members, const lom_key_check *check)
{
    lom_clouds *all = members;
    for (size_t i = 1; i < all->wind_count; i++)
        if (!(all->winds[i].height > all->winds[i - 1].height)) {
            const lom_key_check at = check->element(check, "wind", i);
            return at.fail(&at, "height", "the heights of winds must rise.");
        }
    return check_sky(all, check);
}

const lom_key_table lom_clouds_keys = { .size = sizeof(lom_clouds),
                                        .keys = clouds,
                                        .key_count = sizeof clouds / sizeof *clouds,
                                        .text =
                                            "What all clouds share: how they scatter, and the light of sky and ground.",
                                        .check = check_clouds };
