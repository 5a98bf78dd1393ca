/* The light of a scene's clouds as the sun moves. In: the way to the sun. Out: a grid of light for each cloud, which
 * the other clouds shadow. Invariant: a cloud's light is a function of the sun and of the places of the clouds alone;
 * it is made again when that changes. */
#include "base/numbers.h"
#include "base/pass_error.h"
#include "cloud/cloud_draw.h"
#include "cloud/cloud_layers.h"
#include "pipeline/share_work.h"

#include <string.h>

/* A place in parts of a cloud's box, and a way in parts a metre. */
static void to_box(const struct lom_placed_cloud *cloud, const double world[3], bool is_place, double box[3])
{
    const double middle[3] = { cloud->middle.x, cloud->middle.y, cloud->middle.z };
    for (int i = 0; i < 3; i++) {
        double sum = 0;
        for (int k = 0; k < 3; k++)
            sum += cloud->axes[i][k] * (is_place ? world[k] - middle[k] : world[k]);
        box[i] = sum / cloud->cloud->size[i] + (is_place ? 0.5 : 0);
    }
}

/* Optical depth of a cloud along the way from a place on: the grid of light's density, the nearest voxel at the middles
 * of equal steps. */
static double depth_of(const struct lom_placed_cloud *cloud, const double from[3], const double way[3], int steps)
{
    const lom_light_grid *g = cloud->light;
    const int size[3] = { g->width, g->height, g->depth };
    double start[3], along[3], enter = 0, leave = 1e30, sum = 0;
    to_box(cloud, from, true, start);
    to_box(cloud, way, false, along);
    for (int i = 0; i < 3; i++) {
        if (along[i] == 0) {
            if (start[i] < 0 || start[i] >= 1)
                return 0;
            continue;
        }
        double first = ((along[i] > 0 ? 0 : 1) - start[i]) / along[i],
               last = ((along[i] > 0 ? 1 : 0) - start[i]) / along[i];
        enter = first > enter ? first : enter;
        leave = last < leave ? last : leave;
    }
    if (!(enter < leave))
        return 0;
    double step = (leave - enter) / steps;
    for (int k = 0; k < steps; k++) {
        int voxel[3];
        for (int i = 0; i < 3; i++) {
            double at = (start[i] + along[i] * (enter + (k + 0.5) * step)) * size[i];
            voxel[i] = at > 0 ? at < size[i] - 1 ? lom_int_of(at) : size[i] - 1 : 0;
        }
        sum += g->density[((size_t)voxel[2] * (size_t)size[1] + (size_t)voxel[1]) * (size_t)size[0] + (size_t)voxel[0]];
    }
    return sum / 65535 * step * cloud->cloud->extinction * cloud->cloud->density;
}

static double radius_of(const struct lom_placed_cloud *cloud)
{
    const double *size = cloud->cloud->size;
    return lom_double_sqrt(size[0] * size[0] + size[1] * size[1] + size[2] * size[2]) / 2;
}

/* Whether a may shadow b: spheres around them, swept along the light. */
static bool may_shadow(const struct lom_placed_cloud *a, const struct lom_placed_cloud *b, const double to_light[3])
{
    const double d[3] = { a->middle.x - b->middle.x, a->middle.y - b->middle.y, a->middle.z - b->middle.z };
    double along = d[0] * to_light[0] + d[1] * to_light[1] + d[2] * to_light[2];
    double square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2] - along * along, reach = radius_of(a) + radius_of(b);
    return along > -reach && square < reach * reach;
}

static uint64_t hash_numbers(uint64_t hash, const double *numbers, size_t count)
{
    return lom_hash_bytes(hash, numbers, count * sizeof *numbers);
}

struct shadowing {
    const struct lom_cloud_set *set;
    const struct lom_placed_cloud *cloud;
    const double *to_light;
    const size_t *others;
    size_t other_count;
};

enum { SHADOW_STEPS = 24 };

static float depth_beyond(void *context, const float exit[3])
{
    const struct shadowing *s = context;
    double world[3] = { s->cloud->middle.x, s->cloud->middle.y, s->cloud->middle.z }, sum = 0;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            world[k] += s->cloud->axes[i][k] * ((double)exit[i] - 0.5) * s->cloud->cloud->size[i];
    for (size_t i = 0; i < s->other_count; i++)
        sum += depth_of(&s->set->clouds[s->others[i]], world, s->to_light, SHADOW_STEPS);
    return (float)sum;
}

