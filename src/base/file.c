/* Whole files. In: a path and bytes (or a limit); out: all bytes, or a file that is completely written. Invariant: a
 * regular file is replaced by rename only after its new content reached the disk, so a full disk, a limit or a kill
 * leaves the old content, and a failure leaves no temporary file. */
#include <lom/base.h>

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum {
    FIRST_CAPACITY = 1 << 16, /* of a file whose size is not known */
    MOST_A_CALL = 1 << 30,    /* the kernel's own bound on one read or write is slightly below 2^31 */
    TEMPORARY_NAMES = 1000    /* tried before giving up */
};

static bool fail_system(lom_error *error, const char *path, const char *action)
{
    int code = errno;
    return lom_fail(error, code == ENOMEM ? LOM_ERROR_MEMORY : LOM_ERROR_FILE, "%s: could not %s: %s.", path, action,
                    strerror(code));
}

/* ---- reading ---- */

static bool grow(lom_bytes *bytes, size_t *capacity, size_t wanted, lom_error *error)
{
    uint8_t *larger = lom_allocate(wanted, 1, error);
    if (larger == NULL)
        return false;
    if (bytes->size != 0)
        memcpy(larger, bytes->data, bytes->size);
    lom_release(bytes->data);
    bytes->data = larger;
    *capacity = wanted;
    return true;
}

/* Reads until the end; one byte more than the limit is asked for, so that "exactly the limit" is accepted. The expected
 * size is a hint: /proc files say 0 and a file may grow meanwhile. */
static bool read_all(int descriptor, const char *path, size_t expected, size_t limit, lom_bytes *bytes,
                     lom_error *error)
{
    size_t capacity = 0;
    if (!grow(bytes, &capacity, expected < limit ? expected + 1 : limit + 1, error))
        return false;
    for (;;) {
        size_t room = capacity - bytes->size;
        ssize_t got = read(descriptor, bytes->data + bytes->size, room < MOST_A_CALL ? room : MOST_A_CALL);
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0)
            return fail_system(error, path, "read");
        if (got == 0)
            return true;
        bytes->size += (size_t)got;
        if (bytes->size > limit)
            return lom_fail(error, LOM_ERROR_LIMIT, "%s: the file is larger than the limit of %zu bytes.", path, limit);
        if (bytes->size == capacity && !grow(bytes, &capacity, capacity <= limit / 2 ? capacity * 2 : limit + 1, error))
            return false;
    }
}

lom_bytes lom_read_file(const char *path, size_t limit, lom_error *error)
{
    lom_bytes bytes = { 0 };
    bool standard = strcmp(path, "-") == 0;
    if (limit > SIZE_MAX / 4)
        limit = SIZE_MAX / 4;
    int descriptor = standard ? STDIN_FILENO : open(path, O_RDONLY | O_CLOEXEC);
    struct stat status;
    if (descriptor < 0 || fstat(descriptor, &status) != 0) {
        fail_system(error, path, "open");
    } else if (S_ISREG(status.st_mode) && (uintmax_t)status.st_size > limit) {
        lom_fail(error, LOM_ERROR_LIMIT, "%s: %ju bytes are more than the limit of %zu.", path,
                 (uintmax_t)status.st_size, limit);
    } else {
        size_t expected = S_ISREG(status.st_mode) && status.st_size > 0 ? (size_t)status.st_size : FIRST_CAPACITY;
        if (!read_all(descriptor, path, expected, limit, &bytes, error)) {
            lom_release(bytes.data);
            bytes = (lom_bytes){ 0 };
        } else {
            bytes.data[bytes.size] = 0; /* there is room: read_all keeps size < capacity */
        }
    }
    if (!standard && descriptor >= 0)
        close(descriptor);
    return bytes;
}

/* ---- writing ---- */

static bool write_all(int descriptor, const char *path, const uint8_t *data, size_t size, lom_error *error)
{
    while (size != 0) {
        ssize_t put = write(descriptor, data, size < MOST_A_CALL ? size : MOST_A_CALL);
        if (put < 0 && errno == EINTR)
            continue;
        if (put < 0)
            return fail_system(error, path, "write");
        data += put;
        size -= (size_t)put;
    }
    return true;
}

/* A file-size limit (RLIMIT_FSIZE) should be an error like a full disk, but the system also sends the writing thread
 * SIGXFSZ, which would end the program with the temporary file left behind. So that signal is held back meanwhile, and
 * taken off the thread when this write caused it. */
