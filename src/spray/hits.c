/* Drops where water throws them (hits.h). In: places, a time. Out: where each drop is. Invariant: a drop is a function of
 * the places, its number and the time alone. */
#include "spray/hits.h"

#include "base/numbers.h"

static const double gravity = 9.80665;
static const double slow = 1, fast = 3; /* m/s: water that is slower throws no drops, faster all of them */

double lom_hit_speed(const struct lom_hit_place *place, double size)
{
    const double a = place->amplitude * size;
    if (!(a > 0))
        return place->speed;
    const double u = lom_smaller(place->speed, a * place->swing);
    return lom_double_sqrt(u * u + 2 * gravity * a);
}

const struct lom_hit_place *lom_find_hit_place(const struct lom_hits *hits, double at)
{
    const double weight = at * hits->sum[hits->count - 1];
    size_t low = 0, high = hits->count - 1;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (hits->sum[middle] > weight)
            high = middle;
        else
            low = middle + 1;
    }
    return &hits->places[low];
}

static double ramp(double x)
{
    x = x < 0 ? 0 : x > 1 ? 1 : x;
    return x * x * (3 - 2 * x);
}

double lom_hit_alpha(double share, double speed)
{
    return ramp(10 * share) * ramp(10 * (1 - share)) * ramp((speed - slow) / (fast - slow));
}

/* Of a drop: which life it is, of surf the number of the wave, and when it began. */
struct birth {
    double number, time, size; /* size: of the wave */
};

enum { DELAY, ALONG, UP, BACK, NORMAL, RISE = NORMAL + 1, DRAWS };

static struct birth find_birth(const struct lom_hits *hits, const struct lom_hit_place *at, const lom_emitter *e,
                               uint64_t key, size_t index, double time)
{
    if (hits->period == 0) {
        const double shift = (double)index / (double)e->count, number = lom_double_floor(time / e->life + shift);
        return (struct birth){ number, (number - shift) * e->life, 1 };
    }
    const double number = lom_double_floor((time - at->arrival) / hits->period);
    const double front = at->arrival + number * hits->period;
    const double part = lom_random_uniform(key, (uint64_t)lom_int64_of(number) * DRAWS + DELAY);
    struct lom_surf_uniform moment;
    lom_fill_surf(&moment, &hits->map, &hits->surf, (double[2]){ 0, 0 }, front);
    return (struct birth){ number, front + e->jet_time * part * part,
                           lom_surf_size(&moment, at->phase, at->place[0], at->place[1]) };
}

/* Most drops are slow: the squares of their shares of the speed are spread evenly. What the wall turns goes up, and back
 * to the sea by a third of that. */
static void throw(const struct lom_hits *hits, const struct lom_hit_place *at, const lom_emitter *e, double speed,
                  uint64_t key, uint64_t counter, double start[3], double velocity[3])
{
    double normal[2], rise[2];
    const double across = (lom_random_uniform(key, counter + ALONG) - 0.5) * at->width;
    const double up = lom_random_uniform(key, counter + UP), turned = speed * up * up;
    const double along = hits->period == 0 ? speed : -0.6 * turned * lom_random_uniform(key, counter + BACK);
    lom_random_normal(key, counter + NORMAL, normal);
    lom_random_normal(key, counter + RISE, rise);
    for (int i = 0; i < 2; i++) {
        start[2 * i] = at->place[i] + (i == 0 ? -at->way[1] : at->way[0]) * across;
        velocity[2 * i] = e->velocity[2 * i] + along * at->way[i] + e->spread * normal[i];
    }
    start[1] = at->level;
    velocity[1] = e->velocity[1] + turned + e->spread_up * rise[0];
}

static lom_particle hit_at(const struct lom_hits *hits, const lom_emitter *e, double kick, size_t index, double time)
{
    const struct lom_hit_place *at = lom_find_hit_place(hits, ((double)index + 0.5) / (double)e->count);
    const uint64_t key = lom_random_bits(e->seed, index);
    const struct birth birth = find_birth(hits, at, e, key, index, time);
    const double speed = lom_hit_speed(at, birth.size), age = time - birth.time, share = age / e->life;
    lom_particle p = { .life = lom_int64_of(birth.number), .share = share >= 0 && share < 1 ? share : 0 };
    double start[3], velocity[3];
    throw(hits, at, e, kick * speed, key, (uint64_t)p.life * DRAWS, start, velocity);
    lom_particle_flight(start, velocity, e->wind, e->drag, p.share * e->life, p.place, p.velocity);
    const bool flies = share >= 0 && share < 1;
    p.alpha = flies ? lom_hit_alpha(share, speed) : 0;
    return p;
}

void lom_place_hits(const struct lom_hits *hits, const lom_emitter *emitter, double kick, double time, size_t first,
                    size_t end, lom_particle *particles)
{
    for (size_t i = first; i < end; i++)
        particles[i - first] = hits->followed != 0 ? lom_entity_hit_at(hits, emitter, kick, i, time)
                                                   : hit_at(hits, emitter, kick, i, time);
}

/* The box of the places, as a segment, and what is thrown adds to the velocity on every axis. */
void lom_bound_hits(const struct lom_hits *hits, const lom_emitter *emitter, double kick, double low[3], double high[3])
{
    lom_emitter e = *emitter;
    e.jets = 0;
    for (int i = 0; i < 3; i++) {
        e.from[i] = hits->low[i];
        e.to[i] = hits->high[i];
    }
    lom_bound_emitter(&e, low, high);
    for (int i = 0; i < 3; i++) {
        const double reach = kick * hits->fastest * e.life + hits->places[0].width;
        low[i] -= reach;
        high[i] += reach;
    }
}
