/* lom/sea.h - the open sea: wave spectra, and a surface of several cascades summed by Fourier transforms.
 *
 * Conventions: y up, the undisturbed surface is y = 0, x and z horizontal, p = (x, z); metres, seconds, radians. An
 * angle is measured from +x towards +z, and the wind is named by where it blows *to*.
 *
 * The surface of one cascade, a patch of length L that repeats in x and z, is
 *     h(p, t) = sum over k of H(k, t) exp(i k.p),   k = 2 pi / L (n, m),   -N/2 < n, m < N/2,
 *     H(k, t) = h0(k) exp(-i w t) + conj(h0(-k)) exp(i w t),   w^2 = g k tanh(k d),
 *     h0(k)   = (a + i b) / 2 sqrt(P(k)) 2 pi / L,   a, b standard normal numbers of (seed, n, m)
 * (J. Tessendorf: Simulating ocean water, SIGGRAPH course notes, 2001; the sign of t is the other one, so that h0(k) is
 * the wave that travels along +k). P is the directional spectrum, so the expected variance of h is the sum of
 * P(k) (2 pi / L)^2. The waves n = -N/2 and m = -N/2, which have no direction on the grid, and k = 0 have none.
 * h0 depends on (seed, n, m, L), not on N: a finer grid adds waves and changes none.
 */
#ifndef LOM_SEA_H
#define LOM_SEA_H

#include <lom/pipeline.h>

LOM_API_BEGIN

/* ---- named winds ---- */

/* A level of the Beaufort scale. */
typedef struct lom_wind_level {
    const char *name;   /* "calm", "light-air", "light-breeze", "gentle-breeze", "moderate-breeze", "fresh-breeze",
                           "strong-breeze", "near-gale", "gale", "strong-gale", "storm", "violent-storm", "hurricane" */
    int beaufort;       /* 0..12 */
    double speed;       /* m/s at 10 m, the middle of the level (WMO: 0.836 B^(3/2)) */
    const char *effect; /* what the sea looks like */
} lom_wind_level;

int lom_wind_level_count(void);
const lom_wind_level *lom_wind_level_at(int index); /* NULL outside 0 .. count - 1 */
/* The level of that name; NULL, with an error that suggests the nearest name, when there is none. */
const lom_wind_level *lom_find_wind_level(const char *name, lom_error *error);

/* ---- the description of a sea: its zero value is a good one ---- */

typedef enum lom_spectrum_kind {
    LOM_SPECTRUM_JONSWAP = 0,       /* Hasselmann et al. 1973: a sea that grows with the fetch; in finite depth TMA */
    LOM_SPECTRUM_PIERSON_MOSKOWITZ, /* Pierson, Moskowitz 1964: fully developed; in finite depth with TMA's factor */
    LOM_SPECTRUM_PHILLIPS           /* Tessendorf 2001: a / (2 pi) exp(-1/(kL)^2) / k^4 |cos|^2 with a = 0.0081 */
} lom_spectrum_kind;

typedef enum lom_spreading_kind {
    LOM_SPREADING_AUTO = 0,       /* COSINE_SQUARED for Phillips, HASSELMANN for the others */
    LOM_SPREADING_COSINE_SQUARED, /* cos^2 / pi to both sides: as much against the wind as with it */
    LOM_SPREADING_COSINE_2S,      /* cos^2s of half the angle; s given, or after Mitsuyasu et al. 1975 */
    LOM_SPREADING_HASSELMANN,     /* cos^2s with s of Hasselmann, Dunckel, Ewing 1980 */
    LOM_SPREADING_DONELAN_BANNER  /* sech^2, Donelan, Hamilton, Hui 1985 with Banner's 1990 tail */
} lom_spreading_kind;

enum { LOM_MAX_CASCADES = 8 };

typedef struct lom_cascade_desc {
    int size;      /* N, samples a side: a power of two, 16..2048; 0: 256 */
    double length; /* L, metres, 1e-3..1e6; 0: 6 peak wavelengths for the first, then each 6.854 times shorter */
    double
        longest; /* waves from this length on are left out; 0: no limit for the first, else where the one before ends */
    double
        shortest; /* the shortest wave that takes part; 0: a sixth of the next cascade's length, 2 L / N for the last */
    uint64_t seed; /* 0: made from the sea's seed and the cascade's number */
} lom_cascade_desc;

