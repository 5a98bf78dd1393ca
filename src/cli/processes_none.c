/* Processes of a system that has none: WebAssembly's. In: what is wanted. Out: that it cannot be had. */
#include "processes.h"

bool lom_open_temporary_folder(lom_temporary_folder *folder, lom_error *error)
{
    *folder = (lom_temporary_folder){ .held = -1 };
    return lom_fail(error, LOM_ERROR_FILE, "this system runs no other programs, which grading needs");
}

void lom_close_temporary_folder(lom_temporary_folder *folder)
{
    (void)folder;
}

bool lom_run_process(char *const argv[], const lom_bounds *bounds, unsigned char *output, size_t *size,
                     lom_ending *ending, lom_error *error)
{
    (void)argv;
    (void)bounds;
    (void)output;
    (void)size;
    (void)ending;
    return lom_fail(error, LOM_ERROR_FILE, "this system runs no other programs");
}

const char *lom_name_signal(int number)
{
    (void)number;
    return "a signal";
}
