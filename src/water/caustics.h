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

/* The light on each of size x size texels, in parts of still water's. */
struct lom_gathered_light {
    int size;
    float *texel;
    uint64_t *sum; /* while it is gathered */
};

/* False without memory; freed with lom_free_gathered_light either way. */
bool lom_make_gathered_light(struct lom_gathered_light *light, int size, lom_error *error);
void lom_free_gathered_light(struct lom_gathered_light *light);
/* Each photon (of a texture of RGBA32F with light->size texels along an edge) spread over 3 x 3 texels by the quadratic
 * B-spline, in units of 2^-16: what of that comes to the rows first .. end - 1, and nothing of other rows. */
void lom_gather_photons(struct lom_gathered_light *light, const lom_texture *photons, int first, int end);

#endif
