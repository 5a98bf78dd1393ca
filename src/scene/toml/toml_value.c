/* TOML: keys, values, arrays and inline tables. In: bytes at the parser's position. Out: values in the tree. Invariant:
 * a table never has the same key twice, and a table that is complete as written is never added to. */
#include "scene/toml/toml_parser.h"

#include <string.h>

lom_toml_value *lom_toml_find(const lom_toml_value *table, const char *key, size_t length)
{
    if (table == NULL || table->type != LOM_TOML_TABLE)
        return NULL;
    for (size_t i = 0; i < table->count; i++)
        if (table->items[i]->key_length == length && memcmp(table->items[i]->key, key, length) == 0)
            return table->items[i];
    return NULL;
}

static bool append(lom_arena *arena, lom_toml_value *container, lom_toml_value *value, lom_error *error)
{
    lom_toml_value **items = lom_arena_grow(arena, container->items, container->count, &container->capacity,
                                            sizeof(lom_toml_value *), error);
    if (items == NULL)
        return false;
    container->items = items;
    container->items[container->count++] = value;
    return true;
}

bool lom_toml_put(lom_arena *arena, lom_toml_value *table, lom_toml_value *value, lom_error *error)
{
    for (size_t i = 0; i < table->count; i++) {
        const lom_toml_value *old = table->items[i];
        if (old->key_length == value->key_length && memcmp(old->key, value->key, value->key_length) == 0) {
            table->items[i] = value;
            return true;
        }
    }
    return append(arena, table, value, error);
}

lom_toml_value *lom_toml_new(lom_toml_parser *parser, lom_toml_type type, size_t offset)
{
    if (++parser->value_count > LOM_TOML_MAX_VALUES) {
        lom_toml_fail(parser->source, offset, LOM_ERROR_LIMIT, parser->error,
                      "the document has more than the limit of %d values.", LOM_TOML_MAX_VALUES);
        return NULL;
    }
    lom_toml_value *value = lom_arena_take(parser->arena, 1, sizeof *value, parser->error);
    if (value == NULL)
        return NULL;
    value->type = type;
    value->source = parser->source;
    value->offset = value->key_offset = offset;
    return value;
}

bool lom_toml_append(lom_toml_parser *parser, lom_toml_value *container, lom_toml_value *value)
{
    if (container->type == LOM_TOML_TABLE && container->count >= LOM_TOML_MAX_KEYS)
        return lom_toml_fail(parser->source, value->key_offset, LOM_ERROR_LIMIT, parser->error,
                             "this table has more than the limit of %d keys.", LOM_TOML_MAX_KEYS);
    return append(parser->arena, container, value, parser->error);
}

lom_toml_value *lom_toml_child(lom_toml_parser *parser, lom_toml_value *table, const lom_toml_value *part,
                               lom_toml_type type, unsigned flags)
{
    lom_toml_value *child = lom_toml_new(parser, type, part->key_offset);
    if (child == NULL)
        return NULL;
    child->key = part->key;
    child->key_length = part->key_length;
    child->flags = flags;
    return lom_toml_append(parser, table, child) ? child : NULL;
}

/* ---- keys ---- */

static bool is_bare(int c)
{
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' || c == '-';
}

bool lom_toml_key(lom_toml_parser *parser, lom_toml_value *part)
{
    part->key_offset = parser->at;
    int c = lom_toml_peek(parser, 0);
    if (c == '"' || c == '\'')
        return lom_toml_string(parser, false, &part->key, &part->key_length);
    size_t length = 0;
    while (is_bare(lom_toml_peek(parser, length)))
        length++;
    if (length == 0)
        return LOM_TOML_ERROR(parser, parser->at, "a key is missing here (letters, digits, - and _, or quoted).");
    part->key = lom_arena_text(parser->arena, parser->source->text + parser->at, length, parser->error);
    part->key_length = length;
    parser->at += length;
    return part->key != NULL;
}

/* The table that a.b.c = ... adds c to: the dots before it make tables, or go on in those that dots made. */
static lom_toml_value *dotted_table(lom_toml_parser *parser, lom_toml_value *table, const lom_toml_value *part)
{
    lom_toml_value *child = lom_toml_find(table, part->key, part->key_length);
    if (child == NULL)
        return lom_toml_child(parser, table, part, LOM_TOML_TABLE, LOM_TOML_DOTTED);
    if (child->type != LOM_TOML_TABLE) {
        LOM_TOML_ERROR(parser, part->key_offset, "\"%s\" is %s already and cannot have keys.", part->key,
                       lom_toml_type_name(child->type));
        return NULL;
    }
    if (child->flags & (LOM_TOML_DEFINED | LOM_TOML_CLOSED)) {
        LOM_TOML_ERROR(parser, part->key_offset, "the table \"%s\" is complete already and cannot be added to.",
                       part->key);
        return NULL;
    }
    child->flags |= LOM_TOML_DOTTED;
    return child;
}

