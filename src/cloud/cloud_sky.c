/* A sky of many clouds. In: count or cover, seed, area, kinds, or a METAR report. Out: clouds in places. Invariant:
 * every number is drawn by what it is for (the layer, the cloud, the try, the purpose), so that a cloud's place depends
 * on those before it through what they cover alone.
 *
 * Each cloud is the best of some candidates (Mitchell 1991): the one that hides least of what hides the ground already.
 * What hides the ground is counted over a raster of the area, by the footprint of the cloud's own density, made
 * coarsely: the columns whose optical depth is at least 0.1. Of a cover, candidates that would pass it do not count, so
 * the sky ends as near below it as the smallest candidate allows. */
#include "cloud/cloud_sky.h"

#include "base/numbers.h"
#include "cloud/cloud_kinds.h"

#include <string.h>

enum { LEAST_RASTER = 128, MOST_RASTER = 1024, MASK = 32, MASK_HEIGHT = 12, TRIES = 16, SHRINKS = 3 };
static const double cells_a_cloud = 8;                     /* along the shorter side of the smallest */
static const double least_depth = 0.1, full_cover = 0.985; /* of the raster: 8 oktas */
static const double mean_noise = 0.49;                     /* of what eats into densities (detail_noise.wide.c) */

/* What random numbers are for. */
enum purpose { FOR_KIND, FOR_SHAPE, FOR_X, FOR_Z, FOR_SIZE, FOR_TALL, FOR_YAW, FOR_BASE, PURPOSES };

struct footprint {
    const lom_cloud_kind *kind;
    int seed;
    bool hides[MASK * MASK];
};

struct layer {
    const lom_clouds *sky;
    const lom_cloud_mix *mix;
    size_t mix_count;
    double cover, base; /* share of the area, negative: `count` clouds; metres, negative: of the genus */
    int count;
    uint64_t key;
};

struct placing {
    const struct layer *layer;
    uint8_t *raster; /* what is hidden: side x side cells */
    int side;
    struct footprint *prints; /* those made so far */
    size_t print_count, print_room;
    lom_cloud_mix told; /* by a report, of the layer that is placed */
    double detail;
    int hidden;
};

struct candidate {
    lom_cloud cloud;
    int own, new; /* cells that it hides, and that nothing else does */
};

bool lom_has_sky(const lom_clouds *sky)
{
    return sky->count > 0 || sky->oktas > 0 || sky->metar != NULL;
}

static double draw(const struct layer *layer, size_t cloud, int try, enum purpose purpose)
{
    uint64_t key = lom_random_bits(layer->key, cloud);
    return lom_random_uniform(key, (uint64_t)try * PURPOSES + purpose);
}

static const lom_cloud_mix *choose_kind(const struct layer *layer, size_t cloud)
{
    double sum = 0, at = 0;
    for (size_t i = 0; i < layer->mix_count; i++)
        sum += layer->mix[i].share;
    double chosen = draw(layer, cloud, 0, FOR_KIND) * sum;
    size_t i = 0;
    for (; i + 1 < layer->mix_count; i++) {
        at += layer->mix[i].share;
        if (chosen < at)
            break;
    }
    return &layer->mix[i];
}

/* ---- what a cloud hides ---- */

/* `detail`: how far noise eats into the cloud, which counts as it does on average. */
static void fill_footprint(struct footprint *print, const lom_image *volume, double detail)
{
    const double eaten = detail * mean_noise;
    double step = print->kind->size[1] / MASK_HEIGHT * print->kind->extinction;
    for (int z = 0; z < MASK; z++)
        for (int x = 0; x < MASK; x++) {
            double sum = 0;
            for (int y = 0; y < MASK_HEIGHT; y++) {
                uint16_t density;
                memcpy(&density, lom_image_pixel(volume, x, y, z), sizeof density);
                sum += lom_larger((density / 65535.0 - eaten) / (1 - eaten), 0);
            }
            print->hides[z * MASK + x] = sum * step >= least_depth;
        }
}

