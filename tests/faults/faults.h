/* Lets calls fail in turn: the first, the second ... until none is left to fail, once and from there on. After each: an
 * error with a code and a sentence, or the same result as without the fault; nothing leaked; no file half written and
 * none left behind. The linker puts the functions __wrap_* in the place of the real ones (Makefile: FAULTS). */
#ifndef LOM_TESTS_FAULTS_H
#define LOM_TESTS_FAULTS_H

#include "check.h"
#include "small_scene.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdatomic.h>

/* ---- faults ---- */

typedef enum { NOTHING, MEMORY, FILES, THREADS } fault_kind;

static struct {
    fault_kind kind;
    bool lasting;       /* all from there on, not that one alone */
    int at;             /* which call fails, from 0 */
    atomic_int calls;   /* of the kind, so far */
    atomic_long held;   /* allocations not yet released */
    atomic_llong bytes; /* of all allocations */
    atomic_int opened;  /* files */
    int file_error;
} fault;

static inline bool fails(fault_kind kind)
{
    if (fault.kind != kind)
        return false;
    int call = atomic_fetch_add(&fault.calls, 1);
    return fault.lasting ? call >= fault.at : call == fault.at;
}

static inline bool file_fails(void)
{
    if (!fails(FILES))
        return false;
    errno = fault.file_error;
    return true;
}

void *__real_aligned_alloc(size_t alignment, size_t size);
void __real_lom_release(void *memory);
int __real_pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*run)(void *), void *argument);
ssize_t __real_read(int descriptor, void *data, size_t size);
ssize_t __real_write(int descriptor, const void *data, size_t size);
int __real_openat(int folder, const char *path, int flags, ...);
int __real_linkat(int from_folder, const char *from, int to_folder, const char *to, int flags);
int __real_fsync(int descriptor);
int __real_close(int descriptor);
int __real_renameat(int from_folder, const char *from, int to_folder, const char *to);

void *__wrap_aligned_alloc(size_t alignment, size_t size);
void __wrap_lom_release(void *memory);
int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*run)(void *), void *argument);
ssize_t __wrap_read(int descriptor, void *data, size_t size);
ssize_t __wrap_write(int descriptor, const void *data, size_t size);
int __wrap_openat(int folder, const char *path, int flags, ...);
int __wrap_linkat(int from_folder, const char *from, int to_folder, const char *to, int flags);
int __wrap_fsync(int descriptor);
int __wrap_close(int descriptor);
int __wrap_renameat(int from_folder, const char *from, int to_folder, const char *to);

void *__wrap_aligned_alloc(size_t alignment, size_t size)
{
    if (fails(MEMORY))
        return NULL;
    void *memory = __real_aligned_alloc(alignment, size);
    atomic_fetch_add(&fault.held, memory != NULL);
    atomic_fetch_add(&fault.bytes, (long long)size);
    return memory;
}

void __wrap_lom_release(void *memory)
{
    atomic_fetch_sub(&fault.held, memory != NULL);
    __real_lom_release(memory);
}

int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*run)(void *), void *argument)
{
    return fails(THREADS) ? EAGAIN : __real_pthread_create(thread, attributes, run, argument);
}

ssize_t __wrap_read(int descriptor, void *data, size_t size)
{
    return file_fails() ? -1 : __real_read(descriptor, data, size);
}

ssize_t __wrap_write(int descriptor, const void *data, size_t size)
{
    return file_fails() ? -1 : __real_write(descriptor, data, size);
}

int __wrap_openat(int folder, const char *path, int flags, ...)
{
    va_list rest;
    va_start(rest, flags);
    mode_t mode = va_arg(rest, mode_t);
    va_end(rest);
    atomic_fetch_add(&fault.opened, 1);
    return file_fails() ? -1 : __real_openat(folder, path, flags, mode);
}

int __wrap_linkat(int from_folder, const char *from, int to_folder, const char *to, int flags)
{
    return file_fails() ? -1 : __real_linkat(from_folder, from, to_folder, to, flags);
}

