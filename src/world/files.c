/* Files read ahead. In: a scene's paths. Out: pictures and meshes, to be taken once each. Invariant: what is taken is what
 * reading the file then would have given; who finds nothing here reads it. */
#include "world/files.h"

#include "base/reserve.h"

#include <string.h>

static struct lom_file_ahead *find(const struct lom_files *files, const char *path, bool is_mesh)
{
    for (size_t i = 0; files != NULL && i < files->count; i++)
        if (files->items[i].is_mesh == is_mesh && strcmp(files->items[i].path, path) == 0)
            return &files->items[i];
    return NULL;
}

static bool add(struct lom_files *files, const char *path, bool is_mesh, lom_error *error)
{
    if (path == NULL || find(files, path, is_mesh) != NULL)
        return true;
    if (!lom_reserve(&files->items, &files->capacity, files->count + 1, sizeof *files->items, error))
        return false;
    files->items[files->count++] = (struct lom_file_ahead){ .path = path, .is_mesh = is_mesh };
    return true;
}

static bool add_pictures(struct lom_files *files, const char *const *paths, size_t count, lom_error *error)
{
    bool done = true;
    for (size_t i = 0; done && i < count; i++)
        done = add(files, paths[i], false, error);
    return done;
}

static bool add_terrain(struct lom_files *files, const lom_terrain *t, lom_error *error)
{
    const char *const paths[] = { t->height_map, t->texture, t->detail_map, t->normal_map };
    bool done = !t->present || add_pictures(files, paths, sizeof paths / sizeof *paths, error);
    for (size_t i = 0; done && t->present && i < t->layer_count; i++)
        done = add(files, t->layers[i].map, false, error);
    return done;
}

static bool add_sky(struct lom_files *files, const lom_sky_params *sky, lom_error *error)
{
    if (!sky->present || sky->faces[0] == NULL)
        return true;
    return sky->cube != NULL ? add(files, sky->cube, false, error) : add_pictures(files, sky->faces, 6, error);
}

static bool add_entity(struct lom_files *files, const lom_entity *entity, lom_error *error)
{
    const lom_scene_material *m = &entity->material;
    const char *const paths[] = { m->texture,     m->emissive_map, m->specular_map,
                                  m->opacity_map, m->gloss_map,    m->normal_map };
    return !entity->visible ||
           (add(files, entity->mesh, true, error) && add_pictures(files, paths, sizeof paths / sizeof *paths, error));
}

bool lom_list_files(struct lom_files *files, const lom_scene *scene, lom_error *error)
{
    bool done = add_terrain(files, &scene->terrain, error) && add_sky(files, &scene->sky, error);
    for (size_t i = 0; done && i < scene->entity_count; i++)
        done = add_entity(files, &scene->entities[i], error);
    if (done && scene->water.present && scene->water.normal_map != NULL)
        done = add(files, scene->water.normal_map, false, error) && add(files, scene->water.flow_map, false, error);
    return done;
}

void lom_read_files(void *files, size_t first, size_t end)
{
    struct lom_files *f = files;
    for (size_t i = first; i < end; i++) {
        struct lom_file_ahead *file = &f->items[i];
        lom_error unread = { .code = LOM_OK };
        if (file->is_mesh)
            file->mesh = lom_read_obj(file->path, &unread);
        else
            file->image = lom_read_image(file->path, &unread);
    }
}

lom_image *lom_take_image(struct lom_files *files, const char *path, lom_error *error)
{
    struct lom_file_ahead *file = find(files, path, false);
    lom_image *image = file != NULL ? file->image : NULL;
    if (image == NULL)
        return lom_read_image(path, error);
    file->image = NULL;
    return image;
}

lom_mesh *lom_take_mesh(struct lom_files *files, const char *path, lom_error *error)
{
    struct lom_file_ahead *file = find(files, path, true);
    lom_mesh *mesh = file != NULL ? file->mesh : NULL;
    if (mesh == NULL)
        return lom_read_obj(path, error);
    file->mesh = NULL;
    return mesh;
}

void lom_free_files(struct lom_files *files)
{
    for (size_t i = 0; i < files->count; i++) {
        lom_free_image(files->items[i].image);
        lom_free_mesh(files->items[i].mesh);
    }
    lom_release(files->items);
    *files = (struct lom_files){ .count = 0 };
}
