/* Clouds by impostors. In: the clouds of the set, an eye, what the frames of the run before left. Out: plates, made
 * anew where the rule says so and shown the farthest first. Invariant: which plates are made anew, and from where,
 * follows from the places of eye, sun and clouds in the frames of the run; not from crops, tiles, threads or lanes. */
#include "pipeline/check_device.h"
#include "pipeline/share_work.h"
#include "cloud/impostor_draw.h"
#include "render/frame.h"

static const double around_on = 0.25, around_off = 0.3; /* distance to the box in parts of its longest side */
static const double small_on = 1, small_off = 1.25;     /* extent in pixels */
static const double least_texel =
    0.7; /* of a plate, in parts of the finest grain: more than two a period of anything */

void lom_free_impostors(lom_renderer *renderer)
{
    struct lom_impostors *state = &renderer->clouds.impostors;
    for (int e = 0; e < 2; e++) {
        for (size_t i = 0; state->of_eye[e] != NULL && i < renderer->clouds.set->count; i++)
            for (int part = 0; part < 2; part++) {
                lom_release_texture(renderer->device, state->of_eye[e][i].marched[part]);
                lom_release_texture(renderer->device, state->of_eye[e][i].magnified[part]);
            }
        lom_release(state->of_eye[e]);
    }
    lom_release(state->suns);
}

void lom_end_impostor_run(lom_renderer *renderer)
{
    renderer->clouds.impostors.width = 0; /* which no frame has */
}

void lom_interrupt_impostor_run(lom_renderer *renderer)
{
    renderer->clouds.impostors.frame = -2; /* which is before no frame's number */
}

static double angle_between(const double a[3], const double b[3])
{
    double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    double half = lom_double_sqrt(x * x + y * y + z * z) / 2;
    return 2 * lom_double_asin(half < 1 ? half : 1);
}

/* Whether the light has left what a cloud's plates were made for: the sun by more than the allowance, a colour by more
 * than a 30th. */
static bool has_light_moved(const struct lom_cloud_sun *sun, const struct lom_moment *moment)
{
    const lom_light *light = &moment->scene.light;
    const double to_light[3] = { moment->to_light.x, moment->to_light.y, moment->to_light.z };
    bool is_other = angle_between(to_light, sun->to_light) > sun->allowance;
    for (int i = 0; i < 3; i++) {
        double color = light->color[i] * light->intensity, change = color - sun->color[i];
        is_other |= (change < 0 ? -change : change) > color / 30;
    }
    return is_other;
}

/* Which sun each cloud is lit by. Cloud i of n gets its first new one after (i + 1) / n of the allowance, so that they
 * are not all made anew in one frame. */
static bool follow_sun(struct frame *f, lom_error *error)
{
    struct lom_impostors *state = &f->renderer->clouds.impostors;
    const struct lom_moment *moment = &f->renderer->moment;
    const lom_light *light = &moment->scene.light;
    size_t count = f->renderer->clouds.set->count;
    if (state->suns == NULL)
        state->suns = lom_allocate(count, sizeof *state->suns, error);
    for (size_t i = 0; state->suns != NULL && i < count; i++) {
        struct lom_cloud_sun *sun = &state->suns[i];
        if (state->continues && !has_light_moved(sun, moment))
            continue;
        double whole = f->scene->quality.impostor.sun, part = (double)(i + 1) / (double)count;
        *sun = (struct lom_cloud_sun){ { moment->to_light.x, moment->to_light.y, moment->to_light.z },
                                       .allowance = state->continues ? whole : whole * part };
        for (int k = 0; k < 3; k++)
            sun->color[k] = light->color[k] * light->intensity;
    }
    return state->suns != NULL;
}

bool lom_has_plates(const struct frame *f)
{
    return f->scene->quality.impostors != LOM_IMPOSTORS_OFF && !f->parallel && f->shown == NULL;
}

