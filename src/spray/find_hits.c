/* Places where water throws drops (hits.h). In: a site, a rectangle. Out: places with what throws there, and sums of
 * weights, by which drops are shared among them. Invariant: a function of the bed and the waves, row by row. */
#include "spray/hits.h"

#include "base/numbers.h"
#include "base/reserve.h"
#include "waves/river.h"

static const double gravity = 9.80665;
static const double ahead = 2.5, least_rise = 1.1;      /* metres: ground that is steep rises so much within that way */
static const double least_amplitude = 0.02, froude = 1; /* metres; speed in parts of sqrt(g d) */

static bool add(struct lom_hits *hits, const struct lom_hit_place *place, lom_error *error)
{
    const size_t count = hits->count + 1;
    size_t capacity = hits->capacity;
    if (!lom_reserve(&hits->places, &capacity, count, sizeof *hits->places, error) ||
        !lom_reserve(&hits->sum, &hits->capacity, count, sizeof *hits->sum, error))
        return false;
    const double speed = lom_hit_speed(place, 1), at[3] = { place->place[0], place->level, place->place[1] };
    hits->places[hits->count] = *place;
    hits->sum[hits->count] = (hits->count > 0 ? hits->sum[hits->count - 1] : 0) + place->width * speed * speed;
    for (int i = 0; i < 3; i++) {
        hits->low[i] = hits->count > 0 ? lom_smaller(hits->low[i], at[i]) : at[i];
        hits->high[i] = hits->count > 0 ? lom_larger(hits->high[i], at[i]) : at[i];
    }
    hits->count = count;
    return true;
}

/* The rectangle as steps of a grid over the bed: first and last of columns and rows. */
static void find_range(const lom_spray *spray, const double size[2], const int steps[2], int first[2], int last[2])
{
    for (int i = 0; i < 2; i++) {
        const double a = spray->from[2 * i], b = spray->to[2 * i];
        const double low = (lom_smaller(a, b) / size[i] + 0.5) * steps[i],
                     high = (lom_larger(a, b) / size[i] + 0.5) * steps[i];
        first[i] = lom_int_of(lom_double_floor(lom_larger(0, lom_smaller(low, steps[i]))));
        last[i] = lom_int_of(lom_double_floor(lom_larger(-1, lom_smaller(high, steps[i]))));
    }
}

/* ---- surf ---- */

/* Whether the wave at a place meets steep ground a step further; the place is then filled. */
static bool meets(const struct lom_hits *hits, const struct lom_wave_site *site, double x, double z, double step,
                  struct lom_hit_place *out)
{
    if (lom_bed_over_level(site, x, z) >= 0)
        return false;
    const struct lom_surf_place here = lom_surf_place_at(&hits->map, x, z);
    const double number = lom_double_sqrt(here.k[0] * here.k[0] + here.k[1] * here.k[1]);
    if (!(number > 0))
        return false;
    const double way[2] = { here.k[0] / number, here.k[1] / number };
    /* Behind an island waves from both sides meet: what has turned back is no front. */
    if (!(way[0] * lom_double_cos(site->surf->direction) + way[1] * lom_double_sin(site->surf->direction) > 0))
        return false;
    if (lom_bed_over_level(site, x + way[0] * step, z + way[1] * step) < 0 ||
        lom_bed_over_level(site, x + way[0] * ahead, z + way[1] * ahead) < least_rise)
        return false;
    /* The wave as it comes, before the bed of the wall makes it break in the maps. */
    const double before[2] = { x - 2 * step * way[0], z - 2 * step * way[1] };
    const struct lom_surf_place wave = lom_surf_place_at(&hits->map, before[0], before[1]);
    const double depth = lom_larger(-lom_bed_over_level(site, before[0], before[1]), 0.05);
    if (!(wave.amplitude > least_amplitude))
        return false;
    const double frequency = lom_two_pi / hits->period;
    /* A front is where t = w time - phase is -f, and f the angle of (skew, lean). */
    const double front = wave.lean != 0 || wave.skew != 0 ? lom_double_atan2(wave.lean, wave.skew) : 0;
    double waves = (here.phase - front) / lom_two_pi;
    waves -= lom_double_floor(waves);
    *out = (struct lom_hit_place){ .place = { x, z },
                                   .level = site->level,
                                   .way = { way[0], way[1] },
                                   .width = step,
                                   .amplitude = wave.amplitude,
                                   .speed = frequency / number,
                                   .swing = frequency / lom_double_tanh(number * depth),
                                   .phase = here.phase,
                                   .arrival = waves < 1 ? waves * hits->period : 0 };
    return true;
}

