/* A sky box. In: where the sun stands, how hazy and cloudy it is, a seed; out: six pictures that meet, because each
 * pixel is a function of its direction alone. Clear sky by scattering, fair-weather clouds above the horizon and thin
 * cirrus by noise on the sphere of directions, exposed, and rounded to 8 bits with a dither against bands. */
#include "base/numbers.h"
#include "base/range.h"
#include "geometry/noise.h"
#include "sky/atmosphere.h"

#include <lom/sky.h>

typedef struct painter {
    lom_noise noise;
    lom_atmosphere atmosphere;
    double cloudiness;
    double horizon[3]; /* radiance low in the sky, averaged over the directions: what clouds get from around */
    double exposure;
} painter;

typedef struct layer {
    double color[3], opacity;
} layer;

/* ---- clouds ---- */

/* High ice clouds: a sheet of streaks, drawn out along the wind. */
static double cirrus_density(const painter *p, lom_vec3 d)
{
    double slant = 1.0 / (d.y + 0.12);
    double x = d.x * slant, z = d.z * slant;
    double along = 0.82 * x + 0.57 * z, across = -0.57 * x + 0.82 * z;
    lom_octaves few = { .count = 3, .period = 256, .gain = 0.5 };
    lom_octaves many = { .count = 6, .period = 256, .gain = 0.58 };
    double bend = lom_fractal2(&p->noise, along * 0.7 + 3.5, across * 0.9 + 8.5, few);
    double swirl = lom_fractal2(&p->noise, along * 1.1 + 50.5, across * 1.3 + 18.5, few);
    double streak =
        lom_fractal2(&p->noise, along * 0.6 + 0.3 * swirl + 20.5, (across + 0.35 * bend) * 3.0 + 60.5, many);
    double cover = lom_fractal2(&p->noise, x * 0.45 + 90.5, z * 0.45 + 30.5, few);
    return lom_smooth_step(-0.12, 0.5, streak) * lom_smooth_step(-0.28 - 0.2 * p->cloudiness, 0.35, cover);
}

/* Heaps that float on a base a little above the horizon. The noise lives on a cylinder around the viewer, so that heaps
 * stand upright; what is higher in a cloud needs more of it. */
static double cumulus_density(const painter *p, lom_vec3 q, lom_octaves octaves)
{
    lom_octaves large = { .count = 2, .period = 256, .gain = 0.5 };
    double cover = lom_fractal3(&p->noise, q.x * 1.6 + 40.5, q.y * 1.1 + 9.5, q.z * 1.6 + 11.5, large);
    double heaps = lom_fractal3(&p->noise, q.x * 3.1 + 7.5, q.y * 5.0 + 3.5, q.z * 3.1 + 5.5, octaves);
    double base = lom_smooth_step(0.12, 0.16, q.y + 0.05 * cover);
    double height = lom_smooth_step(0.14, 0.5, q.y) + 2.5 * lom_smooth_step(0.30, 0.6, q.y);
    return base * (heaps * 0.95 + cover * 0.9 - 0.2 - 0.42 * height + 0.36 * p->cloudiness);
}

static lom_vec3 on_cylinder(lom_vec3 d)
{
    double flat = lom_double_sqrt(d.x * d.x + d.z * d.z);
    double inverse = flat > 0.3 ? 1.0 / flat : 1.0 / 0.3;
    return (lom_vec3){ d.x * inverse, d.y * inverse, d.z * inverse };
}

static layer cirrus(const painter *p, lom_vec3 d)
{
    layer l = { .opacity = 0 };
    if (d.y <= 0.01)
        return l;
    double density = cirrus_density(p, d) * lom_smooth_step(0.02, 0.22, d.y);
    const lom_vec3 sun = p->atmosphere.sun;
    double cosine = d.x * sun.x + d.y * sun.y + d.z * sun.z;
    double forward = 1.0 / (1.35 - cosine);
    l.opacity = 0.56 * p->cloudiness * density;
    for (int k = 0; k < 3; k++)
        l.color[k] = p->atmosphere.sunlight[k] * (0.075 + 0.016 * forward) + 0.6 * p->horizon[k];
    return l;
}

