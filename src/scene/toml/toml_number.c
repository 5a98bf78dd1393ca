/* TOML: integers, floats, booleans, dates and times. In: bytes at the parser's position. Out: a value of 64 bits, or
 * the checked text of a date. Invariant: a number is accepted exactly when TOML's grammar has it and int64 or double
 * holds it. */
#include "scene/toml/toml_parser.h"

#include <string.h>

static bool is_digit(int c)
{
    return c >= '0' && c <= '9';
}

/* ---- dates ---- */

/* Two digits at text as a number, -1 when they are none. */
static int two_digits(const char *text)
{
    return is_digit(text[0]) && is_digit(text[1]) ? (text[0] - '0') * 10 + text[1] - '0' : -1;
}

static bool in_range(int value, int low, int high)
{
    return value >= low && value <= high;
}

/* YYYY-MM-DD: 10 bytes, 0 when the shape is another; *valid says whether the calendar has the day. */
static size_t date_part(const char *text, size_t length, bool *valid)
{
    static const signed char days[] = { 31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31 };
    if (length < 10 || two_digits(text) < 0 || two_digits(text + 2) < 0 || text[4] != '-' || two_digits(text + 5) < 0 ||
        text[7] != '-' || two_digits(text + 8) < 0)
        return 0;
    int year = two_digits(text) * 100 + two_digits(text + 2), month = two_digits(text + 5), day = two_digits(text + 8);
    bool leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
    *valid &= in_range(month, 1, 12) &&
              in_range(day, 1, days[month >= 1 && month <= 12 ? month - 1 : 0] + (month == 2 && leap ? 1 : 0));
    return 10;
}

/* hh:mm:ss[.digits]; a leap second (60) is allowed as in RFC 3339. */
static size_t time_part(const char *text, size_t length, bool *valid)
{
    if (length < 8 || two_digits(text) < 0 || text[2] != ':' || two_digits(text + 3) < 0 || text[5] != ':' ||
        two_digits(text + 6) < 0)
        return 0;
    *valid &= two_digits(text) <= 23 && two_digits(text + 3) <= 59 && two_digits(text + 6) <= 60;
    size_t used = 8;
    if (length > used + 1 && text[used] == '.' && is_digit(text[used + 1]))
        for (used++; used < length && is_digit(text[used]);)
            used++;
    return used;
}

/* Z or +hh:mm. */
static size_t offset_part(const char *text, size_t length, bool *valid)
{
    if (length >= 1 && (text[0] == 'Z' || text[0] == 'z'))
        return 1;
    if (length < 6 || (text[0] != '+' && text[0] != '-') || two_digits(text + 1) < 0 || text[3] != ':' ||
        two_digits(text + 4) < 0)
        return 0;
    *valid &= two_digits(text + 1) <= 23 && two_digits(text + 4) <= 59;
    return 6;
}

/* Length of the date or time at text, 0 when the shape is none. */
static size_t date_length(const char *text, size_t length, bool *valid)
{
    *valid = true;
    size_t used = date_part(text, length, valid);
    if (used == 0)
        return time_part(text, length, valid);
    if (length - used < 9 || (text[used] != 'T' && text[used] != 't' && text[used] != ' '))
        return used;
    size_t time = time_part(text + used + 1, length - used - 1, valid);
    if (time == 0)
        return used;
    used += 1 + time;
    return used + offset_part(text + used, length - used, valid);
}

/* ---- numbers ---- */

/* What may follow a value: the end, a blank, a newline, or a mark of the text around it. */
static bool ends_value(int c)
{
    return c == -1 || strchr(" \t\r\n,]}#", c) != NULL;
}

/* Digits with single underscores between them, as many as follow; the underscores are dropped. */
static size_t digits(const char *text, size_t length, const char *allowed, char *out, size_t *used)
{
    size_t at = 0;
    while (at < length && text[at] != 0 && strchr(allowed, text[at]) != NULL) {
        out[(*used)++] = text[at++];
        if (at + 1 < length && text[at] == '_' && text[at + 1] != 0 && strchr(allowed, text[at + 1]) != NULL)
            at++;
    }
    return at;
}

static bool fail_number(lom_toml_parser *parser, size_t length)
{
    int shown = length > 40 ? 40 : (int)length;
    return LOM_TOML_ERROR(parser, parser->at, "\"%.*s\" is not a value of TOML.", shown,
                          parser->source->text + parser->at);
}

/* Digits in a base of 2, 8, 10 or 16 as a value up to limit. */
static bool to_integer(const char *text, size_t length, unsigned base, uint64_t limit, uint64_t *value)
{
    *value = 0;
    for (size_t i = 0; i < length; i++) {
        int c = text[i];
        unsigned digit = (unsigned)(is_digit(c) ? c - '0' : (c | 0x20) - 'a' + 10);
        if (digit > limit || *value > (limit - digit) / base)
            return false;
        *value = *value * base + digit;
    }
    return true;
}

