/* The processor time of this thread: what else the machine does makes it longer, never shorter. */
#ifndef LOM_TESTS_PROCESSOR_TIME_H
#define LOM_TESTS_PROCESSOR_TIME_H

#include <time.h>

static inline double processor_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + (double)now.tv_nsec * 1e-9;
}

#endif
