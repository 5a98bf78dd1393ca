/* Proves: METAR text is the layers of its table, and what is none is refused with a sentence; a sky of many covers the
 * oktas that are asked for, measured over the volumes themselves, holds as many clouds as asked, at the heights of
 * their genera, and is a function of its numbers. */
#include "check.h"
#include "cloud/cloud_sky.h"

#include "base/numbers.h"

#include <lom/scene.h>

#include <stdio.h>
#include <string.h>

static const lom_cloud pattern = { .present = true, .density = 1, .detail = 0.35, .detail_size = 180, .visible = true };
static const lom_clouds plain = { .seed = 1,
                                  .shapes = 2,
                                  .area = { 12000, 9000 },
                                  .middle = { 500, -2000 },
                                  .sizes = { 0.8, 1.2 },
                                  .voxels = 0.25,
                                  .base = -1 };

/* ---- METAR ---- */

static void metar_text_is_its_table(void)
{
    static const struct {
        const char *text;
        int count;
        lom_metar_layer layer[3];
    } rows[] = {
        { "FEW030 BKN120CB", 2, { { 1.5, 30 * 30.48, "cumulus_humilis" }, { 6, 120 * 30.48, "cumulonimbus" } } },
        { "SCT015", 1, { { 3.5, 15 * 30.48, "cumulus_mediocris" } } },
        { "BKN040TCU", 1, { { 6, 40 * 30.48, "cumulus_congestus" } } },
        { "OVC008 OVC100 OVC250",
          3,
          { { 8, 8 * 30.48, "stratus" }, { 8, 100 * 30.48, "altostratus" }, { 8, 250 * 30.48, "cirrostratus" } } },
        { "BKN020 BKN110 BKN300",
          3,
          { { 6, 20 * 30.48, "stratocumulus" },
            { 6, 110 * 30.48, "altocumulus" },
            { 6, 300 * 30.48, "cirrocumulus" } } },
        { "FEW000", 1, { { 1.5, 0, "cumulus_humilis" } } },
        { "FEW/// SCT///CB OVC010///",
          3,
          { { 1.5, -1, "cumulus_humilis" }, { 3.5, -1, "cumulonimbus" }, { 8, 10 * 30.48, "stratus" } } },
        { "VV002", 1, { { 8, 0, "stratus" } } },
        { "NSC", 0, { { 0, 0, NULL } } },
        { "CAVOK", 0, { { 0, 0, NULL } } },
        { " SKC\n", 0, { { 0, 0, NULL } } },
        { "METAR LSZH 301650Z 24010KT 9999 FEW012 SCT300 M02/M05 Q1013 BECMG BKN004",
          2,
          { { 1.5, 12 * 30.48, "cumulus_humilis" }, { 3.5, 300 * 30.48, "cirrus" } } },
        { "SPECI EDDF 301650Z VRB02KT CAVOK=", 0, { { 0, 0, NULL } } },
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        lom_metar_layer layer[LOM_MAX_METAR_LAYERS];
        lom_error error = { 0 };
        int count = lom_parse_metar(rows[i].text, layer, &error);
        CHECK(count == rows[i].count, "\"%s\" has %d layers: %s", rows[i].text, count, error.text);
        for (int k = 0; k < count && count == rows[i].count; k++)
            CHECK(layer[k].oktas == rows[i].layer[k].oktas && layer[k].base == rows[i].layer[k].base &&
                      strcmp(layer[k].kind, rows[i].layer[k].kind) == 0,
                  "\"%s\", layer %d: %g oktas of %s at %g m", rows[i].text, k, layer[k].oktas, layer[k].kind,
                  layer[k].base);
    }
}

static void what_is_no_group_is_refused(void)
{
    static const struct {
        const char *text, *sentence;
    } rows[] = {
        { "", "at least one group" },
        { " \t", "at least one group" },
        { "FEW03", "\"FEW03\" is no group" },
        { "FEW0300", "\"FEW0300\" is no group" },
        { "FEW03O", "\"FEW03O\" is no group" },
        { "few030", "\"few030\" is no group" },
        { "FEW-30", "\"FEW-30\" is no group" },
        { "BKN120CBX", "\"BKN120CBX\" is no group" },
        { "VV", "\"VV\" is no group" },
        { "FEW030 METAR", "\"METAR\" is no group" },
        { "24010KT FEW030", "begins with METAR or SPECI" },
        { "FEW001 FEW001 FEW001 FEW001 FEW001 FEW001 FEW001 FEW001 FEW001", "at most 8 groups" },
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        lom_metar_layer layer[LOM_MAX_METAR_LAYERS];
        lom_error error = { 0 };
        CHECK(lom_parse_metar(rows[i].text, layer, &error) == -1 && strstr(error.text, rows[i].sentence) != NULL,
              "\"%s\" gives \"%s\"", rows[i].text, error.text);
    }
}

