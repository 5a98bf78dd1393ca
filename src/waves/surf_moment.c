/* Surf at a time. In: its maps, a time. Out: what shaders add to the maps' phases, and the height over a place in
 * double. Invariant: a function of place and time; whole turns of the time are taken off in double. */
#include "base/numbers.h"
#include "waves/surf.h"
#include "waves/surf_curl.h"

/* Groups: the heights of crests vary as where two pairs of neighbouring periods beat, 6.1 and 3.7 crests apart, along
 * crests by as many lengths. Their sum is at most 1. */
static const double group[2] = { 6.1, 3.7 }, share[2] = { 0.6, 0.4 };

static double reduced(double phase)
{
    double turns = phase / lom_two_pi;
    return (turns - lom_double_floor(turns + 0.5)) * lom_two_pi;
}

void lom_fill_surf(struct lom_surf_uniform *out, const struct lom_surf_map *map, const lom_water_surf *surf,
                   const double origin[2], double time)
{
    const double rate = lom_two_pi / surf->period;
    const int size[2] = { map->width, map->height };
    out->time = (float)reduced(rate * time);
    out->rate = (float)rate;
    out->variation = (float)surf->variation;
    for (int i = 0; i < 2; i++) {
        out->origin[i] = origin[i];
        out->corner[i] = (float)(map->corner[i] - origin[i]);
        out->last[i] = (float)(map->corner[i] + map->spacing[i] * (size[i] - 1) - origin[i]);
        out->scale[i] = (float)(1 / (map->spacing[i] * size[i]));
        out->half[i] = (float)(0.5 / size[i]);
        out->group_rate[i] = (float)(1 / group[i]);
        out->group_share[i] = (float)share[i];
        double phase = reduced(rate * time / group[i]);
        for (int k = 0; k < 2; k++) {
            double along = map->along[k] * lom_two_pi / (map->length * group[i]) * (i == 0 ? 1 : -1);
            out->group_along[i][k] = (float)along;
            phase += reduced(along * origin[k]);
        }
        out->group_time[i] = (float)phase;
    }
}

/* Bilinear between the cells of eight floats, as a texture of them is. */
static void look_up(const struct lom_surf_map *map, const float (*cells)[8], double x, double z, double value[8])
{
    const double place[2] = { (x - map->corner[0]) / map->spacing[0], (z - map->corner[1]) / map->spacing[1] };
    const int size[2] = { map->width, map->height };
    int cell[2];
    double part[2];
    for (int i = 0; i < 2; i++) {
        double at = place[i] < 0 ? 0 : place[i] > size[i] - 1 ? size[i] - 1 : place[i];
        cell[i] = lom_int_of(at) < size[i] - 2 ? lom_int_of(at) : size[i] - 2;
        part[i] = at - cell[i];
    }
    for (int k = 0; k < 8; k++)
        value[k] = 0;
    for (int corner = 0; corner < 4; corner++) {
        int dx = corner & 1, dz = corner >> 1;
        const float *from = cells[(cell[1] + dz) * map->width + cell[0] + dx];
        double weight = (dx ? part[0] : 1 - part[0]) * (dz ? part[1] : 1 - part[1]);
        for (int k = 0; k < 8; k++)
            value[k] += weight * (double)from[k];
    }
}

/* Radians of phase beyond the maps. */
static double phase_outside(const struct lom_surf_map *map, const double v[8], double x, double z)
{
    const double at[2] = { x, z };
    double outside = 0;
    for (int i = 0; i < 2; i++) {
        const double low = map->corner[i], last = low + map->spacing[i] * ((i == 0 ? map->width : map->height) - 1);
        outside += v[1 + i] * (at[i] - (at[i] < low ? low : at[i] > last ? last : at[i]));
    }
    return outside;
}

struct lom_surf_place lom_surf_place_at(const struct lom_surf_map *map, double x, double z)
{
    double v[8];
    look_up(map, (const float(*)[8]) & map->cells->phase, x, z, v);
    return (struct lom_surf_place){ v[0] + phase_outside(map, v, x, z), { v[1], v[2] }, v[3], v[4], v[5] };
}

