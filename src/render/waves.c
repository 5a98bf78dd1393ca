/* The waves of a scene's water at a time. In: the scene's parameters. Out: what shaders evaluate. */
#include "render/renderer.h"
#include "waves/flow.h"
#include "spray/make_foam.h"
#include "water/surface.h"

enum { FLOW_CELLS = 160 };

/* The depth of water over a grid: the level less the terrain's vertices. */
static void find_depths(const lom_renderer *renderer, double *depth)
{
    const lom_scene *scene = renderer->scene;
    const struct lom_ground *ground = &renderer->ground;
    for (int y = 0; y < FLOW_CELLS; y++)
        for (int x = 0; x < FLOW_CELLS; x++) {
            size_t column = (size_t)(x * ground->columns / (FLOW_CELLS - 1));
            size_t row = (size_t)(y * ground->rows / (FLOW_CELLS - 1));
            size_t vertex = row * ((size_t)ground->columns + 1) + column;
            double bed = ground->heights != NULL ? (double)ground->heights[vertex] : -1e3;
            depth[y * FLOW_CELLS + x] = scene->water.level - bed;
        }
}

static bool load_flow(lom_renderer *renderer, lom_error *error)
{
    const lom_water_waves *waves = &renderer->scene->water.waves;
    if (waves->kind != LOM_WAVES_FLOW || renderer->normal_map == NULL)
        return true;
    double *depth = lom_allocate((size_t)FLOW_CELLS * FLOW_CELLS, sizeof *depth, error);
    if (depth == NULL)
        return false;
    find_depths(renderer, depth);
    lom_image *field = lom_make_flow(depth, FLOW_CELLS, waves->direction, error);
    lom_release(depth);
    if (field == NULL)
        return false;
    renderer->flow = lom_make_texture(
        renderer->device, &(lom_texture_desc){ .width = FLOW_CELLS,
                                               .height = FLOW_CELLS,
                                               .format = LOM_FORMAT_RG32F,
                                               .pixels = field->pixels,
                                               .sampler = { .wrap_s = LOM_WRAP_CLAMP, .wrap_t = LOM_WRAP_CLAMP } });
    lom_free_image(field);
    const lom_error *failed = lom_device_error(renderer->device);
    return renderer->flow != NULL || lom_fail(error, failed->code, "%s", failed->text);
}

static void fill_flow(const lom_renderer *renderer, struct lom_flow_uniform *flow, double time)
{
    const lom_scene *scene = renderer->scene;
    const lom_water_params *water = &scene->water;
    if (renderer->flow == NULL)
        return;
    flow->field = renderer->flow;
    flow->ripples = renderer->normal_map;
    flow->inverse_tile = (float)(1 / water->tile);
    flow->steepness = (float)(1 / water->normal_up);
    for (int i = 0; i < 2; i++) { /* the grid's corners are the middles of its texels */
        double size = scene->terrain.given != 0 ? scene->terrain.size[i] : water->size[i];
        double step = size / (FLOW_CELLS - 1);
        flow->corner[i] = (float)(-size / 2 - step / 2);
        flow->scale[i] = (float)(1 / (step * FLOW_CELLS));
    }
    lom_fill_flow_phases(flow, water->waves.speed, water->tile, time);
}

static bool load_foam(lom_renderer *renderer, lom_error *error)
{
    const lom_water_foam *foam = &renderer->scene->water.foam;
    if (!(foam->amount > 0) && !(foam->shore_depth > 0))
        return true;
    lom_image *pattern = lom_make_foam(256, 1, error);
    if (pattern == NULL)
        return false;
    renderer->foam = lom_make_texture(renderer->device, &(lom_texture_desc){ .width = pattern->width,
                                                                             .height = pattern->height,
                                                                             .format = LOM_FORMAT_R8,
                                                                             .pixels = pattern->pixels,
                                                                             .mips = LOM_MIPS_ALL });
    lom_free_image(pattern);
    const lom_error *failed = lom_device_error(renderer->device);
    return renderer->foam != NULL || lom_fail(error, failed->code, "%s", failed->text);
}

bool lom_load_waves(lom_renderer *renderer, lom_error *error)
{
    const lom_scene *scene = renderer->scene;
    if (scene->water.given == 0 || scene->quality.water < LOM_WATER_NORMAL_MAP)
        return true;
    return load_foam(renderer, error) && load_flow(renderer, error) && lom_load_shallow(renderer, error) &&
           lom_load_surf(renderer, error) && lom_load_sea(renderer, error);
}

void lom_bound_waves(const lom_renderer *renderer, struct lom_waves_uniform *out, double time)
{
    lom_fill_trochoids(out, renderer->scene->water.level, &renderer->scene->water.waves, &renderer->scene->water.foam,
                       time);
    fill_flow(renderer, &out->flow, time);
    lom_bound_shallow(renderer, out);
    lom_add_surf(renderer, out, time);
    lom_bound_sea(renderer, out);
}

bool lom_place_waves(lom_renderer *renderer, struct lom_waves_uniform *out, double time, lom_error *error)
{
    lom_fill_trochoids(out, renderer->scene->water.level, &renderer->scene->water.waves, &renderer->scene->water.foam,
                       time);
    lom_add_surf(renderer, out, time);
    return lom_place_shallow(renderer, out, time, error) && lom_place_sea(renderer, out, time, error);
}

double lom_wave_height(const lom_renderer *renderer, const struct lom_waves_uniform *waves, double x, double z)
{
    double surf = renderer->surf.cells == NULL ? 0 : lom_surf_height(&renderer->surf, &waves->surf, x, z);
    return surf + lom_shallow_height(renderer, x, z) + lom_trochoid_height(waves, x, z) +
           lom_sea_height(renderer, x, z);
}
