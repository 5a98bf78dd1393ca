/* Errors and warnings as values. In: a code and a sentence. Out: a lom_error that keeps the first failure; warnings
 * that keep the first sentences and count them all. */
#include <lom/base.h>

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

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

/* A sentence and its newline, when there is room for both. */
static void put_sentence(lom_warnings *warnings, const char *sentence, size_t length)
{
    size_t used = strlen(warnings->text);
    if (length + 2 > sizeof warnings->text - used)
        return;
    memcpy(warnings->text + used, sentence, length);
    memcpy(warnings->text + used + length, "\n", 2);
}

void lom_warn(lom_warnings *warnings, const char *format, ...)
{
    char sentence[500];
    va_list arguments;
    if (warnings == NULL)
        return;
    va_start(arguments, format);
    vsnprintf(sentence, sizeof sentence, format, arguments);
    va_end(arguments);
    for (char *p = sentence; *p != 0; p++)
        if ((unsigned char)*p < ' ' || *p == 127)
            *p = '?';
    if (strstr(warnings->text, sentence) != NULL)
        return;
    warnings->count++;
    put_sentence(warnings, sentence, strlen(sentence));
}

bool lom_warn_instead(lom_warnings *warnings, lom_error *error)
{
    if (error->code != LOM_ERROR_FILE && error->code != LOM_ERROR_INPUT && error->code != LOM_ERROR_LIMIT)
        return false;
    lom_warn(warnings, "%s", error->text);
    *error = (lom_error){ .code = LOM_OK };
    return true;
}

void lom_add_warnings(lom_warnings *warnings, const lom_warnings *more)
{
    for (const char *at = more->text; *at != 0;) {
        size_t length = strcspn(at, "\n");
        put_sentence(warnings, at, length);
        at += length + 1;
    }
    warnings->count += more->count;
}
