/* Proves the foam of a river: there is none where the water is slow; below a sill, over which it is faster than its waves,
 * it is e^(-t / window) of what is made there, t the time that the water took; at every width its pattern goes with the
 * water, and each of its two phases starts again where its share is 0. */
#include "check.h"

#include "waves/river.h"
#include "waves/wave_field.h"

enum { SIZE = 64, SILL = 20, LAST = 24 };
static double depth[SIZE * SIZE];
static float foam[SIZE * SIZE];
static lom_device *device;

/* A channel along +y of this depth, with a sill across it. */
static lom_image *channel(double sill)
{
    for (int i = 0; i < SIZE * SIZE; i++) {
        const bool wet = i % SIZE >= 20 && i % SIZE < 36;
        depth[i] = !wet ? -1 : i / SIZE >= SILL && i / SIZE < LAST ? sill : 2;
    }
    return lom_make_river(depth, SIZE, 1.5707963267948966, NULL);
}

static double foam_at(int x, int y)
{
    return (double)foam[y * SIZE + x];
}

static void slow_water_has_none(void)
{
    lom_image *field = channel(2);
    const struct lom_river_foam_desc desc = { depth, 1.5, { 1, 1 }, 4 };
    lom_carry_river_foam(foam, field, &desc);
    for (int i = 0; i < SIZE * SIZE; i++)
        CHECK(foam[i] == 0, "%g at %d, %d", (double)foam[i], i % SIZE, i / SIZE);
    lom_free_image(field);
}

static void it_is_carried_from_a_sill_and_fades(void)
{
    lom_image *field = channel(0.2);
    for (int n = 0; n < 3; n++) {
        const struct lom_river_foam_desc desc = { depth, 1.2, { 0.5 + 0.5 * n, 0.5 + 0.5 * n }, 2 + 3 * n };
        lom_carry_river_foam(foam, field, &desc);
        double seconds = 0;
        for (int y = 2; y < SILL - 2; y++)
            CHECK(foam_at(28, y) == 0, "above the sill %g at %d", foam_at(28, y), y);
        CHECK(foam_at(28, SILL + 2) > 0.99, "on the sill %g", foam_at(28, SILL + 2));
        for (int y = LAST + 2; y < SIZE - 2; y++) {
            const float *v = lom_image_pixel(field, 28, y, 0);
            seconds += desc.cell[1] / ((double)v[1] * desc.speed);
            const double left = lom_double_exp(-seconds / desc.window), ratio = foam_at(28, y) / foam_at(28, LAST + 1);
            CHECK(left < 0.03 || (ratio > 0.9 * left && ratio < 1.1 * left), "row %d: %g left, not %g", y, ratio, left);
            CHECK(foam_at(28, y) <= foam_at(28, y - 1), "row %d: more than before", y);
        }
        CHECK(foam_at(40, LAST + 4) == 0, "on land");
    }
    lom_free_image(field);
}

enum { COLUMNS = 40 };
static float heights[(COLUMNS + 1) * (COLUMNS + 1)]; /* zeros: a level bed */

static void slopes_at(const struct lom_wave_site *site, double time, struct lom_wave_slopes *w)
{
    static const uint8_t up[4] = { 128, 128, 255, 255 };
    static const struct lom_footprint point;
    lom_texture *ripples = lom_make_texture(
        device, &(lom_texture_desc){ .width = 1, .height = 1, .format = LOM_FORMAT_RGBA8, .pixels = up });
    const struct lom_wave_source source = { site, ripples, NULL, device };
    struct lom_waves_uniform waves;
    lom_error error = { 0 };
    memset(&waves, 0, sizeof waves);
    struct lom_wave_field *field = lom_load_wave_field(&source, &error);
    CHECK(field != NULL && lom_place_waves(field, &waves, (lom_vec3){ 3, 0, 2 }, time, &error), "%s", error.text);
    *w = lom_find_slopes(&waves, lom_splat(1), lom_splat(-2), &point);
    lom_free_wave_field(field);
    lom_release_texture(device, ripples);
}

static void its_pattern_goes_with_the_water(void)
{
    static const lom_shallow_water not_shallow;
    static const lom_water_surf no_surf;
    const lom_water_waves waves = { .kind = LOM_WAVES_FLOW, .speed = 2, .direction = 0 };
    const lom_water_foam carried = { .amount = 1, .window = 3, .carried = true, .tile = 6 };
    const struct lom_wave_site site = { .waves = &waves,
                                        .foam = &carried,
                                        .surf = &no_surf,
                                        .shallow = &not_shallow,
                                        .size = { COLUMNS, COLUMNS },
                                        .tile = 2,
                                        .ripple_up = 3,
                                        .bed = { heights, COLUMNS, COLUMNS, { COLUMNS, COLUMNS }, -3 } };
    int turns = 0;
    struct lom_wave_slopes before, after;
    slopes_at(&site, 50, &before);
    for (int i = 1; i <= 50; i++, before = after) {
        const double step = 0.05;
        slopes_at(&site, 50 + step * i, &after);
        const double way[2] = { (double)(after.drift_x[0] - before.drift_x[0]),
                                (double)(after.again_x[LOM_LANES - 1] - before.again_x[0]) };
        const double share[2] = { 1 - (double)after.again[0], (double)after.again[0] };
        for (int k = 0; k < 2; k++) {
            const bool goes = way[k] / step > 1.8 && way[k] / step < 2.2; /* 2 on the mean of the water */
            CHECK(goes || share[k] < 0.11, "phase %d moves by %g m/s at a share of %g", k, way[k] / step, share[k]);
            turns += !goes;
        }
    }
    CHECK(turns >= 4, "%d times a phase starts again", turns);
}

int main(int argc, char **argv)
{
    device = lom_open_device(&(lom_device_desc){ .threads = 1, .lanes = LOM_LANES });
    RUN(slow_water_has_none);
    RUN(it_is_carried_from_a_sill_and_fades);
    RUN(its_pattern_goes_with_the_water);
    lom_close_device(device);
    return check_result();
}
