/* Files of a scene that are read before they are asked for, by whoever has workers. */
#ifndef LOM_WORLD_FILES_H
#define LOM_WORLD_FILES_H

#include <lom/scene.h>

/* A picture, or a mesh; NULL: not read, taken, or not to be read. */
struct lom_file_ahead {
    const char *path; /* the scene's */
    bool is_mesh;
    lom_image *image;
    lom_mesh *mesh;
};

struct lom_files {
    struct lom_file_ahead *items;
    size_t count, capacity;
};

/* Adds the files that a renderer reads of a scene, each once: height map, meshes, maps of terrain, water and entities, faces
 * of the sky. They are not opened yet. */
bool lom_list_files(struct lom_files *files, const lom_scene *scene, lom_error *error);
/* Reads some of a struct lom_files. What fails is left to who asks for it, who reads it again and says why. */
void lom_read_files(void *files, size_t first, size_t end);
void lom_free_files(struct lom_files *files);

/* What lom_read_image and lom_read_obj return of the path, from these files where they have it; the caller's. files may be
 * NULL. */
lom_image *lom_take_image(struct lom_files *files, const char *path, lom_error *error);
lom_mesh *lom_take_mesh(struct lom_files *files, const char *path, lom_error *error);

#endif