bool lom_begin_impostors(struct frame *f, lom_error *error)
{
    struct lom_impostors *state = &f->renderer->clouds.impostors;
    if (f->parallel && f->shown == NULL)
        lom_end_impostor_run(f->renderer);
    if (!lom_has_plates(f) || f->renderer->clouds.set == NULL)
        return true;
    state->swept = 0;
    state->frames++;
    state->continues =
        state->width == f->width && state->height == f->height && (f->desc->continues || state->frame + 1 == f->number);
    state->frame = f->number;
    state->width = f->width;
    state->height = f->height;
    for (int e = 0; e < 2 && !state->continues; e++)
        for (size_t i = 0; state->of_eye[e] != NULL && i < f->renderer->clouds.set->count; i++) {
            struct lom_impostor *impostor = &state->of_eye[e][i];
            impostor->is_made = impostor->is_small = impostor->is_around = false;
        }
    return follow_sun(f, error);
}

/* What the decisions about one cloud share. */
struct looking {
    struct frame *f;
    const lom_impostor_dials *dials;
    bool is_reference;
    struct lom_impostor_eye eye;
    struct lom_cloud_view seen; /* by which plates are marched and shown */
    double phase;               /* of the clouds' shapes */
    bool has_aircraft;          /* the camera follows it from behind: a plate whose cloud it is in is split */
    lom_vec3 aircraft;          /* in the world */
    int width, height;          /* of the picture */
    struct lom_impostor *all;
    const size_t *order; /* clouds in view, the farthest first */
};

static struct lom_impostor_eye eye_of(const struct lom_scene_view *view, const struct lom_cloud_view *seen, int height)
{
    const double(*m)[4] = view->view.m;
    return (struct lom_impostor_eye){ .right = { m[0][0], m[0][1], m[0][2] },
                                      .up = { m[1][0], m[1][1], m[1][2] },
                                      .forward = { -m[2][0], -m[2][1], -m[2][2] },
                                      .near_plane = seen->near_plane,
                                      .tangent = { 1 / view->projection.m[0][0], 1 / view->projection.m[1][1] },
                                      .pixel = seen->pixel_angle,
                                      .height = height };
}

static double longest_side(const struct lom_placed_cloud *cloud)
{
    const double *size = cloud->cloud->size;
    double longest = size[0] > size[1] ? size[0] : size[1];
    return size[2] > longest ? size[2] : longest;
}

/* From the eye (less the middle) to the cloud's box; 0 inside. */
static double distance_to_box(const struct lom_placed_cloud *cloud, lom_vec3 eye)
{
    double sum = 0;
    for (int i = 0; i < 3; i++) {
        double along = cloud->axes[i][0] * eye.x + cloud->axes[i][1] * eye.y + cloud->axes[i][2] * eye.z;
        double beyond = (along < 0 ? -along : along) - cloud->cloud->size[i] / 2;
        sum += beyond > 0 ? beyond * beyond : 0;
    }
    return lom_double_sqrt(sum);
}

/* Metres of the finest thing a cloud's density holds: a voxel of its volume, or of the noise that eats into it. */
static double finest_grain(const struct looking *l, const struct lom_placed_cloud *cloud)
{
    const lom_medium *m = cloud->density->medium;
    const double *size = cloud->cloud->size, noise = l->f->renderer->clouds.set->detail->size;
    const double voxel[3] = { size[0] / m->width, size[1] / m->height, size[2] / m->depth };
    double finest = cloud->detail > 0 ? cloud->cloud->detail_size / noise : voxel[0];
    for (int i = 0; i < 3; i++)
        finest = voxel[i] < finest ? voxel[i] : finest;
    return finest;
}

static bool make_plate(const struct looking *l, const struct lom_placed_cloud *cloud, const lom_vec3 corner[8],
                       lom_vec3 eye, struct lom_plate *plate)
{
    const lom_impostor_dials *d = l->dials;
    if (l->is_reference) {
        bool done = lom_make_reference_plate(corner, eye, &l->eye, d->largest_reference, plate);
        if (done && !d->lod)
            plate->width = plate->height = d->largest_reference;
        return done;
    }
    return lom_make_facing_plate(corner, eye, &l->eye, d->lod ? d->scale : 1e9,
                                 d->lod ? least_texel * finest_grain(l, cloud) : 0, d->largest, plate);
}

