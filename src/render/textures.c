/* Pictures as textures, each loaded once, with the levels that its file has or those made of it. In: pictures of the
 * world. Out: textures of the renderer's device, filtered as the scene's quality says. */
#include "base/reserve.h"
#include "image/texture.h"
#include "pipeline/check_device.h"
#include "render/renderer.h"

#include <string.h>

lom_sampler_desc lom_scene_sampler(const lom_quality *quality)
{
    static const struct {
        lom_filter minify, magnify;
    } filters[] = { [LOM_TEXTURE_TRILINEAR] = { LOM_FILTER_LINEAR_MIPMAP_LINEAR, LOM_FILTER_LINEAR },
                    [LOM_TEXTURE_BILINEAR] = { LOM_FILTER_LINEAR_MIPMAP_NEAREST, LOM_FILTER_LINEAR },
                    [LOM_TEXTURE_NEAREST] = { LOM_FILTER_NEAREST_MIPMAP_NEAREST, LOM_FILTER_NEAREST } };
    lom_filter within = quality->texture_filter == LOM_TEXTURE_NEAREST ? LOM_FILTER_NEAREST : LOM_FILTER_LINEAR;
    return (lom_sampler_desc){ .minify = quality->mipmaps ? filters[quality->texture_filter].minify : within,
                               .magnify = filters[quality->texture_filter].magnify,
                               .anisotropy = quality->anisotropy };
}

/* 8-bit pictures stay 8-bit; deeper ones are sampled as 16-bit. */
static lom_format format_of(const lom_image *image, bool srgb)
{
    return image->format == LOM_FORMAT_RGBA8 && srgb ? LOM_FORMAT_RGBA8_SRGB : image->format;
}

/* The path stays valid with the texture. */
static lom_texture *make_texture(lom_renderer *renderer, const char *path, bool color, lom_error *error)
{
    const lom_scene *scene = renderer->scene;
    const lom_image *image = lom_world_picture(renderer->world, path, error);
    bool srgb = color && scene->output.transfer == LOM_TRANSFER_SRGB;
    if (image == NULL)
        return NULL;
    const void *smaller[LOM_MAX_LEVELS];
    int levels = lom_list_levels(image, smaller);
    lom_mips mips = levels > 1 ? LOM_MIPS_SUPPLIED : LOM_MIPS_ALL;
    lom_texture *texture =
        lom_make_texture(renderer->device, &(lom_texture_desc){ .width = image->width,
                                                                .height = image->height,
                                                                .format = format_of(image, srgb),
                                                                .pixels = image->pixels,
                                                                .label = path,
                                                                .mips = scene->quality.mipmaps ? mips : LOM_MIPS_NONE,
                                                                .level_pixels = smaller,
                                                                .level_count = levels,
                                                                .sampler = lom_scene_sampler(&scene->quality) });
    lom_error failed = { 0 };
    if (!lom_check_device(renderer->device, &failed))
        lom_fail(error, failed.code, "%s: %s", path, failed.text);
    lom_release_world_picture(renderer->world, path);
    return texture;
}

static char *copy_path(const char *path, lom_error *error)
{
    size_t size = strlen(path) + 1;
    char *copy = lom_allocate(size, 1, error);
    return copy != NULL ? memcpy(copy, path, size) : NULL;
}

lom_texture *lom_load_texture(lom_renderer *renderer, const char *path, bool color, lom_error *error)
{
    struct lom_texture_cache *cache = &renderer->textures;
    for (size_t i = 0; i < cache->count; i++)
        if (cache->items[i].color == color && strcmp(cache->items[i].path, path) == 0) {
            cache->items[i].uses++;
            return cache->items[i].texture;
        }
    if (!lom_reserve(&cache->items, &cache->capacity, cache->count + 1, sizeof *cache->items, error))
        return NULL;
    char *copy = copy_path(path, error);
    lom_texture *texture = copy != NULL ? make_texture(renderer, copy, color, error) : NULL;
    if (texture != NULL)
        cache->items[cache->count++] = (struct lom_cached_texture){ copy, color, texture, 1 };
    else
        lom_release(copy);
    return texture;
}

bool lom_drop_texture(lom_renderer *renderer, const lom_texture *texture)
{
    struct lom_texture_cache *cache = &renderer->textures;
    for (size_t i = 0; texture != NULL && i < cache->count; i++) {
        struct lom_cached_texture *item = &cache->items[i];
        if (item->texture != texture)
            continue;
        if (--item->uses == 0) {
            lom_release_texture(renderer->device, item->texture);
            lom_release(item->path);
            *item = cache->items[--cache->count];
        }
        return true;
    }
    return false;
}

void lom_free_textures(lom_renderer *renderer)
{
    for (size_t i = 0; i < renderer->textures.count; i++)
        lom_release(renderer->textures.items[i].path);
    lom_release(renderer->textures.items);
}
