/* Sprites of drops. In: where drops are, how they look, how the frame looks at them. Out: a sprite for each that is
 * seen. Invariant: a sprite is a function of its drop and of the whole frame's view, never of a crop.
 *
 * A drop is a disc of this radius that faces the eye, drawn out along its way on the screen by what it flies in
 * `stretch` seconds: what it covers is spread over that area, so the share that it takes of a pixel falls with it. A
 * sprite is at least a pixel to each side of its middle, and thinner ones lose opacity instead of size: they neither
 * sparkle nor vanish between the pixels' centres. */
#include "base/numbers.h"
#include "spray/spray.h"

/* Drops in front of the sun throw most of its light forward: the phase function of Henyey and Greenstein (1941) with
 * this mean cosine. Light that is scattered more than once leaves dense spray on all sides: about half of what a white
 * wall that faces the sun sends back. */
static const double mean_cosine = 0.75, scattered_often = 0.55;
static const double least_opacity = 1.0 / 4096;

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* An isotropic scatterer sends a quarter of what a white wall does: pi E / (4 pi) against E. */
static double sun_share(double forward, double cosine)
{
    const double g = mean_cosine, base = 1 + g * g - 2 * g * cosine;
    return scattered_often + forward * (1 - g * g) / (4 * base * lom_double_sqrt(base));
}

/* Unit vectors along the drop's way as the eye sees it and across; returns the speed along the first. away: a unit
 * vector from the eye. Where it flies straight at the eye, along is up on the screen. */
static double find_axes(const struct lom_spray_view *view, const double away[3], const double velocity[3],
                        double along[3], double across[3])
{
    double ahead = dot(velocity, away);
    for (int i = 0; i < 3; i++)
        along[i] = velocity[i] - ahead * away[i];
    double speed = lom_double_sqrt(dot(along, along));
    if (!(speed > 1e-6)) {
        ahead = dot(view->view.m[1], away);
        for (int i = 0; i < 3; i++)
            along[i] = view->view.m[1][i] - ahead * away[i];
    }
    double length = lom_larger(lom_double_sqrt(dot(along, along)), 1e-30);
    for (int i = 0; i < 3; i++)
        along[i] /= length;
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        across[i] = along[j] * away[k] - along[k] * away[j];
    }
    return speed > 1e-6 ? speed : 0;
}

struct place {
    double offset[3]; /* from the eye */
    double x, y, w;   /* along the view's axes; w is ahead */
};

static struct place place_of(const struct lom_spray_view *view, const double at[3])
{
    struct place p = { .offset = { at[0] - view->eye.x, at[1] - view->eye.y, at[2] - view->eye.z } };
    p.x = dot(view->view.m[0], p.offset);
    p.y = dot(view->view.m[1], p.offset);
    p.w = -dot(view->view.m[2], p.offset);
    return p;
}

/* x or y of parallel rays in the picture. */
static double clip_of(const struct lom_spray_view *view, const struct place *p, int axis)
{
    return view->projection.m[axis][axis] * (axis == 0 ? p->x : p->y) - view->projection.m[axis][2] * p->w;
}

/* Whether a ball about the place lies outside the view, or its middle before the near plane, where nothing is drawn. */
static bool is_outside(const struct lom_spray_view *view, const struct place *p, double reach)
{
    double a = view->projection.m[0][0], b = view->projection.m[1][1];
    if (view->rays.parallel)
        return p->w <= view->near_plane || lom_magnitude(clip_of(view, p, 0)) - 1 > reach * a ||
               lom_magnitude(clip_of(view, p, 1)) - 1 > reach * b;
    double x = p->x < 0 ? -p->x : p->x, y = p->y < 0 ? -p->y : p->y;
    return p->w <= view->near_plane || x * a - p->w > reach * lom_double_sqrt(a * a + 1) ||
           y * b - p->w > reach * lom_double_sqrt(b * b + 1);
}

