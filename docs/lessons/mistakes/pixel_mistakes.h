/* Stages with one rule broken each, from coverage to output. In and out: as the right stage's. They differ from it in what
 * the name says, and in nothing else; the table in gallery.c says which rule that is. */
#ifndef LOM_LESSONS_PIXEL_MISTAKES_H
#define LOM_LESSONS_PIXEL_MISTAKES_H

#include "stages.h"

/* ---- covers ---- */

/* Twice the area times the weight of vertex i at a place in units. */
static int64_t edge_at(const struct triangle *t, int i, int64_t x, int64_t y)
{
    const struct vertex *on = &t->v[(i + 1) % 3];
    return t->right[i] * (x - on->x) + t->down[i] * (y - on->y);
}

static bool is_top_or_left(const struct triangle *t, int i)
{
    return t->right[i] > 0 || (t->right[i] == 0 && t->down[i] > 0);
}

static bool is_before_clip_plane(const struct triangle *t, const struct fragment *f)
{
    return !t->crosses || dot(f->l, t->distance) > 0 || (t->keeps_zero && dot(f->l, t->distance) == 0);
}

static bool covers_all_edges(const struct triangle *t, struct fragment *f)
{
    bool inside = true;
    for (int i = 0; i < 3; i++) {
        int64_t e = edge_at(t, i, (int64_t)f->x * UNITS + UNITS / 2, (int64_t)f->y * UNITS + UNITS / 2);
        inside = inside && e >= 0;
        f->l[i] = (float)e * t->inverse_area;
    }
    return inside && is_before_clip_plane(t, f);
}

static bool covers_no_edge(const struct triangle *t, struct fragment *f)
{
    return covers(t, f) && f->l[0] != 0 && f->l[1] != 0 && f->l[2] != 0;
}

static bool cover_at_corners(const struct triangle *t, struct fragment *f)
{
    struct triangle moved = *t;
    for (int i = 0; i < 3; i++) {
        moved.v[i].x += UNITS / 2;
        moved.v[i].y += UNITS / 2;
    }
    return covers(&moved, f);
}

/* Edge functions in float, a step added from pixel to pixel, from the first column and row of the bounds on. */
static bool cover_by_adding(const struct triangle *t, struct fragment *f)
{
    int32_t low[2] = { INT32_MAX, INT32_MAX };
    for (int i = 0; i < 3; i++) {
        low[0] = t->v[i].x < low[0] ? t->v[i].x : low[0];
        low[1] = t->v[i].y < low[1] ? t->v[i].y : low[1];
    }
    int x0 = low[0] > 0 ? low[0] / UNITS : 0, y0 = low[1] > 0 ? low[1] / UNITS : 0;
    bool inside = true;
    for (int i = 0; i < 3; i++) {
        float e = (float)edge_at(t, i, (int64_t)x0 * UNITS + UNITS / 2, (int64_t)y0 * UNITS + UNITS / 2);
        for (int y = y0; y < f->y; y++)
            e = e + (float)(t->down[i] * UNITS);
        for (int x = x0; x < f->x; x++)
            e = e + (float)(t->right[i] * UNITS);
        inside = inside && (e > 0 || (e == 0 && is_top_or_left(t, i)));
        f->l[i] = e * t->inverse_area;
    }
    return inside && is_before_clip_plane(t, f);
}

static bool cover_in_32_bits(const struct triangle *t, struct fragment *f)
{
    bool inside = true;
    for (int i = 0; i < 3; i++) {
        int64_t exact = edge_at(t, i, (int64_t)f->x * UNITS + UNITS / 2, (int64_t)f->y * UNITS + UNITS / 2);
        int32_t e = (int32_t)(uint32_t)exact; /* what is left of it */
        inside = inside && (e > 0 || (e == 0 && is_top_or_left(t, i)));
        f->l[i] = (float)e * t->inverse_area;
    }
    return inside && is_before_clip_plane(t, f);
}