static bool is_duplicate(lom_toml_parser *parser, const lom_toml_value *table, const lom_toml_value *part)
{
    const lom_toml_value *old = lom_toml_find(table, part->key, part->key_length);
    if (old == NULL)
        return false;
    size_t line, column;
    lom_toml_place(parser->source, old->key_offset, &line, &column);
    LOM_TOML_ERROR(parser, part->key_offset, "the key \"%s\" stands in this table already (line %zu).", part->key,
                   line);
    return true;
}

bool lom_toml_pair(lom_toml_parser *parser, lom_toml_value *table)
{
    lom_toml_value part = { 0 };
    for (int depth = 1;; depth++) {
        if (!lom_toml_key(parser, &part))
            return false;
        lom_toml_skip_blanks(parser);
        if (lom_toml_peek(parser, 0) != '.')
            break;
        if (depth >= LOM_TOML_MAX_DEPTH)
            return LOM_TOML_ERROR(parser, parser->at, "a key has at most %d parts.", LOM_TOML_MAX_DEPTH);
        parser->at++;
        lom_toml_skip_blanks(parser);
        table = dotted_table(parser, table, &part);
        if (table == NULL)
            return false;
    }
    if (lom_toml_peek(parser, 0) != '=')
        return LOM_TOML_ERROR(parser, parser->at, "\"=\" must follow the key \"%s\".", part.key);
    if (is_duplicate(parser, table, &part))
        return false;
    parser->at++;
    lom_toml_skip_blanks(parser);
    lom_toml_value *value = lom_toml_any_value(parser);
    if (value == NULL)
        return false;
    value->key = part.key;
    value->key_length = part.key_length;
    value->key_offset = part.key_offset;
    return lom_toml_append(parser, table, value);
}

/* ---- values ---- */

static bool array(lom_toml_parser *parser, lom_toml_value *value)
{
    parser->at++;
    for (;;) {
        if (!lom_toml_skip_lines(parser))
            return false;
        if (lom_toml_peek(parser, 0) == ']')
            break;
        lom_toml_value *item = lom_toml_any_value(parser);
        if (item == NULL || !lom_toml_append(parser, value, item) || !lom_toml_skip_lines(parser))
            return false;
        int c = lom_toml_peek(parser, 0);
        if (c == -1)
            return LOM_TOML_ERROR(parser, value->offset, "this array never ends.");
        if (c != ',' && c != ']')
            return LOM_TOML_ERROR(parser, parser->at, "\",\" or \"]\" must follow a value of an array.");
        parser->at += c == ',';
    }
    parser->at++;
    return true;
}

/* Tables inside an inline table are complete with it. */
static void close_tables(lom_toml_value *table)
{
    table->flags |= LOM_TOML_CLOSED;
    for (size_t i = 0; i < table->count; i++)
        if (table->items[i]->type == LOM_TOML_TABLE && !(table->items[i]->flags & LOM_TOML_CLOSED))
            close_tables(table->items[i]);
}

static bool inline_table(lom_toml_parser *parser, lom_toml_value *value)
{
    parser->at++;
    lom_toml_skip_blanks(parser);
    bool empty = lom_toml_peek(parser, 0) == '}';
    while (!empty) {
        if (!lom_toml_pair(parser, value))
            return false;
        lom_toml_skip_blanks(parser);
        int c = lom_toml_peek(parser, 0);
        if (c == '}')
            break;
        if (c != ',')
            return LOM_TOML_ERROR(parser, parser->at,
                                  "\",\" or \"}\" must follow a value of an inline table, on the same line.");
        parser->at++;
        lom_toml_skip_blanks(parser);
    }
    parser->at++;
    close_tables(value);
    return true;
}

static bool nested(lom_toml_parser *parser, lom_toml_value *value)
{
    if (parser->depth >= LOM_TOML_MAX_DEPTH)
        return lom_toml_fail(parser->source, value->offset, LOM_ERROR_LIMIT, parser->error, "values may nest %d deep.",
                             LOM_TOML_MAX_DEPTH);
    parser->depth++;
    bool good = value->type == LOM_TOML_ARRAY ? array(parser, value) : inline_table(parser, value);
    parser->depth--;
    return good;
}

lom_toml_value *lom_toml_any_value(lom_toml_parser *parser)
{
    int c = lom_toml_peek(parser, 0);
    lom_toml_type type = c == '[' ? LOM_TOML_ARRAY : c == '{' ? LOM_TOML_TABLE : LOM_TOML_STRING;
    lom_toml_value *value = lom_toml_new(parser, type, parser->at);
    if (value == NULL)
        return NULL;
    bool good;
    if (c == '[' || c == '{')
        good = nested(parser, value);
    else if (c == '"' || c == '\'')
        good = lom_toml_string(parser, true, &value->text, &value->length);
    else
        good = lom_toml_scalar(parser, value);
    return good ? value : NULL;
}
