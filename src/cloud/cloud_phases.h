/* What scatters along a ray that shaders of clouds share: the phase function of every octave. */
#ifndef LOM_CLOUD_PHASES_H
#define LOM_CLOUD_PHASES_H

#include "cloud/cloud_uniforms.h"
#include "cloud/phase.h"

/* Of light that is seen along a unit vector from the eye. */
LOM_INLINE void lom_set_cloud_phases(const struct lom_cloud_uniforms *cloud, lom_medium_rays *rays,
                                     lom_float3 direction)
{
    lom_float mu = lom_dot3(direction, lom_uniform3(cloud->to_light));
    for (int k = 0; k < cloud->march.octaves; k++)
        rays->phase[k] = lom_phase_octave(cloud->phase, cloud->forward, cloud->backward, cloud->blend, mu, k);
    if (cloud->silver > 0)
        rays->phase[0] = lom_max(rays->phase[0], cloud->silver * lom_phase_henyey_greenstein(mu, cloud->silver_cosine));
}

#endif
