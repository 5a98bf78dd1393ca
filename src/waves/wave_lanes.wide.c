/* The waves of a surface over lanes. In: rest positions and the size of what is sampled there; out: displacements,
 * slopes with the variance of what is too small to be seen, foam (wave_lanes.h says what each kind of wave is). */
#include "base/numbers.h"
#include "image/sample_alike.h"
#include "waves/surf_lanes.h"
#include "waves/wake_lanes.h"

#include <string.h>

static lom_float phase_change(const struct lom_trochoid_uniform *t, const struct lom_footprint *f)
{
    return lom_max(lom_abs(t->kx * f->ax + t->kz * f->az), lom_abs(t->kx * f->bx + t->kz * f->bz));
}

/* A trochoid at a rest position: what a footprint leaves of it, and the sine and cosine of its angle times that; they
 * are found where anything is left. */
struct trochoid {
    lom_float weight, sine, cosine;
    bool is_seen;
};

static struct trochoid find_trochoid(const struct lom_trochoid_uniform *t, lom_float x, lom_float z,
                                     const struct lom_footprint *f)
{
    struct trochoid found = { wave_weight(phase_change(t, f)), { 0 }, { 0 }, false };
    found.is_seen = lom_any(found.weight > 0.0f);
    if (!found.is_seen)
        return found;
    lom_float angle = t->kx * x + t->kz * z + t->phase;
    found.sine = lom_sin(angle) * found.weight;
    found.cosine = lom_cos(angle) * found.weight;
    return found;
}

/* What is looked up of the region: 0 outside. */
struct shallow_place {
    lom_float s, t, lod;
    lom_mask inside;
};

static struct shallow_place shallow_place_of(const struct lom_shallow_uniform *u, lom_float x, lom_float z,
                                             const struct lom_footprint *f)
{
    struct shallow_place p = { (x - u->corner[0]) * u->scale[0], (z - u->corner[1]) * u->scale[1], { 0 }, { 0 } };
    p.inside = (p.s >= 0.0f) & (p.s <= 1.0f) & (p.t >= 0.0f) & (p.t <= 1.0f);
    p.lod = lom_lod_of(u->surface, f->ax * u->scale[0], f->az * u->scale[1], f->bx * u->scale[0], f->bz * u->scale[1]);
    return p;
}

static void add_trochoid_shift(const struct lom_trochoid_uniform *t, const struct trochoid *found,
                               struct lom_wave_shift *p)
{
    if (!found->is_seen)
        return;
    p->h = p->h + t->amplitude * found->cosine;
    p->dx = p->dx - t->across_x * found->sine;
    p->dz = p->dz - t->across_z * found->sine;
}

/* A pattern that repeats shows its period where a period is a few samples wide, though each of its waves is seen whole:
 * samples of it are wider, from all waves that they leave at 64 samples a period to none at 16, and what they take is
 * roughness. It is the period across what is seen that counts: along a flat view it is short. */
LOM_INLINE struct lom_footprint hide_period(const struct lom_waves_uniform *waves, const struct lom_footprint *f)
{
    if (!(waves->period > 0))
        return *f;
    lom_float across = lom_min(f->ax * f->ax + f->az * f->az, f->bx * f->bx + f->bz * f->bz);
    lom_float wider = lom_clamp(across * (4096 / (waves->period * waves->period)), lom_splat(1.0f), lom_splat(0x1p40f));
    return (struct lom_footprint){ f->ax * wider, f->az * wider, f->bx * wider, f->bz * wider };
}

/* What all others add to the shift of the trochoids. */
static void add_other_shifts(const struct lom_waves_uniform *waves, lom_float x, lom_float z,
                             const struct lom_footprint *f, struct lom_wave_shift *p)
{
    if (waves->shallow.surface != NULL) {
        struct shallow_place at = shallow_place_of(&waves->shallow, x, z, f);
        lom_float height = lom_sample(waves->shallow.surface, at.s, at.t, at.lod).x;
        p->h = p->h + lom_select(at.inside, height, (lom_float){ 0 });
    }
    if (waves->surf.waves != NULL) {
        add_surf_shift(&waves->surf, x, z, f, p);
    }
    const struct lom_footprint wide = hide_period(waves, f);
    for (int i = 0; i < waves->cascade_count; i++) {
        const struct lom_cascade_uniform *c = &waves->cascade[i];
        lom_float4 d =
            lom_sample(c->displacement, x * c->inverse_length + c->shift[0], z * c->inverse_length + c->shift[1],
                       lom_wave_lod(c->displacement, &wide, c->inverse_length));
        p->dx = p->dx + d.x;
        p->h = p->h + d.y;
        p->dz = p->dz + d.z;
    }
}

