/* log, log2, log1p, pow in double. In: any doubles; out: within 1 ulp (0.52 in the normal range).
 * Invariant: the same bits on every machine (double_parts.h).
 *
 * Method (Tang, "Table-driven implementation of the logarithm function", 1990): x = 2^k z with z in [11/16, 11/8), cut
 * into 128 intervals by the leading bits; c is the reciprocal of the interval's middle, rounded to a multiple of 1/512
 * and exactly 1 in the two intervals beside 1, so that log x keeps its relative precision there. r = z c - 1 is exact
 * in a pair, |r| <= 2^-7, and log x = k ln2 - log c + log(1 + r). The series of log(1 + r) has its first three terms in
 * pairs and the others, to r^11/11 (the rest is below 2^-73 of r), in double: 2^-69 relative, which
 * leaves y log x an absolute error of 2^-59 where pow comes near overflow. */
#include "base/double_parts.h"

static const lom_pair LN2 = { 0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56 };
static const lom_pair INV_LN2 = { 0x1.71547652b82fep+0, 0x1.777d0ffda0d24p-56 };
static const lom_pair THIRD = { 0x1.5555555555555p-2, 0x1.5555555555555p-56 };

#define START UINT64_C(0x3fe6000000000000) /* the bits of 11/16 */

static const struct reciprocal {
    double c, log_hi, log_lo; /* -log c = log_hi + log_lo */
} RECIPROCAL[128] = {
    { 0x1.738p+0, -0x1.7d4eeef5eec6ep-2, 0x1.8f8f27d8e90e9p-61 },
    { 0x1.71p+0, -0x1.7664e1239dbcfp-2, 0x1.f6d5d64f5daf8p-57 },
    { 0x1.6fp+0, -0x1.70d42e2789236p-2, 0x1.52cc811d78d59p-57 },
    { 0x1.6dp+0, -0x1.6b3bb2235943ep-2, 0x1.da856ccd987b3p-56 },
    { 0x1.6bp+0, -0x1.659b57303e1f3p-2, 0x1.f893d41c411f1p-56 },
    { 0x1.69p+0, -0x1.5ff3070a793d4p-2, 0x1.bc60efafc6f6ep-57 },
    { 0x1.67p+0, -0x1.5a42ab0f4cfe2p-2, 0x1.8ebcb7dee9a3dp-56 },
    { 0x1.65p+0, -0x1.548a2c3add263p-2, 0x1.819cf7e308ddbp-57 },
    { 0x1.63p+0, -0x1.4ec973260026ap-2, 0x1.42a87d977dc5ep-56 },
    { 0x1.618p+0, -0x1.4a7373cecf997p-2, -0x1.cb140cabb6bdbp-56 },
    { 0x1.5f8p+0, -0x1.44a41b463c47cp-2, 0x1.d70c8309edcfcp-56 },
    { 0x1.5d8p+0, -0x1.3ecc460ef5f5p-2, 0x1.4313e09807affp-58 },
    { 0x1.5b8p+0, -0x1.38ebdb38ed321p-2, 0x1.3e8cc159afd1p-56 },
    { 0x1.5ap+0, -0x1.347dd9a987d55p-2, 0x1.4dd4c580919f8p-57 },
    { 0x1.58p+0, -0x1.2e8e2bae11d31p-2, 0x1.8f4cdb95ebdf9p-56 },
    { 0x1.56p+0, -0x1.2895a13de86a3p-2, -0x1.7ad24c13f040ep-56 },
    { 0x1.548p+0, -0x1.241558bfd1404p-2, 0x1.9bae06a5c872dp-65 },
    { 0x1.528p+0, -0x1.1e0d0c33716bep-2, -0x1.e55361a93fe61p-57 },
    { 0x1.51p+0, -0x1.1980d2dd4236fp-2, -0x1.9d3d1b0e4d147p-56 },
    { 0x1.4fp+0, -0x1.136870293a8bp-2, -0x1.7b66298edd24ap-56 },
    { 0x1.4d8p+0, -0x1.0ed005f657da4p-2, -0x1.c56bd2abfe82ap-56 },
    { 0x1.4cp+0, -0x1.0a324e27390e3p-2, -0x1.7dcfde8061c03p-56 },
    { 0x1.4ap+0, -0x1.0402594b4d041p-2, 0x1.28ec217a5022dp-57 },
    { 0x1.488p+0, -0x1.feb0233e607ccp-3, -0x1.6e32d5e8c707fp-57 },
    { 0x1.47p+0, -0x1.f550a564b7b37p-3, -0x1.c5f6dfd018c37p-61 },
    { 0x1.45p+0, -0x1.e8c0252aa5a6p-3, 0x1.6e03a39bfc89bp-59 },
    { 0x1.438p+0, -0x1.df46c0c722d2fp-3, -0x1.05616f20722e7p-57 },
    { 0x1.42p+0, -0x1.d5c216b4fbb91p-3, -0x1.6e443597e4d4p-57 },
    { 0x1.408p+0, -0x1.cc320c0176502p-3, -0x1.039a653793a85p-57 },
    { 0x1.3fp+0, -0x1.c2968558c18c1p-3, 0x1.73dee38a3fb6bp-57 },
    { 0x1.3d8p+0, -0x1.b8ef670420c3bp-3, 0x1.999bd0ee3fe88p-57 },
    { 0x1.3cp+0, -0x1.af3c94e80bff3p-3, 0x1.398cff3641985p-58 },
    { 0x1.3a8p+0, -0x1.a57df28244dcdp-3, 0x1.b9af132a24e39p-59 },
    { 0x1.39p+0, -0x1.9bb362e7dfb83p-3, -0x1.575e31f003e0cp-57 },
    { 0x1.378p+0, -0x1.91dcc8c340bdep-3, -0x1.aaf77bfd17182p-58 },
    { 0x1.36p+0, -0x1.87fa06520c911p-3, 0x1.bf7fdbfa08d9ap-57 },
    { 0x1.348p+0, -0x1.7e0afd630c274p-3, 0x1.83e270efcc373p-58 },
    { 0x1.33p+0, -0x1.740f8f54037a5p-3, 0x1.b264062a84cdbp-58 },
    { 0x1.318p+0, -0x1.6a079d0f7aad2p-3, 0x1.eedcbac2a7f18p-62 },
    { 0x1.3p+0, -0x1.5ff3070a793d4p-3, 0x1.bc60efafc6f6ep-58 },
    { 0x1.2e8p+0, -0x1.55d1ad4232d6fp-3, 0x1.ac8966e060839p-58 },
    { 0x1.2d8p+0, -0x1.4f099f4a230b2p-3, -0x1.a0a02a1b24794p-61 },
    { 0x1.2cp+0, -0x1.44d2b6ccb7d1ep-3, -0x1.9f4f6543e1f88p-57 },
    { 0x1.2a8p+0, -0x1.3a8eb2d31a376p-3, 0x1.220a8abf098f4p-60 },
    { 0x1.29p+0, -0x1.303d718e47fd3p-3, 0x1.6b9c7d96091fap-63 },
    { 0x1.28p+0, -0x1.29552f81ff523p-3, -0x1.301771c407dbfp-57 },
    { 0x1.268p+0, -0x1.1eed90e2dc2c3p-3, 0x1.4e47b44db854p-57 },
    { 0x1.25p+0, -0x1.14785846742acp-3, -0x1.a28813e3a7f07p-57 },
    { 0x1.24p+0, -0x1.0d77e7cd08e59p-3, -0x1.9a5dc5e9030acp-57 },
    { 0x1.228p+0, -0x1.02ebb42bf3d4bp-3, 0x1.f4b9c01cb92c6p-59 },
    { 0x1.218p+0, -0x1.f7b79fec37ddfp-4, 0x1.87e897ed01783p-59 },
    { 0x1.2p+0, -0x1.e27076e2af2e6p-4, 0x1.61578001e0162p-60 },
    { 0x1.1fp+0, -0x1.d4313d66cb35dp-4, -0x1.790dd951d90fap-58 },
    { 0x1.1d8p+0, -0x1.beba818146765p-4, 0x1.e2db7c7d5a13p-58 },
    { 0x1.1c8p+0, -0x1.b05b49bee43fep-4, -0x1.160c7c252f298p-58 },
    { 0x1.1bp+0, -0x1.9ab42462033adp-4, 0x1.2099e1c184e8ep-59 },
    { 0x1.1ap+0, -0x1.8c345d6319b21p-4, 0x1.4a697ab3424a9p-61 },
    { 0x1.188p+0, -0x1.765bf23a6be13p-4, -0x1.0ff28ef6a592fp-58 },
    { 0x1.178p+0, -0x1.67bb0726ec0fcp-4, 0x1.b692c214ddbecp-58 },
    { 0x1.168p+0, -0x1.590cafdf01c28p-4, -0x1.3d5c8aaea76d2p-58 },
    { 0x1.15p+0, -0x1.42edcbea646fp-4, -0x1.ddd4f935996c9p-59 },
    { 0x1.14p+0, -0x1.341d7961bd1d1p-4, 0x1.b599f227becbbp-58 },
    { 0x1.13p+0, -0x1.253f62f0a1417p-4, 0x1.c125963fc4cfdp-62 },
    { 0x1.118p+0, -0x1.0ed839b5526fep-4, -0x1.7256ea8988a68p-61 },
    { 0x1.108p+0, -0x1.ffae9119b9303p-5, -0x1.ba13162a9c446p-60 },
    { 0x1.0f8p+0, -0x1.e19070c276016p-5, 0x1.19918a7a17dc1p-59 },
    { 0x1.0e8p+0, -0x1.c355dd0921f2dp-5, 0x1.9b2a03e3be3a7p-60 },
    { 0x1.0dp+0, -0x1.95c830ec8e3ebp-5, -0x1.f5a0e80520bf2p-59 },
    { 0x1.0cp+0, -0x1.77458f632dcfcp-5, -0x1.18d3ca87b9296p-59 },
    { 0x1.0bp+0, -0x1.58a5bafc8e4d5p-5, 0x1.ce55c2b4e2b72p-59 },
    { 0x1.0ap+0, -0x1.39e87b9febd6p-5, 0x1.5bfa937f551bbp-59 },
    { 0x1.09p+0, -0x1.1b0d98923d98p-5, 0x1.e9ae889bac481p-60 },
    { 0x1.078p+0, -0x1.d91a66c543cc4p-6, 0x1.d34e608cbdaabp-62 },
    { 0x1.068p+0, -0x1.9ace7551cc514p-6, -0x1.3409c1df8167fp-60 },
    { 0x1.058p+0, -0x1.5c45a51b8d389p-6, 0x1.b10b6c3ec21b4p-60 },
    { 0x1.048p+0, -0x1.1d7f7eb9eebe7p-6, 0x1.d41fe63d2dbf9p-61 },
    { 0x1.038p+0, -0x1.bcf712c74384cp-7, 0x1.f6842688f499ap-62 },
    { 0x1.028p+0, -0x1.3e7295d25a7d9p-7, 0x1.ff29a11443a06p-65 },
    { 0x1.018p+0, -0x1.7ee11ebd82e94p-8, 0x1.61e96e2fc5d9p-62 },
    { 0x1p+0, 0x0p+0, 0x0p+0 },
    { 0x1p+0, 0x0p+0, 0x0p+0 },
    { 0x1.fap-1, 0x1.82448a388a2aap-7, 0x1.04b16137f09ap-62 },
    { 0x1.f6p-1, 0x1.432a925980cc1p-6, -0x1.8cdaf39004192p-60 },
    { 0x1.f2p-1, 0x1.c63d2ec14aaf2p-6, -0x1.ce030a686bd86p-60 },
    { 0x1.efp-1, 0x1.149e3e4005a8dp-5, -0x1.53482d1f9d7d7p-61 },
    { 0x1.ebp-1, 0x1.5715c4c03ceefp-5, -0x1.bbf88ec501b56p-61 },
    { 0x1.e7p-1, 0x1.9a187b573de7cp-5, -0x1.727626c86b3abp-59 },
    { 0x1.e4p-1, 0x1.ccb73cdddb2ccp-5, -0x1.e48fb0500efd4p-59 },
    { 0x1.ep-1, 0x1.08598b59e3a07p-4, -0x1.dd7009902bf32p-58 },
    { 0x1.ddp-1, 0x1.2207b5c78549ep-4, -0x1.cc0fbce104eaap-58 },
    { 0x1.d9p-1, 0x1.4485e03dbdfadp-4, 0x1.1ba349aadbc6ep-58 },
    { 0x1.d6p-1, 0x1.5e95a4d9791cbp-4, 0x1.f38745c5c450ap-58 },
    { 0x1.d2p-1, 0x1.8197e2f40e3fp-4, 0x1.b9f2dffbeed43p-60 },
    { 0x1.cfp-1, 0x1.9c0c32d4d2548p-4, 0x1.fb0be3ccc1532p-59 },
    { 0x1.ccp-1, 0x1.b6ac88dad5b1cp-4, -0x1.0057eed1ca59fp-59 },
    { 0x1.c9p-1, 0x1.d179788219364p-4, 0x1.9daf7df76ad2ap-59 },
    { 0x1.c6p-1, 0x1.ec739830a112p-4, -0x1.a2bf991780d3fp-59 },
    { 0x1.c2p-1, 0x1.08598b59e3a07p-3, -0x1.dd7009902bf32p-57 },
    { 0x1.bfp-1, 0x1.160c8024b27b1p-3, -0x1.2d56ff61c2bfbp-57 },
    { 0x1.bcp-1, 0x1.23d712a49c202p-3, -0x1.6e38161051d69p-57 },
    { 0x1.b9p-1, 0x1.31b994d3a4f85p-3, -0x1.c4716bdfc0cc9p-58 },
    { 0x1.b6p-1, 0x1.3fb45a59928ccp-3, -0x1.d87e6a354d056p-57 },
    { 0x1.b3p-1, 0x1.4dc7b897bc1c8p-3, -0x1.927d47803c5f4p-57 },
    { 0x1.b1p-1, 0x1.5737cc9018cddp-3, 0x1.4f4d710fec38ep-57 },
    { 0x1.aep-1, 0x1.6574ebe8c133ap-3, -0x1.d34f0f4621bedp-60 },
    { 0x1.abp-1, 0x1.73cb9074fd14dp-3, -0x1.521a000b4cf01p-57 },
    { 0x1.a8p-1, 0x1.823c16551a3c2p-3, -0x1.1232ce70be781p-57 },
    { 0x1.a5p-1, 0x1.90c6db9fcbcd9p-3, 0x1.054473941ad99p-57 },
    { 0x1.a3p-1, 0x1.9a8778debaa38p-3, 0x1.f47dfd871f87fp-57 },
    { 0x1.ap-1, 0x1.a93ed3c8ad9e3p-3, 0x1.bcafa9de97203p-57 },
    { 0x1.9dp-1, 0x1.b811730b823d2p-3, 0x1.a0ee735d9f0ecp-60 },
    { 0x1.9bp-1, 0x1.c2028ab17f9b4p-3, 0x1.f11aa3853a5f1p-57 },
    { 0x1.98p-1, 0x1.d1037f2655e7bp-3, 0x1.60629242471a2p-57 },
    { 0x1.96p-1, 0x1.db13db0d4894p-3, 0x1.aa11d49f96cb9p-58 },
    { 0x1.93p-1, 0x1.ea4449f04aaf5p-3, -0x1.d33919ab94074p-57 },
    { 0x1.91p-1, 0x1.f474b134df229p-3, -0x1.27c77ded76aadp-58 },
    { 0x1.8ep-1, 0x1.01eae5626c691p-2, -0x1.18290bd2932e2p-59 },
    { 0x1.8cp-1, 0x1.07138604d5862p-2, 0x1.cdb16ed4e9138p-56 },
    { 0x1.8ap-1, 0x1.0c42d676162e3p-2, 0x1.162c79d5d11eep-58 },
    { 0x1.87p-1, 0x1.14167ef367783p-2, 0x1.e0936abd4fa6ep-62 },
    { 0x1.85p-1, 0x1.1956d3b9bc2fap-2, 0x1.7b9d68d50a15dp-56 },
    { 0x1.83p-1, 0x1.1e9e1678899f4p-2, 0x1.512c3749a1e4ep-56 },
    { 0x1.8p-1, 0x1.269621134db92p-2, 0x1.e0efadd9db02bp-56 },
    { 0x1.7ep-1, 0x1.2bef07cdc9354p-2, -0x1.82dad7fd86088p-56 },
    { 0x1.7cp-1, 0x1.314f1e1d35ce4p-2, -0x1.3d69909e5c3dcp-56 },
    { 0x1.7ap-1, 0x1.36b6776be1117p-2, -0x1.324f0e883858ep-58 },
    { 0x1.78p-1, 0x1.3c25277333184p-2, -0x1.2ad27e50a8ec6p-56 },
    { 0x1.75p-1, 0x1.44591e0539f49p-2, -0x1.2b125247b0fa5p-56 },
};

