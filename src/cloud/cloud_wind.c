/* Clouds that move with the wind. In: the wind at heights, a time. Out: where each cloud is. Invariant: a closed form
 * of the time, so any frame alone has its clouds where a run has them. */
#include "base/numbers.h"
#include "cloud/cloud_draw.h"

/* The way in metres from time 0 on: speed t, and the integral of gust sin(two_pi t / gust_period). */
static void find_way(const lom_cloud_wind *wind, double time, double way[2])
{
    double length = wind->speed * time;
    if (wind->gust > 0) {
        double turns = time / wind->gust_period;
        turns -= lom_double_floor(turns);
        length += wind->gust * wind->gust_period / lom_two_pi * (1 - lom_double_cos(lom_two_pi * turns));
    }
    way[0] = length * lom_double_cos(wind->direction);
    way[1] = length * lom_double_sin(wind->direction);
}

/* Heights rise from entry to entry; between two the ways are mixed, beyond the ends the end's holds. */
static void way_at(const lom_clouds *params, double height, double time, double way[2])
{
    const lom_cloud_wind *wind = params->winds;
    size_t last = params->wind_count - 1, i = 0;
    while (i < last && height >= wind[i + 1].height)
        i++;
    find_way(&wind[i], time, way);
    if (i == last || height <= wind[i].height)
        return;
    double above[2], part = (height - wind[i].height) / (wind[i + 1].height - wind[i].height);
    find_way(&wind[i + 1], time, above);
    for (int k = 0; k < 2; k++)
        way[k] += (above[k] - way[k]) * part;
}

/* Ways are whole 64ths of a metre, so that clouds of one wind keep the same distances to the bit, and so their light; of a
 * cloud smaller than 4 m they are parts by a power of two, a 4096th of it or less. */
static double find_grain(const lom_cloud *cloud)
{
    const double *size = cloud->size, smallest = lom_smaller(lom_smaller(size[0], size[1]), size[2]);
    double grain = 64;
    while (smallest < 4 && grain * smallest < 4096 && grain < 0x1p40)
        grain *= 2;
    return grain;
}

static double round_way(double way, double grain)
{
    return lom_double_floor(way * grain + 0.5) / grain;
}

lom_vec3 lom_cloud_way(const lom_clouds *params, const lom_cloud *cloud, double time)
{
    double way[2] = { 0, 0 };
    if (params->wind_count != 0)
        way_at(params, cloud->position.y + cloud->size[1] / 2, time, way);
    const double grain = find_grain(cloud);
    return (lom_vec3){ round_way(way[0], grain), 0, round_way(way[1], grain) };
}

void lom_move_clouds(struct lom_cloud_set *set, double time)
{
    for (size_t i = 0; set->params->wind_count != 0 && i < set->count; i++) {
        struct lom_placed_cloud *placed = &set->clouds[i];
        lom_vec3 way = lom_cloud_way(set->params, placed->cloud, time);
        placed->middle.x = placed->cloud->position.x + way.x;
        placed->middle.z = placed->cloud->position.z + way.z;
    }
}
