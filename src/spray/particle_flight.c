/* Flight and lives of particles. In: an emitter and a time. Out: where each particle is. Invariant: a particle is a
 * function of the emitter, its number and the time alone. */
#include "spray/spray.h"

static const double gravity = 9.80665;

/* phi1(x) = (1 - e^-x)/x and phi2(x) = (x - 1 + e^-x)/x^2, the integrals of the solution of a linear equation
 * (Hochbruck and Ostermann, Exponential integrators, Acta Numerica 2010, section 2). The differences cancel for small
 * x, where the series sum (-x)^n/(n + 1)! and sum (-x)^n/(n + 2)! stand in for them: 18 terms leave less than 2^-60
 * below x = 1. */
static void flight_integrals(double x, double *phi1, double *phi2)
{
    if (x >= 1) {
        *phi1 = -lom_double_expm1(-x) / x;
        *phi2 = (1 - *phi1) / x;
        return;
    }
    double sum = 0;
    for (int n = 18; n >= 0; n--)
        sum = (1 - x * sum) / (n + 2);
    *phi2 = sum;
    *phi1 = 1 - x * sum;
}

/* With u = v - wind the equation is du/dt = g - drag u, so x = x0 + wind t + u0 t phi1(drag t) + g t^2 phi2(drag t) and
 * u = u0 e^(-drag t) + g t phi1(drag t), where e^-x = 1 - x phi1(x). */
void lom_particle_flight(const double start[3], const double velocity[3], const double wind[3], double drag, double age,
                         double place[3], double now[3])
{
    double phi1, phi2;
    flight_integrals(drag * age, &phi1, &phi2);
    for (int i = 0; i < 3; i++)
        place[i] = start[i] + wind[i] * age + (velocity[i] - wind[i]) * (age * phi1);
    place[1] -= gravity * age * age * phi2;
    for (int i = 0; now != NULL && i < 3; i++)
        now[i] = wind[i] + (velocity[i] - wind[i]) * (1 - drag * age * phi1) - (i == 1 ? gravity * age * phi1 : 0);
}

/* Newton's method on the depth fallen, g t^2 phi2(kt), which is convex in t: from the right it descends to the root.
 * phi2(x) >= 1/(2 + x), so the root of g t^2/(2 + kt) = h is to the right of it. */
double lom_fall_time(double height, double drag)
{
    if (!(height > 0))
        return 0;
    const double hk = height * drag;
    double t = (hk + lom_double_sqrt(hk * hk + 8 * gravity * height)) / (2 * gravity);
    for (int step = 0; step < 64; step++) {
        double phi1, phi2;
        flight_integrals(drag * t, &phi1, &phi2);
        double next = t - (gravity * t * t * phi2 - height) / (gravity * t * phi1);
        if (!(next < t))
            break;
        t = next;
    }
    return t;
}

static bool is_within(double value, double least, double most)
{
    return value >= least && value <= most;
}

bool lom_check_emitter(const lom_emitter *e, double time, lom_error *error)
{
    if (e->count > LOM_MAX_PARTICLES)
        return lom_fail(error, LOM_ERROR_LIMIT, "An emitter of %zu particles is beyond the limit of %d.", e->count,
                        LOM_MAX_PARTICLES);
    for (int i = 0; i < 3; i++) {
        if (!is_within(e->from[i], -1e9, 1e9) || !is_within(e->to[i], -1e9, 1e9))
            return lom_fail(error, LOM_ERROR_USAGE, "The ends of an emitter must be within 1e9 m of the origin.");
        if (!is_within(e->velocity[i], -1000, 1000) || !is_within(e->wind[i], -1000, 1000))
            return lom_fail(error, LOM_ERROR_USAGE, "Velocity and wind of an emitter must be within 1000 m/s.");
    }
    if (!is_within(e->spread, 0, 100) || !is_within(e->spread_up, 0, 100))
        return lom_fail(error, LOM_ERROR_USAGE, "The spread of an emitter must be 0 to 100 m/s.");
    if (!is_within(e->drag, 0, 1000))
        return lom_fail(error, LOM_ERROR_USAGE, "The drag of an emitter must be 0 to 1000 per second.");
    if (!is_within(e->life, 0.001, 3600))
        return lom_fail(error, LOM_ERROR_USAGE, "The life of an emitter's particles must be 0.001 to 3600 s.");
    if (e->jets < 0 || e->jets > LOM_MAX_PARTICLES)
        return lom_fail(error, LOM_ERROR_USAGE, "The jets of an emitter must be 0 to %d.", LOM_MAX_PARTICLES);
    if (e->jets != 0 && (!is_within(e->jet_time, 0.001, 3600) || !is_within(e->jet_width, 0, 1000)))
        return lom_fail(error, LOM_ERROR_USAGE, "A jet must last 0.001 to 3600 s and be 0 to 1000 m wide.");
    if (!is_within(time, -1e9, 1e9))
        return lom_fail(error, LOM_ERROR_USAGE, "The time of particles must be within 1e9 s of 0.");
    return true;
}

static double ramp(double x)
{
    double value = x * x * (3 - 2 * x);
    return x < 1 && value < 1 ? value : 1; /* which rounding may pass just below x = 1 */
}

