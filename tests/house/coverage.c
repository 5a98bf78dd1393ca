/* Linked into the program of a build that counts what is executed, in the place of nanosleep (Makefile: COUNTING): a
 * program that watches a scene sleeps between two looks until a signal ends it, and what it did until then counts as
 * well. A signal's handler could not keep the counts: it may have interrupted what they are kept with. */
#include <time.h>

void __gcov_dump(void);
void __gcov_reset(void);
int __real_nanosleep(const struct timespec *duration, struct timespec *rest);
int __wrap_nanosleep(const struct timespec *duration, struct timespec *rest);

int __wrap_nanosleep(const struct timespec *duration, struct timespec *rest)
{
    __gcov_dump();
    __gcov_reset();
    return __real_nanosleep(duration, rest);
}