static void add_trochoid_slopes(const struct lom_trochoid_uniform *t, const struct trochoid *found,
                                struct lom_wave_slopes *w)
{
    float kxa = t->kx * t->amplitude, kza = t->kz * t->amplitude;
    lom_float lost = 0.5f * (1.0f - found->weight * found->weight);
    w->vxx = w->vxx + kxa * kxa * lost;
    w->vzz = w->vzz + kza * kza * lost;
    w->vxz = w->vxz + kxa * kza * lost;
    if (!found->is_seen)
        return;
    lom_float s = found->sine, c = found->cosine;
    w->sx = w->sx - kxa * s;
    w->sz = w->sz - kza * s;
    w->xx = w->xx - t->across_x * t->kx * c;
    w->zz = w->zz - t->across_z * t->kz * c;
    w->xz = w->xz - t->across_x * t->kz * c;
}

/* The derivatives of the displacement at the moments of the window before this time; of the first, which is this time, they are
 * the slopes'. */
struct moments {
    lom_float xx[LOM_FOAM_MOMENTS], zz[LOM_FOAM_MOMENTS], xz[LOM_FOAM_MOMENTS];
};

/* cos(angle + turn) = cos angle cos turn - sin angle sin turn, and the turns are the same everywhere: no cosine of its
 * own is found for a moment. The four roundings leave it within 2^-22 of the exact one. */
static void add_trochoid_moments(const struct lom_trochoid_uniform *t, const struct trochoid *found,
                                 struct moments *past)
{
    for (int m = 1; m < LOM_FOAM_MOMENTS && found->is_seen; m++) {
        lom_float c = found->cosine * t->turn[m][0] - found->sine * t->turn[m][1];
        past->xx[m] = past->xx[m] - t->across_x * t->kx * c;
        past->zz[m] = past->zz[m] - t->across_z * t->kz * c;
        past->xz[m] = past->xz[m] - t->across_x * t->kz * c;
    }
}

/* What broke at a rest point within the window before this time: the largest of its moments, each by how far the
 * Jacobian was below the threshold, fading with its age. A function of the time alone: any frame has its foam. */
static lom_float trochoid_foam(const struct lom_waves_uniform *waves, const struct lom_wave_slopes *now,
                               struct moments *past)
{
    lom_float foam = { 0 };
    past->xx[0] = now->xx;
    past->zz[0] = now->zz;
    past->xz[0] = now->xz;
    for (int m = 0; m < LOM_FOAM_MOMENTS; m++) {
        lom_float jacobian = (1.0f + past->xx[m]) * (1.0f + past->zz[m]) - past->xz[m] * past->xz[m];
        float fresh = 1.0f - (float)m / LOM_FOAM_MOMENTS;
        foam = lom_max(foam, lom_saturate((waves->foam_threshold - jacobian) * 4.0f) * fresh);
    }
    return foam;
}

static void add_cascade_slopes(const struct lom_cascade_uniform *c, lom_float x, lom_float z,
                               const struct lom_footprint *f, struct lom_wave_slopes *w)
{
    const lom_texture *const field[3] = { c->derivatives, c->moments, c->displacement };
    lom_float2 at = { x * c->inverse_length + c->shift[0], z * c->inverse_length + c->shift[1] };
    lom_float lod = lom_wave_lod(c->derivatives, f, c->inverse_length);
    lom_float4 value[3];
    LOM_WIDE(lom_sample_three_lanes)(field, &at, &lod, value);
    const lom_float4 d = value[0], m = value[1];
    w->sx = w->sx + d.x;
    w->sz = w->sz + d.y;
    w->xx = w->xx + d.z;
    w->zz = w->zz + d.w;
    w->xz = w->xz + value[2].w;
    w->vxx = w->vxx + lom_max(m.x - d.x * d.x, (lom_float){ 0 });
    w->vzz = w->vzz + lom_max(m.y - d.y * d.y, (lom_float){ 0 });
    w->vxz = w->vxz + (m.z - d.x * d.y);
    w->foam = w->foam + m.w;
}

