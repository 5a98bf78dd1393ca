/* Numbers as text. Oracles: glibc's strtod, strtof and printf (written independently, correctly rounded), and values
 * whose bits are known. Proves: parsing is correctly rounded, also at halfway points, for denormals, for thousands of
 * digits; printing is the shortest text that reads back; neither minds the rounding mode. */
#include "check.h"

#include <lom/base.h>

#include <fenv.h>
#include <locale.h>
#include <math.h>

static uint64_t double_bits(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static uint32_t float_bits(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static double double_of(uint64_t bits)
{
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static float float_of(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static void against_libc(const char *text)
{
    double value = 7;
    float single = 7;
    size_t used = lom_parse_double(text, strlen(text), &value);
    size_t used_single = lom_parse_float(text, strlen(text), &single);
    CHECK(used == strlen(text) && used_single == used, "%.60s: %zu and %zu used", text, used, used_single);
    CHECK(double_bits(value) == double_bits(strtod(text, NULL)), "%.60s: %a, not %a", text, value, strtod(text, NULL));
    CHECK(float_bits(single) == float_bits(strtof(text, NULL)), "%.60s: %a, not %a", text, single, strtof(text, NULL));
}

static void edges(void)
{
    static const char *const texts[] = {
        "0",
        "-0",
        "0.0",
        "00000",
        "0e999999999999999999999",
        "0.0e-99999",
        "1",
        "-1",
        "+1",
        "1.",
        ".5",
        "-.5",
        "1e0",
        "1E5",
        "1e+5",
        "1e-5",
        "1e999",
        "-1e999",
        "1e-999",
        "1e99999999999999999999999",
        "1e-99999999999999999999999",
        "1e308",
        "1e309",
        "1.7976931348623157e308",
        "1.7976931348623158e308",
        "1.7976931348623159e308",
        "1.797693134862315807e308",
        "1.797693134862315708145274237317043567980e308",
        "1.79769313486231580793728971405303415079e308",
        "4.9406564584124654e-324",
        "2.4703282292062327e-324",
        "2.4703282292062328e-324",
        "2.5e-324",
        "5e-324",
        "7.4e-324",
        "2.2250738585072014e-308",
        "2.2250738585072011e-308",
        "2.2250738585072012e-308",
        "2.225073858507201e-308",
        "9007199254740992",
        "9007199254740993",
        "9007199254740994",
        "9007199254740995",
        "9007199254740993.0000000000001",
        "9007199254740992.9999999999999",
        "16777216",
        "16777217",
        "16777218",
        "16777219",
        "16777217.00000000000001",
        "3.4028234663852886e38",
        "3.4028235677973366e38",
        "3.4028235677973367e38",
        "3.4028235677973365e38",
        "3.5e38",
        "1.401298464324817e-45",
        "7.006492321624085e-46",
        "7.006492321624086e-46",
        "7.1e-46",
        "1e-45",
        "9.9e-46",
        "1.1754943508222875e-38",
        "1.1754942e-38",
        "0.1",
        "0.2",
        "0.3",
        "123456789012345678901234567890",
        "1e22",
        "1e23",
        "8.5e22",
        "6.0221412999999987e23",
        "5e-20",
        "1e-19",
        "1e19",
        "1e20",
        "18446744073709551615",
        "18446744073709551616",
        "9999999999999999999",
        "0.9999999999999999999",
        "1.00000005960464477539",
        "1.000000059604644775390625",
        "1.0000000596046447753906250000000000000000000000000001",
        "1.00000017881393432617187499",
        "0.000001",
        "1e-7",
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        against_libc(texts[i]);
}

static void prefixes(void)
{
    static const struct {
        const char *text;
        size_t used;
        double value;
    } cases[] = {
        { "", 0, 7 },
        { "-", 0, 7 },
        { "+", 0, 7 },
        { ".", 0, 7 },
        { "e5", 0, 7 },
        { "-.", 0, 7 },
        { ".e5", 0, 7 },
        { "nan", 0, 7 },
        { "inf", 0, 7 },
        { "-inf", 0, 7 },
        { " 1", 0, 7 },
        { "x", 0, 7 },
        { "--1", 0, 7 },
        { "1e", 1, 1 },
        { "1e+", 1, 1 },
        { "1e-x", 1, 1 },
        { "1,5", 1, 1 },
        { "0x10", 1, 0 },
        { "1.5.5", 3, 1.5 },
        { "1.e2x", 4, 100 },
        { "12 34", 2, 12 },
        { "1_000", 1, 1 },
        { "-3.25e1e1", 7, -32.5 },
        { "+5", 2, 5 },
        { "1.\xb2", 2, 1 },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double value = 7;
        size_t used = lom_parse_double(cases[i].text, strlen(cases[i].text), &value);
        CHECK(used == cases[i].used && value == cases[i].value, "%s: %zu used, value %g", cases[i].text, used, value);
    }
    char text[] = "123456"; /* the length counts, not the zero byte */
    double value = 0;
    CHECK(lom_parse_double(text, 3, &value) == 3 && value == 123, "value %g", value);
}

/* Exact halfway points between neighbours, and the same with a last digit far behind. */
static void halfway(void)
{
    char text[2600];
    for (uint64_t i = 0; i < 2000; i++) {
        uint64_t bits = lom_random_bits(1, i) & ~(UINT64_C(1) << 63);
        if (i % 4 == 0)
            bits &= (UINT64_C(1) << 52) - 1; /* denormals */
        double low = double_of(bits), high = double_of(bits + 1);
        if (!isfinite(high))
            continue;
        /* long double holds the sum of two neighbouring doubles exactly on x86-64; elsewhere the check still compares
         * the same text with libc */
        snprintf(text, sizeof text, "%.1100Le", ((long double)low + high) / 2);
        against_libc(text);
        char *e = strchr(text, 'e');
        e[-1] = '1';
        against_libc(text);
    }
    for (uint64_t i = 0; i < 20000; i++) {
        uint32_t bits = (uint32_t)lom_random_bits(2, i) & 0x7fffffff;
        float low = float_of(bits), high = float_of(bits + 1);
        if (!isfinite(high))
            continue;
        snprintf(text, sizeof text, "%.200e", ((double)low + high) / 2);
        against_libc(text);
        char *e = strchr(text, 'e');
        e[-1] = '1';
        against_libc(text);
    }
}

static void many_digits(void)
{
    enum { LENGTH = 20000 };
    static char text[LENGTH + 64];
    for (uint64_t i = 0; i < 100; i++) {
        size_t length = 700 + lom_random_bits(3, i) % (LENGTH - 700);
        for (size_t j = 0; j < length; j++)
            text[j] = (char)('0' + lom_random_bits(i + 10, j) % 10);
        text[lom_random_bits(4, i) % length] = '.';
        snprintf(text + length, 32, "e%d", (int)(lom_random_bits(5, i) % 21000) - 20500);
        against_libc(text);
    }
    memset(text, '0', LENGTH); /* 0.000...1 and 1000...0 with exponents that bring them back */
    text[1] = '.';
    memcpy(text + LENGTH - 1, "1e19998", 8);
    against_libc(text);
    memset(text, '0', LENGTH);
    text[0] = '1';
    memcpy(text + LENGTH, "e-20000", 8);
    against_libc(text);
    /* 2^53 + 1 and a 1 after 10^4 zeros: above halfway, by the last digit only */
    memset(text, '0', LENGTH);
    memcpy(text, "9007199254740993.", 17);
    text[LENGTH - 1] = '1';
    text[LENGTH] = 0;
    against_libc(text);
    text[LENGTH - 1] = '0';
    against_libc(text);
}

/* The shortest text by trial: fewest digits for which printf's rounding reads back. */
static int least_digits_double(double value)
{
    char text[64];
    for (int digits = 1; digits < 17; digits++) {
        snprintf(text, sizeof text, "%.*e", digits - 1, value);
        if (strtod(text, NULL) == value)
            return digits;
    }
    return 17;
}

static int least_digits_float(float value)
{
    char text[64];
    for (int digits = 1; digits < 9; digits++) {
        snprintf(text, sizeof text, "%.*e", digits - 1, value);
        if (strtof(text, NULL) == value)
            return digits;
    }
    return 9;
}

static int count_digits(const char *text)
{
    int digits = 0, zeros = 0;
    for (; *text != 0 && *text != 'e'; text++) {
        if (*text < '0' || *text > '9' || (*text == '0' && digits == 0))
            continue;
        digits += *text == '0' ? 0 : 1 + zeros;
        zeros = *text == '0' ? zeros + 1 : 0;
    }
    return digits;
}

static void print_double_round_trip(double value)
{
    char text[32];
    size_t length = lom_print_double(text, value);
    double back = 0;
    CHECK(length == strlen(text) && length < 32, "%s", text);
    CHECK(double_bits(strtod(text, NULL)) == double_bits(value), "%s is not %a for strtod", text, value);
    CHECK(lom_parse_double(text, length, &back) == length && double_bits(back) == double_bits(value), "%s is not %a",
          text, value);
    CHECK(count_digits(text) <= least_digits_double(value), "%s has %d digits, %d are enough", text, count_digits(text),
          least_digits_double(value));
}

static void print_float_round_trip(float value)
{
    char text[32];
    size_t length = lom_print_float(text, value);
    float back = 0;
    CHECK(length == strlen(text) && length < 32, "%s", text);
    CHECK(float_bits(strtof(text, NULL)) == float_bits(value), "%s is not %a for strtof", text, value);
    CHECK(lom_parse_float(text, length, &back) == length && float_bits(back) == float_bits(value), "%s is not %a", text,
          value);
    CHECK(count_digits(text) <= least_digits_float(value), "%s has %d digits, %d are enough", text, count_digits(text),
          least_digits_float(value));
}

static void random_doubles(void)
{
    for (uint64_t i = 0; i < 60000; i++) {
        double value = double_of(lom_random_bits(6, i));
        if (isfinite(value))
            print_double_round_trip(value);
        print_double_round_trip((double)(int64_t)(lom_random_bits(7, i) >> (i % 64)));
        print_double_round_trip(lom_random_uniform(8, i));
    }
    for (int exponent = -1074; exponent < 1024; exponent++) { /* where the gap below is half of the gap above */
        print_double_round_trip(ldexp(1, exponent));
        print_double_round_trip(nextafter(ldexp(1, exponent), 0) != 0 ? nextafter(ldexp(1, exponent), 0) : 1);
        print_double_round_trip(nextafter(ldexp(1, exponent), 1e308));
    }
}

static void random_floats(void)
{
    for (uint64_t i = 0; i < 100000; i++) {
        float value = float_of((uint32_t)lom_random_bits(9, i));
        if (isfinite(value))
            print_float_round_trip(value);
    }
    for (int exponent = -149; exponent < 128; exponent++)
        print_float_round_trip(ldexpf(1, exponent));
}

static void random_texts(void)
{
    char text[64];
    for (uint64_t i = 0; i < 100000; i++) {
        uint64_t bits = lom_random_bits(11, i);
        snprintf(text, sizeof text, "%s%llu.%06llue%d", bits & 1 ? "-" : "",
                 (unsigned long long)(bits >> (bits >> 1 & 63)), (unsigned long long)(bits >> 8 & 0xffff),
                 (int)(bits >> 32 & 127) - 64);
        against_libc(text);
        snprintf(text, sizeof text, "%.17g", double_of(bits));
        if (isfinite(double_of(bits)))
            against_libc(text);
    }
}

static void forms(void)
{
    static const struct {
        double value;
        const char *text;
    } cases[] = {
        { 0.0, "0" },
        { -0.0, "-0" },
        { 0.1, "0.1" },
        { -3, "-3" },
        { 1e30, "1e+30" },
        { 1e16, "1e+16" },
        { 1e15, "1000000000000000" },
        { 1234.5, "1234.5" },
        { 0.0001, "0.0001" },
        { 0.00001, "1e-05" },
        { 1e100, "1e+100" },
        { 5e-324, "5e-324" },
        { 1.7976931348623157e308, "1.7976931348623157e+308" },
        { 1e23, "1e+23" },
        { 9007199254740993.0, "9007199254740992" },
        { 0.3, "0.3" },
        { 100, "100" },
        { 2.5e-7, "2.5e-07" },
        { HUGE_VAL, "inf" },
        { -HUGE_VAL, "-inf" },
        { NAN, "nan" },
        { -NAN, "nan" },
        { 123456789, "123456789" },
    };
    char text[32];
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        lom_print_double(text, cases[i].value);
        CHECK(strcmp(text, cases[i].text) == 0, "%s, not %s", text, cases[i].text);
    }
    lom_print_float(text, 0.1f);
    CHECK(strcmp(text, "0.1") == 0, "%s", text);
    lom_print_float(text, 16777216);
    CHECK(strcmp(text, "16777216") == 0, "%s", text);
    lom_print_float(text, HUGE_VALF);
    CHECK(strcmp(text, "inf") == 0, "%s", text);
}

static void any_rounding_mode(void)
{
    static const int modes[] = { FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO };
    static const char *const texts[] = {
        "0.1", "1e23", "123456789.123456789", "1e-310", "0.30000000000000004", "1e40"
    };
    for (int m = 0; m < 3; m++) {
        for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
            double value = 0, expected = strtod(texts[i], NULL);
            float single = 0, expected_single = strtof(texts[i], NULL);
            char text[32], expected_text[32];
            lom_print_double(expected_text, expected);
            fesetround(modes[m]);
            lom_parse_double(texts[i], strlen(texts[i]), &value);
            lom_parse_float(texts[i], strlen(texts[i]), &single);
            lom_print_double(text, expected);
            fesetround(FE_TONEAREST);
            CHECK(value == expected && single == expected_single && strcmp(text, expected_text) == 0, "%s", texts[i]);
        }
    }
}

/* Locales whose decimal sign is a comma, where there are any. */
static void any_locale(void)
{
    static const char *const locales[] = { "de_DE.UTF-8", "de_DE", "fr_FR.UTF-8", "tr_TR.UTF-8", "ar_EG.UTF-8" };
    for (size_t i = 0; i < sizeof locales / sizeof *locales; i++) {
        if (setlocale(LC_ALL, locales[i]) == NULL)
            continue;
        double value = 0;
        char text[32];
        CHECK(lom_parse_double("1.5e1", 5, &value) == 5 && value == 15, "%s: %g", locales[i], value);
        CHECK(lom_parse_double("1,5", 3, &value) == 1 && value == 1, "%s: %g", locales[i], value);
        lom_print_double(text, 0.25);
        CHECK(strcmp(text, "0.25") == 0, "%s: %s", locales[i], text);
    }
    setlocale(LC_ALL, "C");
}

int main(int argc, char **argv)
{
    RUN(edges);
    RUN(prefixes);
    RUN(halfway);
    RUN(many_digits);
    RUN(random_doubles);
    RUN(random_floats);
    RUN(random_texts);
    RUN(forms);
    RUN(any_rounding_mode);
    RUN(any_locale);
    return check_result();
}
