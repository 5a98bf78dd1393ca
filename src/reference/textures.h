/* Pictures as the reference samples them: bilinear at the finest level, in double. */
#ifndef LOM_REFERENCE_TEXTURES_H
#define LOM_REFERENCE_TEXTURES_H

#include "reference/vectors.h"

/* A picture, or the six of a cube (+x, -x, +y, -y, +z, -z) as the slices of one. */
struct lom_picture {
    const lom_image *image; /* RGBA8 or RGBA16; outlives the picture */
    double decoded[256];    /* what the codes of RGBA8 mean */
};

/* srgb: 8-bit samples are sRGB-encoded; deeper ones are taken as they are, as the renderer does. */
void lom_set_picture(struct lom_picture *picture, const lom_image *image, bool srgb);

/* Repeated in both directions; texel (i, j) has its centre at ((i + 0.5) / width, (j + 0.5) / height). */
lom_vec3 lom_sample_picture(const struct lom_picture *picture, double s, double t);
/* The same of its alpha. */
double lom_sample_picture_alpha(const struct lom_picture *picture, double s, double t);
/* The mean of red, green and blue over all texels, by their weights in luminance (ITU-R BT.709). */
double lom_mean_brightness(const struct lom_picture *picture);
/* A cube in a direction: OpenGL 4.6, table 8.19, and filtered across edges. Beyond a corner of three faces lies the
 * mean of its three texels. */
lom_vec3 lom_sample_cube_picture(const struct lom_picture *cube, lom_vec3 direction);

#endif
