/* The system's calls on files, replaced: each can be made to fail, to give less than was asked for, or to be
 * interrupted. And a folder of the test's own. */
#ifndef LOM_TESTS_FILE_CALLS_H
#define LOM_TESTS_FILE_CALLS_H

#include <lom/base.h>

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

static struct {
    bool write, fsync, close, chmod; /* fail with ENOSPC, EIO, EIO, EPERM */
    bool takes_nothing;              /* what is written: 0 bytes a call */
    int rename, create;              /* fail with this error */
    bool named;                      /* there are no files without names */
    bool unnameable;                 /* there are, but no /proc that would give them one */
    bool shorten;                    /* at most 7 bytes a call, every third one interrupted */
    atomic_int calls, fsyncs;
} inject;

static inline bool interrupts(void)
{
    int call = atomic_fetch_add(&inject.calls, 1);
    return inject.shorten && call % 3 == 2;
}

static inline int give_up(int reason)
{
    errno = reason;
    return -1;
}

ssize_t write(int descriptor, const void *data, size_t size)
{
    if (inject.write || interrupts())
        return give_up(inject.write ? ENOSPC : EINTR);
    if (inject.takes_nothing)
        return 0;
    return syscall(SYS_write, descriptor, data, inject.shorten && size > 7 ? 7 : size);
}

ssize_t read(int descriptor, void *data, size_t size)
{
    if (interrupts())
        return give_up(EINTR);
    return syscall(SYS_read, descriptor, data, inject.shorten && size > 7 ? 7 : size);
}

int openat(int folder, const char *path, int flags, ...)
{
    va_list rest;
    va_start(rest, flags);
    mode_t mode = va_arg(rest, mode_t);
    va_end(rest);
    if (interrupts())
        return give_up(EINTR);
    bool nameless = (flags & O_TMPFILE) == O_TMPFILE;
    if (inject.create != 0 && (nameless || (flags & O_CREAT) != 0))
        return give_up(inject.create);
    if (inject.named && nameless)
        return give_up(EOPNOTSUPP);
    return (int)syscall(SYS_openat, folder, path, flags, mode);
}

int fsync(int descriptor)
{
    inject.fsyncs++;
    if (inject.fsync || interrupts())
        return give_up(inject.fsync ? EIO : EINTR);
    return (int)syscall(SYS_fsync, descriptor);
}

int fchmod(int descriptor, mode_t mode)
{
    return inject.chmod ? give_up(EPERM) : (int)syscall(SYS_fchmod, descriptor, mode);
}

int stat(const char *path, struct stat *status)
{
    if (inject.unnameable && strncmp(path, "/proc/", 6) == 0)
        return give_up(ENOENT);
    return fstatat(AT_FDCWD, path, status, 0);
}

int close(int descriptor)
{
    int closed = (int)syscall(SYS_close, descriptor);
    return inject.close ? give_up(EIO) : closed;
}

int renameat(int from_folder, const char *from, int to_folder, const char *to)
{
    return inject.rename != 0 ? give_up(inject.rename)
                              : (int)syscall(SYS_renameat2, from_folder, from, to_folder, to, 0);
}

static char folder[64];

static inline const char *path_of(const char *name)
{
    static _Thread_local char path[4][400];
    static _Thread_local int next;
    next = (next + 1) % 4;
    snprintf(path[next], sizeof path[next], "%s/%s", folder, name);
    return path[next];
}

static inline int count_files(void)
{
    DIR *d = opendir(folder);
    int count = 0;
    while (d != NULL && readdir(d) != NULL)
        count++;
    if (d != NULL)
        closedir(d);
    return count - 2;
}

static inline bool holds(const char *path, const void *data, size_t size)
{
    lom_error error = { 0 };
    lom_bytes bytes = lom_read_file(path, 1 << 30, &error);
    bool same =
        bytes.data != NULL && bytes.size == size && memcmp(bytes.data, data, size) == 0 && bytes.data[size] == 0;
    lom_release(bytes.data);
    return same;
}

static inline bool make_folder(void)
{
    const char *base = getenv("TMPDIR");
    snprintf(folder, sizeof folder, "%.40s/lom-file-XXXXXX", base != NULL ? base : "/tmp");
    return mkdtemp(folder) != NULL;
}

#endif
