/* Waves of surf over lanes. In: what they are at a time (lom_surf_uniform), rest positions, the size of what is sampled
 * there. Out: displacements, slopes, foam. Part of wave_lanes.wide.c; invariant as there. */
#ifndef LOM_WAVES_SURF_LANES_H
#define LOM_WAVES_SURF_LANES_H

#include "base/numbers.h"
#include "waves/surf_curl.h"
#include "waves/wave_lanes.h"

/* How much of a wave is left when its phase changes by so much from sample to sample: (1 - (change / pi)^2)^2, nothing
 * from pi on, where it could not be told from another. */
static lom_float wave_weight(lom_float change)
{
    lom_float left = lom_max(1.0f - change * change * 0.10132118f, (lom_float){ 0 });
    return left * left;
}

/* A wave of surf at a place: its amplitude times its size in its group, the angle w t - theta, and what follows of the
 * angle: its height in amplitudes and the derivative of that. */
struct surf_wave {
    lom_float amplitude, kx, kz, angle, lean_angle, breaking;
    lom_float height, change;
    lom_float s, t, size, outside; /* its place in the maps; its size in its group; radians beyond them */
};

/* eta = a s (sin t + r sin f / (1 + s)) / (1 - r cos(t + f)), s = sqrt(1 - r^2) (Abreu, Silva, Sancho, Temperville
 * 2010, equation 7): a sine, peaked crests or a steep front. Beyond the maps the phase goes on straight. */
static struct surf_wave find_surf(const struct lom_surf_uniform *u, lom_float x, lom_float z)
{
    lom_float s = (x - u->corner[0]) * u->scale[0] + u->half[0], t = (z - u->corner[1]) * u->scale[1] + u->half[1];
    lom_float4 wave = lom_sample(u->waves, s, t, (lom_float){ 0 }),
               shape = lom_sample(u->shapes, s, t, (lom_float){ 0 });
    lom_float outside_x = x - lom_clamp(x, lom_splat(u->corner[0]), lom_splat(u->last[0]));
    lom_float outside_z = z - lom_clamp(z, lom_splat(u->corner[1]), lom_splat(u->last[1]));
    lom_float theta = wave.x + wave.y * outside_x + wave.z * outside_z, size = lom_splat(1.0f);
    for (int i = 0; i < 2; i++)
        size = size + u->variation * u->group_share[i] *
                          lom_sin(u->group_time[i] - theta * u->group_rate[i] + x * u->group_along[i][0] +
                                  z * u->group_along[i][1]);
    struct surf_wave w = { .amplitude = wave.w * size, .kx = wave.y, .kz = wave.z, .angle = u->time - theta };
    w.s = s;
    w.t = t;
    w.size = size;
    w.outside = wave.y * outside_x + wave.z * outside_z;
    lom_float sine = lom_sin(w.angle), cosine = lom_cos(w.angle);
    lom_float root = lom_sqrt(lom_max(1.0f - shape.x * shape.x - shape.y * shape.y, lom_splat(0.01f)));
    lom_float above = sine + shape.y / (1.0f + root), below = 1.0f - shape.x * cosine + shape.y * sine;
    w.height = root * above / below;
    w.change = root * (cosine * below - above * (shape.x * sine + shape.y * cosine)) / (below * below);
    w.breaking = shape.z;
    w.lean_angle = w.angle + lom_atan2(shape.y, lom_max(shape.x, lom_splat(1e-6f)));
    return w;
}

/* How much of it a footprint leaves. */
static lom_float surf_weight(const struct surf_wave *w, const struct lom_footprint *f)
{
    return wave_weight(lom_max(lom_abs(w->kx * f->ax + w->kz * f->az), lom_abs(w->kx * f->bx + w->kz * f->bz)));
}

/* Foam of a breaking wave: it begins at the foot of the front, half a radian before the steepest place t = -f, and
 * lies behind it until it has faded, whatever broke before: the same at every moment at which the angle is the same. */
