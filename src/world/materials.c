/* What an entity is made of. In: its table in the scene, its mesh with that one's materials. Out: a material for each
 * part of the mesh. Invariant: the entity's own word counts before its mesh's, which counts before the default. */
#include "world/materials.h"

#include "base/pass_error.h"

#include <string.h>

static void take(double out[3], bool has_own, const double own[3], const float base[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = has_own ? own[i] : (double)base[i];
}

/* The path of a map that a mesh's material names: beside the mesh. */
static char *path_beside(const char *mesh, const char *map, lom_error *error)
{
    const char *slash = strrchr(mesh, '/');
    size_t folder = slash == NULL ? 0 : (size_t)(slash - mesh) + 1, size = strlen(map) + 1;
    char *path = lom_allocate(folder + size, 1, error);
    if (path != NULL) {
        memcpy(path, mesh, folder);
        memcpy(path + folder, map, size);
    }
    return path;
}

/* The map of a mesh's material. One that cannot be read is left out with a warning. */
static bool find_map(struct lom_world *world, const char *mesh, const char *map, const char **texture, lom_error *error)
{
    lom_error unreadable = { .code = LOM_OK };
    char *path = path_beside(mesh, map, error);
    bool done = path != NULL && (lom_keep_world_picture(world, path, texture, &unreadable) ||
                                 lom_warn_instead(&world->warnings, &unreadable) || lom_pass_error(&unreadable, error));
    lom_release(path);
    return done;
}

bool lom_resolve_materials(struct lom_world *world, struct lom_world_entity *entity, lom_error *error)
{
    const lom_mesh *mesh = entity->mesh;
    const lom_scene_material *own = &entity->entity->material;
    entity->parts = lom_allocate(mesh->part_count, sizeof *entity->parts, error);
    for (size_t i = 0; entity->parts != NULL && i < mesh->part_count; i++) {
        const lom_mesh_part *part = &mesh->parts[i];
        const lom_material base = part->material < 0 ? lom_default_material("") : mesh->materials[part->material];
        struct lom_world_material *m = &entity->parts[i].material;
        entity->parts[i].first = part->first_index;
        entity->parts[i].count = part->index_count;
        take(m->ambient, own->has_ambient, own->ambient, base.ambient);
        take(m->diffuse, own->has_diffuse, own->diffuse, base.diffuse);
        take(m->specular, own->has_specular, own->specular, base.specular);
        m->shininess = own->has_shininess ? own->shininess : (double)base.shininess;
        m->texture = own->texture;
        if (own->texture == NULL && base.diffuse_map[0] != 0 &&
            !find_map(world, entity->entity->mesh, base.diffuse_map, &m->texture, error))
            return false;
    }
    return entity->parts != NULL;
}
