/* A picture by rays. In: a loaded scene and a frame's description. Out: linear RGB32F. Each pixel is computed from its
 * coordinates in the whole frame alone; threads take rows. */
#include "base/threads.h"
#include "reference/liquids.h"
#include "reference/wave_surface.h"

#include <stdatomic.h>

struct frame {
    lom_reference reference; /* as it was loaded, with what moves, and the waves, of this frame */
    bool placed;             /* what it places is its own */
    lom_reference others[LOM_MAX_OTHER_WATERS];
    struct lom_wave_surface waves[1 + LOM_MAX_OTHER_WATERS];
    struct lom_ray_liquids liquids;
    const lom_reference *inside; /* of the water that the camera is in, or NULL */
    lom_reference_frame desc;
    lom_image *image;
    lom_camera_view camera;
    lom_vec3 eye; /* its */
    lom_mat4 view, projection;
    atomic_int next_row;
};

/* The base-2 radical inverse: the bits of i behind the point, reversed (van der Corput). */
static double radical_inverse(uint32_t i)
{
    uint32_t reversed = 0;
    for (int bit = 0; bit < 32; bit++)
        reversed |= (i >> bit & 1) << (31 - bit);
    return reversed * 0x1p-32;
}

static double fraction(double x)
{
    return x - lom_double_floor(x);
}

/* Where sample i of a pixel lies in it: a Hammersley point, turned by the pixel's own two random numbers (R. Cranley,
 * T. Patterson, SIAM J. Numer. Anal. 13, 1976). */
static void place_sample(const struct frame *f, int x, int y, int i, double *u, double *v)
{
    *u = *v = 0.5;
    if (f->desc.samples == 1)
        return;
    uint64_t pixel = (uint64_t)(uint32_t)y << 32 | (uint32_t)x;
    *u = fraction((i + 0.5) / f->desc.samples + lom_random_uniform(pixel, 0));
    *v = fraction(radical_inverse((uint32_t)i) + lom_random_uniform(pixel, 1));
}

static bool is_under(const struct frame *f, const lom_reference *one, lom_vec3 place)
{
    if (one->waves == NULL)
        return lom_water_above(one, place, f->desc.time) > 0;
    return lom_is_over_water(one, place) && place.y < lom_wave_surface_height(one->waves, place.x, place.z);
}

static const lom_reference *water_around(const struct frame *f, lom_vec3 place)
{
    for (size_t i = 0; i <= f->reference.other_count; i++)
        if (is_under(f, lom_reference_with(&f->reference, i), place))
            return lom_reference_with(&f->reference, i);
    return NULL;
}

/* The ray through a place of the picture in pixels. Each of parallel rays starts at a place of its own, in water or
 * not. */
static lom_vec3 see(const struct frame *f, double x, double y)
{
    struct lom_ray ray;
    lom_ray_through(&f->projection, &f->view, f->eye, 2 * x / f->desc.width - 1, 1 - 2 * y / f->desc.height,
                    &ray.origin, &ray.direction);
    const lom_reference *inside =
        f->camera.projection == LOM_PROJECTION_PERSPECTIVE ? f->inside : water_around(f, ray.origin);
    return lom_radiance_along(&f->reference, ray, f->camera.near_plane * length(ray.direction), f->desc.time,
                              f->desc.depth, inside);
}

static void trace_row(const struct frame *f, int row)
{
    const lom_rect *crop = &f->desc.crop;
    for (int column = 0; column < crop->width; column++) {
        int x = crop->x + column, y = crop->y + row;
        lom_vec3 total = { 0, 0, 0 };
        for (int i = 0; i < f->desc.samples; i++) {
            double u, v;
            place_sample(f, x, y, i, &u, &v);
            total = sum(total, see(f, x + u, y + v));
        }
        total = scaled(total, 1.0 / f->desc.samples);
        float *pixel = lom_image_pixel(f->image, column, row, 0);
        pixel[0] = (float)total.x;
        pixel[1] = (float)total.y;
        pixel[2] = (float)total.z;
    }
}

static void trace_rows(void *context, int worker)
{
    struct frame *f = context;
    (void)worker;
    for (int row = atomic_fetch_add(&f->next_row, 1); row < f->desc.crop.height;
         row = atomic_fetch_add(&f->next_row, 1))
        trace_row(f, row);
}

