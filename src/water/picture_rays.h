/* Rays from a surface of water through pictures of the scene with their depth, over lanes. In: a point, where its ray goes.
 * Out: what of a picture it meets, or what stands for that, as sharp as the surface is smooth. */
#ifndef LOM_WATER_PICTURE_RAYS_H
#define LOM_WATER_PICTURE_RAYS_H

#include "shading/depth_square.h"
#include "water/foam_cover.h"
#include "water/water_column.h"

/* Farther than all of a scene, and nearer than where a picture shows nothing (lom_depth_reach, near planes from 1e-12). */
static const float unseen = 0x1p50f;

/* What a rough surface blurs of a picture, in pixels: how wide, as far as the levels of a picture go, and how far apart
 * are the LOM_BLUR_PLACES, one above the other, whose mean is taken. */
struct lom_blur {
    lom_float width, apart;
    lom_mask alone; /* texels that are not hidden, unfiltered, `spread` pixels from the highest to the lowest */
    lom_float spread;
};

/* Facets whose slopes vary by s turn what they mirror by 2 s up and down, and less sideways where the eye looks along
 * the surface: a blur that is wider than the levels go is drawn out upright. Of parallel rays it is as much of the
 * mirrored ray's length. */
LOM_INLINE struct lom_blur lom_blur_of(const struct lom_surface_uniforms *u, lom_float variance, lom_float length)
{
    const float widest = (float)(1 << LOM_BLUR_LEVELS);
    float pixels = 1.0f / (u->eye.pixel * u->eye.pixel);
    if (u->eye.parallel)
        variance = variance * lom_min(length * length, lom_splat(endless));
    lom_float spread = lom_sqrt(lom_max(variance * pixels, lom_splat(1.0f)));
    lom_float width = lom_min(spread, lom_splat(widest));
    lom_float apart = lom_min((spread - width) / (float)LOM_BLUR_PLACES, lom_splat(2.0f * widest));
    return (struct lom_blur){ width, apart, { 0 }, { 0 } };
}

struct lom_lookup {
    lom_float s, t, w; /* w: the reach */
};

LOM_INLINE struct lom_lookup lom_project_point(const struct lom_surface_uniforms *u,
                                               const struct lom_picture_uniform *picture, lom_float3 p)
{
    lom_float4 c = lom_transform4(&picture->clip_from_offset, p);
    lom_float w = lom_max(c.w, lom_splat(1e-25f)), half = lom_splat(0.5f) / w;
    lom_float reach = u->eye.parallel ? u->eye.far_reach - c.z * u->eye.depth_reach : c.w;
    return (struct lom_lookup){ 0.5f + c.x * half, 0.5f - c.y * half, reach };
}

/* The reach of what a picture shows at (s, t); huge where there is nothing. */
LOM_INLINE lom_float lom_picture_w(const struct lom_surface_uniforms *u, const struct lom_picture_uniform *picture,
                                   lom_float s, lom_float t)
{
    return lom_depth_reach(&u->eye, lom_find_depth(picture->depth, s, t));
}

LOM_INLINE lom_mask lom_within_reach(const struct lom_surface_uniforms *u, lom_float2 own, struct lom_lookup at)
{
    lom_mask near = (lom_abs(at.s - own.x) < u->reach) & (lom_abs(at.t - own.y) < u->reach);
    return near & (at.s > 0.0f) & (at.s < 1.0f) & (at.t > 0.0f) & (at.t < 1.0f) & (at.w > 0.0f);
}

LOM_INLINE lom_float lom_largest_part(lom_float3 v)
{
    return lom_max(lom_max(lom_abs(v.x), lom_abs(v.y)), lom_abs(v.z));
}

struct lom_hit {
    lom_mask found;
    lom_float length; /* of the ray */
    lom_float s, t;
};

/* What reaches farther in a picture is not before the surface; some 20 pixels are allowed to waves. */
LOM_INLINE lom_float lom_before_surface(const struct lom_surface_uniforms *u, const struct lom_surface_point *p)
{
    return u->eye.parallel ? p->w - 20.0f * u->eye.pixel : p->w * 0.98f;
}

