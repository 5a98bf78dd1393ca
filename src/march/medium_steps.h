/* What the marches through a medium share: the density that counts, the sun's share, the steps and which of them are
 * empty. Every function is of the rays alone, so that what is skipped changes no bit of what is not. */
#ifndef LOM_MARCH_MEDIUM_STEPS_H
#define LOM_MARCH_MEDIUM_STEPS_H

#include "fixed_cells.h"
#include "medium_cells.h"

#include <lom/lanes_mathematics.h>

#include <assert.h>

LOM_INLINE lom_float density_in(const lom_medium_desc *desc, const lom_volume_place *place,
                                const struct medium_words *words)
{
    if (desc->filtering != LOM_FILTERING_FIXED)
        return lom_mix_medium(words->upper, words->lower, *place);
    struct fixed_place at = fix_place(*place);
    return fixed_mix_medium(words->upper, words->lower, &at);
}

/* The density that counts: the medium's, into whose thin parts tiling noise n eats: (d - s n) / (1 - s n), never below
 * 0 (Schneider and Vos 2015). Far away the noise is its mean. */
static inline lom_float find_density(const lom_medium_desc *desc, lom_float3 p, const lom_volume_place *place,
                                     const struct medium_words *words, lom_float distance)
{
    lom_float density = density_in(desc, place, words);
    const lom_mask thin = (density > 0.0f) & (density < 1.0f);
    if (desc->detail == NULL || !lom_any(thin))
        return density;
    lom_float noise = lom_splat(desc->detail->mean);
    lom_float fading = 1.0f - lom_smoothstep(lom_splat(desc->detail_near), lom_splat(desc->detail_far), distance);
    if (lom_any(fading > 0.0f)) {
        lom_float3 q = { p.x * desc->detail_scale[0], p.y * desc->detail_scale[1], p.z * desc->detail_scale[2] };
        noise = lom_mix(noise,
                        desc->filtering == LOM_FILTERING_FIXED ? fixed_detail(desc->detail, q)
                                                               : read_detail(desc->medium->gathers, desc->detail, q),
                        fading);
    }
    lom_float eaten = noise * desc->detail_strength;
    return lom_select(thin, lom_saturate((density - eaten) / (1.0f - eaten)),
                      density); /* 0 / 0 where all is eaten of 1 */
}

/* sum over k of weight_k exp(-T / 4^k), the first times the phase, from s = exp(-T / 64): the powers 64, 16, 4, 1, then
 * roots. */
static inline lom_float sun_share(const lom_medium_desc *desc, const lom_medium_rays *rays, lom_float s)
{
    lom_float power[LOM_MAX_OCTAVES];
    power[3] = s;
    for (int k = 2; k >= 0; k--) {
        lom_float square = power[k + 1] * power[k + 1];
        power[k] = square * square;
    }
    for (int k = 4; k < desc->octaves; k++)
        power[k] = lom_sqrt(lom_sqrt(power[k - 1]));
    lom_float sum = power[0] * (rays->phase * desc->weight[0]);
    for (int k = 1; k < desc->octaves; k++)
        sum += power[k] * desc->weight[k];
    return sum;
}

/* What reaches a place of the sky's light and of the ground's, from what either would send through what lies before it
 * alone, A = 1 / (1 + c t) of the depths t above and below. Droplets that absorb nothing let a flux through a layer that
 * is the same everywhere, so between its sides the radiance is linear in the depth: the sky's share is (1 + c t_below) /
 * (2 + c t_below + c t_above) = A_above / (A_above + A_below), the ground's the rest. */
LOM_INLINE lom_light_sample share_surroundings(lom_light_sample light)
{
    lom_float above = light.sky / lom_max(light.sky + light.ground, lom_splat(0x1p-16f));
    return (lom_light_sample){ light.sun, above, 1.0f - above };
}

LOM_INLINE lom_float largest3(lom_float a, lom_float b, lom_float c)
{
    return lom_max(lom_max(lom_abs(a), lom_abs(b)), lom_abs(c));
}

/* How a packet's rays go from cell to cell along the axis on which the fastest is fastest, and which cells are as good as
 * empty. */
struct cell_walk {
    float per_cell;  /* steps in a cell, or fewer, whatever is rounded */
    float unsure;    /* cells by which a place may be from where it is taken to be: within its cell, and by rounding */
    int clear, last; /* the least emptiness of which nothing is left; the index behind all cells */
};

/* The emptiness from which on noise leaves nothing of a cell that is at least `nearest` away: noise is never below 0, and
 * eats the more of its mean the more it has faded into it. What rounding and fixed point make of it is below a thousandth;
 * noise that eats all of 1 may divide 0 by 0. */
