/* Wave spectra. In: a resolved description of a sea; out: variances per wavenumber and direction, in double. Invariant:
 * every function is finite and 0 where there are no waves (k = 0, no wind, no depth), and spectrum times spreading
 * integrates over the k plane to the variance of the heights.
 *
 * S(w) = a g^2 w^-5 exp(-5/4 (wp/w)^4) G^r, r = exp(-(w - wp)^2 / (2 s^2 wp^2)), s = 0.07 up to wp and 0.09 above.
 * JONSWAP (Hasselmann et al.: Measurements of wind-wave growth and swell decay, 1973): a = 0.076 (U^2/(F g))^0.22,
 * wp = 22 (g^2/(U F))^(1/3). Pierson and Moskowitz (1964): a = 0.0081, G = 1, wp = 0.855 g/U (their 0.877 g/U at 19.5 m
 * with the wind at 10 m), which no fetch takes wp below. Finite depth: S times tanh^2(k d)/(1 + 2 k d/sinh(2 k d))
 * (Kitaigorodskii et al. 1975; TMA: Bouws et al. 1985). From w to k: S(k) = S(w) dw/dk. Spreading: see C. Horvath:
 * Empirical directional wave spectra for computer graphics (2015), who compares them. */
#include "base/numbers.h"
#include "base/double_parts.h"

#include <lom/sea.h>

double lom_dispersion(double wavenumber, double depth, double gravity)
{
    if (!(wavenumber > 0) || !(depth > 0))
        return 0;
    return lom_double_sqrt(gravity * wavenumber * lom_double_tanh(wavenumber * depth));
}

/* dw/dk = (g/2w) (tanh kd + kd (1 - tanh^2 kd)) */
double lom_group_speed(double wavenumber, double depth, double gravity)
{
    double w = lom_dispersion(wavenumber, depth, gravity);
    if (!(w > 0))
        return 0;
    double kd = wavenumber * depth, t = lom_double_tanh(kd);
    double rest = kd < 300 ? kd * (1 - t * t) : 0;
    return gravity / (2 * w) * (t + rest);
}

lom_wave_spectrum lom_sea_spectrum(const lom_sea_desc *sea)
{
    lom_wave_spectrum s = { .kind = sea->spectrum,
                            .spreading = sea->spreading,
                            .wind = { lom_double_cos(sea->wind_direction), lom_double_sin(sea->wind_direction) },
                            .speed = sea->calm ? 0 : sea->wind_speed,
                            .level = 0.0081,
                            .enhancement = 1,
                            .exponent = sea->spreading_exponent,
                            .depth = sea->depth > 0 ? sea->depth : DOUBLE_INFINITY,
                            .gravity = sea->gravity,
                            .scale = sea->height_scale * sea->height_scale,
                            .damping = sea->shortest_wave / (2 * lom_pi) };
    if (!(s.speed > 0))
        return s;
    double g = s.gravity, u = s.speed, developed = 0.855 * g / u;
    if (s.kind == LOM_SPECTRUM_JONSWAP) {
        s.enhancement = sea->peak_enhancement;
        s.level = 0.076 * lom_double_pow(u * u / (sea->fetch * g), 0.22);
        s.peak = 22 * lom_double_cbrt(g * g / (u * sea->fetch));
        if (s.peak < developed) {
            s.peak = developed;
            s.level = 0.0081;
        }
    } else {
        s.peak = s.kind == LOM_SPECTRUM_PHILLIPS ? g / u : developed;
    }
    return s;
}

/* With x = (wp/w)^2: x > 25 gives exp(-781), a zero. */
static double frequency_spectrum(const lom_wave_spectrum *s, double w)
{
    double ratio = s->peak / w, x = ratio * ratio;
    if (!(x < 25))
        return 0;
    double width = w <= s->peak ? 0.07 : 0.09, off = (w - s->peak) / (width * s->peak);
    double boost = s->enhancement == 1 ? 1 : lom_double_pow(s->enhancement, lom_double_exp(-0.5 * off * off));
    double w2 = w * w;
    return s->level * (s->gravity * s->gravity) / (w2 * w2 * w) * lom_double_exp(-1.25 * x * x) * boost;
}

/* 2 y/sinh(2 y) is 1 at 0 and 0 long before sinh overflows. */
static double depth_factor(double kd)
{
    double t = lom_double_tanh(kd);
    double rest = kd > 300 ? 0 : kd < 1e-8 ? 1 : 2 * kd / lom_double_sinh(2 * kd);
    return t * t / (1 + rest);
}

