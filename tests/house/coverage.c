/* Linked into the program of a build that counts what is executed: a test ends some programs by a signal, and what they
 * did counts as well. */
#include <signal.h>
#include <unistd.h>

void __gcov_dump(void);

static void keep_counts(int number)
{
    __gcov_dump();
    signal(number, SIG_DFL);
    raise(number);
}

__attribute__((constructor)) static void catch_signals(void)
{
    signal(SIGTERM, keep_counts);
}
