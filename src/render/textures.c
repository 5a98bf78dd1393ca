/* Pictures as textures, each loaded once. In: paths. Out: textures of the renderer's device, filtered as the scene's
 * quality says. */
#include "base/reserve.h"
#include "pipeline/check_device.h"
#include "render/renderer.h"

#include <string.h>

static lom_sampler_desc sampler_of(const lom_quality *quality)
{
    static const struct {
        lom_filter minify, magnify;
    } filters[] = { [LOM_TEXTURE_TRILINEAR] = { LOM_FILTER_LINEAR_MIPMAP_LINEAR, LOM_FILTER_LINEAR },
                    [LOM_TEXTURE_BILINEAR] = { LOM_FILTER_LINEAR_MIPMAP_NEAREST, LOM_FILTER_LINEAR },
                    [LOM_TEXTURE_NEAREST] = { LOM_FILTER_NEAREST_MIPMAP_NEAREST, LOM_FILTER_NEAREST } };
    lom_filter within = quality->texture_filter == LOM_TEXTURE_NEAREST ? LOM_FILTER_NEAREST : LOM_FILTER_LINEAR;
    return (lom_sampler_desc){ .minify = quality->mipmaps ? filters[quality->texture_filter].minify : within,
                               .magnify = filters[quality->texture_filter].magnify };
}

/* 8-bit pictures stay 8-bit; deeper ones are sampled as 16-bit. */
static lom_format format_of(const lom_image *image, bool srgb)
{
    if (lom_describe_format(image->format)->bits > 8)
        return LOM_FORMAT_RGBA16;
    return srgb ? LOM_FORMAT_RGBA8_SRGB : LOM_FORMAT_RGBA8;
}

static lom_texture *make_texture(lom_renderer *renderer, const char *path, bool color, lom_error *error)
{
    const lom_scene *scene = renderer->scene;
    lom_image *file = lom_read_image(path, error);
    if (file == NULL)
        return NULL;
    bool deep = lom_describe_format(file->format)->bits > 8;
    lom_image *image = lom_convert_image(file, deep ? LOM_FORMAT_RGBA16 : LOM_FORMAT_RGBA8, error);
    lom_texture *result = NULL;
    bool srgb = color && scene->output.transfer == LOM_TRANSFER_SRGB;
    if (image != NULL) {
        result = lom_make_texture(renderer->device,
                                  &(lom_texture_desc){ .width = image->width,
                                                       .height = image->height,
                                                       .format = format_of(image, srgb),
                                                       .pixels = image->pixels,
                                                       .mips = scene->quality.mipmaps ? LOM_MIPS_ALL : LOM_MIPS_NONE,
                                                       .sampler = sampler_of(&scene->quality) });
        lom_error failed = { 0 };
        if (!lom_check_device(renderer->device, &failed))
            lom_fail(error, failed.code, "%s: %s", path, failed.text);
    }
    lom_free_image(image);
    lom_free_image(file);
    return result;
}

/* The path belongs to the renderer from here on. */
static const char *keep_path(lom_renderer *renderer, const char *path, lom_error *error)
{
    size_t size = strlen(path) + 1;
    char *copy = lom_allocate(size, 1, error);
    if (copy == NULL || !lom_reserve(&renderer->textures.paths, &renderer->textures.path_capacity,
                                     renderer->textures.path_count + 1, sizeof *renderer->textures.paths, error)) {
        lom_release(copy);
        return NULL;
    }
    renderer->textures.paths[renderer->textures.path_count++] = copy;
    return memcpy(copy, path, size);
}

lom_texture *lom_find_texture(const lom_renderer *renderer, const char *path, bool color)
{
    for (size_t i = 0; path != NULL && i < renderer->textures.count; i++)
        if (renderer->textures.items[i].color == color && strcmp(renderer->textures.items[i].path, path) == 0)
            return renderer->textures.items[i].texture;
    return NULL;
}

lom_texture *lom_load_texture(lom_renderer *renderer, const char *path, bool color, lom_error *error)
{
    lom_texture *found = lom_find_texture(renderer, path, color);
    if (found != NULL)
        return found;
    if (!lom_reserve(&renderer->textures.items, &renderer->textures.capacity, renderer->textures.count + 1,
                     sizeof *renderer->textures.items, error))
        return NULL;
    const char *kept = keep_path(renderer, path, error);
    lom_texture *texture = kept == NULL ? NULL : make_texture(renderer, path, color, error);
    if (texture != NULL)
        renderer->textures.items[renderer->textures.count++] = (struct lom_cached_texture){ kept, color, texture };
    return texture;
}

void lom_free_textures(lom_renderer *renderer)
{
    struct lom_texture_cache *cache = &renderer->textures;
    for (size_t i = 0; i < cache->path_count; i++)
        lom_release(cache->paths[i]);
    lom_release(cache->paths);
    lom_release(cache->items);
}