/* Records name every texel that the definition looks at. */
#ifdef LOM_RECORD
enum { LOM_LOOKS_AROUND = false };
#else
enum { LOM_LOOKS_AROUND = true };
#endif

/* The longest way through a picture of which blocks are asked, in places that are asked. */
enum { LOM_MOST_PLACES = 16 };

/* Whether a picture shows nothing along all rays of the lanes, by its blocks: then following them finds nothing. A ray that
 * stays before the eye is a straight way in the picture, to where it leaves it. Places on it are asked 3/2 of a block apart, so
 * that no texel of it is more than 3/4 of one beside a place, and a place knows of all that is less than one away. What floats round
 * is less: 8 roundings of sums of at most the largest row times the largest coordinate move a place by at most 2^-12 of the
 * picture, which has at most 2^8 blocks a side, where w is 2^-9 of that or more. */
LOM_INLINE bool lom_shows_nothing_along(const struct lom_surface_uniforms *u, const struct lom_picture_uniform *picture,
                                        const struct lom_surface_point *p, lom_float3 d, lom_float range)
{
    if (!LOM_LOOKS_AROUND || picture->near.around == NULL || u->eye.parallel || picture->near.columns > 256 ||
        picture->near.rows > 256)
        return false;
    const lom_float3 end = lom_add3(p->offset, lom_scale3(d, range));
    const struct lom_lookup a = lom_project_point(u, picture, p->offset), b = lom_project_point(u, picture, end);
    const lom_float large = lom_max(lom_max(lom_largest_part(p->offset), lom_largest_part(end)), lom_splat(1.0f));
    const lom_float x = b.s - a.s, y = b.t - a.t, nearer = lom_min(a.w, b.w);
    const lom_mask inside = (a.s >= 0.0f) & (a.s <= 1.0f) & (a.t >= 0.0f) & (a.t <= 1.0f);
    const lom_mask straight = (large * picture->rows_sum <= nearer * 512.0f) & (lom_max(a.w, b.w) < unseen);
    if (!lom_all(inside & straight & (lom_abs(x) < 64.0f) & (lom_abs(y) < 64.0f)))
        return false;
    const lom_float leaves_s = lom_select(x < 0.0f, -a.s, 1.0f - a.s) / lom_select(x == 0.0f, lom_splat(1.0f), x);
    const lom_float leaves_t = lom_select(y < 0.0f, -a.t, 1.0f - a.t) / lom_select(y == 0.0f, lom_splat(1.0f), y);
    const lom_float part = lom_min(lom_min(leaves_s, leaves_t), lom_splat(1.0f));
    const lom_float blocks = lom_max(lom_abs(x) * (float)picture->near.columns, lom_abs(y) * (float)picture->near.rows);
    int places = 1;
    while (places <= LOM_MOST_PLACES && !lom_all(blocks * part <= 1.5f * (float)places))
        places++;
    if (places > LOM_MOST_PLACES)
        return false;
    for (int i = 0; i < places; i++) {
        const lom_float at = part * (((float)i + 0.5f) / (float)places);
        if (!lom_all(lom_nearest_around(&picture->near, a.s + x * at, a.t + y * at) <= lom_only_color))
            return false;
    }
    return true;
}

/* How far along a ray its step i is. */
LOM_INLINE lom_float lom_length_of_step(const struct lom_surface_uniforms *u, lom_float range, int i)
{
    const float share = (float)i / (float)u->steps;
    return range * (share * share * share);
}

/* Whether a ray that was behind the picture at step i, at `at`, meets nothing later on in the lanes of `going`, by how far the
 * farthest is that the picture shows from there down: a ray that ends lower stays below there. It is behind at every step j by
 * at least w_j - f, f the farthest, and meets nothing while that is 3/2 steps or more. With s metres of ray a metre of w a step
 * reaches (l_j - l_i) / s farther in w, and l_j is as j^3, so that l_j / s gains on 3/2 (l_j - l_j-1) with j from where 3 j (j + 1)
 * + 1 is 9 j s: from j = i + 1 on where i + 2 is 3 s. The next step decides, then. What floats round is as in lom_shows_nothing_along:
 * the places less than a row of blocks, reaches less than 2^-10 of the largest. */
