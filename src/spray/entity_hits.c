/* Drops that water throws up at an entity which stands or floats in it (hits.h). In: its waterline, the waves, a time. Out:
 * where each drop is. Invariant: a drop is a function of the scene, its number and the time alone. */
#include "spray/hits.h"

#include "base/numbers.h"

static const double gravity = 9.80665;
static const double moment = 1.0 / 64; /* s: of the differences that give the velocity of the entity */

/* How the entity stands at a time: what its waterline is turned and moved by. */
struct stand {
    double place[2], turn[2], velocity[2]; /* turn: cosine and sine */
};

static struct stand stand_at(const struct lom_hits *hits, double time)
{
    struct stand at = { .turn = { 1, 0 } };
    double before[2], after[2], heading;
    hits->follow(hits->scene, hits->followed, time, at.place, &heading);
    if (!hits->moves)
        return at;
    at.turn[0] = lom_double_cos(heading - hits->heading);
    at.turn[1] = lom_double_sin(heading - hits->heading);
    hits->follow(hits->scene, hits->followed, time - moment, before, &heading);
    hits->follow(hits->scene, hits->followed, time + moment, after, &heading);
    for (int i = 0; i < 2; i++)
        at.velocity[i] = (after[i] - before[i]) / (2 * moment);
    return at;
}

static void turn(const struct stand *at, const double from[2], double out[2])
{
    out[0] = at->turn[0] * from[0] - at->turn[1] * from[1];
    out[1] = at->turn[1] * from[0] + at->turn[0] * from[1];
}

/* The piece of the waterline with its place and its normal as they are at the time. */
static struct lom_hit_place place_piece(const struct lom_hit_place *piece, const struct stand *at)
{
    struct lom_hit_place placed = *piece;
    turn(at, piece->place, placed.place);
    turn(at, piece->way, placed.way);
    for (int i = 0; i < 2; i++)
        placed.place[i] += at->place[i];
    return placed;
}

/* Which of the sides a velocity comes from, in the entity's own frame. */
static int find_side(const struct stand *at, const double velocity[2])
{
    const double own[2] = { at->turn[0] * velocity[0] + at->turn[1] * velocity[1],
                            at->turn[0] * velocity[1] - at->turn[1] * velocity[0] };
    const int side = lom_int_of(lom_double_floor(lom_double_atan2(own[1], own[0]) / lom_two_pi * LOM_HIT_SIDES + 0.5));
    return (side + LOM_HIT_SIDES) % LOM_HIT_SIDES;
}

static bool is_met(const struct lom_hit_place *piece, const struct stand *at, const double u[2])
{
    return (piece->met_from >> find_side(at, u) & 1) != 0;
}

/* The water at a piece, and in u its velocity seen from the entity. */
static struct lom_water_motion water_at(const struct lom_hits *hits, const struct lom_hit_place *piece,
                                        const struct stand *at, double time, double u[2])
{
    const struct lom_water_motion water = lom_water_motion_at(&hits->trains, piece->place[0], piece->place[1], time);
    for (int i = 0; i < 2; i++)
        u[i] = water.velocity[i] - at->velocity[i];
    return water;
}

/* By Bernoulli's law water of speed u that stands h over the level can rise to h + u^2 / 2g. Of that a wall which it meets
 * at an angle turns upwards what its normal component is of it. */
static double thrown_at(const struct lom_hits *hits, const struct lom_hit_place *piece, const struct stand *at,
                        double time)
{
    double u[2];
    const struct lom_water_motion water = water_at(hits, piece, at, time, u);
    const double square = u[0] * u[0] + u[1] * u[1], meeting = -(u[0] * piece->way[0] + u[1] * piece->way[1]);
    const double energy = square + 2 * gravity * water.height;
    return meeting > 0 && energy > 0 && is_met(piece, at, u) ? meeting * lom_double_sqrt(energy / square) : 0;
}

enum { UP, BACK, NORMAL, RISE, ALONG, LOOKS, MOST_LOOKS = 8, DRAWS = LOOKS + MOST_LOOKS };

/* Where a drop begins: most pieces are in the lee, so it looks at some, with the velocity that the water has at the first,
 * for one that is met. */
