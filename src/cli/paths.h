/* What a path says about its file. */
#ifndef LOM_CLI_PATHS_H
#define LOM_CLI_PATHS_H

#include <lom/base.h>

/* The letters after the last dot of the last part of path, "" when there is none; points into path. */
const char *lom_path_extension(const char *path);
/* The part of path behind the last slash; points into path. */
const char *lom_path_file(const char *path);
/* Whether the extension of path is the given one (in small letters), whatever the case of path's ASCII letters. */
bool lom_path_is(const char *path, const char *extension);

/* A path as printf makes it, however long; NULL on failure, freed with lom_release. */
char *lom_path_print(lom_error *error, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* The first of the paths that is there, each taken from the folder that the program is in (those that begin with "../"
 * from the one around it); in `path`, NULL where none is. */
const char *lom_path_by_program(const char *const *paths, int count, char path[4096]);

/* Makes the folders that path's file lies in, from the one whose name ends at `root` on, where they are not there. path
 * is as before afterwards. */
bool lom_make_folders(char *path, size_t root, lom_error *error);

#endif