/* Voxels get the extinction of their value, before they are filtered; the original is gray. */
static void thin_voxels(lom_image *lit, const lom_transfer_function *transfer)
{
    const size_t size = lom_image_size(lit);
    for (size_t i = 3; i < size; i += 4)
        lit->pixels[i] =
            (uint8_t)lom_count_of((double)lom_transfer_at(transfer, lit->pixels[i] / 255.0f, 3) * 255 + 0.5, 255);
}

/* The original model: gray by its lighting in advance, or white. */
static bool light_in_advance(const struct lom_cloud_set *set, struct lom_placed_cloud *cloud, const double to_light[3],
                             lom_error *error)
{
    double along[3]; /* in voxels: the reference steps by voxels of a cube */
    bool in_advance =
        set->params->original_light == LOM_ORIGINAL_COMBINED || set->params->original_light == LOM_ORIGINAL_ADVANCE;
    to_box(cloud, to_light, false, along);
    lom_image *lit = lom_light_cloud_in_advance(cloud->density->image, along, in_advance ? set->params->lighter : 0,
                                                set->params->dark_light, error);
    if (lit != NULL && cloud->transfer.count > 0)
        thin_voxels(lit, &cloud->transfer);
    lom_volume *original = lit != NULL ? lom_create_volume(lit, error) : NULL;
    lom_free_image(lit);
    if (original == NULL)
        return false;
    lom_free_volume(cloud->original);
    cloud->original = original;
    return true;
}

/* The other models: a grid of light, which the other clouds shadow. */
static bool sweep_sun(const struct lom_cloud_set *set, struct lom_placed_cloud *cloud, struct shadowing *s,
                      lom_error *error)
{
    lom_light_desc desc = { .extinction = (float)(cloud->cloud->extinction * cloud->cloud->density),
                            .beyond = s->other_count != 0 ? depth_beyond : NULL,
                            .context = s };
    for (int i = 0; i < 3; i++) {
        desc.size[i] = (float)cloud->cloud->size[i];
        desc.to_light[i] = (float)(cloud->axes[i][0] * s->to_light[0] + cloud->axes[i][1] * s->to_light[1] +
                                   cloud->axes[i][2] * s->to_light[2]);
    }
    if (set->quality.model == LOM_CLOUDS_FORWARD)
        desc.forward = (float)(set->params->albedo * (set->params->forward > 0 ? set->params->forward : 0));
    return lom_sweep_sun(cloud->light, &desc, error);
}

/* ---- the shadow of something else ---- */

struct shaded_box {
    const struct lom_cloud_shade *shade;
    const struct lom_placed_cloud *cloud;
};

/* In parts of the cloud's box. */
static double shadow_height(const void *context, double x, double z)
{
    const struct shaded_box *box = context;
    const struct lom_placed_cloud *cloud = box->cloud;
    const double *size = cloud->cloud->size, across = (x - 0.5) * size[0], back = (z - 0.5) * size[2];
    const double at_x = cloud->middle.x + across * cloud->axes[0][0] + back * cloud->axes[2][0];
    const double at_z = cloud->middle.z + across * cloud->axes[0][2] + back * cloud->axes[2][2];
    return (box->shade->height(box->shade->context, at_x, at_z) - cloud->middle.y) / size[1] + 0.5;
}

/* Of a voxel, across the shadow's slope: how high it is, and how much that rises along it towards the sun; in parts of the
 * box. */
static double edge_of(const struct lom_placed_cloud *cloud, const double to_light[3])
{
    const lom_light_grid *g = cloud->light;
    const double *size = cloud->cloud->size;
    double along = 0;
    for (int i = 0; i < 3; i += 2) {
        const double way = cloud->axes[i][0] * to_light[0] + cloud->axes[i][2] * to_light[2];
        along += lom_magnitude(way) * size[i] / (i == 0 ? g->width : g->depth);
    }
    const double flat = to_light[0] * to_light[0] + to_light[2] * to_light[2];
    return (size[1] / g->height + (flat > 0 ? along * to_light[1] / flat : 0)) / size[1];
}

/* Whether it reaches up to a voxel of the grid. */
static bool is_shaded(const struct shaded_box *box, double edge)
{
    const lom_light_grid *g = box->cloud->light;
    if (box->shade == NULL || g == NULL || lom_cloud_bounds(box->cloud).low.y >= box->shade->highest)
        return false;
    for (int z = 0; z < g->depth; z++)
        for (int x = 0; x < g->width; x++)
            if (shadow_height(box, (x + 0.5) / g->width, (z + 0.5) / g->depth) + edge / 2 > 0.5 / g->height)
                return true;
    return false;
}

/* ---- all of it ---- */