/* Whether a plate is so small that the cloud is not drawn. */
static bool is_small(const struct looking *l, const struct lom_impostor *impostor, const struct lom_plate *plate)
{
    if (l->is_reference)
        return l->dials->lod && plate->width <= l->dials->smallest;
    return lom_switch(impostor->is_small, plate->extent, small_on, small_off);
}

static const struct lom_cloud_sun *sun_of(const struct looking *l, const struct lom_placed_cloud *cloud)
{
    return &l->f->renderer->clouds.impostors.suns[cloud - l->f->renderer->clouds.set->clouds];
}

/* How far, in pixels, the edges of a cloud have moved by their change of shape: a whole crossfade moves them by as much
 * of a cell of the noise (a quarter of its repetition) as the noise eats of the cloud. */
static double shape_error(const struct looking *l, const struct lom_impostor *impostor,
                          const struct lom_placed_cloud *cloud, lom_vec3 eye)
{
    double changed = l->phase - impostor->phase;
    double most = cloud->cloud->detail * (1 + l->f->scene->clouds.swell) * cloud->cloud->detail_size / 4;
    return (changed < 0 ? -changed : changed) * most / (lom_vec3_length(eye) * l->eye.pixel);
}

static enum lom_refresh why_refresh(const struct looking *l, const struct lom_impostor *impostor,
                                    const struct lom_placed_cloud *cloud, const lom_vec3 corner[8], lom_vec3 eye)
{
    const double *sun = sun_of(l, cloud)->to_light;
    if (!impostor->is_made)
        return LOM_REFRESH_FIRST;
    if (impostor->is_around)
        return LOM_REFRESH_NEAR;
    if (impostor->sun[0] != sun[0] || impostor->sun[1] != sun[1] || impostor->sun[2] != sun[2])
        return LOM_REFRESH_SUN;
    if (shape_error(l, impostor, cloud, eye) > l->dials->bound)
        return LOM_REFRESH_SHAPE;
    return l->is_reference ? lom_reference_refresh(&impostor->plate, eye, &l->eye, longest_side(cloud))
                           : lom_bounded_refresh(&impostor->plate, corner, eye, &l->eye, l->dials->bound);
}

/* A target of this size in *texture, which is kept when it has it. */
static bool provide_target(lom_device *device, lom_texture **texture, int width, int height)
{
    if (*texture != NULL && lom_texture_width(*texture) == width && lom_texture_height(*texture) == height)
        return true;
    lom_release_texture(device, *texture);
    *texture = lom_make_texture(
        device, &(lom_texture_desc){ .width = width,
                                     .height = height,
                                     .label = "plate of a cloud",
                                     .format = LOM_FORMAT_RGBA16F,
                                     .sampler = { .wrap_s = LOM_WRAP_CLAMP, .wrap_t = LOM_WRAP_CLAMP } });
    return *texture != NULL;
}

/* Part 0 is all of the cloud, or what lies beyond the cut; part 1 what lies before it. */
static void set_slice(struct lom_cloud_view *seen, const struct lom_impostor *impostor, int part)
{
    seen->is_sliced = impostor->parts == 2;
    seen->slice_axis = impostor->plate.forward;
    seen->slice_from = part == 0 ? impostor->cut : 0;
    seen->slice_to = part == 0 ? 1e30 : impostor->cut;
}

