/* The files of a scene, looked at for changes. */
#ifndef LOM_CLI_WATCH_H
#define LOM_CLI_WATCH_H

#include <lom/scene.h>

enum { LOM_MAX_WATCHED = 4096 };

/* The scene file is the first; what they were before they were read. */
struct lom_watched {
    size_t count;
    char *path[LOM_MAX_WATCHED];
    uint64_t facts[LOM_MAX_WATCHED];
};

/* One more, with its facts of now. What lies beyond LOM_MAX_WATCHED is not looked at. */
void lom_watch_file(struct lom_watched *watched, const char *path);
/* Of a scene that has been read: those that were watched before keep their facts, of the others, which have not been
 * read, they are taken now. So a change while files are read or drawn is seen. */
void lom_watch_scene(struct lom_watched *watched, const lom_scene *scene);
/* Takes the facts of now; whether those of a file that the scene names, and not only of the scene file, are others. */
bool lom_look_at_watched(struct lom_watched *watched);
bool lom_has_changed(const struct lom_watched *watched);
/* Whether one that the scene names has, and not only the scene file. */
bool lom_has_named_file_changed(const struct lom_watched *watched);
/* None is watched any more. */
void lom_forget_watched(struct lom_watched *watched);

#endif
