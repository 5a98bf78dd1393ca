/* Where the self-test has been seen. In: nothing. Out: the rows of the matrix that gave this hash when it was last drawn.
 * Invariant: `make matrix RECORD=1` writes it, and only when all rows that were asked agreed. */
#include "measure.h"

const uint64_t lom_selftest_seen = UINT64_C(0xf8ecb8bf2c6fd255);

const char *const lom_selftest_rows[] = {
    "gcc-3",           "gcc-3-masked", "gcc-3-locale", "gcc-0",   "gcc-1",     "gcc-2",     "gcc-s",   "gcc-1-native",
    "gcc-1-lto",       "gcc-0-uchar",  "gcc-11-3",     "musl-1",  "clang-3",   "clang-0",   "clang-1", "clang-2",
    "clang-13-3",      "clang-19-1",   "i686-1",       "armhf-1", "riscv64-1", "ppc64el-1", "ppc64-1", "aarch64-3",
    "aarch64-0-schar", "s390x-3",      "s390x-0",      "wasm-1",  "wasm128-1", NULL,
};
