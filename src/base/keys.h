/* The vocabulary of scene keys: what a model layer says about the keys it reads, as data. A table of lom_key describes
 * the members of one parameter struct; the scene layer reads files, checks ranges, writes error messages and makes
 * docs/scene.md from the same tables. Invariant: nothing about a key is said anywhere else. */
#ifndef LOM_BASE_KEYS_H
#define LOM_BASE_KEYS_H

#include <lom/base.h>

typedef enum lom_key_type {                  /* the member behind offset */
                            LOM_KEY_BOOL,    /* bool */
                            LOM_KEY_INTEGER, /* int */
                            LOM_KEY_NUMBER,  /* double[count] */
                            LOM_KEY_ANGLE,   /* double[count]; degrees in the file, radians in the struct */
                            LOM_KEY_COLOR,   /* double[3]: linear red, green, blue */
                            LOM_KEY_STRING,  /* const char *[count], NULL when not given */
                            LOM_KEY_FILE, /* const char *[count], NULL when not given; resolved against the scene file's
                                             folder */
                            LOM_KEY_CHOICE, /* int: the index into choices */
                            LOM_KEY_TABLE,  /* the struct of table, inline */
                            LOM_KEY_TABLES  /* pointer to an array of structs of table, and a size_t at length_offset */
} lom_key_type;

enum {
    LOM_KEY_REQUIRED = 1, /* the table is an error without it */
    LOM_KEY_SPREAD = 2,   /* one number stands for all count of them */
    LOM_KEY_ABOVE = 4     /* minimum itself is outside the range */
};

/* What a setting is measured against (docs/dials.md). */
typedef enum lom_dial_reference {
    LOM_DIAL_TRACED, /* the picture of the reference tracer, or of random paths */
    LOM_DIAL_FINEST, /* the dial's own last setting: the tracer does not have what it approximates */
    LOM_DIAL_EQUAL   /* every other setting: none may change a byte */
} lom_dial_reference;

/* That a key trades accuracy for time, and how. Of a key inside [quality] it may say that it does not. */
typedef struct lom_key_dial {
    const char *approximates; /* what the settings stand for: half a sentence */
    const char *settings;     /* TOML values without spaces (words without quotes), the cheapest first, the most exact
                                 last */
    const char *needs;        /* where it acts: conditions separated by spaces, all of which hold. "A|B": one of these
                                 tables or keys is there and not 0 or false; "KEY=a|b": its value is one of these; NULL:
                                 always */
    lom_dial_reference reference;
    const char *none; /* why the key is no dial; NULL: it is one */
} lom_key_dial;

typedef struct lom_key {
    const char *name;
    lom_key_type type;
    size_t offset;
    int count;                         /* values of an array; 0 and 1 both mean one plain value */
    unsigned flags;                    /* LOM_KEY_... */
    double minimum, maximum;           /* of every number, in the file's unit; both 0: any finite number */
    double initial[4];                 /* the default of booleans, numbers and choices, in the file's unit */
    const char *unit;                  /* "m", "degrees", NULL for a plain number */
    const char *text;                  /* the documentation: sentences */
    const char *choices[12];           /* of LOM_KEY_CHOICE, ended by NULL */
    const struct lom_key_table *table; /* of LOM_KEY_TABLE and LOM_KEY_TABLES */
    size_t length_offset;              /* of LOM_KEY_TABLES */
    size_t
        others_offset; /* of LOM_KEY_TABLE: where the file may have an array of them instead, the first is inline and a
                             pointer to an array of the others is here, their number at length_offset; 0: it may not */
    const char *initial_text; /* what the documentation says of the default when no number can say it */
    const lom_key_dial *dial; /* of an approximation; every key inside [quality] has one */
    const char *untraced; /* the TOML value with which a picture has nothing that the reference does not: what is drawn
                             to be compared with it has this value; NULL: the reference knows the key, or it has no
                             such effect */
} lom_key;

/* What the check of a table asks and says: whether a key stands in the file (in none when the table is not there), and
 * what is wrong, at the key's place. */
typedef struct lom_key_check lom_key_check;
struct lom_key_check {
    bool (*is_given)(const lom_key_check *check, const char *key);
    bool (*fail)(const lom_key_check *check, const char *key, const char *sentence); /* false */
    /* The same of table i of the array of tables under key. */
    lom_key_check (*element)(const lom_key_check *check, const char *key, size_t i);
    /* The path of a file that the value of a key leads to; NULL, with a sentence, when it is not there. It lives as
     * long as the struct. */
    const char *(*path)(const lom_key_check *check, const char *key, const char *name);
    lom_error *error;  /* where `fail` says it, for what fails for another reason: memory */
    void *reader;      /* the scene layer's */
    const void *table; /* likewise; NULL: not in the file */
};

typedef struct lom_key_table {
    size_t size; /* of the struct; its first member is `bool present`: the table was in the file */
    const lom_key *keys;
    int key_count;
    const char *text; /* the documentation of the table: sentences */
    /* What concerns several keys of the table, and what is derived from them, once the struct and those inside it are
     * filled; false when it has failed. NULL: nothing. */
    bool (*check)(void *members, const lom_key_check *check);
} lom_key_table;

#endif