/* Lit by the sun as far as the cloud towards it lets its light through, from around by the sky. */
static layer cumulus(const painter *p, lom_vec3 d)
{
    layer l = { .opacity = 0 };
    lom_octaves fine = { .count = 6, .period = 256, .gain = 0.55 };
    lom_octaves coarse = { .count = 4, .period = 256, .gain = 0.5 };
    lom_vec3 q = on_cylinder(d);
    if (q.y < 0.04 || q.y > 0.95)
        return l;
    double density = cumulus_density(p, q, fine);
    if (density <= 0)
        return l;
    l.opacity = lom_smooth_step(0, 0.16, density);
    const lom_vec3 sun = p->atmosphere.sun;
    double shade = 0;
    for (int i = 1; i <= 3; i++) {
        double reach = 0.028 * i * i;
        lom_vec3 s = { q.x + sun.x * reach, q.y + (0.35 + sun.y) * reach, q.z + sun.z * reach };
        double between = cumulus_density(p, s, coarse);
        shade += between > 0 ? between * i : 0;
    }
    double direct = lom_double_exp(-3.2 * shade) * (0.75 + 0.25 * lom_double_exp(-6 * density));
    double cosine = d.x * sun.x + d.y * sun.y + d.z * sun.z;
    double rim = 0.022 / (1.12 - cosine) * lom_double_exp(-9 * density);
    double below = 0.75 + 0.5 * lom_smooth_step(0.08, 0.4, q.y);
    for (int k = 0; k < 3; k++)
        l.color[k] = p->atmosphere.sunlight[k] * (0.12 * direct + rim) + p->horizon[k] * below * 0.9;
    return l;
}

/* ---- the picture ---- */

static void add_sun(const painter *p, lom_vec3 d, double radiance[3])
{
    const lom_vec3 sun = p->atmosphere.sun;
    double dx = d.x - sun.x, dy = d.y - sun.y, dz = d.z - sun.z;
    double angle = lom_double_sqrt(dx * dx + dy * dy + dz * dz);
    double disc = 1.0 - lom_smooth_step(0.006, 0.011, angle);
    double glow = 0.0007 / (0.002 + angle * angle);
    for (int k = 0; k < 3; k++)
        radiance[k] += p->atmosphere.sunlight[k] * (3.0 * disc + 0.02 * glow);
}

/* Linear light, exposed: 1 - exp(-x) bends highlights instead of cutting them. */
static void paint_direction(const painter *p, lom_vec3 d, double color[3])
{
    double radiance[3];
    double low = d.y > 0 ? d.y : 0;
    lom_atmosphere_at(&p->atmosphere, (lom_vec3){ d.x, low, d.z }, radiance);
    if (d.y > -0.02)
        add_sun(p, d, radiance);
    layer layers[2] = { cirrus(p, d), cumulus(p, d) };
    double clear = 1.0 - 0.85 * lom_smooth_step(0.2, 0.02, d.y); /* distant clouds drown in the haze */
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 3; k++)
            radiance[k] = lom_mix_double(radiance[k], layers[i].color[k], layers[i].opacity * clear);
    double ground = lom_smooth_step(0, -0.35, d.y);
    static const double earth[3] = { 0.020, 0.024, 0.026 };
    for (int k = 0; k < 3; k++) {
        double light = lom_mix_double(radiance[k], earth[k] * 0.35, ground);
        color[k] = 1.0 - lom_double_exp(-p->exposure * light);
    }
}

static double encode_srgb(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * lom_double_pow(linear, 1.0 / 2.4) - 0.055;
}

/* An 8x8 ordered dither: bands vanish, and pictures still compress. */
static double dither(int x, int y)
{
    int bits = 0;
    for (int i = 0; i < 3; i++) {
        int a = x >> i & 1, b = y >> i & 1;
        bits = bits << 2 | (a ^ b) << 1 | b;
    }
    return (bits + 0.5) / 64.0 - 0.5;
}

/* The directions of OpenGL's cube map faces (OpenGL 4.6, table 8.19), s to the right and t down the picture. */
static lom_vec3 face_direction(int face, double s, double t)
{
    const lom_vec3 ray[6] = { { 1, -t, -s }, { -1, -t, s }, { s, 1, t }, { s, -1, -t }, { s, -t, 1 }, { -s, -t, -1 } };
    double length = lom_double_sqrt(1 + s * s + t * t);
    return (lom_vec3){ ray[face].x / length, ray[face].y / length, ray[face].z / length };
}