static bool prefixed_integer(lom_toml_parser *parser, const char *text, size_t length, char *buffer,
                             lom_toml_value *value)
{
    unsigned base = text[1] == 'x' ? 16 : text[1] == 'o' ? 8 : 2;
    const char *allowed = base == 16 ? "0123456789abcdefABCDEF" : base == 8 ? "01234567" : "01";
    size_t used = 0;
    if (length == 2 || digits(text + 2, length - 2, allowed, buffer, &used) != length - 2)
        return fail_number(parser, length);
    uint64_t magnitude;
    if (!to_integer(buffer, used, base, INT64_MAX, &magnitude))
        return LOM_TOML_ERROR(parser, parser->at, "this integer does not fit 64 bits.");
    value->type = LOM_TOML_INTEGER;
    value->integer = (int64_t)magnitude;
    return true;
}

static bool decimal_integer(lom_toml_parser *parser, const char *text, size_t length, lom_toml_value *value)
{
    bool negative = text[0] == '-', has_sign = text[0] == '-' || text[0] == '+';
    uint64_t magnitude, limit = (uint64_t)INT64_MAX + negative;
    if (!to_integer(text + has_sign, length - has_sign, 10, limit, &magnitude))
        return LOM_TOML_ERROR(parser, parser->at, "this integer does not fit 64 bits.");
    value->type = LOM_TOML_INTEGER;
    if (!negative)
        value->integer = (int64_t)magnitude;
    else
        value->integer = magnitude == limit ? INT64_MIN : -(int64_t)magnitude;
    return true;
}

/* [+-] digits [. digits] [e [+-] digits], inf, nan; copied without underscores into buffer. */
static bool decimal(lom_toml_parser *parser, const char *text, size_t length, char *buffer, lom_toml_value *value)
{
    size_t used = 0, at = 0;
    if (text[0] == '+' || text[0] == '-')
        buffer[used++] = text[at++];
    double sign = text[0] == '-' ? -1.0 : 1.0;
    if (length - at == 3 && (memcmp(text + at, "inf", 3) == 0 || memcmp(text + at, "nan", 3) == 0)) {
        value->type = LOM_TOML_FLOAT;
        value->number = text[at] == 'i' ? sign * __builtin_inf() : __builtin_nan("");
        return true;
    }
    static const char decimals[] = "0123456789";
    size_t whole = digits(text + at, length - at, decimals, buffer, &used);
    if (whole == 0 || (text[at] == '0' && whole > 1))
        return fail_number(parser, length);
    at += whole;
    bool is_float = false;
    if (at < length && text[at] == '.') {
        buffer[used++] = text[at++];
        size_t fraction = digits(text + at, length - at, decimals, buffer, &used);
        if (fraction == 0)
            return fail_number(parser, length);
        at += fraction;
        is_float = true;
    }
    if (at < length && (text[at] == 'e' || text[at] == 'E')) {
        buffer[used++] = text[at++];
        if (at < length && (text[at] == '+' || text[at] == '-'))
            buffer[used++] = text[at++];
        size_t exponent = digits(text + at, length - at, decimals, buffer, &used);
        if (exponent == 0)
            return fail_number(parser, length);
        at += exponent;
        is_float = true;
    }
    if (at != length)
        return fail_number(parser, length);
    if (!is_float)
        return decimal_integer(parser, buffer, used, value);
    value->type = LOM_TOML_FLOAT;
    return lom_parse_double(buffer, used, &value->number) == used || fail_number(parser, length);
}

static bool boolean(const char *text, size_t length, lom_toml_value *value)
{
    bool is_true = length == 4 && memcmp(text, "true", 4) == 0;
    if (!is_true && !(length == 5 && memcmp(text, "false", 5) == 0))
        return false;
    value->type = LOM_TOML_BOOLEAN;
    value->boolean = is_true;
    return true;
}

bool lom_toml_scalar(lom_toml_parser *parser, lom_toml_value *value)
{
    const char *text = parser->source->text + parser->at;
    size_t left = parser->source->size - parser->at;
    bool valid;
    size_t length = date_length(text, left, &valid);
    if (length > 0 && ends_value(lom_toml_peek(parser, length))) {
        if (!valid)
            return LOM_TOML_ERROR(parser, parser->at, "the calendar has no such date or time.");
        value->type = LOM_TOML_DATE;
        value->length = length;
        value->text = lom_arena_text(parser->arena, text, length, parser->error);
        parser->at += length;
        return value->text != NULL;
    }
    length = 0;
    while (!ends_value(lom_toml_peek(parser, length)))
        length++;
    if (length == 0)
        return LOM_TOML_ERROR(parser, parser->at, "a value is missing here.");
    char *buffer = lom_arena_take(parser->arena, length, 1, parser->error);
    if (buffer == NULL)
        return false;
    bool has_prefix = length >= 2 && text[0] == '0' && (text[1] == 'x' || text[1] == 'o' || text[1] == 'b');
    if (!boolean(text, length, value) && !(has_prefix ? prefixed_integer(parser, text, length, buffer, value)
                                                      : decimal(parser, text, length, buffer, value)))
        return false;
    parser->at += length;
    return true;
}
