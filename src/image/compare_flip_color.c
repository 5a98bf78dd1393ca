/* The colour mathematics of LDR FLIP (Andersson et al. 2020). In: samples, filtered colours, feature differences. Out:
 * linear light, opponent colours, perceived colours, the error of a pixel. Invariant: all constants follow from the
 * paper's numbers and the sRGB primaries by arithmetic in double. Compiled for speed. */
#include "base/numbers.h"
#include "compare_flip.h"
#include "convert.h"

#include <string.h>

static const double pixels_per_degree = 67;

/* ---- constants ---- */

/* sRGB primaries and D65 (IEC 61966-2-1) from their chromaticities x, y = (0.64, 0.33), (0.30, 0.60), (0.15, 0.06),
 * white (0.3127, 0.3290), solved exactly: the rows are X, Y, Z. */
static const double rgb_to_xyz[3][3] = {
    { 10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0 },
    { 2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0 },
    { 1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0 },
};

/* The inverse as the adjugate over the determinant; indices modulo 3 take care of the signs. */
static void invert3(const double m[3][3], double inverse[3][3])
{
    double cofactor[3][3];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
            cofactor[i][j] = m[i1][j1] * m[i2][j2] - m[i1][j2] * m[i2][j1];
        }
    double determinant = m[0][0] * cofactor[0][0] + m[0][1] * cofactor[0][1] + m[0][2] * cofactor[0][2];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            inverse[j][i] = cofactor[i][j] / determinant;
}

/* exp(-d^2 / scale) of the pixel distances d, to sum 1; returns the sum before. */
static double make_gaussian(double scale, int radius, double weight[LOM_FLIP_TAPS])
{
    double sum = 0;
    for (int k = 0; k < LOM_FLIP_TAPS; k++) {
        double d = k - LOM_FLIP_RADIUS;
        weight[k] = d >= -radius && d <= radius ? lom_double_exp(-d * d / scale) : 0;
        sum += weight[k];
    }
    for (int k = 0; k < LOM_FLIP_TAPS; k++)
        weight[k] /= sum;
    return sum;
}

/* Section 4.1, table 1: a contrast filter is sum a sqrt(pi / b) exp(-pi^2 d^2 / b) over the distance d in degrees in
 * two dimensions, scaled to sum 1. A Gaussian in two dimensions is the product of two in one, so each term's weight is
 * a sqrt(pi / b) times the square of its sum in one dimension. */
static void make_contrast_filters(lom_flip_constants *constants)
{
    const double degrees = pixels_per_degree * pixels_per_degree / (lom_pi * lom_pi); /* b to square pixels */
    const double a[2] = { 34.1, 13.5 }, b[2] = { 0.04, 0.025 };
    make_gaussian(0.0047 * degrees, LOM_FLIP_RADIUS, constants->luminance);
    make_gaussian(0.0053 * degrees, LOM_FLIP_RADIUS, constants->red_green);
    double *share = constants->blue_yellow_share;
    for (int i = 0; i < 2; i++) {
        double sum = make_gaussian(b[i] * degrees, LOM_FLIP_RADIUS, constants->blue_yellow[i]);
        share[i] = a[i] * __builtin_sqrt(lom_pi / b[i]) * sum * sum;
    }
    double total = share[0] + share[1];
    share[0] /= total;
    share[1] /= total;
}

/* Positive weights to sum 1 and negative ones to -1. In two dimensions the sign depends on this direction alone and the
 * other one is a common factor, so the parts scale as they do in one. */
static void balance(double weight[LOM_FLIP_TAPS])
{
    double positive = 0, negative = 0;
    for (int k = 0; k < LOM_FLIP_TAPS; k++) {
        positive += weight[k] > 0 ? weight[k] : 0;
        negative -= weight[k] < 0 ? weight[k] : 0;
    }
    for (int k = 0; k < LOM_FLIP_TAPS; k++)
        weight[k] /= weight[k] > 0 ? positive : negative;
}

/* Section 4.2: the Gaussian of standard deviation 0.5 * 0.082 degrees, its first derivative (edges) and its second
 * (points). */
static void make_feature_filters(lom_flip_constants *constants)
{
    double deviation = 0.5 * 0.082 * pixels_per_degree, variance = deviation * deviation;
    make_gaussian(2 * variance, LOM_FLIP_FEATURE_RADIUS, constants->smooth);
    for (int k = 0; k < LOM_FLIP_TAPS; k++) {
        double d = k - LOM_FLIP_RADIUS;
        constants->edge[k] = -d * constants->smooth[k];
        constants->point[k] = (d * d / variance - 1) * constants->smooth[k];
    }
    balance(constants->edge);
    balance(constants->point);
}

/* Equation 3 (Abasi et al. 2020): city block in lightness, Euclid in the plane of hues; raised to q_c = 0.7. */
static double color_distance(const double a[3], const double b[3])
{
    double da = a[1] - b[1], db = a[2] - b[2];
    return lom_double_pow(__builtin_fabs(a[0] - b[0]) + __builtin_sqrt(da * da + db * db), 0.7);
}

