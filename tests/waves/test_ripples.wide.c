/* Proves of ripples of a normal map on still water, at every width: their slope is that of the map's normal, its up
 * component scaled; the map drifts by whole repetitions a second and where the flow map moves it; what its levels
 * average away is variance. */
#include "check.h"

#include "waves/wave_field.h"

enum { SIZE = 64 };

static lom_device *device;

static lom_texture *map_of(const uint8_t (*pixels)[4], int size)
{
    return lom_make_texture(
        device,
        &(lom_texture_desc){ .width = size, .height = size, .pixels = pixels, .label = "map", .mips = LOM_MIPS_ALL });
}

static const struct lom_footprint point;

static struct lom_wave_slopes slopes_at(const struct lom_wave_site *site, const lom_texture *normals,
                                        const lom_texture *flow, double time, const double place[2],
                                        const struct lom_footprint *f)
{
    const struct lom_wave_source source = { site, normals, flow, device };
    struct lom_waves_uniform waves;
    lom_error error = { 0 };
    memset(&waves, 0, sizeof waves);
    struct lom_wave_field *field = lom_load_wave_field(&source, &error);
    CHECK(field != NULL && lom_place_waves(field, &waves, (lom_vec3){ 0, 0, 0 }, time, &error), "%s", error.text);
    lom_free_wave_field(field);
    return lom_find_slopes(&waves, lom_splat((float)place[0]), lom_splat((float)place[1]), f);
}

static bool near(double a, double b, double bound)
{
    return a - b < bound && b - a < bound;
}

static const lom_water_waves still = { .kind = LOM_WAVES_NONE };
static const lom_water_foam no_foam;
static const lom_water_surf no_surf;
static const lom_shallow_water not_shallow;

static struct lom_wave_site site_of(double tile, double up, double speed)
{
    return (struct lom_wave_site){ .waves = &still,
                                   .foam = &no_foam,
                                   .surf = &no_surf,
                                   .shallow = &not_shallow,
                                   .size = { 100, 100 },
                                   .tile = tile,
                                   .ripple_up = up,
                                   .is_rippled = true,
                                   .ripple_speed = speed };
}

/* One normal everywhere: (2 r - 1, up b, 2 g - 1). */
static void a_slope_is_that_of_the_normal(void)
{
    static const uint8_t colors[][4] = { { 178, 140, 230, 255 }, { 20, 200, 180, 255 }, { 128, 128, 255, 255 } };
    static const double ups[] = { 1, 3, 20 };
    for (size_t i = 0; i < 3; i++) {
        const struct lom_wave_site site = site_of(7, ups[i], 0.1);
        lom_texture *map = map_of(&colors[i], 1);
        struct lom_wave_slopes w = slopes_at(&site, map, NULL, 3, (double[2]){ 1.7, -40 }, &point);
        double up = ups[i] * colors[i][2] / 255, x = 2 * colors[i][0] / 255. - 1, z = 2 * colors[i][1] / 255. - 1;
        CHECK(near(w.sx[0], -x / up, 1e-3) && near(w.sz[LOM_LANES - 1], -z / up, 1e-3), "%g %g, not %g %g", w.sx[0],
              w.sz[0], -x / up, -z / up);
        CHECK(w.xx[0] == 0 && w.xz[0] == 0 && w.zz[0] == 0, "the surface is displaced");
        lom_release_texture(device, map);
    }
}

/* A ramp along z: after 3 s at 1/12 of a repetition a second it has moved by a quarter; a flow map of red and green moves it
 * by a tenth of them more. Alone it stands still. */
static void the_map_drifts(void)
{
    static uint8_t ramp[SIZE * SIZE][4];
    static const uint8_t flows[2][4] = { { 0, 255, 0, 255 }, { 0, 0, 0, 0 } };
    for (int i = 0; i < SIZE * SIZE; i++) {
        const uint8_t step[4] = { 128, (uint8_t)(4 * (i / SIZE)), 255, 255 };
        memcpy(ramp[i], step, sizeof step);
    }
    lom_texture *map = map_of((const uint8_t(*)[4])ramp, SIZE);
    const struct lom_wave_site site = site_of(10, 1, 1. / 12);
    const double place[2] = { 0, 2.2 }, moved[3] = { 0, 0.35, 0.25 };
    for (int k = 0; k < 3; k++) {
        lom_texture *flow = k == 0 ? NULL : map_of(&flows[k - 1], 1);
        struct lom_wave_slopes w = slopes_at(&site, map, flow, 3, place, &point);
        double texel = (place[1] / 10 + moved[k]) * SIZE - 0.5, exact = -(2 * 4 * texel / 255 - 1);
        CHECK(near(w.sz[0], exact, 5e-3), "flow %d: %g, not %g", k, w.sz[0], exact);
        lom_release_texture(device, flow);
    }
    lom_release_texture(device, map);
}

/* Two normals in turn, leaning to both sides: from afar the surface is level and as rough as they are. */
static void what_is_averaged_is_variance(void)
{
    static uint8_t checks[SIZE * SIZE][4];
    for (int i = 0; i < SIZE * SIZE; i++) {
        const uint8_t lean[4] = { (uint8_t)((i % SIZE + i / SIZE) % 2 != 0 ? 166 : 89), 128, 249, 255 };
        memcpy(checks[i], lean, sizeof lean);
    }
    lom_texture *map = map_of((const uint8_t(*)[4])checks, SIZE);
    const struct lom_wave_site site = site_of(4, 1, 0);
    const struct lom_footprint wide = { lom_splat(2), { 0 }, { 0 }, lom_splat(2) };
    struct lom_wave_slopes w = slopes_at(&site, map, NULL, 0, (double[2]){ 0.3, 0.4 }, &wide);
    double up = 2 * 249 / 255. - 1, exact = 0.5 * (1 - up) / up / (249 / 255. * 249 / 255.);
    CHECK(near(w.sx[0], 0, 0.01) && near(w.sz[0], 0, 0.01), "seen: %g %g", w.sx[0], w.sz[0]);
    CHECK(near(w.vxx[0], exact, 0.05 * exact) && w.vxx[0] == w.vzz[0], "hidden: %g, not %g", w.vxx[0], exact);
    lom_release_texture(device, map);
}

int main(int argc, char **argv)
{
    device = lom_open_device(&(lom_device_desc){ .threads = 1, .lanes = LOM_LANES });
    RUN(a_slope_is_that_of_the_normal);
    RUN(the_map_drifts);
    RUN(what_is_averaged_is_variance);
    lom_close_device(device);
    return check_result();
}
