/* Terrain for drawing. In: the world's height map and the scene's pictures. Out: its blocks, and the textures that its
 * shaders look up. */
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

/* The texture of a picture in *map; NULL for a NULL path. */
static bool load_map(lom_renderer *renderer, const char *path, bool color, const lom_texture **map, lom_error *error)
{
    *map = path != NULL ? lom_load_texture(renderer, path, color, error) : NULL;
    return path == NULL || *map != NULL;
}

bool lom_load_ground_maps(lom_renderer *renderer, lom_error *error)
{
    const lom_terrain *t = &renderer->scene->terrain;
    struct lom_ground_maps *maps = &renderer->ground_maps;
    if (!t->present)
        return true;
    if (!load_map(renderer, t->texture, true, &maps->base, error))
        return false;
    if (t->layer_count > LOM_MAX_TERRAIN_LAYERS)
        return lom_fail(error, LOM_ERROR_LIMIT, "%s: a terrain has at most %d layers, and this one has %zu.",
                        renderer->scene->path, LOM_MAX_TERRAIN_LAYERS, t->layer_count);
    for (size_t i = 0; i < t->layer_count; i++) {
        const lom_texture *below = i == 0 ? maps->base : maps->layer[i - 1];
        maps->brightness_below[i] = 1;
        if ((t->layers[i].grain != 0 && !find_brightness(below, &maps->brightness_below[i], error)) ||
            !load_map(renderer, t->layers[i].map, true, &maps->layer[i], error))
            return false;
    }
    return load_map(renderer, t->detail_map, false, &maps->detail, error) &&
           load_map(renderer, t->normal_map, false, &maps->normals, error);
}

bool lom_load_ground(lom_renderer *renderer, lom_error *error)
{
    const lom_terrain *t = &renderer->scene->terrain;
    if (!t->present)
        return true;
    const lom_image *map = lom_world_height_map(renderer->world, error);
    return map != NULL && lom_make_ground_blocks(&renderer->ground, t, map, renderer->world->heights,
                                                 &renderer->scene->quality, renderer->device, error);
}

void lom_free_ground_maps(lom_renderer *renderer)
{
    const struct lom_ground_maps *maps = &renderer->ground_maps;
    const lom_texture *const used[] = { maps->base, maps->detail, maps->normals };
    for (size_t i = 0; i < sizeof used / sizeof *used; i++)
        lom_drop_texture(renderer, used[i]);
    for (int i = 0; i < LOM_MAX_TERRAIN_LAYERS; i++)
        lom_drop_texture(renderer, maps->layer[i]);
}

void lom_free_ground(lom_renderer *renderer)
{
    lom_release_texture(renderer->device, renderer->ground.vertex_texture);
    lom_drop_composed_ground(renderer);
    lom_free_ground_blocks(&renderer->ground);
}

void lom_drop_ground_shadow(lom_renderer *renderer)
{
    lom_free_ground_shadow(&renderer->ground);
}

void lom_free_ground_shadow(struct lom_ground *ground)
{
    lom_free_texture(ground->shadow);
    lom_release(ground->shadow_heights);
    ground->shadow = NULL;
    ground->shadow_heights = NULL;
}
