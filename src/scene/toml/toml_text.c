/* TOML: characters, comments, line ends and strings. In: bytes at the parser's position. Out: checked text, UTF-8
 * without escapes. Invariant: what was accepted is valid UTF-8 and holds no control character that TOML forbids. */
#include "base/utf8.h"
#include "scene/toml/toml_parser.h"

#include <string.h>

bool lom_toml_check_utf8(lom_toml_parser *parser)
{
    const unsigned char *text = (const unsigned char *)parser->source->text;
    size_t size = parser->source->size;
    for (size_t at = 0; at < size;) {
        size_t length = lom_utf8_length(text + at, size - at);
        if (length == 0)
            return LOM_TOML_ERROR(parser, at, "the byte 0x%02x is not UTF-8 here.", (unsigned)text[at]);
        at += length;
    }
    return true;
}

/* Control characters other than the tab, which no part of a document may hold. */
static bool is_control(int c)
{
    return (c >= 0 && c < 0x20 && c != '\t') || c == 0x7f;
}

static bool fail_control(lom_toml_parser *parser, size_t offset, const char *where)
{
    return LOM_TOML_ERROR(parser, offset, "a control character (U+%04X) may not stand in %s.",
                          (unsigned)(unsigned char)parser->source->text[offset], where);
}

/* Length of the newline at the position: 0, 1 or 2 bytes. */
static size_t newline_length(const lom_toml_parser *parser)
{
    int c = lom_toml_peek(parser, 0);
    if (c == '\n')
        return 1;
    return c == '\r' && lom_toml_peek(parser, 1) == '\n' ? 2 : 0;
}

void lom_toml_skip_blanks(lom_toml_parser *parser)
{
    while (lom_toml_peek(parser, 0) == ' ' || lom_toml_peek(parser, 0) == '\t')
        parser->at++;
}

/* Blanks and a comment, up to the newline or the end. */
static bool skip_comment(lom_toml_parser *parser)
{
    lom_toml_skip_blanks(parser);
    if (lom_toml_peek(parser, 0) != '#')
        return true;
    while (lom_toml_peek(parser, 0) != -1 && newline_length(parser) == 0) {
        if (is_control(lom_toml_peek(parser, 0)))
            return fail_control(parser, parser->at, "a comment");
        parser->at++;
    }
    return true;
}

bool lom_toml_skip_lines(lom_toml_parser *parser)
{
    for (;;) {
        if (!skip_comment(parser))
            return false;
        size_t length = newline_length(parser);
        if (length == 0)
            return true;
        parser->at += length;
    }
}

bool lom_toml_end_line(lom_toml_parser *parser)
{
    if (!skip_comment(parser))
        return false;
    size_t length = newline_length(parser);
    if (length == 0 && lom_toml_peek(parser, 0) != -1)
        return LOM_TOML_ERROR(parser, parser->at, "the line must end here; a new key or table starts on its own line.");
    parser->at += length;
    return true;
}

/* ---- strings ---- */

/* Writes a code point as UTF-8 and returns its length. */
static size_t encode_utf8(char *out, uint32_t point)
{
    if (point < 0x80) {
        out[0] = (char)point;
        return 1;
    }
    size_t length = point < 0x800 ? 2 : point < 0x10000 ? 3 : 4;
    static const unsigned char lead[] = { 0, 0, 0xc0, 0xe0, 0xf0 };
    for (size_t i = length - 1; i > 0; i--) {
        out[i] = (char)(0x80 | (point & 0x3f));
        point >>= 6;
    }
    out[0] = (char)(lead[length] | point);
    return length;
}

