/* Errors and warnings as values. In: a code and a sentence. Out: a lom_error that keeps the first failure; warnings
 * that keep the first sentences and count them all. Invariant: an error has a code and a sentence, or neither; of a
 * sentence that is too long (paths have up to 4095 bytes) the beginning and the end stay, which name the file and the
 * reason. */
#include "base/pass_error.h"
#include <lom/base.h>

#include <assert.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { LONGEST = 8192 };

/* Whether byte is one within a UTF-8 sequence, where no text may be cut. */
static bool is_inside(char byte)
{
    return ((unsigned char)byte & 0xc0) == 0x80;
}

/* Copies text, without its middle when it is longer than room - 1 bytes. */
static void shorten(char *to, size_t room, const char *text)
{
    static const char gap[] = " ... ";
    size_t length = strlen(text), half = (room - sizeof gap) / 2;
    if (length < room) {
        memcpy(to, text, length + 1);
        return;
    }
    size_t head = half;
    const char *tail = text + length - half;
    while (head > 0 && is_inside(text[head]))
        head--;
    while (is_inside(*tail))
        tail++;
    memcpy(to, text, head);
    memcpy(to + head, gap, sizeof gap - 1);
    memcpy(to + head + sizeof gap - 1, tail, strlen(tail) + 1);
}

bool lom_fail(lom_error *error, lom_code code, const char *format, ...)
{
    assert(code != LOM_OK);
    if (error == NULL || error->code != LOM_OK)
        return false;
    char text[LONGEST];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    shorten(error->text, sizeof error->text, text);
    assert(error->text[0] != 0);
    error->code = code;
    return false;
}

bool lom_pass_error(const lom_error *from, lom_error *to)
{
    return from->code == LOM_OK || lom_fail(to, from->code, "%s", from->text);
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
    char text[LONGEST], sentence[500];
    va_list arguments;
    if (warnings == NULL)
        return;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    shorten(sentence, sizeof sentence, text);
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