/* log(1 + r), |r| <= 2^-7. */
static lom_pair log1p_small(lom_pair r)
{
    static const double coefficient[] = {
        -1.0 / 4, 1.0 / 5, -1.0 / 6, 1.0 / 7, -1.0 / 8, 1.0 / 9, -1.0 / 10, 1.0 / 11
    };
    lom_pair r2 = pair_multiply(r, r);
    lom_pair r3 = pair_multiply(pair_multiply(r2, r), THIRD);
    double tail = r2.hi * r2.hi * polynomial(r.hi, coefficient, 8);
    lom_pair cubic = fast_two_sum(r3.hi, r3.lo + tail);
    return pair_add(pair_add(r, (lom_pair){ -0.5 * r2.hi, -0.5 * r2.lo }), cubic);
}

lom_pair lom_log_parts(lom_pair x)
{
    int k = 0;
    if (x.hi < 0x1p-1022) {
        x.hi *= 0x1p54;
        x.lo *= 0x1p54;
        k = -54;
    }
    uint64_t bits = double_bits(x.hi);
    int exponent = (int)((bits - START + (UINT64_C(1023) << 52)) >> 52) - 1023;
    const struct reciprocal *entry = &RECIPROCAL[(bits - START) >> 45 & 127];
    double z = bits_double(bits - ((uint64_t)(int64_t)exponent << 52));
    k += exponent;

    lom_pair product = two_product(z, entry->c);
    double low = x.lo == 0 ? 0 : scale(x.lo, -exponent) * entry->c;
    lom_pair sum = log1p_small(two_sum(product.hi - 1, product.lo + low));
    if (entry->c != 1)
        sum = pair_add((lom_pair){ entry->log_hi, entry->log_lo }, sum);
    if (k != 0) {
        lom_pair whole = two_product(k, LN2.hi);
        sum = pair_add(fast_two_sum(whole.hi, whole.lo + k * LN2.lo), sum);
    }
    return sum;
}

