/* What only a POSIX system has: signals, owners of files, processes (system.h). Invariant: a call leaves the signals that
 * the thread holds back as they were. */
#include "base/system.h"

#include <errno.h>
#include <signal.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

/* A limit of file sizes (RLIMIT_FSIZE) should be an error like a full disk, and so should a reader that went away; but
 * the system also sends the writing thread SIGXFSZ or SIGPIPE, which would end the program. So these are held back
 * meanwhile, and taken off the thread when this write caused them. */
ssize_t lom_write_quietly(int descriptor, const void *data, size_t size)
{
    static const int numbers[] = { SIGXFSZ, SIGPIPE };
    sigset_t held, before, pending;
    sigemptyset(&held);
    sigpending(&pending);
    for (int i = 0; i < 2; i++)
        if (sigismember(&pending, numbers[i]) == 0)
            sigaddset(&held, numbers[i]);
    bool masked = pthread_sigmask(SIG_BLOCK, &held, &before) == 0;
    ssize_t put = write(descriptor, data, size);
    int reason = errno;
    sigpending(&pending);
    for (int i = 0; i < 2; i++) {
        sigset_t one;
        int taken;
        sigemptyset(&one);
        sigaddset(&one, numbers[i]);
        if (masked && put < 0 && sigismember(&held, numbers[i]) == 1 && sigismember(&pending, numbers[i]) == 1)
            sigwait(&one, &taken);
    }
    if (masked)
        pthread_sigmask(SIG_SETMASK, &before, NULL);
    errno = reason;
    return put;
}

/* Where the owner cannot be kept, a set-user-id bit would give the file's rights to another user: such bits go. */
bool lom_keep_status(int descriptor, const struct stat *other)
{
    struct stat own;
    if (fstat(descriptor, &own) != 0)
        return false;
    mode_t mode = other->st_mode & 07777;
    bool same = own.st_uid == other->st_uid && own.st_gid == other->st_gid;
    if (!same && fchown(descriptor, other->st_uid, other->st_gid) != 0) {
        mode &= ~(mode_t)(S_ISUID | S_ISGID);
        (void)!fchown(descriptor, (uid_t)-1, other->st_gid);
    }
    return (own.st_mode & 07777) == mode || fchmod(descriptor, mode) == 0;
}

_Static_assert(sizeof(sigset_t) <= sizeof(lom_held_signals),
               "lom_held_signals is too small for this machine's sigset_t");

void lom_hold_signals(lom_held_signals *before)
{
    sigset_t all, own;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &own);
    memcpy(before->set, &own, sizeof own);
}

void lom_let_signals(const lom_held_signals *before)
{
    int reason = errno;
    sigset_t own;
    memcpy(&own, before->set, sizeof own);
    pthread_sigmask(SIG_SETMASK, &own, NULL);
    errno = reason;
}

/* A first touch of a page costs the system as much as writing it several times; a large one is a five hundredth of them. */
void lom_expect_whole(void *memory, size_t size)
{
#ifdef MADV_HUGEPAGE
    int reason = errno;
    madvise(memory, size, MADV_HUGEPAGE);
    errno = reason;
#else
    (void)memory, (void)size;
#endif
}

int lom_process(void)
{
    return (int)getpid();
}