LOM_INLINE bool lom_meets_no_more(const struct lom_surface_uniforms *u, const struct lom_picture_uniform *picture,
                                  const struct lom_surface_point *p, lom_float3 d, lom_float range, int i,
                                  struct lom_lookup at, lom_mask going)
{
    const lom_float3 last = lom_add3(p->offset, lom_scale3(d, range));
    const struct lom_lookup end = lom_project_point(u, picture, last);
    const lom_float length = lom_length_of_step(u, range, i), step = lom_length_of_step(u, range, i + 1) - length;
    const lom_float deeper = (end.w - at.w) / (range - length); /* of w, a metre */
    const lom_float farthest = lom_depth_reach(&u->eye, lom_farthest_below(&picture->far, at.t));
    const lom_float large = lom_max(lom_largest_part(p->offset), lom_largest_part(last));
    const lom_mask straight = (large * picture->rows_sum <= at.w * 512.0f) & (end.t >= at.t);
    const lom_mask gains = deeper * (float)(i + 2) >= 3.01f;
    const lom_float behind = at.w + step * deeper - farthest;
    return lom_all(~going | (straight & gains & (behind >= 1.5f * step + end.w * 0x1p-10f)));
}

/* Follows the ray from p along d through the picture: `steps` points whose distances grow as the cube of their number,
 * then halving of the step in which the ray went behind what the picture shows. Behind what stands further before the
 * ray than a step it goes on; its length is then where it first did. What is mirrored and stands before the surface and before
 * all of the step, too, is in nobody's way. Where the picture of what is under water shows nothing, ground that rises out of
 * the water hides its own bed: a ray that comes out behind what stands before it had its length at the rim. A ray that
 * leaves the picture, or its reach, finds nothing. */
LOM_INLINE struct lom_hit lom_follow_ray(const struct lom_surface_uniforms *u,
                                         const struct lom_picture_uniform *picture, const struct lom_surface_point *p,
                                         lom_float3 d, lom_float range)
{
    lom_float2 own = lom_own_place(picture, p);
    struct lom_hit hit = { { 0 }, lom_splat(endless), own.x, own.y };
    if (lom_shows_nothing_along(u, picture, p, d, range))
        return hit;
    lom_mask going = range > 0.0f, hidden = { 0 };
    lom_float before = { 0 }, last = { 0 }, reached = p->w, rim = lom_splat(endless);
    const lom_float bound = lom_before_surface(u, p);
    for (int i = 1; i <= u->steps && lom_any(going); i++) {
        lom_float length = lom_length_of_step(u, range, i);
        struct lom_lookup at = lom_project_point(u, picture, lom_add3(p->offset, lom_scale3(d, length)));
        going = going & lom_within_reach(u, own, at);
        if (!lom_any(going))
            break;
        lom_float shown = lom_picture_w(u, picture, at.s, at.t), over = at.w - shown;
        lom_mask behind = going & (over > 0.0f);
        if (picture == &u->mirrored)
            behind = behind & ((shown > bound) | (shown > lom_min(reached, at.w) - 0.25f * (length - last)));
        lom_mask met = behind & (over < 1.5f * (length - last));
        lom_float first =
            lom_select(behind & (hit.length == endless), lom_select(hidden, lom_min(rim, length), length), hit.length);
        hit.length = lom_select(met, length, first);
        before = lom_select(met, last, before);
        hit.found = hit.found | met;
        going = going & ~met;
        hidden = shown > unseen;
        rim = lom_select(hidden, rim, length);
        last = length;
        reached = at.w;
        const bool knows = LOM_LOOKS_AROUND && picture->far.below != NULL && !u->eye.parallel && i < u->steps;
        if (knows && !lom_any(going & (hit.length == endless)) &&
            lom_meets_no_more(u, picture, p, d, range, i, at, going))
            break;
    }
    if (!lom_any(hit.found))
        return hit;
    lom_float low = before, high = hit.length;
    for (int i = 0; i < 6; i++) {
        lom_float middle = 0.5f * (low + high);
        struct lom_lookup at = lom_project_point(u, picture, lom_add3(p->offset, lom_scale3(d, middle)));
        lom_mask behind = at.w > lom_picture_w(u, picture, at.s, at.t);
        high = lom_select(behind, middle, high);
        low = lom_select(behind, low, middle);
    }
    struct lom_lookup at = lom_project_point(u, picture, lom_add3(p->offset, lom_scale3(d, high)));
    hit.length = lom_select(hit.found, high, hit.length);
    hit.s = lom_clamp(at.s, hit.s - u->reach, hit.s + u->reach);
    hit.t = lom_clamp(at.t, hit.t - u->reach, hit.t + u->reach);
    return hit;
}

