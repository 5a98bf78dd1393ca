/* Proves of the surface that is drawn of shallow water: still water is flat, slopes are those of the surface, what is
 * dry lies below its bed, borders fade, and fast water foams. */
#include "check.h"

#include "waves/shallow_surface.h"

enum { COLUMNS = 40, ROWS = 30, CELLS = COLUMNS * ROWS };

static double bed[CELLS], depth[CELLS], flow_x[(COLUMNS + 1) * ROWS], flow_z[COLUMNS * (ROWS + 1)];
static float surface[CELLS][4], moments[CELLS][4];

static lom_shallow_view view(void)
{
    return (lom_shallow_view){
        .columns = COLUMNS, .rows = ROWS, .cell = 0.5, .bed = bed, .depth = depth, .flow_x = flow_x, .flow_z = flow_z
    };
}

static double magnitude(double x)
{
    return x < 0 ? -x : x;
}

/* A beach: the bed rises along x through the level of 2 m. */
static void make_beach(void)
{
    memset(flow_x, 0, sizeof flow_x);
    memset(flow_z, 0, sizeof flow_z);
    for (int i = 0; i < CELLS; i++) {
        bed[i] = 0.1 * (i % COLUMNS);
        depth[i] = bed[i] < 2 ? 2 - bed[i] : 0;
    }
}

static void still_water_is_flat_and_ends_at_the_beach(void)
{
    float bounds[2];
    make_beach();
    lom_shallow_view v = view();
    int wet = lom_fill_shallow_surface(&v, NULL, 2, false, NULL, surface, moments, bounds);
    CHECK(wet == 20 * ROWS, "%d cells are wet", wet);
    for (int i = 0; i < CELLS; i++) {
        const float *s = surface[i];
        CHECK(s[1] == 0 && s[2] == 0 && s[3] == 0, "cell %d: slopes %g %g, foam %g", i, s[1], s[2], s[3]);
        if (depth[i] > 0)
            CHECK(magnitude(s[0]) < 1e-6, "cell %d stands at %g", i, s[0]);
        else
            CHECK(2 + (double)s[0] < bed[i] - 0.04, "dry cell %d: %g over a bed of %g", i, 2 + (double)s[0], bed[i]);
    }
    CHECK(bounds[0] <= 0 && magnitude(bounds[1] - (1.8 - 0.05 * lom_shallow_film(v.cell))) < 1e-6, "bounds %g %g",
          bounds[0], bounds[1]);
}

static void slopes_are_those_of_the_surface(void)
{
    float bounds[2];
    make_beach();
    for (int i = 0; i < CELLS; i++) {
        bed[i] = 0;
        depth[i] = 3 + 0.02 * (i % COLUMNS) - 0.05 * (i / COLUMNS);
    }
    lom_shallow_view v = view();
    lom_fill_shallow_surface(&v, NULL, 1, false, NULL, surface, moments, bounds);
    for (int i = 0; i < CELLS; i++) {
        const float *s = surface[i], *m = moments[i];
        CHECK(magnitude(s[0] - (depth[i] - 1)) < 1e-6, "height %g", s[0]);
        CHECK(magnitude(s[1] - 0.04) < 1e-6 && magnitude(s[2] + 0.1) < 1e-6, "slopes %g %g", s[1], s[2]);
        CHECK(m[0] == s[1] * s[1] && m[1] == s[2] * s[2] && m[2] == s[1] * s[2], "moments of cell %d", i);
    }
    double texel[4];
    lom_sample_shallow_surface(&v, (const float(*)[4])surface, 10.25, 7.75, texel);
    CHECK(magnitude(texel[0] - (2 + 0.02 * 9.75 - 0.05 * 7.25)) < 1e-6, "between cells %g", texel[0]);
    CHECK(magnitude(texel[1] - 0.04) < 1e-6 && magnitude(texel[2] + 0.1) < 1e-6 && texel[3] == 0, "slopes there");
    lom_sample_shallow_surface(&v, (const float(*)[4])surface, -1e6, 1e6, texel);
    CHECK(texel[0] == (double)surface[(ROWS - 1) * COLUMNS][0], "far outside");
}

static void borders_fade_to_the_level(void)
{
    float bounds[2];
    make_beach();
    for (int i = 0; i < CELLS; i++) {
        bed[i] = 0;
        depth[i] = 3;
    }
    lom_shallow_view v = view();
    lom_fill_shallow_surface(&v, NULL, 1, true, NULL, surface, moments, bounds);
    for (int i = 1; i < COLUMNS / 2; i++)
        CHECK(surface[15 * COLUMNS + i][0] >= surface[15 * COLUMNS + i - 1][0], "cell %d is lower", i);
    CHECK(surface[15 * COLUMNS][0] == 0 && surface[15 * COLUMNS + 10][0] == 2, "from %g to %g",
          surface[15 * COLUMNS][0], surface[15 * COLUMNS + 10][0]);
}

/* At a Froude number of 0.5 and of 2: 0.2 m of water at 0.7 and at 2.8 m/s. */
static void fast_water_foams(void)
{
    float bounds[2];
    make_beach();
    for (int i = 0; i < CELLS; i++) {
        bed[i] = 0;
        depth[i] = 0.2;
    }
    for (int i = 0; i < (COLUMNS + 1) * ROWS; i++)
        flow_x[i] = i % (COLUMNS + 1) < 20 ? 0.2 * 0.7 : 0.2 * 2.8;
    lom_shallow_view v = view();
    lom_fill_shallow_surface(&v, NULL, 0, false, NULL, surface, moments, bounds);
    CHECK(surface[5 * COLUMNS + 5][3] == 0 && surface[5 * COLUMNS + 35][3] == 1, "foam %g and %g",
          surface[5 * COLUMNS + 5][3], surface[5 * COLUMNS + 35][3]);
}

int main(int argc, char **argv)
{
    RUN(still_water_is_flat_and_ends_at_the_beach);
    RUN(slopes_are_those_of_the_surface);
    RUN(borders_fade_to_the_level);
    RUN(fast_water_foams);
    return check_result();
}