static bool cover_past_clip_plane(const struct triangle *t, struct fragment *f)
{
    struct triangle whole = *t;
    whole.crosses = false;
    return covers(&whole, f);
}

/* ---- depth_at, is_nearer ---- */

static float depth_in_16_bits(const struct triangle *t, const float l[3])
{
    return 1 - rintf((1 - depth_at(t, l)) * 65535) / 65535;
}

static float depth_in_perspective(const struct triangle *t, const float l[3])
{
    float b[3], sum = 0;
    for (int i = 0; i < 3; i++) {
        b[i] = l[i] * t->v[i].one_over_w;
        sum += b[i];
    }
    for (int i = 0; i < 3; i++)
        b[i] = b[i] / sum;
    return depth_at(t, b);
}

static float depth_of_a_vertex(const struct triangle *t, const float l[3])
{
    (void)l;
    return t->v[0].depth;
}

static bool is_farther(float depth, float before)
{
    return depth < before || before == 0; /* the first one is taken */
}

static bool is_always_nearer(float depth, float before)
{
    (void)depth;
    (void)before;
    return true;
}

/* ---- interpolate ---- */

static void interpolate_on_the_screen(const struct triangle *t, struct fragment *f)
{
    struct triangle flat = *t;
    for (int i = 0; i < 3; i++)
        flat.v[i].one_over_w = 1;
    interpolate(&flat, f);
}

static void interpolate_without_dividing(const struct triangle *t, struct fragment *f)
{
    interpolate(t, f);
    for (int i = 0; i < VARYINGS; i++) /* f / w, and no division by 1 / w */
        f->varying[i] = f->varying[i] / f->w;
}

static void exchange_weights(const struct triangle *t, struct fragment *f)
{
    struct fragment other = *f;
    other.l[1] = f->l[2];
    other.l[2] = f->l[1];
    interpolate(t, &other);
    memcpy(f->varying, other.varying, sizeof f->varying);
    f->w = other.w;
}

static void take_one_vertex(const struct triangle *t, struct fragment *f)
{
    interpolate(t, f);
    memcpy(f->varying, t->v[2].value, sizeof f->varying);
}

/* ---- level_of_detail ---- */

static float finest_level(const struct level *whole, const struct fragment *f)
{
    (void)whole;
    (void)f;
    return 0;
}

static float level_by_shorter_step(const struct level *whole, const struct fragment *f)
{
    struct fragment one = *f;
    float along[2];
    for (int k = 0; k < 2; k++) {
        float s = f->ds[k] * (float)whole->width, t = f->dt[k] * (float)whole->height;
        along[k] = s * s + t * t;
    }
    int shorter = along[0] < along[1] ? 0 : 1;
    one.ds[1 - shorter] = f->ds[shorter];
    one.dt[1 - shorter] = f->dt[shorter];
    return level_of_detail(whole, &one);
}

static float level_by_natural_logarithm(const struct level *whole, const struct fragment *f)
{
    return 0.6931472f * level_of_detail(whole, f);
}

static float level_of_square(const struct level *whole, const struct fragment *f)
{
    return 2 * level_of_detail(whole, f); /* log2 of the square, not halved */
}

/* ---- sample ---- */

static void sample_nearest(const struct texture *texture, struct fragment *f)
{
    const struct level *level = &texture->level[lom_int_of(clamp(f->lod, 0, (float)(texture->levels - 1)))];
    float s = f->varying[S] - floorf(f->varying[S]), t = f->varying[T] - floorf(f->varying[T]);
    int x = lom_int_of(s * (float)level->width), y = lom_int_of(t * (float)level->height);
    memcpy(f->texel, level->texel[y % level->height * level->width + x % level->width], sizeof f->texel);
    f->texel[3] = f->texel[3] / 255;
}

static void sample_at_corners(const struct texture *texture, struct fragment *f)
{
    struct fragment moved = *f;
    moved.varying[S] = f->varying[S] + 0.5f / (float)texture->level[0].width;
    moved.varying[T] = f->varying[T] + 0.5f / (float)texture->level[0].height;
    sample(texture, &moved);
    memcpy(f->texel, moved.texel, sizeof f->texel);
}

