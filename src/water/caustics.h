/* Caustics: the sunlight that a surface of waves focuses on the bed. A square of water is cut into cells; the light of
 * each is bent by Snell's law at the surface and followed to the bed, where it lands in a texture over x and z. What
 * lands is added up in integers, so that no order matters. */
#ifndef LOM_WATER_CAUSTICS_H
#define LOM_WATER_CAUSTICS_H

#include "water/surface.h"

struct lom_photon_uniforms {
    struct lom_waves_uniform waves;
    float corner[2], cell; /* x and z of the square's corner less the eye, metres a texel */
    float to_light[3], eta;
    const lom_texture *bed;                      /* heights over bed_base and the terrain's rectangle */
    float bed_corner[2], bed_scale[2], bed_base; /* less the eye */
};

/* A texel for each cell: where its light lands, in texels from the corner, and how much it carries, in parts of what a
 * cell of still water does. */
extern const lom_shader lom_photon_shader;

/* The light on each of size x size texels, in parts of still water's: each photon spread over 3 x 3 texels by the
 * quadratic B-spline, in units of 2^-16. NULL on failure. R32F; freed with lom_free_image. */
lom_image *lom_gather_photons(const lom_image *photons, lom_error *error);

#endif