static const struct footprint *find_footprint(struct placing *p, const lom_cloud_kind *kind, int seed, lom_error *error)
{
    for (size_t i = 0; i < p->print_count; i++)
        if (p->prints[i].kind == kind && p->prints[i].seed == seed)
            return &p->prints[i];
    if (p->print_count == p->print_room) {
        lom_fail(error, LOM_ERROR_USAGE, "A sky has at most %zu shapes of clouds.", p->print_room);
        return NULL;
    }
    lom_image *volume = lom_make_cloud(&(lom_cloud_desc){ kind->name, MASK, MASK_HEIGHT, MASK, (uint64_t)seed }, error);
    if (volume == NULL)
        return NULL;
    struct footprint *print = &p->prints[p->print_count++];
    *print = (struct footprint){ .kind = kind, .seed = seed };
    fill_footprint(print, volume, p->detail);
    lom_free_image(volume);
    return print;
}

/* The cells of the raster, from *low to *high, that a cloud can reach along an axis. */
static void find_cells(double middle, double reach, double low, double cell, int side, int *first, int *last)
{
    double from = lom_smaller(lom_larger((middle - reach - low) / cell, 0), side);
    double to = lom_smaller(lom_larger((middle + reach - low) / cell + 1, 0), side);
    *first = lom_int_of(from);
    *last = lom_int_of(to);
}

/* Counts the cells that a cloud hides, or hides them. */
static void visit(struct placing *p, struct candidate *c, const struct footprint *print, bool mark)
{
    const lom_clouds *sky = p->layer->sky;
    const lom_cloud *cloud = &c->cloud;
    double sine = lom_double_sin(cloud->yaw), cosine = lom_double_cos(cloud->yaw);
    double low[2] = { sky->middle[0] - sky->area[0] / 2, sky->middle[1] - sky->area[1] / 2 };
    double reach = lom_double_sqrt(cloud->size[0] * cloud->size[0] + cloud->size[2] * cloud->size[2]) / 2;
    double cell[2] = { sky->area[0] / p->side, sky->area[1] / p->side };
    int x0, x1, z0, z1;
    find_cells(cloud->position.x, reach, low[0], cell[0], p->side, &x0, &x1);
    find_cells(cloud->position.z, reach, low[1], cell[1], p->side, &z0, &z1);
    c->own = c->new = 0;
    for (int z = z0; z < z1; z++)
        for (int x = x0; x < x1; x++) {
            double dx = low[0] + (x + 0.5) * cell[0] - cloud->position.x;
            double dz = low[1] + (z + 0.5) * cell[1] - cloud->position.z;
            double s = (cosine * dx - sine * dz) / cloud->size[0] + 0.5;
            double t = (sine * dx + cosine * dz) / cloud->size[2] + 0.5;
            if (!(s >= 0 && s < 1 && t >= 0 && t < 1) ||
                !print->hides[lom_int_of(t * MASK) * MASK + lom_int_of(s * MASK)])
                continue;
            uint8_t *hidden = &p->raster[z * p->side + x];
            c->own++;
            c->new += !*hidden;
            if (mark)
                *hidden = 1;
        }
}

/* ---- clouds ---- */

/* The height of a genus's bases is one draw for its sky, as the level of condensation is one; a cloud is off it by up
 * to a 50th of the range. */
static double base_of(const struct layer *layer, const lom_cloud_kind *kind, size_t cloud)
{
    if (layer->base >= 0)
        return layer->base;
    if (kind->high <= kind->low)
        return 1000;
    double range = kind->high - kind->low, share = lom_random_uniform(layer->key, (uint64_t)lom_int64_of(kind->high));
    double off = 0.04 * (draw(layer, cloud, 0, FOR_BASE) - 0.5);
    return kind->low + range * lom_smaller(lom_larger(share * 0.96 + 0.02 + off, 0), 1);
}

