/* TOML 1.0 (toml.io/en/v1.0.0): text in, a tree of values out. Invariant: every value knows the place it was written
 * at, so that whoever reads the tree later can still say "lake.toml:12:5". */
#ifndef LOM_SCENE_TOML_TOML_H
#define LOM_SCENE_TOML_TOML_H

#include "scene/toml/arena.h"

enum {
    LOM_TOML_MAX_SIZE = 16 << 20,    /* bytes of a document */
    LOM_TOML_MAX_DEPTH = 64,         /* arrays and inline tables in each other; parts of a dotted key */
    LOM_TOML_MAX_KEYS = 4096,        /* keys of one table */
    LOM_TOML_MAX_VALUES = 256 * 1024 /* values of all kinds in one document */
};

typedef enum lom_toml_type {
    LOM_TOML_STRING,
    LOM_TOML_INTEGER,
    LOM_TOML_FLOAT,
    LOM_TOML_BOOLEAN,
    LOM_TOML_DATE, /* any of the four kinds of dates and times, checked and kept as text */
    LOM_TOML_ARRAY,
    LOM_TOML_TABLE
} lom_toml_type;

/* Text that values were written in: a document, or an override. */
typedef struct lom_toml_source {
    const char *name; /* "lake.toml", or "--set water.level=3" */
    const char *text;
    size_t size;
    bool is_override; /* messages then name no line and column */
} lom_toml_source;

enum {                        /* how a table or array came to be; decides what may be added to it (TOML 1.0, "Table") */
       LOM_TOML_IMPLICIT = 1, /* [a.b] makes a */
       LOM_TOML_DEFINED = 2,  /* [a.b] defines b */
       LOM_TOML_DOTTED = 4,   /* a.b = 1 defines a */
       LOM_TOML_CLOSED = 8,   /* inline: complete as written */
       LOM_TOML_OF_TABLES = 16 /* an array that [[a]] made */
};

typedef struct lom_toml_value {
    lom_toml_type type;
    unsigned flags;
    const lom_toml_source *source;
    size_t offset;     /* of the value in the source; of the key in the header for tables that a header makes */
    size_t key_offset; /* of the key; equals offset in arrays */
    const char *key;   /* NULL in arrays; key_length bytes and a zero byte */
    size_t key_length;
    union {
        struct {
            const char *text; /* UTF-8, length bytes (which may be zero bytes too) and a zero byte */
            size_t length;
        };
        int64_t integer;
        double number;
        bool boolean;
        struct { /* of arrays and tables, in the order of the source */
            struct lom_toml_value **items;
            size_t count, capacity;
        };
    };
} lom_toml_value;

/* Parses a document into its root table. source and its text must live as long as the values; NULL on failure. */
lom_toml_value *lom_toml_parse(lom_arena *arena, const lom_toml_source *source, lom_error *error);

/* Parses the KEY of "KEY=VALUE" into at most LOM_TOML_MAX_DEPTH parts (values whose key and offset are set) and VALUE
 * into *value, which has the last part as its key. VALUE may be a bare word, which gives a string. */
bool lom_toml_parse_assignment(lom_arena *arena, const lom_toml_source *source, lom_toml_value *parts,
                               size_t *part_count, lom_toml_value **value, lom_error *error);

/* The value of a key of a table; NULL when there is none, or when table is NULL or none. */
lom_toml_value *lom_toml_find(const lom_toml_value *table, const char *key, size_t length);
/* Puts value under its own key into table, replacing the value that is there. */
bool lom_toml_put(lom_arena *arena, lom_toml_value *table, lom_toml_value *value, lom_error *error);

/* The line and the column (in characters), both from 1, of a place in a source. */
void lom_toml_place(const lom_toml_source *source, size_t offset, size_t *line, size_t *column);
/* Fails with "name:line:column: sentence", or "name: sentence" for an override. */
bool lom_toml_fail(const lom_toml_source *source, size_t offset, lom_code code, lom_error *error, const char *format,
                   ...) __attribute__((format(printf, 5, 6)));
/* "a string", "an integer", ... */
const char *lom_toml_type_name(lom_toml_type type);

#endif
