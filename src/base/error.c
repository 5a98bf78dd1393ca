/* Errors as values. In: a code and a sentence. Out: a lom_error that keeps the first failure. */
#include <lom/base.h>

#include <stdarg.h>
#include <stdio.h>

bool lom_fail(lom_error *error, lom_code code, const char *format, ...)
{
    if (error == NULL || error->code != LOM_OK)
        return false;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(error->text, sizeof error->text, format, arguments);
    va_end(arguments);
    error->code = code;
    return false;
}