double lom_surf_size(const struct lom_surf_uniform *moment, double phase, double x, double z)
{
    double size = 1;
    for (int i = 0; i < 2; i++)
        size += (double)moment->variation * share[i] *
                lom_double_sin((double)moment->group_time[i] - phase / group[i] +
                               (double)moment->group_along[i][0] * (x - moment->origin[0]) +
                               (double)moment->group_along[i][1] * (z - moment->origin[1]));
    return size;
}

static double spilling_height(const struct lom_surf_place *at, double angle, double size)
{
    const double s = lom_double_sin(angle), c = lom_double_cos(angle);
    const double root = lom_double_sqrt(1 - at->skew * at->skew - at->lean * at->lean);
    return at->amplitude * size * root * (s + at->lean / (1 + root)) / (1 - at->skew * c + at->lean * s);
}

void lom_surf_shift(const struct lom_surf_map *map, const struct lom_surf_uniform *moment, double x, double z,
                    double shift[3])
{
    double v[8], curl[8], thrown[2];
    const struct lom_surf_place at = lom_surf_place_at(map, x, z);
    const double angle = (double)moment->time - at.phase, size = lom_surf_size(moment, at.phase, x, z);
    shift[0] = shift[2] = 0;
    shift[1] = spilling_height(&at, angle, size);
    if (map->curls == NULL)
        return;
    look_up(map, (const float(*)[8]) & map->curls->since, x, z, curl);
    if (!(curl[1] > 0))
        return;
    look_up(map, (const float(*)[8]) & map->cells->phase, x, z, v);
    const double number = lom_double_sqrt(at.k[0] * at.k[0] + at.k[1] * at.k[1]), rate = (double)moment->rate;
    const double ahead = reduced(curl[3] - angle), since = curl[0] + phase_outside(map, v, x, z) + curl[2] * (size - 1);
    const struct lom_curl_wave wave = { .number = number,
                                        .speed = rate / number,
                                        .ahead = ahead,
                                        .span = curl[4],
                                        .height = shift[1],
                                        .drop = at.amplitude * size * curl[6],
                                        .age = (since - ahead) / rate };
    lom_surf_curl(&wave, thrown);
    shift[0] = curl[1] * thrown[0] * at.k[0] / number;
    shift[1] += curl[1] * thrown[1];
    shift[2] = curl[1] * thrown[0] * at.k[1] / number;
}

enum { SEARCH = 96 }; /* places that are looked at for a curl over another */

/* Of a wave that overturns the upper one of what is over the place: it is looked for where the water rests that may
 * have been thrown there, which is behind it along the wave's way. */
double lom_surf_height(const struct lom_surf_map *map, const struct lom_surf_uniform *moment, double x, double z)
{
    double shift[3], before = 0, height = -1e30, under = 0;
    lom_surf_shift(map, moment, x, z, shift);
    if (map->curls == NULL || !(map->farthest > 0))
        return shift[1];
    const struct lom_surf_place at = lom_surf_place_at(map, x, z);
    const double number = lom_double_sqrt(at.k[0] * at.k[0] + at.k[1] * at.k[1]);
    const double way[2] = { at.k[0] / number, at.k[1] / number };
    const double reach = map->farthest * (1 + (double)moment->variation);
    for (int i = 0; i <= SEARCH; i++) {
        const double back = reach * i / SEARCH;
        lom_surf_shift(map, moment, x - back * way[0], z - back * way[1], shift);
        const double past = shift[0] * way[0] + shift[2] * way[1] - back;
        if (i > 0 && (past >= 0) != (before >= 0)) {
            const double part = before / (before - past);
            height = lom_larger(height, under + part * (shift[1] - under));
        } else if (i == 0 && past == 0) {
            height = shift[1];
        }
        before = past;
        under = shift[1];
    }
    return height;
}
