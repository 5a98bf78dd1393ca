/* Lane mathematics: pow and atan2 within 1 ulp of libm's double functions (whose error is far below an ulp of float)
 * over a grid, random and remarkable pairs, NaN results by their bits, lanes that do not see each other, and one hash
 * that every width, compiler, level and machine must find. Functions of one argument: test_every_float.wide.c.
 * LOM_EXHAUSTIVE=1 visits 2^24 pairs of the grid and 2^28 random ones. */
#include <lom/lanes_mathematics.h>

#include "check.h"
#include "ulps.h"

static __attribute__((noinline)) void lanes_pow(lom_float *result, const lom_float *x, const lom_float *y)
{
    *result = lom_pow(*x, *y);
}

static __attribute__((noinline)) void lanes_atan2(lom_float *result, const lom_float *y, const lom_float *x)
{
    *result = lom_atan2(*y, *x);
}

static const struct unary {
    const char *name;
    unary_lanes *function;
} unary[] = {
#define ROW(name) { #name, lanes_##name },
    UNARY(ROW)
};
enum { UNARY_COUNT = sizeof unary / sizeof unary[0] };

static void check_pair(const char *name, binary_lanes *function, double (*oracle)(double, double), const float *x,
                       const float *y, double *worst)
{
    float out[LOM_LANES];
    lom_float vx = lom_load(x), vy = lom_load(y), result;
    function(&result, &vx, &vy);
    lom_store(out, result);
    for (int i = 0; i < LOM_LANES; i++) {
        double error = error_in_ulps(out[i], oracle(x[i], y[i]));
        CHECK(error <= 1, "%s(%a, %a) = %a is off by %g ulp", name, x[i], y[i], out[i], error);
        *worst = error > *worst ? error : *worst;
    }
}

static float random_float(uint64_t key, uint64_t i, float low, float high)
{
    return low + (high - low) * (float)lom_random_uniform(key, i);
}

/* Every sign and exponent with every so many of the next bits of the mantissa, each with each: 512 floats, or 4096. */
static void a_grid_of_pairs_is_within_1_ulp(void)
{
    const uint32_t count = every_float_is_visited() ? 1u << 12 : 1u << 9, step = UINT32_MAX / count + 1;
    double worst_pow = 0, worst_atan2 = 0;
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t k = 0; k < count; k += LOM_LANES) {
            float x[LOM_LANES], y[LOM_LANES];
            for (uint32_t lane = 0; lane < LOM_LANES; lane++)
                x[lane] = float_of(i * step), y[lane] = float_of((k + lane) * step);
            check_pair("pow", lanes_pow, pow, x, y, &worst_pow);
            check_pair("atan2", lanes_atan2, atan2, x, y, &worst_atan2);
        }
    printf("  pow   %.4f ulp\n  atan2 %.4f ulp\n", worst_pow, worst_atan2);
}

/* Four kinds of pairs: any bits, powers of a cosine, bases near 1 with results of every size, and moderate numbers. */
static void random_pairs_are_within_1_ulp(void)
{
    const uint64_t count = every_float_is_visited() ? UINT64_C(1) << 28 : 400000;
    double worst_pow = 0, worst_atan2 = 0;
    for (uint64_t i = 0; i < count; i += LOM_LANES) {
        float x[LOM_LANES], y[LOM_LANES];
        for (uint64_t k = 0; k < LOM_LANES; k++) {
            uint64_t n = i + k, bits = lom_random_bits(1, n);
            switch (n % 4) {
            case 0:
                x[k] = float_of((uint32_t)bits), y[k] = float_of((uint32_t)(bits >> 32));
                break;
            case 1:
                x[k] = random_float(2, n, 0, 1), y[k] = random_float(3, n, 0, 200);
                break;
            case 2:
                x[k] = random_float(2, n, 0.99f, 1.01f);
                y[k] = random_float(3, n, -100, 100) / (float)fabs(log(x[k]) + 1e-9);
                break;
            default:
                x[k] = random_float(2, n, 0, 9), y[k] = random_float(3, n, -9, 9);
            }
        }
        check_pair("pow", lanes_pow, pow, x, y, &worst_pow);
        check_pair("atan2", lanes_atan2, atan2, x, y, &worst_atan2);
    }
    printf("  pow   %.4f ulp\n  atan2 %.4f ulp\n", worst_pow, worst_atan2);
}

static __attribute__((noinline)) void lanes_fade(lom_float *result, const lom_float *x)
{
    *result = lom_fade(*x);
}

/* e^x down to -87, then 0: never a denormal; a NaN stays one. */
static void what_fades_is_never_denormal(void)
{
    for (uint64_t i = 0; i < 200000; i += LOM_LANES) {
        lom_float x, e, faded;
        for (uint64_t k = 0; k < LOM_LANES; k++)
            x[k] = i < 100000 ? random_float(5, i + k, -110, 5) : float_of((uint32_t)lom_random_bits(6, i + k));
        lanes_exp(&e, &x);
        lanes_fade(&faded, &x);
        for (int k = 0; k < LOM_LANES; k++)
            CHECK(bits_of(faded[k]) == (x[k] <= -87.0f ? 0 : bits_of(e[k])), "%a: %a, not %a", (double)x[k],
                  (double)faded[k], (double)e[k]);
    }
    lom_float ends = lom_splat(-87.0f), next = lom_splat(-0x1.5bfffep+6f), faded;
    lanes_fade(&faded, &ends);
    CHECK(bits_of(faded[0]) == 0);
    lanes_fade(&faded, &next);
    CHECK(faded[0] >= 0x1p-126f, "%a", (double)faded[0]);
}