/* ---- the sky ---- */

static size_t place(const lom_clouds *sky, lom_cloud clouds[LOM_MAX_SKY])
{
    size_t count = 0;
    lom_error error = { 0 };
    CHECK(lom_place_sky(sky, &pattern, clouds, &count, &error), "a sky: %s", error.text);
    return count;
}

/* The share of the area over which a cloud's own volume, column by column, has an optical depth of 0.1 or more. */
static double measure_cover(const lom_clouds *sky, const lom_cloud *clouds, size_t count)
{
    enum { CELLS = 200 };
    const double eaten = pattern.detail * 0.49; /* on average by noise */
    static bool hidden[CELLS * CELLS];
    memset(hidden, 0, sizeof hidden);
    for (size_t i = 0; i < count; i++) {
        const lom_cloud *c = &clouds[i];
        const int n[3] = { (int)c->voxels[0], (int)c->voxels[1], (int)c->voxels[2] };
        lom_image *volume = lom_make_cloud(&(lom_cloud_desc){ c->kind, n[0], n[1], n[2], (uint64_t)c->seed }, NULL);
        double sine = lom_double_sin(c->yaw), cosine = lom_double_cos(c->yaw);
        for (int z = 0; z < CELLS; z++)
            for (int x = 0; x < CELLS; x++) {
                double dx = sky->middle[0] + sky->area[0] * ((x + 0.5) / CELLS - 0.5) - c->position.x;
                double dz = sky->middle[1] + sky->area[1] * ((z + 0.5) / CELLS - 0.5) - c->position.z;
                double s = (cosine * dx - sine * dz) / c->size[0] + 0.5, sum = 0;
                double t = (sine * dx + cosine * dz) / c->size[2] + 0.5;
                if (!(s >= 0 && s < 1 && t >= 0 && t < 1))
                    continue;
                for (int y = 0; y < n[1]; y++) {
                    uint16_t density;
                    memcpy(&density, lom_image_pixel(volume, (int)(s * n[0]), y, (int)(t * n[2])), sizeof density);
                    double left = (density / 65535.0 - eaten) / (1 - eaten);
                    sum += left > 0 ? left : 0;
                }
                hidden[z * CELLS + x] |= sum * c->extinction * c->size[1] / n[1] >= 0.1;
            }
        lom_free_image(volume);
    }
    int sum = 0;
    for (int i = 0; i < CELLS * CELLS; i++)
        sum += hidden[i];
    return (double)sum / (CELLS * CELLS);
}

static lom_cloud clouds[LOM_MAX_SKY], again[LOM_MAX_SKY];

static void cover_is_the_oktas(void)
{
    static const lom_cloud_mix pads[] = { { .kind = "stratocumulus", .share = 1 } };
    for (int oktas = 1; oktas <= 7; oktas += 2)
        for (int layered = 0; layered < 2; layered++) {
            lom_clouds sky = plain;
            sky.oktas = oktas;
            sky.mix = layered ? (lom_cloud_mix *)pads : NULL;
            sky.mix_count = (size_t)layered;
            size_t count = place(&sky, clouds);
            double cover = 8 * measure_cover(&sky, clouds, count);
            CHECK(cover > oktas - 0.5 && cover < oktas + 0.5, "%d oktas of %s are %g in %zu clouds", oktas,
                  layered ? "stratocumulus" : "cumulus", cover, count);
        }
}

static void a_report_has_its_layers(void)
{
    lom_clouds sky = plain;
    sky.metar = "SCT030 OVC100";
    size_t count = place(&sky, clouds), low = 0;
    while (low < count && clouds[low].position.y < 1000)
        low++;
    double cover[2] = { 8 * measure_cover(&sky, clouds, low), 8 * measure_cover(&sky, clouds + low, count - low) };
    CHECK(cover[0] > 3 && cover[0] < 4, "SCT is %g oktas in %zu clouds", cover[0], low);
    CHECK(cover[1] > 7.5, "OVC is %g oktas in %zu clouds", cover[1], count - low);
    for (size_t i = 0; i < count; i++)
        CHECK(clouds[i].position.y == (i < low ? 30 : 100) * 30.48 &&
                  strcmp(clouds[i].kind, i < low ? "cumulus_mediocris" : "altostratus") == 0,
              "cloud %zu is %s at %g m", i, clouds[i].kind, clouds[i].position.y);
    sky.metar = "NSC";
    CHECK(place(&sky, clouds) == 0, "no clouds");
}