int __wrap_fsync(int descriptor)
{
    return file_fails() ? -1 : __real_fsync(descriptor);
}

int __wrap_close(int descriptor)
{
    int closed = __real_close(descriptor); /* a close that fails has closed all the same */
    return file_fails() ? -1 : closed;
}

int __wrap_renameat(int from_folder, const char *from, int to_folder, const char *to)
{
    return file_fails() ? -1 : __real_renameat(from_folder, from, to_folder, to);
}

/* ---- the loop ---- */

/* Does something and gives a hash of the result. False: the error says why. */
typedef bool task(const char *name, uint64_t *hash, lom_error *error);

/* Which calls fail: all in turn, or `tries` of them, evenly spread (a long task; all with LOM_EXHAUSTIVE=1). */
typedef struct fault_plan {
    fault_kind kind;
    bool lasting;
    int tries; /* 0: all */
    void (*check)(bool done);
} fault_plan;

static inline int count_calls(task *run, const char *name, fault_kind kind, uint64_t *whole)
{
    lom_error none = { 0 };
    atomic_store(&fault.calls, 0);
    fault.at = INT_MAX;
    fault.lasting = false;
    fault.kind = kind;
    CHECK(run(name, whole, &none), "%s without a fault: %s", name, none.text);
    fault.kind = NOTHING;
    return atomic_load(&fault.calls);
}

/* Lets call n fail. Returns whether there was one. */
static inline bool fail_one(task *run, const char *name, const fault_plan *plan, int n, uint64_t whole)
{
    lom_error error = { 0 };
    uint64_t hash = 0;
    const char *how = plan->lasting ? "from there on" : "once";
    long before = atomic_load(&fault.held);
    atomic_store(&fault.calls, 0);
    fault.at = n;
    fault.lasting = plan->lasting;
    fault.kind = plan->kind;
    bool done = run(name, &hash, &error);
    fault.kind = NOTHING;
    CHECK(atomic_load(&fault.held) == before, "%s, fault %d %s: %ld allocations leaked", name, n, how,
          atomic_load(&fault.held) - before);
    size_t length = strlen(error.text);
    if (done)
        CHECK(hash == whole && error.code == LOM_OK, "%s, fault %d %s: another result, code %d", name, n, how,
              error.code);
    else
        CHECK(error.code != LOM_OK && length > 10 && error.text[length - 1] == '.', "%s, fault %d %s: code %d, \"%s\"",
              name, n, how, error.code, error.text);
    CHECK(done || plan->kind != MEMORY || error.code == LOM_ERROR_MEMORY, "%s, fault %d %s: code %d, \"%s\"", name, n,
          how, error.code, error.text);
    CHECK(count_small_files(".lom-") == 0, "%s, fault %d %s: a temporary file is left", name, n, how);
    if (plan->check != NULL)
        plan->check(done);
    return atomic_load(&fault.calls) > n;
}

/* Returns how many calls there were. */
static inline int fail_each(task *run, const char *name, const fault_plan *plan)
{
    uint64_t whole = 0;
    int calls = count_calls(run, name, plan->kind, &whole), n = 0;
    if (plan->tries != 0 && getenv("LOM_EXHAUSTIVE") == NULL && plan->tries < calls) {
        for (int i = 0; i < plan->tries; i++)
            fail_one(run, name, plan, (int)((long)i * calls / plan->tries), whole);
        return calls;
    }
    while (fail_one(run, name, plan, n, whole))
        n++;
    return n;
}

/* Both loops see the same allocations, but for `slack` of them. */
static inline void fail_memory(task *run, const char *name, int least, int slack, int tries)
{
    int once = fail_each(run, name, &(fault_plan){ .kind = MEMORY, .tries = tries });
    int lasting = fail_each(run, name, &(fault_plan){ .kind = MEMORY, .tries = tries, .lasting = true });
    CHECK(once >= least && once - lasting <= slack && lasting - once <= slack, "%s: %d allocations, %d", name, once,
          lasting);
}

#endif