/* Whether anything nearer than the surface stands at (s, t +- y) or (s +- x, t +- y) of a picture. */
LOM_INLINE lom_mask lom_is_hidden(const struct lom_surface_uniforms *u, const struct lom_picture_uniform *picture,
                                  const struct lom_surface_point *p, struct lom_hit at, lom_float x, lom_float y)
{
    lom_float bound = lom_before_surface(u, p);
    lom_mask hidden = { 0 };
    for (int i = 0; i < 6; i++) {
        lom_float across = at.s + x * (float)(i % 3 - 1), down = i < 3 ? at.t - y : at.t + y;
        hidden = hidden | ~(lom_picture_w(u, picture, across, down) > bound);
    }
    return hidden;
}

/* What blocks of a picture (near_blocks.h) tell of all that a blur reaches from the lanes' places: that nothing is nearer than
 * the surface; and that nothing is there at all. A blur reaches 12 pixels from where it begins and is drawn out by 24 more; levels of
 * the picture, of which the coarsest has texels of 8 pixels, by 14 more, of pictures that are no larger than the frame. */
struct lom_surroundings {
    bool open, empty;
};

LOM_INLINE struct lom_surroundings lom_surroundings_of(const struct lom_surface_uniforms *u,
                                                       const struct lom_picture_uniform *picture,
                                                       const struct lom_surface_point *p, struct lom_hit hit)
{
    if (!LOM_LOOKS_AROUND || picture->near.around == NULL)
        return (struct lom_surroundings){ false, false };
    lom_float nearest = lom_nearest_around(&picture->near, hit.s, hit.t);
    bool open = lom_all(lom_depth_reach(&u->eye, nearest) > lom_before_surface(u, p));
    return (struct lom_surroundings){ open, open && lom_all(nearest == 0.0f) };
}

/* The blur at a place in a picture. It does not reach beyond the place that a level surface mirrors, on whose other
 * side may be the shore's edge, which no facet shows; and there is as little of it as keeps out what is nearer than the
 * surface, which would bleed into what is mirrored beyond. */
LOM_INLINE struct lom_blur lom_clear_blur(const struct lom_surface_uniforms *u,
                                          const struct lom_picture_uniform *picture, const struct lom_surface_point *p,
                                          struct lom_hit hit, struct lom_blur blur, bool open)
{
    if (!lom_any(blur.width > 1.0f))
        return blur;
    lom_float moved = lom_abs(hit.t - lom_own_place(picture, p).y) / u->pixel[1];
    blur.apart = lom_clamp((moved - blur.width) * (2.0f / (float)LOM_BLUR_PLACES), (lom_float){ 0 }, blur.apart);
    if (open)
        return blur;
    lom_float x = blur.width * (1.5f * u->pixel[0]), y = blur.width * (1.5f * u->pixel[1]);
    lom_mask hidden = lom_is_hidden(u, picture, p, hit, x, y);
    blur.alone = hidden & (blur.width > 1.0f);
    blur.spread = blur.width;
    blur.width = lom_select(hidden, lom_splat(1.0f), blur.width);
    for (int i = 1; i < LOM_BLUR_PLACES && lom_any(blur.apart > 0.0f); i++)
        hidden = hidden | lom_is_hidden(u, picture, p, hit, x, y + blur.apart * (0.5f * (float)i * u->pixel[1]));
    blur.apart = lom_select(hidden, (lom_float){ 0 }, blur.apart);
    return blur;
}

