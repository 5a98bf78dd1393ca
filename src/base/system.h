/* The seam between files and the system. In: descriptors and paths. Out: what a call gave, or -1 (false) and errno.
 * system.c is what every system has; system_posix.c or, without signals, owners and processes, system_wasi.c the rest.
 * Nothing else of base/ but threads.c knows them. */
#ifndef LOM_BASE_SYSTEM_H
#define LOM_BASE_SYSTEM_H

#include <lom/base.h>

#include <poll.h>
#include <sys/stat.h>
#include <sys/types.h>

enum { LOM_MOST_A_CALL = 1 << 30 }; /* Linux's own bound on one read or write is slightly below 2^31 */

/* "PATH: could not ACTION: the reason that errno names." */
bool lom_fail_system(lom_error *error, const char *path, const char *action);

/* open, again when a signal interrupts it. */
int lom_open_again(int folder, const char *path, int flags);
/* A folder to find names in, which takes no right to list it. */
int lom_open_folder(int parent, const char *path);

/* Whether a read or write that failed is to be made again: a signal came between, or the descriptor does not block and
 * was waited for (event: POLLIN or POLLOUT). */
bool lom_call_again(int descriptor, short event);

/* write, without the signals that a limit of file sizes or a reader that went away send to the thread. */
ssize_t lom_write_quietly(int descriptor, const void *data, size_t size);

/* Gives the file the mode, and where the system lets it the owner, of another. */
bool lom_keep_status(int descriptor, const struct stat *other);

/* The signals that a thread holds back. */
typedef struct lom_held_signals {
    uint64_t set[16];
} lom_held_signals;

/* Holds all signals back, so that no handler comes between; lets them through again but for those held before, and
 * leaves errno as it is. */
void lom_hold_signals(lom_held_signals *before);
void lom_let_signals(const lom_held_signals *before);

/* The number of this process: a forked child has another one. */
int lom_process(void);

/* That a block will be touched from end to end, so that the system may give it in pages as large as this. A hint: nothing
 * but time follows from it. */
enum { LOM_LARGE_PAGE = 2 << 20 };
void lom_expect_whole(void *memory, size_t size);

/* A temporary file's name, which lom_remove_temporaries knows. */
typedef struct lom_temporary lom_temporary;

/* A new file in folder, to read and write: without a name (*temporary is NULL) where there are such files, else with
 * one. The descriptor. */
int lom_create_temporary(int folder, lom_temporary **temporary);
/* Gives a file without a name one in folder; NULL on failure. */
lom_temporary *lom_name_temporary(int descriptor, int folder);
/* Its name in the folder. */
const char *lom_temporary_name(const lom_temporary *temporary);
/* The name is another file's now, or is removed first; temporary is gone, and NULL is allowed. */
void lom_release_temporary(lom_temporary *temporary, bool remove);

#endif
