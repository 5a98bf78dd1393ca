/* The clouds of a scene, loaded. In: the [[cloud]] tables. Out: a medium for each different volume, a grid of light for
 * each cloud, the noise and the jitter they share; what a set that was loaded before has of it is taken from there.
 * Invariant: clouds of one kind, seed and size of volume share one density. */
#include "base/pass_error.h"
#include "cloud/cloud_draw.h"
#include "cloud/cloud_layers.h"
#include "cloud/cloud_sprites.h"
#include "cloud/detail_noise.h"
#include "pipeline/share_work.h"

#include <string.h>

void lom_free_cloud_set(struct lom_cloud_set *set)
{
    if (set == NULL)
        return;
    for (size_t i = 0; i < set->density_count; i++) {
        lom_free_image(set->densities[i].image);
        lom_free_medium(set->densities[i].medium);
    }
    for (size_t i = 0; i < set->count; i++) {
        lom_free_light_grid(set->clouds[i].light);
        lom_free_volume(set->clouds[i].original);
        lom_free_cloud_sprites(set->clouds[i].sprites);
        lom_free_cloud_sheet(set->clouds[i].sheet);
    }
    for (int i = 0; i < LOM_DETAIL_FIELDS; i++)
        lom_free_image(set->fields[i]);
    lom_free_detail(set->detail);
    lom_free_texture(set->picture);
    lom_free_texture(set->fine);
    lom_free_texture(set->gradient);
    lom_release(set->jitter);
    lom_release(set->densities);
    lom_release(set->clouds);
    lom_release(set->order);
    lom_release(set->sorting);
    lom_release(set->lighting);
    lom_release(set);
}

static bool is_same_density(const lom_cloud *a, const lom_cloud *b)
{
    if (memcmp(a->voxels, b->voxels, sizeof a->voxels) != 0)
        return false;
    if (a->file != NULL || b->file != NULL)
        return a->file != NULL && b->file != NULL && strcmp(a->file, b->file) == 0;
    return a->seed == b->seed && lom_find_cloud_kind(a->kind, NULL) == lom_find_cloud_kind(b->kind, NULL);
}

static lom_image *load_image(const lom_cloud *cloud, lom_error *error)
{
    const int size[3] = { lom_int_of(cloud->voxels[0]), lom_int_of(cloud->voxels[1]), lom_int_of(cloud->voxels[2]) };
    if (cloud->file != NULL)
        return lom_read_volume(cloud->file, size, error);
    return lom_make_cloud(&(lom_cloud_desc){ cloud->kind, size[0], size[1], size[2], (uint64_t)cloud->seed }, error);
}

static struct lom_cloud_density *held_density(const struct lom_cloud_set *set, const lom_cloud *cloud)
{
    for (size_t i = 0; set != NULL && i < set->density_count; i++)
        if (is_same_density(set->densities[i].source, cloud))
            return &set->densities[i];
    return NULL;
}

/* What workers make of a set, a density or a light each, and what became of them. */
struct making {
    struct lom_cloud_set *set;
    lom_error *failed;
};

/* By all workers of the device; NULL: by the caller. The first that failed counts. */
static bool make_all(struct lom_cloud_set *set, size_t count, lom_device *device, lom_range_work *work,
                     lom_error *error)
{
    struct making m = { set, lom_allocate(count, sizeof *m.failed, error) };
    bool done = m.failed != NULL;
    if (done && device != NULL)
        lom_share_work(device, count, 1, work, &m);
    else if (done)
        work(&m, 0, count);
    for (size_t i = 0; done && i < count; i++)
        done = lom_pass_error(&m.failed[i], error);
    lom_release(m.failed);
    return done;
}

static void make_densities(void *context, size_t first, size_t end)
{
    const struct making *m = context;
    for (size_t i = first; i < end; i++) {
        struct lom_cloud_density *density = &m->set->densities[i];
        if (density->image != NULL)
            continue;
        density->image = load_image(density->source, &m->failed[i]);
        if (density->image != NULL)
            density->medium = lom_create_medium(density->image, &m->failed[i]);
    }
}

