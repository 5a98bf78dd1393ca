/* What a path says about its file. In: a path. Out: parts of it. Invariant: letters are compared as ASCII, whatever the
 * locale says. */
#include "paths.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

const char *lom_path_file(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash != NULL ? slash + 1 : path;
}

const char *lom_path_extension(const char *path)
{
    const char *file = lom_path_file(path), *dot = strrchr(file, '.');
    return dot != NULL ? dot + 1 : "";
}

bool lom_path_is(const char *path, const char *extension)
{
    const char *p = lom_path_extension(path);
    for (; *p != 0 && *extension != 0; p++, extension++)
        if ((*p >= 'A' && *p <= 'Z' ? *p - 'A' + 'a' : *p) != *extension)
            return false;
    return *p == *extension;
}

char *lom_path_print(lom_error *error, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(NULL, 0, format, arguments);
    va_end(arguments);
    char *path = length >= 0 ? lom_allocate((size_t)length + 1, 1, error) : NULL;
    if (path == NULL)
        return NULL;
    va_start(arguments, format);
    vsnprintf(path, (size_t)length + 1, format, arguments);
    va_end(arguments);
    return path;
}

const char *lom_path_by_program(const char *const *paths, int count, char path[4096])
{
    char program[3800];
    ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    for (int i = 0; i < count && length > 0; i++) {
        int above = strncmp(paths[i], "../", 3) == 0 ? 1 : 0;
        ssize_t folder = length;
        for (int up = 0; up <= above; up++) /* the program's name, then the folder that it is in */
            while (folder > 0 && program[--folder] != '/') {
            }
        snprintf(path, 4096, "%.*s/%.200s", (int)folder, program, paths[i] + 3 * above);
        if (access(path, R_OK) == 0)
            return path;
    }
    return NULL;
}

bool lom_make_folders(char *path, size_t root, lom_error *error)
{
    for (size_t i = root; path[i] != '\0'; i++) {
        if (path[i] != '/' || i == 0)
            continue;
        path[i] = '\0';
        bool made = mkdir(path, 0777) == 0 || errno == EEXIST;
        int reason = errno;
        if (!made)
            lom_fail(error, LOM_ERROR_FILE, "%s: %s.", path, strerror(reason));
        path[i] = '/';
        if (!made)
            return false;
    }
    return true;
}