static void sample_one_level(const struct texture *texture, struct fragment *f)
{
    struct fragment whole = *f;
    whole.lod = floorf(clamp(f->lod, 0, (float)(texture->levels - 1)));
    sample(texture, &whole);
    memcpy(f->texel, whole.texel, sizeof f->texel);
}

static void sample_clamped(const struct texture *texture, struct fragment *f)
{
    struct fragment held = *f;
    held.varying[S] = clamp(f->varying[S], 0, most_weight);
    held.varying[T] = clamp(f->varying[T], 0, most_weight);
    sample(texture, &held);
    memcpy(f->texel, held.texel, sizeof f->texel);
}

/* ---- shade ---- */

/* N.L, of the side that is seen; not held above 0. */
static float cosine_to_light(const struct uniforms *u, const struct fragment *f, float n[3], float e[3])
{
    for (int i = 0; i < 3; i++) {
        n[i] = f->varying[NORMAL + i];
        e[i] = u->eye[i] - f->varying[WORLD + i];
    }
    normalize(n);
    normalize(e);
    return dot(n, e) < 0 ? -dot(n, to_light) : dot(n, to_light);
}

static void light_below_zero(const struct uniforms *u, struct fragment *f)
{
    float n[3], e[3], cosine = cosine_to_light(u, f, n, e);
    shade(u, f);
    for (int i = 0; i < 3 && cosine < 0; i++)
        f->color[i] = f->texel[i] * (ambient + lamp * cosine);
}

static void light_one_side(const struct uniforms *u, struct fragment *f)
{
    float n[3], e[3], cosine = cosine_to_light(u, f, n, e);
    shade(u, f);
    for (int i = 0; i < 3 && dot(n, e) < 0; i++) /* from within, the light that falls on the outside */
        f->color[i] = f->texel[i] * (ambient + lamp * greater(-cosine, 0));
}

static void skip_normalizing(const struct uniforms *u, struct fragment *f)
{
    const float *varying = f->varying + NORMAL;
    float n[3], e[3], diffuse = greater(cosine_to_light(u, f, n, e), 0), length = sqrtf(dot(varying, varying));
    shade(u, f);
    for (int i = 0; i < 3; i++)
        f->color[i] = f->color[i] + f->texel[i] * lamp * diffuse * (length - 1);
}

/* L - 2 (N.L) N goes on through the surface. */
static void mirror_backwards(const struct uniforms *u, struct fragment *f)
{
    float n[3], e[3], r[3], power = 1, diffuse = greater(cosine_to_light(u, f, n, e), 0), twice = 2 * dot(n, to_light);
    for (int i = 0; i < 3; i++)
        r[i] = to_light[i] - n[i] * twice;
    for (int i = 0; i < u->shininess; i++)
        power = power * greater(dot(r, e), 0);
    for (int i = 0; i < 3; i++)
        f->color[i] = f->texel[i] * (ambient + lamp * diffuse) + (diffuse > 0 ? power * shine : 0);
    f->color[3] = f->texel[3] * u->opacity;
}

static void eye_from_the_origin(const struct uniforms *u, struct fragment *f)
{
    struct uniforms still = *u;
    memset(still.eye, 0, sizeof still.eye);
    shade(&still, f);
}

/* ---- write_pixel ---- */

static void write_light_as_codes(const float color[4], bool blends, uint8_t pixel[4])
{
    write_pixel(color, blends, pixel);
    for (int c = 0; c < 3; c++)
        pixel[c] = (uint8_t)lom_count_of((double)decode(pixel[c]) * 255 + 0.5, 255);
}

static void blend_codes(const float color[4], bool blends, uint8_t pixel[4])
{
    uint8_t source[4] = { 0 };
    float alpha = clamp(color[3], 0, 1);
    write_pixel(color, false, source);
    for (int c = 0; c < 3 && blends; c++)
        source[c] = (uint8_t)lom_count_of((double)(source[c] * alpha + pixel[c] * (1 - alpha)) + 0.5, 255);
    memcpy(pixel, source, 3);
    pixel[3] = blends ? pixel[3] : source[3];
}