/* The results of log and log2 that need no logarithm: NaN, 0, negative, infinite. */
static bool log_special(double x, double *result)
{
    if (x > 0 && x < DOUBLE_INFINITY)
        return false;
    *result = x == 0 ? -DOUBLE_INFINITY : x > 0 ? DOUBLE_INFINITY : double_nan();
    return true;
}

double lom_double_log(double x)
{
    double special;
    if (log_special(x, &special))
        return special;
    lom_pair l = lom_log_parts((lom_pair){ x, 0 });
    return l.hi + l.lo;
}

double lom_double_log2(double x)
{
    double special;
    if (log_special(x, &special))
        return special;
    lom_pair l = pair_multiply(lom_log_parts((lom_pair){ x, 0 }), INV_LN2);
    return l.hi + l.lo;
}

double lom_double_log1p(double x)
{
    double special;
    if (magnitude(x) < 0x1p-54)
        return x; /* x^2/2 is below half an ulp */
    if (log_special(1 + x, &special))
        return special;
    lom_pair l = lom_log_parts(two_sum(1, x));
    return l.hi + l.lo;
}

/* 0: y is no integer, 1: odd, 2: even (as every double from 2^53 on, and infinity). */
static int integer_kind(double y)
{
    double a = magnitude(y);
    if (a >= 0x1p53)
        return 2;
    int64_t n = lom_int64_of(a);
    if ((double)n != a)
        return 0;
    return n & 1 ? 1 : 2;
}

