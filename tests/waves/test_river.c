/* Proves of the flow of a river: even in a straight channel, as fast as a narrow is narrow, nowhere on land; and of its
 * two phases: constant variance, and each starts again where its weight is 0. */
#include "check.h"

#include "waves/river.h"
#include "waves/wave_lanes.h"

enum { SIZE = 64 };

static const float *velocity(const lom_image *field, int x, int y)
{
    return lom_image_pixel((lom_image *)field, x, y, 0);
}

static void a_straight_channel_flows_evenly(void)
{
    double depth[SIZE * SIZE];
    for (int i = 0; i < SIZE * SIZE; i++)
        depth[i] = i % SIZE >= 20 && i % SIZE < 36 ? 2 : -1;
    lom_image *field = lom_make_river(depth, SIZE, 1.5707963267948966, NULL);
    for (int y = 1; y < SIZE - 1; y++)
        for (int x = 0; x < SIZE; x++) {
            const float *v = velocity(field, x, y);
            bool wet = x >= 20 && x < 36;
            CHECK(v[0] < 0.02f && v[0] > -0.02f, "across %g at %d, %d", (double)v[0], x, y);
            CHECK(wet ? v[1] > 0.95f && v[1] < 1.05f : v[1] == 0, "along %g at %d, %d", (double)v[1], x, y);
        }
    lom_free_image(field);
}

static void a_narrow_is_fast(void)
{
    double depth[SIZE * SIZE];
    for (int i = 0; i < SIZE * SIZE; i++) {
        int x = i % SIZE, y = i / SIZE, half = y < 28 ? 16 : 8;
        depth[i] = x >= 32 - half && x < 32 + half ? 3 : 0;
    }
    lom_image *field = lom_make_river(depth, SIZE, 1.5707963267948966, NULL);
    double wide = velocity(field, 32, 8)[1], narrow = velocity(field, 32, 54)[1];
    CHECK(narrow / wide > 1.9 && narrow / wide < 2.1, "%g in the wide, %g in the narrow", wide, narrow);
    lom_free_image(field);
}

static void phases_do_not_pulse(void)
{
    struct lom_river_uniform before, river;
    lom_fill_river_phases(&before, 1.3, 7, (double[2]){ 0, 0 }, 0);
    for (int i = 1; i < 5000; i++) {
        lom_fill_river_phases(&river, 1.3, 7, (double[2]){ 0, 0 }, i * 0.002);
        float sum = river.weight[0] * river.weight[0] + river.weight[1] * river.weight[1];
        CHECK(sum > 0.9999f && sum < 1.0001f, "the variance is %g", (double)sum);
        for (int k = 0; k < 2; k++)
            CHECK(river.jump[k][1] == before.jump[k][1] || (river.weight[k] < 0.01f && before.weight[k] < 0.01f),
                  "phase %d jumps at weight %g", k, (double)river.weight[k]);
        before = river;
    }
}

int main(int argc, char **argv)
{
    RUN(a_straight_channel_flows_evenly);
    RUN(a_narrow_is_fast);
    RUN(phases_do_not_pulse);
    return check_result();
}
