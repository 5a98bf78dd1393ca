/* The height map of a mountain lake. In: a size and a seed; out: 16-bit gray whose level 1/16 is the water's surface,
 * black the deepest lake bed, white the highest summit. The plan of the lake is drawn by hand below, in metres over
 * 1600 x 1600 m, x to the east, z to the south, where one stands and looks north; rivers, screes and rain do the rest.
 */
#include "geometry/erosion.h"
#include "geometry/noise.h"

#include <lom/geometry.h>

static const double extent = 1600.0;   /* metres of a side */
static const double relief = 400.0;    /* metres from black to white */
static const double lake_depth = 25.0; /* metres from black to the water's surface: relief / 16 */

/* ---- the plan ---- */

/* All points within `radius` of a line, the radius changing along it. */
typedef struct stroke {
    double x0, z0, x1, z1, radius0, radius1;
} stroke;

static const stroke water[] = {
    { 40, -20, -10, 250, 190, 210 },   /* the open lake */
    { -10, 250, 10, 455, 200, 75 },    /* the bay in front */
    { -60, -60, -260, -190, 110, 45 }, /* an arm behind the western ridge */
    { 150, 60, 300, -10, 120, 40 },    /* a cove in the east */
};
static const stroke land[] = {
    { -170, 440, -47, 409, 40, 17 }, /* the cape with the cabin */
    { 95, 515, 30, 476, 26, 8 },     /* the spit in the south */
    { -4, 432, 1, 428, 3.5, 3 },     /* the shoal with the reeds */
    { 260, 235, 138, 205, 60, 14 },  /* a wooded headland */
    { -260, 130, -128, 96, 70, 16 }, /* another, behind the first */
    { 52, 132, 70, 124, 13, 8 },     /* an islet */
    { -38, 250, -34, 247, 5, 3 },    /* rocks */
};

/* Hills beside the valley floor: middle, radius, height. */
static const struct knoll {
    double x, z, radius, height;
} knolls[] = {
    { 268, 250, 85, 24 }, { 185, 215, 45, 9 }, { -245, 140, 95, 26 }, { -165, 108, 50, 9 },
    { -150, 452, 60, 7 }, { 62, 128, 16, 5 },  { 130, 540, 60, 9 },   { -250, 330, 100, 18 },
};

static double knoll_height(double x, double z)
{
    double sum = 0;
    for (size_t i = 0; i < sizeof knolls / sizeof knolls[0]; i++) {
        double dx = (x - knolls[i].x) / knolls[i].radius, dz = (z - knolls[i].z) / knolls[i].radius;
        double inside = lom_clamp_double(1 - dx * dx - dz * dz, 0, 1);
        sum += knolls[i].height * inside * inside;
    }
    return sum;
}

/* Distance to the stroke's edge, negative inside. */
static double stroke_distance(const stroke *s, double x, double z)
{
    double ax = s->x1 - s->x0, az = s->z1 - s->z0;
    double t = lom_clamp_double(((x - s->x0) * ax + (z - s->z0) * az) / (ax * ax + az * az), 0, 1);
    double dx = x - (s->x0 + ax * t), dz = z - (s->z0 + az * t);
    return lom_double_sqrt(dx * dx + dz * dz) - lom_mix_double(s->radius0, s->radius1, t);
}

/* A minimum without a crease, `width` wide. */
static double soft_minimum(double a, double b, double width)
{
    double overlap = lom_clamp_double(1.0 - (a > b ? a - b : b - a) / width, 0, 1);
    return (a < b ? a : b) - overlap * overlap * width * 0.25;
}

/* Metres to the shore: positive on land, negative in the lake. The shore is rough by noise, the foreground little. */
static double shore_distance(const lom_noise *noise, double x, double z)
{
    double rough = 0.12 + 0.88 * lom_smooth_step(400, 250, z);
    lom_octaves octaves = { .count = 4, .period = 256, .gain = 0.5 };
    double wx = x + rough * 95.0 * lom_fractal2(noise, x / 190.0 + 40.5, z / 190.0 + 40.5, octaves);
    double wz = z + rough * 95.0 * lom_fractal2(noise, x / 190.0 + 90.5, z / 190.0 + 70.5, octaves);
    double lake = 1e9;
    for (size_t i = 0; i < sizeof water / sizeof water[0]; i++)
        lake = soft_minimum(lake, stroke_distance(&water[i], wx, wz), 60);
    double ground = 1e9;
    for (size_t i = 0; i < sizeof land / sizeof land[0]; i++)
        ground = soft_minimum(ground, stroke_distance(&land[i], wx, wz), 12);
    double shore = -soft_minimum(-lake, ground, 10); /* land wins */
    return shore + rough * 3.0 * lom_noise2(noise, x / 17.0, z / 17.0, 256);
}

