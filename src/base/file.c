/* Whole files. In: a path and bytes (or a limit); out: all bytes, or a file that is completely written (writer.c).
 * Invariant: what is read is all there is, however many calls that takes. */
#include <lom/base.h>

#include "base/reserve.h"
#include "base/system.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { FIRST_CAPACITY = 1 << 16 /* of a file whose size is not known */ };

/* Reads until the end; one byte more than the limit is asked for, so that "exactly the limit" is accepted. The expected
 * size is a hint: /proc files say 0 and a file may grow meanwhile. */
static bool read_all(int descriptor, const char *path, size_t expected, size_t limit, lom_bytes *bytes,
                     lom_error *error)
{
    size_t capacity = 0;
    if (!lom_reserve(&bytes->data, &capacity, expected < limit ? expected + 1 : limit + 1, 1, error))
        return false;
    for (;;) {
        size_t room = capacity - bytes->size;
        ssize_t got = read(descriptor, bytes->data + bytes->size, room < LOM_MOST_A_CALL ? room : LOM_MOST_A_CALL);
        if (got < 0 && lom_call_again(descriptor, POLLIN))
            continue;
        if (got < 0)
            return lom_fail_system(error, path, "read");
        if (got == 0)
            return true;
        bytes->size += (size_t)got;
        if (bytes->size > limit)
            return lom_fail(error, LOM_ERROR_LIMIT, "%s: the file is larger than the limit of %zu bytes.", path, limit);
        if (bytes->size == capacity && !lom_reserve(&bytes->data, &capacity, capacity + 1, 1, error))
            return false;
    }
}

lom_bytes lom_read_file(const char *path, size_t limit, lom_error *error)
{
    lom_bytes bytes = { 0 };
    bool standard = strcmp(path, "-") == 0;
    if (limit > SIZE_MAX / 4)
        limit = SIZE_MAX / 4;
    int descriptor = standard ? STDIN_FILENO : lom_open_again(AT_FDCWD, path, O_RDONLY | O_CLOEXEC);
    struct stat status;
    if (descriptor < 0 || fstat(descriptor, &status) != 0) {
        lom_fail_system(error, path, "open");
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

bool lom_write_file(const char *path, const void *data, size_t size, lom_error *error)
{
    lom_writer *writer = lom_open_writer(path, error);
    if (writer == NULL)
        return false;
    lom_append(writer, data, size, error);
    return lom_close_writer(writer, error);
}