static lom_float surf_foam(const struct lom_surf_uniform *u, const struct surf_wave *w, float window)
{
    lom_float turns = (w->lean_angle + 0.5f) * 0.15915494f, part = turns - lom_floor(turns);
    lom_float behind = lom_fade(part * (-(float)lom_two_pi / (u->rate * window)));
    lom_float ahead = lom_saturate(1.0f - (1.0f - part) * 20.0f);
    return w->breaking * lom_max(behind, ahead);
}

/* ---- plunging (surf_curl.h; surf_curl.c is the same in double) ---- */

/* How a wave plunges at a place: 0 not at all .. 1, radians ahead of its crest, seconds since its lip left and since
 * that of the crest that was here, seconds that a lip flies; metres ahead of the spilling wave and over it. */
struct surf_plunge {
    lom_float strength, ahead, age, passed, flight;
    lom_float forward, up;
};

/* What the curl is made of: struct curl of surf_curl.c. */
struct curl {
    lom_float x, front, speed, flight, steep, thrown, seconds, part;
    lom_float ahead, span, height, drop, bend; /* bend: smooth share of the back that is drawn out */
};

static lom_float smooth_share(lom_float t)
{
    return lom_smoothstep(lom_splat(0.0f), lom_splat(1.0f), t);
}

static lom_float fall_at(const struct curl *c, lom_float x)
{
    lom_float seconds = lom_min(lom_max(x, (lom_float){ 0 }) / c->speed, c->seconds);
    return 4.903325f * seconds * seconds;
}

static void throw_lip(const struct curl *c, struct surf_plunge *p)
{
    lom_mask front = c->ahead >= 0.0f;
    lom_float roof = smooth_share(1.0f + c->ahead * (1.0f / lom_curl_roof));
    lom_float below = smooth_share(1.0f - c->part * (1.0f / lom_curl_below));
    lom_float share = lom_select(front, below, roof);
    lom_float x = c->x - lom_select(front, c->steep * c->part, (lom_float){ 0 }) + c->thrown * share;
    lom_float hollow = smooth_share(2.0f * c->part) * smooth_share(2.0f - 2.0f * c->part) * lom_curl_hollow;
    lom_float thicker = 4.0f * share * (1.0f - share) * lom_curl_thickness * c->drop * c->seconds / c->flight;
    lom_float weight = lom_select(front, share * (2.0f - share), lom_splat(1.0f));
    p->forward = c->steep * lom_select(front, lom_splat(1.0f), c->bend) + (x - c->x) - c->thrown * hollow;
    p->up = -(weight * fall_at(c, x)) - lom_select(front, thicker, (lom_float){ 0 });
}

static lom_float run_bore(const struct curl *c)
{
    lom_float most = lom_curl_steep * c->front, crest = most + 0.8f * c->speed * c->flight;
    lom_float foot = lom_max(lom_curl_foot * c->front, crest - most);
    lom_float beyond = lom_max(c->ahead - c->span, (lom_float){ 0 });
    lom_float reach = 0.6f * lom_max((float)lom_pi - c->span, lom_splat(0.1f));
    lom_float before = crest * (1.0f - c->part) + foot * c->part * smooth_share(1.0f - beyond / reach);
    return lom_select(c->ahead >= 0.0f, before, crest * c->bend);
}

