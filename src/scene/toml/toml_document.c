/* TOML: a whole document, and the KEY=VALUE of an override. In: text. Out: the root table. Invariant: a header opens
 * a table that nothing defined before (TOML 1.0, "Table" and "Array of Tables"). */
#include "base/utf8.h"
#include "scene/toml/toml_parser.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* ---- places ---- */

void lom_toml_place(const lom_toml_source *source, size_t offset, size_t *line, size_t *column)
{
    size_t start = source->size >= 3 && memcmp(source->text, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
    *line = *column = 1;
    for (size_t i = start; i < offset && i < source->size; i++) {
        unsigned char c = (unsigned char)source->text[i];
        *line += c == '\n';
        if (c == '\n')
            *column = 1;
        else
            *column += (c & 0xc0) != 0x80; /* the following bytes of a character count no column */
    }
}

/* A message is one line of UTF-8: a quoted key may hold a newline, and a name that was cut half a character. */
static void make_printable(char *text)
{
    for (size_t left = strlen(text); left > 0;) {
        size_t length = lom_utf8_length((const unsigned char *)text, left);
        if (length == 0 || (unsigned char)*text < 0x20 || *text == 0x7f)
            *text = '?';
        length += length == 0;
        text += length;
        left -= length;
    }
}

bool lom_toml_fail(const lom_toml_source *source, size_t offset, lom_code code, lom_error *error, const char *format,
                   ...)
{
    char sentence[320], message[sizeof error->text];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(sentence, sizeof sentence, format, arguments);
    va_end(arguments);
    size_t line, column;
    lom_toml_place(source, offset, &line, &column);
    if (source->is_override)
        snprintf(message, sizeof message, "%s: %s", source->name, sentence);
    else
        snprintf(message, sizeof message, "%s:%zu:%zu: %s", source->name, line, column, sentence);
    make_printable(message);
    return lom_fail(error, code, "%s", message);
}

const char *lom_toml_type_name(lom_toml_type type)
{
    static const char *const names[] = { "a string", "an integer", "a number", "true or false",
                                         "a date",   "an array",   "a table" };
    return names[type];
}

/* ---- headers ---- */

static lom_toml_value *fail_null(lom_toml_parser *parser, const lom_toml_value *part, const char *sentence)
{
    LOM_TOML_ERROR(parser, part->key_offset, sentence, part->key);
    return NULL;
}

/* Where [a.b] goes on behind a: the table a, or the last table of the array of tables a. */
static lom_toml_value *step_into(lom_toml_parser *parser, lom_toml_value *table, const lom_toml_value *part)
{
    lom_toml_value *child = lom_toml_find(table, part->key, part->key_length);
    if (child == NULL)
        return lom_toml_child(parser, table, part, LOM_TOML_TABLE, LOM_TOML_IMPLICIT);
    if (child->type == LOM_TOML_ARRAY && (child->flags & LOM_TOML_OF_TABLES))
        return child->items[child->count - 1];
    if (child->type != LOM_TOML_TABLE)
        return fail_null(parser, part, "\"%s\" is a value already and cannot have tables in it.");
    if (child->flags & LOM_TOML_CLOSED)
        return fail_null(parser, part, "\"%s\" is an inline table, which is complete and cannot be added to.");
    return child;
}

static lom_toml_value *open_table(lom_toml_parser *parser, lom_toml_value *table, const lom_toml_value *part)
{
    lom_toml_value *child = lom_toml_find(table, part->key, part->key_length);
    if (child == NULL)
        return lom_toml_child(parser, table, part, LOM_TOML_TABLE, LOM_TOML_DEFINED);
    if (child->type != LOM_TOML_TABLE)
        return fail_null(parser, part, "\"%s\" is a value or an array of tables already, not a table.");
    if (child->flags != LOM_TOML_IMPLICIT)
        return fail_null(parser, part, "the table \"%s\" is defined twice.");
    child->flags |= LOM_TOML_DEFINED;
    child->offset = child->key_offset = part->key_offset;
    return child;
}

static lom_toml_value *open_element(lom_toml_parser *parser, lom_toml_value *table, const lom_toml_value *part)
{
    lom_toml_value *list = lom_toml_find(table, part->key, part->key_length);
    if (list == NULL)
        list = lom_toml_child(parser, table, part, LOM_TOML_ARRAY, LOM_TOML_OF_TABLES);
    if (list == NULL)
        return NULL;
    if (list->type != LOM_TOML_ARRAY || !(list->flags & LOM_TOML_OF_TABLES))
        return fail_null(parser, part, "\"%s\" is something else already, not an array of tables.");
    lom_toml_value *element = lom_toml_new(parser, LOM_TOML_TABLE, part->key_offset);
    if (element == NULL || !lom_toml_append(parser, list, element))
        return NULL;
    element->flags = LOM_TOML_DEFINED;
    return element;
}

/* [a.b] or [[a.b]] at the position; the table it opens. */
static lom_toml_value *header(lom_toml_parser *parser, lom_toml_value *table)
{
    bool of_tables = lom_toml_peek(parser, 1) == '[';
    parser->at += of_tables ? 2 : 1;
    lom_toml_value part = { 0 };
    for (int depth = 1;; depth++) {
        lom_toml_skip_blanks(parser);
        if (!lom_toml_key(parser, &part))
            return NULL;
        lom_toml_skip_blanks(parser);
        if (lom_toml_peek(parser, 0) != '.')
            break;
        if (depth >= LOM_TOML_MAX_DEPTH)
            return fail_null(parser, &part, "a header has too many parts at \"%s\".");
        parser->at++;
        table = step_into(parser, table, &part);
        if (table == NULL)
            return NULL;
    }
    if (lom_toml_peek(parser, 0) != ']' || (of_tables && lom_toml_peek(parser, 1) != ']')) {
        LOM_TOML_ERROR(parser, parser->at, "\"%s\" must close this header.", of_tables ? "]]" : "]");
        return NULL;
    }
    parser->at += of_tables ? 2 : 1;
    return of_tables ? open_element(parser, table, &part) : open_table(parser, table, &part);
}

static bool document(lom_toml_parser *parser, lom_toml_value *root)
{
    if (parser->source->size >= 3 && memcmp(parser->source->text, "\xef\xbb\xbf", 3) == 0)
        parser->at = 3;
    lom_toml_value *table = root;
    for (;;) {
        if (!lom_toml_skip_lines(parser))
            return false;
        int c = lom_toml_peek(parser, 0);
        if (c == -1)
            return true;
        if (c == '[')
            table = header(parser, root);
        else if (!lom_toml_pair(parser, table))
            return false;
        if (table == NULL || !lom_toml_end_line(parser))
            return false;
    }
}

static bool check_size(lom_toml_parser *parser)
{
    if (parser->source->size > LOM_TOML_MAX_SIZE)
        return lom_fail(parser->error, LOM_ERROR_LIMIT, "%s: the file is larger than the limit of %d bytes.",
                        parser->source->name, LOM_TOML_MAX_SIZE);
    return lom_toml_check_utf8(parser);
}

lom_toml_value *lom_toml_parse(lom_arena *arena, const lom_toml_source *source, lom_error *error)
{
    lom_toml_parser parser = { .arena = arena, .source = source, .error = error };
    if (!check_size(&parser))
        return NULL;
    lom_toml_value *root = lom_toml_new(&parser, LOM_TOML_TABLE, 0);
    return root != NULL && document(&parser, root) ? root : NULL;
}

/* ---- KEY=VALUE ---- */

static bool assignment_key(lom_toml_parser *parser, lom_toml_value *parts, size_t *part_count)
{
    for (*part_count = 0;;) {
        lom_toml_skip_blanks(parser);
        if (*part_count >= LOM_TOML_MAX_DEPTH)
            return LOM_TOML_ERROR(parser, parser->at, "a key has at most %d parts.", LOM_TOML_MAX_DEPTH);
        lom_toml_value *part = &parts[(*part_count)++];
        *part = (lom_toml_value){ .source = parser->source };
        if (!lom_toml_key(parser, part))
            return false;
        lom_toml_skip_blanks(parser);
        if (lom_toml_peek(parser, 0) != '.')
            break;
        parser->at++;
    }
    if (lom_toml_peek(parser, 0) != '=')
        return LOM_TOML_ERROR(parser, parser->at, "an override has the form KEY=VALUE.");
    parser->at++;
    return true;
}

/* The rest of the source as a value: TOML, or a string without quotes where it starts like no other value of TOML that
 * needs a closing mark. */
static lom_toml_value *assignment_value(lom_toml_parser *parser)
{
    lom_toml_skip_blanks(parser);
    size_t start = parser->at;
    int c = lom_toml_peek(parser, 0);
    bool marked = c == '"' || c == '\'' || c == '[' || c == '{';
    lom_error ignored = { 0 };
    lom_toml_parser trial = *parser;
    trial.error = marked ? parser->error : &ignored;
    lom_toml_value *value = c == -1 ? NULL : lom_toml_any_value(&trial);
    if (value != NULL && lom_toml_end_line(&trial) && lom_toml_peek(&trial, 0) == -1)
        return value;
    if (marked) {
        LOM_TOML_ERROR(&trial, trial.at, "the value must end here.");
        return NULL;
    }
    value = lom_toml_new(parser, LOM_TOML_STRING, start);
    if (value == NULL)
        return NULL;
    value->length = parser->source->size - start;
    value->text = lom_arena_text(parser->arena, parser->source->text + start, value->length, parser->error);
    return value->text != NULL ? value : NULL;
}

bool lom_toml_parse_assignment(lom_arena *arena, const lom_toml_source *source, lom_toml_value *parts,
                               size_t *part_count, lom_toml_value **value, lom_error *error)
{
    lom_toml_parser parser = { .arena = arena, .source = source, .error = error };
    if (!check_size(&parser) || !assignment_key(&parser, parts, part_count))
        return false;
    *value = assignment_value(&parser);
    if (*value == NULL)
        return false;
    const lom_toml_value *last = &parts[*part_count - 1];
    (*value)->key = last->key;
    (*value)->key_length = last->key_length;
    (*value)->key_offset = last->key_offset;
    return true;
}
