/* What an entity is made of. In: its table in the scene, its mesh with that one's materials. Out: a material for each
 * part of the mesh. Invariant: the entity's own word counts before its mesh's, which counts before the default. */
#include "world/materials.h"

#include "base/pass_error.h"

#include <string.h>

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
static bool find_map(struct lom_world *world, const char *mesh, const char *map, bool is_normals, float bump,
                     const char **kept, lom_error *error)
{
    lom_error unreadable = { .code = LOM_OK };
    char *path = path_beside(mesh, map, error);
    bool done = path != NULL;
    if (done && !(is_normals ? lom_keep_world_normals(world, path, bump, kept, &unreadable)
                             : lom_keep_world_picture(world, path, kept, &unreadable)))
        done = lom_warn_instead(&world->warnings, &unreadable) || lom_pass_error(&unreadable, error);
    lom_release(path);
    return done;
}

/* Whether a picture has a texel that its alpha does not make whole. */
static bool has_alpha(const lom_image *image)
{
    const bool deep = image->format == LOM_FORMAT_RGBA16;
    const size_t samples = 4 * (size_t)image->width * (size_t)image->height;
    const uint8_t *bytes = image->pixels;
    for (size_t i = 3; i < samples; i += 4) {
        uint16_t code = bytes[i];
        if (deep)
            memcpy(&code, bytes + 2 * i, sizeof code);
        if (code != (deep ? UINT16_MAX : UINT8_MAX))
            return true;
    }
    return false;
}

static void widen(double out[3], const float in[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = (double)in[i];
}

/* A mesh's material, but for the maps that the entity has its own of. */
static bool take_base(struct lom_world *world, const char *mesh, const lom_material *base,
                      const lom_scene_material *own, struct lom_world_material *m, lom_error *error)
{
    const float bump = own->has_bump ? (float)own->bump : base->bump;
    const struct {
        const char *own, *map;
        const char **kept;
    } maps[] = { { own->texture, base->diffuse_map, &m->texture },
                 { own->emissive_map, base->emissive_map, &m->emissive_map },
                 { own->specular_map, base->specular_map, &m->specular_map },
                 { own->gloss_map, base->gloss_map, &m->gloss_map },
                 { own->opacity_map, base->opacity_map, &m->opacity_map },
                 { own->normal_map, base->normal_map, &m->normal_map } };
    *m = (struct lom_world_material){ .shininess = (double)base->shininess, .opacity = (double)base->opacity };
    widen(m->ambient, base->ambient);
    widen(m->diffuse, base->diffuse);
    widen(m->specular, base->specular);
    widen(m->emissive, base->emissive);
    for (size_t i = 0; i < sizeof maps / sizeof *maps; i++)
        if (maps[i].own == NULL && maps[i].map[0] != 0 &&
            !find_map(world, mesh, maps[i].map, maps[i].kept == &m->normal_map, bump, maps[i].kept, error))
            return false;
    return true;
}

static void take(double out[3], bool has_own, const double own[3])
{
    for (int i = 0; i < 3 && has_own; i++)
        out[i] = own[i];
}

/* What a table of the scene says, over what is there. The texture's path stays the scene's. */
static bool take_own(struct lom_world *world, const lom_scene_material *own, struct lom_world_material *m,
                     lom_error *error)
{
    take(m->ambient, own->has_ambient, own->ambient);
    take(m->diffuse, own->has_diffuse, own->diffuse);
    take(m->specular, own->has_specular, own->specular);
    take(m->emissive, own->has_emissive, own->emissive);
    m->shininess = own->has_shininess ? own->shininess : m->shininess;
    m->texture = own->texture != NULL ? own->texture : m->texture;
    m->opacity = own->has_opacity ? own->opacity : m->opacity;
    return (own->emissive_map == NULL || lom_keep_world_picture(world, own->emissive_map, &m->emissive_map, error)) &&
           (own->specular_map == NULL || lom_keep_world_picture(world, own->specular_map, &m->specular_map, error)) &&
           (own->opacity_map == NULL || lom_keep_world_picture(world, own->opacity_map, &m->opacity_map, error)) &&
           (own->gloss_map == NULL || lom_keep_world_picture(world, own->gloss_map, &m->gloss_map, error)) &&
           (own->normal_map == NULL ||
            lom_keep_world_normals(world, own->normal_map, own->has_bump ? (float)own->bump : 1, &m->normal_map,
                                   error));
}

/* Where the map of opacity has it. */
static bool look_for_alpha(struct lom_world *world, struct lom_world_material *m, lom_error *error)
{
    const lom_image *image = m->opacity_map == NULL ? NULL : lom_world_picture(world, m->opacity_map, error);
    m->opacity_is_in_alpha = image != NULL && has_alpha(image);
    return m->opacity_map == NULL || image != NULL;
}

bool lom_resolve_materials(struct lom_world *world, struct lom_world_entity *entity, lom_error *error)
{
    const lom_mesh *mesh = entity->mesh;
    const lom_entity *source = entity->entity;
    const size_t parts = lom_mesh_parts(mesh);
    entity->parts = lom_allocate(parts, sizeof *entity->parts, error);
    for (size_t i = 0; entity->parts != NULL && i < parts; i++) {
        const lom_mesh_part *from = &mesh->parts[i];
        struct lom_world_part *part = &entity->parts[i];
        const lom_material base = from->material < 0 ? lom_default_material("") : mesh->materials[from->material];
        part->first = from->first_index;
        part->count = from->index_count;
        if (!take_base(world, source->mesh, &base, &source->material, &part->material, error) ||
            !take_own(world, &source->material, &part->material, error))
            return false;
        part->back = part->material;
        if (!take_own(world, &source->back, &part->back, error) || !look_for_alpha(world, &part->material, error) ||
            !look_for_alpha(world, &part->back, error))
            return false;
    }
    return entity->parts != NULL;
}
