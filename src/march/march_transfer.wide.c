/* Rays through a medium that a transfer function colours, LOM_LANES at a time. In: rays between two distances, a medium,
 * a function. Out: the colours that come towards the eye, and what comes through from behind. Invariant: a step between
 * two values of 0 adds 0 where the function is clear there, so that leaving such steps out changes no bit. */
#include "lanes/notes.h"
#include "medium_steps.h"

#include <lom/transfer.h>

/* The value at a place; the noise in it is that of a distance from the eye. One copy of the code for all who ask. */
static __attribute__((noinline)) lom_float value_in(const lom_medium_desc *desc, lom_float3 p, lom_float eye)
{
    lom_volume_place place = lom_find_in_cells(desc->medium->width, desc->medium->height, desc->medium->depth, p);
    struct medium_words words;
    load_medium(desc->medium, place.index, &words);
    return find_density(desc, p, &place, &words, eye);
}

static inline lom_float value_at(const lom_medium_rays *rays, const lom_medium_desc *desc, lom_float at, lom_float eye)
{
    return value_in(desc, lom_add3(rays->start, lom_scale3(rays->along, at)), eye);
}

/* A unit vector against the gradient of the value, by differences over two voxels, in the box's axes; 0 where the value
 * is even. */
static lom_float3 normal_at(const lom_medium_desc *desc, const lom_transfer_desc *look, lom_float3 p, lom_float at)
{
    const lom_medium *m = desc->medium;
    const int voxels[3] = { m->width, m->height, m->depth };
    lom_float rise[3];
    for (int i = 0; i < 3; i++) {
        float beside = 1.0f / (float)voxels[i];
        lom_float ends[2];
        for (int side = 0; side < 2; side++) {
            float off = side == 0 ? -beside : beside;
            lom_float3 q = { i == 0 ? p.x + off : p.x, i == 1 ? p.y + off : p.y, i == 2 ? p.z + off : p.z };
            ends[side] = value_in(desc, q, at);
        }
        rise[i] = (ends[0] - ends[1]) * ((float)voxels[i] / look->size[i]);
    }
    lom_float3 n = { rise[0], rise[1], rise[2] };
    lom_float longest = largest3(n.x, n.y, n.z);
    n = lom_scale3(n, 1.0f / lom_max(longest, lom_splat(0x1p-100f))); /* whose square is a float, whatever the size */
    lom_float square = lom_dot3(n, n);
    return lom_scale3(n,
                      lom_select(square > 0.5f, 1.0f / lom_sqrt(lom_max(square, lom_splat(0.5f))), (lom_float){ 0 }));
}

static lom_float3 mix_lights(const lom_transfer_desc *look, lom_float sun, lom_float sky, lom_float ground)
{
    lom_float3 light = lom_scale3(lom_splat3(look->sun[0], look->sun[1], look->sun[2]), sun);
    light = lom_add3(light, lom_scale3(lom_splat3(look->sky[0], look->sky[1], look->sky[2]), sky));
    return lom_add3(light, lom_scale3(lom_splat3(look->ground[0], look->ground[1], look->ground[2]), ground));
}

static __attribute__((noinline)) lom_light_sample grid_light(const lom_medium_desc *desc, lom_float3 p)
{
    if (desc->light == NULL)
        return (lom_light_sample){ lom_splat(1.0f), lom_splat(1.0f), lom_splat(1.0f) };
    return desc->filtering == LOM_FILTERING_FIXED ? fixed_light(desc->light, p)
                                                  : read_light(desc->medium->gathers, desc->light, p);
}

/* Where a surface takes its light from: two voxels of the grid before it, so that it is not in its own shadow. */
static lom_float3 before_surface(const lom_medium_desc *desc, lom_float3 p, lom_float3 n)
{
    const lom_light_grid *g = desc->light;
    if (g == NULL)
        return p;
    return (lom_float3){ p.x + n.x * (2.0f / (float)g->width), p.y + n.y * (2.0f / (float)g->height),
                         p.z + n.z * (2.0f / (float)g->depth) };
}

/* What lights a white surface at a place. */
static lom_float3 surface_light(const lom_medium_desc *desc, const lom_transfer_desc *look, const lom_medium_rays *rays,
                                lom_float3 p, lom_float at, lom_light_sample *light)
{
    lom_float3 n = normal_at(desc, look, p, at);
    lom_float3 along = { rays->along.x * look->size[0], rays->along.y * look->size[1], rays->along.z * look->size[2] };
    n = lom_scale3(n, lom_select(lom_dot3(n, along) > 0.0f, lom_splat(-1.0f), lom_splat(1.0f)));
    *light = grid_light(desc, before_surface(desc, p, n));
    lom_float cosine =
        lom_max(lom_dot3(n, lom_splat3(look->to_light[0], look->to_light[1], look->to_light[2])), (lom_float){ 0 });
    lom_float through = light->sun;
    for (int part = LOM_LIGHT_DEPTH; part > 1; part /= 2)
        through = through * through;
    lom_float above = n.y * 0.5f + 0.5f;
    return mix_lights(look, cosine * through, above * light->sky, (1.0f - above) * light->ground);
}

/* The light that a place turns into its colour. */
static lom_float3 light_at(const lom_medium_desc *desc, const lom_transfer_desc *look, const lom_medium_rays *rays,
                           lom_float at, lom_light_sample *light)
{
    *light = (lom_light_sample){ lom_splat(1.0f), lom_splat(1.0f), lom_splat(1.0f) };
    if (look->look == LOM_LOOK_GLOWING)
        return lom_splat3(1, 1, 1);
    lom_float3 p = lom_add3(rays->start, lom_scale3(rays->along, at));
    if (look->look == LOM_LOOK_SURFACE)
        return surface_light(desc, look, rays, p, at, light);
    *light = share_surroundings(grid_light(desc, p));
    return mix_lights(look, sun_share(desc, rays, light->sun), light->sky, light->ground);
}