/* The curl of a wave at a place of the maps, in the lanes where one is; false: in none. */
static bool find_plunge(const struct lom_surf_uniform *u, const struct surf_wave *w, const struct lom_footprint *f,
                        struct surf_plunge *p)
{
    lom_float zero = { 0 };
    lom_float4 curl = lom_sample(u->curls[0], w->s, w->t, zero);
    p->strength = lom_saturate(curl.y * surf_weight(w, f));
    if (!lom_any(p->strength > 0.0f))
        return false;
    lom_float4 shape = lom_sample(u->curls[1], w->s, w->t, zero);
    lom_float turns = (curl.w - w->angle) * (1.0f / (float)lom_two_pi);
    lom_float number = lom_sqrt(lom_max(w->kx * w->kx + w->kz * w->kz, lom_splat(1e-8f)));
    lom_float since = curl.x + w->outside + curl.z * (w->size - 1.0f);
    struct curl c = { .ahead = (turns - lom_floor(turns + 0.5f)) * (float)lom_two_pi, .span = shape.x };
    p->ahead = c.ahead;
    p->age = (since - c.ahead) / u->rate;
    p->passed = since / u->rate;
    c.drop = lom_max(w->amplitude * shape.z, lom_splat(1e-4f));
    c.flight = p->flight = lom_sqrt(c.drop * (2.0f / 9.80665f));
    c.x = c.ahead / number;
    c.front = c.span / number;
    c.speed = lom_curl_speed * u->rate / number;
    c.part = lom_saturate(c.ahead / c.span);
    c.seconds = lom_clamp(p->age, zero, c.flight);
    c.bend = smooth_share(1.0f + c.ahead * (1.0f / lom_curl_back));
    lom_float most = lom_curl_steep * c.front, steepening = most / c.speed;
    c.steep = most * lom_saturate((p->age + steepening) / steepening);
    c.thrown = c.speed * c.seconds;
    throw_lip(&c, p);
    lom_float after = (p->age - c.flight) / c.flight, closed = smooth_share(after);
    lom_float bore = run_bore(&c) * (1.0f - smooth_share(after * (1.0f / lom_curl_bore)));
    p->forward = p->strength * (p->forward * (1.0f - closed) + bore * closed);
    p->up = p->strength * p->up * (1.0f - closed);
    return true;
}

/* The shift of a curl along the wave's way. */
static void add_plunge(const struct surf_wave *w, const struct surf_plunge *p, struct lom_wave_shift *shift)
{
    lom_float forward = p->forward / lom_sqrt(lom_max(w->kx * w->kx + w->kz * w->kz, lom_splat(1e-8f)));
    shift->dx = shift->dx + forward * w->kx;
    shift->dz = shift->dz + forward * w->kz;
    shift->h = shift->h + p->up;
}

static void add_surf_shift(const struct lom_surf_uniform *u, lom_float x, lom_float z, const struct lom_footprint *f,
                           struct lom_wave_shift *shift)
{
    struct surf_wave w = find_surf(u, x, z);
    struct surf_plunge p;
    shift->h = shift->h + w.amplitude * w.height * surf_weight(&w, f);
    if (u->curls[0] != NULL && find_plunge(u, &w, f, &p))
        add_plunge(&w, &p, shift);
}

/* The shift of the curl alone. */
static struct lom_wave_shift plunge_at(const struct lom_surf_uniform *u, lom_float x, lom_float z,
                                       const struct lom_footprint *f)
{
    struct lom_wave_shift shift = { { 0 }, { 0 }, { 0 } };
    struct surf_wave w = find_surf(u, x, z);
    struct surf_plunge p;
    if (find_plunge(u, &w, f, &p))
        add_plunge(&w, &p, &shift);
    return shift;
}

/* Foam of a wave that plunges: none on its front before its lip lands, but a rim of the lip, nor where it passed before
 * that; the front of a young bore is white. Beyond the foot lies the foam of the wave before it. */
static lom_float plunge_foam(const struct surf_plunge *p, lom_float foam)
{
    lom_float landed = smooth_share((p->age - 0.9f * p->flight) / (0.25f * p->flight));
    lom_float passed = smooth_share((p->passed - 0.7f * p->flight) / (0.5f * p->flight));
    lom_float behind = smooth_share(p->ahead * -6.0f), beyond = smooth_share(p->ahead * 2.5f - 3.5f);
    lom_float front = 1.0f - lom_max(behind, beyond);
    lom_float young = 1.0f - smooth_share((p->age - 3.0f * p->flight) / (8.0f * p->flight));
    lom_float rim = 0.75f * smooth_share(1.0f - lom_abs(p->ahead) * 6.0f) * smooth_share(2.0f * p->age / p->flight);
    lom_float white = lom_max(1.05f * landed * young * front, rim * (1.0f - landed));
    lom_float own = lom_max(foam * (landed * front + passed * behind + beyond), white);
    return lom_mix(foam, own, p->strength);
}

