/* Any bytes as the words of a command line, zeros between them: the parser accepts what a plain reading of the table
 * accepts, with the numbers of that reading, and refuses the rest. */
#include "cli/options.h"

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

struct values {
    lom_option_integers size, range, crop, count;
    lom_option_number share, any;
    lom_option_list list;
    const char *text, *choice;
    bool flag;
};

static const lom_option options[] = {
    { .name = "size",
      .kind = LOM_OPTION_INTEGER,
      .field = offsetof(struct values, size),
      .value = "WxH",
      .minimum = 1,
      .maximum = 32768 },
    { .name = "range",
      .kind = LOM_OPTION_INTEGER,
      .field = offsetof(struct values, range),
      .value = "A:B",
      .minimum = -9,
      .maximum = 1e9 },
    { .name = "crop",
      .kind = LOM_OPTION_INTEGER,
      .field = offsetof(struct values, crop),
      .value = "X,Y,W,H",
      .minimum = -32768,
      .maximum = 32768 },
    { .name = "count",
      .kind = LOM_OPTION_INTEGER,
      .letter = 'n',
      .field = offsetof(struct values, count),
      .value = "N" },
    { .name = "share",
      .kind = LOM_OPTION_NUMBER,
      .letter = 's',
      .field = offsetof(struct values, share),
      .value = "F",
      .maximum = 1 },
    { .name = "any", .kind = LOM_OPTION_NUMBER, .field = offsetof(struct values, any), .value = "F" },
    { .name = "list", .kind = LOM_OPTION_LIST, .letter = 'l', .field = offsetof(struct values, list), .value = "WORD" },
    { .name = "text", .kind = LOM_OPTION_TEXT, .letter = 'o', .field = offsetof(struct values, text), .value = "WORD" },
    { .name = "choice", .kind = LOM_OPTION_CHOICE, .field = offsetof(struct values, choice), .value = "a|bc|def" },
    { .name = "flag", .kind = LOM_OPTION_FLAG, .letter = 'q', .field = offsetof(struct values, flag) },
};
enum { OPTIONS = sizeof options / sizeof *options, MOST_WORDS = 64 };

static const lom_command_line line = { .name = "fuzz",
                                       .arguments = "FILE...",
                                       .summary = "Reads anything",
                                       .options = options,
                                       .option_count = OPTIONS,
                                       .maximum_arguments = 8 };

static void require(bool condition)
{
    if (!condition)
        abort();
}

/* What --name WORD gave, read again by the C library: the pattern's letters as %lld, everything else as itself. */
static void check_integers(const char *pattern, const char *word, const lom_option_integers *got, double minimum,
                           double maximum)
{
    int count = 0;
    for (; *pattern != 0; pattern++) {
        if (*pattern < 'A' || *pattern > 'Z') {
            require(*word++ == *pattern);
            continue;
        }
        char *end;
        require(*word == '-' || (*word >= '0' && *word <= '9'));
        int64_t value = strtoll(word, &end, 10);
        require(end != word && value == got->value[count++]);
        require(minimum == maximum || ((double)value >= minimum && (double)value <= maximum));
        word = end;
    }
    require(*word == 0);
}

static void check_values(const struct values *values, const char *word)
{
    const struct {
        const lom_option_integers *got;
        int option;
    } integers[] = { { &values->size, 0 }, { &values->range, 1 }, { &values->crop, 2 }, { &values->count, 3 } };
    for (int i = 0; i < 4; i++)
        if (integers[i].got->given)
            check_integers(options[i].value, word, integers[i].got, options[i].minimum, options[i].maximum);
    if (values->share.given)
        require(values->share.value == strtod(word, NULL) && values->share.value >= 0 && values->share.value <= 1);
    if (values->any.given)
        require(values->any.value == strtod(word, NULL));
}

/* Each option with each word alone, then all words as one line. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *text = malloc(size + 1), *words[MOST_WORDS + 2];
    if (size != 0)
        memcpy(text, data, size);
    text[size] = 0;
    char program[] = "fuzz";
    int count = 0, status;
    lom_arguments arguments;
    words[count++] = program;
    for (size_t at = 0; at < size && count <= MOST_WORDS; at += strlen(text + at) + 1)
        words[count++] = text + at;
    words[count] = NULL;
    for (int o = 0; o < OPTIONS && count > 1; o++) {
        if (options[o].kind == LOM_OPTION_FLAG) /* takes no word: the next one would be an option of its own */
            continue;
        char name[32] = "--", *pair[] = { program, name, words[1], NULL };
        strcat(name, options[o].name);
        struct values values = { .flag = false };
        if (strncmp(words[1], "--", 2) != 0 && lom_parse_options(&line, 3, pair, &values, &arguments, &status))
            check_values(&values, words[1]);
    }
    struct values values = { .flag = false };
    bool parsed = lom_parse_options(&line, count, words, &values, &arguments, &status);
    require(parsed == (status == LOM_EXIT_DONE) || !parsed);
    require(!parsed || (arguments.count >= 0 && arguments.count <= 8));
    free(text);
    return 0;
}
