/* A binary float to the shortest decimal text that reads back as the same value. In: a float or double; out: its text,
 * independent of locale and rounding mode because only integers are computed with.
 *
 * G. L. Steele, J. L. White: How to print floating-point numbers accurately (PLDI 1990), algorithm FPP with the fixed
 * scaling of Dragon4: the value is r/s, and every decimal strictly between (r - low)/s and (r + high)/s reads back as
 * the value; the bounds themselves do when the mantissa is even (ties round to even). Digits are produced until the
 * rest is inside that interval, so no shorter text is. */
#include <lom/base.h>

#include "big.h"

#include <string.h>

enum { MOST_DIGITS = 17 };

typedef struct digits {
    int count;
    int point; /* value = 0.d1 d2 d3 ... * 10^point */
    char digit[MOST_DIGITS + 1];
} digits;

typedef struct interval {
    big r, s, low, high;
    bool even;
} interval;

/* Whether value + high reaches the next power of ten, that is (r + high) / s >= 1, or > 1 with exclusive bounds. */
static bool reaches_one(const interval *v)
{
    big sum = v->r;
    big_add(&sum, &v->high);
    int order = big_compare(&sum, &v->s);
    return order > 0 || (order == 0 && v->even);
}

static void multiply_by_ten(interval *v)
{
    big_multiply_add(&v->r, 10, 0);
    big_multiply_add(&v->low, 10, 0);
    big_multiply_add(&v->high, 10, 0);
}

/* mantissa * 2^exponent with the distance to the halfway points on both sides; everything is doubled (once more at a
 * power of two, where the gap below is half of the gap above) so that these are integers. */
static void set_interval(interval *v, uint64_t mantissa, int exponent, bool closer_below)
{
    int doubling = closer_below ? 2 : 1;
    v->even = mantissa % 2 == 0;
    big_set(&v->r, mantissa);
    big_set(&v->s, 1);
    big_set(&v->low, 1);
    big_set(&v->high, 1);
    big_shift_left(&v->r, doubling);
    big_shift_left(&v->s, doubling);
    big_shift_left(&v->high, doubling - 1);
    if (exponent >= 0) {
        big_shift_left(&v->r, exponent);
        big_shift_left(&v->low, exponent);
        big_shift_left(&v->high, exponent);
    } else {
        big_shift_left(&v->s, -exponent);
    }
}

/* Scales so that the value lies in [0.1, 1), and returns the power of ten taken out. floor(leading_bit * log10(2)) with
 * log10(2) * 2^20 = 315652.8 rounded down is at most one too small for the exponents of a double; for negative ones the
 * rounding goes the other way, hence one less. The loop makes up for it. */
static int scale(interval *v, int leading_bit)
{
    int point = (leading_bit * 315652 >> 20) - (leading_bit < 0); /* >> of a negative rounds down in gcc and clang */
    if (point >= 0) {
        big_multiply_power_of_ten(&v->s, point);
    } else {
        big_multiply_power_of_ten(&v->r, -point);
        big_multiply_power_of_ten(&v->low, -point);
        big_multiply_power_of_ten(&v->high, -point);
    }
    while (reaches_one(v)) {
        big_multiply_add(&v->s, 10, 0);
        point++;
    }
    return point;
}

static void generate(interval *v, digits *out)
{
    out->count = 0;
    for (;;) {
        multiply_by_ten(v);
        int digit = 0;
        while (big_compare(&v->r, &v->s) >= 0) {
            big_subtract(&v->r, &v->s);
            digit++;
        }
        int order = big_compare(&v->r, &v->low);
        bool down = order < 0 || (order == 0 && v->even);
        bool up = reaches_one(v);
        if (down && up) { /* both neighbours read back: take the nearer one, the even one of a tie */
            big_shift_left(&v->r, 1);
            int half = big_compare(&v->r, &v->s);
            up = half > 0 || (half == 0 && digit % 2 != 0);
        }
        out->digit[out->count++] = (char)('0' + digit + up);
        if (down || up)
            return;
    }
}

/* ---- digits to text ---- */

static size_t put_exponent(char *text, int exponent)
{
    size_t n = 0;
    int size = exponent < 0 ? -exponent : exponent;
    text[n++] = 'e';
    text[n++] = exponent < 0 ? '-' : '+';
    if (size >= 100)
        text[n++] = (char)('0' + size / 100);
    text[n++] = (char)('0' + size / 10 % 10);
    text[n++] = (char)('0' + size % 10);
    return n;
}

/* Plain for 0.0001 <= |value| < 1e16, else d.ddde+dd with at least two digits of exponent, as printf writes it. */
static size_t put_digits(char *text, const digits *d)
{
    size_t n = 0;
    if (d->point <= -4 || d->point > 16) {
        text[n++] = d->digit[0];
        if (d->count > 1)
            text[n++] = '.';
        for (int i = 1; i < d->count; i++)
            text[n++] = d->digit[i];
        return n + put_exponent(text + n, d->point - 1);
    }
    if (d->point <= 0)
        text[n++] = '0';
    for (int i = 0; i < d->point; i++)
        text[n++] = i < d->count ? d->digit[i] : '0';
    if (d->count > d->point)
        text[n++] = '.';
    for (int i = d->point; i < 0; i++)
        text[n++] = '0';
    for (int i = d->point > 0 ? d->point : 0; i < d->count; i++)
        text[n++] = d->digit[i];
    return n;
}

/* field: the biased exponent; precision counts the hidden bit; least: the weight of the lowest denormal bit. */
static size_t print(char text[32], bool negative, int field, uint64_t fraction, int precision, int least)
{
    int largest_field = precision == 53 ? 0x7ff : 0xff;
    size_t n = 0;
    if (negative && !(field == largest_field && fraction != 0))
        text[n++] = '-';
    if (field == largest_field) {
        memcpy(text + n, fraction != 0 ? "nan" : "inf", 3);
        n += 3;
    } else if (field == 0 && fraction == 0) {
        text[n++] = '0';
    } else {
        uint64_t hidden = field != 0 ? UINT64_C(1) << (precision - 1) : 0;
        int exponent = least + (field != 0 ? field - 1 : 0);
        interval v;
        digits d;
        set_interval(&v, fraction | hidden, exponent, fraction == 0 && field > 1);
        d.point = scale(&v, exponent + 63 - __builtin_clzll(fraction | hidden));
        generate(&v, &d);
        n += put_digits(text + n, &d);
    }
    text[n] = 0;
    return n;
}

size_t lom_print_double(char text[32], double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return print(text, bits >> 63 != 0, (int)(bits >> 52 & 0x7ff), bits & ((UINT64_C(1) << 52) - 1), 53, -1074);
}

size_t lom_print_float(char text[32], float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return print(text, bits >> 31 != 0, (int)(bits >> 23 & 0xff), bits & 0x7fffff, 24, -149);
}