static struct lom_hit_place find_start(const struct lom_hits *hits, const struct stand *at, uint64_t key,
                                       uint64_t counter, double time)
{
    const struct lom_hit_place *piece = lom_find_hit_place(hits, lom_random_uniform(key, counter + LOOKS));
    struct lom_hit_place placed = place_piece(piece, at);
    double u[2];
    water_at(hits, &placed, at, time, u);
    for (uint64_t look = 1; look < MOST_LOOKS && !is_met(piece, at, u); look++)
        piece = lom_find_hit_place(hits, lom_random_uniform(key, counter + LOOKS + look));
    placed = place_piece(piece, at);
    const double across = (lom_random_uniform(key, counter + ALONG) - 0.5) * placed.width;
    placed.place[0] -= placed.way[1] * across;
    placed.place[1] += placed.way[0] * across;
    return placed;
}

lom_particle lom_entity_hit_at(const struct lom_hits *hits, const lom_emitter *e, double kick, size_t index,
                               double time)
{
    const uint64_t key = lom_random_bits(e->seed, index);
    const double shift = (double)index / (double)e->count, number = lom_double_floor(time / e->life + shift);
    const double birth = (number - shift) * e->life, age = time - birth, share = age / e->life;
    lom_particle p = { .life = lom_int64_of(number), .share = share >= 0 && share < 1 ? share : 0 };
    const uint64_t counter = (uint64_t)p.life * DRAWS;
    const struct stand at = stand_at(hits, birth);
    const struct lom_hit_place piece = find_start(hits, &at, key, counter, birth);
    const double speed = thrown_at(hits, &piece, &at, birth);
    double normal[2], rise[2], start[3], velocity[3];
    const double up = lom_random_uniform(key, counter + UP), turned = kick * speed * up * up;
    const double lean = 0.4 * lom_random_uniform(key, counter + BACK), off = turned * lean,
                 rising = turned * lom_double_sqrt(1 - lean * lean);
    lom_random_normal(key, counter + NORMAL, normal);
    lom_random_normal(key, counter + RISE, rise);
    for (int i = 0; i < 2; i++) {
        start[2 * i] = piece.place[i];
        velocity[2 * i] = e->velocity[2 * i] + at.velocity[i] + off * piece.way[i] + e->spread * normal[i];
    }
    start[1] = piece.level;
    velocity[1] = e->velocity[1] + rising + e->spread_up * rise[0];
    lom_particle_flight(start, velocity, e->wind, e->drag, p.share * e->life, p.place, p.velocity);
    if (share >= 0 && share < 1)
        p.alpha = lom_hit_alpha(share, speed);
    return p;
}

static const double anywhere = 1e9; /* metres: an entity that moves is no farther; its drops are moved in every frame */

/* Leaves out what stands on dry ground. */
static bool keep_wet(struct lom_hits *hits, const struct lom_wave_site *site, const struct stand *at, lom_error *error)
{
    size_t kept = 0;
    for (size_t i = 0; i < hits->count; i++) {
        struct lom_hit_place place = hits->places[i];
        if (!hits->moves && lom_bed_over_level(site, place.place[0], place.place[1]) >= 0)
            continue;
        for (int k = 0; k < 3; k++) {
            const double to = k == 1 ? place.level : place.place[k / 2], wide = hits->moves ? anywhere : place.width;
            hits->low[k] = kept > 0 ? lom_smaller(hits->low[k], to - wide) : to - wide;
            hits->high[k] = kept > 0 ? lom_larger(hits->high[k], to + wide) : to + wide;
        }
        for (int k = 0; k < 2; k++)
            place.place[k] -= at->place[k];
        hits->places[kept++] = place;
    }
    hits->count = kept;
    hits->sum = lom_allocate(kept + 1, sizeof *hits->sum, error);
    for (size_t i = 0; hits->sum != NULL && i < kept; i++)
        hits->sum[i] = (i > 0 ? hits->sum[i - 1] : 0) + hits->places[i].width;
    return hits->sum != NULL;
}

bool lom_find_entity_hits(struct lom_hits *hits, const struct lom_wave_site *site, const struct lom_hit_body *body,
                          lom_error *error)
{
    struct stand first = { .turn = { 1, 0 } };
    hits->follow = site->follow;
    hits->scene = site->scene;
    hits->followed = body->followed;
    hits->moves = body->moves;
    site->follow(site->scene, body->followed, 0, first.place, &hits->heading);
    if (!lom_find_waterline(hits, body, site->level, error) || !keep_wet(hits, site, &first, error) ||
        !lom_find_wave_trains(&hits->trains, site, error))
        return false;
    const struct lom_water_motion most = lom_bound_water_motion(&hits->trains);
    const double u = most.velocity[0];
    hits->fastest = lom_double_sqrt(u * u + 2 * gravity * most.height);
    return true;
}
