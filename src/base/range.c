/* Ranges of numbers. In: a number, its bounds, what it is. Out: whether it lies within, or a sentence that says so. */
#include "base/range.h"

#include <stdarg.h>
#include <stdio.h>

bool lom_check_range(double value, double least, double most, lom_error *error, const char *what, ...)
{
    if (value >= least && value <= most)
        return true;
    char name[160], given[32], low[32], high[32];
    va_list arguments;
    va_start(arguments, what);
    vsnprintf(name, sizeof name, what, arguments);
    va_end(arguments);
    lom_print_double(given, value);
    lom_print_double(low, least);
    lom_print_double(high, most);
    return lom_fail(error, LOM_ERROR_USAGE, "%s is %s, which is not within %s..%s.", name, given, low, high);
}
