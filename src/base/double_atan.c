/* asin, acos, atan, atan2 in double. In: any doubles; out: within 1 ulp (0.52). Invariant: the same bits on every
 * machine (double_parts.h).
 *
 * All four are the angle of a point (d, n), 0 <= n <= d, in pairs: with c = i/16 the nearest to n/d,
 * atan(n/d) = atan c + atan t, t = (n - c d)/(d + c n), |t| <= 1/32 (the addition theorem); atan c comes from a table
 * of pairs, atan t from its Taylor series to t^15/15 (the rest is below 2^-80 of t). The other octants follow by pi/2 -
 * angle and pi - angle. asin x is the angle of (sqrt(1 - x^2), x), the root taken in pairs, acos x that of (x, sqrt(1 -
 * x^2)). */
#include "base/double_parts.h"

static const lom_pair PI = { 0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53 };
static const lom_pair HALF_PI = { 0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54 };

static const lom_pair ATAN[17] = {
    /* atan(i/16) */
    { 0x0p+0, 0x0p+0 },
    { 0x1.ff55bb72cfdeap-5, -0x1.c934d86d23f1dp-60 },
    { 0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59 },
    { 0x1.7b97b4bce5b02p-3, 0x1.347b0b4f881cap-58 },
    { 0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57 },
    { 0x1.362773707ebccp-2, -0x1.963a544b672d8p-57 },
    { 0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56 },
    { 0x1.a64eec3cc23fdp-2, -0x1.24dec1b50b7ffp-56 },
    { 0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56 },
    { 0x1.0657e94db30dp-1, -0x1.d5b495f6349e6p-56 },
    { 0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58 },
    { 0x1.345f01cce37bbp-1, 0x1.1021137c71102p-55 },
    { 0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56 },
    { 0x1.5d58987169b18p-1, 0x1.0028e4bc5e7cap-57 },
    { 0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56 },
    { 0x1.819d0b7158a4dp-1, -0x1.bf76229d3b917p-56 },
    { 0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55 },
};

/* atan(n/d) for 0 <= n <= d, 2^-600 < d < 2^600. */
static lom_pair first_octant(lom_pair n, lom_pair d)
{
    static const double coefficient[] = { -1.0 / 3, 1.0 / 5, -1.0 / 7, 1.0 / 9, -1.0 / 11, 1.0 / 13, -1.0 / 15 };
    int i = lom_int_of(n.hi / d.hi * 16 + 0.5);
    lom_pair c = { i * 0.0625, 0 };
    lom_pair t = pair_divide(pair_add(n, pair_negate(pair_multiply(c, d))), pair_add(d, pair_multiply(c, n)));
    double square = t.hi * t.hi;
    lom_pair angle = fast_two_sum(t.hi, t.lo + t.hi * square * polynomial(square, coefficient, 7));
    return i == 0 ? angle : pair_add(ATAN[i], angle);
}

/* The angle in [0, pi] of the point (x, y), y >= 0, not both 0. */
static double upper_angle(lom_pair y, lom_pair x)
{
    lom_pair ax = x.hi < 0 ? pair_negate(x) : x;
    bool steep = y.hi > ax.hi;
    lom_pair angle = steep ? first_octant(ax, y) : first_octant(y, ax);
    if (steep)
        angle = pair_add(HALF_PI, pair_negate(angle));
    if (x.hi < 0)
        angle = pair_add(PI, pair_negate(angle));
    return angle.hi + angle.lo;
}

/* sqrt(1 - x^2) for |x| <= 1 */
static lom_pair other_leg(double x)
{
    lom_pair square = two_product(x, x);
    return pair_sqrt(pair_add((lom_pair){ 1, 0 }, pair_negate(square)));
}

double lom_double_asin(double x)
{
    double a = magnitude(x);
    if (!(a <= 1))
        return double_nan();
    if (a < 0x1p-28)
        return x; /* x^3/6 is below half an ulp */
    return with_sign(upper_angle((lom_pair){ a, 0 }, other_leg(a)), x);
}

double lom_double_acos(double x)
{
    if (!(magnitude(x) <= 1))
        return double_nan();
    if (magnitude(x) < 0x1p-60)
        return HALF_PI.hi;
    return upper_angle(other_leg(x), (lom_pair){ x, 0 });
}

double lom_double_atan(double x)
{
    double a = magnitude(x);
    if (x != x)
        return double_nan();
    if (a < 0x1p-28)
        return x; /* x^3/3 is below half an ulp */
    if (a > 0x1p60)
        return with_sign(HALF_PI.hi, x);
    return with_sign(upper_angle((lom_pair){ a, 0 }, (lom_pair){ 1, 0 }), x);
}

/* C11 Annex F.10.1.4. */
double lom_double_atan2(double y, double x)
{
    double a = magnitude(x), b = magnitude(y);
    if (x != x || y != y)
        return double_nan();
    if (a == DOUBLE_INFINITY && b == DOUBLE_INFINITY)
        return with_sign(is_negative(x) ? 0x1.2d97c7f3321d2p+1 : 0x1.921fb54442d18p-1, y); /* 3 pi/4, pi/4 */
    if (b == 0 || a == DOUBLE_INFINITY)
        return with_sign(is_negative(x) ? PI.hi : 0.0, y);
    if (a == 0 || b == DOUBLE_INFINITY)
        return with_sign(HALF_PI.hi, y);
    double larger = a > b ? a : b; /* brought into [2^-474, 2^500] */
    double factor = larger > 0x1p500 ? 0x1p-600 : larger < 0x1p-400 ? 0x1p600 : 1;
    double sx = x * factor, sy = b * factor, sa = a * factor;
    if (sa * 0x1p-60 > sy)
        return with_sign(is_negative(x) ? PI.hi : b / a, y);
    if (sy * 0x1p-60 > sa)
        return with_sign(HALF_PI.hi, y);
    return with_sign(upper_angle((lom_pair){ sy, 0 }, (lom_pair){ sx, 0 }), y);
}
