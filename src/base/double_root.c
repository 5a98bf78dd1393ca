/* sqrt, floor, cbrt in double. In: any double; out: sqrt correctly rounded, floor exact, cbrt within 1 ulp (0.51).
 * Invariant: the same bits on every machine (double_parts.h). */
#include "base/double_parts.h"

double lom_double_sqrt(double x)
{
    return x >= 0 ? __builtin_sqrt(x) : x == 0 ? x : double_nan();
}

double lom_double_floor(double x)
{
    if (x != x)
        return double_nan();
    if (magnitude(x) >= 0x1p52) /* an integer already */
        return x;
    double whole = (double)lom_int64_of(x);
    return with_sign(whole > x ? whole - 1 : whole, x);
}

/* |x| = z 8^k with z in [1, 8): y near z^(1/3) from a parabola through z = 1, 2.8, 8, then Newton's
 * y - (y^3 - z)/(3 y^2), which squares the relative error (0.02 at first); the last step has its residual in pairs. */
double lom_double_cbrt(double x)
{
    double a = magnitude(x);
    if (x != x)
        return double_nan();
    if (a == 0 || a == DOUBLE_INFINITY)
        return x;
    int k = 0;
    if (a < 0x1p-1022) {
        a *= 0x1p54;
        k = -18;
    }
    int exponent = (int)(double_bits(a) >> 52) - 1023;
    int third = (exponent + 3072) / 3 - 1024;
    double z = bits_double(double_bits(a) - ((uint64_t)(int64_t)(3 * third) << 52));
    k += third;

    double y = 0.70 + z * (0.2965 - z * 0.0166);
    for (int i = 0; i < 4; i++)
        y = y - (y * y * y - z) / (3 * y * y);
    lom_pair cube = pair_multiply(two_product(y, y), (lom_pair){ y, 0 });
    double rest = ((cube.hi - z) + cube.lo) / (3 * y * y);
    return with_sign((y - rest) * power_of_two(k), x);
}
