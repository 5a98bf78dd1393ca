/* Every lane function of one argument over a stride through all 2^32 floats, against libm's double functions, whose
 * error is far below an ulp of float: the largest error in ulps and where it is, how many results are not the nearest
 * float, and one sum over arguments and results that is the same at every width. LOM_EXHAUSTIVE=1 visits every float on
 * all processors, but of sin, cos and tan from 131 072 on: there they are the double functions rounded once, which
 * tests/base/test_double.c bounds. Of every float it prints the table of bench/results/lane-mathematics.md and
 * docs/extremes.md. */
#include "base/threads.h"

#include "check.h"
#include "ulps.h"

#define EXACT(X) X(sqrt) X(floor) X(ceil) X(round) X(fraction) X(saturate)
EXACT(WRAP)
#define EXACT_ORACLES(X) X(sqrt) X(floor) X(ceil) X(nearbyint) X(fraction) X(saturate) X(power_2) X(power_5) X(power_32)

#define POWER(n)                                                                                                       \
    static __attribute__((noinline)) void lanes_power_##n(lom_float *result, const lom_float *x)                       \
    {                                                                                                                  \
        *result = lom_keep_nan(*x, lom_pow_integer(*x, n));                                                            \
    }                                                                                                                  \
    static double power_##n(double x)                                                                                  \
    {                                                                                                                  \
        return isnan(x) ? x : pow(x, n);                                                                               \
    }
POWER(2)
POWER(5)
POWER(32)

/* x - floor(x), where the nearest float may be 1, which lom_fraction never is. */
static double fraction(double x)
{
    double part = x - floor(x);
    return (float)part >= 1 ? 0 : part;
}

static double saturate(double x)
{
    return x > 0 ? fmin(x, 1) : 0;
}

/* An oracle of lanes: as it is, or where glibc has it (libmvec, 2.35 on) four at a time, within 4 ulps of double. */
#define MANY(name)                                                                                                     \
    static void many_##name(lom_double *want, const lom_double *x)                                                     \
    {                                                                                                                  \
        for (int i = 0; i < LOM_LANES; i++)                                                                            \
            (*want)[i] = name((*x)[i]);                                                                                \
    }
#if defined __AVX2__ && defined __GLIBC_PREREQ
#if __GLIBC_PREREQ(2, 35)
#define HAS_VECTORS
#endif
#endif
#ifdef HAS_VECTORS
#include <immintrin.h>
#define MANY_VECTORS(name)                                                                                             \
    __m256d _ZGVdN4v_##name(__m256d);                                                                                  \
    static void many_##name(lom_double *want, const lom_double *x)                                                     \
    {                                                                                                                  \
        for (size_t i = 0; i < sizeof *x / sizeof(__m256d); i++) {                                                     \
            __m256d part;                                                                                              \
            memcpy(&part, (const char *)x + i * sizeof part, sizeof part);                                             \
            part = _ZGVdN4v_##name(part);                                                                              \
            memcpy((char *)want + i * sizeof part, &part, sizeof part);                                                \
        }                                                                                                              \
    }
#else
#define MANY_VECTORS MANY
#endif
UNARY(MANY_VECTORS)
EXACT_ORACLES(MANY)

