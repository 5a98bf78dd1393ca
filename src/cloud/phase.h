/* Phase functions over lanes, times 4 pi: 1 on average over the sphere. mu is the cosine between the way the light
 * travels and the way to the eye: 1 looks into the sun. */
#ifndef LOM_CLOUD_PHASE_H
#define LOM_CLOUD_PHASE_H

#include <lom/cloud.h>

/* (1 - g^2) / (1 + g^2 - 2 g mu)^(3/2) (Henyey and Greenstein 1941), |g| < 1. */
LOM_INLINE lom_float lom_phase_henyey_greenstein(lom_float mu, float g)
{
    lom_float base = lom_max((1.0f + g * g) - 2.0f * g * mu, lom_splat(1e-6f));
    return (1.0f - g * g) / (base * lom_sqrt(base));
}

/* 3/4 (1 + mu^2) */
LOM_INLINE lom_float lom_phase_rayleigh(lom_float mu)
{
    return 0.75f * (1.0f + mu * mu);
}

/* The function of [clouds]. */
LOM_INLINE lom_float lom_phase(int phase, float forward, float backward, float blend, lom_float mu)
{
    switch (phase) {
    case LOM_PHASE_DUAL:
        return lom_mix(lom_phase_henyey_greenstein(mu, forward), lom_phase_henyey_greenstein(mu, backward),
                       lom_splat(blend));
    case LOM_PHASE_HENYEY_GREENSTEIN:
        return lom_phase_henyey_greenstein(mu, forward);
    case LOM_PHASE_RAYLEIGH:
        return lom_phase_rayleigh(mu);
    default:
        return lom_splat(1.0f);
    }
}

#endif
