/* What begins the program on a system without signals: WebAssembly's. Nothing ends it but itself. Relative paths begin in
 * the folder that PWD names, since WASI has no current one and its libc begins in the root. */
#include "signals.h"

#include <stdlib.h>
#include <unistd.h>

void lom_handle_signals(void)
{
    const char *folder = getenv("PWD");
    if (folder != NULL)
        (void)!chdir(folder);
}
