/* MPFR (L. Fousse et al.: MPFR, a multiple-precision binary floating-point library with correct rounding, 2007) as the
 * witness of lom's mathematics. In: floats and doubles all over their range, near remarkable ones, and random. Proves
 * that the double functions are within an ulp of the true value, that the ones by which tests/lanes judges the lanes
 * err far less than an ulp of float, and the lanes themselves. The true value is MPFR's to 160 bits. Only make
 * check-long builds this. */
#include <lom/lanes_mathematics.h>

#include "check.h"

#include <math.h>
#include <mpfr.h>

typedef void unary_lanes(lom_float *result, const lom_float *x);
typedef int exact_unary(mpfr_t result, const mpfr_t x, mpfr_rnd_t rounding);
typedef int exact_binary(mpfr_t result, const mpfr_t x, const mpfr_t y, mpfr_rnd_t rounding);

enum { BITS = 160, PERIOD_OF_FLOATS = 65537, DOUBLES = 60000, PAIRS = 60000 };

static mpfr_t truth, first, second, size;

static void open_truth(void)
{
    mpfr_init2(truth, BITS);
    mpfr_init2(size, BITS);
    mpfr_init2(first, 53);
    mpfr_init2(second, 53);
}

static void close_truth(void)
{
    mpfr_clears(truth, first, second, size, (mpfr_ptr)0);
    mpfr_free_cache();
}

static mpfr_srcptr magnitude(void)
{
    mpfr_abs(size, truth, MPFR_RNDN);
    return size;
}

/* The distance of got from the truth in ulps of a format of `digits` bits whose least normal number is 2^least: 2^-149
 * and 2^-1074 are the least ulps. What rounds to infinity may be infinite; a zero keeps its sign, a NaN is one. */
static double error_in_ulps(double got, int digits, int least, double largest)
{
    if (mpfr_nan_p(truth) || isnan(got))
        return mpfr_nan_p(truth) && isnan(got) ? 0 : INFINITY;
    if (mpfr_zero_p(truth))
        return got == 0 && (signbit(got) != 0) == (mpfr_signbit(truth) != 0) ? 0 : INFINITY;
    if (isinf(got) || mpfr_inf_p(truth)) /* what is above the largest number may be rounded to infinity */
        return isinf(got) && (got > 0) == (mpfr_sgn(truth) > 0) && mpfr_cmp_d(magnitude(), largest) > 0 ? 0 : INFINITY;
    long exponent = mpfr_get_exp(truth) - 1; /* truth = 1.xxx 2^exponent */
    exponent = exponent < least ? least : exponent;
    mpfr_d_sub(size, got, truth, MPFR_RNDN);
    mpfr_mul_2si(size, size, digits - 1 - exponent, MPFR_RNDN);
    return fabs(mpfr_get_d(size, MPFR_RNDN));
}

static double error_of_float(float got)
{
    return error_in_ulps(got, 24, -126, 0x1.fffffep127);
}

static double error_of_double(double got)
{
    return error_in_ulps(got, 53, -1022, 0x1.fffffffffffffp1023);
}

/* ---- functions of one number ---- */

/* clang-format off */
#define LANES(X) X(exp) X(exp2) X(expm1) X(tanh) X(log) X(log2) X(sin) X(cos) X(tan) X(asin) X(acos) X(atan)
#define DOUBLES_ALONE(X) X(log1p) X(sinh) X(cosh) X(erf) X(cbrt)
/* clang-format on */

#define WRAP(name)                                                                                                     \
    static __attribute__((noinline)) void lanes_##name(lom_float *result, const lom_float *x)                          \
    {                                                                                                                  \
        *result = lom_##name(*x);                                                                                      \
    }
LANES(WRAP)