static inline int clear_from(const lom_medium_desc *desc, float nearest)
{
    if (desc->detail == NULL || !(desc->detail_strength < 0.99f) || !(desc->detail_near < desc->detail_far))
        return LOM_CELL_EMPTY;
    const lom_float faded =
        lom_smoothstep(lom_splat(desc->detail_near), lom_splat(desc->detail_far), lom_splat(nearest));
    const float eaten = desc->detail_strength * desc->detail->mean * faded[0] - 1e-3f;
    const int levels = eaten > 0 ? lom_int_of(eaten * 64) : 0;
    return levels < LOM_CELL_EMPTY ? LOM_CELL_EMPTY - levels : 1;
}

/* A place is the start and a multiple of the direction, of which each, their sum and its product with the cells is rounded to
 * 2^-24 of what it is: of a start far away 2^-22 of its cells at most. `distances` are what the noise fades by, or less. */
static inline struct cell_walk walk_cells(const lom_medium_desc *desc, const lom_medium_rays *rays, lom_float step,
                                          lom_float distances)
{
    const lom_medium *m = desc->medium;
    const float across = (float)m->width, down = (float)m->height, deep = (float)m->depth;
    lom_float speed = step * largest3(rays->along.x * across, rays->along.y * down, rays->along.z * deep) + 1e-6f;
    lom_float away = largest3(rays->start.x * across, rays->start.y * down, rays->start.z * deep);
    float speeds[LOM_LANES], far[LOM_LANES], from[LOM_LANES], fastest = 1e-6f, farthest = 0, nearest = 3e38f;
    lom_store(speeds, speed);
    lom_store(far, away);
    lom_store(from, distances);
    struct cell_walk walk = { 0, 1e30f, LOM_CELL_EMPTY, (m->width + 1) * (m->height + 1) * (m->depth + 1) };
    for (uint32_t lanes = lom_bits(rays->active); lanes != 0; lanes &= lanes - 1) {
        int i = __builtin_ctz(lanes);
        if (!(speeds[i] <= 1e30f) || !(far[i] <= 1e30f))
            return walk;
        fastest = speeds[i] > fastest ? speeds[i] : fastest;
        farthest = far[i] > farthest ? far[i] : farthest;
        nearest = from[i] < nearest ? from[i] : nearest;
    }
    walk.per_cell = 0.99999f / fastest;
    walk.unsure = 1.01f + 0x1p-21f * farthest;
    walk.clear = clear_from(desc, nearest);
    return walk;
}

/* Whole steps that are empty for every ray from the places on: where each cell is as good as empty the first is; so are those
 * after it whose cells are nearer than the nearest that holds something. */
static inline int empty_steps(const lom_medium *m, const lom_volume_place *place, lom_mask alive,
                              const struct cell_walk *walk)
{
    int32_t index[LOM_LANES], least[4] = { 255, 255, 255, 255 };
    lom_store_int(index, lom_select_int(alive, place->index, lom_splat_int(walk->last)));
    __asm__("" : "+m"(index));            /* gcc would take them out of registers one by one */
    for (int i = 0; i < LOM_LANES; i++) { /* no branch that the lanes would have to be guessed for */
        int32_t emptiness = m->emptiness[index[i]];
        least[i & 3] = emptiness < least[i & 3] ? emptiness : least[i & 3];
    }
    for (int i = 1; i < 4; i++)
        least[0] = least[i] < least[0] ? least[i] : least[0];
    if (least[0] < LOM_CELL_EMPTY)
        return least[0] >= walk->clear;
    float room = (float)(least[0] - LOM_CELL_EMPTY + 1) - walk->unsure, steps = room * walk->per_cell;
    return 1 + (room > 0 ? lom_int_of(steps < 65535 ? steps : 65535) : 0);
}

/* The extinction of a medium; one without all of a float's digits counts as 0. Nothing that it stops is seen, and some
 * processors take a hundred times as long for each product of such numbers. */
static inline float extinction_of(const lom_medium_desc *desc)
{
    return desc->extinction < 0x1p-126f ? 0.0f : desc->extinction;
}

/* The step of each ray in metres: the asked one, or longer where the ray would take too many. */
static inline lom_float step_of(const lom_medium_desc *desc, const lom_medium_rays *rays)
{
    assert(desc->stop <= 1); /* else rays would end at steps that others beside them skip */
    lom_float length = lom_max(rays->leave - rays->enter, (lom_float){ 0 });
    return lom_max(lom_splat(desc->step), length * (1.0f / (float)desc->most_steps));
}

#endif
