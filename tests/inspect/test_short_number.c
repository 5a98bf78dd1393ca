/* Proves that the numbers of a legend are what they are of: three digits, within half of the last; read back they are near,
 * and those that have no more digits are exact. */
#include "check.h"

#include "inspect/short_number.h"

#include <lom/lom.h>

static void some_are_known(void)
{
    static const struct {
        double value;
        const char *text;
    } known[] = {
        { 0, "0" },          { 1, "1" },           { -1, "-1" },       { 0.1, "0.1" },         { 12.5, "12.5" },
        { 999, "999" },      { 999.4, "999" },     { 999.6, "1000" },  { 1230, "1230" },       { 9996, "10k" },
        { 10000, "10k" },    { 45600, "45.6k" },   { 123456, "123k" }, { 999600, "1M" },       { 7.89e6, "7.89M" },
        { 1.5e8, "150M" },   { 1.5e9, "1.5e9" },   { 1e12, "1e12" },   { 0.00123, "0.00123" }, { 0.0001, "0.0001" },
        { 0.00001, "1e-5" }, { 1.2e-7, "1.2e-7" }, { -0.25, "-0.25" }, { 1e-31, "0" },         { 1e31, "far" },
        { 0.125, "0.125" },  { 2.345, "2.35" },    { 100.4, "100" },   { 0.9996, "1" },        { -45600, "-45.6k" },
    };
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        char text[LOM_SHORT_NUMBER];
        lom_print_short(text, known[i].value);
        CHECK(strcmp(text, known[i].text) == 0, "%g: \"%s\", not \"%s\"", known[i].value, text, known[i].text);
    }
    char text[LOM_SHORT_NUMBER];
    lom_print_short(text, (double)__builtin_nanf(""));
    CHECK(strcmp(text, "far") == 0, "%s", text);
}

static double read_back(const char *text)
{
    char *rest;
    double value = strtod(text, &rest);
    return *rest == 'k' ? value * 1e3 : *rest == 'M' ? value * 1e6 : value;
}

static void all_are_near(void)
{
    for (uint64_t i = 0; i < 20000; i++) {
        double value = lom_double_exp2(lom_random_uniform(5, i) * 120 - 60) * (i % 2 == 0 ? 1 : -1);
        char text[LOM_SHORT_NUMBER];
        lom_print_short(text, value);
        double ratio = read_back(text) / value;
        CHECK(ratio > 0.9949 && ratio < 1.0051 && strlen(text) <= 10, "%g: \"%s\"", value, text);
    }
}

int main(int argc, char **argv)
{
    RUN(some_are_known);
    RUN(all_are_near);
    return check_result();
}
