/* Decimal text to the nearest binary float. In: characters; out: how many were used, and the value rounded once, half
 * to even, from the exact decimal. Only integers are computed with, so the rounding mode and the locale cannot matter.
 *
 * W. D. Clinger: How to read floating point numbers accurately (PLDI 1990) shows that exact integers are needed in
 * general. Halfway points between doubles have at most 768 significant digits, so digits beyond MAX_DIGITS matter only
 * by whether one of them is not 0: such a tail is replaced by a single 1. */
#include <lom/base.h>

#include "big.h"

#include <string.h>

enum { MAX_DIGITS = 800 };

/* value = 0.d1 d2 d3 ... * 10^point, without leading and trailing zeros */
typedef struct decimal {
    bool negative;
    int count;
    int64_t point;
    uint8_t digit[MAX_DIGITS + 1];
} decimal;

/* A binary format: precision with the hidden bit, the weight of the least denormal bit, the field of the exponent. */
typedef struct binary {
    int precision, least_exponent, exponent_field;
    int64_t largest_point, smallest_point; /* at a larger point every value is infinite, at a smaller one zero */
} binary;

static const binary binary64 = { 53, -1074, 0x7ff, 309, -323 };
static const binary binary32 = { 24, -149, 0xff, 39, -45 };

/* ---- text to digits ---- */

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

typedef struct digit_scan {
    decimal *number;
    size_t pending_zeros; /* zeros after the last digit that is not 0: dropped unless another follows */
    bool any, tail;
} digit_scan;

static void take_digit(digit_scan *scan, char c, bool after_point)
{
    decimal *number = scan->number;
    bool leading = number->count == 0;
    scan->any = true;
    if (c == '0' && leading) {
        number->point -= after_point;
        return;
    }
    number->point += !after_point;
    if (c == '0') {
        scan->pending_zeros++;
        return;
    }
    if ((size_t)number->count + scan->pending_zeros >= MAX_DIGITS) {
        scan->tail = true;
        return;
    }
    for (; scan->pending_zeros > 0; scan->pending_zeros--)
        number->digit[number->count++] = 0;
    number->digit[number->count++] = (uint8_t)(c - '0');
}

/* Exponents saturate far outside of what any length of digits could bring back. */
static size_t scan_exponent(const char *text, size_t length, size_t at, int64_t *exponent)
{
    static const int64_t saturated = INT64_C(1) << 62;
    size_t i = at + 1;
    bool negative = i < length && text[i] == '-';
    if (i < length && (text[i] == '-' || text[i] == '+'))
        i++;
    if (i >= length || !is_digit(text[i]))
        return at;
    int64_t value = 0;
    for (; i < length && is_digit(text[i]); i++)
        value = value < saturated / 16 ? value * 10 + (text[i] - '0') : saturated;
    *exponent = negative ? -value : value;
    return i;
}

static size_t scan_decimal(const char *text, size_t length, decimal *number)
{
    digit_scan scan = { .number = number };
    number->count = 0;
    number->point = 0;
    number->negative = length > 0 && text[0] == '-';
    size_t i = length > 0 && (text[0] == '-' || text[0] == '+');
    for (; i < length && is_digit(text[i]); i++)
        take_digit(&scan, text[i], false);
    if (i < length && text[i] == '.') {
        i++;
        for (; i < length && is_digit(text[i]); i++)
            take_digit(&scan, text[i], true);
    }
    if (!scan.any)
        return 0;
    if (scan.tail) { /* a 1 directly after the digits kept: its exact place does not matter */
        for (; scan.pending_zeros > 0 && number->count < MAX_DIGITS; scan.pending_zeros--)
            number->digit[number->count++] = 0;
        number->digit[number->count++] = 1;
    }
    int64_t exponent = 0;
    if (i < length && (text[i] == 'e' || text[i] == 'E'))
        i = scan_exponent(text, length, i, &exponent);
    number->point += exponent;
    return i;
}

/* ---- digits to bits ---- */

/* The bits of mantissa * 2^exponent, plus something in (0, 2^exponent) when sticky is set, rounded to the format.
 * mantissa has its top bit set. */
static uint64_t round_to(const binary *format, uint64_t mantissa, int exponent, bool sticky)
{
    int drop = 64 - format->precision;
    if (exponent + drop < format->least_exponent)
        drop = format->least_exponent - exponent; /* denormal: fewer bits are kept */
    if (drop > 64)
        return 0; /* below half of the least denormal */
    uint64_t kept = drop < 64 ? mantissa >> drop : 0;
    uint64_t half = UINT64_C(1) << (drop - 1);
    bool above = (mantissa & (half - 1)) != 0 || sticky;
    if ((mantissa & half) != 0 && (above || (kept & 1) != 0))
        kept++;
    /* With the hidden bit counted in, a carry moves into the exponent by itself; a denormal has field 0. */
    int field = exponent + drop - format->least_exponent;
    uint64_t bits = kept + ((uint64_t)field << (format->precision - 1));
    uint64_t infinity = (uint64_t)format->exponent_field << (format->precision - 1);
    return bits < infinity ? bits : infinity;
}

