/* What the files of the TOML parser share: the reading position and a function for each group of the grammar. */
#ifndef LOM_SCENE_TOML_TOML_PARSER_H
#define LOM_SCENE_TOML_TOML_PARSER_H

#include "scene/toml/toml.h"

typedef struct lom_toml_parser {
    lom_arena *arena;
    const lom_toml_source *source;
    size_t at;          /* the next byte to read */
    size_t value_count; /* so far */
    int depth;          /* of arrays and inline tables that are open */
    lom_error *error;
} lom_toml_parser;

/* The byte at position at + ahead, or -1 behind the end. */
static inline int lom_toml_peek(const lom_toml_parser *parser, size_t ahead)
{
    size_t left = parser->source->size - parser->at;
    return ahead < left ? (unsigned char)parser->source->text[parser->at + ahead] : -1;
}

/* Fails at a place of the source being parsed; always false. */
#define LOM_TOML_ERROR(parser, offset, ...)                                                                            \
    lom_toml_fail((parser)->source, offset, LOM_ERROR_INPUT, (parser)->error, __VA_ARGS__)

/* toml_text.c */
bool lom_toml_check_utf8(lom_toml_parser *parser);
void lom_toml_skip_blanks(lom_toml_parser *parser);
/* Skips blanks, comments and newlines; false when a comment or a newline is malformed. */
bool lom_toml_skip_lines(lom_toml_parser *parser);
/* Blanks, a comment and then a newline or the end must follow. */
bool lom_toml_end_line(lom_toml_parser *parser);
/* A quoted string at the position; the multi-line forms only where allowed. */
bool lom_toml_string(lom_toml_parser *parser, bool multi_line, const char **text, size_t *length);

/* toml_number.c: an integer, a float, a boolean or a date at the position. */
bool lom_toml_scalar(lom_toml_parser *parser, lom_toml_value *value);

/* toml_value.c */
lom_toml_value *lom_toml_new(lom_toml_parser *parser, lom_toml_type type, size_t offset);
bool lom_toml_append(lom_toml_parser *parser, lom_toml_value *container, lom_toml_value *value);
/* A new table or array that bears the key of part, appended to table. */
lom_toml_value *lom_toml_child(lom_toml_parser *parser, lom_toml_value *table, const lom_toml_value *part,
                               lom_toml_type type, unsigned flags);
/* One simple key at the position, into a value's key and key_offset. */
bool lom_toml_key(lom_toml_parser *parser, lom_toml_value *part);
/* key = value at the position, into table. */
bool lom_toml_pair(lom_toml_parser *parser, lom_toml_value *table);
lom_toml_value *lom_toml_any_value(lom_toml_parser *parser);

#endif
