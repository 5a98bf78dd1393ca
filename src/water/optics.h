/* Light at the surface of water and in it, over lanes, and the same in double (optics.c) that tests hold them to. In:
 * unit vectors and cosines; out: reflectance, the refracted ray, the light that is left.
 *
 * An incident ray d and a normal n: its cosine is c = -d.n. eta is the index of the side that the ray comes from over
 * that of the other side; from behind (c < 0) the normal is turned round and eta becomes 1/eta. */
#ifndef LOM_WATER_OPTICS_H
#define LOM_WATER_OPTICS_H

#include <lom/geometry.h>
#include <lom/lanes_mathematics.h>

/* The reference works' mix s p + (1 - s) o with s = e.n: what is left of 1 is reflected. */
LOM_INLINE lom_float lom_fresnel_dot(lom_float cosine)
{
    return 1.0f - lom_saturate(cosine);
}

/* Schlick 1994: r + (1 - r)(1 - c)^5 with r the reflectance at normal incidence. */
LOM_INLINE lom_float lom_fresnel_schlick(lom_float cosine, float eta)
{
    float root = (eta - 1.0f) / (eta + 1.0f), r = root * root;
    lom_float x = 1.0f - lom_saturate(cosine), square = x * x;
    return r + (1.0f - r) * (square * square * x);
}

/* Fresnel's equations for unpolarised light, c in [0, 1]: the mean of both polarisations' squares. 1 where all light is
 * reflected (Snell's law has no solution), at c = 0 unless eta is 1, and for an eta that is NaN. */
LOM_INLINE lom_float lom_fresnel_exact(lom_float cosine, lom_float eta)
{
    lom_float square = lom_refracted_square(cosine, eta);
    lom_mask passes = square > 0.0f;
    lom_float t = lom_sqrt(lom_select(passes, square, (lom_float){ 0 }));
    lom_float s = (eta * cosine - t) / (eta * cosine + t), p = (cosine - eta * t) / (cosine + eta * t);
    lom_float mean = 0.5f * (s * s + p * p);
    return lom_select(passes, lom_select(mean < 1.0f, mean, lom_splat(1.0f)), lom_splat(1.0f));
}

/* Beer and Lambert: e^(-a l) of each colour after l metres. */
LOM_INLINE lom_float3 lom_transmittance(const float absorption[3], lom_float length)
{
    return (lom_float3){ lom_fade(-absorption[0] * length), lom_fade(-absorption[1] * length),
                         lom_fade(-absorption[2] * length) };
}

/* ---- the same in double ---- */

double lom_fresnel_schlick_double(double cosine, double eta);
double lom_fresnel_exact_double(double cosine, double eta);
bool lom_refract_double(lom_vec3 d, lom_vec3 n, double eta, lom_vec3 *refracted);

#endif