/* The bounds of pow_integer: of each of n roundings at most an ulp of the result. */
static const struct unary {
    const char *name;
    unary_lanes *function;
    double (*oracle)(double);
    void (*oracles)(lom_double *want, const lom_double *x);
    double low, high; /* beyond them the result is that at them, or NaN */
    bool is_nan_beyond;
    double bound;       /* ulps */
    double dense_below; /* magnitudes below which every float is visited; above, 16 of every 496 */
    bool keeps_nan;     /* with its payload: any NaN will do */
    uint64_t sum[2];    /* of arguments and results: over every 2039th float, and over all that is ever visited */
} functions[] = {
#define ROW(name, lanes, oracle, low, high, is_nan_beyond, bound, dense_below, keeps_nan, some, all)                   \
    {                                                                                                                  \
        name, lanes_##lanes, oracle, many_##oracle, low, high, is_nan_beyond, bound, dense_below, keeps_nan,           \
        {                                                                                                              \
            UINT64_C(some), UINT64_C(all)                                                                              \
        }                                                                                                              \
    }
    ROW("exp", exp, exp, -200, 200, false, 1, INFINITY, false, 0xe1c7b6d2b00e42bc, 0x75eaea7a9e8e90e2),
    ROW("exp2", exp2, exp2, -200, 200, false, 1, INFINITY, false, 0xb24b853b05cab1c6, 0x3f0a0e4da730a39f),
    ROW("expm1", expm1, expm1, -200, 200, false, 1, INFINITY, false, 0x55c7ee641dcec88e, 0x579dafd2a3d80828),
    ROW("tanh", tanh, tanh, -50, 50, false, 1, INFINITY, false, 0x06e0e7209adba691, 0xac034c3b329892b4),
    ROW("log", log, log, 0, INFINITY, true, 1, INFINITY, false, 0x5859060663298c6c, 0xefa1a6d3a3f1185c),
    ROW("log2", log2, log2, 0, INFINITY, true, 1, INFINITY, false, 0x6cbe92d42a1dc13a, 0x11326208e957e7b7),
    ROW("sin", sin, sin, -INFINITY, INFINITY, false, 1, 131072, false, 0xacbb0c1f5c63da98, 0xfcc474796014db80),
    ROW("cos", cos, cos, -INFINITY, INFINITY, false, 1, 131072, false, 0xde62fed5e4cc7c3e, 0xa808867bfb31e9e0),
    ROW("tan", tan, tan, -INFINITY, INFINITY, false, 1, 131072, false, 0x15adb0f50b271d2e, 0xd16d074c7b0abeee),
    ROW("asin", asin, asin, -1, 1, true, 1, INFINITY, false, 0x155cf68bbadbab12, 0x02a859e6d08e219e),
    ROW("acos", acos, acos, -1, 1, true, 1, INFINITY, false, 0x7702069229d63d13, 0x3fe31384d966b1a0),
    ROW("atan", atan, atan, -INFINITY, INFINITY, false, 1, INFINITY, false, 0x667c98467079c3fb, 0x835bcdcfa08b9922),
    ROW("pow_integer(x, 2)", power_2, power_2, -INFINITY, INFINITY, false, 0.5, 0, false, 0xbde109c4a386f236,
        0x24bea9c61ca6d228),
    ROW("pow_integer(x, 5)", power_5, power_5, -INFINITY, INFINITY, false, 5, 0, false, 0xfc52014abb6bef5d,
        0x02904aea9371fb4c),
    ROW("pow_integer(x, 32)", power_32, power_32, -INFINITY, INFINITY, false, 32, 0, false, 0x7eb013981e930859,
        0x644a7abc45e53978),
    ROW("sqrt", sqrt, sqrt, 0, INFINITY, true, 0.5, INFINITY, true, 0xc50ac84cbf501600, 0x7006b0c70ae30bb6),
    ROW("floor", floor, floor, -INFINITY, INFINITY, false, 0, INFINITY, true, 0x4b1ad720cf336241, 0x85b2c71c94000000),
    ROW("ceil", ceil, ceil, -INFINITY, INFINITY, false, 0, INFINITY, true, 0xbfcb31f9540c0005, 0xd1b2c71c94000000),
    ROW("round", round, nearbyint, -INFINITY, INFINITY, false, 0, INFINITY, true, 0x7567ad2690ece2ff,
        0xa3459c71aa000000),
    ROW("fraction", fraction, fraction, -INFINITY, INFINITY, false, 0.5, INFINITY, true, 0xe364108d74ef7cd6,
        0x029db8e3b1c00000),
    ROW("saturate", saturate, saturate, -INFINITY, INFINITY, false, 0, INFINITY, true, 0xd69d4e5c869fe0ec,
        0x8cb5b5558a400000),
};
enum { COUNT = sizeof functions / sizeof functions[0], BLOCKS = 4096 };

struct found {
    double worst; /* ulps */
    float at;
    uint64_t not_nearest, sum;
};

struct walk {
    const struct unary *unary;
    uint32_t stride, count; /* floats visited in each block */
    struct found found[BLOCKS];
};

static void note(struct found *found, const struct unary *unary, float x, float got)
{
    const double want = unary->oracle(x);
    if (bits_of((float)want) == bits_of(got) && !isnan(got))
        return;
    double error = unary->keeps_nan && isnan(want) && isnan(got) ? 0 : error_in_ulps(got, want);
    found->not_nearest += !isnan(want);
    if (error > found->worst)
        found->worst = error, found->at = x;
}

/* The float nearest to what the vector of the oracle says. */
LOM_INLINE lom_float nearest_result(const struct unary *unary, lom_float x)
{
    lom_double asked = lom_widen(x), want;
    for (int k = 0; k < LOM_LANES; k++)
        asked[k] = asked[k] < unary->low ? unary->low : asked[k] > unary->high ? unary->high : asked[k];
    unary->oracles(&want, &asked);
    for (int k = 0; k < LOM_LANES && unary->is_nan_beyond; k++)
        want[k] = x[k] < unary->low || x[k] > unary->high ? NAN : want[k];
    const lom_float nearest = lom_narrow(want);
    return lom_select(nearest == nearest, nearest, (lom_float)lom_splat_int(QUIET_NAN));
}

