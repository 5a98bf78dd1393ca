/* Other programs that this one runs: a compiler, a student's stage. processes.c; where there are none, processes_none.c. */
#ifndef LOM_CLI_PROCESSES_H
#define LOM_CLI_PROCESSES_H

#include <lom/base.h>

/* A folder for files that are gone when the program is, however it ends: another process waits for that. */
typedef struct lom_temporary_folder {
    char path[512];
    int held, keeper;
} lom_temporary_folder;

bool lom_open_temporary_folder(lom_temporary_folder *folder, lom_error *error);
void lom_close_temporary_folder(lom_temporary_folder *folder); /* with all that is in it */

/* How a process ended. */
typedef struct lom_ending {
    enum { LOM_ENDED, LOM_KILLED, LOM_ENDLESS } how; /* by itself; by a signal; since its time was over */
    int number;                                      /* its status, or its signal */
} lom_ending;

/* What a process may do. */
typedef struct lom_bounds {
    int descriptor;     /* what it writes there is taken, the rest is lost: 1, 2 or 3 */
    int seconds;        /* of the clock */
    int processor_time; /* seconds; 0: unbounded, else it writes no file, either, and has 1 GiB of memory */
    size_t bytes;       /* that it writes at most; it is ended behind them */
} lom_bounds;

/* Runs a program, found on PATH where its name has no slash, to its end; output: bounds->bytes, of which *size are
 * written. A program that cannot be run ends with status 127. Whatever it has started is ended with it. */
bool lom_run_process(char *const argv[], const lom_bounds *bounds, unsigned char *output, size_t *size,
                     lom_ending *ending, lom_error *error);

/* The name of a signal that ends a process, and what it says of it. */
const char *lom_name_signal(int number);

#endif