static bool find_surf(struct lom_hits *hits, const lom_spray *spray, const struct lom_wave_site *site, lom_error *error)
{
    const struct lom_bed *bed = &site->bed;
    const int steps[2] = { bed->columns, bed->rows };
    int first[2], last[2];
    if (bed->heights == NULL || !lom_make_site_surf(&hits->map, site, error))
        return bed->heights == NULL;
    const bool is_there = hits->map.cells != NULL;
    const double size[2] = { bed->size[0] / bed->columns, bed->size[1] / bed->rows };
    hits->period = site->surf->period;
    find_range(spray, bed->size, steps, first, last);
    bool done = true;
    for (int row = first[1]; is_there && done && row <= last[1]; row++)
        for (int column = first[0]; done && column <= last[0]; column++) {
            struct lom_hit_place place;
            if (meets(hits, site, column * size[0] - bed->size[0] / 2, row * size[1] - bed->size[1] / 2,
                      lom_larger(size[0], size[1]), &place))
                done = add(hits, &place, error);
        }
    lom_free_surf_map(&hits->map);
    hits->map.cells = NULL;
    return done;
}

/* ---- a river ---- */

static bool find_rapids(struct lom_hits *hits, const lom_spray *spray, const struct lom_wave_site *site,
                        lom_error *error)
{
    enum { CELLS = LOM_RIVER_CELLS };
    const int steps[2] = { CELLS - 1, CELLS - 1 };
    const struct lom_bed *bed = &site->bed;
    int first[2], last[2];
    if (bed->heights == NULL || site->waves->kind != LOM_WAVES_FLOW)
        return true;
    double *depth = lom_allocate((size_t)CELLS * CELLS, sizeof *depth, error);
    lom_image *field = NULL;
    if (depth != NULL) {
        lom_find_river_depths(site, depth);
        field = lom_make_river(depth, CELLS, site->waves->direction, error);
    }
    bool done = field != NULL;
    find_range(spray, bed->size, steps, first, last);
    for (int row = first[1]; done && row <= last[1]; row++)
        for (int column = first[0]; done && column <= last[0]; column++) {
            const float *v = lom_image_pixel(field, column, row, 0);
            const double here = depth[row * CELLS + column], x = (double)v[0] * site->waves->speed,
                         z = (double)v[1] * site->waves->speed, speed = lom_double_sqrt(x * x + z * z);
            if (!(here > 0) || !(speed > froude * lom_double_sqrt(gravity * here)))
                continue;
            const struct lom_hit_place place = { .place = { column * bed->size[0] / (CELLS - 1) - bed->size[0] / 2,
                                                            row * bed->size[1] / (CELLS - 1) - bed->size[1] / 2 },
                                                 .level = site->level,
                                                 .way = { x / speed, z / speed },
                                                 .width = bed->size[0] / (CELLS - 1),
                                                 .speed = speed };
            done = add(hits, &place, error);
        }
    lom_free_image(field);
    lom_release(depth);
    return done;
}

/* ---- all ---- */

bool lom_find_hits(struct lom_hits *hits, const lom_spray *spray, const struct lom_wave_site *site,
                   const struct lom_hit_body *body, lom_error *error)
{
    *hits = (struct lom_hits){ .surf = *site->surf };
    if (spray->source == LOM_SPRAY_ENTITY)
        return body == NULL || lom_find_entity_hits(hits, site, body, error);
    bool done = spray->source == LOM_SPRAY_SURF    ? find_surf(hits, spray, site, error)
                : spray->source == LOM_SPRAY_RIVER ? find_rapids(hits, spray, site, error)
                                                   : true;
    for (size_t i = 0; i < hits->count; i++)
        hits->fastest = lom_larger(hits->fastest, lom_hit_speed(&hits->places[i], 1 + site->surf->variation));
    return done;
}

void lom_free_hits(struct lom_hits *hits)
{
    lom_release(hits->places);
    lom_release(hits->sum);
    lom_free_wave_trains(&hits->trains);
}
