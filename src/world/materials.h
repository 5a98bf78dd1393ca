/* The materials of an entity: its own over its mesh's. */
#ifndef LOM_WORLD_MATERIALS_H
#define LOM_WORLD_MATERIALS_H

#include "world/world.h"

/* Gives the entity its parts, one a part of its mesh. False on failure. */
bool lom_resolve_materials(struct lom_world *world, struct lom_world_entity *entity, lom_error *error);

/* Whether the picture of a file can be had; *kept is then the world's own copy of its path. False with an error. */
bool lom_keep_world_picture(struct lom_world *world, const char *path, const char **kept, lom_error *error);

#endif
