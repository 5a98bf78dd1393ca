/* Double-double arithmetic for src/base/double_*.c: a pair stands for the unevaluated sum hi + lo, |lo| <= ulp(hi)/2.
 * In: finite doubles whose products neither overflow nor underflow; out: pairs with a relative error near 2^-104.
 * Invariant: only + - * / and integer operations on the bits, round to nearest even, so every machine agrees.
 * Sources: Dekker, "A floating-point technique for extending the available precision" (1971), for the product by
 * splitting; Knuth, TAOCP 2, 4.2.2, theorem B, for the sum; Joldes, Muller, Popescu, "Tight and rigorous error bounds
 * for basic building blocks of double-word arithmetic" (2017), for the rest. */
#ifndef LOM_BASE_DOUBLE_PARTS_H
#define LOM_BASE_DOUBLE_PARTS_H

#include <lom/base.h>

#include <string.h>

typedef struct lom_pair {
    double hi, lo;
} lom_pair;

#define DOUBLE_INFINITY __builtin_inf()

static inline uint64_t double_bits(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static inline double bits_double(uint64_t bits)
{
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* Every NaN result is this one, so that its bits do not differ by machine. They are hidden from the compiler, which may
 * otherwise take one NaN for another: clang 19 makes the square root alone of x >= 0 ? root of x : NaN. */
static inline double double_nan(void)
{
    uint64_t bits = UINT64_C(0x7ff8000000000000);
    __asm__("" : "+r"(bits));
    return bits_double(bits);
}

static inline bool is_negative(double x)
{
    return double_bits(x) >> 63 != 0;
}

static inline double magnitude(double x)
{
    return bits_double(double_bits(x) & (UINT64_MAX >> 1));
}

/* |x| with the sign of sign. */
static inline double with_sign(double x, double sign)
{
    return bits_double((double_bits(x) & (UINT64_MAX >> 1)) | (double_bits(sign) & ~(UINT64_MAX >> 1)));
}

/* 2^k for -1022 <= k <= 1023. */
static inline double power_of_two(int k)
{
    return bits_double((uint64_t)(k + 1023) << 52);
}

/* x * 2^k, rounded once, for x in [1/2, 4] and |k| <= 1200: the first factor of a small k keeps x normal, hence exact.
 */
static inline double scale(double x, int k)
{
    if (k > 1023)
        return x * power_of_two(1000) * power_of_two(k - 1000);
    if (k < -1000)
        return x * power_of_two(-900) * power_of_two(k + 900);
    return x * power_of_two(k);
}

/* The integer nearest to x, ties to even, for |x| < 2^51: 1.5 * 2^52 has units of 1. */
static inline double nearest(double x)
{
    return (x + 0x1.8p52) - 0x1.8p52;
}

static inline lom_pair fast_two_sum(double a, double b) /* |a| >= |b| or a == 0 */
{
    double s = a + b;
    return (lom_pair){ s, b - (s - a) };
}

static inline lom_pair two_sum(double a, double b)
{
    double s = a + b;
    double bb = s - a;
    return (lom_pair){ s, (a - (s - bb)) + (b - bb) };
}

static inline lom_pair two_product(double a, double b)
{
    double p = a * b;
    double ta = a * 134217729.0; /* 2^27 + 1: Veltkamp's split into 26 + 26 bits and a sign */
    double tb = b * 134217729.0;
    double ah = ta - (ta - a);
    double bh = tb - (tb - b);
    double al = a - ah;
    double bl = b - bh;
    return (lom_pair){ p, ((ah * bh - p) + ah * bl + al * bh) + al * bl };
}

static inline lom_pair pair_add(lom_pair a, lom_pair b)
{
    lom_pair s = two_sum(a.hi, b.hi);
    lom_pair t = two_sum(a.lo, b.lo);
    s = fast_two_sum(s.hi, s.lo + t.hi);
    return fast_two_sum(s.hi, s.lo + t.lo);
}

static inline lom_pair pair_negate(lom_pair a)
{
    return (lom_pair){ -a.hi, -a.lo };
}

static inline lom_pair pair_multiply(lom_pair a, lom_pair b)
{
    lom_pair p = two_product(a.hi, b.hi);
    return fast_two_sum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

static inline lom_pair pair_divide(lom_pair a, lom_pair b)
{
    double q = a.hi / b.hi;
    lom_pair p = two_product(q, b.hi);
    double rest = ((a.hi - p.hi) - p.lo) + (a.lo - q * b.lo);
    return fast_two_sum(q, rest / b.hi);
}

static inline lom_pair pair_sqrt(lom_pair a) /* a.hi >= 0 */
{
    double s = __builtin_sqrt(a.hi);
    if (s == 0)
        return (lom_pair){ 0, 0 };
    lom_pair p = two_product(s, s);
    return fast_two_sum(s, (((a.hi - p.hi) - p.lo) + a.lo) / (s + s));
}

/* coefficient[0] + coefficient[1] x + ... by Horner. */
static inline double polynomial(double x, const double *coefficient, int count)
{
    double sum = coefficient[count - 1];
    for (int i = count - 2; i >= 0; i--)
        sum = sum * x + coefficient[i];
    return sum;
}

/* e^(x.hi + x.lo) = m * 2^*k with m in [0.99, 2], to a relative 2^-66; |x.hi| <= 800. */
lom_pair lom_exp_parts(lom_pair x, int *k);

/* log(x.hi + x.lo) to a relative 2^-66; x.hi > 0 and finite, |x.lo| <= ulp(x.hi)/2. */
lom_pair lom_log_parts(lom_pair x);

#endif
