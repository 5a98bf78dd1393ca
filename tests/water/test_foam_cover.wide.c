/* Proves the foam of a shore at every width: where a pixel holds one depth it is that of the depth, where it holds more
 * the mean over them; of a shore that is narrower than a pixel it is the shore's share, wherever in the pixel that
 * lies; and that no line shows where a sheet of foam turns over. */
#include "check.h"

#include "water/foam_cover.h"

static const struct lom_foam_uniform foam = { .shore_depth = 0.5f, .move = 0.3f };

static double foam_at(double middle, double range, double cover)
{
    struct lom_depths depths = { lom_splat((float)middle), lom_splat((float)range) };
    lom_mask shore = lom_abs(depths.middle) < foam.shore_depth + 0.5f * depths.range;
    return lom_shore_foam(&foam, depths, shore, lom_splat((float)cover), lom_splat(0.7f))[LOM_LANES - 1];
}

/* Fine sums over a pixel's depths, of which the four places of the shader are an approximation. */
static double mean_of(double middle, double range, double cover)
{
    const int count = 4000;
    double sum = 0;
    for (int i = 0; i < count; i++)
        sum += foam_at(middle + range * ((i + 0.5) / count - 0.5), 0, cover);
    return sum / count;
}

static void a_pixel_of_one_depth_has_its_foam(void)
{
    for (int i = -20; i <= 20; i++) {
        double depth = 0.04 * i, whole = foam_at(depth, 0, 0), narrow = foam_at(depth, 2e-3, 0);
        CHECK(whole - narrow < 0.05 && narrow - whole < 0.05, "depth %g: %g, of a range %g", depth, whole, narrow);
        CHECK((depth >= 0.5 || depth <= -0.5) ? whole == 0 : whole >= 0, "depth %g: %g", depth, whole);
        CHECK(foam_at(depth, 0, 2) == 1, "under foam that covers all: %g", foam_at(depth, 0, 2));
    }
}

static void a_narrow_shore_is_its_share(void)
{
    for (int k = 0; k < 6; k++) {
        double range = 1.5 * (1 << k), all = mean_of(0, range, 0);
        for (int i = -8; i <= 8; i++) {
            double middle = (range / 2 - 0.5) * i / 8, here = foam_at(middle, range, 0);
            CHECK(here - all < 0.12 * all + 1e-3 && all - here < 0.12 * all + 1e-3,
                  "a range of %g about %g: %g, the mean is %g", range, middle, here, all);
        }
        CHECK(foam_at(range, range, 0) == 0, "beyond the shore: %g", foam_at(range, range, 0));
    }
}

/* However two even grains are mixed, as much of the mix lies below any value as of each of them. */
static void a_mix_of_even_grains_is_even(void)
{
    enum { GRAINS = 120, SHARES = 21, VALUES = 9 };
    for (int n = 0; n < SHARES; n++) {
        int below[VALUES] = { 0 };
        for (int i = 0; i < GRAINS * GRAINS; i++) {
            const float first = ((float)(i / GRAINS) + 0.5f) / GRAINS, second = ((float)(i % GRAINS) + 0.5f) / GRAINS;
            const float mix =
                lom_even_mix(lom_splat(first), lom_splat(second), lom_splat((float)n / (SHARES - 1)))[LOM_LANES - 1];
            CHECK(mix >= -1e-6f && mix <= 1.000001f, "share %d: %g", n, (double)mix);
            for (int k = 0; k < VALUES; k++)
                below[k] += mix < 0.1f * (float)(k + 1);
        }
        for (int k = 0; k < VALUES; k++) {
            const double part = (double)below[k] / (GRAINS * GRAINS), even = 0.1 * (k + 1);
            CHECK(part - even < 0.012 && even - part < 0.012, "share %d: %g below %g", n, part, even);
        }
    }
}

/* Turned over from facing up to facing down, about any axis and under any sun, the light of foam goes on without a jump.
 * What looks up has its own; what looks down has what the other side of the sheet has, or the side over the edge, and
 * where it is upright that of both sides of the edge. */
static void foam_that_turns_over_has_no_line(void)
{
    for (int sun = 0; sun < 12; sun++)
        for (int axis = 0; axis < 12; axis++) {
            const double height = 0.1 + 0.07 * sun, flat = lom_double_sqrt(1 - height * height);
            const struct lom_light_uniform light = { .to_light = { (float)flat, (float)height, 0 } };
            const float x = (float)lom_double_cos(0.5236 * axis), z = (float)lom_double_sin(0.5236 * axis);
            double before = 0;
            for (int degree = 0; degree <= 180; degree++) {
                const float y = (float)lom_double_cos(degree * lom_two_pi / 360);
                const float away = (float)lom_double_sin(degree * lom_two_pi / 360);
                const double here =
                    (double)lom_lambert_on_foam(&light, lom_splat3(x * away, y, z * away))[LOM_LANES - 1];
                const double own = (double)lom_lambert(&light, lom_splat3(x * away, y, z * away))[0];
                const double over = (double)lom_lambert(&light, lom_splat3(x * away, -y, z * away))[0];
                const double other = (double)lom_lambert(&light, lom_splat3(-x * away, -y, -z * away))[0];
                const double change = here - before;
                CHECK(degree == 0 || (change < 0.09 && change > -0.09), "sun %d, axis %d: by %g at %d degrees", sun,
                      axis, change, degree);
                CHECK(degree > 90 || here == own, "%d degrees: what looks up has %g of %g", degree, here, own);
                CHECK(degree <= 90 || here >= over - 1e-6, "%d degrees: %g, over the edge %g", degree, here, over);
                CHECK(degree < 111 || here >= other - 1e-6, "%d degrees: %g, above %g", degree, here, other);
                before = here;
            }
        }
}

int main(int argc, char **argv)
{
    RUN(a_pixel_of_one_depth_has_its_foam);
    RUN(a_narrow_shore_is_its_share);
    RUN(a_mix_of_even_grains_is_even);
    RUN(foam_that_turns_over_has_no_line);
    return check_result();
}
