/* Terrain before anything of a frame is drawn. In: the frame's camera and sun. Out: every block's level of detail, the
 * same for all passes, the picture of all layers, and the shadow that the terrain throws. Invariant: they follow from
 * the whole frame. */
#include "base/numbers.h"
#include "render/frame.h"
#include "render/seen.h"

static bool make_shadow(lom_renderer *renderer, lom_vec3 to_light, lom_error *error)
{
    struct lom_ground *ground = &renderer->ground;
    int width = ground->columns + 1, height = ground->rows + 1;
    const double direction[3] = { to_light.x, to_light.y, to_light.z };
    lom_free_ground_shadow(ground);
    float *shadow = lom_allocate((size_t)width * (size_t)height, sizeof *shadow, error);
    if (shadow != NULL) {
        lom_find_ground_shadow(renderer->device, ground->heights, width, height, renderer->scene->terrain.size,
                               direction, shadow);
        ground->shadow = lom_create_texture(
            &(lom_texture_desc){
                .width = width,
                .height = height,
                .format = LOM_FORMAT_R32F,
                .pixels = shadow,
                .label = "terrain shadow",
                .sampler = { .wrap_s = LOM_WRAP_BORDER, .wrap_t = LOM_WRAP_BORDER, .border = { -1e30f } } },
            error);
    }
    ground->shadow_heights = shadow;
    ground->shadowed_from = to_light;
    return ground->shadow != NULL;
}

/* Whether the frame may show something that the terrain's shadow falls on. */
static bool shows_receiver(const struct frame *f)
{
    const lom_renderer *r = f->renderer;
    const struct lom_seen seen = lom_find_seen(f);
    bool shows = f->scene->spray_count != 0 || lom_terrain_shades_clouds(f) || f->scene->other_water_count != 0 ||
                 lom_may_show_water(f);
    for (int i = 0; !shows && i < r->ground.across * r->ground.down; i++)
        shows = lom_may_show(&seen, r->ground.blocks[i].bounds);
    for (size_t i = 0; !shows && i < r->entities.count; i++)
        shows = lom_may_show(&seen, r->entities.items[i].at->bounds);
    return shows;
}

static bool cast_shadow(struct frame *f, lom_error *error)
{
    struct lom_ground *ground = &f->renderer->ground;
    const lom_vec3 to_light = f->renderer->moment.to_light, made = ground->shadowed_from;
    if (!f->scene->quality.terrain_shadows) {
        lom_add_step(f, "terrain shadow", false, "quality.terrain_shadows is off");
        return true;
    }
    if (ground->shadow != NULL && made.x == to_light.x && made.y == to_light.y && made.z == to_light.z) {
        lom_add_step(f, "terrain shadow", false, "the sun has not moved");
        return true;
    }
    if (!shows_receiver(f)) {
        lom_add_step(f, "terrain shadow", false, "no ground is in view, nor anything else that it could fall on");
        return true;
    }
    lom_step *step =
        lom_add_step(f, "terrain shadow", true,
                     to_light.y > 0 ? "heights up to which terrain keeps the sun off"
                                    : "the sun is not above the horizon: it shines on nothing of the ground");
    step->width = ground->columns + 1;
    step->height = ground->rows + 1;
    return make_shadow(f->renderer, to_light, error);
}

bool lom_prepare_ground(struct frame *f, lom_error *error)
{
    struct lom_ground *ground = &f->renderer->ground;
    if (ground->blocks == NULL)
        return true;
    if (!lom_compose_ground(f, error))
        return false;
    double scale = f->height * f->view.projection.m[1][1] / 2;
    if (f->parallel) /* a metre may point across the picture and away from it at once */
        scale *= 1 + lom_magnitude(f->camera.shear[0]) + lom_magnitude(f->camera.shear[1]);
    const double pixels = f->scene->quality.terrain_error;
    lom_choose_ground(ground, f->view.eye, scale, pixels, f->parallel);
    ground->eye = f->view.eye;
    ground->parallel = f->parallel;
    ground->errors_allowed = pixels > 0 ? scale / pixels : 1e30;
    return cast_shadow(f, error);
}
