/* Any bytes as a number: the characters used and the value are those of strtod and strtof (but for what is no number
 * here: white space, nan, inf, hexadecimal), and printing the value reads back. */
#include <lom/base.h>

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* The part of the text that strtod reads in the same way: from the start, without white space and letters but e. */
static size_t plain_length(const char *text, size_t size)
{
    return size == 0 || text[0] == 0 ? 0 : strspn(text, "+-.0123456789eE");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *text = calloc(size + 1, 1), *end, printed[32];
    if (size != 0)
        memcpy(text, data, size);
    double value = 0;
    float single = 0;
    lom_parse_double((const char *)data, size, &value); /* without a zero behind */
    text[plain_length(text, size)] = 0;
    size = strlen(text);
    value = 0;
    size_t used = lom_parse_double(text, size, &value);
    double expected = strtod(text, &end);
    if (used != (size_t)(end - text) || memcmp(&value, &expected, sizeof value) != 0)
        abort();
    float expected_single = strtof(text, NULL);
    if (lom_parse_float(text, size, &single) != used || memcmp(&single, &expected_single, sizeof single) != 0)
        abort();
    double back = value;
    size_t length = lom_print_double(printed, value);
    if (value - value == 0 && (lom_parse_double(printed, length, &back) != length || back != value))
        abort();
    free(text);
    return 0;
}