/* Of arguments and results: so many bits, multiplied. */
LOM_INLINE lom_ulong mix(lom_uint argument, lom_uint result)
{
    const lom_long low = (lom_long){ 0 } + 0xffffffff;
    const lom_long a = __builtin_convertvector((lom_int)argument, lom_long) & low;
    return (lom_ulong)(__builtin_convertvector((lom_int)result, lom_long) & low) * (lom_ulong)(2 * a + 1);
}

/* What is the nearest float to a vector of the oracle is within half an ulp; the rest is looked at one by one. */
static void walk_blocks(void *context, size_t first, size_t end)
{
    struct walk *walk = context;
    for (size_t block = first; block < end; block++) {
        struct found found = { walk->unary->bound < 0.5 ? 0 : 0.5, 0, 0, 0 };
        const float start = float_of((uint32_t)(block * walk->count));
        const bool is_sparse = walk->stride == 1 && isfinite(start) && fabs(start) >= walk->unary->dense_below;
        lom_ulong sum = { 0 };
        for (uint32_t i = 0; i < walk->count; i += LOM_LANES) {
            if (is_sparse && i / 16 % 31 != 0)
                continue;
            const uint32_t at = (uint32_t)block * walk->count + i;
            const lom_uint bits = (lom_splat_uint(at) + (lom_uint)lom_lane_index()) * walk->stride;
            lom_float x = (lom_float)bits, y;
            walk->unary->function(&y, &x);
            if (walk->unary->keeps_nan)
                y = lom_select(y == y, y, (lom_float)lom_splat_int(QUIET_NAN));
            sum += mix(bits, (lom_uint)y);
            const lom_float nearest = nearest_result(walk->unary, x);
            const uint32_t differs = lom_bits((lom_int)nearest != (lom_int)y);
            for (int k = 0; k < LOM_LANES && differs != 0; k++)
                if (differs >> k & 1)
                    note(&found, walk->unary, x[k], y[k]);
        }
        for (int k = 0; k < LOM_LANES; k++)
            found.sum += sum[k];
        walk->found[block] = found;
    }
}

/* Of a run over all floats, a row of the table of bench/results/lane-mathematics.md, as far as a test knows it, and what
 * docs/extremes.md has besides. */
static void print_row(const struct unary *unary, const struct found *found)
{
    const char *dense = unary->dense_below == 0 ? "16 of every 496 floats" : "all floats";
    char over[96];
    if (unary->dense_below > 0 && isfinite(unary->dense_below))
        snprintf(over, sizeof over, "all floats below %g, 16 of every 496 above", unary->dense_below);
    else if (unary->is_nan_beyond && isfinite(unary->high))
        snprintf(over, sizeof over, "%s in [%g, %g]", dense, unary->low, unary->high);
    else
        snprintf(over, sizeof over, "%s", dense);
    printf("| %s | %.5f | %s | %a | %llu |\n", unary->name, found->worst, over, found->at,
           (unsigned long long)found->not_nearest);
}

static void every_float_is_within_its_bound(void)
{
    static struct walk walk;
    lom_pool *pool = lom_create_pool(lom_default_threads(), NULL);
    const bool all = every_float_is_visited();
    walk.stride = all ? 1 : 2039; /* a prime */
    walk.count = all ? 1 << 20 : 512;
    CHECK(pool != NULL);
    if (all) {
        printf("%d lanes\n\n| function | largest error, ulp | over | at | not nearest |\n|---|---|---|---|---|\n",
               LOM_LANES);
        fflush(stdout);
    }
    for (int f = 0; pool != NULL && f < COUNT; f++) {
        walk.unary = &functions[f];
        lom_share_out(pool, BLOCKS, 1, walk_blocks, &walk);
        struct found all_found = { 0, 0, 0, 0 };
        for (int block = 0; block < BLOCKS; block++) {
            const struct found *found = &walk.found[block];
            if (found->worst > all_found.worst)
                all_found.worst = found->worst, all_found.at = found->at;
            all_found.not_nearest += found->not_nearest;
            all_found.sum += found->sum;
        }
        CHECK(all_found.worst <= functions[f].bound, "%s(%a) is off by %g ulp", functions[f].name, all_found.at,
              all_found.worst);
        CHECK(all_found.sum == functions[f].sum[all], "%s: the sum is %016llx", functions[f].name,
              (unsigned long long)all_found.sum);
        if (all)
            print_row(&functions[f], &all_found);
        else
            printf("  %-18s %.5f ulp at %a, %llu not nearest, sum %016llx\n", functions[f].name, all_found.worst,
                   all_found.at, (unsigned long long)all_found.not_nearest, (unsigned long long)all_found.sum);
        fflush(stdout);
    }
    lom_free_pool(pool);
}

int main(int argc, char **argv)
{
    RUN(every_float_is_within_its_bound);
    return check_result();
}
