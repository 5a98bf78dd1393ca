/* Proves: the wind moves clouds by closed forms of the time, in any order of times, by height, and back where they were
 * after a whole period of gusts without speed. */
#include "check.h"
#include "cloud/cloud_draw.h"

static lom_cloud_wind winds[2] = { { .height = 1000, .speed = 10, .gust = 4, .gust_period = 20 },
                                   { .height = 3000, .speed = 30, .direction = 1.5707963267948966, .gust_period = 1 } };

/* Where a cloud whose middle is at a height is at a time, less its place. */
static lom_vec3 moved(double height, double time, size_t count)
{
    lom_cloud cloud = { .position = { 100, height - 500, -50 }, .size = { 1000, 1000, 1000 } };
    lom_clouds params = { .winds = winds, .wind_count = count };
    struct lom_placed_cloud placed = { .cloud = &cloud, .middle = { 100, height, -50 } };
    struct lom_cloud_set set = { .params = &params, .clouds = &placed, .count = 1 };
    lom_move_clouds(&set, time / 2); /* an earlier time leaves no trace */
    lom_move_clouds(&set, time);
    return (lom_vec3){ placed.middle.x - 100, placed.middle.y - height, placed.middle.z + 50 };
}

/* Within the rounding of ways to 64ths. */
static bool is_near(lom_vec3 a, double x, double z)
{
    return lom_vec3_length((lom_vec3){ a.x - x, a.y, a.z - z }) < 0.5 / 64 * 1.5;
}

static void calm_moves_nothing(void)
{
    CHECK(is_near(moved(2000, 1e4, 0), 0, 0), "no wind");
    CHECK(is_near(moved(2000, 0, 2), 0, 0), "time 0");
}

static void ways_follow_height(void)
{
    CHECK(is_near(moved(3000, 60, 2), 0, 1800) && is_near(moved(9000, 60, 2), 0, 1800), "the upper wind and above");
    CHECK(is_near(moved(1000, 60, 2), 600, 0) && is_near(moved(-10, 60, 2), 600, 0), "the lower wind and below");
    CHECK(is_near(moved(1500, 60, 2), 450, 450), "a quarter of the way between");
    CHECK(is_near(moved(5000, 60, 1), 600, 0), "one wind blows at all heights");
}

/* The integral of g sin(2 pi t / p) is g p / (2 pi) (1 - cos(2 pi t / p)): twice g p / (2 pi) after half a period. */
static void gusts_are_the_integral_of_a_sine(void)
{
    double most = 4 * 20 / 3.141592653589793;
    CHECK(is_near(moved(1000, 10, 2), 100 + most, 0), "half a period");
    CHECK(is_near(moved(1000, 20, 2), 200, 0) && is_near(moved(1000, 2e6, 2), 2e7, 0), "whole periods");
    double before = -1;
    for (int i = 0; i < 200; i++) {
        double x = moved(1000, 0.1 * i, 2).x;
        CHECK(x > before, "slower gusts than wind never blow backwards");
        before = x;
    }
}

int main(int argc, char **argv)
{
    RUN(calm_moves_nothing);
    RUN(ways_follow_height);
    RUN(gusts_are_the_integral_of_a_sine);
    return check_result();
}