static void add_shallow_slopes(const struct lom_shallow_uniform *u, lom_float x, lom_float z,
                               const struct lom_footprint *f, struct lom_wave_slopes *w)
{
    struct shallow_place at = shallow_place_of(u, x, z, f);
    lom_float zero = { 0 };
    lom_float4 d = lom_sample(u->surface, at.s, at.t, at.lod), m = lom_sample(u->moments, at.s, at.t, at.lod);
    w->sx = w->sx + lom_select(at.inside, d.y, zero);
    w->sz = w->sz + lom_select(at.inside, d.z, zero);
    w->vxx = w->vxx + lom_select(at.inside, lom_max(m.x - d.y * d.y, zero), zero);
    w->vzz = w->vzz + lom_select(at.inside, lom_max(m.y - d.z * d.z, zero), zero);
    w->vxz = w->vxz + lom_select(at.inside, m.z - d.y * d.z, zero);
    w->foam = w->foam + lom_select(at.inside, d.w, zero);
}

/* What the map's levels average away shortens its normals to l: (1 - l) / l is its variance (Toksvig 2005). */
static lom_float normal_length(lom_float3 n)
{
    return lom_clamp(lom_sqrt(lom_dot3(n, n)), lom_splat(0.1f), lom_splat(1.0f));
}

/* Two waves of independent phase: their variances add up as w0^2 + w1^2, which is divided out, so that the ripples
 * never pulse. */
static void add_river_slopes(const struct lom_river_uniform *river, lom_float x, lom_float z,
                             const struct lom_footprint *f, struct lom_wave_slopes *w)
{
    lom_float s = (x - river->corner[0]) * river->scale[0], t = (z - river->corner[1]) * river->scale[1];
    lom_float4 v = lom_sample(river->field, s, t, (lom_float){ 0 });
    lom_float lod = lom_wave_lod(river->ripples, f, river->inverse_tile);
    lom_float sx = { 0 }, sz = { 0 }, lost = { 0 };
    for (int i = 0; i < 2; i++) {
        lom_float u = (x - v.x * river->drift[i]) * river->inverse_tile + river->jump[i][0];
        lom_float r = (z - v.y * river->drift[i]) * river->inverse_tile + river->jump[i][1];
        lom_float4 texel = lom_sample(river->ripples, u, r, lod);
        lom_float3 n = { texel.x * 2.0f - 1.0f, texel.z * 2.0f - 1.0f, texel.y * 2.0f - 1.0f };
        lom_float length = normal_length(n);
        lom_float scale = river->weight[i] * river->steepness / lom_max(n.y, lom_splat(0.1f));
        sx = sx - n.x * scale;
        sz = sz - n.z * scale;
        lost = lost + river->weight[i] * river->weight[i] * (1.0f - length) / length;
    }
    lom_float hidden = 0.5f * river->steepness * river->steepness * lost;
    w->sx = w->sx + sx;
    w->sz = w->sz + sz;
    w->vxx = w->vxx + hidden;
    w->vzz = w->vzz + hidden;
    if (!river->carries_foam)
        return;
    w->foam = w->foam + v.z;
    w->drift_x = v.x * river->foam_drift[0] + river->foam_jump[0][0];
    w->drift_z = v.y * river->foam_drift[0] + river->foam_jump[0][1];
    w->again = lom_splat(river->foam_share);
    w->again_x = v.x * river->foam_drift[1] + river->foam_jump[1][0];
    w->again_z = v.y * river->foam_drift[1] + river->foam_jump[1][1];
}

/* The normal that the planar lake has (water/lake.wide.c): (2 r - 1, b / steepness, 2 g - 1), looked up where the flow map
 * has moved it. */