static lom_image *paint_face(const painter *p, int face, int size, lom_error *error)
{
    lom_image *picture = lom_create_image(size, size, 1, LOM_FORMAT_RGB8_SRGB, error);
    for (int y = 0; picture != NULL && y < size; y++)
        for (int x = 0; x < size; x++) {
            lom_vec3 d = face_direction(face, 2 * (x + 0.5) / size - 1, 2 * (y + 0.5) / size - 1);
            double color[3];
            paint_direction(p, d, color);
            uint8_t *pixel = lom_image_pixel(picture, x, y, 0);
            for (int k = 0; k < 3; k++)
                pixel[k] = lom_unorm8_of_double(encode_srgb(color[k]) + dither(x, y) / 255.0);
        }
    return picture;
}

static void measure_horizon(painter *p)
{
    for (int i = 0; i < 16; i++) {
        double angle = lom_two_pi * i / 16;
        double radiance[3];
        lom_atmosphere_at(&p->atmosphere, (lom_vec3){ 0.9 * lom_double_cos(angle), 0.436, 0.9 * lom_double_sin(angle) },
                          radiance);
        for (int k = 0; k < 3; k++)
            p->horizon[k] += radiance[k] / 16;
    }
}

static bool check_desc(const lom_sky_box_desc *desc, int size, lom_error *error)
{
    if (size < 8 || size > 4096)
        return lom_fail(error, LOM_ERROR_USAGE, "A sky box is made with a side of 8 to 4096, not %d.", size);
    return lom_check_range(desc->sun_azimuth, -1000, 1000, error, "The sun's azimuth over a sky box") &&
           lom_check_range(desc->sun_elevation, -1.5708, 1.5708, error, "The sun's elevation over a sky box") &&
           lom_check_range(desc->haziness, 0, 100, error, "The haziness of a sky box") &&
           lom_check_range(desc->cloudiness, 0, 1, error, "The cloudiness of a sky box");
}

bool lom_make_sky_box(const lom_sky_box_desc *desc, lom_image *faces[6], lom_error *error)
{
    static const lom_sky_box_desc defaults = { .size = 0 };
    desc = desc != NULL ? desc : &defaults;
    int size = desc->size != 0 ? desc->size : 1024;
    for (int i = 0; i < 6; i++)
        faces[i] = NULL;
    if (!check_desc(desc, size, error))
        return false;
    lom_float_state state;
    lom_enter_float_state(&state);
    painter p = { .cloudiness = desc->cloudiness, .exposure = 16.0 };
    lom_seed_noise(&p.noise, desc->seed);
    double flat = lom_double_cos(desc->sun_elevation);
    lom_vec3 sun = { lom_double_sin(desc->sun_azimuth) * flat, lom_double_sin(desc->sun_elevation),
                     -lom_double_cos(desc->sun_azimuth) * flat };
    lom_fill_atmosphere(&p.atmosphere, sun, desc->haziness);
    measure_horizon(&p);
    bool done = true;
    for (int i = 0; i < 6 && done; i++) {
        faces[i] = paint_face(&p, i, size, error);
        done = faces[i] != NULL;
    }
    lom_leave_float_state(&state);
    for (int i = 0; i < 6 && !done; i++) {
        lom_free_image(faces[i]);
        faces[i] = NULL;
    }
    return done;
}

lom_image *lom_make_sky_cube(const lom_sky_box_desc *desc, lom_error *error)
{
    lom_image *faces[6], *cube = NULL;
    if (!lom_make_sky_box(desc, faces, error))
        return NULL;
    cube = lom_create_image(faces[0]->width, faces[0]->height, 6, faces[0]->format, error);
    if (cube != NULL)
        cube->slices = LOM_SLICES_CUBE;
    for (int i = 0; i < 6; i++) {
        if (cube != NULL)
            memcpy(lom_image_pixel(cube, 0, 0, i), faces[i]->pixels, lom_image_size(faces[i]));
        lom_free_image(faces[i]);
    }
    return cube;
}
