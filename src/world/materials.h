/* The materials of an entity: its own over its mesh's. */
#ifndef LOM_WORLD_MATERIALS_H
#define LOM_WORLD_MATERIALS_H

#include "world/world.h"

/* Gives the entity its parts, one a part of its mesh. False on failure. */
bool lom_resolve_materials(struct lom_world *world, struct lom_world_entity *entity, lom_error *error);

/* Whether the picture of a file can be had; *kept is then the world's own copy of its path. False with an error. */
bool lom_keep_world_picture(struct lom_world *world, const char *path, const char **kept, lom_error *error);
/* The same of a normal map: where the picture is grey, the normals of its heights are made. */
bool lom_keep_world_normals(struct lom_world *world, const char *path, float bump, const char **kept, lom_error *error);
/* Whether red, green and blue are the same everywhere. */
bool lom_is_grey(const lom_image *image, lom_error *error);
/* Normals (normals.c) as RGBA16, of the red of an image, which repeats: white is bump / 64 of its width above black. NULL on
 * failure. */
lom_image *lom_normals_of_heights(const lom_image *heights, float bump, lom_error *error);

#endif
