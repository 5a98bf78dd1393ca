/* The clouds of a scene before what lies behind them. In: the [[cloud]] tables, rays. Out: the light of each cloud by a
 * random path for each ray, and what it lets through. Clouds are followed one by one from near to far: each scatters
 * the sun, the sky and the ground, and its own light alone. The noise that eats into them is the models' as an asset; of
 * shapes that change it is that of the time 0. */
#include "base/numbers.h"
#include "cloud/cloud_draw.h"
#include "cloud/detail_noise.h"
#include "reference/reference.h"

#include <string.h>

struct lom_ray_cloud {
    const lom_cloud *cloud;
    lom_reference_volume *volume; /* around the origin, its axes the world's turned by the cloud's yaw */
    lom_vec3 middle;              /* before the wind has moved it */
    double sine, cosine;
};

static bool is_same_density(const lom_cloud *a, const lom_cloud *b)
{
    if (a->file != NULL || b->file != NULL)
        return a->file != NULL && b->file != NULL && strcmp(a->file, b->file) == 0 &&
               memcmp(a->voxels, b->voxels, sizeof a->voxels) == 0;
    return a->seed == b->seed && strcmp(a->kind, b->kind) == 0 && memcmp(a->voxels, b->voxels, sizeof a->voxels) == 0;
}

static lom_image *load_density(const lom_cloud *cloud, lom_error *error)
{
    const int size[3] = { lom_int_of(cloud->voxels[0]), lom_int_of(cloud->voxels[1]), lom_int_of(cloud->voxels[2]) };
    if (cloud->file != NULL)
        return lom_read_volume(cloud->file, size, error);
    return lom_make_cloud(&(lom_cloud_desc){ cloud->kind, size[0], size[1], size[2], (uint64_t)cloud->seed }, error);
}

static bool place_cloud(lom_reference *reference, const lom_cloud *cloud, const lom_image *density,
                        const lom_image *noise, lom_error *error)
{
    const lom_clouds *all = &reference->scene->clouds;
    struct lom_ray_cloud *placed = &reference->clouds[reference->cloud_count];
    lom_vec3 half = { cloud->size[0] / 2, cloud->size[1] / 2, cloud->size[2] / 2 };
    *placed = (struct lom_ray_cloud){ .cloud = cloud,
                                      .middle = cloud->position,
                                      .sine = lom_double_sin(cloud->yaw),
                                      .cosine = lom_double_cos(cloud->yaw) };
    placed->middle.y += half.y;
    lom_transfer_point points[LOM_MAX_TRANSFER];
    size_t point_count = lom_cloud_transfer_points(cloud, points);
    placed->volume = lom_create_reference_volume(
        &(lom_reference_volume_desc){ .density = density,
                                      .low = scaled(half, -1),
                                      .high = half,
                                      .extinction = cloud->extinction * cloud->density,
                                      .detail = noise,
                                      .detail_strength = lom_smaller(cloud->detail, 0.999),
                                      .detail_size = cloud->detail_size,
                                      .albedo = { all->albedo, all->albedo, all->albedo },
                                      .phase = { (lom_cloud_phase)all->phase, all->forward, all->backward, all->blend },
                                      .transfer = points,
                                      .transfer_count = point_count,
                                      .look = cloud->look },
        error);
    reference->cloud_count += placed->volume != NULL;
    return placed->volume != NULL;
}

bool lom_load_ray_clouds(lom_reference *reference, lom_error *error)
{
    const lom_scene *scene = reference->scene;
    if (scene->cloud_count == 0 || scene->quality.clouds == LOM_CLOUDS_OFF)
        return true;
    reference->clouds = lom_allocate(scene->cloud_count, sizeof *reference->clouds, error);
    lom_image **images = lom_allocate(scene->cloud_count, sizeof(lom_image *), error);
    lom_image *noise = lom_make_detail_noise(0, error);
    bool done = reference->clouds != NULL && images != NULL && noise != NULL;
    for (size_t i = 0; done && i < scene->cloud_count; i++) {
        size_t owner = 0;
        while (owner < i && (images[owner] == NULL || !is_same_density(&scene->cloud[owner], &scene->cloud[i])))
            owner++;
        if (!scene->cloud[i].visible)
            continue;
        if (owner == i)
            images[i] = load_density(&scene->cloud[i], error);
        done = images[owner] != NULL && place_cloud(reference, &scene->cloud[i], images[owner], noise, error);
    }
    for (size_t i = 0; images != NULL && i < scene->cloud_count; i++)
        lom_free_image(images[i]);
    lom_release(images);
    lom_free_image(noise);
    return done;
}

void lom_free_ray_clouds(lom_reference *reference)
{
    for (size_t i = 0; i < reference->cloud_count; i++)
        lom_free_reference_volume(reference->clouds[i].volume);
    lom_release(reference->clouds);
}

/* ---- rays ---- */

/* A direction in a cloud's own axes: x runs along (cosine, 0, -sine), z along (sine, 0, cosine). */
static lom_vec3 turned(const struct lom_ray_cloud *cloud, lom_vec3 v)
{
    return (lom_vec3){ cloud->cosine * v.x - cloud->sine * v.z, v.y, cloud->sine * v.x + cloud->cosine * v.z };
}