static bool refresh(const struct looking *l, struct lom_impostor *impostor, const struct lom_placed_cloud *cloud,
                    lom_error *error)
{
    lom_renderer *r = l->f->renderer;
    const struct lom_cloud_sun *sun = sun_of(l, cloud);
    if (!lom_light_cloud(r->clouds.set, (size_t)(cloud - r->clouds.set->clouds), sun->to_light,
                         &r->clouds.impostors.swept, error))
        return false;
    const struct lom_plate *plate = &impostor->plate;
    bool magnifies = l->dials->two_pass && plate->pitch > 1.25, done = true;
    for (int part = 0; done && part < impostor->parts; part++) {
        struct lom_cloud_view seen = l->seen;
        set_slice(&seen, impostor, part);
        for (int i = 0; i < 3; i++) {
            seen.light.to_light[i] = (float)sun->to_light[i];
            seen.light.color[i] = (float)sun->color[i];
        }
        lom_texture **marched = &impostor->marched[part], **magnified = &impostor->magnified[part];
        done = provide_target(r->device, marched, plate->width, plate->height) &&
               lom_draw_plate(r->device, r->clouds.set, cloud, &seen, plate, *marched);
        if (done && magnifies)
            done = provide_target(r->device, magnified, 2 * plate->width, 2 * plate->height) &&
                   lom_magnify_plate(r->device, *marched, *magnified);
        if (done && !magnifies) {
            lom_release_texture(r->device, *magnified);
            *magnified = NULL;
        }
    }
    for (int i = 0; i < 3; i++)
        impostor->sun[i] = sun->to_light[i];
    impostor->phase = l->phase;
    impostor->made_in = l->f->renderer->clouds.impostors.frames;
    impostor->is_made = done;
    return done;
}

/* Where a plate is cut: at the aircraft, when it is in the cloud. The number of parts. */
static int find_cut(const struct looking *l, const struct lom_plate *plate, const struct lom_placed_cloud *cloud,
                    double *cut)
{
    if (!l->has_aircraft || distance_to_box(cloud, lom_vec3_subtract(l->aircraft, cloud->middle)) > 0)
        return 1;
    *cut = lom_vec3_dot(lom_vec3_subtract(l->aircraft, l->seen.eye), plate->forward);
    return *cut > l->eye.near_plane ? 2 : 1;
}

/* Whether the cloud is drawn, whether it is about the eye, what plate it has then, and whether that is to be made. */
static void decide(const struct looking *l, struct lom_impostor *impostor, const struct lom_placed_cloud *cloud)
{
    lom_vec3 corner[8], eye = lom_vec3_subtract(l->seen.eye, cloud->middle);
    struct lom_plate *plate = &impostor->wanted;
    lom_cloud_corners(cloud, corner);
    bool was_around = impostor->is_around, fits = make_plate(l, cloud, corner, eye, plate);
    double away = distance_to_box(cloud, eye) / longest_side(cloud);
    impostor->is_around =
        !fits || away == 0 || (!l->is_reference && lom_switch(was_around, away, around_on, around_off));
    impostor->is_small = !impostor->is_around && is_small(l, impostor, plate);
    impostor->is_due = false;
    if (impostor->is_small)
        return;
    if (was_around != impostor->is_around)
        impostor->is_made = false;
    if (impostor->is_around)
        lom_make_screen_plate(eye, &l->eye, l->dials->inside_scale, l->width, l->height, plate);
    impostor->wanted_parts = find_cut(l, plate, cloud, &impostor->wanted_cut);
    bool is_whole = impostor->wanted_parts == 1 && impostor->parts == 1; /* a cut moves with the aircraft */
    impostor->is_due = !is_whole || why_refresh(l, impostor, cloud, corner, eye) != LOM_REFRESH_NONE;
}

static void decide_some(void *context, size_t first, size_t end)
{
    const struct looking *l = context;
    for (size_t i = first; i < end; i++)
        decide(l, &l->all[l->order[i]], &l->f->renderer->clouds.set->clouds[l->order[i]]);
}

