/* What the shaders of water with waves are told. In: a frame. Out: its optics, its sky, its foam, its place and size,
 * as offsets from the eye. */
#include "render/water/surface.h"
#include "scene/scene_light.h"

static void set_rays(float out[3][3], const struct lom_scene_view *view)
{
    const lom_view_rays rays = lom_find_view_rays(&view->projection, &view->view);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            out[i][k] = (float)rays.row[i][k];
}

/* The light that the water sends back is `scatter` of what a white surface would, seen from straight above: there the
 * way down and the way up are 1 + slant metres a metre. */
static void set_medium(struct lom_medium_uniform *medium, const lom_scene *scene)
{
    const lom_water_optics *optics = &scene->water.optics;
    double up = lom_to_light(&scene->light).y, flat = 1 - up * up;
    double refracted = 1 - flat / (optics->index * optics->index);
    double slant = up > 0 ? 1 / lom_double_sqrt(refracted) : 1;
    medium->slant = (float)slant;
    for (int i = 0; i < 3; i++) {
        double sun = scene->light.color[i] * scene->light.intensity * (up > 0 ? up : 0);
        medium->absorption[i] = (float)optics->absorption[i];
        medium->source[i] = (float)(optics->scatter[i] * (sun + scene->light.ambient[i]) * (1 + slant));
    }
}

static void set_foam(struct lom_foam_uniform *foam, const struct frame *f)
{
    const lom_water_foam *params = &f->scene->water.foam;
    double move = f->time / 4;
    foam->pattern = f->renderer->water->foam;
    foam->amount = (float)params->amount;
    foam->shore_depth = (float)params->shore_depth;
    foam->inverse_tile = (float)(1 / params->tile);
    foam->move = (float)(move - lom_double_floor(move));
    const double *middle = f->scene->water.position;
    const double at[2] = { f->view.eye.x - middle[0], f->view.eye.z - middle[1] };
    for (int i = 0; i < 2; i++)
        foam->shift[i] = (float)(at[i] / params->tile - lom_double_floor(at[i] / params->tile));
}

static void set_optics(struct lom_surface_uniforms *u, const lom_scene *scene)
{
    const lom_water_optics *optics = &scene->water.optics;
    u->roughness = (float)optics->roughness;
    u->glitter = (float)optics->glitter;
    u->fresnel = optics->fresnel;
    u->steps = optics->steps;
    u->surface_steps = 96;
    u->bent = lom_water_models[scene->quality.water].bends;
    u->marched = lom_water_models[scene->quality.water].form == LOM_SURFACE_RAYS;
    set_medium(&u->medium, scene);
}

static double farther(double square, lom_vec3 eye, const lom_box *box)
{
    const double low[3] = { box->low.x - eye.x, box->low.y - eye.y, box->low.z - eye.z };
    const double high[3] = { box->high.x - eye.x, box->high.y - eye.y, box->high.z - eye.z };
    double sum = 0;
    for (int i = 0; i < 3; i++)
        sum += low[i] * low[i] > high[i] * high[i] ? low[i] * low[i] : high[i] * high[i];
    return sum > square ? sum : square;
}

/* At the rim of Snell's window a ray is bent by half of what the picture holds, which is made to show all of it: cut off
 * anywhere before that, what stands at the shore ends in teeth. */
double lom_ray_reach(const struct frame *f)
{
    return f->below ? 1 : f->scene->water.optics.reach;
}

/* From the eye to the farthest corner of anything that a ray could meet; from any place of the picture's plane, where
 * parallel rays start. */
static double find_range(const struct frame *f)
{
    const lom_renderer *r = f->renderer;
    double farthest = 0;
    for (int i = 0; i < r->ground.across * r->ground.down; i++)
        farthest = farther(farthest, f->view.eye, &r->ground.blocks[i].bounds);
    for (size_t i = 0; i < r->entities.count; i++)
        farthest = farther(farthest, f->view.eye, &r->entities.items[i].at->bounds);
    const double half = f->parallel ? f->camera.height / 2 * (1 + (double)f->width / f->height) : 0;
    return lom_double_sqrt(farthest) + half;
}

void lom_look_at_surface(struct surface *surface, const struct frame *f)
{
    memset(surface, 0, sizeof *surface);
    struct lom_surface_uniforms *u = &surface->uniforms;
    const lom_water_params *water = &f->scene->water;
    surface->clip_from_offset = lom_clip_from_offset(&f->view.projection, &f->view.view);
    u->clip_from_offset = lom_round_matrix(&surface->clip_from_offset);
    set_optics(u, f->scene);
    u->light = lom_renderer_light(f->renderer, f->view.eye);
    u->entity_shadow = lom_sun_shadow_of(f->renderer, f->view.eye);
    lom_set_sky(&u->sky, f->renderer);
    set_foam(&u->foam, f);
    set_rays(u->ray, &f->view);
    u->waves = f->waves;
    u->side = f->below ? -1 : 1;
    u->reach = (float)lom_ray_reach(f);
    u->eta = (float)(f->below ? f->scene->water.optics.index : 1 / f->scene->water.optics.index);
    u->range = (float)find_range(f);
    u->pixel[0] = 1.0f / (float)f->width;
    u->pixel[1] = 1.0f / (float)f->height;
    u->eye = lom_find_eye(&f->view.projection, &f->view.view, 2 / f->view.projection.m[1][1] / f->height);
    surface->level = water->level - f->view.eye.y;
    for (int i = 0; i < 2; i++) {
        double middle = water->position[i] - (i == 0 ? f->view.eye.x : f->view.eye.z);
        surface->quad[i] = middle - water->size[i] / 2;
        surface->quad[2 + i] = middle + water->size[i] / 2;
    }
    for (int i = 0; i < 4; i++)
        u->quad[i] = (float)surface->quad[i];
}
