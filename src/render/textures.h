/* The pictures that a scene names, each a texture once. */
#ifndef LOM_RENDER_TEXTURES_H
#define LOM_RENDER_TEXTURES_H

#include <lom/render.h>
#include <lom/texture.h>

struct lom_cached_texture {
    char *path;
    bool color;
    lom_texture *texture; /* the device's */
    size_t uses;          /* by how many of what the rooms have loaded */
};

struct lom_texture_cache {
    struct lom_cached_texture *items;
    size_t count, capacity;
};

/* How textures of pictures are sampled, repeated. */
lom_sampler_desc lom_scene_sampler(const lom_quality *quality);
/* The texture of a picture of the world, which is then released; loaded once. color: it holds colours (sRGB-encoded
 * unless the scene's transfer is naive). Each call is one use, until lom_drop_texture. */
lom_texture *lom_load_texture(lom_renderer *renderer, const char *path, bool color, lom_error *error);
/* Ends one use of a texture, which is released after its last one. False, and nothing else, for a texture that did not
 * come from lom_load_texture, and for NULL. */
bool lom_drop_texture(lom_renderer *renderer, const lom_texture *texture);
void lom_free_textures(lom_renderer *renderer);

#endif
