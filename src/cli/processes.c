/* Other programs. In: a command line and bounds. Out: what it wrote and how it ended. Invariant: no process that is
 * started here outlives this program by more than its bounds, and no file in a folder of lom_open_temporary_folder does. */
#include "processes.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static void remove_folder(const char *path)
{
    DIR *list = opendir(path);
    for (struct dirent *entry = list != NULL ? readdir(list) : NULL; entry != NULL; entry = readdir(list))
        unlinkat(dirfd(list), entry->d_name, 0);
    if (list != NULL)
        closedir(list);
    rmdir(path);
}

bool lom_open_temporary_folder(lom_temporary_folder *folder, lom_error *error)
{
    const char *parent = getenv("TMPDIR");
    int ends[2];
    *folder = (lom_temporary_folder){ .held = -1 };
    int length = snprintf(folder->path, sizeof folder->path, "%s/lom-XXXXXX",
                          parent != NULL && parent[0] != '\0' ? parent : "/tmp");
    if (length >= (int)sizeof folder->path || mkdtemp(folder->path) == NULL)
        return lom_fail(error, LOM_ERROR_FILE, "no temporary folder can be made in %.300s: %s",
                        parent != NULL ? parent : "/tmp", strerror(errno));
    if (pipe2(ends, O_CLOEXEC) != 0) {
        remove_folder(folder->path);
        return lom_fail(error, LOM_ERROR_FILE, "no pipe can be made: %s", strerror(errno));
    }
    folder->keeper = fork();
    if (folder->keeper == 0) { /* the pipe ends when nobody holds its other end any more */
        char byte;
        setsid();
        close(ends[1]);
        while (read(ends[0], &byte, 1) < 0 && errno == EINTR) {
        }
        remove_folder(folder->path);
        _exit(0);
    }
    close(ends[0]);
    folder->held = ends[1];
    if (folder->keeper > 0)
        return true;
    close(ends[1]);
    remove_folder(folder->path);
    return lom_fail(error, LOM_ERROR_FILE, "no process can be started: %s", strerror(errno));
}

void lom_close_temporary_folder(lom_temporary_folder *folder)
{
    if (folder->held < 0)
        return;
    close(folder->held);
    while (waitpid(folder->keeper, NULL, 0) < 0 && errno == EINTR) {
    }
    folder->held = -1;
}

static void bound(int what, rlim_t soft, rlim_t hard)
{
    struct rlimit limit;
    getrlimit(what, &limit);
    limit.rlim_cur = soft < limit.rlim_max ? soft : limit.rlim_max;
    limit.rlim_max = hard < limit.rlim_max ? hard : limit.rlim_max;
    setrlimit(what, &limit);
}

/* In the new process: a group of its own, nothing to read, one descriptor that is heard, bounds that it inherits. */
static void become(char *const argv[], const lom_bounds *bounds, int end)
{
    int nothing = open("/dev/null", O_RDWR), heard = fcntl(end, F_DUPFD_CLOEXEC, 10);
    setpgid(0, 0);
    for (int i = 0; i < 3; i++)
        dup2(nothing, i);
    dup2(heard, bounds->descriptor);
    signal(SIGPIPE, SIG_DFL);
    bound(RLIMIT_CORE, 0, 0);
    if (bounds->processor_time > 0) {
        bound(RLIMIT_CPU, (rlim_t)bounds->processor_time, (rlim_t)bounds->processor_time + 1);
        bound(RLIMIT_FSIZE, 0, 0);
        bound(RLIMIT_AS, (rlim_t)1 << 30, (rlim_t)1 << 30);
    }
    alarm((unsigned)bounds->seconds + 1); /* where nobody is left to end it */
    execvp(argv[0], argv);
    _exit(127);
}

static int64_t milliseconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000 + now.tv_nsec / 1000000;
}

/* Takes what is written until it ends; false when the time is over, or there is no room. */
static bool hear(int end, const lom_bounds *bounds, int64_t last, unsigned char *output, size_t *size)
{
    for (;;) {
        int64_t left = last - milliseconds();
        unsigned char beyond;
        bool has_room = *size < bounds->bytes;
        struct pollfd waits = { .fd = end, .events = POLLIN };
        if (left <= 0)
            return false;
        if (poll(&waits, 1, (int)left) <= 0)
            continue;
        ssize_t taken = read(end, has_room ? output + *size : &beyond, has_room ? bounds->bytes - *size : 1);
        if (taken == 0)
            return true;
        if (taken > 0 && !has_room)
            return false;
        *size += taken > 0 ? (size_t)taken : 0;
    }
}

bool lom_run_process(char *const argv[], const lom_bounds *bounds, unsigned char *output, size_t *size,
                     lom_ending *ending, lom_error *error)
{
    int ends[2], status = 0;
    int64_t last = milliseconds() + (int64_t)bounds->seconds * 1000;
    *size = 0;
    if (pipe2(ends, O_CLOEXEC) != 0)
        return lom_fail(error, LOM_ERROR_FILE, "no pipe can be made: %s", strerror(errno));
    pid_t process = fork();
    if (process == 0)
        become(argv, bounds, ends[1]);
    close(ends[1]);
    if (process < 0) {
        close(ends[0]);
        return lom_fail(error, LOM_ERROR_FILE, "no process can be started: %s", strerror(errno));
    }
    setpgid(process, process);
    siginfo_t info = { .si_pid = 0 };
    bool in_time = hear(ends[0], bounds, last, output, size);
    while (in_time && waitid(P_PID, (id_t)process, &info, WEXITED | WNOWAIT | WNOHANG) == 0 && info.si_pid == 0) {
        poll(NULL, 0, 5); /* it has nothing more to say, and has not ended */
        in_time = milliseconds() < last;
    }
    kill(-process, SIGKILL); /* all that it started; it is not waited for yet, so the number is still its own */
    while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    close(ends[0]);
    bool is_endless = !in_time || (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGALRM));
    ending->how = is_endless ? LOM_ENDLESS : WIFSIGNALED(status) ? LOM_KILLED : LOM_ENDED;
    ending->number = WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status);
    return true;
}

const char *lom_name_signal(int number)
{
    static const struct {
        int number;
        const char *name;
    } names[] = { { SIGSEGV, "SIGSEGV, memory that is not its own" },
                  { SIGFPE, "SIGFPE, an integer divided by 0" },
                  { SIGABRT, "SIGABRT, it gave up" },
                  { SIGBUS, "SIGBUS, memory that is not there" },
                  { SIGILL, "SIGILL, no instruction" },
                  { SIGTRAP, "SIGTRAP" },
                  { SIGXFSZ, "SIGXFSZ, it wrote a file" },
                  { SIGKILL, "SIGKILL" } };
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        if (names[i].number == number)
            return names[i].name;
    return "a signal";
}