/* What a cloud's light depends on, and the shadow on it. */
static void find_light(const struct lom_cloud_set *set, size_t index, const double to_light[3],
                       struct lom_cloud_lighting *light)
{
    const struct lom_placed_cloud *cloud = &set->clouds[index];
    const struct shaded_box box = { set->shade, cloud };
    const bool swept_sun = set->quality.model != LOM_CLOUDS_ORIGINAL;
    *light = (struct lom_cloud_lighting){ .hash = hash_numbers(LOM_HASH_START, to_light, 3) };
    for (size_t i = 0; i < set->count && set->params->shadows; i++) {
        const struct lom_placed_cloud *other = &set->clouds[i];
        if (i == index || !may_shadow(other, cloud, to_light))
            continue;
        const double apart[3] = { other->middle.x - cloud->middle.x, other->middle.y - cloud->middle.y,
                                  other->middle.z - cloud->middle.z };
        light->shadow_count++;
        light->hash = hash_numbers(light->hash, apart, 3);
    }
    light->edge = swept_sun && set->shade != NULL ? edge_of(cloud, to_light) : 0;
    light->shaded = swept_sun && is_shaded(&box, light->edge);
    if (light->shaded)
        light->hash = lom_hash_bytes(light->hash, &cloud->middle, sizeof cloud->middle);
    light->hash |= 1;
}

/* The clouds that shadow it, as they were counted; NULL where there are none, or no memory. */
static size_t *list_shadowing(const struct lom_cloud_set *set, size_t index, const double to_light[3], size_t count,
                              lom_error *error)
{
    size_t *others = count != 0 ? lom_allocate(count, sizeof *others, error) : NULL, found = 0;
    for (size_t i = 0; others != NULL && i < set->count; i++)
        if (i != index && may_shadow(&set->clouds[i], &set->clouds[index], to_light))
            others[found++] = i;
    return others;
}

/* Writes a cloud's own light alone, and reads of others what no light changes: clouds are lit side by side. */
static bool make_light(const struct lom_cloud_set *set, size_t index, const double to_light[3],
                       const struct lom_cloud_lighting *light, lom_error *error)
{
    struct lom_placed_cloud *cloud = &set->clouds[index];
    size_t *others = list_shadowing(set, index, to_light, light->shadow_count, error);
    struct shadowing s = { set, cloud, to_light, others, light->shadow_count };
    bool done = others != NULL || light->shadow_count == 0;
    if (done)
        done = set->quality.model != LOM_CLOUDS_ORIGINAL ? sweep_sun(set, cloud, &s, error)
                                                         : light_in_advance(set, cloud, to_light, error);
    lom_release(others);
    if (!done)
        return false;
    const struct shaded_box box = { set->shade, cloud };
    if (light->shaded)
        lom_shade_light_grid(cloud->light, shadow_height, &box, light->edge);
    cloud->lit_for = light->hash;
    return true;
}

bool lom_light_cloud(struct lom_cloud_set *set, size_t index, const double to_light[3], int *swept, lom_error *error)
{
    struct lom_cloud_lighting light;
    if (set->quality.model == LOM_CLOUDS_LAYERS) /* the sheets' light is a picture */
        return lom_update_cloud_gradient(set, error);
    find_light(set, index, to_light, &light);
    set->shaded += light.shaded;
    if (set->clouds[index].lit_for == light.hash)
        return true;
    if (!make_light(set, index, to_light, &light, error))
        return false;
    ++*swept;
    return true;
}

/* What workers light, a cloud each. */
struct lighting {
    struct lom_cloud_set *set;
    const double *to_light;
};

static void make_lights(void *context, size_t first, size_t end)
{
    const struct lighting *l = context;
    for (size_t i = first; i < end; i++)
        if (l->set->clouds[i].lit_for != l->set->lighting[i].hash)
            make_light(l->set, i, l->to_light, &l->set->lighting[i], &l->set->lighting[i].failed);
}

bool lom_light_clouds(struct lom_cloud_set *set, const double to_light[3], lom_device *device, int *swept,
                      lom_error *error)
{
    struct lighting l = { set, to_light };
    *swept = 0;
    if (set->quality.model == LOM_CLOUDS_LAYERS)
        return lom_update_cloud_gradient(set, error);
    for (size_t i = 0; i < set->count; i++) {
        find_light(set, i, to_light, &set->lighting[i]);
        set->shaded += set->lighting[i].shaded;
        *swept += set->clouds[i].lit_for != set->lighting[i].hash;
    }
    if (*swept != 0 && device != NULL)
        lom_share_work(device, set->count, 1, make_lights, &l);
    else if (*swept != 0)
        make_lights(&l, 0, set->count);
    for (size_t i = 0; i < set->count; i++)
        if (!lom_pass_error(&set->lighting[i].failed, error))
            return false;
    return true;
}