typedef struct lom_sea_desc {
    lom_spectrum_kind spectrum;
    lom_spreading_kind spreading;
    const char *wind_level;    /* a name of the table above; NULL: wind_speed */
    double wind_speed;         /* m/s at a height of 10 m, up to 100; 0: 8 */
    bool calm;                 /* no wind at all (or no depth): a flat sea, whatever the rest says */
    double wind_direction;     /* radians, where it blows to */
    double fetch;              /* metres of water before the wind, 1..1e8; 0: 100 km. JONSWAP only */
    double peak_enhancement;   /* JONSWAP's gamma, 1..20; 0: 3.3 */
    double spreading_exponent; /* s of COSINE_2S, up to 100; 0: after Mitsuyasu */
    double depth;              /* metres, up to 1e6; 0: deep water */
    double gravity;            /* m/s^2, up to 1000; 0: 9.80665 */
    double height_scale;       /* factor on all heights, up to 1000; 0: 1 */
    double
        shortest_wave; /* metres: waves shorter than this fade as exp(-(k l)^2), l = shortest_wave / (2 pi); 0: none */
    double choppiness; /* factor on the horizontal displacement, up to 10; 0: 1, which is the physical one */
    bool heights_only; /* no horizontal displacement, whatever choppiness says: crests as round as troughs */
    uint64_t seed;
    int cascade_count; /* 0: 3 */
    lom_cascade_desc cascade[LOM_MAX_CASCADES];
} lom_sea_desc;

/* Fills in every default and checks every range: NaN, infinities, sizes that are no power of two, bands that overlap.
 * A named wind level becomes its speed; wind level "calm" sets calm. */
bool lom_resolve_sea(const lom_sea_desc *desc, lom_sea_desc *resolved, lom_error *error);

/* ---- spectra, in double ---- */

/* A spectrum ready to be evaluated; plain data. */
typedef struct lom_wave_spectrum {
    lom_spectrum_kind kind;
    lom_spreading_kind spreading;
    double wind[2]; /* unit vector */
    double peak;    /* rad/s, of the spectrum's maximum (Phillips: of omega^2 = g k at k = 1 / L) */
    double speed;   /* of the wind */
    double level;   /* a: 0.0081, or of the fetch */
    double enhancement, exponent, depth, gravity, scale,
        damping; /* depth infinite for deep water; scale on variances */
} lom_wave_spectrum;

/* The spectrum of a resolved description; that of a calm sea is 0 everywhere. */
lom_wave_spectrum lom_sea_spectrum(const lom_sea_desc *resolved);

/* w = sqrt(g k tanh(k d)), rad/s; d infinite for deep water. 0 for k = 0 or d = 0. Within 2 ulp. */
double lom_dispersion(double wavenumber, double depth, double gravity);
/* dw/dk, m/s: the speed of a group of waves; 0 for k = 0 where it would be infinite. */
double lom_group_speed(double wavenumber, double depth, double gravity);
/* The variance of heights per wavenumber k = |k|, m^3: its integral over k is the variance of h. 0 for k = 0. */
double lom_spectrum_at(const lom_wave_spectrum *spectrum, double wavenumber);
/* The share of that per radian at an angle from the wind, -pi..pi: its integral is 1. */
double lom_spreading_at(const lom_wave_spectrum *spectrum, double wavenumber, double angle);
/* Both: the variance per area of the k plane, m^4, S(k) D(k, angle) / k. */
double lom_directional_spectrum(const lom_wave_spectrum *spectrum, double kx, double kz);

/* ---- the sea ---- */

typedef struct lom_sea lom_sea;

/* Makes the amplitudes of every cascade; the device is used for its threads only. NULL on failure; freed with
 * lom_free_sea. It belongs to no device: devices of any threads and lanes may advance it, one at a time. */
