/* Terrain for drawing. In: the scene's height map and its pictures. Out: its blocks, and the textures that its shaders
 * look up. */
#include "render/renderer.h"

/* The mean over the coarsest level of a texture of colours; no texture is white. */
static bool find_brightness(const lom_texture *texture, float *mean, lom_error *error)
{
    lom_image *level = NULL, *gray = NULL;
    double sum = 0;
    if (texture == NULL)
        return true;
    level = lom_read_texture(texture, lom_texture_levels(texture) - 1, 0, error);
    gray = level == NULL ? NULL : lom_convert_image(level, LOM_FORMAT_R32F, error);
    if (gray != NULL) {
        size_t count = (size_t)gray->width * (size_t)gray->height;
        for (size_t i = 0; i < count; i++)
            sum += (double)((const float *)(const void *)gray->pixels)[i];
        *mean = sum > 1e-3 * (double)count ? (float)(sum / (double)count) : 1e-3f;
    }
    lom_free_image(level);
    lom_free_image(gray);
    return gray != NULL;
}

bool lom_load_ground(lom_renderer *renderer, lom_error *error)
{
    const lom_terrain *t = &renderer->scene->terrain;
    if (!t->present)
        return true;
    lom_image *map = lom_read_image(t->height_map, error);
    if (map == NULL)
        return false;
    const lom_scene *scene = renderer->scene;
    struct lom_ground *ground = &renderer->ground;
    bool done = lom_make_ground_blocks(ground, t, map, &scene->quality, renderer->device, error);
    lom_free_image(map);
    if (done && t->texture != NULL)
        done = lom_load_texture(renderer, t->texture, true, error) != NULL;
    if (done && t->layer_count > LOM_MAX_TERRAIN_LAYERS)
        return lom_fail(error, LOM_ERROR_LIMIT, "%s: a terrain has at most %d layers, and this one has %zu.",
                        renderer->scene->path, LOM_MAX_TERRAIN_LAYERS, t->layer_count);
    const lom_texture *below = done && t->texture != NULL ? lom_load_texture(renderer, t->texture, true, error) : NULL;
    for (size_t i = 0; done && i < t->layer_count; i++) {
        renderer->ground.brightness_below[i] = 1;
        done = t->layers[i].grain == 0 || find_brightness(below, &renderer->ground.brightness_below[i], error);
        below = done ? lom_load_texture(renderer, t->layers[i].map, true, error) : NULL;
        done = below != NULL;
    }
    if (done && t->detail_map != NULL)
        done = lom_load_texture(renderer, t->detail_map, false, error) != NULL;
    if (done && t->normal_map != NULL)
        done = lom_load_texture(renderer, t->normal_map, false, error) != NULL;
    return done;
}

void lom_free_ground(lom_renderer *renderer)
{
    lom_free_ground_blocks(&renderer->ground);
}