static void multiply_alpha_twice(const float color[4], bool blends, uint8_t pixel[4])
{
    float alpha = blends ? clamp(color[3], 0, 1) : 1;
    const float darker[4] = { color[0] * alpha, color[1] * alpha, color[2] * alpha, color[3] };
    write_pixel(darker, blends, pixel);
}

static void blend_additively(const float color[4], bool blends, uint8_t pixel[4])
{
    float sum[4], alpha = clamp(color[3], 0, 1);
    for (int c = 0; c < 3; c++)
        sum[c] = blends ? color[c] * alpha + decode(pixel[c]) : color[c];
    sum[3] = color[3];
    write_pixel(sum, false, pixel);
}

static void wrap_above_one(const float color[4], bool blends, uint8_t pixel[4])
{
    float wrapped[4];
    memcpy(wrapped, color, sizeof wrapped);
    for (int c = 0; c < 3; c++) /* as a byte would */
        wrapped[c] = color[c] > 1 ? color[c] - 1 : color[c];
    write_pixel(wrapped, blends, pixel);
}

static void cut_off_bytes(const float color[4], bool blends, uint8_t pixel[4])
{
    float alpha = blends ? clamp(color[3], 0, 1) : 1;
    uint8_t before[4];
    memcpy(before, pixel, sizeof before);
    write_pixel(color, blends, pixel);
    for (int c = 0; c < 3; c++) { /* the code is the largest whose light is not above */
        float light = clamp(color[c], 0, 1) * alpha + (blends ? decode(before[c]) * (1 - alpha) : 0);
        pixel[c] = pixel[c] > 0 && decode(pixel[c]) > light ? (uint8_t)(pixel[c] - 1) : pixel[c];
    }
}

/* ---- wave ---- */

static void travel_backwards(const lom_trochoid *w, float x, float z, float time, float moved[3])
{
    wave(w, x, z, -time, moved);
}

static void wave_of_length(const lom_trochoid *w, float x, float z, float time, float moved[3])
{
    lom_trochoid other = *w;
    other.number = w->number / 6.283185307179586; /* 1 / length */
    wave(&other, x, z, time, moved);
}

static void wave_of_one_speed(const lom_trochoid *w, float x, float z, float time, float moved[3])
{
    lom_trochoid other = *w;
    other.rate = lom_double_sqrt(9.80665) * w->number;
    wave(&other, x, z, time, moved);
}

static void wave_up_and_down(const lom_trochoid *w, float x, float z, float time, float moved[3])
{
    lom_trochoid sine = *w;
    sine.across = 0;
    wave(&sine, x, z, time, moved);
}

static void wave_turned_over(const lom_trochoid *w, float x, float z, float time, float moved[3])
{
    wave(w, x, z, time, moved);
    moved[0] = -moved[0];
    moved[2] = -moved[2];
}

/* ---- march ---- */

static void lose_evenly(float depth, float light, float ray[2])
{
    float through = greater(1 - depth, 0);
    ray[1] = ray[1] + ray[0] * (1 - through) * light;
    ray[0] = ray[0] * through;
}

static void forget_what_is_before(float depth, float light, float ray[2])
{
    float through = (float)lom_double_exp(-(double)depth);
    ray[1] = ray[1] + (1 - through) * light;
    ray[0] = ray[0] * through;
}

static void put_behind_over(float depth, float light, float ray[2])
{
    float through = (float)lom_double_exp(-(double)depth);
    ray[1] = ray[1] * through + (1 - through) * light;
    ray[0] = ray[0] * through;
}

static void add_depth_as_light(float depth, float light, float ray[2])
{
    ray[1] = ray[1] + ray[0] * depth * light;
    ray[0] = ray[0] * (float)lom_double_exp(-(double)depth);
}

#endif
