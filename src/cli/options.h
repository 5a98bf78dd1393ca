/* Command lines from tables: a subcommand states its options once, and that table parses them, checks their ranges,
 * prints `--help` and suggests the nearest name for an unknown one. */
#ifndef LOM_CLI_OPTIONS_H
#define LOM_CLI_OPTIONS_H

#include <lom/base.h>

#include <stdio.h>

/* Exit statuses of the program and of every subcommand. */
enum {
    LOM_EXIT_DONE = 0,    /* done, accepted */
    LOM_EXIT_DIFFERS = 1, /* pictures differ, a check failed */
    LOM_EXIT_FAILED = 2   /* could not do it */
};

/* What the word after an option is, and the type of the field that receives it. */
typedef enum lom_option_kind {
    LOM_OPTION_FLAG,    /* no word; bool */
    LOM_OPTION_TEXT,    /* any word; const char *, NULL when absent */
    LOM_OPTION_CHOICE,  /* one of the words of `value`, separated by '|'; of the command line's `choice` when that is
                         * NULL; const char *, NULL when absent */
    LOM_OPTION_NUMBER,  /* a decimal number in [minimum, maximum]; lom_option_number */
    LOM_OPTION_INTEGER, /* integers in [minimum, maximum], in the pattern of `value`: a capital letter stands for an
                         * integer, anything else for itself ("N", "WxH", "A:B", "X,Y,W,H"); behind a '|' stands a
                         * word that may be given instead ("A:B|all"); lom_option_integers */
    LOM_OPTION_LIST     /* any word, may be repeated; lom_option_list */
} lom_option_kind;

typedef struct lom_option_number {
    bool given;
    double value;
} lom_option_number;

typedef struct lom_option_integers {
    bool given;
    bool is_word;     /* the word instead of integers */
    int64_t value[4]; /* as many as the pattern has capital letters */
} lom_option_integers;

static inline int64_t lom_given_or(const lom_option_integers *option, int64_t otherwise)
{
    return option->given ? option->value[0] : otherwise;
}

enum { LOM_OPTION_LIST_MAX = 256 };
typedef struct lom_option_list {
    int count;
    const char *items[LOM_OPTION_LIST_MAX]; /* in the order of the command line */
} lom_option_list;

typedef struct lom_option {
    const char *name; /* without the dashes: "size" */
    char letter;      /* 'o' for -o, 0 for none */
    lom_option_kind kind;
    size_t field;            /* offsetof the field in the subcommand's struct of values */
    const char *value;       /* how --help shows the word: "WxH"; also the pattern or the choices */
    double minimum, maximum; /* of numbers and integers, both included; both 0: no limits */
    const char *help;        /* one sentence, without a full stop */
} lom_option;

typedef struct lom_command_line {
    const char *name;                    /* "compare" */
    const char *arguments;               /* how the usage line shows what is no option: "A B" */
    const char *summary;                 /* one line */
    const char *(*choice)(size_t index); /* the words of a table to choose from: NULL behind the last */
    const char *details;                 /* paragraphs below the options; may be NULL */
    void (*print_more)(FILE *out);       /* what a table says below them; may be NULL */
    const lom_option *options;
    size_t option_count;
    int minimum_arguments, maximum_arguments; /* maximum -1: any number */
} lom_command_line;

/* What is left when the options are taken out, in order. The words belong to argv. */
typedef struct lom_arguments {
    int count;
    char **items;
} lom_arguments;

/* Parses argv[1, argc) into values (a zeroed struct whose fields the table names) and arguments; permutes argv so that
 * the arguments lie side by side. Options may stand anywhere before "--", as --name WORD, --name=WORD, -o WORD or
 * -oWORD; a flag may not have a word; an option that is no list may be given once; "-" is an argument. Returns true to
 * go on. Returns false to end with *status: 0 when --help was printed to stdout, 2 when the line is wrong, which has
 * been said on stderr. */
bool lom_parse_options(const lom_command_line *line, int argc, char **argv, void *values, lom_arguments *arguments,
                       int *status);

/* Integers in the pattern of an option's `value`, which has at least one: how many were read, 0 when text is not in it. */
int lom_match_integers(const char *pattern, const char *text, int64_t value[4]);

/* Prints the usage, the options and the details of line. */
void lom_print_help(const lom_command_line *line, FILE *out);

/* Prints "lom: " and the sentence and a newline to stderr; returns LOM_EXIT_FAILED. */
int lom_complain(const char *format, ...) __attribute__((format(printf, 1, 2)));
/* The same with the text of error. */
int lom_complain_error(const lom_error *error);
/* Prints "lom: warning: " and each of the sentences (ended by newlines) to stderr, and how many of count are left. */
void lom_tell_warnings(const char *sentences, size_t count);

#endif
