/* Files written piece by piece. In: a path, then bytes. Out: the file that the path leads to, whole, or what it was.
 * Invariant: a regular file is replaced by rename only after its new content reached the disk, so a full disk, a limit
 * or a kill leaves the old content, and a failure leaves no temporary file. Folders are held open and names looked up
 * in them, so no path is too long, and none changes its meaning while the file is written. */
#include "base/system.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum {
    MOST_LINKS = 40,      /* as Linux follows */
    LONGEST_LINK = 65536, /* bytes that a link may hold */
    BLOCK = 65536         /* bytes copied at once */
};

struct lom_writer {
    int descriptor;
    bool borrowed; /* the caller's descriptor, which stays open */
    bool replaces; /* the file of this name in this folder, by a temporary one; else it is written directly */
    int folder;
    char *name;
    lom_temporary *temporary; /* NULL: it has no name */
    bool exists;
    struct stat old; /* of the file that is replaced */
    char *path;      /* for messages */
    bool failed;
};

/* ---- where a path leads ---- */

static char *copy_text(const char *text, size_t length, lom_error *error)
{
    char *copy = lom_allocate(length + 1, 1, error);
    return copy != NULL ? memcpy(copy, text, length) : NULL;
}

/* The number of the descriptor that path names, -1 when it names none. Opening such a path would begin a regular file
 * anew, and fails for a socket. */
static int named_descriptor(const char *path)
{
    static const struct {
        const char *name;
        int number; /* -1: digits follow */
    } names[] = {
        { "-", 1 }, { "/dev/stdout", 1 }, { "/dev/stderr", 2 }, { "/dev/fd/", -1 }, { "/proc/self/fd/", -1 }
    };
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        size_t length = strlen(names[i].name);
        if (names[i].number >= 0 && strcmp(path, names[i].name) == 0)
            return names[i].number;
        if (names[i].number >= 0 || strncmp(path, names[i].name, length) != 0)
            continue;
        int number = 0, digits = 0;
        for (path += length; *path >= '0' && *path <= '9' && digits < 9; path++, digits++)
            number = number * 10 + (*path - '0');
        return *path == 0 && digits > 0 ? number : -1;
    }
    return -1;
}

/* Moves *folder to the folder that the path begins with, and *path to the name behind it. */
static bool enter_folder(int *folder, char **path)
{
    char *slash = strrchr(*path, '/');
    if (slash == NULL && *folder >= 0)
        return true;
    char *name = slash != NULL ? slash + 1 : *path, first = *name;
    *name = 0;
    int next = lom_open_folder(*folder >= 0 ? *folder : AT_FDCWD, slash != NULL ? *path : ".");
    *name = first;
    int reason = errno;
    if (*folder >= 0)
        close(*folder);
    errno = reason;
    *folder = next;
    *path = name;
    return next >= 0;
}

static char *read_link(int folder, const char *name, lom_error *error)
{
    char *text = lom_allocate(LONGEST_LINK, 1, error);
    errno = ENOENT; /* of a link without text */
    if (text != NULL && readlinkat(folder, name, text, LONGEST_LINK - 1) > 0)
        return text;
    lom_release(text);
    return NULL;
}

/* The folder and the name where open(path, O_CREAT) would find or make the file: links are followed, the last one also
 * when what it names is not there yet. */
static bool find_place(lom_writer *w, lom_error *error)
{
    char *text = copy_text(w->path, strlen(w->path), error), *name = text;
    bool found = false;
    errno = ENOENT;
    for (int links = 0; text != NULL && name[0] != 0 && enter_folder(&w->folder, &name); links++) {
        bool is_folder = name[0] == 0 || strcmp(name, ".") == 0 || strcmp(name, "..") == 0;
        errno = EISDIR;
        if (is_folder)
            break;
        w->exists = fstatat(w->folder, name, &w->old, AT_SYMLINK_NOFOLLOW) == 0;
        found = w->exists ? !S_ISLNK(w->old.st_mode) : errno == ENOENT;
        if (found || !w->exists)
            break;
        char *target = links < MOST_LINKS ? read_link(w->folder, name, error) : NULL;
        if (links == MOST_LINKS)
            errno = ELOOP;
        int reason = errno;
        lom_release(text);
        errno = reason;
        text = name = target;
    }
    if (found)
        w->name = copy_text(name, strlen(name), error);
    else if (error == NULL || error->code == LOM_OK)
        lom_fail_system(error, w->path, "create");
    lom_release(text);
    return found && w->name != NULL;
}