/* The derivatives of the curl by differences over some of the footprint: its slopes are those of what is drawn, along
 * the crest too. */
static void add_plunge_slopes(const struct lom_surf_uniform *u, const struct surf_wave *wave, lom_float x, lom_float z,
                              const struct lom_footprint *f, float window, struct lom_wave_slopes *w)
{
    struct surf_plunge p;
    lom_float foam = surf_foam(u, wave, window);
    if (!find_plunge(u, wave, f, &p)) {
        w->foam = w->foam + foam;
        return;
    }
    lom_mask over = (p.strength > 0.0f) & ((p.forward > 0.0f) | (p.forward < 0.0f));
    w->foam = w->foam + plunge_foam(&p, foam);
    if (!lom_any(over))
        return;
    lom_float step =
        lom_max(0.5f * lom_max(lom_max(lom_abs(f->ax), lom_abs(f->az)), lom_max(lom_abs(f->bx), lom_abs(f->bz))),
                lom_splat(0.04f));
    struct lom_wave_shift here = { { 0 }, { 0 }, { 0 } };
    add_plunge(wave, &p, &here);
    struct lom_wave_shift right = plunge_at(u, x + step, z, f), below = plunge_at(u, x, z + step, f);
    lom_float scale = lom_select(over, 1.0f / step, (lom_float){ 0 });
    w->sx = w->sx + (right.h - here.h) * scale;
    w->sz = w->sz + (below.h - here.h) * scale;
    w->xx = w->xx + (right.dx - here.dx) * scale;
    w->zz = w->zz + (below.dz - here.dz) * scale;
    w->xz = w->xz + 0.5f * ((right.dz - here.dz) + (below.dx - here.dx)) * scale;
    w->overturns = w->overturns | over;
}

/* Water under a wave of amplitude a moves by u = a w / tanh(kd) sin t, at most by c = w / k; its integral is to and
 * fro by a / tanh(kd) = a g k / w^2, at most by 1 / k. */
static void add_surf_drift(const struct lom_surf_uniform *u, const struct surf_wave *wave, struct lom_wave_slopes *w)
{
    lom_float square = lom_max(wave->kx * wave->kx + wave->kz * wave->kz, lom_splat(1e-12f));
    lom_float way = lom_min(wave->amplitude * u->swing, 1.0f / square) * -lom_cos(wave->angle);
    w->drift_x = w->drift_x + way * wave->kx;
    w->drift_z = w->drift_z + way * wave->kz;
}

static void add_surf_slopes(const struct lom_waves_uniform *waves, lom_float x, lom_float z,
                            const struct lom_footprint *f, struct lom_wave_slopes *w)
{
    struct surf_wave wave = find_surf(&waves->surf, x, z);
    lom_float weight = surf_weight(&wave, f), slope = -(wave.amplitude * wave.change * weight);
    lom_float lost = 0.5f * (1.0f - weight * weight) * wave.amplitude * wave.amplitude;
    w->sx = w->sx + slope * wave.kx;
    w->sz = w->sz + slope * wave.kz;
    w->vxx = w->vxx + lost * wave.kx * wave.kx;
    w->vzz = w->vzz + lost * wave.kz * wave.kz;
    w->vxz = w->vxz + lost * wave.kx * wave.kz;
    if (waves->surf.curls[0] != NULL)
        add_plunge_slopes(&waves->surf, &wave, x, z, f, waves->foam_window, w);
    else
        w->foam = w->foam + surf_foam(&waves->surf, &wave, waves->foam_window);
    if (waves->surf.swing > 0)
        add_surf_drift(&waves->surf, &wave, w);
}

#endif