/* How many steps from the one that ends at `high` on lie between values of 0. */
static int skipped_steps(const lom_medium_rays *rays, const lom_medium *m, lom_float high, lom_mask alive,
                         const struct cell_walk *walk)
{
    lom_float3 p = lom_add3(rays->start, lom_scale3(rays->along, high));
    lom_volume_place place = lom_find_in_cells(m->width, m->height, m->depth, p);
    return empty_steps(m, &place, alive, walk);
}

/* Adds what a step sends: `seen` is its mean of the transfer function, `share` of the pixel. */
static void add_step(lom_transfer_result *sum, lom_float4 seen, lom_float share, lom_float3 light)
{
    lom_float each = share / lom_max(seen.w, lom_splat(0x1p-100f));
    sum->color.x += each * (seen.x * light.x);
    sum->color.y += each * (seen.y * light.y);
    sum->color.z += each * (seen.z * light.z);
    sum->transmittance -= share;
}

void LOM_WIDE(lom_march_transfer)(lom_transfer_result *out, const lom_medium_rays *rays, const lom_medium_desc *medium,
                                  const lom_transfer_desc *desc, lom_march_count *count)
{
    lom_transfer_result sum = { .transmittance = lom_splat(1.0f) };
    const lom_float step = step_of(medium, rays), first = rays->enter + (rays->shift - 1.0f) * step;
    const struct cell_walk walk = walk_cells(medium, rays, step, rays->enter);
    const bool skips = !medium->walk && desc->transfer->empty_is_clear;
    lom_mask alive = rays->active;
    LOM_NOTE(LOM_NOTE_RAY, medium->medium, rays->enter, rays->leave, step);
    lom_float seen = { 0 }, front = value_at(rays, medium, rays->enter, rays->enter);
    uint64_t sampled = 0;
    int i = 0;
    for (; lom_any(alive); i++) {
        lom_float low = lom_max(first + step * (float)i, rays->enter);
        lom_float high = lom_min(first + step * (float)(i + 1), rays->leave);
        alive &= low < rays->leave;
        if (!lom_any(alive))
            break;
        if (skips && !lom_any((front > 0.0f) & alive)) {
            int empty = skipped_steps(rays, medium->medium, high, alive, &walk);
            if (empty != 0) {
                i += empty - 1;
                continue;
            }
        }
        sampled++;
        lom_float length = lom_max(high - low, (lom_float){ 0 }), middle = (low + high) * 0.5f;
        lom_float back = value_at(rays, medium, high, high);
        lom_float4 mean = lom_transfer_between(desc->transfer, front, back);
        LOM_NOTE(LOM_NOTE_STEP, medium->medium, middle, length, (front + back) * 0.5f, lom_as_float(alive));
        front = back;
        if (!lom_any((mean.w > 0.0f) & alive))
            continue;
        lom_float opacity = -lom_expm1(-(mean.w * length) * extinction_of(medium));
        lom_float share = lom_as_float(lom_as_int(opacity * sum.transmittance) & alive);
        lom_light_sample light;
        lom_float3 lit = light_at(medium, desc, rays, middle, &light);
        add_step(&sum, mean, share, lit);
        sum.distance += share * middle;
        seen += share;
        LOM_NOTE(LOM_NOTE_LIGHT, medium->medium, share, sum.transmittance, light.sun, light.sky, light.ground);
        alive &= sum.transmittance >= medium->stop;
    }
    sum.distance = lom_select(seen > 0.0f, sum.distance / lom_max(seen, lom_splat(1e-30f)), (lom_float){ 0 });
    *out = sum;
    if (count != NULL) {
        count->walked += (uint64_t)i;
        count->sampled += sampled;
    }
}

void LOM_WIDE(lom_transfer_depth)(lom_float *depth, const lom_medium_rays *rays, const lom_medium_desc *medium,
                                  const lom_transfer_function *transfer, int steps)
{
    const lom_float step = lom_max(rays->leave - rays->enter, (lom_float){ 0 }) * (1.0f / (float)steps);
    const struct cell_walk walk = walk_cells(medium, rays, step, lom_splat(3e38f));
    const lom_float far = lom_splat(3e38f);
    const bool skips = !medium->walk && transfer->empty_is_clear;
    LOM_NOTE(LOM_NOTE_RAY, medium->medium, rays->enter, rays->leave, step);
    lom_float sum = { 0 }, front = value_at(rays, medium, rays->enter, far);
    for (int i = 0; i < steps && lom_any(rays->active); i++) {
        lom_float at = rays->enter + step * (float)(i + 1);
        if (skips && !lom_any((front > 0.0f) & rays->active)) {
            int empty = skipped_steps(rays, medium->medium, at, rays->active, &walk);
            if (empty != 0) {
                i += empty - 1;
                continue;
            }
        }
        lom_float back = value_at(rays, medium, at, far);
        LOM_NOTE(LOM_NOTE_STEP, medium->medium, at, step, back, lom_as_float(rays->active));
        sum += lom_transfer_between(transfer, front, back).w;
        front = back;
    }
    *depth = lom_as_float(lom_as_int(sum * (step * extinction_of(medium))) & rays->active);
}
