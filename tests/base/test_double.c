/* lom_double_*: known values (decimal arithmetic, hard cases among them), C's special cases, random arguments against
 * quadruple precision where the compiler has it, symmetries, and one hash that every machine must find. */
#include <lom/base.h>

#include "check.h"
#include "double_values.h"

#include <float.h>
#include <math.h>

typedef double function1(double);
typedef double function2(double, double);

static uint64_t bits_of(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static double double_of(uint64_t bits)
{
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* The distance of got from hi + lo in ulps of hi. */
static double error_in_ulps(double got, double hi, double lo)
{
    int exponent;
    if (isnan(got) || isnan(hi))
        return isnan(got) && isnan(hi) ? 0 : INFINITY;
    if (isinf(got) || isinf(hi))
        return got == hi ? 0 : INFINITY;
    frexp(hi, &exponent);
    if (exponent < -1021)
        exponent = -1021;
    return fabs(ldexp(got - hi, 53 - exponent) - ldexp(lo, 53 - exponent));
}

/* clang-format off */
#define UNARY(X)                                                                                                       \
    X(sin, SIN) X(cos, COS) X(tan, TAN) X(asin, ASIN)                                                                  \
    X(acos, ACOS) X(atan, ATAN) X(exp, EXP) X(exp2, EXP2)                                                              \
    X(expm1, EXPM1) X(log, LOG) X(log2, LOG2) X(log1p, LOG1P)                                                          \
    X(sinh, SINH) X(cosh, COSH) X(tanh, TANH) X(erf, ERF)                                                              \
    X(cbrt, CBRT)
/* clang-format on */

static const struct unary {
    const char *name;
    function1 *function;
    const double (*value)[3];
    size_t count;
} unary[] = {
#define ROW(name, NAME) { #name, lom_double_##name, NAME##_VALUES, sizeof NAME##_VALUES / sizeof NAME##_VALUES[0] },
    UNARY(ROW)
#undef ROW
};
enum { UNARY_COUNT = sizeof unary / sizeof unary[0] };

static void known_values_are_within_1_ulp(void)
{
    for (int f = 0; f < UNARY_COUNT; f++)
        for (size_t i = 0; i < unary[f].count; i++) {
            const double *v = unary[f].value[i];
            double got = unary[f].function(v[0]);
            CHECK(error_in_ulps(got, v[1], v[2]) <= 1, "%s(%a) = %a, not %a", unary[f].name, v[0], got, v[1]);
        }
    for (size_t i = 0; i < sizeof POW_VALUES / sizeof POW_VALUES[0]; i++) {
        const double *v = POW_VALUES[i];
        double got = lom_double_pow(v[0], v[1]);
        CHECK(error_in_ulps(got, v[2], v[3]) <= 1, "pow(%a, %a) = %a, not %a", v[0], v[1], got, v[2]);
    }
    for (size_t i = 0; i < sizeof ATAN2_VALUES / sizeof ATAN2_VALUES[0]; i++) {
        const double *v = ATAN2_VALUES[i];
        double got = lom_double_atan2(v[0], v[1]);
        CHECK(error_in_ulps(got, v[2], v[3]) <= 1, "atan2(%a, %a) = %a, not %a", v[0], v[1], got, v[2]);
    }
}

/* C11 Annex F.10, by bits; every NaN is 0x7ff8000000000000. */
static void special_cases_are_those_of_c(void)
{
    const double inf = INFINITY, pi = 0x1.921fb54442d18p+1;
    const double nan = double_of(UINT64_C(0x7ff8000000000000)), signed_nan = double_of(UINT64_C(0xfff0000000000001));
    const struct {
        function1 *function;
        double x, want;
    } table[] = {
        { lom_double_sin, -0.0, -0.0 },
        { lom_double_sin, inf, nan },
        { lom_double_cos, 0, 1 },
        { lom_double_cos, -inf, nan },
        { lom_double_tan, -0.0, -0.0 },
        { lom_double_tan, inf, nan },
        { lom_double_asin, -0.0, -0.0 },
        { lom_double_asin, 1, pi / 2 },
        { lom_double_asin, -1, -pi / 2 },
        { lom_double_asin, 1.5, nan },
        { lom_double_acos, 1, 0 },
        { lom_double_acos, -1, pi },
        { lom_double_acos, -inf, nan },
        { lom_double_acos, 0, pi / 2 },
        { lom_double_atan, -0.0, -0.0 },
        { lom_double_atan, inf, pi / 2 },
        { lom_double_atan, -inf, -pi / 2 },
        { lom_double_atan, 1, pi / 4 },
        { lom_double_exp, -0.0, 1 },
        { lom_double_exp, inf, inf },
        { lom_double_exp, -inf, 0 },
        { lom_double_exp, 709.79, inf },
        { lom_double_exp, -745.2, 0 },
        { lom_double_exp2, 1024, inf },
        { lom_double_exp2, 10, 1024 },
        { lom_double_exp2, -1074, 0x1p-1074 },
        { lom_double_exp2, -1075, 0 },
        { lom_double_exp2, -inf, 0 },
        { lom_double_expm1, -0.0, -0.0 },
        { lom_double_expm1, -inf, -1 },
        { lom_double_expm1, inf, inf },
        { lom_double_log, 0, -inf },
        { lom_double_log, -0.0, -inf },
        { lom_double_log, 1, 0 },
        { lom_double_log, -1, nan },
        { lom_double_log, inf, inf },
        { lom_double_log2, 8, 3 },
        { lom_double_log2, 0x1p-1074, -1074 },
        { lom_double_log2, 0, -inf },
        { lom_double_log2, -inf, nan },
        { lom_double_log1p, -0.0, -0.0 },
        { lom_double_log1p, -1, -inf },
        { lom_double_log1p, -1.5, nan },
        { lom_double_log1p, inf, inf },
        { lom_double_sinh, -0.0, -0.0 },
        { lom_double_sinh, -inf, -inf },
        { lom_double_sinh, 711, inf },
        { lom_double_cosh, -inf, inf },
        { lom_double_cosh, 0, 1 },
        { lom_double_tanh, -0.0, -0.0 },
        { lom_double_tanh, inf, 1 },
        { lom_double_tanh, -inf, -1 },
        { lom_double_erf, -0.0, -0.0 },
        { lom_double_erf, -inf, -1 },
        { lom_double_cbrt, -0.0, -0.0 },
        { lom_double_cbrt, -27, -3 },
        { lom_double_cbrt, -inf, -inf },
        { lom_double_sqrt, -0.0, -0.0 },
        { lom_double_sqrt, -1, nan },
        { lom_double_sqrt, inf, inf },
        { lom_double_floor, -0.0, -0.0 },
        { lom_double_floor, -0.5, -1 },
        { lom_double_floor, 0.99, 0 },
        { lom_double_floor, -inf, -inf },
        { lom_double_floor, 0x1p53, 0x1p53 },
        { lom_double_floor, -3, -3 },
        { lom_double_sqrt, signed_nan, nan },
        { lom_double_floor, signed_nan, nan },
    };
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++) {
        double got = table[i].function(table[i].x);
        CHECK(bits_of(got) == bits_of(table[i].want), "row %zu: f(%a) = %a, not %a", i, table[i].x, got, table[i].want);
    }
    for (int f = 0; f < UNARY_COUNT; f++) {
        double got = unary[f].function(signed_nan);
        CHECK(bits_of(got) == bits_of(nan), "%s(-NaN) = %016llx", unary[f].name, (unsigned long long)bits_of(got));
    }
}

/* All pairs of remarkable numbers. The platform's pow and atan2 follow Annex F; where a result is finite and not 0 they
 * may differ by an ulp. */
static void pairs_of_special_numbers(void)
{
    static const double number[] = { 0,           0x1p-1074, 1e-310, 1e-5,    0.5,      1 - 0x1p-53, 1,
                                     1 + 0x1p-52, 1.5,       2,      3,       4,        1023,        0x1p52 + 1,
                                     0x1p53 - 1,  0x1p53,    1e300,  DBL_MAX, INFINITY, NAN };
    enum { COUNT = sizeof number / sizeof number[0] };
    for (int i = 0; i < 4 * COUNT * COUNT; i++) {
        double x = number[i / 4 % COUNT] * (i & 1 ? -1 : 1), y = number[i / 4 / COUNT] * (i & 2 ? -1 : 1);
        double got = lom_double_pow(x, y), want = pow(x, y);
        bool same_sign = isnan(want) || signbit(got) == signbit(want);
        CHECK(error_in_ulps(got, want, 0) <= 1 && same_sign, "pow(%a, %a) = %a, not %a", x, y, got, want);
        got = lom_double_atan2(x, y), want = atan2(x, y);
        same_sign = isnan(want) || signbit(got) == signbit(want);
        CHECK(error_in_ulps(got, want, 0) <= 1 && same_sign, "atan2(%a, %a) = %a, not %a", x, y, got, want);
    }
}

/* A number in [low, high), or with any bits where high is not above low. */
static double random_argument(uint64_t key, uint64_t i, double low, double high)
{
    if (low < high)
        return low + (high - low) * lom_random_uniform(key, i);
    return double_of(lom_random_bits(key, i));
}

#ifdef __SIZEOF_FLOAT128__

typedef __float128 quad;

/* |got - want| in ulps of want, denormals included. */
static double quad_error_in_ulps(double got, quad want)
{
    int exponent;
    if (isinf(got) || isinf((double)want))
        return got == (double)want ? 0 : INFINITY;
    frexp((double)want, &exponent);
    int up = 53 - (exponent < -1021 ? -1021 : exponent);
    return fabs((double)((got - want) * ldexp(1, up / 2) * ldexp(1, up - up / 2)));
}

static const quad QUAD_LN2 = (quad)0x1.62e42fefa39efp-1 + (quad)0x1.abc9e3b39803fp-56 + (quad)0x1.7b57a079a1934p-111;
static const quad QUAD_PI = (quad)0x1.921fb54442d18p+1 + (quad)0x1.1a62633145c07p-53 - (quad)0x1.f1976b7ed8fbcp-109;

/* e^x for |x| <= 11500: x = n ln2 + r, r/64 by Taylor, squared six times. */
static quad quad_expm1_small(quad x)
{
    quad sum = 0, term = x;
    for (int n = 2; n < 30; n++) {
        sum += term;
        term *= x / n;
    }
    return sum;
}

static quad quad_exp(quad x)
{
    int n = (int)(x / QUAD_LN2 + (x < 0 ? -0.5 : 0.5));
    quad m = 1 + quad_expm1_small(x - n * QUAD_LN2);
    for (; n > 0; n--)
        m *= 2;
    for (; n < 0; n++)
        m /= 2;
    return m;
}

static quad quad_expm1(quad x)
{
    return x > -0.3 && x < 0.3 ? quad_expm1_small(x) : quad_exp(x) - 1;
}

/* x = 2^k z, |log z| < 0.35, log z = 2 atanh((z - 1)/(z + 1)). */
static quad quad_log(quad x)
{
    int k = 0;
    for (; x > 1.4142; k++)
        x /= 2;
    for (; x < 0.7071; k--)
        x *= 2;
    quad s = (x - 1) / (x + 1), sum = 0, power = s;
    for (int n = 1; n < 50; n += 2) {
        sum += power / n;
        power *= s * s;
    }
    return k * QUAD_LN2 + 2 * sum;
}

/* sin x for |x| < 2^20. */
static quad quad_sin(quad x)
{
    int64_t n = (int64_t)(x / QUAD_PI + (x < 0 ? -0.5 : 0.5));
    quad r = x - n * QUAD_PI, sum = 0, term = r;
    for (int k = 2; k < 40; k += 2) {
        sum += term;
        term *= -r * r / (k * (k + 1));
    }
    return n & 1 ? -sum : sum;
}

static quad quad_cos(quad x)
{
    return quad_sin(x + QUAD_PI / 2);
}

static quad quad_tan(quad x)
{
    return quad_sin(x) / quad_cos(x);
}

/* atan x = 2 atan(x/(1 + sqrt(1 + x^2))), the root by Newton from double. */
static quad quad_sqrt(quad x)
{
    quad root = sqrt((double)x);
    for (int i = 0; i < 3 && root != 0; i++)
        root = (root + x / root) / 2;
    return root;
}

static quad quad_atan(quad x)
{
    if (x > 1 || x < -1)
        return (x > 0 ? QUAD_PI / 2 : -QUAD_PI / 2) - quad_atan(1 / x);
    int halvings = 0;
    for (; x > 0.05 || x < -0.05; halvings++)
        x = x / (1 + quad_sqrt(1 + x * x));
    quad sum = 0, power = x;
    for (int n = 1; n < 30; n += 2) {
        sum += (n & 2 ? -power : power) / n;
        power *= x * x;
    }
    return sum * (1 << halvings);
}

static quad quad_asin(quad x)
{
    return quad_atan(x / quad_sqrt((1 - x) * (1 + x)));
}

static quad quad_acos(quad x)
{
    return 2 * quad_atan(quad_sqrt((1 - x) / (1 + x)));
}

static quad quad_erf(quad x)
{
    quad sum = 0, term = x;
    for (int n = 0; n < 120; n++) {
        sum += term / (2 * n + 1);
        term *= -x * x / (n + 1);
    }
    return 2 * sum / quad_sqrt(QUAD_PI);
}

static quad quad_exp2(quad x)
{
    return quad_exp(x * QUAD_LN2);
}

static quad quad_log2(quad x)
{
    return quad_log(x) / QUAD_LN2;
}

static quad quad_log1p(quad x)
{
    return quad_log(1 + x);
}

static quad quad_sinh(quad x)
{
    return (quad_expm1(x) - quad_expm1(-x)) / 2;
}

static quad quad_cosh(quad x)
{
    return (quad_exp(x) + quad_exp(-x)) / 2;
}

static quad quad_tanh(quad x)
{
    return quad_expm1(2 * x) / (quad_expm1(2 * x) + 2);
}

static quad quad_cbrt(quad x)
{
    return x < 0 ? -quad_exp(quad_log(-x) / 3) : quad_exp(quad_log(x) / 3);
}

static void random_arguments_are_within_1_ulp(void)
{
    static const struct {
        const char *name;
        function1 *function;
        quad (*oracle)(quad);
        double low, high;
    } table[] = {
#define ROW(name, low, high) { #name, lom_double_##name, quad_##name, low, high },
        ROW(sin, -10, 10) ROW(sin, -1e6, 1e6) ROW(cos, -10, 10) ROW(cos, -1e6, 1e6) ROW(tan, -10, 10)
            ROW(tan, -1e6, 1e6) ROW(asin, -1, 1) ROW(acos, -1, 1) ROW(acos, 0.999, 1) ROW(atan, -3, 3)
                ROW(atan, -0.1, 0.1) ROW(atan, -1e5, 1e5) ROW(exp, -1, 1) ROW(exp, -745, 709.7) ROW(exp, -745, -700)
                    ROW(exp2, -1, 1) ROW(exp2, -1074, 1023.9) ROW(expm1, -1, 1) ROW(expm1, -40, 60)
                        ROW(expm1, -0.01, 0.01) ROW(log, 0, 3) ROW(log, 0.98, 1.02) ROW(log, 0, 1e300) ROW(log2, 0, 3)
                            ROW(log2, 0.98, 1.02) ROW(log1p, -1, 1) ROW(log1p, -0.01, 0.01) ROW(log1p, 0, 1e20)
                                ROW(sinh, -3, 3) ROW(sinh, -710, 710) ROW(cosh, -3, 3) ROW(cosh, -710, 710)
                                    ROW(tanh, -1, 1) ROW(tanh, -20, 20) ROW(erf, -1, 1) ROW(erf, -3, 3) ROW(cbrt, -8, 8)
                                        ROW(cbrt, -1e300, 1e300)
#undef ROW
    };
    for (size_t f = 0; f < sizeof table / sizeof table[0]; f++) {
        double worst = 0, at = 0;
        for (uint64_t i = 0; i < 4000; i++) {
            double x = random_argument(f, i, table[f].low, table[f].high);
            double error = quad_error_in_ulps(table[f].function(x), table[f].oracle(x));
            if (error > worst)
                worst = error, at = x;
        }
        CHECK(worst <= 1, "%s(%a) is off by %.3f ulp", table[f].name, at, worst);
        printf("  %-5s in [%g, %g): %.3f ulp\n", table[f].name, table[f].low, table[f].high, worst);
    }
    double worst = 0;
    for (uint64_t i = 0; i < 20000; i++) {
        double x = random_argument(100, i, i & 1 ? 0 : 0.99, i & 1 ? 4 : 1.01);
        double y = random_argument(101, i, -1, 1) * 740 / fabs(log(x));
        double error = quad_error_in_ulps(lom_double_pow(x, y), quad_exp(y * quad_log(x)));
        CHECK(error <= 1, "pow(%a, %a) is off by %.3f ulp", x, y, error);
        worst = error > worst ? error : worst;
    }
    printf("  pow: %.3f ulp\n", worst);
}

#endif

static void symmetries_are_exact(void)
{
    for (uint64_t i = 0; i < 20000; i++) {
        double x = random_argument(200, i, 0, i & 1 ? 20 : 0); /* every other one has any bits */
        for (int f = 0; f < UNARY_COUNT; f++) {
            double there = unary[f].function(x), back = unary[f].function(-x);
            bool even = strcmp(unary[f].name, "cos") == 0 || strcmp(unary[f].name, "cosh") == 0;
            bool odd = strstr("sin tan asin atan sinh tanh erf cbrt", unary[f].name) != NULL;
            if (isnan(there) || (!even && !odd))
                continue;
            CHECK(back == (even ? there : -there), "%s(-+%a)", unary[f].name, x);
        }
    }
}

/* The same bits with every compiler, level and machine. */
static void the_hash_is_the_recorded_one(void)
{
    uint64_t hash = LOM_HASH_START;
    for (uint64_t i = 0; i < 3000; i++)
        for (int f = 0; f < UNARY_COUNT + 2; f++) {
            double x = random_argument(300, i, -8, i % 3 == 0 ? -8 : 8), y = random_argument(301, i, -8, 8);
            double value = f < UNARY_COUNT    ? unary[f].function(x)
                           : f == UNARY_COUNT ? lom_double_pow(fabs(x), y)
                                              : lom_double_atan2(x, y);
            uint64_t bits = bits_of(value);
            uint8_t bytes[8];
            for (int k = 0; k < 8; k++)
                bytes[k] = (uint8_t)(bits >> 8 * k);
            hash = lom_hash_bytes(hash, bytes, 8);
        }
    CHECK(hash == UINT64_C(0xc7a8b18160926b87), "%016llx", (unsigned long long)hash);
}

/* What the rounding of a double to a float leaves, of three members of a struct: gcc 12 vectorizes such lines, from -O2 on,
 * to no rounding at all unless FLOAT_FLAGS keep it from that. */
struct split {
    float near[4], rest[4];
};

__attribute__((noinline)) static struct split split_three(const double *x)
{
    struct split s = { .near = { 0 } };
    for (int i = 0; i < 3; i++) {
        s.near[i] = (float)x[i];
        s.rest[i] = (float)(x[i] - (double)s.near[i]);
    }
    return s;
}

static void a_rounding_to_float_is_never_dropped(void)
{
    static const double x[3] = { 10.1, 20.7, -33.3 };
    struct split s = split_three(x);
    for (int i = 0; i < 3; i++) {
        volatile float near = (float)x[i];
        CHECK(s.near[i] == near && s.rest[i] == (float)(x[i] - (double)near) && s.rest[i] != 0, "%d: %a", i,
              (double)s.rest[i]);
    }
}

int main(int argc, char **argv)
{
    RUN(known_values_are_within_1_ulp);
    RUN(special_cases_are_those_of_c);
    RUN(pairs_of_special_numbers);
#ifdef __SIZEOF_FLOAT128__
    RUN(random_arguments_are_within_1_ulp);
#else
    printf("SKIP random_arguments_are_within_1_ulp: the compiler has no quadruple precision here\n");
#endif
    RUN(symmetries_are_exact);
    RUN(the_hash_is_the_recorded_one);
    RUN(a_rounding_to_float_is_never_dropped);
    return check_result();
}