/* The part of the screen that a ball about the place reaches; anything, where that reaches the near plane. */
static struct lom_sprite_reach reach_of(const struct lom_spray_view *view, const struct place *p, double reach)
{
    const double middle[2] = { p->x, p->y };
    double nearest = p->w - reach, farthest = p->w + reach;
    struct lom_sprite_reach r = { .seen = 1, .low = { -1, -1 }, .high = { 1, 1 } };
    for (int i = 0; i < 2 && nearest > view->near_plane; i++) {
        double scale = view->projection.m[i][i];
        if (view->rays.parallel) {
            r.low[i] = clip_of(view, p, i) - reach * scale;
            r.high[i] = clip_of(view, p, i) + reach * scale;
            continue;
        }
        double a = (middle[i] - reach) * scale, b = (middle[i] + reach) * scale;
        r.low[i] = a < 0 ? a / nearest : a / farthest;
        r.high[i] = b > 0 ? b / nearest : b / farthest;
    }
    return r;
}

struct lom_sprite_reach lom_join_reaches(struct lom_sprite_reach a, struct lom_sprite_reach b)
{
    a.seen += b.seen;
    for (int i = 0; i < 2; i++) {
        a.low[i] = b.low[i] < a.low[i] ? b.low[i] : a.low[i];
        a.high[i] = b.high[i] > a.high[i] ? b.high[i] : a.high[i];
    }
    return a;
}

/* The direction of the ray to a place, of unit length. */
static void find_away(const struct lom_spray_view *view, const struct place *p, double away[3])
{
    const lom_vec3 along = view->rays.along;
    const double all[3] = { along.x, along.y, along.z }, *ray = view->rays.parallel ? all : p->offset;
    const double length = lom_larger(lom_double_sqrt(dot(ray, ray)), 1e-6);
    for (int i = 0; i < 3; i++)
        away[i] = ray[i] / length;
}

static const struct lom_sprite_reach none = { .seen = 0, .low = { 1, 1 }, .high = { -1, -1 } };

static struct lom_sprite_reach make_sprite(const lom_spray *spray, const struct lom_spray_view *view,
                                           const lom_particle *particle, struct lom_sprite *s, float *depth)
{
    const struct place p = place_of(view, particle->place);
    double radius = spray->size[0] + (spray->size[1] - spray->size[0]) * particle->share;
    double away[3], along[3], across[3];
    find_away(view, &p, away);
    double length = radius + find_axes(view, away, particle->velocity, along, across) * spray->stretch / 2;
    double away_by = view->rays.parallel ? 1 : lom_larger(p.w, view->near_plane);
    double pixel = 2 * away_by / (view->projection.m[1][1] * view->height);
    double wide = lom_larger(radius, pixel), high = lom_larger(length, pixel);
    double opacity = spray->opacity * particle->alpha * (radius / wide) * (radius / high);
    double reach = wide + high;
    if (opacity < least_opacity || is_outside(view, &p, reach))
        return none;
    *depth = (float)p.w;
    for (int i = 0; i < 3; i++) {
        s->middle[i] = (float)p.offset[i];
        s->along[i] = (float)(along[i] * high);
        s->across[i] = (float)(across[i] * wide);
        s->color[i] = (float)spray->color[i];
    }
    s->opacity = (float)opacity;
    s->soft = (float)spray->soft;
    s->sun = (float)sun_share(spray->forward, dot(away, view->to_light));
    return reach_of(view, &p, reach);
}

struct lom_sprite_reach lom_make_sprites(const lom_spray *spray, const struct lom_spray_view *view,
                                         const lom_particle *particles, size_t count, struct lom_sprite *sprites,
                                         float *depth)
{
    struct lom_sprite_reach reach = none;
    for (size_t i = 0; i < count; i++) {
        depth[i] = 0;
        if (particles[i].alpha > 0)
            reach = lom_join_reaches(reach, make_sprite(spray, view, &particles[i], &sprites[i], &depth[i]));
    }
    return reach;
}
