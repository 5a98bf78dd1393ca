/* Rays through a medium, LOM_LANES at a time. In: rays between two distances, a density, a grid of light. Out: how much
 * of each light they bring, and what comes through from behind. Invariant: a step at which the density is 0 for a ray
 * changes no bit of its result, so that leaving such steps out changes none either. */
#include "lanes/notes.h"
#include "medium_steps.h"

void LOM_WIDE(lom_cross_box)(lom_medium_rays *rays)
{
    lom_float *enter = &rays->enter, *leave = &rays->leave;
    const lom_float start[3] = { rays->start.x, rays->start.y, rays->start.z };
    const lom_float along[3] = { rays->along.x, rays->along.y, rays->along.z };
    lom_mask still = lom_splat_int(-1);
    *enter = (lom_float){ 0 };
    *leave = lom_splat(3e38f);
    for (int i = 0; i < 3; i++) {
        lom_mask parallel = lom_abs(along[i]) < 0x1p-126f; /* not a box's side in 3e38 m, and 1 / it may be infinite */
        still &= parallel;
        lom_float inverse = 1.0f / lom_select(parallel, lom_splat(1.0f), along[i]);
        lom_float first = -start[i] * inverse, second = (1.0f - start[i]) * inverse;
        lom_mask outside = parallel & ((start[i] < 0.0f) | (start[i] >= 1.0f));
        *enter = lom_select(parallel, *enter, lom_max(*enter, lom_min(first, second)));
        *leave = lom_select(parallel, *leave, lom_min(*leave, lom_max(first, second)));
        rays->active &= ~outside;
    }
    rays->active &= (*enter < *leave) & ~still;
}

/* A step of each ray: what of it lies between the ray's ends, and its middle. */
struct medium_step {
    lom_float low, high, middle;
    lom_float3 p;
    lom_volume_place place;
};

LOM_INLINE struct medium_step find_step(const lom_medium *m, const lom_medium_rays *rays, lom_float first,
                                        lom_float step, int i)
{
    struct medium_step s;
    s.low = lom_max(first + step * (float)i, rays->enter);
    s.high = lom_min(first + step * (float)(i + 1), rays->leave);
    s.middle = (s.low + s.high) * 0.5f;
    s.p = lom_add3(rays->start, lom_scale3(rays->along, s.middle));
    s.place = lom_find_in_cells(m->width, m->height, m->depth, s.p);
    return s;
}

static lom_light_sample light_at(const lom_medium_desc *desc, lom_float3 p)
{
    if (desc->light == NULL)
        return (lom_light_sample){ lom_splat(1.0f), lom_splat(1.0f), lom_splat(1.0f) };
    return desc->filtering == LOM_FILTERING_FIXED ? fixed_light(desc->light, p)
                                                  : read_light(desc->medium->gathers, desc->light, p);
}

/* Adds what a step of a density sends. */
LOM_INLINE void add_light(lom_medium_result *sum, const lom_medium_desc *desc, const lom_medium_rays *rays,
                          const struct medium_step *s, lom_float share)
{
    const lom_light_sample light = share_surroundings(light_at(desc, s->p));
    sum->sun += share * sun_share(desc, rays, light.sun);
    sum->sky += share * light.sky;
    sum->ground += share * light.ground;
    sum->distance += share * s->middle;
    sum->transmittance -= share;
    LOM_NOTE(LOM_NOTE_LIGHT, desc->medium, share, sum->transmittance, light.sun, light.sky, light.ground);
}

/* Behind a step that is not empty comes another one, nearly always: its words are asked for before the light of this one. */
void LOM_WIDE(lom_march_medium)(lom_medium_result *out, const lom_medium_rays *rays, const lom_medium_desc *desc,
                                lom_march_count *count)
{
    const lom_medium *m = desc->medium;
    lom_medium_result sum = { .transmittance = lom_splat(1.0f) };
    const lom_float step = step_of(desc, rays), first = rays->enter + (rays->shift - 1.0f) * step;
    const struct cell_walk walk = walk_cells(desc, rays, step, rays->enter);
    lom_mask alive = rays->active;
    LOM_NOTE(LOM_NOTE_RAY, m, rays->enter, rays->leave, step);
    lom_float seen = { 0 };
    struct medium_step s, next;
    struct medium_words words;
    uint64_t sampled = 0;
    bool was_empty = true;
    int i = 0;
    for (; lom_any(alive); i++) {
        s = was_empty ? find_step(m, rays, first, step, i) : next;
        alive &= s.low < rays->leave;
        if (!lom_any(alive))
            break;
        if (was_empty && !desc->walk) {
            int empty = empty_steps(m, &s.place, alive, &walk);
            if (empty != 0) {
                i += empty - 1;
                continue;
            }
        }
        if (was_empty)
            load_medium(m, s.place.index, &words);
        sampled++;
        lom_float density = find_density(desc, s.p, &s.place, &words, s.middle);
        lom_float length = lom_max(s.high - s.low, (lom_float){ 0 });
        LOM_NOTE(LOM_NOTE_STEP, m, s.middle, length, density, lom_as_float(alive));
        was_empty = !lom_any((density > 0.0f) & alive);
        if (was_empty)
            continue;
        next = find_step(m, rays, first, step, i + 1);
        load_medium(m, next.place.index, &words);
        lom_float opacity = -lom_expm1(-(density * length) * extinction_of(desc));
        lom_float share = lom_as_float(lom_as_int(opacity * sum.transmittance) & alive);
        add_light(&sum, desc, rays, &s, share);
        seen += share;
        alive &= sum.transmittance >= desc->stop;
    }
    sum.distance = lom_select(seen > 0.0f, sum.distance / lom_max(seen, lom_splat(1e-30f)), (lom_float){ 0 });
    *out = sum;
    if (count != NULL) {
        count->walked += (uint64_t)i;
        count->sampled += sampled;
    }
}

void LOM_WIDE(lom_medium_depth)(lom_float *depth, const lom_medium_rays *rays, const lom_medium_desc *desc, int steps)
{
    lom_float sum = { 0 };
    lom_float step = lom_max(rays->leave - rays->enter, (lom_float){ 0 }) * (1.0f / (float)steps);
    const lom_medium *m = desc->medium;
    const struct cell_walk walk = walk_cells(desc, rays, step, lom_splat(3e38f));
    bool was_empty = true;
    LOM_NOTE(LOM_NOTE_RAY, desc->medium, rays->enter, rays->leave, step);
    for (int i = 0; i < steps && lom_any(rays->active); i++) {
        lom_float at = rays->enter + step * ((float)i + 0.5f);
        lom_float3 p = lom_add3(rays->start, lom_scale3(rays->along, at));
        lom_volume_place place = lom_find_in_cells(m->width, m->height, m->depth, p);
        if (was_empty && !desc->walk) {
            int empty = empty_steps(m, &place, rays->active, &walk);
            if (empty != 0) {
                i += empty - 1;
                continue;
            }
        }
        struct medium_words words;
        load_medium(m, place.index, &words);
        lom_float density = find_density(desc, p, &place, &words, lom_splat(3e38f));
        LOM_NOTE(LOM_NOTE_STEP, desc->medium, at, step, density, lom_as_float(rays->active));
        was_empty = !lom_any((density > 0.0f) & rays->active);
        sum += density;
    }
    *depth = lom_as_float(lom_as_int(sum * (step * extinction_of(desc))) & rays->active);
}
