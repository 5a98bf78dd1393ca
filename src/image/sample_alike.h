/* Three textures at one place and level of detail: bit for bit lom_sample of each. Those that are made of descriptors that
 * differ in their pixels alone share all that is found before texels are read (sample_rows.h). */
#ifndef LOM_IMAGE_SAMPLE_ALIKE_H
#define LOM_IMAGE_SAMPLE_ALIKE_H

#include <lom/texture.h>

void LOM_WIDE(lom_sample_three_lanes)(const lom_texture *const texture[3], const lom_float2 *at, const lom_float *lod,
                                      lom_float4 out[3]);

#endif