static int hex_value(int c)
{
    if (c >= '0' && c <= '9')
        return c - '0';
    if (c >= 'a' && c <= 'f')
        return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/* \uXXXX or \UXXXXXXXX at the position: a Unicode scalar value (no surrogate). Returns the bytes written, 0 on failure.
 */
static size_t unicode_escape(lom_toml_parser *parser, char *out)
{
    size_t start = parser->at, digits = lom_toml_peek(parser, 1) == 'u' ? 4 : 8;
    uint32_t point = 0;
    for (size_t i = 0; i < digits; i++) {
        int digit = hex_value(lom_toml_peek(parser, 2 + i));
        if (digit < 0)
            return LOM_TOML_ERROR(parser, start, "\\%c needs %zu hexadecimal digits.", digits == 4 ? 'u' : 'U', digits);
        point = point << 4 | (uint32_t)digit;
    }
    if (point > 0x10ffff || (point >= 0xd800 && point <= 0xdfff))
        return LOM_TOML_ERROR(parser, start, "U+%04X is not a Unicode character.", (unsigned)point);
    parser->at += 2 + digits;
    return encode_utf8(out, point);
}

/* A backslash before the end of a line: it, the newline and all blanks and newlines up to the next character vanish. */
static bool skip_line_end(lom_toml_parser *parser)
{
    size_t start = parser->at++;
    lom_toml_skip_blanks(parser);
    if (newline_length(parser) == 0)
        return LOM_TOML_ERROR(parser, start, "a backslash before blanks must be the last character of the line.");
    for (size_t length; (length = newline_length(parser)) > 0;) {
        parser->at += length;
        lom_toml_skip_blanks(parser);
    }
    return true;
}

/* An escape at the position; *used grows by what it stands for. */
static bool escape(lom_toml_parser *parser, bool multi_line, char *out, size_t *used)
{
    static const char names[] = "btnfr\"\\", values[] = "\b\t\n\f\r\"\\";
    int c = lom_toml_peek(parser, 1);
    const char *name = c > 0 ? memchr(names, c, sizeof names - 1) : NULL;
    if (name != NULL) {
        out[(*used)++] = values[name - names];
        parser->at += 2;
        return true;
    }
    if (c == 'u' || c == 'U') {
        size_t length = unicode_escape(parser, out + *used);
        *used += length;
        return length > 0;
    }
    if (multi_line && (c == ' ' || c == '\t' || c == '\n' || c == '\r'))
        return skip_line_end(parser);
    return LOM_TOML_ERROR(parser, parser->at,
                          "unknown escape; TOML has \\b \\t \\n \\f \\r \\\" \\\\ \\uXXXX \\UXXXXXXXX.");
}

/* The number of quotes in a row at the position, at most 5. */
static size_t count_quotes(const lom_toml_parser *parser, int quote)
{
    size_t count = 0;
    while (count < 5 && lom_toml_peek(parser, count) == quote)
        count++;
    return count;
}

/* The content of a string behind its opening quotes, up to and with its closing ones. */
static bool content(lom_toml_parser *parser, size_t start, int quote, bool multi_line, char *out, size_t *used)
{
    for (;;) {
        int c = lom_toml_peek(parser, 0);
        if (c == -1)
            return LOM_TOML_ERROR(parser, start, "this string never ends.");
        if (c == quote && !multi_line) {
            parser->at++;
            return true;
        }
        if (c == quote) {
            size_t quotes = count_quotes(parser, quote), kept = quotes >= 3 ? quotes - 3 : quotes;
            memset(out + *used, quote, kept); /* up to two quotes may stand before the closing three */
            *used += kept;
            parser->at += quotes;
            if (quotes >= 3)
                return true;
            continue;
        }
        if (c == '\\' && quote == '"') {
            if (!escape(parser, multi_line, out, used))
                return false;
            continue;
        }
        size_t newline = newline_length(parser);
        if (newline > 0 && !multi_line)
            return LOM_TOML_ERROR(parser, start, "this string does not end on its line.");
        if (newline == 0 && is_control(c))
            return fail_control(parser, parser->at, "a string");
        out[(*used)++] = newline > 0 ? '\n' : (char)c; /* CRLF is read as one newline: the same text everywhere */
        parser->at += newline > 0 ? newline : 1;
    }
}

/* An upper bound of the string's length: the bytes up to a possible end. */
static size_t content_bound(const lom_toml_parser *parser, int quote, bool multi_line)
{
    const char *text = parser->source->text + parser->at;
    size_t left = parser->source->size - parser->at;
    for (size_t i = 0; i < left; i++) {
        if (text[i] == '\\' && quote == '"')
            i++;
        else if (multi_line ? left - i >= 3 && text[i] == quote && text[i + 1] == quote && text[i + 2] == quote
                            : text[i] == quote || text[i] == '\n')
            return i + 5;
    }
    return left;
}

bool lom_toml_string(lom_toml_parser *parser, bool multi_line, const char **text, size_t *length)
{
    size_t start = parser->at;
    int quote = lom_toml_peek(parser, 0);
    bool triple = lom_toml_peek(parser, 1) == quote && lom_toml_peek(parser, 2) == quote;
    if (triple && !multi_line)
        return LOM_TOML_ERROR(parser, start, "a key may not be a multi-line string.");
    parser->at += triple ? 3 : 1;
    if (triple)
        parser->at += newline_length(parser); /* a newline right behind the opening quotes is dropped */
    char *out = lom_arena_take(parser->arena, content_bound(parser, quote, triple) + 1, 1, parser->error);
    if (out == NULL)
        return false;
    *text = out;
    *length = 0;
    return content(parser, start, quote, triple, out, length);
}