lom_flip_constants *lom_create_flip_constants(const lom_common_format *common, size_t samples, lom_error *error)
{
    lom_flip_constants *constants = lom_allocate(1, sizeof *constants, error);
    if (constants == NULL)
        return NULL;
    memcpy(constants->to_xyz, rgb_to_xyz, sizeof rgb_to_xyz);
    invert3(constants->to_xyz, constants->to_rgb);
    for (int i = 0; i < 3; i++)
        constants->white[i] = rgb_to_xyz[i][0] + rgb_to_xyz[i][1] + rgb_to_xyz[i][2];
    make_contrast_filters(constants);
    make_feature_filters(constants);
    const double green[3] = { 0, 1, 0 }, blue[3] = { 0, 0, 1 };
    double opponent[3], lab_green[3], lab_blue[3];
    lom_flip_opponent(constants, green, opponent);
    lom_flip_perceived(constants, opponent, lab_green);
    lom_flip_opponent(constants, blue, opponent);
    lom_flip_perceived(constants, opponent, lab_blue);
    constants->largest = color_distance(lab_green, lab_blue);
    size_t steps = common->is_float || common->bits > 16 ? SIZE_MAX : (size_t)1 << common->bits;
    if (steps <= samples) {
        constants->decoded = lom_allocate(steps, sizeof *constants->decoded, error);
        if (constants->decoded == NULL) {
            lom_release(constants);
            return NULL;
        }
        for (size_t i = 0; i < steps; i++)
            constants->decoded[i] = lom_srgb_decode_double((double)i / common->peak);
    }
    return constants;
}

void lom_free_flip_constants(lom_flip_constants *constants)
{
    if (constants == NULL)
        return;
    lom_release(constants->decoded);
    lom_release(constants);
}

/* ---- colours ---- */

double lom_flip_linear(const lom_flip_constants *constants, const lom_common_format *common, double sample)
{
    if (constants->decoded != NULL)
        return constants->decoded[lom_count_of(sample, UINT16_MAX)];
    return common->is_float ? lom_unit_of(sample) : lom_srgb_decode_double(sample / common->peak);
}

/* XYZ relative to white. */
static void relative_xyz(const lom_flip_constants *constants, const double rgb[3], double xyz[3])
{
    for (int i = 0; i < 3; i++) {
        const double *row = constants->to_xyz[i];
        xyz[i] = (row[0] * rgb[0] + row[1] * rgb[1] + row[2] * rgb[2]) / constants->white[i];
    }
}

/* L*a*b* without its cube roots, so that a spatial filter does not shift colours (Zhang, Wandell 1997). */
void lom_flip_opponent(const lom_flip_constants *constants, const double rgb[3], double opponent[3])
{
    double xyz[3];
    relative_xyz(constants, rgb, xyz);
    opponent[0] = 116 * xyz[1] - 16;
    opponent[1] = 500 * (xyz[0] - xyz[1]);
    opponent[2] = 200 * (xyz[1] - xyz[2]);
}

/* CIE 15: the cube root, straight below (6/29)^3. */
static double compress(double t)
{
    const double limit = 6.0 / 29;
    return t > limit * limit * limit ? lom_double_cbrt(t) : t / (3 * limit * limit) + 4.0 / 29;
}

void lom_flip_perceived(const lom_flip_constants *constants, const double opponent[3], double lab[3])
{
    double y = (opponent[0] + 16) / 116;
    const double relative[3] = { opponent[1] / 500 + y, y, y - opponent[2] / 200 };
    double xyz[3], rgb[3];
    for (int i = 0; i < 3; i++)
        xyz[i] = relative[i] * constants->white[i];
    for (int i = 0; i < 3; i++) {
        const double *row = constants->to_rgb[i];
        rgb[i] = lom_unit_of(row[0] * xyz[0] + row[1] * xyz[1] + row[2] * xyz[2]);
    }
    relative_xyz(constants, rgb, xyz);
    double fx = compress(xyz[0]), fy = compress(xyz[1]), fz = compress(xyz[2]);
    double lightness = 116 * fy - 16;
    lab[0] = lightness;
    lab[1] = 0.01 * lightness * (500 * (fx - fy)); /* Hunt: colours fade with the light */
    lab[2] = 0.01 * lightness * (200 * (fy - fz));
}

/* Section 4.3: colour differences up to p_c c_max are spread over 0..p_t, what is larger over p_t..1. Section 4.4: the
 * feature difference, with q_f = 0.5, is the exponent that lifts the colour difference. */
double lom_flip_pixel(const lom_flip_constants *constants, const double a[3], const double b[3], double feature)
{
    const double p_c = 0.4, p_t = 0.95;
    double distance = color_distance(a, b), knee = p_c * constants->largest;
    double color =
        distance < knee ? p_t / knee * distance : p_t + (distance - knee) / (constants->largest - knee) * (1 - p_t);
    double lift = __builtin_sqrt(feature / __builtin_sqrt(2.0));
    return lom_double_pow(lom_unit_of(color), 1 - lom_unit_of(lift));
}
