/* Nanoseconds a value of the lane mathematics at one width: make bench-mathematics. In: 4096 arguments spread over the
 * stated range, in the first-level cache; out: a line a function, the best of 500 passes. "exp in float" is what
 * lom_exp would be without double lanes: Cody and Waite's two-part ln 2, the rounding error of 1 + r and of r kept, two
 * factors of 2^k for denormals (which are rounded twice). */
#include <lom/lanes_mathematics.h>

#include <stdio.h>
#include <time.h>

enum { COUNT = 4096, PASSES = 500 };

LOM_INLINE lom_float exp_in_float(lom_float x)
{
    lom_float bounded = lom_clamp(x, lom_splat(-105.0f), lom_splat(89.0f));
    lom_float t = bounded * 1.44269504f + 0x1.8p23f, n = t - 0x1.8p23f;
    lom_float high = bounded - n * 0x1.62ep-1f, low = n * 0x1.0bfbe8p-15f, r = high - low;
    lom_float q = 0x1.5554e8p-5f + r * (0x1.1110ep-7f + r * (0x1.6d43d2p-10f + r * 0x1.a1258cp-13f));
    q = 0.5f + r * (0x1.555556p-3f + r * q);
    lom_float sum = 1.0f + r, lost = ((1.0f - sum) + r) + ((high - r) - low);
    lom_float value = sum + (lost + r * r * q);
    lom_int k = (lom_int)t - 0x4b400000, half = k >> 1;
    value = value * (lom_float)((half + 127) << 23) * (lom_float)((k - half + 127) << 23);
    return lom_keep_nan(x, value);
}

#define ONE(name, expression)                                                                                          \
    static void name(lom_float *out, const lom_float *in)                                                              \
    {                                                                                                                  \
        lom_float x = *in, y = x + 0.5f;                                                                               \
        (void)y;                                                                                                       \
        *out = expression;                                                                                             \
    }
ONE(run_exp, lom_exp(x))
ONE(run_exp_in_float, exp_in_float(x))
ONE(run_exp2, lom_exp2(x))
ONE(run_expm1, lom_expm1(x))
ONE(run_tanh, lom_tanh(x))
ONE(run_log, lom_log(x))
ONE(run_log2, lom_log2(x))
ONE(run_pow, lom_pow(x, y))
ONE(run_pow_integer, lom_pow_integer(x, 32))
ONE(run_sin, lom_sin(x))
ONE(run_cos, lom_cos(x))
ONE(run_tan, lom_tan(x))
ONE(run_asin, lom_asin(x))
ONE(run_acos, lom_acos(x))
ONE(run_atan, lom_atan(x))
ONE(run_atan2, lom_atan2(y, x))

static const struct row {
    const char *name;
    void (*run)(lom_float *out, const lom_float *in);
    float low, high;
} rows[] = {
    { "exp", run_exp, -10, 10 },
    { "exp in float", run_exp_in_float, -10, 10 },
    { "exp2", run_exp2, -10, 10 },
    { "expm1", run_expm1, -10, 10 },
    { "tanh", run_tanh, -5, 5 },
    { "log", run_log, 0.1f, 10 },
    { "log2", run_log2, 0.1f, 10 },
    { "pow(x, x + 1/2)", run_pow, 0, 4 },
    { "pow_integer(x, 32)", run_pow_integer, 0, 1 },
    { "sin", run_sin, -10, 10 },
    { "cos", run_cos, -10, 10 },
    { "tan", run_tan, -10, 10 },
    { "asin", run_asin, -1, 1 },
    { "acos", run_acos, -1, 1 },
    { "atan", run_atan, -5, 5 },
    { "atan2(x + 1/2, x)", run_atan2, -5, 5 },
};

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + (double)now.tv_nsec * 1e-9;
}

int main(void)
{
    static lom_float in[COUNT / LOM_LANES], out[COUNT / LOM_LANES];
    for (size_t r = 0; r < sizeof rows / sizeof rows[0]; r++) {
        for (int i = 0; i < COUNT; i++)
            in[i / LOM_LANES][i % LOM_LANES] = rows[r].low + (rows[r].high - rows[r].low) * (float)i / COUNT;
        double best = 1;
        for (int pass = 0; pass < PASSES; pass++) {
            double start = seconds();
            for (int i = 0; i < COUNT / LOM_LANES; i++)
                rows[r].run(&out[i], &in[i]);
            __asm__ volatile("" : : "r"(out) : "memory");
            double taken = seconds() - start;
            best = taken < best ? taken : best;
        }
        printf("%2d lanes  %-20s %.2f ns\n", LOM_LANES, rows[r].name, best / COUNT * 1e9);
    }
    return 0;
}
