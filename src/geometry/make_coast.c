/* Coasts. In: a name, a seed. Out: a height map of a square of 400 m whose black is 20 m below the sea and whose white
 * is 44 m above it; z grows down the picture. A height is a function of the place alone. */
#include "base/numbers.h"
#include "noise.h"

#include <lom/geometry.h>

#include <string.h>

static const double side = 400, deepest = 20, relief = 64;

typedef double coast_height(const lom_noise *noise, double x, double z); /* metres, of x and z in 0..400 */

static double bend(const lom_noise *noise, double x, double z, double length, double amount)
{
    lom_octaves octaves = { .count = 3, .period = 256, .gain = 0.5 };
    return amount * lom_fractal2(noise, x / length + 7.3, z / length + 3.1, octaves);
}

/* A beach of sand: d metres from its line, below it a bed that deepens like d^(2/3) (Dean 1977), above it dunes. */
static double beach(double d, double slope)
{
    if (d < 0)
        return 9 * (1 - lom_double_exp(d * slope / 9)) * 1.0;
    double root = lom_double_cbrt(d);
    return -slope * 2.2 * root * root;
}

/* Ripples that waves leave on a sandy bed. */
static double ripples(const lom_noise *noise, double x, double z)
{
    double phase = (z + bend(noise, x, z, 9, 3)) / 1.9;
    return 0.035 * lom_double_sin(lom_two_pi * phase) + bend(noise, x, z, 5, 0.12);
}

/* A rock that rises from the bed: a bump of this radius and height, broken by ridges. */
static double rock(const lom_noise *noise, double x, double z, double at_x, double at_z, double radius, double height)
{
    double dx = (x - at_x) / radius, dz = (z - at_z) / radius, square = dx * dx + dz * dz;
    if (square > 4)
        return -1000;
    lom_octaves octaves = { .count = 5, .period = 256, .gain = 0.55 };
    double ridge = lom_ridged2(noise, x / (1.1 * radius) + 11.5, z / (1.1 * radius) + 4.5, octaves);
    double bump = 1.35 - square * (1.1 + 0.4 * square);
    return height * (bump * (0.45 + 0.75 * ridge) + 0.35 * (ridge - 0.5)) - 4;
}

/* Land to the north, a bay of clear shallow water before it, a reef, then the deep. */
static double lagoon(const lom_noise *noise, double x, double z)
{
    double d = z - 120 - bend(noise, x, z * 0.3, 130, 55) - 0.0012 * (x - 210) * (x - 210);
    double inner = beach(d, 0.16), floor = -3.4 + bend(noise, x, z, 60, 2.0);
    double bed = inner < floor ? floor : inner;
    double out = lom_smooth_step(285, 380, z + bend(noise, x, z, 80, 30));
    double reef = lom_double_exp(-(z - 292) * (z - 292) / 250) * (3.2 + bend(noise, x, z, 12, 3));
    bed = lom_mix_double(bed, -17, out) + reef * (1 - out) * lom_smooth_step(60, 150, d);
    double coral = lom_larger(0, bend(noise, x + 90, z, 7, 3) - 0.75) * 2.0 * lom_smooth_step(40, 90, d);
    bed += coral + ripples(noise, x, z) * lom_smooth_step(-2, 3, d);
    bed += lom_smooth_step(-25, -75, d) * (10 + bend(noise, x, z, 45, 16));
    bed = lom_larger(bed, rock(noise, x, z, 120, 196, 13, 9));
    bed = lom_larger(bed, rock(noise, x, z, 146, 212, 6, 5));
    return lom_larger(bed, rock(noise, x, z, 300, 172, 17, 13));
}

/* A beach that faces the open sea in the south, between two headlands of rock. */
static double cove(const lom_noise *noise, double x, double z)
{
    double d = z - 150 - bend(noise, x, 0.4 * z, 90, 22) - 0.0016 * (x - 200) * (x - 200);
    double bed = beach(d, 0.13) + ripples(noise, x, z) * lom_smooth_step(-2, 3, d);
    bed += lom_smooth_step(-18, -80, d) * (15 + bend(noise, x, z, 55, 22));
    lom_octaves octaves = { .count = 6, .period = 256, .gain = 0.55 };
    double ridge = lom_ridged2(noise, x / 75 + 2.5, z / 75 + 8.5, octaves);
    double west = lom_smooth_step(110, 20, x + bend(noise, x, z, 60, 30)) * lom_smooth_step(330, 230, z);
    double east = lom_smooth_step(300, 385, x + bend(noise, z, x, 60, 26)) * lom_smooth_step(300, 190, z);
    bed += (west + east) * (6 + 34 * ridge);
    bed = lom_larger(bed, rock(noise, x, z, 152, 196, 8, 7));
    bed = lom_larger(bed, rock(noise, x, z, 164, 206, 5, 6));
    return lom_larger(bed, rock(noise, x, z, 258, 202, 10, 9));
}

/* A river through woods: it winds from the north to the south between banks, over gravel. */
static double river(const lom_noise *noise, double x, double z)
{
    double middle = 200 + 46 * lom_double_sin(z / 46) + 20 * lom_double_sin(z / 19 + 1) + bend(noise, 40, z, 70, 20);
    double half = 11 + bend(noise, 90, z, 40, 6), off = x - middle, away = off < 0 ? -off : off;
    double bank = away - half + bend(noise, x, z, 12, 3.5);
    double bed = -1.9 + 1.3 * (away / half) * (away / half) + bend(noise, x, z, 6, 0.7);
    double land = 1.4 + 0.05 * lom_larger(bank, 0) + bend(noise, x, z, 40, 3) * lom_smooth_step(0, 25, bank);
    double hills = lom_smooth_step(50, 170, bank) * (16 + bend(noise, x, z, 70, 26));
    return lom_mix_double(bed < 0.2 ? bed : 0.2, land + hills, lom_smooth_step(-2.5, 3.5, bank));
}