/* Each different one, or that of the set before. */
static bool load_densities(struct lom_cloud_set *set, const struct lom_cloud_set *before, const lom_cloud *clouds,
                           size_t count, lom_device *device, lom_error *error)
{
    for (size_t i = 0; i < count; i++) {
        if (!clouds[i].visible || held_density(set, &clouds[i]) != NULL)
            continue;
        const struct lom_cloud_density *shared = held_density(before, &clouds[i]);
        struct lom_cloud_density *density = &set->densities[set->density_count++];
        if (shared != NULL)
            *density = *shared;
        density->source = &clouds[i];
    }
    return make_all(set, set->density_count, device, make_densities, error);
}

/* What marching makes of a density on average: the mean of the noise eats into it, and a transfer function thins it. */
static void fill_erosion(const struct lom_cloud_set *set, const struct lom_placed_cloud *placed, float eroded[256])
{
    double eaten = set->detail->mean * placed->cloud->detail;
    for (int i = 0; i < 256; i++) {
        double left = (i / 255.0 - eaten) / (1 - eaten);
        eroded[i] = left > 0 ? (float)left : 0;
        if (placed->transfer.count > 0)
            eroded[i] = lom_transfer_at(&placed->transfer, eroded[i], 3);
    }
}

static float extinction_of(const lom_cloud *cloud)
{
    return (float)(cloud->extinction * cloud->density);
}

static bool holds_light(const struct lom_cloud_set *set, const lom_light_grid *light)
{
    for (size_t i = 0; i < set->count; i++)
        if (set->clouds[i].light == light)
            return true;
    return false;
}

static bool is_same_transfer(const lom_cloud *a, const lom_cloud *b)
{
    bool same = a->transfer_count == b->transfer_count;
    for (size_t i = 0; same && i < a->transfer_count; i++)
        same = a->transfer[i].value == b->transfer[i].value && a->transfer[i].extinction == b->transfer[i].extinction;
    return same;
}

/* The light of a cloud of the set before that has the same density, size and thickness, unless another cloud has taken
 * it; NULL: there is none. */
static lom_light_grid *share_light(const struct lom_cloud_set *set, const struct lom_cloud_set *before,
                                   const struct lom_placed_cloud *placed)
{
    const lom_cloud *cloud = placed->cloud;
    for (size_t i = 0; before != NULL && i < before->count; i++) {
        const struct lom_placed_cloud *other = &before->clouds[i];
        const lom_cloud *source = other->cloud;
        if (other->density->image == placed->density->image && source->detail == cloud->detail &&
            extinction_of(source) == extinction_of(cloud) &&
            memcmp(source->size, cloud->size, sizeof cloud->size) == 0 && is_same_transfer(source, cloud) &&
            before->quality.light_scale == set->quality.light_scale && !holds_light(set, other->light))
            return other->light;
    }
    return NULL;
}

static void make_light(const struct lom_cloud_set *set, struct lom_placed_cloud *placed, lom_error *error)
{
    const lom_cloud *cloud = placed->cloud;
    float eroded[256];
    fill_erosion(set, placed, eroded);
    placed->light = lom_create_light_grid(placed->density->image, set->quality.light_scale, eroded, error);
    if (placed->light == NULL)
        return;
    const float size[3] = { (float)cloud->size[0], (float)cloud->size[1], (float)cloud->size[2] };
    lom_sweep_sky(placed->light, size, extinction_of(cloud));
}

static void make_lights(void *context, size_t first, size_t end)
{
    const struct making *m = context;
    for (size_t i = first; i < end; i++)
        if (m->set->clouds[i].light == NULL)
            make_light(m->set, &m->set->clouds[i], &m->failed[i]);
}

size_t lom_cloud_transfer_points(const lom_cloud *cloud, lom_transfer_point points[LOM_MAX_TRANSFER])
{
    size_t count = cloud->transfer_count < LOM_MAX_TRANSFER ? cloud->transfer_count : LOM_MAX_TRANSFER;
    for (size_t i = 0; i < count; i++) {
        const lom_cloud_transfer *from = &cloud->transfer[i];
        points[i] =
            (lom_transfer_point){ from->value, from->extinction, { from->color[0], from->color[1], from->color[2] } };
    }
    return count;
}