/* How fast the land rises, 0..1: a range in the north, lower walls at the sides, hills in the south. */
static double uplift_at(const lom_noise *noise, double x, double z, double shore)
{
    lom_octaves octaves = { .count = 3, .period = 256, .gain = 0.5 };
    double uneven = lom_fractal2(noise, x / 420.0 + 20.5, z / 420.0 + 60.5, octaves);
    double north = lom_smooth_step(180, -620, z + 160.0 * uneven);
    double side = lom_smooth_step(190, 620, x > 0 ? x : -x * 1.05);
    double south = lom_smooth_step(300, 620, z);
    double rise = 0.08 + 0.95 * north + 0.5 * side * (1 - 0.65 * south);
    double summit_x = (x + 95) / 190, summit_z = (z + 560) / 150;
    rise *= 1 - 0.45 * lom_smooth_step(-600, -800, z);
    rise += 1.5 / (1.0 + summit_x * summit_x + summit_z * summit_z);
    rise *= 0.75 + 0.55 * uneven;
    return lom_clamp_double(rise, 0.04, 3) * lom_smooth_step(0, 170, shore);
}

/* ---- the ground, from coarse to fine ---- */

/* Centres of cells, in metres. */
static double place(const lom_field *field, int i)
{
    return (i + 0.5) * field->cell - 0.5 * extent;
}

typedef struct landscape {
    lom_noise noise;
    lom_field height, shore, uplift;
} landscape;

static void plan_level(landscape *l)
{
    int size = l->height.size;
    for (int j = 0; j < size; j++)
        for (int i = 0; i < size; i++) {
            size_t k = (size_t)j * (size_t)size + (size_t)i;
            double x = place(&l->height, i), z = place(&l->height, j);
            l->shore.values[k] = shore_distance(&l->noise, x, z);
            l->uplift.values[k] = l->shore.values[k] <= 0 ? 0 : 1e-4 + uplift_at(&l->noise, x, z, l->shore.values[k]);
        }
}

/* Makes room for a level of twice the size and plans it. */
static bool refine(landscape *l, lom_error *error)
{
    lom_field fine = lom_double_field(&l->height, error);
    lom_release(l->height.values);
    lom_release(l->shore.values);
    lom_release(l->uplift.values);
    l->height = fine;
    l->shore = lom_create_field(fine.size, fine.cell, error);
    l->uplift = lom_create_field(fine.size, fine.cell, error);
    if (!l->height.values || !l->shore.values || !l->uplift.values)
        return false;
    plan_level(l);
    return true;
}

/* Small bumps, so that new valleys find their way. */
static void roughen(landscape *l, double wavelength, double amount)
{
    int size = l->height.size;
    lom_octaves octaves = { .count = 3, .period = 256, .gain = 0.6 };
    for (int j = 0; j < size; j++)
        for (int i = 0; i < size; i++) {
            size_t k = (size_t)j * (size_t)size + (size_t)i;
            double x = place(&l->height, i) / wavelength, z = place(&l->height, j) / wavelength;
            if (l->shore.values[k] > 0)
                l->height.values[k] += amount * lom_smooth_step(0, 60, l->shore.values[k]) *
                                       (1 + lom_fractal2(&l->noise, x + 3.5, z + 9.5, octaves));
        }
}

/* Land by rivers, with 1.0 of uplift meaning `rate` metres in a unit of time. */
static bool run_rivers(landscape *l, int steps, uint64_t seed, lom_error *error)
{
    const double rate = 48.0;
    size_t cells = (size_t)l->uplift.size * (size_t)l->uplift.size;
    for (size_t k = 0; k < cells; k++)
        l->uplift.values[k] *= rate;
    lom_rivers rivers = { .uplift = l->uplift.values,
                          .incision = extent,
                          .talus = { 0.45, 1.25 },
                          .rock_height = 260,
                          .creep = 0.3,
                          .step = 0.3,
                          .steps = steps,
                          .seed = seed };
    bool done = lom_erode_by_rivers(&l->height, &rivers, error);
    for (size_t k = 0; k < cells; k++)
        l->uplift.values[k] /= rate;
    return done;
}

/* Rock: crests and ledges where the ground is steep and high; and hummocks below. */
static void add_rock(landscape *l)
{
    int size = l->height.size;
    lom_octaves ledges = { .count = 5, .period = 256, .gain = 0.55 };
    lom_octaves hummocks = { .count = 4, .period = 256, .gain = 0.5 };
    for (int j = 1; j + 1 < size; j++)
        for (int i = 1; i + 1 < size; i++) {
            double *h = l->height.values + (size_t)j * (size_t)size + (size_t)i;
            double shore = l->shore.values[(size_t)j * (size_t)size + (size_t)i];
            if (shore <= 0)
                continue;
            double x = place(&l->height, i), z = place(&l->height, j);
            double high = lom_smooth_step(20, 200, *h);
            double crest = lom_ridged2(&l->noise, x / 95.0 + 7.5, z / 95.0 + 5.5, ledges) - 0.4;
            double bump = lom_fractal2(&l->noise, x / 45.0 + 77.5, z / 45.0 + 15.5, hummocks);
            *h += lom_smooth_step(4, 120, shore) * (34.0 * high * crest + 4.0 * bump);
        }
}

