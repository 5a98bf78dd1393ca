/* What files need of any system (system.h). Invariant: at any moment every temporary name that exists is in the table
 * below in the state NAMED, or its thread is on the way there with all signals held back. */
#include "base/system.h"

#include <errno.h>
#include <fcntl.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* ---- calls ---- */

bool lom_fail_system(lom_error *error, const char *path, const char *action)
{
    int code = errno;
    return lom_fail(error, code == ENOMEM ? LOM_ERROR_MEMORY : LOM_ERROR_FILE, "%s: could not %s: %s.", path, action,
                    strerror(code));
}

int lom_open_again(int folder, const char *path, int flags)
{
    int descriptor;
    do
        descriptor = openat(folder, path, flags, 0666);
    while (descriptor < 0 && errno == EINTR);
    return descriptor;
}

int lom_open_folder(int parent, const char *path)
{
#if defined O_PATH
    enum { SEARCH = O_PATH };
#elif defined O_SEARCH
    enum { SEARCH = O_SEARCH };
#else
    enum { SEARCH = O_RDONLY };
#endif
    return lom_open_again(parent, path, SEARCH | O_DIRECTORY | O_CLOEXEC);
}

bool lom_call_again(int descriptor, short event)
{
    if (errno == EINTR)
        return true;
    if (errno != EAGAIN && errno != EWOULDBLOCK)
        return false;
    struct pollfd wait = { .fd = descriptor, .events = event };
    return poll(&wait, 1, -1) >= 0 || errno == EINTR;
}

/* ---- temporary names ---- */

enum {
    MOST_NAMES = 512, /* at once; each is at least two descriptors, of which a process has 1024 */
    TRIES = 100,      /* names, before giving up; one of 2^64 is taken by accident hardly ever */
    PATIENCE = 2000   /* milliseconds that the handler of a signal waits for a name on its way */
};

enum { FREE, COMING, NAMED };

struct lom_temporary {
    atomic_int state;
    int process; /* a forked child has the table, but not the files */
    int folder;
    char name[24];
};

static struct lom_temporary names[MOST_NAMES]; /* of the whole process, as its signals are */
static atomic_bool ending;

static bool make_name(char name[24])
{
    uint8_t bits[8] = { 0 }; /* MemorySanitizer does not know what getentropy writes */
    if (getentropy(bits, sizeof bits) != 0)
        return false;
    memcpy(name, ".lom-", 5);
    for (int i = 0; i < 16; i++)
        name[5 + i] = "0123456789abcdef"[bits[i / 2] >> i % 2 * 4 & 15];
    name[21] = 0;
    return true;
}

static lom_temporary *take_free_name(void)
{
    for (int i = 0; i < MOST_NAMES; i++) {
        int expected = FREE;
        if (atomic_compare_exchange_strong(&names[i].state, &expected, COMING))
            return &names[i];
    }
    errno = EMFILE;
    return NULL;
}

/* A file without a name is linked through its entry in /proc: a name of the empty path would take a capability. */
static bool link_descriptor(int descriptor, int folder, const char *name)
{
    char entry[40];
    snprintf(entry, sizeof entry, "/proc/self/fd/%d", descriptor);
    int linked;
    do
        linked = linkat(AT_FDCWD, entry, folder, name, AT_SYMLINK_FOLLOW);
    while (linked != 0 && errno == EINTR);
    return linked == 0;
}

/* A name of its own in folder: of the nameless file *descriptor, or, when that is -1, of a new file. */
static lom_temporary *take_name(int *descriptor, int folder)
{
    lom_held_signals before;
    lom_hold_signals(&before);
    lom_temporary *taken = take_free_name();
    bool done = false;
    if (taken != NULL) {
        taken->process = lom_process();
        taken->folder = folder;
        errno = EEXIST;
        for (int i = 0; !done && i < TRIES && errno == EEXIST; i++) {
            errno = EINTR;
            if (atomic_load(&ending) || !make_name(taken->name))
                break;
            if (*descriptor >= 0) {
                done = link_descriptor(*descriptor, folder, taken->name);
            } else {
                int created = lom_open_again(folder, taken->name, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC);
                done = created >= 0;
                *descriptor = created;
            }
        }
        atomic_store(&taken->state, done ? NAMED : FREE);
    }
    lom_let_signals(&before);
    return done ? taken : NULL;
}

int lom_create_temporary(int folder, lom_temporary **temporary)
{
    int descriptor = -1;
    *temporary = NULL;
#if defined O_TMPFILE
    struct stat entry, own;
    char path[40];
    descriptor = lom_open_again(folder, ".", O_TMPFILE | O_RDWR | O_CLOEXEC);
    snprintf(path, sizeof path, "/proc/self/fd/%d", descriptor);
    if (descriptor >= 0 && fstat(descriptor, &own) == 0 && stat(path, &entry) == 0 && entry.st_ino == own.st_ino &&
        entry.st_dev == own.st_dev)
        return descriptor;
    if (descriptor >= 0) /* no /proc: it could not be given a name */
        close(descriptor);
    descriptor = -1;
#endif
    *temporary = take_name(&descriptor, folder);
    return descriptor;
}

lom_temporary *lom_name_temporary(int descriptor, int folder)
{
    return take_name(&descriptor, folder);
}

const char *lom_temporary_name(const lom_temporary *temporary)
{
    return temporary->name;
}

/* A handler may remove the name at the same time: no name is ever used again, so that does no harm. */
void lom_release_temporary(lom_temporary *temporary, bool remove)
{
    if (temporary == NULL)
        return;
    if (remove)
        unlinkat(temporary->folder, temporary->name, 0);
    atomic_store(&temporary->state, FREE);
}

/* Names on their way belong to other threads, since their own holds the signals back: those are waited for. */
void lom_remove_temporaries(void)
{
    int reason = errno;
    int process = lom_process();
    int waited = 0;
    atomic_store(&ending, true);
    for (int i = 0; i < MOST_NAMES; i++) {
        for (; waited < PATIENCE && atomic_load(&names[i].state) == COMING; waited++)
            poll(NULL, 0, 1);
        if (atomic_load(&names[i].state) == NAMED && names[i].process == process)
            unlinkat(names[i].folder, names[i].name, 0);
    }
    errno = reason;
}