static void a_sky_is_a_function_of_its_numbers(void)
{
    lom_clouds sky = plain;
    CHECK(!lom_has_sky(&sky) && place(&sky, clouds) == 0, "none");
    sky.count = 40;
    CHECK(place(&sky, clouds) == 40 && place(&sky, again) == 40, "as many as asked");
    CHECK(memcmp(clouds, again, 40 * sizeof *clouds) == 0, "the same numbers give the same sky");
    sky.count = 25;
    CHECK(place(&sky, again) == 25 && memcmp(clouds, again, 25 * sizeof *clouds) == 0, "more clouds leave the others");
    sky.seed = 2;
    CHECK(place(&sky, again) == 25 && clouds[0].position.x != again[0].position.x, "another seed gives another sky");
}

static void clouds_are_of_their_genus(void)
{
    lom_clouds sky = plain;
    sky.count = 60;
    size_t count = place(&sky, clouds), kinds[3] = { 0 };
    for (size_t i = 0; i < count; i++) {
        const lom_cloud *c = &clouds[i];
        const lom_cloud_kind *kind = lom_find_cloud_kind(c->kind, NULL);
        double size = c->size[0] / kind->size[0], x = c->position.x - 500, z = c->position.z + 2000;
        kinds[kind->name[8] == 'h' ? 0 : kind->name[8] == 'm' ? 1 : 2]++;
        CHECK(c->position.y >= kind->low && c->position.y <= kind->high, "%s at %g m", c->kind, c->position.y);
        CHECK(size >= 0.8 && size <= 1.2 && c->seed >= 1 && c->seed <= 2, "size %g, shape %d", size, c->seed);
        CHECK(x >= -6000 && x <= 6000 && z >= -4500 && z <= 4500, "at %g, %g of the area", x, z);
        CHECK((size >= 1 ? c->extinction <= kind->extinction * 1.06 : c->extinction >= kind->extinction) &&
                  c->visible && c->detail == 0.35,
              "the pattern's and the kind's");
    }
    CHECK(kinds[0] > kinds[1] && kinds[1] > kinds[2] && kinds[2] > 0, "3 : 2 : 1 are %zu, %zu, %zu", kinds[0], kinds[1],
          kinds[2]);
    sky.base = 1234;
    CHECK(place(&sky, clouds) == 60 && clouds[7].position.y == 1234, "a base of one's own");
}

static void too_many_are_refused(void)
{
    lom_clouds sky = plain;
    lom_error error = { 0 };
    size_t count = 0;
    sky.oktas = 4;
    sky.area[0] = sky.area[1] = 300000;
    CHECK(!lom_place_sky(&sky, &pattern, clouds, &count, &error) && error.code == LOM_ERROR_LIMIT, "%s", error.text);
}

static void bad_skies_are_refused(void)
{
    static const struct {
        const char *text, *sentence;
    } rows[] = {
        { "count = 3\noktas = 2", "s.toml:3:9: a sky has either a count of clouds or a cover." },
        { "sizes = [2, 1]", "s.toml:2:9: the least size of clouds is above the largest." },
        { "metar = 'FEW030'\nbase = 9", "s.toml:3:8: a report of clouds (metar) tells this itself." },
        { "metar = 'FEW030 BKN12CB'", "s.toml:2:9: \"BKN12CB\" is no group of clouds such as FEW030, BKN120CB, OVC/// "
                                      "or NSC (a whole report begins "
                                      "with METAR or SPECI)." },
        { "[[clouds.mix]]\nkind = 'cumulus'", "s.toml:3:8: There is no kind of cloud \"cumulus\"" },
        { "oktas = 8\narea = 900000\nsizes = 0.2", "s.toml:4:9: \"sizes\" must be an array of 2 numbers" },
        { "oktas = 8\narea = 900000", "A sky has at most 4096 clouds" },
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char text[200];
        lom_error error = { 0 };
        snprintf(text, sizeof text, "[clouds]\n%s\n", rows[i].text);
        lom_scene *scene = lom_decode_scene(text, strlen(text), "-", NULL, 0, &error);
        const char *sentence = rows[i].sentence + (strncmp(rows[i].sentence, "s.toml", 6) == 0 ? 6 : 0);
        CHECK(scene == NULL && strstr(error.text, sentence) != NULL, "%s: \"%s\"", rows[i].text, error.text);
        lom_free_scene(scene);
    }
}

int main(int argc, char **argv)
{
    RUN(metar_text_is_its_table);
    RUN(what_is_no_group_is_refused);
    RUN(cover_is_the_oktas);
    RUN(a_report_has_its_layers);
    RUN(a_sky_is_a_function_of_its_numbers);
    RUN(clouds_are_of_their_genus);
    RUN(too_many_are_refused);
    RUN(bad_skies_are_refused);
    return check_result();
}