double lom_spectrum_at(const lom_wave_spectrum *s, double k)
{
    if (!(k > 0) || !(k < DOUBLE_INFINITY) || !(s->speed > 0) || !(s->depth > 0))
        return 0;
    double value = 0;
    if (s->kind == LOM_SPECTRUM_PHILLIPS) {
        double kl = k * s->speed * s->speed / s->gravity;
        if (kl > 0.03) /* below, exp(-1/(kl)^2) is 0 */
            value = s->level / 2 * lom_double_exp(-1 / (kl * kl)) / (k * k * k);
    } else {
        value =
            frequency_spectrum(s, lom_dispersion(k, s->depth, s->gravity)) * lom_group_speed(k, s->depth, s->gravity);
        if (s->depth < DOUBLE_INFINITY)
            value = value * depth_factor(k * s->depth);
    }
    double damped = k * s->damping;
    if (damped > 0)
        value = value * lom_double_exp(-damped * damped);
    return value * s->scale;
}

/* log Gamma for x >= 1/2: Stirling's series (Abramowitz, Stegun 6.1.41) at x + 8, the rest below 1e-12. */
static double log_gamma(double x)
{
    double product = 1;
    for (int i = 0; i < 8; i++)
        product *= x + i;
    double y = x + 8, z = 1 / (y * y);
    double series = (1.0 / 12 - z * (1.0 / 360 - z * (1.0 / 1260 - z / 1680))) / y;
    return (y - 0.5) * lom_double_log(y) - y + 0.9189385332046727 + series - lom_double_log(product);
}

/* cos^2s(angle/2) Gamma(s + 1)/(2 sqrt(pi) Gamma(s + 1/2)) */
static double cosine_2s(double exponent, double angle)
{
    double norm = lom_double_exp(log_gamma(exponent + 1) - log_gamma(exponent + 0.5)) / (2 * 1.772453850905516);
    double c = lom_double_cos(angle / 2);
    return norm * lom_double_pow(c * c, exponent);
}

/* Mitsuyasu et al. 1975: s = 11.5 (wp U/g)^-2.5 (w/wp)^5 below the peak, ^-2.5 above. */
static double mitsuyasu_exponent(double age, double ratio)
{
    double s = 11.5 * lom_double_pow(age, -2.5) * lom_double_pow(ratio, ratio <= 1 ? 5 : -2.5);
    return s < 100 ? s : 100;
}

/* Hasselmann, Dunckel, Ewing 1980: s = 6.97 (w/wp)^4.06 below the peak, 9.77 (w/wp)^(-2.33 - 1.45 (wp U/g - 1.17)). */
static double hasselmann_exponent(double age, double ratio)
{
    if (ratio <= 1)
        return 6.97 * lom_double_pow(ratio, 4.06);
    return 9.77 * lom_double_pow(ratio, -2.33 - 1.45 * (age - 1.17));
}

/* b/(2 tanh(b pi)) / cosh^2(b angle); b of Donelan, Hamilton, Hui (1985), above 1.6 wp of Banner (1990), below 0.56 wp
 * the value there. */
static double hyperbolic(double ratio, double angle)
{
    double bounded = ratio < 0.56 ? 0.56 : ratio, b;
    if (bounded < 0.95)
        b = 2.61 * lom_double_pow(bounded, 1.3);
    else if (bounded < 1.6)
        b = 2.28 * lom_double_pow(bounded, -1.3);
    else
        b = lom_double_pow(10, -0.4 + 0.8393 * lom_double_exp(-0.567 * 2 * lom_double_log(bounded)));
    double c = lom_double_cosh(b * angle);
    return b / (2 * lom_double_tanh(b * lom_pi)) / (c * c);
}

double lom_spreading_at(const lom_wave_spectrum *s, double k, double angle)
{
    if (!(k > 0) || !(s->speed > 0) || !(s->depth > 0))
        return 0;
    if (s->spreading == LOM_SPREADING_COSINE_SQUARED) {
        double c = lom_double_cos(angle);
        return c * c / lom_pi;
    }
    double ratio = lom_dispersion(k, s->depth, s->gravity) / s->peak, age = s->peak * s->speed / s->gravity;
    if (s->spreading == LOM_SPREADING_DONELAN_BANNER)
        return hyperbolic(ratio, angle);
    if (s->spreading == LOM_SPREADING_HASSELMANN)
        return cosine_2s(hasselmann_exponent(age, ratio), angle);
    return cosine_2s(s->exponent > 0 ? s->exponent : mitsuyasu_exponent(age, ratio), angle);
}

double lom_directional_spectrum(const lom_wave_spectrum *s, double kx, double kz)
{
    double k = lom_double_sqrt(kx * kx + kz * kz);
    double radial = lom_spectrum_at(s, k);
    if (!(radial > 0))
        return 0;
    double along = kx * s->wind[0] + kz * s->wind[1], across = kz * s->wind[0] - kx * s->wind[1];
    return radial * lom_spreading_at(s, k, lom_double_atan2(across, along)) / k;
}