static bool write_without_signal(int descriptor, const char *path, const void *data, size_t size, lom_error *error)
{
    sigset_t blocked, before, pending;
    sigemptyset(&blocked);
    sigaddset(&blocked, SIGXFSZ);
    sigpending(&pending);
    bool was_pending = sigismember(&pending, SIGXFSZ) == 1;
    bool masked = pthread_sigmask(SIG_BLOCK, &blocked, &before) == 0;
    bool written = write_all(descriptor, path, data, size, error);
    sigpending(&pending);
    if (masked && !was_pending && sigismember(&pending, SIGXFSZ) == 1) {
        int taken;
        sigwait(&blocked, &taken);
    }
    if (masked)
        pthread_sigmask(SIG_SETMASK, &before, NULL);
    return written;
}

/* Some file systems cannot flush (EINVAL, ENOTSUP): then there is nothing to wait for. */
static bool flush(int descriptor, const char *path, lom_error *error)
{
    while (fsync(descriptor) != 0) {
        if (errno == EINVAL || errno == ENOTSUP || errno == EROFS)
            return true;
        if (errno != EINTR)
            return fail_system(error, path, "flush to disk");
    }
    return true;
}

static bool close_checked(int descriptor, const char *path, lom_error *error)
{
    if (close(descriptor) != 0 && errno != EINTR) /* Linux has closed it even then; retrying could close another's */
        return fail_system(error, path, "close");
    return true;
}

static bool write_direct(const char *path, const void *data, size_t size, lom_error *error)
{
    int descriptor = open(path, O_WRONLY | O_CLOEXEC);
    if (descriptor < 0)
        return fail_system(error, path, "open for writing");
    bool written = write_without_signal(descriptor, path, data, size, error);
    bool closed = close_checked(descriptor, path, error);
    return written && closed;
}

/* The folder of path with its last slash, in a buffer of PATH_MAX; "" for the current one. */
static bool folder_of(const char *path, char folder[PATH_MAX], lom_error *error)
{
    const char *slash = strrchr(path, '/');
    size_t length = slash != NULL ? (size_t)(slash - path) + 1 : 0;
    if (length >= PATH_MAX) {
        errno = ENAMETOOLONG;
        return fail_system(error, path, "open for writing");
    }
    memcpy(folder, path, length);
    folder[length] = 0;
    return true;
}

/* Creates a new file beside path under a name of its own; mode as the umask gives it. */
static int open_temporary(const char *path, const char *folder, char name[PATH_MAX], lom_error *error)
{
    for (int i = 0; i < TEMPORARY_NAMES; i++) {
        int length = snprintf(name, PATH_MAX, "%s.lom-%ld-%d", folder, (long)getpid(), i);
        errno = ENAMETOOLONG;
        int descriptor = length < PATH_MAX ? open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666) : -1;
        if (descriptor >= 0)
            return descriptor;
        if (errno != EEXIST)
            break;
    }
    fail_system(error, path, "create a temporary file beside it");
    return -1;
}

static bool flush_folder(const char *path, const char *folder, lom_error *error)
{
    int descriptor = open(folder[0] != 0 ? folder : ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0)
        return true; /* a folder one may write to but not read: the rename stands, only its flush is up to the system */
    bool flushed = flush(descriptor, path, error);
    close(descriptor);
    return flushed;
}

/* Writes beside path, then renames; status is that of the file to be replaced, or NULL. */
static bool replace(const char *path, const struct stat *status, const void *data, size_t size, lom_error *error)
{
    char folder[PATH_MAX], temporary[PATH_MAX];
    if (!folder_of(path, folder, error))
        return false;
    int descriptor = open_temporary(path, folder, temporary, error);
    if (descriptor < 0)
        return false;
    bool good = write_without_signal(descriptor, path, data, size, error) && flush(descriptor, path, error);
    if (good && status != NULL && fchmod(descriptor, status->st_mode & 07777) != 0)
        good = fail_system(error, path, "keep its permissions");
    if (!close_checked(descriptor, path, error))
        good = false;
    if (good && rename(temporary, path) != 0)
        good = fail_system(error, path, "rename the temporary file to it");
    if (!good) {
        unlink(temporary);
        return false;
    }
    return flush_folder(path, folder, error);
}

bool lom_write_file(const char *path, const void *data, size_t size, lom_error *error)
{
    if (strcmp(path, "-") == 0)
        return write_without_signal(STDOUT_FILENO, "standard output", data, size, error);
    struct stat status;
    if (stat(path, &status) != 0) {
        if (errno != ENOENT)
            return fail_system(error, path, "open for writing");
        return replace(path, NULL, data, size, error);
    }
    if (!S_ISREG(status.st_mode))
        return write_direct(path, data, size, error);
    char *real = realpath(path, NULL); /* a link to a file stays a link */
    if (real == NULL)
        return fail_system(error, path, "open for writing");
    bool replaced = replace(real, &status, data, size, error);
    free(real);
    return replaced;
}