/* A cirque: a plateau in the north breaks off in ribs and ledges around a plunge pool, from which a stream leaves to
 * the south between banks of gravel. The stream's notch in the rim is at x = 200. */
static double falls(const lom_noise *noise, double x, double z)
{
    lom_octaves octaves = { .count = 5, .period = 256, .gain = 0.55 };
    double side_way = x - 200 - bend(noise, 30, z, 60, 10) * lom_smooth_step(215, 260, z);
    double away = side_way < 0 ? -side_way : side_way;
    double ribs = lom_ridged2(noise, x / 26 + 3.7, z / 70 + 1.3, octaves);
    double worn = lom_double_exp(-away * away / 90), mouth = lom_double_exp(-away * away / 18);
    double rim = 174 + 0.0095 * (x - 197) * (x - 197) + bend(noise, x, z * 0.5, 48, 12) - 11 * worn;
    double d = rim - z + (ribs - 0.5) * 10 * (1 - 0.8 * worn) + bend(noise, x, z, 7, 1.8) * (1 - 0.6 * worn);
    double ledge = (1 - worn) * lom_larger(0, 2.5 + bend(noise, x, z, 22, 9)), step = 8 + 5 * ribs;
    double low = lom_smooth_step(0, 2.8, d), high = lom_smooth_step(2.8 + ledge, 6 + ledge, d);
    double shelf = (1 - worn) * lom_larger(0, 2 + bend(noise, x + 70, z, 19, 8)), third = 6 + ledge + shelf;
    double top = 17 + bend(noise, x, z, 30, 3) * (1 - worn) + 0.1 * lom_larger(d - 8, 0);
    double crown = (1 - worn) * (4 + 9 * lom_ridged2(noise, x / 60 + 6.5, z / 60 + 2.5, octaves)) + 6 * worn;
    double notch = (3 + bend(noise, x, z, 5, 1.5)) * mouth;
    double wall = low * step + high * (top - step) + lom_smooth_step(third, third + 2.6, d) * (crown - notch);
    double pool_z = (z - 186) / 31, pool_x = (x - 200) / 27, pool = lom_double_sqrt(pool_x * pool_x + pool_z * pool_z);
    double banks = (pool - 1) * 9 + bend(noise, x, z, 11, 4), stream = away - 6.5 + bend(noise, x, z, 10, 3);
    double past = lom_smooth_step(206, 222, z);
    double shore = lom_mix_double(banks, stream < banks ? stream : banks, past);
    double ground =
        shore < 0 ? -2.6 * (1 - lom_double_exp(shore / 5)) - 0.35 : -0.35 + 0.24 * shore + 0.0035 * shore * shore;
    ground = ground < 12 ? ground : 12 + 0.2 * (ground - 12);
    double gravel = lom_larger(0, bend(noise, x + 50, z, 4.5, 2.2) - 0.1) * lom_smooth_step(-5, 3, shore);
    return ground + 0.55 * gravel + bend(noise, x, z, 2.6, 0.3) + lom_smooth_step(-0.5, 0.5, d) * wall;
}

/* A long beach of sand that falls evenly into the sea in the south, over low banks, with dunes behind it. */
static double strand(const lom_noise *noise, double x, double z)
{
    double d = z - 140 - bend(noise, x, 0.3 * z, 120, 14), slope = 0.085, banks = bend(noise, x + 20, z, 90, 0.6);
    double deep = lom_smooth_step(150, 240, d), bed = lom_mix_double(-slope * d, -16, deep);
    double dunes = lom_smooth_step(-18, -70, d) * (4 + bend(noise, x, z, 40, 7));
    bed = d < 0 ? 4 * (1 - lom_double_exp(d * slope / 4)) + dunes : bed;
    bed += banks * lom_smooth_step(8, 40, d) * (1 - deep);
    return bed + bend(noise, x, z, 9, 0.12) * lom_smooth_step(20, -2, d);
}

static const struct coast {
    const char *name;
    coast_height *height;
} coasts[] = { { "lagoon", lagoon }, { "cove", cove }, { "river", river }, { "falls", falls }, { "strand", strand } };
enum { COASTS = sizeof coasts / sizeof coasts[0] };

const char *lom_coast_name(size_t index)
{
    return index < COASTS ? coasts[index].name : NULL;
}

lom_image *lom_make_coast(const char *name, int size, uint64_t seed, lom_error *error)
{
    const struct coast *coast = NULL;
    for (size_t i = 0; i < COASTS; i++)
        if (strcmp(coasts[i].name, name) == 0)
            coast = &coasts[i];
    if (coast == NULL || size < 2 || size > 4096) {
        lom_fail(error, LOM_ERROR_USAGE, "There is no coast \"%s\" of %d pixels a side.", name, size);
        return NULL;
    }
    lom_float_state state;
    lom_enter_float_state(&state);
    lom_noise noise;
    lom_seed_noise(&noise, seed);
    lom_image *map = lom_create_image(size, size, 1, LOM_FORMAT_R16, error);
    for (int y = 0; map != NULL && y < size; y++)
        for (int x = 0; x < size; x++) {
            double height = coast->height(&noise, side * x / (size - 1), side * y / (size - 1));
            uint16_t *pixel = lom_image_pixel(map, x, y, 0);
            *pixel = (uint16_t)lom_count_of(lom_clamp_double((height + deepest) / relief, 0, 1) * 65535 + 0.5, 65535);
        }
    lom_leave_float_state(&state);
    return map;
}
