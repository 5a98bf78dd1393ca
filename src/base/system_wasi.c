/* What a system without signals, owners of files and processes does instead (system.h): WebAssembly's (WASI preview 1).
 * Invariant: a file is written as elsewhere, beside the old one and renamed over it. */
#include "base/system.h"

#include <unistd.h>

/* With vectors, clang 14 makes one of values that were loaded (a gather) by loading again behind later stores. */
#if defined __wasm_simd128__ && defined __clang_major__ && __clang_major__ < 16
#error "clang before 16 moves loads behind stores where WebAssembly has vectors: take a newer one, or make wasm SIMD=."
#endif

ssize_t lom_write_quietly(int descriptor, const void *data, size_t size)
{
    return write(descriptor, data, size);
}

/* Files have no mode here, and no owner. */
bool lom_keep_status(int descriptor, const struct stat *other)
{
    (void)descriptor, (void)other;
    return true;
}

void lom_hold_signals(lom_held_signals *before)
{
    *before = (lom_held_signals){ .set = { 0 } };
}

void lom_let_signals(const lom_held_signals *before)
{
    (void)before;
}

void lom_expect_whole(void *memory, size_t size)
{
    (void)memory, (void)size;
}

int lom_process(void)
{
    return 0;
}