/* C11 Annex F.10.4.4, in its order. */
static bool pow_special(double x, double y, double *result)
{
    double a = magnitude(x), b = magnitude(y);
    double signed_one = is_negative(x) && integer_kind(y) == 1 ? -1.0 : 1.0;
    if (y == 0 || x == 1)
        *result = 1;
    else if (x != x || y != y)
        *result = double_nan();
    else if (a == 0 || a == DOUBLE_INFINITY)
        *result = signed_one * ((a == 0) == (y < 0) ? DOUBLE_INFINITY : 0.0);
    else if (b == DOUBLE_INFINITY)
        *result = a == 1 ? 1 : (a > 1) == (y > 0) ? DOUBLE_INFINITY : 0.0;
    else if (x < 0 && integer_kind(y) == 0)
        *result = double_nan();
    else
        return false;
    return true;
}

double lom_double_pow(double x, double y)
{
    double special;
    if (pow_special(x, y, &special))
        return special;
    double signed_one = x < 0 && integer_kind(y) == 1 ? -1.0 : 1.0;
    lom_pair l = lom_log_parts((lom_pair){ magnitude(x), 0 });
    double estimate = y * l.hi; /* |l.hi| >= 2^-53 unless |x| = 1: what follows has |y| < 2^63 */
    if (estimate > 710)
        return signed_one * DOUBLE_INFINITY;
    if (estimate < -746)
        return signed_one * 0.0;
    if (magnitude(estimate) < 0x1p-60)
        return signed_one;
    lom_pair p = two_product(y, l.hi);
    int k;
    lom_pair m = lom_exp_parts(fast_two_sum(p.hi, p.lo + y * l.lo), &k);
    return signed_one * scale(m.hi + m.lo, k);
}
