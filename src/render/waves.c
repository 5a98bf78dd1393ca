/* The waves of a scene's water at a time. In: the scene's parameters. Out: what shaders evaluate. */
#include "render/renderer.h"
#include "water/make_foam.h"
#include "water/surface.h"

bool lom_load_waves(lom_renderer *renderer, lom_error *error)
{
    const lom_scene *scene = renderer->scene;
    const lom_water_foam *foam = &scene->water.foam;
    if (scene->water.given == 0 || scene->quality.water < LOM_WATER_NORMAL_MAP ||
        (!(foam->amount > 0) && !(foam->shore_depth > 0)))
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

bool lom_fill_waves(lom_renderer *renderer, struct lom_waves_uniform *out, double time, lom_error *error)
{
    (void)error;
    lom_fill_trochoids(out, &renderer->scene->water, time);
    return true;
}

double lom_wave_height(const lom_renderer *renderer, const struct lom_waves_uniform *waves, double x, double z)
{
    (void)renderer;
    return lom_trochoid_height(waves, x, z);
}
