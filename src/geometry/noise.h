/* Coherent noise for everything that is made rather than drawn. All functions are pure, use + - * / and square root
 * alone, and are periodic in whole lattice cells, so that what is made of them can be tiled without a seam. */
#ifndef LOM_GEOMETRY_NOISE_H
#define LOM_GEOMETRY_NOISE_H

#include <lom/base.h>

/* A random order of 0..255, twice in a row. */
typedef struct lom_noise {
    uint8_t order[512];
} lom_noise;

/* The noise that belongs to a seed. */
void lom_seed_noise(lom_noise *noise, uint64_t seed);

/* Gradient noise (Perlin 2002: fifth-degree fade, gradients on the lattice), mean 0, within [-1, 1]. The lattice
 * repeats after `period` cells, 1..256, in x and y (and z). */
double lom_noise2(const lom_noise *noise, double x, double y, int period);
/* The same with a period for each direction. */
double lom_noise2_grid(const lom_noise *noise, double x, double y, int columns, int rows);
double lom_noise3(const lom_noise *noise, double x, double y, double z, int period);

/* Sums of octaves: octave i has frequency 2^i, period * 2^i cells (bounded by 256, which period * 2^i then has to
 * divide or reach), amplitude gain^i, and its own offset; divided by the sum of the amplitudes. */
typedef struct lom_octaves {
    int count, period;
    double gain;
} lom_octaves;
/* fBm, within [-1, 1]. */
double lom_fractal2(const lom_noise *noise, double x, double y, lom_octaves octaves);
double lom_fractal3(const lom_noise *noise, double x, double y, double z, lom_octaves octaves);
/* Ridged multifractal (Musgrave, in Ebert et al.: Texturing and Modeling, 2003, ch. 16), within [0, 1]: (1 - |n|)^2,
 * each octave weighted by the one before, so that valleys stay smooth and crests get rough. */
double lom_ridged2(const lom_noise *noise, double x, double y, lom_octaves octaves);

/* Cellular noise (Worley 1996): one point a cell. */
typedef struct lom_cell {
    double nearest, second; /* distances to the two nearest points, in cells */
    double x, y;            /* from the nearest point to (x, y) */
    uint32_t identity;      /* 16 random bits of the nearest point */
} lom_cell;
/* The lattice repeats after `columns` cells in x and `rows` in y, 3..256. */
lom_cell lom_cellular2(const lom_noise *noise, double x, double y, int columns, int rows);

/* ---- the small functions of procedural shading ---- */

double lom_mix_double(double a, double b, double t);        /* a + (b - a) t */
double lom_clamp_double(double x, double low, double high); /* low for NaN */
double lom_smooth_step(double low, double high, double x);  /* cubic, clamped; high may be below low */
/* The byte of a number of [0, 1], rounded to nearest; clamped. */
uint8_t lom_unorm8_of_double(double x);

#endif