static const struct unary {
    const char *name;
    unary_lanes *lanes; /* NULL: there is none */
    double (*ours)(double), (*platform)(double);
    exact_unary *exact;
} unary[] = {
#define LANE_ROW(name)   { #name, lanes_##name, lom_double_##name, name, mpfr_##name },
#define DOUBLE_ROW(name) { #name, NULL, lom_double_##name, name, mpfr_##name },
    LANES(LANE_ROW) DOUBLES_ALONE(DOUBLE_ROW)
};
enum { UNARY_COUNT = sizeof unary / sizeof unary[0] };

static float float_of(uint32_t bits)
{
    float x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

static double double_of(uint64_t bits)
{
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

struct worst {
    double error, at;
};

static void keep_worst(struct worst *worst, double error, double at)
{
    if (!(error <= worst->error))
        *worst = (struct worst){ error, at };
}

static void find_truth(const struct unary *f, double x)
{
    mpfr_set_d(first, x, MPFR_RNDN);
    f->exact(truth, first, MPFR_RNDN);
}

/* Floats in equal steps of their bits, and the neighbours of 0, 1, pi/2, the ends of the range of each exponential. */
static float float_number(uint32_t i)
{
    static const float remarkable[] = { 0.0f,       0x1p-149f, 0x1p-126f, 0.5f,     1.0f,     1.57079633f,
                                        3.1415927f, 88.7228f,  103.972f,  127.999f, 149.0f,   8388608.0f,
                                        1e22f,      1e38f,     INFINITY,  NAN,      0x1p-12f, 0.693147f };
    const uint32_t near = 16 * (uint32_t)(sizeof remarkable / sizeof remarkable[0]);
    if (i >= near)
        return float_of((i - near) * PERIOD_OF_FLOATS);
    uint32_t bits;
    memcpy(&bits, &remarkable[i / 16], sizeof bits);
    bits += i / 2 % 8 - 4 * (bits >= 4);
    return float_of(i & 1 ? bits ^ UINT32_C(0x80000000) : bits);
}

static void lanes_and_their_judge_are_true(void)
{
    const uint32_t count = UINT32_MAX / PERIOD_OF_FLOATS + 16 * 18;
    for (int f = 0; f < UNARY_COUNT; f++) {
        struct worst lanes = { 0, 0 }, judge = { 0, 0 };
        for (uint32_t i = 0; i < count && unary[f].lanes != NULL; i++) {
            float x = float_number(i);
            lom_float in = lom_splat(x), out;
            unary[f].lanes(&out, &in);
            find_truth(&unary[f], x);
            keep_worst(&lanes, error_of_float(out[0]), (double)x);
            keep_worst(&judge, error_of_double(unary[f].platform(x)), (double)x);
        }
        CHECK(lanes.error <= 1, "lom_%s(%a) is off by %g ulp", unary[f].name, lanes.at, lanes.error);
        /* a thousandth of what is judged: 2^29 ulps of double are one of float */
        CHECK(judge.error <= 0x1p19, "the platform's %s(%a) is off by %g ulp", unary[f].name, judge.at, judge.error);
        if (unary[f].lanes != NULL)
            printf("  lanes %-5s %.4f ulp of float at %a; their judge %.3f ulp of double at %a\n", unary[f].name,
                   lanes.error, lanes.at, judge.error, judge.at);
    }
}

/* A quarter any bits, a quarter within 20 of 0, a quarter near 1 from both sides, a quarter small. */
static double double_number(uint64_t i)
{
    double unit = 2 * lom_random_uniform(32, i) - 1;
    switch (i % 4) {
    case 0:
        return double_of(lom_random_bits(31, i));
    case 1:
        return 20 * unit;
    case 2:
        return 1 + unit * ldexp(1, -(int)(i / 4 % 50));
    default:
        return ldexp(unit, -(int)(i / 4 % 300));
    }
}

/* sin, cos and tan are promised to 2^40. */
static bool is_promised(const struct unary *f, double x)
{
    bool turns = f->ours == lom_double_sin || f->ours == lom_double_cos || f->ours == lom_double_tan;
    return !turns || !(fabs(x) > 0x1p40) || isinf(x);
}

static void doubles_are_true(void)
{
    for (int f = 0; f < UNARY_COUNT; f++) {
        struct worst ours = { 0, 0 };
        for (uint64_t i = 0; i < DOUBLES; i++) {
            double x = double_number(i);
            if (!is_promised(&unary[f], x))
                continue;
            find_truth(&unary[f], x);
            keep_worst(&ours, error_of_double(unary[f].ours(x)), x);
        }
        CHECK(ours.error <= 1, "lom_double_%s(%a) is off by %g ulp", unary[f].name, ours.at, ours.error);
        printf("  double %-5s %.4f ulp at %a\n", unary[f].name, ours.error, ours.at);
    }
}

/* ---- functions of two numbers ---- */

static __attribute__((noinline)) void lanes_pow(lom_float *result, const lom_float *x, const lom_float *y)
{
    *result = lom_pow(*x, *y);
}

static __attribute__((noinline)) void lanes_atan2(lom_float *result, const lom_float *y, const lom_float *x)
{
    *result = lom_atan2(*y, *x);
}

static const struct binary {
    const char *name;
    void (*lanes)(lom_float *result, const lom_float *x, const lom_float *y);
    double (*ours)(double, double);
    exact_binary *exact;
} binary[] = { { "pow", lanes_pow, lom_double_pow, mpfr_pow }, { "atan2", lanes_atan2, lom_double_atan2, mpfr_atan2 } };

/* Any bits; a base from 0 to 9 and its power; a base near 1 with a power that leads anywhere. */
static void make_pair(uint64_t i, double pair[2])
{
    double unit = lom_random_uniform(42, i), other = 2 * lom_random_uniform(43, i) - 1;
    pair[0] = 9 * unit;
    pair[1] = 30 * other;
    if (i % 3 == 0) {
        pair[0] = float_of((uint32_t)lom_random_bits(41, i));
        pair[1] = float_of((uint32_t)(lom_random_bits(41, i) >> 32));
    } else if (i % 3 == 1) {
        pair[0] = 1 + (unit - 0.5) * 0x1p-5;
        pair[1] = 60 * other / (fabs(log(pair[0])) + 1e-9);
    }
}

static void pairs_are_true(void)
{
    for (size_t f = 0; f < sizeof binary / sizeof binary[0]; f++) {
        struct worst ours = { 0, 0 }, lanes = { 0, 0 };
        for (uint64_t i = 0; i < PAIRS; i++) {
            double pair[2];
            make_pair(i, pair);
            mpfr_set_d(first, pair[0], MPFR_RNDN);
            mpfr_set_d(second, pair[1], MPFR_RNDN);
            binary[f].exact(truth, first, second, MPFR_RNDN);
            keep_worst(&ours, error_of_double(binary[f].ours(pair[0], pair[1])), pair[0]);
            float x = (float)pair[0], y = (float)pair[1];
            lom_float vx = lom_splat(x), vy = lom_splat(y), out;
            binary[f].lanes(&out, &vx, &vy);
            mpfr_set_flt(first, x, MPFR_RNDN);
            mpfr_set_flt(second, y, MPFR_RNDN);
            binary[f].exact(truth, first, second, MPFR_RNDN);
            keep_worst(&lanes, error_of_float(out[0]), (double)x);
        }
        CHECK(ours.error <= 1, "lom_double_%s(%a, ...) is off by %g ulp", binary[f].name, ours.at, ours.error);
        CHECK(lanes.error <= 1, "lom_%s(%a, ...) is off by %g ulp", binary[f].name, lanes.at, lanes.error);
        printf("  %-5s double %.4f ulp, lanes %.4f ulp\n", binary[f].name, ours.error, lanes.error);
    }
}

int main(int argc, char **argv)
{
    open_truth();
    RUN(lanes_and_their_judge_are_true);
    RUN(doubles_are_true);
    RUN(pairs_are_true);
    close_truth();
    return check_result();
}