static bool check_frame(const lom_reference_frame *d, lom_error *error)
{
    const lom_rect *c = &d->crop;
    if (d->width < 1 || d->height < 1 || d->width > LOM_MAX_SIZE || d->height > LOM_MAX_SIZE || c->x < 0 || c->y < 0 ||
        c->width < 1 || c->height < 1 || c->x > d->width - c->width || c->y > d->height - c->height)
        return lom_fail(error, LOM_ERROR_USAGE, "The crop %d,%d,%d,%d does not lie inside the frame of %dx%d pixels.",
                        c->x, c->y, c->width, c->height, d->width, d->height);
    if (d->samples < 1 || d->samples > 65536 || d->depth < 0 || d->depth > 64 || d->threads < 0 ||
        !(d->time - d->time == 0))
        return lom_fail(error, LOM_ERROR_USAGE,
                        "The reference takes 1 to 65536 samples, a depth of 0 to 64 and a finite time, not %d, %d and "
                        "%g.",
                        d->samples, d->depth, d->time);
    return true;
}

/* The light and the entities where they are at the frame's time. */
static bool move(struct frame *f, const lom_reference *loaded, lom_error *error)
{
    f->reference = *loaded;
    f->placed = lom_world_moves(loaded->world);
    return !f->placed || lom_place_reference(&f->reference, f->desc.time, error);
}

/* Where waves are finest: below the eye; where the middle one of parallel rays comes to the water. */
static lom_vec3 middle_of_waves(const struct frame *f, const lom_reference *one)
{
    lom_vec3 origin, ray;
    lom_ray_through(&f->projection, &f->view, f->eye, 0, 0, &origin, &ray);
    double way = ray.y != 0 ? (one->scene->water.level - origin.y) / ray.y : 0;
    bool comes = f->camera.projection != LOM_PROJECTION_PERSPECTIVE && way > 0 && way < f->camera.far_plane;
    return comes ? along(origin, ray, way) : f->eye;
}

static bool add_waves(struct frame *f, lom_reference *one, lom_error *error)
{
    struct lom_wave_surface *waves = &f->waves[one->number];
    if (!lom_make_wave_surface(waves, one, middle_of_waves(f, one), f->desc.time, error))
        return false;
    one->waves = waves->triangles != NULL ? waves : NULL;
    return true;
}

/* The camera and the waters around it, each with its waves. */
static bool look(struct frame *f, lom_error *error)
{
    f->camera = f->desc.camera != NULL ? *f->desc.camera : lom_scene_camera_at(f->reference.scene, f->desc.time);
    f->view = lom_camera_look(&f->camera);
    f->projection = lom_camera_projection(&f->camera, (double)f->desc.width / f->desc.height);
    f->eye = lom_camera_eye(&f->camera);
    if (!lom_make_ray_liquids(&f->liquids, &f->reference, f->desc.time, f->desc.threads, error))
        return false;
    f->reference.liquids = f->liquids.count > 0 ? &f->liquids : NULL;
    f->reference.others = f->others;
    f->reference.other_count = f->reference.own_water ? 0 : f->reference.scene->other_water_count;
    for (size_t i = 1; i <= f->reference.other_count; i++)
        lom_set_other_water(&f->others[i - 1], &f->reference, i);
    if (!add_waves(f, &f->reference, error))
        return false;
    for (size_t i = 0; i < f->reference.other_count; i++)
        if (!add_waves(f, &f->others[i], error))
            return false;
    f->inside = water_around(f, f->eye);
    return true;
}

/* The frame is too large for the stack that a thread may have. */
lom_image *lom_trace_scene(const lom_reference *reference, const lom_reference_frame *desc, lom_error *error)
{
    lom_reference_frame whole = *desc;
    if (whole.crop.width == 0)
        whole.crop = (lom_rect){ 0, 0, desc->width, desc->height };
    struct frame *f = check_frame(&whole, error) ? lom_allocate(1, sizeof *f, error) : NULL;
    if (f == NULL)
        return NULL;
    f->desc = whole;
    lom_float_state state;
    lom_enter_float_state(&state);
    lom_pool *pool = lom_create_pool(desc->threads > 0 ? desc->threads : lom_default_threads(), error);
    if (pool != NULL && move(f, reference, error) && look(f, error))
        f->image = lom_create_image(whole.crop.width, whole.crop.height, 1, LOM_FORMAT_RGB32F, error);
    if (f->image != NULL)
        lom_offer_work(pool, trace_rows, f);
    for (size_t i = 0; i <= LOM_MAX_OTHER_WATERS; i++)
        lom_free_wave_surface(&f->waves[i]);
    lom_free_ray_liquids(&f->liquids);
    if (f->placed)
        lom_free_placed(&f->reference);
    lom_free_pool(pool);
    lom_leave_float_state(&state);
    lom_image *image = f->image;
    lom_release(f);
    return image;
}