/* Brings one cloud's plate up to date, which is decided. False: the device failed. */
static bool update(const struct looking *l, struct lom_impostor *impostor, const struct lom_placed_cloud *cloud,
                   lom_error *error)
{
    lom_impostor_counters *counts = l->f->impostors;
    const bool is_drawn = !impostor->is_small;
    counts->skipped += !is_drawn;
    counts->plates += is_drawn;
    counts->split += is_drawn && impostor->wanted_parts == 2;
    counts->reused += is_drawn && !impostor->is_due;
    if (!impostor->is_due)
        return true;
    impostor->plate = impostor->wanted;
    impostor->parts = impostor->wanted_parts;
    impostor->cut = impostor->wanted_cut;
    counts->refreshed++;
    return refresh(l, impostor, cloud, error);
}

static void show(const struct looking *l, const struct lom_impostor *impostor, const struct lom_placed_cloud *cloud)
{
    double distance = lom_vec3_length(lom_vec3_subtract(l->seen.eye, cloud->middle));
    double misting = l->dials->misting ? lom_misting(distance, longest_side(cloud)) : 1;
    uint64_t frames = l->f->renderer->clouds.impostors.frames - impostor->made_in;
    int age = frames < INT32_MAX ? (int)frames : INT32_MAX;
    for (int part = 0; part < impostor->parts; part++) {
        struct lom_cloud_view seen = l->seen;
        set_slice(&seen, impostor, part);
        const lom_texture *picture =
            impostor->magnified[part] != NULL ? impostor->magnified[part] : impostor->marched[part];
        lom_show_plate(l->f->renderer->device, cloud, &seen, &impostor->plate, picture, misting, age);
    }
}

static struct lom_impostor *provide_impostors(lom_renderer *r, bool mirrored, lom_error *error)
{
    struct lom_impostor **all = &r->clouds.impostors.of_eye[mirrored];
    if (*all == NULL)
        *all = lom_allocate(r->clouds.set->count, sizeof **all, error);
    return *all;
}

bool lom_draw_impostors(struct frame *f, const struct lom_scene_view *view, const struct lom_cloud_view *seen,
                        const lom_pass_desc *pass, size_t *count, lom_error *error)
{
    lom_renderer *r = f->renderer;
    int width = pass->frame_width != 0 ? pass->frame_width : lom_texture_width(pass->color[0]);
    int height = pass->frame_height != 0 ? pass->frame_height : lom_texture_height(pass->color[0]);
    struct looking l = { .f = f,
                         .dials = &f->scene->quality.impostor,
                         .is_reference = f->scene->quality.impostors == LOM_IMPOSTORS_REFERENCE,
                         .eye = eye_of(view, seen, height),
                         .seen = *seen,
                         .phase = lom_cloud_phase_at(&f->scene->clouds, f->time),
                         .width = width,
                         .height = height };
    const lom_camera *camera = &f->scene->camera;
    if (camera->followed != 0 && camera->person == LOM_PERSON_THIRD && !view->mirrored) {
        l.has_aircraft = true;
        l.aircraft = lom_scene_entity_at(&f->scene->entities[camera->followed - 1], f->time).position;
    }
    enum { SOME = 4 }; /* clouds that a worker decides about at a time: some 10 000 instructions each */
    size_t *order = r->clouds.set->order;
    struct lom_impostor *all = provide_impostors(r, view->mirrored, error);
    bool done = all != NULL;
    l.all = all;
    l.order = order;
    *count = done ? lom_order_clouds(r->clouds.set, seen, l.dials->culling, order) : 0;
    f->impostors->culled += done ? (int)(r->clouds.set->count - *count) : 0;
    lom_share_work(r->device, *count, SOME, decide_some, &l);
    for (size_t i = 0; done && i < *count; i++)
        done = update(&l, &all[order[i]], &r->clouds.set->clouds[order[i]], error);
    if (done && *count != 0) {
        lom_begin_pass(r->device, pass);
        for (size_t i = 0; i < *count; i++)
            if (!all[order[i]].is_small)
                show(&l, &all[order[i]], &r->clouds.set->clouds[order[i]]);
        lom_end_pass(r->device);
    }
    return lom_check_device(r->device, error) && done;
}