static bool make_transfer(struct lom_placed_cloud *placed, lom_error *error)
{
    lom_transfer_point points[LOM_MAX_TRANSFER];
    size_t count = lom_cloud_transfer_points(placed->cloud, points);
    return count == 0 || lom_make_transfer_function(points, count, &placed->transfer, error);
}

static bool place_cloud(struct lom_cloud_set *set, const struct lom_cloud_set *before, const lom_cloud *cloud,
                        lom_error *error)
{
    struct lom_placed_cloud *placed = &set->clouds[set->count++];
    double s = lom_double_sin(cloud->yaw), c = lom_double_cos(cloud->yaw);
    *placed = (struct lom_placed_cloud){ .cloud = cloud,
                                         .middle = cloud->position,
                                         .detail = cloud->detail,
                                         .axes = { { c, 0, -s }, { 0, 1, 0 }, { s, 0, c } } };
    placed->middle.y += cloud->size[1] / 2;
    placed->density = held_density(set, cloud);
    placed->light = share_light(set, before, placed);
    return make_transfer(placed, error);
}

/* What the model shows of it in place of its volume. */
static bool make_pictures(const struct lom_cloud_set *set, struct lom_placed_cloud *placed, lom_error *error)
{
    if (set->quality.model == LOM_CLOUDS_LAYERS) {
        placed->sheet = lom_make_cloud_sheet(placed, error);
        return placed->sheet != NULL;
    }
    if (lom_has_cloud_sprites(set->quality.model))
        placed->sprites = lom_make_cloud_sprites(placed, set->quality.model, set->mean_opacity, error);
    return placed->sprites != NULL || !lom_has_cloud_sprites(set->quality.model);
}

static bool load_clouds(struct lom_cloud_set *set, const struct lom_cloud_set *before, const lom_cloud *clouds,
                        size_t count, lom_device *device, lom_error *error)
{
    bool done = load_densities(set, before, clouds, count, device, error);
    for (size_t i = 0; done && i < count; i++)
        if (clouds[i].visible)
            done = place_cloud(set, before, &clouds[i], error);
    done = done && make_all(set, set->count, device, make_lights, error);
    for (size_t i = 0; done && i < set->count; i++)
        done = make_pictures(set, &set->clouds[i], error);
    return done;
}

/* The mean of a picture's last channel, in parts of 255. */
static double mean_of(const lom_image *picture, size_t channels)
{
    uint64_t sum = 0;
    const size_t size = lom_image_size(picture);
    for (size_t i = channels - 1; i < size; i += channels)
        sum += picture->pixels[i];
    return (double)sum / (255.0 * (double)(size / channels));
}

/* A texture of a picture, which is freed; NULL where there is none. */
static lom_texture *hold_picture(const struct lom_cloud_set *set, lom_image *made, lom_wrap wrap, double *mean,
                                 lom_error *error)
{
    if (made == NULL)
        return NULL;
    lom_texture_desc desc = { .width = made->width,
                              .height = made->height,
                              .format = made->format,
                              .pixels = made->pixels,
                              .mips = LOM_MIPS_ALL,
                              .sampler = { .wrap_s = wrap, .wrap_t = wrap, .filtering = set->quality.filtering } };
    *mean = mean_of(made, made->format == LOM_FORMAT_R8 ? 1 : 4);
    lom_texture *texture = lom_create_texture(&desc, error);
    lom_free_image(made);
    return texture;
}

static bool load_pictures(struct lom_cloud_set *set, lom_error *error)
{
    if (set->quality.model != LOM_CLOUDS_LAYERS) {
        bool is_puff = set->quality.model == LOM_CLOUDS_SPRITES;
        lom_image *made = is_puff ? lom_make_cloud_puff(64, 1, error) : lom_make_cloud_picture(256, 1, error);
        set->picture = hold_picture(set, made, LOM_WRAP_CLAMP, &set->mean_opacity, error);
        return set->picture != NULL;
    }
    set->picture = hold_picture(set, lom_make_cloud_noise(256, 1, error), LOM_WRAP_REPEAT, &set->mean_opacity, error);
    if (set->picture != NULL)
        set->fine = hold_picture(set, lom_make_cloud_noise(256, 2, error), LOM_WRAP_REPEAT, &set->mean_fine, error);
    return set->fine != NULL;
}

