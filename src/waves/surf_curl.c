/* The curl of a plunging breaker in double (surf_curl.h has its description; surf_lanes.h the same over lanes). */
#include "waves/surf_curl.h"

#include <lom/base.h>
#include "base/numbers.h"

static const double gravity = 9.80665;

static double smooth_step(double t)
{
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    return t * t * (3 - 2 * t);
}

static double saturated(double t)
{
    return t < 0 ? 0 : t > 1 ? 1 : t;
}

struct curl {
    double x, front, speed, flight; /* metres ahead; of F; v; seconds until the lip lands */
    double steep, thrown;           /* metres that the crest is ahead when its lip leaves, and the lip since then */
    double seconds;                 /* that the lip has flown */
    double part;                    /* of the way from crest to foot: 0 .. 1 */
};

/* Under the parabola of free fall at x metres ahead of where the lip left. */
static double fall_at(const struct curl *c, double x)
{
    const double seconds = lom_smaller(lom_larger(x, 0) / c->speed, c->seconds);
    return gravity / 2 * seconds * seconds;
}

/* The wave from its back over the jet to its foot. */
static void throw_lip(const struct curl *c, const struct lom_curl_wave *w, double place[2])
{
    const double back = smooth_step(1 + w->ahead / (double)lom_curl_back);
    if (w->ahead < 0) {
        const double x = c->x + c->thrown * smooth_step(1 + w->ahead / (double)lom_curl_roof);
        place[0] = c->steep * back + x;
        place[1] = w->height - fall_at(c, x);
        return;
    }
    const double share = smooth_step(1 - c->part / (double)lom_curl_below),
                 x = c->x - c->steep * c->part + c->thrown * share;
    const double hollow = smooth_step(2 * c->part) * smooth_step(2 - 2 * c->part);
    const double thicker = 4 * share * (1 - share) * (double)lom_curl_thickness * w->drop * c->seconds / c->flight;
    place[0] = c->steep + x - (double)lom_curl_hollow * c->thrown * hollow;
    place[1] = w->height - share * (2 - share) * fall_at(c, x) - thicker;
}

/* How far the bore is ahead of the wave. */
static double run_bore(const struct curl *c, const struct lom_curl_wave *w)
{
    const double most = (double)lom_curl_steep * c->front, crest = most + 0.8 * c->speed * c->flight;
    const double foot = lom_larger((double)lom_curl_foot * c->front, crest - most);
    if (w->ahead < 0)
        return crest * smooth_step(1 + w->ahead / (double)lom_curl_back);
    const double beyond = lom_larger(w->ahead - w->span, 0), reach = 0.6 * lom_larger(lom_pi - w->span, 0.1);
    return crest * (1 - c->part) + foot * c->part * smooth_step(1 - beyond / reach);
}

void lom_surf_curl(const struct lom_curl_wave *w, double shift[2])
{
    struct curl c = { .x = w->ahead / w->number,
                      .front = w->span / w->number,
                      .speed = (double)lom_curl_speed * w->speed,
                      .part = saturated(w->ahead / w->span) };
    c.flight = lom_double_sqrt(2 * lom_larger(w->drop, 1e-4) / gravity);
    c.seconds = w->age < 0 ? 0 : lom_smaller(w->age, c.flight);
    const double steepening = (double)lom_curl_steep * c.front / c.speed;
    c.steep = (double)lom_curl_steep * c.front * saturated((w->age + steepening) / steepening);
    c.thrown = c.speed * c.seconds;
    const double after = (w->age - c.flight) / c.flight, closed = smooth_step(after);
    const double bore = run_bore(&c, w) * (1 - smooth_step(after / (double)lom_curl_bore));
    double place[2];
    throw_lip(&c, w, place);
    shift[0] = (place[0] - c.x) * (1 - closed) + bore * closed;
    shift[1] = (place[1] - w->height) * (1 - closed);
}