static lom_vec3 middle_at(const lom_reference *reference, const struct lom_ray_cloud *cloud, double time)
{
    return sum(cloud->middle, lom_cloud_way(&reference->scene->clouds, cloud->cloud, time));
}

static struct lom_ray into_cloud(const lom_reference *reference, const struct lom_ray_cloud *cloud,
                                 const struct lom_ray *ray, double time)
{
    return (struct lom_ray){ turned(cloud, difference(ray->origin, middle_at(reference, cloud, time))),
                             turned(cloud, ray->direction) };
}

/* Where a cloud is, for what shines on it. */
struct lit_cloud {
    const lom_reference *reference;
    const struct lom_ray_cloud *cloud;
    lom_vec3 middle;
};

static lom_vec3 surroundings(const void *context, lom_vec3 direction)
{
    const lom_clouds *all = &((const struct lit_cloud *)context)->reference->scene->clouds;
    const double *c = direction.y > 0 ? all->sky : all->ground;
    return (lom_vec3){ c[0], c[1], c[2] };
}

/* What terrain leaves of the sun at a place in the cloud's own axes. */
static double sun_share(const void *context, lom_vec3 place)
{
    const struct lit_cloud *lit = context;
    const struct lom_ray_cloud *c = lit->cloud;
    const lom_vec3 off = { c->cosine * place.x + c->sine * place.z, place.y, c->cosine * place.z - c->sine * place.x };
    return lom_ground_leaves_sun(lit->reference, sum(lit->middle, off));
}

/* What one cloud sends along a ray in its own axes from its entry on, in front of `light`; air in between turns it to
 * the haze. */
static lom_vec3 before(const lom_reference *reference, const struct lom_ray_cloud *cloud, const struct lom_ray *inner,
                       double enter, double far, double time, lom_vec3 light)
{
    const lom_clouds *all = &reference->scene->clouds;
    lom_vec3 sun = scaled(reference->light, lom_pi * all->brightness);
    const struct lit_cloud lit = { reference, cloud, middle_at(reference, cloud, time) };
    lom_reference_light around = { .to_sun = turned(cloud, reference->to_light),
                                   .sun = { sun.x, sun.y, sun.z },
                                   .sun_share = reference->scene->terrain.present ? sun_share : NULL,
                                   .context = &lit,
                                   .surroundings = surroundings };
    lom_volume_rays rays = { inner->origin, inner->direction, far, 1, 1024, LOM_HASH_START };
    rays.key = lom_hash_bytes(rays.key, inner, sizeof *inner);
    lom_volume_light found;
    if (!lom_trace_volume(cloud->volume, &around, &rays, &found, NULL))
        return light;
    double clear = all->haze_distance > 0 ? lom_double_exp(-enter / all->haze_distance) : 1;
    double alpha = (1 - found.transmittance) * (1 - clear);
    const double *haze = all->haze_color, *scattered = found.scattered;
    return (lom_vec3){ light.x * found.transmittance + scattered[0] * clear + haze[0] * alpha,
                       light.y * found.transmittance + scattered[1] * clear + haze[1] * alpha,
                       light.z * found.transmittance + scattered[2] * clear + haze[2] * alpha };
}

/* From far to near: the farthest entry that is nearer than the last one (of equal ones the later cloud comes first). */
lom_vec3 lom_light_through_clouds(const lom_reference *reference, const struct lom_ray *ray, double far, double time,
                                  lom_vec3 light)
{
    double last = __builtin_inf();
    size_t last_index = reference->cloud_count;
    for (;;) {
        double farthest = -1;
        size_t next = reference->cloud_count;
        struct lom_ray inner = *ray;
        for (size_t i = 0; i < reference->cloud_count; i++) {
            struct lom_ray in = into_cloud(reference, &reference->clouds[i], ray, time);
            double enter = 0, leave = far;
            if (lom_cross_volume(reference->clouds[i].volume, in.origin, in.direction, &enter, &leave) &&
                enter >= farthest && (enter < last || (enter == last && i < last_index))) {
                farthest = enter;
                next = i;
                inner = in;
            }
        }
        if (next == reference->cloud_count)
            return light;
        light = before(reference, &reference->clouds[next], &inner, farthest, far, time, light);
        last = farthest;
        last_index = next;
    }
}

double lom_cloud_shadow(const lom_reference *reference, lom_vec3 place, double time)
{
    const lom_clouds *all = &reference->scene->clouds;
    struct lom_ray ray = { place, reference->to_light };
    double depth = 0;
    if (!all->shadows)
        return 1;
    for (size_t i = 0; i < reference->cloud_count; i++) {
        struct lom_ray inner = into_cloud(reference, &reference->clouds[i], &ray, time);
        depth +=
            lom_volume_optical_depth(reference->clouds[i].volume, inner.origin, inner.direction, 0, __builtin_inf());
    }
    return 1 + all->shadow_strength * lom_double_expm1(-depth);
}
