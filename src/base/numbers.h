/* Numbers that every folder needs. */
#ifndef LOM_BASE_NUMBERS_H
#define LOM_BASE_NUMBERS_H

static const double lom_pi __attribute__((unused)) = 3.141592653589793;
static const double lom_two_pi __attribute__((unused)) = 6.283185307179586;
static const double lom_radians_per_degree __attribute__((unused)) = 0.017453292519943295;

/* The smaller and the larger of two: the second where they are equal or one of them is NaN. */
static inline __attribute__((unused)) double lom_smaller(double a, double b)
{
    return a < b ? a : b;
}
static inline __attribute__((unused)) double lom_larger(double a, double b)
{
    return a > b ? a : b;
}
static inline __attribute__((unused)) int lom_smaller_int(int a, int b)
{
    return a < b ? a : b;
}
static inline __attribute__((unused)) int lom_larger_int(int a, int b)
{
    return a > b ? a : b;
}

/* |x|, but for -0, which stays. */
static inline __attribute__((unused)) double lom_magnitude(double x)
{
    return x < 0 ? -x : x;
}
static inline __attribute__((unused)) int lom_magnitude_int(int x)
{
    return x < 0 ? -x : x;
}

/* x, or 0 below 2^-100: products of floats that small, with shares of 2^-26 and more, may be denormal, and there are
 * processors that take a hundred times as long for those. What scenes and meshes say comes through here. */
static inline __attribute__((unused)) double lom_without_denormals(double x)
{
    return lom_magnitude(x) < 0x1p-100 ? 0 : x;
}

/* To floats, as uniforms hold colours and coefficients. */
static inline __attribute__((unused)) void lom_round_three(float out[3], const double in[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = (float)in[i];
}

#endif