lom_sea *lom_create_sea(const lom_sea_desc *desc, lom_device *device, lom_error *error);
void lom_free_sea(lom_sea *sea);
const lom_sea_desc *lom_describe_sea(const lom_sea *sea); /* resolved */

/* What a step makes. What is not asked for costs nothing and keeps its old values. */
enum {
    LOM_SEA_HEIGHT = 1,       /* displacement[1] */
    LOM_SEA_SLOPES = 2,       /* derivatives[0, 1] */
    LOM_SEA_DISPLACEMENT = 4, /* displacement[0, 2] */
    LOM_SEA_JACOBIAN = 8,     /* displacement[3], derivatives[2, 3] and jacobian */
    LOM_SEA_ALL = 15
};

/* All of every cascade at a time in seconds, |time| <= 1e9, which may come in any order: the same time gives the same
 * bytes. The phase of every wave is within 1e-6 radians of exact for |time| <= 1e7. */
bool lom_advance_sea(lom_sea *sea, lom_device *device, double time, lom_error *error);
/* One cascade, and only these of its fields. */
bool lom_advance_cascade(lom_sea *sea, lom_device *device, int cascade, unsigned fields, double time, lom_error *error);

/* A cascade after its last step. Arrays are row-major, row j at z = j L / N from its start on, sample i of a row at
 * x = i L / N, and belong to the sea. They are pixels of FORMAT_RGBA32F and R32F as lom_texture_desc takes them; with
 * repeating wraps a point (x, z) is looked up at s = x / L + 0.5 / N, t = z / L + 0.5 / N.
 *
 * The surface over the rest position (x, z) is (x + dx, h, z + dz), the sums of all cascades at (x, z). Its tangents
 * are (1 + xx, sx, xz) and (xz, sz, 1 + zz), its normal (xz sz - sx (1 + zz), (1 + xx)(1 + zz) - xz^2, xz sx - sz (1 +
 * xx)), and its Jacobian (1 + xx)(1 + zz) - xz^2: below 1 the surface is compressed, below 0 it folds over (foam).
 * Choppiness is contained in dx, dz, xx, xz, zz. */
typedef struct lom_sea_cascade {
    int size;
    double length, longest, shortest; /* metres; longest may be infinite */
    double height_variance;           /* m^2, expected: the sum of its spectrum */
    double slope_variance;            /* expected mean of sx^2 + sz^2 */
    double bound;                     /* |h| is never more, at any time; |dx|, |dz| at most choppiness times it */
    int waves;                        /* that are not zero */
    double time;                      /* of the last step */
    unsigned fields;                  /* that the last step made; 0 before the first */
    const float *displacement;        /* 4 a sample: dx, h, dz, xz */
    const float *derivatives;         /* 4 a sample: sx, sz, xx, zz */
    const float *jacobian;            /* 1 a sample: of this cascade alone */
    float lowest, highest, reach;     /* of h, and the largest |dx| or |dz|, in the last step that made them */
} lom_sea_cascade;
lom_sea_cascade lom_view_cascade(const lom_sea *sea, int cascade); /* zeros outside 0 .. count - 1 */

/* Four times the standard deviation of h over all cascades: the expected significant wave height, metres. */
double lom_significant_height(const lom_sea *sea);

/* ---- the same surface in double, point by point: for tests and reference renderers ---- */

/* The waves of a sea frozen at a time; independent of the sea's steps and of any transform. */
typedef struct lom_sea_moment lom_sea_moment;
lom_sea_moment *lom_freeze_sea(const lom_sea *sea, double time, lom_error *error);
void lom_free_sea_moment(lom_sea_moment *moment);

typedef struct lom_sea_point {
    double dx, h, dz;          /* metres */
    double sx, sz, xx, xz, zz; /* as in lom_sea_cascade */
    double jacobian;
} lom_sea_point;
/* The direct sum of the waves of one cascade, or of all (cascade -1), at the rest position (x, z); within 1e-4 m for
 * |x|, |z| <= 1e7 m. Costs a few multiplications a wave. */
lom_sea_point lom_evaluate_sea(const lom_sea_moment *moment, int cascade, double x, double z);

LOM_API_END

#endif
