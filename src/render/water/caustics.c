/* Caustics of a frame. In: the waves at its time, the sun, the bed. Out: a texture of the light on the bed, which the
 * shaders of terrain and entities look up below the water's level. Invariant: a function of the whole frame's camera,
 * never of a crop. */
#include "pipeline/check_device.h"
#include "pipeline/renew_texture.h"
#include "pipeline/share_work.h"
#include "render/water/passes.h"
#include "water/caustics.h"

static bool make_targets(lom_renderer *r, int size, lom_error *error)
{
    if (r->water->photons != NULL)
        return true;
    lom_free_gathered_light(&r->water->light);
    if (!lom_make_gathered_light(&r->water->light, size, error))
        return false;
    r->water->photons = lom_make_texture(
        r->device,
        &(lom_texture_desc){ .width = size, .height = size, .label = "photons", .format = LOM_FORMAT_RGBA32F });
    return r->water->photons != NULL;
}

/* The square that is lit: before the eye, its corner on a whole cell so that cells stand still in the world. */
static void place_square(const struct frame *f, double corner[2], double cell)
{
    double size = f->scene->water.optics.caustics_size;
    if (f->parallel) {
        const lom_vec3 middle = lom_middle_on_level(&f->view, f->scene->water.level);
        corner[0] = lom_double_floor((middle.x - size / 2) / cell) * cell;
        corner[1] = lom_double_floor((middle.z - size / 2) / cell) * cell;
        return;
    }
    double x = -f->view.view.m[2][0], z = -f->view.view.m[2][2];
    double flat = lom_double_sqrt(x * x + z * z), ahead = 0.42 * size / (flat > 1e-6 ? flat : 1e-6);
    ahead = flat > 0.3 ? ahead : 0;
    corner[0] = lom_double_floor((f->view.eye.x + ahead * x - size / 2) / cell) * cell;
    corner[1] = lom_double_floor((f->view.eye.z + ahead * z - size / 2) / cell) * cell;
}

static struct lom_photon_uniforms photon_uniforms(const struct frame *f, const double corner[2], double cell)
{
    const lom_terrain *t = &f->scene->terrain;
    const lom_renderer *r = f->renderer;
    struct lom_photon_uniforms u = { .waves = f->waves,
                                     .cell = (float)cell,
                                     .eta = (float)(1 / f->scene->water.optics.index),
                                     .bed = r->water->bed,
                                     .bed_base = (float)(t->base - f->view.eye.y) };
    u.waves.foam_threshold = 0; /* photons read no foam, which is the dearest of what is found with the slopes */
    struct lom_light_uniform light = lom_scene_light(f->scene);
    const int texels[2] = { lom_texture_width(r->water->bed), lom_texture_height(r->water->bed) };
    memcpy(u.to_light, light.to_light, sizeof u.to_light);
    const double eye[2] = { f->view.eye.x, f->view.eye.z };
    for (int i = 0; i < 2; i++) { /* vertices are the texels' centres */
        double step = t->size[i] / (texels[i] - 1);
        u.corner[i] = (float)(corner[i] - eye[i]);
        u.bed_corner[i] = (float)(-t->size[i] / 2 - step / 2 - eye[i]);
        u.bed_scale[i] = (float)(1 / (step * texels[i]));
    }
    return u;
}

static bool draw_photons(struct frame *f, const struct lom_photon_uniforms *u)
{
    lom_renderer *r = f->renderer;
    lom_step *step = lom_add_step(f, "caustics", true, "where the waves send the sunlight on the bed");
    step->width = step->height = lom_texture_width(r->water->photons);
    lom_pass_desc pass = { .color = { r->water->photons }, .label = "photons" };
    const lom_draw_desc draw = { .shader = &lom_photon_shader, .uniforms = u, .count = 3 };
    return lom_draw_pass(r->device, &pass, &draw, 1);
}

static void gather_rows(void *context, size_t first, size_t end)
{
    lom_renderer *r = context;
    lom_gather_photons(&r->water->light, r->water->photons, (int)first, (int)end);
}

/* Rows for each worker, since for each range all photons are looked at. */
static bool gather(lom_renderer *r)
{
    struct lom_gathered_light *light = &r->water->light;
    size_t size = (size_t)light->size, workers = (size_t)lom_describe_device(r->device).threads;
    lom_share_work(r->device, size, (size + workers - 1) / workers, gather_rows, r);
    const lom_texture_desc desc = { .width = light->size,
                                    .height = light->size,
                                    .format = LOM_FORMAT_R32F,
                                    .pixels = light->texel,
                                    .label = "caustics",
                                    .mips = LOM_MIPS_ALL,
                                    .sampler = { .wrap_s = LOM_WRAP_CLAMP, .wrap_t = LOM_WRAP_CLAMP } };
    return lom_renew_texture(r->device, &r->water->caustics, &desc);
}

/* Why there are none; NULL: there are. */
static const char *reason_without(const struct frame *f)
{
    if (!(f->scene->water.optics.caustics > 0))
        return "water.optics.caustics is 0";
    if (f->renderer->water->bed == NULL)
        return "there is no terrain for them to fall on";
    if (!(f->renderer->moment.to_light.y > 0.05))
        return "the sun is too low";
    if (f->waves.trochoid_count == 0 && f->waves.cascade_count == 0)
        return "still water focuses no light";
    return NULL;
}

bool lom_draw_caustics(struct frame *f, lom_error *error)
{
    const lom_water_optics *optics = &f->scene->water.optics;
    const char *reason = reason_without(f);
    if (reason != NULL) {
        lom_add_step(f, "caustics", false, "%s", reason);
        return true;
    }
    double cell = optics->caustics_size / optics->caustics_texels, corner[2];
    if (!make_targets(f->renderer, optics->caustics_texels, error))
        return false;
    place_square(f, corner, cell);
    struct lom_photon_uniforms u = photon_uniforms(f, corner, cell);
    if (!draw_photons(f, &u) || !gather(f->renderer))
        return false;
    double pixel_angle = 2 / f->view.projection.m[1][1] / f->height;
    f->view.caustics = (struct lom_caustics){ .map = f->renderer->water->caustics,
                                              .corner = { corner[0], corner[1] },
                                              .size = optics->caustics_size,
                                              .level = f->scene->water.level,
                                              .strength = optics->caustics,
                                              .fade = optics->caustics_size / 150,
                                              .lod_scale = 1.5 * pixel_angle / cell };
    return true;
}