/* Puts a drop that is born at a time into its jet: where on the segment it begins, and the deviates of its velocity. */
static void join_jet(const lom_emitter *e, size_t index, double birth, double *along, double normal[2])
{
    enum { PLACE, SPREAD, DRAWS };
    const size_t jet = index % (size_t)e->jets;
    const double turns = birth / e->jet_time + (double)jet / (double)e->jets, turn = lom_double_floor(turns);
    const uint64_t key = lom_random_bits(e->seed, (uint64_t)LOM_MAX_PARTICLES + jet);
    const uint64_t counter = (uint64_t)lom_int64_of(turn) * DRAWS;
    double common[2], length = 0, part = turns - turn;
    lom_random_normal(key, counter + SPREAD, common);
    for (int i = 0; i < 3; i++)
        length += (e->to[i] - e->from[i]) * (e->to[i] - e->from[i]);
    length = lom_double_sqrt(length);
    double width = length > 0 ? e->jet_width / length * 4 * part * (1 - part) : 0;
    *along = lom_random_uniform(key, counter + PLACE) + (*along - 0.5) * width;
    for (int i = 0; i < 2; i++)
        normal[i] = 0.8 * common[i] + 0.6 * normal[i];
}

/* The particle as it is at a time, but where it was born, and with the velocity of its birth. */
static lom_particle birth_at(const lom_emitter *e, size_t index, double time)
{
    enum { PLACE, SPREAD, RISE, DRAWS };
    double lives = time / e->life + (double)index / (double)e->count, whole = lom_double_floor(lives);
    if (lives - whole >= 1) /* lives is negative and so small that the difference rounds to 1: the next life begins */
        lives = whole = whole + 1;
    lom_particle p = { .share = lives - whole, .life = lom_int64_of(whole) };
    p.alpha = ramp(10 * p.share) * ramp(10 * (1 - p.share));
    const uint64_t key = lom_random_bits(e->seed, index), counter = (uint64_t)p.life * DRAWS;
    double along = lom_random_uniform(key, counter + PLACE), normal[2], rise[2];
    lom_random_normal(key, counter + SPREAD, normal);
    lom_random_normal(key, counter + RISE, rise);
    if (e->jets != 0)
        join_jet(e, index, (whole - (double)index / (double)e->count) * e->life, &along, normal);
    for (int i = 0; i < 3; i++)
        p.place[i] = e->from[i] + (e->to[i] - e->from[i]) * along;
    p.velocity[0] = e->velocity[0] + e->spread * normal[0];
    p.velocity[1] = e->velocity[1] + e->spread_up * rise[0];
    p.velocity[2] = e->velocity[2] + e->spread * normal[1];
    return p;
}

static lom_particle particle_at(const lom_emitter *e, size_t index, double time)
{
    const lom_particle born = birth_at(e, index, time);
    lom_particle p = born;
    lom_particle_flight(born.place, born.velocity, e->wind, e->drag, p.share * e->life, p.place, p.velocity);
    return p;
}

void lom_birth_range(const lom_emitter *emitter, double time, size_t first, size_t end, lom_particle *particles)
{
    for (size_t i = first; i < end; i++)
        particles[i - first] = birth_at(emitter, i, time);
}

void lom_place_range(const lom_emitter *emitter, double time, size_t first, size_t end, lom_particle *particles)
{
    for (size_t i = first; i < end; i++)
        particles[i - first] = particle_at(emitter, i, time);
}

bool lom_place_particles(const lom_emitter *emitter, double time, lom_particle *particles, lom_error *error)
{
    lom_float_state state;
    lom_enter_float_state(&state);
    bool is_valid = lom_check_emitter(emitter, time, error);
    if (is_valid)
        lom_place_range(emitter, time, 0, emitter->count, particles);
    lom_leave_float_state(&state);
    return is_valid;
}

static void widen(double low[3], double high[3], int axis, double a, double b)
{
    low[axis] += a < b ? a : b;
    high[axis] += a < b ? b : a;
}

/* Of x = start + wind t + (v - wind) t phi1 + g t^2 phi2 each term is bounded alone: t, t phi1 and t^2 phi2 rise from 0
 * to their values at the end of the life, and v lies within 8.58 standard deviations of its mean, in a jet within 0.8 +
 * 0.6 times as many. */
void lom_bound_emitter(const lom_emitter *emitter, double low[3], double high[3])
{
    const double life = emitter->life, most_normal = emitter->jets != 0 ? 1.4 * 8.58 : 8.58;
    double length = 0;
    double phi1, phi2;
    for (int i = 0; i < 3; i++)
        length += (emitter->to[i] - emitter->from[i]) * (emitter->to[i] - emitter->from[i]);
    length = length > 0 ? lom_double_sqrt(length) : 1;
    flight_integrals(emitter->drag * life, &phi1, &phi2);
    for (int i = 0; i < 3; i++) {
        double random = most_normal * (i == 1 ? emitter->spread_up : emitter->spread) * life * phi1;
        double way = emitter->to[i] - emitter->from[i], outside = emitter->jets != 0 ? emitter->jet_width / 2 : 0;
        low[i] = emitter->from[i] + (way < 0 ? way : 0);
        high[i] = emitter->from[i] + (way < 0 ? 0 : way);
        widen(low, high, i, outside * way / length, -outside * way / length);
        widen(low, high, i, 0, emitter->wind[i] * life);
        widen(low, high, i, 0, (emitter->velocity[i] - emitter->wind[i]) * life * phi1);
        widen(low, high, i, -random, random);
    }
    low[1] -= gravity * life * life * phi2;
}

lom_emitter lom_spray_emitter(const lom_spray *spray)
{
    lom_emitter e = { .seed = (uint64_t)spray->seed,
                      .count = (size_t)spray->count,
                      .spread = spray->spread,
                      .spread_up = spray->spread_up,
                      .drag = spray->drag,
                      .jets = spray->jets,
                      .jet_time = spray->jet_time,
                      .jet_width = spray->jet_width,
                      .life = spray->life };
    for (int i = 0; i < 3; i++) {
        e.from[i] = spray->from[i];
        e.to[i] = spray->to[i];
        e.velocity[i] = spray->velocity[i];
        e.wind[i] = spray->wind[i];
    }
    return e;
}