#ifdef __SIZEOF_INT128__
/* What people write: at most 19 digits and a power of ten that fits 64 bits. One exact product or one division with its
 * remainder; the same bits as the general way below. */
static bool convert_short(const decimal *number, const binary *format, uint64_t *bits)
{
    int64_t power = number->point - number->count;
    if (number->count > 19 || power < -19 || power > 19)
        return false;
    uint64_t digits = 0, scale = 1;
    for (int i = 0; i < number->count; i++)
        digits = digits * 10 + number->digit[i];
    for (int64_t i = power < 0 ? -power : power; i > 0; i--)
        scale *= 10;
    int up = __builtin_clzll(digits);
    unsigned __int128 wide = power >= 0 ? (unsigned __int128)digits * scale : (unsigned __int128)(digits << up) << 64;
    bool sticky = false;
    int exponent = 0;
    if (power < 0) { /* 2^127 <= wide and scale < 2^64: the quotient has 64 bits or more */
        sticky = wide % scale != 0;
        wide /= scale;
        exponent = -up - 64;
    }
    uint64_t high = (uint64_t)(wide >> 64);
    if (high == 0) {
        int shift = __builtin_clzll((uint64_t)wide);
        *bits = round_to(format, (uint64_t)wide << shift, exponent - shift, sticky);
        return true;
    }
    int shift = 64 - __builtin_clzll(high);
    sticky |= (wide & (((unsigned __int128)1 << shift) - 1)) != 0;
    *bits = round_to(format, (uint64_t)(wide >> shift), exponent + shift, sticky);
    return true;
}
#else
static bool convert_short(const decimal *number, const binary *format, uint64_t *bits)
{
    (void)number, (void)format, (void)bits;
    return false;
}
#endif

/* Any number: the quotient of two exact integers, bit after bit until 64 are known; what remains only makes it sticky.
 */
static uint64_t convert_long(const decimal *number, const binary *format)
{
    big above, below;
    big_set(&above, 0);
    for (int i = 0; i < number->count; i++)
        big_multiply_add(&above, 10, number->digit[i]);
    big_set(&below, 1);
    int power = (int)(number->point - number->count);
    big_multiply_power_of_ten(power >= 0 ? &above : &below, power >= 0 ? power : -power);
    int exponent = big_bits(&above) - big_bits(&below);
    big_shift_left(exponent >= 0 ? &below : &above, exponent >= 0 ? exponent : -exponent);
    if (big_compare(&above, &below) < 0) {
        big_shift_left(&above, 1);
        exponent--;
    }
    /* now 1 <= above / below < 2, and the value is that times 2^exponent */
    uint64_t mantissa = 0;
    for (int i = 0; i < 64; i++) {
        mantissa <<= 1;
        if (big_compare(&above, &below) >= 0) {
            big_subtract(&above, &below);
            mantissa |= 1;
        }
        big_shift_left(&above, 1);
    }
    return round_to(format, mantissa, exponent - 63, above.count != 0);
}

static size_t parse(const char *text, size_t length, const binary *format, bool *negative, uint64_t *bits)
{
    decimal number;
    size_t used = scan_decimal(text, length, &number);
    *negative = number.negative;
    *bits = 0;
    if (used == 0 || number.count == 0 || number.point < format->smallest_point)
        return used;
    if (number.point > format->largest_point)
        *bits = (uint64_t)format->exponent_field << (format->precision - 1);
    else if (!convert_short(&number, format, bits))
        *bits = convert_long(&number, format);
    return used;
}

size_t lom_parse_double(const char *text, size_t length, double *value)
{
    bool negative;
    uint64_t bits;
    size_t used = parse(text, length, &binary64, &negative, &bits);
    bits |= (uint64_t)negative << 63;
    if (used != 0)
        memcpy(value, &bits, sizeof *value);
    return used;
}

size_t lom_parse_float(const char *text, size_t length, float *value)
{
    bool negative;
    uint64_t bits;
    size_t used = parse(text, length, &binary32, &negative, &bits);
    uint32_t word = (uint32_t)bits | (uint32_t)negative << 31;
    if (used != 0)
        memcpy(value, &word, sizeof *value);
    return used;
}
