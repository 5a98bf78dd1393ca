/* The colour mathematics and the constants of LDR FLIP, apart from the walk over the pixels. Sections are those of
 * Andersson et al. 2020. */
#ifndef LOM_IMAGE_COMPARE_FLIP_H
#define LOM_IMAGE_COMPARE_FLIP_H

#include "compare.h"

/* At 67 pixels a degree the contrast filters reach ceil(3 sqrt(0.04 / (2 pi^2)) 67) = 10 pixels (0.04 is the largest
 * spread in table 1), the feature filters ceil(3 * 0.5 * 0.082 * 67) = 9. One length serves all; the feature filters
 * end in zeros. */
enum { LOM_FLIP_RADIUS = 10, LOM_FLIP_FEATURE_RADIUS = 9, LOM_FLIP_TAPS = 2 * LOM_FLIP_RADIUS + 1 };

typedef struct lom_flip_constants {
    double to_xyz[3][3], to_rgb[3][3], white[3]; /* linear sRGB and CIE XYZ; white is the sum of each row */
    double luminance[LOM_FLIP_TAPS], red_green[LOM_FLIP_TAPS]; /* contrast sensitivity, each summing to 1 */
    double blue_yellow[2][LOM_FLIP_TAPS];                      /* the two Gaussians of its sum, each summing to 1 ... */
    double blue_yellow_share[2];                               /* ... and what each contributes */
    double smooth[LOM_FLIP_TAPS];                              /* feature filters: the Gaussian, summing to 1, ... */
    double edge[LOM_FLIP_TAPS], point[LOM_FLIP_TAPS];          /* its derivatives, positive part 1 and negative -1 */
    double largest;                                            /* c_max of section 4.3, already raised to q_c */
    double *decoded; /* linear light of every step; NULL for floats, for more than 16 bits, and for few samples */
} lom_flip_constants;

/* For so many samples. Freed with lom_free_flip_constants, which allows NULL. */
lom_flip_constants *lom_create_flip_constants(const lom_common_format *common, size_t samples, lom_error *error);
void lom_free_flip_constants(lom_flip_constants *constants);

/* A sample of the common format as linear light in 0..1; NaN gives 0. */
double lom_flip_linear(const lom_flip_constants *constants, const lom_common_format *common, double sample);
/* Linear sRGB to YCxCz. */
void lom_flip_opponent(const lom_flip_constants *constants, const double rgb[3], double opponent[3]);
/* Filtered YCxCz, clamped to what a monitor shows, to L*a*b* with Hunt's adjustment. */
void lom_flip_perceived(const lom_flip_constants *constants, const double opponent[3], double lab[3]);
/* The error of one pixel in 0..1, from two colours and the larger of the feature differences. */
double lom_flip_pixel(const lom_flip_constants *constants, const double a[3], const double b[3], double feature);

#endif
