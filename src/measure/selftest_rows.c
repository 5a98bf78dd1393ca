/* Where the self-test has been seen. In: nothing. Out: the rows of the matrix that gave this hash when it was last drawn.
 * Invariant: `make matrix RECORD=1` writes it, and only when all rows that were asked agreed. */
#include "measure.h"

const uint64_t lom_selftest_seen = UINT64_C(0xf8ecb8bf2c6fd255);

const char *const lom_selftest_rows[] = {
    "gcc-3",   "gcc-3-masked", "gcc-3-locale", "clang-3", "i686-1", "aarch64-3",
    "armhf-1", "riscv64-1",    "ppc64-1",      "s390x-3", NULL,
};
