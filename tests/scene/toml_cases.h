/* Tables of TOML documents and what becomes of them. A tree of TOML values as one line of text, in the order of the
 * source: {key=value,...}. Strings are printed with every byte that is not printable ASCII as \xNN, integers as i,
 * floats as f, dates as d: types are part of the text.
 */
#ifndef LOM_TESTS_TOML_CASES_H
#define LOM_TESTS_TOML_CASES_H

#include "check.h"
#include "scene/toml/toml.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

typedef struct dump {
    char text[4096];
    size_t used;
} dump;

static void dump_add(dump *out, const char *text)
{
    size_t length = strlen(text);
    if (out->used + length < sizeof out->text) {
        memcpy(out->text + out->used, text, length + 1);
        out->used += length;
    }
}

static void dump_string(dump *out, const char *text, size_t length, const char *quote)
{
    char one[8];
    dump_add(out, quote);
    for (size_t i = 0; i < length; i++) {
        unsigned char c = (unsigned char)text[i];
        snprintf(one, sizeof one, c >= 0x20 && c < 0x7f && c != '\\' ? "%c" : "\\x%02x", c);
        dump_add(out, one);
    }
    dump_add(out, quote);
}

static void dump_value(dump *out, const lom_toml_value *value)
{
    char text[64];
    switch (value->type) {
    case LOM_TOML_STRING:
        dump_string(out, value->text, value->length, "\"");
        break;
    case LOM_TOML_DATE:
        dump_add(out, "d");
        dump_string(out, value->text, value->length, "");
        break;
    case LOM_TOML_INTEGER:
        snprintf(text, sizeof text, "i%" PRId64, value->integer);
        dump_add(out, text);
        break;
    case LOM_TOML_FLOAT:
        text[0] = 'f';
        lom_print_double(text + 1, value->number);
        dump_add(out, text);
        break;
    case LOM_TOML_BOOLEAN:
        dump_add(out, value->boolean ? "true" : "false");
        break;
    case LOM_TOML_ARRAY:
    case LOM_TOML_TABLE:
        dump_add(out, value->type == LOM_TOML_ARRAY ? "[" : "{");
        for (size_t i = 0; i < value->count; i++) {
            dump_add(out, i > 0 ? "," : "");
            if (value->type == LOM_TOML_TABLE) {
                dump_string(out, value->items[i]->key, value->items[i]->key_length, "");
                dump_add(out, "=");
            }
            dump_value(out, value->items[i]);
        }
        dump_add(out, value->type == LOM_TOML_ARRAY ? "]" : "}");
        break;
    }
}

typedef struct document {
    const char *text;
    size_t size; /* 0: strlen */
} document;

#define TEXT(text)                                                                                                     \
    {                                                                                                                  \
        text, sizeof(text) - 1                                                                                         \
    }

typedef struct valid_case {
    document in;
    const char *out;
} valid_case;

typedef struct invalid_case {
    document in;
    const char *place; /* "line:column: " and the start of the sentence */
} invalid_case;

static lom_toml_value *parse(lom_arena *arena, lom_toml_source *source, document in, lom_error *error)
{
    *source = (lom_toml_source){ .name = "t", .text = in.text, .size = in.size };
    return lom_toml_parse(arena, source, error);
}

static void check_valid(const valid_case *cases, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        lom_arena arena = { 0 };
        lom_toml_source source;
        lom_error error = { 0 };
        lom_toml_value *root = parse(&arena, &source, cases[i].in, &error);
        CHECK(root != NULL, "case %zu: %s", i, error.text);
        if (root != NULL) {
            dump out = { .used = 0 };
            dump_value(&out, root);
            CHECK(strcmp(out.text, cases[i].out) == 0, "case %zu: is %s, expected %s", i, out.text, cases[i].out);
        }
        lom_arena_release(&arena);
    }
}

static void check_invalid(const invalid_case *cases, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        lom_arena arena = { 0 };
        lom_toml_source source;
        lom_error error = { 0 };
        lom_toml_value *root = parse(&arena, &source, cases[i].in, &error);
        char expected[200];
        snprintf(expected, sizeof expected, "t:%s", cases[i].place);
        CHECK(root == NULL, "case %zu is accepted: %s", i, cases[i].in.text);
        CHECK(strncmp(error.text, expected, strlen(expected)) == 0, "case %zu: \"%s\", expected \"%s\"", i, error.text,
              expected);
        lom_arena_release(&arena);
    }
}

#define VALID(cases)   check_valid(cases, sizeof(cases) / sizeof *(cases))
#define INVALID(cases) check_invalid(cases, sizeof(cases) / sizeof *(cases))

#endif