/* ---- opening ---- */

static bool open_directly(lom_writer *w, int flags, lom_error *error)
{
    w->descriptor = lom_open_again(AT_FDCWD, w->path, O_WRONLY | O_NOCTTY | O_CLOEXEC | flags);
    return w->descriptor >= 0 || lom_fail_system(error, w->path, "open for writing");
}

/* The file itself, emptied. */
static bool open_in_place(lom_writer *w)
{
    w->descriptor = lom_open_again(w->folder, w->name, O_WRONLY | O_TRUNC | O_NOFOLLOW | O_CLOEXEC);
    return w->descriptor >= 0;
}

static bool open_replacement(lom_writer *w, lom_error *error)
{
    if (w->exists && faccessat(w->folder, w->name, W_OK, AT_EACCESS) != 0)
        return lom_fail_system(error, w->path, "open for writing");
    w->descriptor = lom_create_temporary(w->folder, &w->temporary);
    w->replaces = w->descriptor >= 0;
    if (w->replaces)
        return true;
    bool closed_folder = errno == EACCES || errno == EPERM || errno == EROFS;
    int reason = errno;
    if (w->exists && closed_folder && open_in_place(w))
        return true;
    errno = reason;
    return lom_fail_system(error, w->path, "create a temporary file beside it");
}

static bool open_writer(lom_writer *w, lom_error *error)
{
    struct stat followed;
    int descriptor = named_descriptor(w->path);
    if (descriptor >= 0) {
        w->descriptor = descriptor;
        w->borrowed = true;
        return fcntl(descriptor, F_GETFD) != -1 || lom_fail_system(error, w->path, "open for writing");
    }
    bool there = stat(w->path, &followed) == 0;
    if (!there && errno != ENOENT)
        return lom_fail_system(error, w->path, "open for writing");
    if (there && !S_ISREG(followed.st_mode))
        return open_directly(w, 0, error);
    if (!find_place(w, error))
        return false;
    bool same = w->exists && w->old.st_ino == followed.st_ino && w->old.st_dev == followed.st_dev;
    if (there && !same) /* a link of the system's own, like those in /proc, whose text is no path */
        return open_directly(w, O_TRUNC, error);
    return open_replacement(w, error);
}

static void free_writer(lom_writer *w)
{
    if (w->descriptor >= 0 && !w->borrowed)
        close(w->descriptor);
    lom_release_temporary(w->temporary, true);
    if (w->folder >= 0)
        close(w->folder);
    lom_release(w->path);
    lom_release(w->name);
    lom_release(w);
}

lom_writer *lom_open_writer(const char *path, lom_error *error)
{
    lom_writer *w = lom_allocate(1, sizeof *w, error);
    if (w == NULL)
        return NULL;
    w->descriptor = w->folder = -1;
    w->path = copy_text(path, strlen(path), error);
    if (w->path != NULL && open_writer(w, error))
        return w;
    free_writer(w);
    return NULL;
}

/* ---- writing ---- */

static bool write_all(int descriptor, const uint8_t *data, size_t size)
{
    while (size != 0) {
        ssize_t put = lom_write_quietly(descriptor, data, size < LOM_MOST_A_CALL ? size : LOM_MOST_A_CALL);
        if (put < 0 && lom_call_again(descriptor, POLLOUT))
            continue;
        if (put == 0)
            errno = EIO;
        if (put <= 0)
            return false;
        data += put;
        size -= (size_t)put;
    }
    return true;
}