static void add_ripple_slopes(const struct lom_ripple_uniform *ripples, lom_float x, lom_float z,
                              const struct lom_footprint *f, struct lom_wave_slopes *w)
{
    lom_float u = x * ripples->inverse_tile + ripples->shift[0], v = z * ripples->inverse_tile + ripples->shift[1];
    if (ripples->flow != NULL) {
        lom_float lod = lom_wave_lod(ripples->flow, f, ripples->inverse_tile);
        lom_float4 drift = lom_sample(ripples->flow, u + ripples->move, v, lod);
        u = u + drift.x * 0.1f;
        v = v + (drift.y * 0.1f + ripples->move);
    }
    lom_float4 texel = lom_sample(ripples->normals, u, v, lom_wave_lod(ripples->normals, f, ripples->inverse_tile));
    lom_float3 n = { texel.x * 2.0f - 1.0f, texel.z * 2.0f - 1.0f, texel.y * 2.0f - 1.0f };
    lom_float scale = ripples->steepness / lom_max(texel.z, lom_splat(0.1f)), length = normal_length(n);
    lom_float hidden = 0.5f * scale * scale * (1.0f - length) / length;
    w->sx = w->sx - n.x * scale;
    w->sz = w->sz - n.z * scale;
    w->vxx = w->vxx + hidden;
    w->vzz = w->vzz + hidden;
}

/* What all others add to the slopes of the trochoids. */
static void add_other_slopes(const struct lom_waves_uniform *waves, lom_float x, lom_float z,
                             const struct lom_footprint *f, struct lom_wave_slopes *w)
{
    if (waves->surf.waves != NULL)
        add_surf_slopes(waves, x, z, f, w);
    const struct lom_footprint wide = hide_period(waves, f);
    for (int i = 0; i < waves->cascade_count; i++)
        add_cascade_slopes(&waves->cascade[i], x, z, &wide, w);
    if (waves->shallow.surface != NULL)
        add_shallow_slopes(&waves->shallow, x, z, f, w);
    if (waves->river.field != NULL)
        add_river_slopes(&waves->river, x, z, f, w);
    if (waves->ripples.normals != NULL)
        add_ripple_slopes(&waves->ripples, x, z, f, w);
    if (waves->wakes.count > 0)
        add_wakes(&waves->wakes, x, z, f, w);
}

/* Both, the one, or the other: what is NULL is not asked for. */
LOM_INLINE void find(const struct lom_waves_uniform *waves, lom_float x, lom_float z, const struct lom_footprint *f,
                     struct lom_wave_shift *shift, struct lom_wave_slopes *slopes)
{
    const struct lom_footprint wide = hide_period(waves, f);
    struct lom_wave_shift p = { { 0 }, { 0 }, { 0 } };
    struct lom_wave_slopes w;
    struct moments past;
    const bool breaks = slopes != NULL && waves->foam_threshold > 0;
    memset(&w, 0, sizeof w);
    memset(&past, 0, sizeof past);
    for (int i = 0; i < waves->trochoid_count; i++) {
        const struct lom_trochoid_uniform *t = &waves->trochoid[i];
        struct trochoid found = find_trochoid(t, x, z, &wide);
        if (shift != NULL)
            add_trochoid_shift(t, &found, &p);
        if (slopes != NULL)
            add_trochoid_slopes(t, &found, &w);
        if (breaks)
            add_trochoid_moments(t, &found, &past);
    }
    if (breaks)
        w.foam = trochoid_foam(waves, &w, &past);
    if (shift != NULL) {
        add_other_shifts(waves, x, z, f, &p);
        *shift = p;
    }
    if (slopes != NULL) {
        add_other_slopes(waves, x, z, f, &w);
        *slopes = w;
    }
}

void LOM_WIDE(lom_displace_lanes)(const struct lom_waves_uniform *waves, const lom_float *x, const lom_float *z,
                                  const struct lom_footprint *f, struct lom_wave_shift *shift)
{
    find(waves, *x, *z, f, shift, NULL);
}

void LOM_WIDE(lom_find_slopes_lanes)(const struct lom_waves_uniform *waves, const lom_float *x, const lom_float *z,
                                     const struct lom_footprint *f, struct lom_wave_slopes *slopes)
{
    find(waves, *x, *z, f, NULL, slopes);
}

void LOM_WIDE(lom_find_waves_lanes)(const struct lom_waves_uniform *waves, const lom_float *x, const lom_float *z,
                                    const struct lom_footprint *f, struct lom_wave_shift *shift,
                                    struct lom_wave_slopes *slopes)
{
    find(waves, *x, *z, f, shift, slopes);
}
