/* Lesson 12. Spectrum, transform, foam: waves OUT.png
 * In: a wind. Out: a picture in three squares: how the wind shares its energy out to waves (their directions and lengths),
 * the surface that those waves add up to, seen from above, and where it folds over: foam. */
#include <lom/geometry.h>
#include <lom/sea.h>

#include <stdio.h>

enum { SIZE = 128 };

/* Brightness of the logarithm of what waves of the wave vector (kx, kz) have, over six powers of ten. */
static void paint_spectrum(lom_image *picture, const lom_wave_spectrum *spectrum)
{
    double peak = spectrum->peak * spectrum->peak / spectrum->gravity; /* the wave number of the highest waves */
    double largest = lom_directional_spectrum(spectrum, spectrum->wind[0] * peak, spectrum->wind[1] * peak);
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++) {
            double kx = (x - SIZE / 2) * peak / 12, kz = (y - SIZE / 2) * peak / 12;
            double share = lom_directional_spectrum(spectrum, kx, kz) / largest;
            float bright = share > 0 ? (float)(1 + lom_double_log2(share) / 20) : 0;
            for (int c = 0; c < 3; c++)
                ((float *)lom_image_pixel(picture, x, y, 0))[c] = bright > 0 ? bright * bright : 0;
        }
}

/* The water's light from its slopes, and white where the Jacobian of its motion is small. */
static void paint_surface(lom_image *picture, const lom_sea_cascade *sea, int left, bool shows_foam)
{
    static const float water[3] = { 0.02f, 0.09f, 0.13f }, sky[3] = { 0.35f, 0.5f, 0.65f };
    const lom_vec3 to_sun = { -0.6, 0.5, -0.62 };
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++) {
            int place = y * (sea->size / SIZE) * sea->size + x * (sea->size / SIZE);
            const float *d = sea->displacement + 4 * place, *e = sea->derivatives + 4 * place;
            double xx = 1 + e[2], zz = 1 + e[3], xz = d[3];
            lom_vec3 normal = { xz * e[1] - e[0] * zz, xx * zz - xz * xz, xz * e[0] - e[1] * xx };
            normal = lom_vec3_normalize(normal);
            float light = (float)lom_vec3_dot(normal, to_sun), height = (float)(0.5 + d[1] / (2 * sea->highest));
            float foam = shows_foam ? (0.8f - sea->jacobian[place]) * 5 : 0;
            foam = foam < 0 ? 0 : foam > 1 ? 1 : foam;
            for (int c = 0; c < 3; c++) {
                float shade = water[c] * (0.5f + height) + sky[c] * (light > 0 ? light * light : 0);
                ((float *)lom_image_pixel(picture, left + x, y, 0))[c] = shade + (0.9f - shade) * foam;
            }
        }
}

static bool draw_sea(lom_image *picture, lom_error *error)
{
    lom_sea_desc desc = { .wind_speed = 18,
                          .wind_direction = 0.6,
                          .fetch = 200e3,
                          .cascade_count = 1,
                          .shortest_wave = 4,
                          .choppiness = 1.3,
                          .seed = 3 };
    desc.cascade[0] = (lom_cascade_desc){ .size = 128, .length = 350 };
    lom_sea_desc resolved;
    lom_device *device = lom_open_device(&(lom_device_desc){ 0 }); /* for its threads */
    lom_sea *sea = lom_resolve_sea(&desc, &resolved, error) ? lom_create_sea(&desc, device, error) : NULL;
    bool done = sea != NULL && lom_advance_sea(sea, device, 10, error);
    if (done) {
        lom_wave_spectrum spectrum = lom_sea_spectrum(&resolved);
        lom_sea_cascade view = lom_view_cascade(sea, 0);
        paint_spectrum(picture, &spectrum);
        paint_surface(picture, &view, SIZE, false);
        paint_surface(picture, &view, 2 * SIZE, true);
    }
    lom_free_sea(sea);
    lom_close_device(device);
    return done;
}

int main(int argc, char **argv)
{
    lom_error error = { .code = LOM_OK };
    lom_image *picture = lom_create_image(3 * SIZE, SIZE, 1, LOM_FORMAT_RGB32F, &error);
    bool drawn = picture != NULL && argc == 2 && draw_sea(picture, &error);
    lom_image *bytes = drawn ? lom_convert_image(picture, LOM_FORMAT_RGB8_SRGB, &error) : NULL;
    bool done = bytes != NULL && lom_write_image(argv[1], NULL, bytes, &error);
    lom_free_image(picture);
    lom_free_image(bytes);
    if (!done)
        fprintf(stderr, "waves: nothing was written; usage: waves OUT.png. %s\n", error.text);
    return done ? 0 : 2;
}
