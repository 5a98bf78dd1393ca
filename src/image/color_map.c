/* Colours for numbers. In: nothing. Out: a curve through Oklab (Ottosson 2020, bottosson.github.io/posts/oklab), a space in
 * which equal distances look equal, at points that are equally far apart along it. Lightness grows all the way, and so
 * does b, from blue to yellow: the axis that all eyes but few tell apart. Invariant: all of the curve lies inside sRGB. */
#include "color_map.h"

#include "convert.h"

#include <lom/base.h>

enum { CHORDS = 4096, POINTS = 5 };

const uint8_t lom_mark_color[3] = { 255, 0, 255 };

/* L, a, b. A Bezier curve of degree 4. */
static const double points[POINTS][3] = {
    { 0.22, 0.03, -0.08 }, { 0.42, 0.02, -0.17 }, { 0.62, -0.14, 0 }, { 0.80, -0.12, 0.13 }, { 0.94, -0.04, 0.16 }
};

/* de Casteljau: the middle of the middles. */
static void find_point(double t, double lab[3])
{
    double p[POINTS][3];
    memcpy(p, points, sizeof p);
    for (int left = POINTS - 1; left > 0; left--)
        for (int i = 0; i < left; i++)
            for (int c = 0; c < 3; c++)
                p[i][c] += t * (p[i + 1][c] - p[i][c]);
    memcpy(lab, p[0], sizeof p[0]);
}

static double distance(const double p[3], const double q[3])
{
    double x = p[0] - q[0], y = p[1] - q[1], z = p[2] - q[2];
    return lom_double_sqrt(x * x + y * y + z * z);
}

static void to_srgb(const double lab[3], uint8_t rgb[3])
{
    double l = lab[0] + 0.3963377774 * lab[1] + 0.2158037573 * lab[2];
    double m = lab[0] - 0.1055613458 * lab[1] - 0.0638541728 * lab[2];
    double s = lab[0] - 0.0894841775 * lab[1] - 1.2914855480 * lab[2];
    l = l * l * l;
    m = m * m * m;
    s = s * s * s;
    rgb[0] = lom_srgb8_of((float)(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s));
    rgb[1] = lom_srgb8_of((float)(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s));
    rgb[2] = lom_srgb8_of((float)(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s));
}

/* The curve's length by chords; then colour i where i / 255 of it lies behind. */
void lom_make_color_map(uint8_t map[256][3])
{
    double length = 0, behind = 0, last[3], next[3];
    find_point(0, last);
    for (int i = 1; i <= CHORDS; i++) {
        find_point(i * (1.0 / CHORDS), next);
        length += distance(last, next);
        memcpy(last, next, sizeof last);
    }
    find_point(0, last);
    to_srgb(last, map[0]);
    for (int i = 1, color = 1; i <= CHORDS; i++) {
        find_point(i * (1.0 / CHORDS), next);
        double chord = distance(last, next);
        for (; color < 255 && behind + chord >= length * color / 255; color++) {
            double lab[3], part = (length * color / 255 - behind) / chord;
            for (int c = 0; c < 3; c++)
                lab[c] = last[c] + part * (next[c] - last[c]);
            to_srgb(lab, map[color]);
        }
        behind += chord;
        memcpy(last, next, sizeof last);
    }
    to_srgb(last, map[255]);
}