/* The mean of texels one above the other about a place, of those that show nothing nearer than the surface; where all do,
 * of all. What the levels of the picture have blurred cannot be told apart. */
LOM_INLINE lom_float4 lom_open_texels(const struct lom_surface_uniforms *u, const struct lom_picture_uniform *picture,
                                      const struct lom_surface_point *p, struct lom_hit hit, lom_float spread)
{
    const float columns = (float)lom_texture_width(picture->color), rows = (float)lom_texture_height(picture->color);
    lom_float bound = lom_before_surface(u, p), weights = { 0 };
    lom_float4 sum = { { 0 }, { 0 }, { 0 }, { 0 } };
    for (int i = 0; i < LOM_OPEN_TEXELS; i++) {
        const float part = ((float)i + 0.5f) / (float)LOM_OPEN_TEXELS - 0.5f;
        lom_float s = (lom_floor(hit.s * columns) + 0.5f) / columns;
        lom_float t = (lom_floor((hit.t + spread * (part * u->pixel[1])) * rows) + 0.5f) / rows;
        lom_mask open = lom_picture_w(u, picture, s, t) > bound;
        lom_float weight = lom_select(open, lom_splat(1.0f), lom_splat(1e-3f));
        lom_float4 texel = lom_sample(picture->color, s, t, (lom_float){ 0 });
        sum = (lom_float4){ sum.x + texel.x * weight, sum.y + texel.y * weight, sum.z + texel.z * weight,
                            sum.w + texel.w * weight };
        weights = weights + weight;
    }
    return (lom_float4){ sum.x / weights, sum.y / weights, sum.z / weights, sum.w / weights };
}

/* The lookup of lanes that are not alone. */
LOM_INLINE lom_float4 lom_blurred(const struct lom_surface_uniforms *u, const struct lom_picture_uniform *picture,
                                  struct lom_hit hit, struct lom_blur blur)
{
    lom_float lod = lom_log2(blur.width);
    if (!lom_any(blur.apart > 0.0f))
        return lom_sample(picture->color, hit.s, hit.t, lod);
    lom_float4 sum = { { 0 }, { 0 }, { 0 }, { 0 } }, first = sum;
    const float part = 1.0f / (float)LOM_BLUR_PLACES;
    for (int i = 0; i < LOM_BLUR_PLACES; i++) {
        lom_float at = blur.apart * (((float)i - 0.5f * (float)(LOM_BLUR_PLACES - 1)) * u->pixel[1]);
        lom_float4 texel = lom_sample(picture->color, hit.s, hit.t + at, lod);
        first = i == 0 ? texel : first;
        sum = (lom_float4){ sum.x + texel.x * part, sum.y + texel.y * part, sum.z + texel.z * part,
                            sum.w + texel.w * part };
    }
    const lom_mask apart = blur.apart > 0.0f; /* four quarters of a denormal are not the whole */
    return (lom_float4){ lom_select(apart, sum.x, first.x), lom_select(apart, sum.y, first.y),
                         lom_select(apart, sum.z, first.z), lom_select(apart, sum.w, first.w) };
}

/* What lies beyond the edge of a picture is not known. Under water, where the bed or the shore's rim is everywhere,
 * what is as far within stands for it; above, what is at the edge, mostly sky: no boat is seen twice. */
LOM_INLINE lom_float lom_onto_picture(const struct lom_surface_uniforms *u, lom_float s)
{
    return u->side < 0 ? 1.0f - lom_abs(1.0f - lom_abs(s)) : s;
}

/* Where what is mirrored would be nearer than the surface, the nearest texel beside it, within four, that is not, since what
 * hides is mostly thin and upright. Where there is none, the first quarter of the way back to the surface's own pixel that is
 * open, and of what lies below that pixel. */
