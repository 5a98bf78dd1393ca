/* Whether the files of a scene have changed. In: paths. Out: yes or no. Invariant: what changes after its facts were
 * taken is seen, also a file that goes, comes back or is replaced. */
#include "watch.h"

#include <string.h>
#include <sys/stat.h>

/* A number that changes when the file is written, replaced, removed or comes back. */
static uint64_t facts_of(const char *path)
{
    struct stat s;
    int64_t facts[4] = { -1, -1, -1, -1 };
    if (stat(path, &s) == 0) {
        facts[0] = (int64_t)s.st_mtim.tv_sec;
        facts[1] = (int64_t)s.st_mtim.tv_nsec;
        facts[2] = (int64_t)s.st_size;
        facts[3] = (int64_t)s.st_ino;
    }
    return lom_hash_bytes(LOM_HASH_START, facts, sizeof facts);
}

bool lom_look_at_watched(struct lom_watched *w)
{
    bool named = false;
    for (size_t i = 0; i < w->count; i++) {
        uint64_t facts = facts_of(w->path[i]);
        named |= i > 0 && facts != w->facts[i];
        w->facts[i] = facts;
    }
    return named;
}

static bool has_changed_from(const struct lom_watched *w, size_t i)
{
    while (i < w->count && facts_of(w->path[i]) == w->facts[i])
        i++;
    return i < w->count;
}

bool lom_has_changed(const struct lom_watched *w)
{
    return has_changed_from(w, 0);
}

bool lom_has_named_file_changed(const struct lom_watched *w)
{
    return has_changed_from(w, 1);
}

void lom_watch_file(struct lom_watched *w, const char *path)
{
    size_t size = strlen(path) + 1;
    char *copy = w->count < LOM_MAX_WATCHED ? lom_allocate(size, 1, NULL) : NULL;
    if (copy == NULL)
        return;
    w->facts[w->count] = facts_of(path);
    w->path[w->count++] = memcpy(copy, path, size);
}

/* The files that an OBJ names: its materials and their pictures. */
static void watch_mesh(struct lom_watched *w, const char *path)
{
    lom_bytes paths = lom_list_obj_files(path, NULL);
    for (size_t at = 0; at < paths.size; at += strlen((const char *)paths.data + at) + 1)
        lom_watch_file(w, (const char *)paths.data + at);
    lom_release(paths.data);
}

static bool is_mesh(const lom_scene *scene, const char *path)
{
    for (size_t i = 0; i < scene->entity_count; i++)
        if (scene->entities[i].mesh != NULL && strcmp(scene->entities[i].mesh, path) == 0)
            return true;
    return false;
}

void lom_forget_watched(struct lom_watched *w)
{
    for (size_t i = 0; i < w->count; i++)
        lom_release(w->path[i]);
    w->count = 0;
}

/* Those of the files that both name are as they were before. */
static void keep_facts(struct lom_watched *w, const struct lom_watched *before)
{
    for (size_t i = 0; i < w->count; i++)
        for (size_t k = 0; k < before->count; k++)
            if (strcmp(w->path[i], before->path[k]) == 0) {
                w->facts[i] = before->facts[k];
                break;
            }
}

void lom_watch_scene(struct lom_watched *w, const lom_scene *scene)
{
    size_t count = 0;
    const char *const *files = lom_scene_files(scene, &count);
    struct lom_watched *before = lom_allocate(1, sizeof *before, NULL);
    if (before == NULL)
        return; /* what was watched still is */
    *before = *w;
    w->count = 0;
    for (size_t i = 0; i < count; i++) {
        lom_watch_file(w, files[i]);
        if (is_mesh(scene, files[i]))
            watch_mesh(w, files[i]);
    }
    keep_facts(w, before);
    lom_forget_watched(before);
    lom_release(before);
}