/* The shore: land comes down to the water on a gentle ramp, steeper under the high walls, and the bed goes on from it.
 */
static void shape_shore(landscape *l)
{
    int size = l->height.size;
    lom_octaves octaves = { .count = 4, .period = 256, .gain = 0.5 };
    for (int j = 0; j < size; j++)
        for (int i = 0; i < size; i++) {
            size_t k = (size_t)j * (size_t)size + (size_t)i;
            double x = place(&l->height, i), z = place(&l->height, j);
            double d = l->shore.values[k];
            double bump = lom_fractal2(&l->noise, x / 30.0 + 31.5, z / 30.0 + 63.5, octaves);
            double steep = 0.5 + 0.5 * lom_noise2(&l->noise, x / 150.0 + 5.5, z / 150.0 + 8.5, 256);
            if (d > 0) {
                double ramp = 4.5 * d / (d + 60) * (1 + 0.4 * bump);
                double width = lom_mix_double(25, 90, steep);
                double most = l->height.values[k] > 0 ? l->height.values[k] : 0;
                double hill = knoll_height(x, z) * (1 + 0.5 * bump);
                l->height.values[k] = most * lom_smooth_step(0, width, d) + hill * lom_smooth_step(0, 14, d) + ramp;
            } else {
                double shelf = -d * lom_mix_double(0.05, 0.14, steep);
                double floor_depth = lake_depth * (0.75 + 0.2 * bump);
                double drop = floor_depth * lom_smooth_step(4, 110, -d);
                double depth = shelf + drop + 0.25 * bump * lom_smooth_step(0, 12, -d);
                l->height.values[k] = -lom_clamp_double(depth, 0.02, lake_depth);
            }
        }
}

/* The highest summit becomes white; the shore keeps its ramp: heights are stretched by a factor that grows from 1. */
static void fit_relief(landscape *l)
{
    size_t cells = (size_t)l->height.size * (size_t)l->height.size;
    double highest = 1;
    for (size_t k = 0; k < cells; k++)
        if (l->height.values[k] > highest)
            highest = l->height.values[k];
    double factor = (relief - lake_depth) / highest;
    for (size_t k = 0; k < cells; k++) {
        double h = l->height.values[k];
        if (h > 0)
            l->height.values[k] =
                h * lom_mix_double(factor < 1 ? factor : 1, factor, lom_smooth_step(0, highest * 0.25, h));
    }
}

static bool form_land(landscape *l, const lom_height_map_desc *desc, lom_error *error)
{
    const int coarse = 256;
    l->height = lom_create_field(coarse / 2, extent / (coarse / 2), error);
    if (l->height.values == NULL || !refine(l, error))
        return false;
    roughen(l, 120, 6);
    if (!run_rivers(l, 110, desc->seed + 1, error))
        return false;
    while (l->height.size < desc->size) {
        if (!refine(l, error))
            return false;
        if (l->height.size == 2 * coarse) {
            roughen(l, 40, 3);
            if (!run_rivers(l, 14, desc->seed + 2, error))
                return false;
        }
    }
    fit_relief(l);
    add_rock(l);
    lom_erode_by_gravity(&l->height, 1.05, 20);
    double ratio = (double)desc->size / 1024.0;
    lom_erode_by_rain(&l->height, &(lom_rain){ lom_int_of(260000 * ratio * ratio), 0.5, desc->seed + 3 });
    lom_erode_by_gravity(&l->height, 1.0, 6);
    shape_shore(l);
    fit_relief(l);
    return true;
}

lom_image *lom_make_height_map(const lom_height_map_desc *desc, lom_error *error)
{
    lom_height_map_desc d = desc != NULL ? *desc : (lom_height_map_desc){ .size = 0 };
    if (d.size == 0)
        d.size = 1024;
    if (d.size != 256 && d.size != 512 && d.size != 1024 && d.size != 2048) {
        lom_fail(error, LOM_ERROR_USAGE, "A height map is made with a side of 256, 512, 1024 or 2048, not %d.", d.size);
        return NULL;
    }
    landscape l = { 0 };
    lom_float_state state;
    lom_enter_float_state(&state);
    lom_seed_noise(&l.noise, d.seed);
    lom_image *map = NULL;
    if (form_land(&l, &d, error))
        map = lom_create_image(d.size, d.size, 1, LOM_FORMAT_R16, error);
    for (int y = 0; map != NULL && y < d.size; y++)
        for (int x = 0; x < d.size; x++) {
            double h = l.height.values[(size_t)y * (size_t)d.size + (size_t)x];
            uint16_t *pixel = lom_image_pixel(map, x, y, 0);
            *pixel = (uint16_t)lom_count_of(lom_clamp_double((h + lake_depth) / relief, 0, 1) * 65535.0 + 0.5, 65535);
        }
    lom_leave_float_state(&state);
    lom_release(l.height.values);
    lom_release(l.shore.values);
    lom_release(l.uplift.values);
    return map;
}
