/* What scatters along a ray that shaders of clouds share: the phase function. */
#ifndef LOM_CLOUD_PHASES_H
#define LOM_CLOUD_PHASES_H

#include "cloud/cloud_uniforms.h"
#include "cloud/phase.h"

/* Of light that is seen along a unit vector from the eye. */
LOM_INLINE void lom_set_cloud_phase(const struct lom_cloud_uniforms *cloud, lom_medium_rays *rays, lom_float3 direction)
{
    lom_float mu = lom_dot3(direction, lom_uniform3(cloud->to_light));
    rays->phase = lom_phase(cloud->phase, cloud->forward, cloud->backward, cloud->blend, mu);
    if (cloud->silver > 0)
        rays->phase = lom_max(rays->phase, cloud->silver * lom_phase_henyey_greenstein(mu, cloud->silver_cosine));
}

#endif