bool lom_append(lom_writer *w, const void *data, size_t size, lom_error *error)
{
    if (w->failed)
        return false;
    if (w->borrowed && w->descriptor == STDOUT_FILENO)
        fflush(stdout);
    w->failed = !write_all(w->descriptor, data, size);
    bool standard = strcmp(w->path, "-") == 0;
    return !w->failed || lom_fail_system(error, standard ? "standard output" : w->path, "write");
}

/* ---- closing ---- */

/* Some files and file systems cannot flush: then there is nothing to wait for. */
static bool flush(int descriptor)
{
    while (fsync(descriptor) != 0) {
        if (errno == EINVAL || errno == ENOTSUP || errno == EROFS)
            return true;
        if (errno != EINTR)
            return false;
    }
    return true;
}

static bool close_descriptor(lom_writer *w)
{
    int descriptor = w->descriptor;
    w->descriptor = -1;
    return w->borrowed || close(descriptor) == 0 || errno == EINTR; /* Linux has closed it even then */
}

/* A folder that one may write to but not read cannot be flushed: the new name stands all the same. */
static bool flush_folder(int folder)
{
    int descriptor = lom_open_again(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0)
        return true;
    bool flushed = flush(descriptor);
    close(descriptor);
    return flushed;
}

static bool copy_all(int from, int to)
{
    uint8_t *block = lom_allocate(BLOCK, 1, NULL);
    bool done = block != NULL;
    errno = ENOMEM;
    while (done) {
        ssize_t got = read(from, block, BLOCK);
        if (got == 0)
            break;
        done = got > 0 ? write_all(to, block, (size_t)got) : lom_call_again(from, POLLIN);
    }
    int reason = errno;
    lom_release(block);
    errno = reason;
    return done;
}

static bool close_direct(lom_writer *w, lom_error *error)
{
    if (!w->borrowed && !flush(w->descriptor))
        return lom_fail_system(error, w->path, "flush to disk");
    return close_descriptor(w) || lom_fail_system(error, w->path, "close");
}

/* A file that another is mounted upon (EBUSY), as containers do with single files, keeps its place: the finished
 * content is copied into it. */
static bool copy_into_place(lom_writer *w, lom_error *error)
{
    int from = lom_open_again(w->folder, lom_temporary_name(w->temporary), O_RDONLY | O_CLOEXEC);
    bool copied = from >= 0 && open_in_place(w) && copy_all(from, w->descriptor);
    if (!copied)
        lom_fail_system(error, w->path, "copy the finished file to it");
    if (from >= 0)
        close(from);
    return copied && close_direct(w, error);
}

static bool rename_temporary(const lom_writer *w)
{
    int renamed;
    do
        renamed = renameat(w->folder, lom_temporary_name(w->temporary), w->folder, w->name);
    while (renamed != 0 && errno == EINTR);
    return renamed == 0;
}

static bool close_replacement(lom_writer *w, lom_error *error)
{
    if (!flush(w->descriptor))
        return lom_fail_system(error, w->path, "flush to disk");
    if (w->exists && !lom_keep_status(w->descriptor, &w->old))
        return lom_fail_system(error, w->path, "keep its permissions");
    if (w->temporary == NULL)
        w->temporary = lom_name_temporary(w->descriptor, w->folder);
    if (w->temporary == NULL)
        return lom_fail_system(error, w->path, "name the file written for it");
    if (!close_descriptor(w))
        return lom_fail_system(error, w->path, "close");
    if (!rename_temporary(w))
        return errno == EBUSY ? copy_into_place(w, error)
                              : lom_fail_system(error, w->path, "rename the temporary file to it");
    lom_release_temporary(w->temporary, false);
    w->temporary = NULL;
    return flush_folder(w->folder) || lom_fail_system(error, w->path, "flush its folder to disk");
}

bool lom_close_writer(lom_writer *w, lom_error *error)
{
    bool closed = !w->failed && (w->replaces ? close_replacement(w, error) : close_direct(w, error));
    free_writer(w);
    return closed;
}

void lom_abandon_writer(lom_writer *w)
{
    if (w != NULL)
        free_writer(w);
}
