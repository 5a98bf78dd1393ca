/* Proves of the colours for numbers what is asked of them: neighbours differ by equal steps in Oklab, each is lighter than
 * the one before, also to those who lack cones for long or middle waves (Machado, Oliveira and Fernandes 2009, severity 1),
 * and the mark is like none of them. */
#include "check.h"

#include "image/color_map.h"
#include "image/convert.h"

#include <lom/lom.h>

static double decoded(uint8_t code)
{
    double x = code / 255.0;
    return x <= 0.04045 ? x / 12.92 : lom_double_pow((x + 0.055) / 1.055, 2.4);
}

/* The inverse of what the map is made with, by the published matrices. */
static void to_oklab(const double rgb[3], double lab[3])
{
    double l = lom_double_cbrt(0.4122214708 * rgb[0] + 0.5363325363 * rgb[1] + 0.0514459929 * rgb[2]);
    double m = lom_double_cbrt(0.2119034982 * rgb[0] + 0.6806995451 * rgb[1] + 0.1073969566 * rgb[2]);
    double s = lom_double_cbrt(0.0883024619 * rgb[0] + 0.2817188376 * rgb[1] + 0.6299787005 * rgb[2]);
    lab[0] = 0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s;
    lab[1] = 1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s;
    lab[2] = 0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s;
}

static double distance(const double p[3], const double q[3])
{
    double sum = 0;
    for (int c = 0; c < 3; c++)
        sum += (p[c] - q[c]) * (p[c] - q[c]);
    return lom_double_sqrt(sum);
}

static uint8_t map[256][3];
static double linear[256][3], lab[256][3];

static void make(void)
{
    lom_make_color_map(map);
    for (int i = 0; i < 256; i++) {
        for (int c = 0; c < 3; c++)
            linear[i][c] = decoded(map[i][c]);
        to_oklab(linear[i], lab[i]);
    }
}

/* Over 15 colours, so that the rounding of each to 8 bits is a small part. */
static void steps_are_equal(void)
{
    make();
    double whole = 0;
    for (int i = 0; i < 255; i += 15)
        whole += distance(lab[i], lab[i + 15]);
    for (int i = 0; i < 255; i += 15) {
        double step = distance(lab[i], lab[i + 15]) / (whole / 17);
        CHECK(step > 0.95 && step < 1.05, "colour %d: %g of the mean", i, step);
    }
}

static void each_is_lighter_than_the_last(void)
{
    static const double eyes[3][3][3] = {
        { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } },
        { { 0.152286, 1.052583, -0.204868 }, { 0.114503, 0.786281, 0.099216 }, { -0.003882, -0.048116, 1.051998 } },
        { { 0.367322, 0.860646, -0.227968 }, { 0.280085, 0.672501, 0.047413 }, { -0.011820, 0.042940, 0.968881 } },
    };
    make();
    for (int eye = 0; eye < 3; eye++) {
        double last = -1;
        for (int i = 0; i < 256; i += 3) {
            double seen[3], at[3];
            for (int c = 0; c < 3; c++) {
                double x = 0;
                for (int k = 0; k < 3; k++)
                    x += eyes[eye][c][k] * linear[i][k];
                seen[c] = x > 0 ? x : 0;
            }
            to_oklab(seen, at);
            CHECK(at[0] > last, "eye %d, colour %d", eye, i);
            last = at[0];
        }
    }
}

static void the_mark_is_like_none(void)
{
    make();
    double mark[3], rgb[3];
    for (int c = 0; c < 3; c++)
        rgb[c] = decoded(lom_mark_color[c]);
    to_oklab(rgb, mark);
    for (int i = 0; i < 256; i++)
        CHECK(distance(mark, lab[i]) > 0.3, "colour %d", i);
}

int main(int argc, char **argv)
{
    RUN(steps_are_equal);
    RUN(each_is_lighter_than_the_last);
    RUN(the_mark_is_like_none);
    return check_result();
}