static lom_cloud make_candidate(const struct layer *layer, const lom_cloud *pattern, const lom_cloud_kind *kind,
                                size_t number, int try)
{
    const lom_clouds *sky = layer->sky;
    lom_cloud cloud = *pattern;
    double size = sky->sizes[0] + (sky->sizes[1] - sky->sizes[0]) * draw(layer, number, try, FOR_SIZE);
    for (int shrink = try / TRIES; shrink > 0; shrink--)
        size /= 2;
    cloud.kind = kind->name;
    cloud.seed = 1 + lom_int_of(draw(layer, number, 0, FOR_SHAPE) * sky->shapes);
    for (int i = 0; i < 3; i++) {
        cloud.size[i] = kind->size[i] * size;
        cloud.voxels[i] = lom_larger(lom_double_floor(kind->voxels[i] * sky->voxels + 0.5), 1);
    }
    cloud.size[1] *= 0.85 + 0.3 * draw(layer, number, try, FOR_TALL);
    const double shrink = lom_shrink_of_kind(kind, cloud.size);
    cloud.extinction = kind->extinction / shrink;
    cloud.detail_size *= shrink;
    cloud.yaw = lom_two_pi * draw(layer, number, try, FOR_YAW) - lom_pi;
    cloud.position = (lom_vec3){ sky->middle[0] + sky->area[0] * (draw(layer, number, try, FOR_X) - 0.5),
                                 base_of(layer, kind, number),
                                 sky->middle[1] + sky->area[1] * (draw(layer, number, try, FOR_Z) - 0.5) };
    return cloud;
}

/* The better of two: more of what it hides is new. */
static bool is_better(const struct candidate *a, const struct candidate *b)
{
    return (double)a->new *(b->own > 0 ? b->own : 1) > (double)b->new *(a->own > 0 ? a->own : 1);
}

/* The next cloud of a layer. *found: there is one that does not pass the cover. False: an error. */
static bool place_next(struct placing *p, const lom_cloud *pattern, size_t number, lom_cloud *placed, bool *found,
                       lom_error *error)
{
    const struct layer *layer = p->layer;
    const lom_cloud_kind *kind = lom_find_cloud_kind(choose_kind(layer, number)->kind, error);
    const struct footprint *print = NULL;
    struct candidate best = { .own = 0 };
    const double cells = (double)p->side * p->side, most = layer->cover < 0 ? cells : layer->cover * cells + 0.5;
    int tries = layer->cover < 0 ? TRIES : TRIES * (1 + SHRINKS);
    *found = false;
    for (int try = 0; kind != NULL && try < tries && !(*found && try % TRIES == 0); try++) {
        struct candidate c = { .cloud = make_candidate(layer, pattern, kind, number, try) };
        print = find_footprint(p, kind, c.cloud.seed, error);
        if (print == NULL)
            return false;
        visit(p, &c, print, false);
        bool fits = p->hidden + c.new <= most && (layer->cover < 0 || c.new > 0);
        if (fits && (!*found || is_better(&c, &best)))
            best = c;
        *found |= fits;
    }
    if (*found) {
        visit(p, &best, print, true);
        p->hidden += best.new;
        *placed = best.cloud;
    }
    return kind != NULL;
}

/* Cells along a side of the raster: so many that the smallest cloud has some. */
static int find_side(const struct layer *layer)
{
    double least = 1e30;
    for (size_t i = 0; i < layer->mix_count; i++) {
        const lom_cloud_kind *kind = lom_find_cloud_kind(layer->mix[i].kind, NULL);
        least = lom_smaller(least, lom_smaller(kind->size[0], kind->size[2]));
    }
    double cells =
        lom_larger(layer->sky->area[0], layer->sky->area[1]) * cells_a_cloud / (least * layer->sky->sizes[0]);
    return lom_int_of(lom_smaller(lom_larger(cells, LEAST_RASTER), MOST_RASTER));
}

static bool too_many(lom_error *error)
{
    return lom_fail(error, LOM_ERROR_LIMIT,
                    "A sky has at most %d clouds: a smaller area, or larger clouds, need fewer.", LOM_MAX_SKY);
}

