/* The pictures that a scene names, each a texture once. */
#ifndef LOM_RENDER_TEXTURES_H
#define LOM_RENDER_TEXTURES_H

#include <lom/render.h>
#include <lom/texture.h>

struct lom_cached_texture {
    const char *path; /* the scene's or the world's */
    bool color;
    lom_texture *texture; /* the device's */
};

struct lom_texture_cache {
    struct lom_cached_texture *items;
    size_t count, capacity;
};

/* The texture of a picture of the world, which is then released; loaded once. color: it holds colours (sRGB-encoded
 * unless the scene's transfer is naive). */
lom_texture *lom_load_texture(lom_renderer *renderer, const char *path, bool color, lom_error *error);
void lom_free_textures(lom_renderer *renderer);

#endif
