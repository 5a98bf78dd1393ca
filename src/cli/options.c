/* Command lines from tables. In: argv and a table of options. Out: the values in the fields that the table names, the
 * other words in order, or a message that says what is wrong and what is allowed. Invariant: help, messages and parsing
 * read one table, so they cannot disagree. */
#include "options.h"

#include <stdarg.h>
#include <string.h>

enum { MAX_OPTIONS = 64, MAX_VALUE = 160 };

int lom_complain(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    fputs("lom: ", stderr);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    va_end(arguments);
    return LOM_EXIT_FAILED;
}

void lom_tell_warnings(const char *sentences, size_t count)
{
    size_t told = 0;
    for (const char *at = sentences; *at != 0; told++) {
        size_t length = strcspn(at, "\n");
        fprintf(stderr, "lom: warning: %.*s\n", (int)length, at);
        at += length + (at[length] != 0);
    }
    if (told < count)
        fprintf(stderr, "lom: warning: %zu more warnings are not shown.\n", count - told);
}

int lom_complain_error(const lom_error *error)
{
    return lom_complain("%s", error->text);
}

static bool refuse(const lom_command_line *line, const char *format, ...) __attribute__((format(printf, 2, 3)));
static bool refuse(const lom_command_line *line, const char *format, ...)
{
    char text[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    lom_complain("%s: %s", line->name, text);
    return false;
}

static bool has_limits(const lom_option *option)
{
    return option->minimum < option->maximum;
}

static bool store_number(const lom_command_line *line, const lom_option *option, const char *word, void *field)
{
    double value;
    size_t length = strlen(word);
    if (length == 0 || lom_parse_double(word, length, &value) != length)
        return refuse(line, "--%s takes a number, not \"%s\"", option->name, word);
    if (has_limits(option) && !(value >= option->minimum && value <= option->maximum))
        return refuse(line, "--%s %s: the number must be from %.15g to %.15g", option->name, word, option->minimum,
                      option->maximum);
    *(lom_option_number *)field = (lom_option_number){ .given = true, .value = value };
    return true;
}

/* Digits with an optional sign at *text; moves *text behind them. False for none, or for more than 15 digits, which no
 * range here reaches and an int64 and a double hold exactly. */
static bool take_integer(const char **text, int64_t *value)
{
    bool negative = **text == '-';
    const char *p = *text + negative;
    int digits = 0;
    *value = 0;
    for (; *p >= '0' && *p <= '9' && digits < 16; p++, digits++)
        *value = *value * 10 + (*p - '0');
    *value = negative ? -*value : *value;
    *text = p;
    return digits > 0 && digits < 16;
}

int lom_match_integers(const char *pattern, const char *text, int64_t value[4])
{
    int count = 0;
    for (; *pattern != 0 && *pattern != '|'; pattern++) {
        bool is_integer = *pattern >= 'A' && *pattern <= 'Z' && count < 4;
        if (is_integer ? !take_integer(&text, &value[count]) : *text++ != *pattern)
            return 0;
        count += is_integer;
    }
    return *text == 0 ? count : 0;
}

static bool store_integers(const lom_command_line *line, const lom_option *option, const char *word, void *field)
{
    lom_option_integers values = { .given = true };
    const char *bar = strchr(option->value, '|');
    if (bar != NULL && strcmp(word, bar + 1) == 0) {
        values.is_word = true;
        *(lom_option_integers *)field = values;
        return true;
    }
    int count = lom_match_integers(option->value, word, values.value);
    if (count == 0)
        return refuse(line, "--%s takes %s in whole numbers, not \"%s\"", option->name, option->value, word);
    for (int i = 0; i < count && has_limits(option); i++)
        if ((double)values.value[i] < option->minimum || (double)values.value[i] > option->maximum)
            return refuse(line, "--%s %s: whole numbers must be from %.15g to %.15g", option->name, word,
                          option->minimum, option->maximum);
    *(lom_option_integers *)field = values;
    return true;
}

/* How the word after an option is shown. */
static void show_value(const lom_command_line *line, const lom_option *option, char *text, size_t room)
{
    size_t length = 0;
    if (option->value != NULL)
        snprintf(text, room, "%s", option->value);
    for (size_t i = 0; option->value == NULL && line->choice(i) != NULL && length < room; i++) {
        int added = snprintf(text + length, room - length, "%s%s", i > 0 ? "|" : "", line->choice(i));
        length += added > 0 ? (size_t)added : 0;
    }
}

static bool store_choice(const lom_command_line *line, const lom_option *option, const char *word, void *field)
{
    char choices[MAX_VALUE];
    size_t length = strlen(word);
    show_value(line, option, choices, sizeof choices);
    for (const char *choice = choices; *choice != 0;) {
        size_t end = strcspn(choice, "|");
        if (end == length && memcmp(choice, word, length) == 0) {
            *(const char **)field = word;
            return true;
        }
        choice += end + (choice[end] == '|');
    }
    return refuse(line, "--%s takes %s, not \"%s\"", option->name, choices, word);
}

static bool store(const lom_command_line *line, const lom_option *option, const char *word, void *values)
{
    void *field = (char *)values + option->field;
    switch (option->kind) {
    case LOM_OPTION_FLAG:
        *(bool *)field = true;
        return true;
    case LOM_OPTION_TEXT:
        *(const char **)field = word;
        return true;
    case LOM_OPTION_CHOICE:
        return store_choice(line, option, word, field);
    case LOM_OPTION_NUMBER:
        return store_number(line, option, word, field);
    case LOM_OPTION_INTEGER:
        return store_integers(line, option, word, field);
    case LOM_OPTION_LIST: {
        lom_option_list *list = field;
        if (list->count == LOM_OPTION_LIST_MAX)
            return refuse(line, "more than %d times --%s", LOM_OPTION_LIST_MAX, option->name);
        list->items[list->count++] = word;
        return true;
    }
    }
    return false;
}

static const lom_option *find_long(const lom_command_line *line, const char *name, size_t length)
{
    for (size_t i = 0; i < line->option_count; i++)
        if (strlen(line->options[i].name) == length && memcmp(line->options[i].name, name, length) == 0)
            return &line->options[i];
    return NULL;
}

static const lom_option *find_letter(const lom_command_line *line, char letter)
{
    for (size_t i = 0; i < line->option_count; i++)
        if (line->options[i].letter == letter)
            return &line->options[i];
    return NULL;
}

static bool refuse_unknown(const lom_command_line *line, const char *word)
{
    const char *names[MAX_OPTIONS];
    size_t count = 0;
    for (size_t i = 0; i < line->option_count && count < MAX_OPTIONS - 1; i++)
        names[count++] = line->options[i].name;
    names[count++] = "help";
    const char *name = word + strspn(word, "-");
    const char *near = lom_nearest_name(name, strcspn(name, "="), names, count);
    if (near != NULL)
        return refuse(line, "unknown option \"%s\" (did you mean \"--%s\"?)", word, near);
    return refuse(line, "unknown option \"%s\"; `lom %s --help` lists them", word, line->name);
}

/* One option at argv[*at]: the option, and the word that belongs to it (NULL for a flag). *at moves to the last word
 * used. */
static const lom_option *take_option(const lom_command_line *line, int argc, char **argv, int *at, const char **word)
{
    const char *text = argv[*at];
    const lom_option *option;
    *word = NULL;
    if (text[1] == '-') {
        size_t length = strcspn(text + 2, "=");
        option = find_long(line, text + 2, length);
        if (text[2 + length] == '=')
            *word = text + 2 + length + 1;
    } else {
        option = find_letter(line, text[1]);
        if (text[2] != 0)
            *word = text + 2;
    }
    if (option == NULL) {
        refuse_unknown(line, text);
        return NULL;
    }
    if (option->kind == LOM_OPTION_FLAG && *word != NULL) {
        refuse(line, "--%s takes no value, but got \"%s\"", option->name, *word);
        return NULL;
    }
    if (option->kind != LOM_OPTION_FLAG && *word == NULL) {
        const char *next = *at + 1 < argc ? argv[*at + 1] : NULL;
        bool is_option =
            next != NULL && strncmp(next, "--", 2) == 0 && find_long(line, next + 2, strcspn(next + 2, "="));
        if (next == NULL || is_option) { /* what is named like an option takes --name=--value */
            char value[MAX_VALUE];
            show_value(line, option, value, sizeof value);
            refuse(line, "--%s needs a value: %s", option->name, value);
            return NULL;
        }
        *word = argv[++*at];
    }
    return option;
}

static bool check_arguments(const lom_command_line *line, int count)
{
    if (count < line->minimum_arguments)
        return refuse(line, "too few arguments; usage: lom %s [OPTION]... %s", line->name, line->arguments);
    if (line->maximum_arguments >= 0 && count > line->maximum_arguments)
        return refuse(line, "too many arguments; usage: lom %s [OPTION]... %s", line->name, line->arguments);
    return true;
}

bool lom_parse_options(const lom_command_line *line, int argc, char **argv, void *values, lom_arguments *arguments,
                       int *status)
{
    bool seen[MAX_OPTIONS] = { false };
    bool options_ended = false;
    *status = LOM_EXIT_FAILED;
    *arguments = (lom_arguments){ .count = 0, .items = argv + 1 };
    for (int at = 1; at < argc; at++) {
        char *text = argv[at];
        if (options_ended || text[0] != '-' || text[1] == 0) {
            arguments->items[arguments->count++] = text;
            continue;
        }
        if (strcmp(text, "--") == 0) {
            options_ended = true;
            continue;
        }
        if (strcmp(text, "--help") == 0 || (strcmp(text, "-h") == 0 && find_letter(line, 'h') == NULL)) {
            lom_print_help(line, stdout);
            *status = LOM_EXIT_DONE;
            return false;
        }
        const char *word;
        const lom_option *option = take_option(line, argc, argv, &at, &word);
        if (option == NULL)
            return false;
        size_t index = (size_t)(option - line->options);
        if (index < MAX_OPTIONS && seen[index] && option->kind != LOM_OPTION_LIST)
            return refuse(line, "--%s is given twice", option->name);
        if (index < MAX_OPTIONS)
            seen[index] = true;
        if (!store(line, option, word, values))
            return false;
    }
    if (!check_arguments(line, arguments->count))
        return false;
    *status = LOM_EXIT_DONE;
    return true;
}

static void print_option(const lom_command_line *line, const lom_option *option, FILE *out)
{
    enum { COLUMN = 32 };
    char left[64 + MAX_VALUE], limits[96] = "", value[MAX_VALUE] = "";
    char letter[8] = "    ";
    if (option->letter != 0)
        snprintf(letter, sizeof letter, "-%c, ", option->letter);
    if (option->kind != LOM_OPTION_FLAG)
        show_value(line, option, value, sizeof value);
    snprintf(left, sizeof left, "  %s--%s%s%s", letter, option->name, value[0] != 0 ? " " : "", value);
    if ((option->kind == LOM_OPTION_NUMBER || option->kind == LOM_OPTION_INTEGER) && has_limits(option))
        snprintf(limits, sizeof limits, " (%.15g to %.15g)", option->minimum, option->maximum);
    fprintf(out, "%-*s", COLUMN, left);
    if (strlen(left) >= COLUMN)
        fprintf(out, "\n%*s", COLUMN, "");
    fprintf(out, "%s%s%s\n", option->help, limits, option->kind == LOM_OPTION_LIST ? "; may be repeated" : "");
}

void lom_print_help(const lom_command_line *line, FILE *out)
{
    static const lom_option help = { .name = "help", .letter = 'h', .help = "print this and exit" };
    bool has_arguments = line->arguments != NULL && line->arguments[0] != 0;
    fprintf(out, "usage: lom %s [OPTION]...%s%s\n\n%s.\n\noptions:\n", line->name, has_arguments ? " " : "",
            has_arguments ? line->arguments : "", line->summary);
    for (size_t i = 0; i < line->option_count; i++)
        print_option(line, &line->options[i], out);
    print_option(line, &help, out);
    if (line->details != NULL)
        fprintf(out, "\n%s\n", line->details);
    if (line->print_more != NULL)
        line->print_more(out);
}