/* Whether even clouds that were the largest boxes, side by side, would be too many. */
static bool is_beyond(const struct layer *layer)
{
    double largest = 0, size = layer->sky->sizes[1];
    for (size_t i = 0; i < layer->mix_count; i++) {
        const lom_cloud_kind *kind = lom_find_cloud_kind(layer->mix[i].kind, NULL);
        largest = lom_larger(largest, kind->size[0] * kind->size[2] * size * size);
    }
    return layer->cover * layer->sky->area[0] * layer->sky->area[1] > LOM_MAX_SKY * largest;
}

static bool place_layer(struct placing *p, const lom_cloud *pattern, lom_cloud *clouds, size_t *count, size_t most,
                        lom_error *error)
{
    const struct layer *layer = p->layer;
    p->side = find_side(layer);
    p->hidden = 0;
    memset(p->raster, 0, (size_t)p->side * (size_t)p->side);
    if (is_beyond(layer))
        return too_many(error);
    const double enough = layer->cover * p->side * p->side - p->side;
    for (size_t i = 0; layer->cover >= 0 ? p->hidden < enough : i < (size_t)layer->count; i++) {
        bool found;
        if (*count == most)
            return too_many(error);
        if (!place_next(p, pattern, i, &clouds[*count], &found, error))
            return false;
        if (!found)
            break;
        *count += 1;
    }
    return true;
}

static bool place_report(struct placing *p, struct layer *layer, const lom_cloud *pattern, lom_cloud *clouds,
                         size_t *count, size_t most, lom_error *error)
{
    lom_metar_layer layers[LOM_MAX_METAR_LAYERS];
    int number = lom_parse_metar(layer->sky->metar, layers, error);
    bool done = number >= 0;
    for (int i = 0; done && i < number; i++) {
        p->told = (lom_cloud_mix){ .kind = layers[i].kind, .share = 1 };
        layer->mix = &p->told;
        layer->mix_count = 1;
        layer->cover = lom_smaller(layers[i].oktas / 8, full_cover);
        layer->base = layers[i].base;
        layer->key = lom_random_bits((uint64_t)layer->sky->seed, (uint64_t)i + 1);
        done = place_layer(p, pattern, clouds, count, most, error);
    }
    return done;
}

bool lom_place_sky(const lom_clouds *sky, const lom_cloud *pattern, lom_cloud *clouds, size_t *count, lom_error *error)
{
    static const lom_cloud_mix fair[] = { { .kind = "cumulus_humilis", .share = 3 },
                                          { .kind = "cumulus_mediocris", .share = 2 },
                                          { .kind = "cumulus_fractus", .share = 1 } };
    struct layer layer = { .sky = sky,
                           .mix = sky->mix_count > 0 ? sky->mix : fair,
                           .mix_count = sky->mix_count > 0 ? sky->mix_count : sizeof fair / sizeof *fair,
                           .cover = sky->oktas > 0 ? lom_smaller(sky->oktas / 8, full_cover) : -1,
                           .base = sky->base,
                           .count = sky->count,
                           .key = lom_random_bits((uint64_t)sky->seed, 0) };
    struct placing p = { .layer = &layer,
                         .print_room = (size_t)(LOM_MAX_MIX * LOM_MAX_SKY_SHAPES),
                         .detail = pattern->detail };
    size_t most = *count + LOM_MAX_SKY;
    p.raster = lom_allocate((size_t)MOST_RASTER * MOST_RASTER, 1, error);
    p.prints = p.raster != NULL ? lom_allocate(p.print_room, sizeof *p.prints, error) : NULL;
    bool done = p.prints != NULL;
    if (done)
        done = sky->metar != NULL ? place_report(&p, &layer, pattern, clouds, count, most, error)
                                  : place_layer(&p, pattern, clouds, count, most, error);
    lom_release(p.prints);
    lom_release(p.raster);
    return done;
}