LOM_INLINE void lom_step_aside(const struct lom_surface_uniforms *u, const struct lom_picture_uniform *picture,
                               const struct lom_surface_point *p, struct lom_hit *hit)
{
    static const float aside[] = { -1, 1, -2, 2, -3, 3, -4, 4 };
    const float texel = 1.0f / (float)lom_texture_width(picture->color);
    const lom_float2 own = lom_own_place(picture, p);
    const lom_float bound = lom_before_surface(u, p), s = hit->s;
    lom_mask hidden = ~(lom_picture_w(u, picture, s, hit->t) > bound);
    for (size_t i = 0; i < sizeof aside / sizeof aside[0] && picture == &u->mirrored && lom_any(hidden); i++) {
        lom_float at = s + aside[i] * texel;
        lom_mask open = hidden & (lom_picture_w(u, picture, at, hit->t) > bound);
        hit->s = lom_select(open, at, hit->s);
        hidden = hidden & ~open;
    }
    const lom_float2 way = { s - own.x, hit->t - own.y };
    for (int quarter = picture == &u->mirrored ? 3 : 0; quarter >= 0 && lom_any(hidden); quarter--) {
        float share = 0.25f * (float)quarter;
        hit->s = lom_select(hidden, own.x + share * way.x, hit->s);
        hit->t = lom_select(hidden, own.y + share * way.y, hit->t);
        hidden = hidden & ~(lom_picture_w(u, picture, hit->s, hit->t) > bound);
    }
}

/* One lookup instead, and for what leaves the picture: what the unbent ray meets is taken to be as far along the bent
 * one, at most `longest`. Where something nearer than the surface stands there, what is beside it answers. */
LOM_INLINE struct lom_hit lom_displaced_lookup(const struct lom_surface_uniforms *u,
                                               const struct lom_picture_uniform *picture,
                                               const struct lom_surface_point *p, lom_float3 d, lom_float longest)
{
    lom_float2 own = lom_own_place(picture, p);
    lom_float further = lom_picture_w(u, picture, own.x, own.y) / p->w - 1.0f;
    lom_float length = lom_clamp(further, (lom_float){ 0 }, lom_splat(100.0f)) * p->distance;
    length = lom_min(length, longest);
    struct lom_lookup at = lom_project_point(u, picture, lom_add3(p->offset, lom_scale3(d, length)));
    struct lom_hit hit = { at.w > 0.0f, length,
                           lom_onto_picture(u, lom_clamp(at.s, own.x - u->reach, own.x + u->reach)),
                           lom_onto_picture(u, lom_clamp(at.t, own.y - u->reach, own.y + u->reach)) };
    lom_step_aside(u, picture, p, &hit);
    return hit;
}

/* What a picture shows at a place, blurred; of what is above the water, whose facets mirror it or let it through. */
LOM_INLINE lom_float4 lom_texel_of_hit(const struct lom_surface_uniforms *u, const struct lom_picture_uniform *picture,
                                       const struct lom_surface_point *p, struct lom_hit hit, bool above,
                                       lom_float variance)
{
    struct lom_blur blur = { lom_splat(1.0f), { 0 }, { 0 }, { 0 } };
    if (above) {
        const struct lom_surroundings around = lom_surroundings_of(u, picture, p, hit);
        if (around.empty)
            return (lom_float4){ { 0 }, { 0 }, { 0 }, { 0 } };
        blur = lom_clear_blur(u, picture, p, hit, lom_blur_of(u, variance, hit.length), around.open);
    }
    lom_float4 texel = lom_blurred(u, picture, hit, blur);
    if (!lom_any(blur.alone))
        return texel;
    lom_float4 open = lom_open_texels(u, picture, p, hit, blur.spread);
    return (lom_float4){ lom_select(blur.alone, open.x, texel.x), lom_select(blur.alone, open.y, texel.y),
                         lom_select(blur.alone, open.z, texel.z), lom_select(blur.alone, open.w, texel.w) };
}

#endif
