/* Words and numbers of OBJ and MTL. In: bytes. Out: words, finite numbers. Lines end in \n, \r\n or \r; nothing depends
 * on the locale. */
#include "text.h"

#include "base/numbers.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* The bytes of the line end at p, 0 when there is none. */
static size_t line_end(const char *p, const char *end)
{
    if (p == end)
        return 0;
    if (*p == '\r')
        return end - p > 1 && p[1] == '\n' ? 2 : 1;
    return *p == '\n';
}

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

/* The bytes of a backslash and the line end after it, 0 when there is none. */
static size_t continuation(const char *p, const char *end)
{
    if (p == end || *p != '\\')
        return 0;
    size_t length = line_end(p + 1, end);
    return length == 0 ? 0 : length + 1;
}

static void skip_blanks(struct lom_text *text)
{
    for (;;) {
        size_t length = continuation(text->at, text->end);
        if (length > 0) {
            text->at += length;
            text->line++;
        } else if (text->at < text->end && is_blank(*text->at)) {
            text->at++;
        } else {
            return;
        }
    }
}

bool lom_text_open(struct lom_text *text, const char *bytes, size_t size, const char *name, lom_error *error)
{
    *text = (struct lom_text){ .at = bytes, .end = bytes + size, .line = 1, .name = name, .error = error };
    if (size >= 3 && memcmp(bytes, "\xEF\xBB\xBF", 3) == 0)
        text->at += 3;
    const char *zero = size == 0 ? NULL : memchr(bytes, 0, size);
    if (zero == NULL)
        return true;
    for (const char *p = bytes; p < zero; p++)
        text->line += line_end(p, text->end) == 1;
    return lom_text_fail(text, LOM_ERROR_INPUT, "A zero byte: this is no text file.");
}

struct lom_word lom_text_word(struct lom_text *text)
{
    skip_blanks(text);
    const char *start = text->at, *p = start;
    if (p == text->end || *p == '#')
        return (struct lom_word){ start, 0 };
    while (p < text->end && !is_blank(*p) && line_end(p, text->end) == 0 && continuation(p, text->end) == 0)
        p++;
    text->at = p;
    return (struct lom_word){ start, (size_t)(p - start) };
}

struct lom_word lom_text_rest(struct lom_text *text)
{
    skip_blanks(text);
    struct lom_word rest = { text->at, 0 };
    const char *p = text->at;
    for (; p < text->end && line_end(p, text->end) == 0 && continuation(p, text->end) == 0; p++)
        if (!is_blank(*p))
            rest.length = (size_t)(p + 1 - rest.start);
    text->at = p;
    return rest;
}

struct lom_word lom_before_comment(struct lom_word rest)
{
    size_t end = 0, at = 0;
    for (; at < rest.length && !(rest.start[at] == '#' && (at == 0 || is_blank(rest.start[at - 1]))); at++)
        if (!is_blank(rest.start[at]))
            end = at + 1;
    return (struct lom_word){ rest.start, end };
}

/* Whether its last point begins an extension, without blanks or '#'. */
static bool has_extension(struct lom_word name)
{
    size_t at = name.length;
    while (at > 0 && name.start[at - 1] != '.' && name.start[at - 1] != '#' && !is_blank(name.start[at - 1]))
        at--;
    return at > 1 && at < name.length && name.start[at - 1] == '.';
}

struct lom_word lom_file_name(struct lom_word rest)
{
    struct lom_word shorter = lom_before_comment(rest);
    size_t mark = shorter.length;
    while (mark < rest.length && rest.start[mark] != '#')
        mark++;
    bool comment = mark + 1 >= rest.length || is_blank(rest.start[mark + 1]);
    return has_extension(shorter) && (comment || !has_extension(rest)) ? shorter : rest;
}

bool lom_text_next(struct lom_text *text)
{
    bool comment = false;
    size_t length;
    for (; text->at < text->end && (length = line_end(text->at, text->end)) == 0; text->at += length) {
        comment = comment || *text->at == '#';
        length = comment ? 0 : continuation(text->at, text->end);
        text->line += length > 0;
        length = length > 0 ? length : 1;
    }
    length = line_end(text->at, text->end);
    text->at += length;
    text->line += length > 0;
    return text->at < text->end;
}

bool lom_text_fail(struct lom_text *text, lom_code code, const char *format, ...)
{
    char sentence[400];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(sentence, sizeof sentence, format, arguments);
    va_end(arguments);
    for (char *p = sentence; *p != 0; p++)
        if ((unsigned char)*p < ' ' || *p == 127)
            *p = '?';
    return lom_fail(text->error, code, "%s:%zu: %s", text->name, text->line, sentence);
}

bool lom_word_is(struct lom_word word, const char *string)
{
    return strlen(string) == word.length && memcmp(word.start, string, word.length) == 0;
}

int lom_word_shown(struct lom_word word)
{
    return word.length < 40 ? (int)word.length : 40;
}

/* What both number readers say about a word of which used bytes are a number. */
static bool check_number(struct lom_text *text, struct lom_word word, size_t used, bool fits)
{
    if (used != word.length || word.length == 0)
        return lom_text_fail(text, LOM_ERROR_INPUT, "\"%.*s\" is not a number.", lom_word_shown(word), word.start);
    if (!fits)
        return lom_text_fail(text, LOM_ERROR_INPUT, "The number %.*s does not fit a 32-bit float.",
                             lom_word_shown(word), word.start);
    return true;
}

bool lom_text_number(struct lom_text *text, struct lom_word word, double *value)
{
    *value = 0;
    size_t used = lom_parse_double(word.start, word.length, value);
    *value = lom_without_denormals(*value);
    return check_number(text, word, used, __builtin_fabsf((float)*value) < __builtin_inff());
}

int lom_text_floats(struct lom_text *text, float *values, int limit)
{
    int count = 0;
    for (struct lom_word word = lom_text_word(text); word.length > 0; word = lom_text_word(text)) {
        if (count == limit) {
            lom_text_fail(text, LOM_ERROR_INPUT, "More than %d numbers.", limit);
            return -1;
        }
        values[count] = 0;
        size_t used = lom_parse_float(word.start, word.length, &values[count]);
        if (!check_number(text, word, used, __builtin_fabsf(values[count]) < __builtin_inff()))
            return -1;
        values[count] = (float)lom_without_denormals((double)values[count]);
        count++;
    }
    return count;
}