/* What all clouds share is the same for every scene; but `detail` that shapes in a crossfade have left. */
static bool load_shared(struct lom_cloud_set *set, const struct lom_cloud_set *before, lom_error *error)
{
    static const struct lom_cloud_set none = { .count = 0 };
    const struct lom_cloud_set *from = before != NULL ? before : &none;
    int fields = set->params->evolve > 0 ? LOM_DETAIL_FIELDS : 1;
    for (int i = 0; i < fields; i++) {
        set->fields[i] = from->fields[i] != NULL ? from->fields[i] : lom_make_detail_noise(i, error);
        if (set->fields[i] == NULL)
            return false;
    }
    set->detail = from->detail != NULL && from->phase == 0 ? from->detail : lom_create_detail(set->fields[0], error);
    if (set->detail == NULL)
        return false;
    if (set->quality.model == LOM_CLOUDS_BILLBOARD || set->quality.model == LOM_CLOUDS_LAYERS ||
        lom_has_cloud_sprites(set->quality.model)) {
        if (from->quality.model == set->quality.model) {
            set->picture = from->picture;
            set->mean_opacity = from->mean_opacity;
            set->fine = from->fine;
            set->mean_fine = from->mean_fine;
        }
        if (set->picture == NULL && !load_pictures(set, error))
            return false;
    }
    if (set->quality.jitter)
        set->jitter = from->jitter != NULL ? from->jitter : lom_make_blue_noise(LOM_BLUE_NOISE, 1, error);
    return set->jitter != NULL || !set->quality.jitter;
}

static void part_densities(const struct lom_cloud_set *owner, struct lom_cloud_set *other)
{
    for (size_t i = 0; i < other->density_count; i++)
        for (size_t k = 0; k < owner->density_count; k++)
            if (other->densities[i].image == owner->densities[k].image) {
                other->densities[i].image = NULL;
                other->densities[i].medium = NULL;
                break;
            }
}

void lom_part_cloud_sets(const struct lom_cloud_set *owner, struct lom_cloud_set *other)
{
    if (owner == NULL || other == NULL)
        return;
    part_densities(owner, other);
    for (size_t i = 0; i < other->count; i++)
        if (holds_light(owner, other->clouds[i].light))
            other->clouds[i].light = NULL;
    for (int i = 0; i < LOM_DETAIL_FIELDS; i++)
        if (other->fields[i] == owner->fields[i])
            other->fields[i] = NULL;
    other->detail = other->detail == owner->detail ? NULL : other->detail;
    other->picture = other->picture == owner->picture ? NULL : other->picture;
    other->fine = other->fine == owner->fine ? NULL : other->fine;
    other->jitter = other->jitter == owner->jitter ? NULL : other->jitter;
}

bool lom_load_cloud_set(const lom_cloud *clouds, size_t count, const lom_clouds *params,
                        const struct lom_cloud_quality *quality, const struct lom_cloud_set *before, lom_device *device,
                        struct lom_cloud_set **loaded, lom_error *error)
{
    size_t visible = 0;
    *loaded = NULL;
    for (size_t i = 0; i < count; i++)
        visible += clouds[i].visible;
    if (visible == 0 || quality->model == LOM_CLOUDS_OFF)
        return true;
    struct lom_cloud_set *set = lom_allocate(1, sizeof *set, error);
    if (set == NULL)
        return false;
    *set = (struct lom_cloud_set){ .params = params, .quality = *quality };
    set->densities = lom_allocate(visible, sizeof *set->densities, error);
    set->clouds = lom_allocate(visible, sizeof *set->clouds, error);
    set->order = lom_allocate(visible, sizeof *set->order, error);
    set->sorting = lom_allocate(visible, 3 * sizeof *set->sorting, error);
    set->lighting = lom_allocate(visible, sizeof *set->lighting, error);
    bool done = set->densities != NULL && set->clouds != NULL && set->order != NULL && set->sorting != NULL &&
                set->lighting != NULL && load_shared(set, before, error) &&
                load_clouds(set, before, clouds, count, device, error);
    if (done) {
        *loaded = set;
        return true;
    }
    lom_part_cloud_sets(before, set);
    lom_free_cloud_set(set);
    return false;
}