static void remarkable_pairs_follow_annex_f(void)
{
    static const float number[] = {
        0.0f, 0x1p-149f, 0x1p-127f, 1e-5f,  0.5f,           0x1.fffffep-1f, 1.0f,  0x1.000002p0f,   1.5f,
        2.0f, 3.0f,      4.0f,      127.0f, 0x1.fffffep23f, 0x1p24f,        1e30f, 0x1.fffffep127f, INFINITY,
        NAN
    };
    enum { COUNT = sizeof number / sizeof number[0] };
    double worst = 0;
    for (int i = 0; i < 4 * COUNT * COUNT; i += LOM_LANES) {
        float x[LOM_LANES], y[LOM_LANES];
        for (int k = 0; k < LOM_LANES; k++) {
            int n = (i + k) % (4 * COUNT * COUNT);
            x[k] = copysignf(number[n / 4 % COUNT], n & 1 ? -1.0f : 1.0f);
            y[k] = copysignf(number[n / 4 / COUNT], n & 2 ? -1.0f : 1.0f);
        }
        check_pair("pow", lanes_pow, pow, x, y, &worst);
        check_pair("atan2", lanes_atan2, atan2, x, y, &worst);
    }
}

static void integer_powers_by_squaring(void)
{
    static const int exponent[] = { 0, 1, 2, 3, 5, 8, 13, 32, 64, 100, -1, -3 };
    for (uint64_t i = 0; i < 4000; i += LOM_LANES) {
        float in[LOM_LANES], out[LOM_LANES];
        for (uint64_t k = 0; k < LOM_LANES; k++)
            in[k] = random_float(5, i + k, -1.5f, 1.5f);
        for (size_t e = 0; e < sizeof exponent / sizeof exponent[0]; e++) {
            int n = exponent[e];
            lom_store(out, lom_pow_integer(lom_load(in), n));
            for (int k = 0; k < LOM_LANES; k++) {
                double want = pow(in[k], n), bound = (abs(n) + 1) * 0x1p-24 * fabs(want) + 64 * 0x1p-149;
                CHECK(fabs(out[k] - want) <= bound, "%a^%d = %a", in[k], n, out[k]);
                if (n == 13) { /* the stated order */
                    float square = in[k] * in[k], fourth = square * square;
                    CHECK(out[k] == in[k] * fourth * (fourth * fourth));
                }
            }
        }
    }
}

/* A lane's bits are the same whatever stands beside it: an argument alone, and beside ones that take the slow ways. */
static void lanes_do_not_see_each_other(void)
{
    static const float company[] = { 1e30f, NAN, INFINITY, -1.0f, 0.0f, 0x1p-149f };
    for (uint64_t i = 0; i < 3000; i++) {
        float x = i & 1 ? random_float(7, i, -4, 4) : float_of((uint32_t)lom_random_bits(7, i));
        float y = random_float(8, i, -4, 4);
        int lane = (int)(i % LOM_LANES);
        lom_float alone = lom_splat(x), beside = lom_splat(company[i % 6]), other = lom_splat(y), first, second;
        beside[lane] = x;
        for (int f = 0; f < UNARY_COUNT; f++) {
            unary[f].function(&first, &alone);
            unary[f].function(&second, &beside);
            CHECK(bits_of(first[lane]) == bits_of(second[lane]), "%s(%a)", unary[f].name, x);
        }
        lanes_pow(&first, &alone, &other);
        lanes_pow(&second, &beside, &other);
        CHECK(bits_of(first[lane]) == bits_of(second[lane]), "pow(%a, %a)", x, y);
        lanes_atan2(&first, &alone, &other);
        lanes_atan2(&second, &beside, &other);
        CHECK(bits_of(first[lane]) == bits_of(second[lane]), "atan2(%a, %a)", x, y);
    }
}

static uint64_t hash_lanes(uint64_t hash, const lom_float *value)
{
    uint8_t bytes[LOM_LANES][4];
    for (int i = 0; i < LOM_LANES; i++)
        for (int k = 0; k < 4; k++)
            bytes[i][k] = (uint8_t)(bits_of((*value)[i]) >> 8 * k);
    return lom_hash_bytes(hash, bytes, sizeof bytes);
}

static void the_hash_is_the_recorded_one(void)
{
    uint64_t hash = LOM_HASH_START;
    enum { COUNT = 4096 };
    for (int f = 0; f < UNARY_COUNT + 3; f++)
        for (uint64_t i = 0; i < COUNT; i += LOM_LANES) {
            lom_float x, y, result;
            for (uint64_t k = 0; k < LOM_LANES; k++) {
                uint64_t n = i + k;
                x[k] = n & 1 ? random_float(9, n, -8, 8) : float_of((uint32_t)lom_random_bits(9, n));
                y[k] = n % 3 ? random_float(10, n, -8, 8) : float_of((uint32_t)lom_random_bits(10, n));
            }
            if (f < UNARY_COUNT)
                unary[f].function(&result, &x);
            else if (f == UNARY_COUNT)
                lanes_pow(&result, &x, &y);
            else if (f == UNARY_COUNT + 1)
                lanes_atan2(&result, &x, &y);
            else
                result = lom_keep_nan(x, lom_pow_integer(x, 37));
            hash = hash_lanes(hash, &result);
        }
    CHECK(hash == UINT64_C(0xf6b4f34185758017), "%016llx", (unsigned long long)hash);
}

int main(int argc, char **argv)
{
    RUN(a_grid_of_pairs_is_within_1_ulp);
    RUN(random_pairs_are_within_1_ulp);
    RUN(what_fades_is_never_denormal);
    RUN(remarkable_pairs_follow_annex_f);
    RUN(integer_powers_by_squaring);
    RUN(lanes_do_not_see_each_other);
    RUN(the_hash_is_the_recorded_one);
    return check_result();
}
