/* The test harness: a test is a function that calls CHECK; RUN prints a line for it. tests/run counts those lines.
 * A failure prints the file, the line, what was expected, and the command that repeats it. */
#ifndef LOM_TESTS_CHECK_H
#define LOM_TESTS_CHECK_H

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int check_failures; /* of the test that is running */
static int check_failed_tests;

#define CHECK(condition, ...)                                                                                          \
    do {                                                                                                               \
        if (!(condition) && check_failures++ < 5) {                                                                    \
            printf("  %s:%d: %s: ", __FILE__, __LINE__, #condition);                                                   \
            printf("" __VA_ARGS__);                                                                                    \
            printf("\n");                                                                                              \
        }                                                                                                              \
    } while (0)

/* RUN(test) runs one test; with arguments on the command line only the tests named there. */
#define RUN(test)                                                                                                      \
    do {                                                                                                               \
        if (check_selected(argc, argv, #test)) {                                                                       \
            check_failures = 0;                                                                                        \
            test();                                                                                                    \
            if (check_failures != 0) {                                                                                 \
                check_failed_tests++;                                                                                  \
                printf("FAIL %s: %d checks failed; repeat: %s %s\n", #test, check_failures, argv[0], #test);           \
            } else {                                                                                                   \
                printf("PASS %s\n", #test);                                                                            \
            }                                                                                                          \
            fflush(stdout);                                                                                            \
        }                                                                                                              \
    } while (0)

static inline int check_selected(int argc, char **argv, const char *name)
{
    for (int i = 1; i < argc; i++)
        if (strcmp(argv[i], name) == 0)
            return 1;
    return argc < 2;
}

/* A wide test ends with SKIP, before main, on a processor that lacks the instructions that it was compiled for. */
#if defined __x86_64__ && defined __AVX2__
__attribute__((constructor)) static void check_lanes(void)
{
#ifdef __AVX512F__
    bool runs = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl") &&
                __builtin_cpu_supports("avx512cd");
#else
    bool runs = __builtin_cpu_supports("avx2");
#endif
    if (!runs) {
        printf("SKIP this processor has no instructions for this width\n");
        exit(0);
    }
}
#endif

static inline int check_result(void)
{
    return check_failed_tests != 0;
}

#endif
