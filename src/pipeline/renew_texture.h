/* Textures whose pixels change from frame to frame. */
#ifndef LOM_PIPELINE_RENEW_TEXTURE_H
#define LOM_PIPELINE_RENEW_TEXTURE_H

#include <lom/pipeline.h>

/* Makes *texture from desc (without supplied levels) the first time, when it is NULL; from then on gives it the pixels
 * of desc, which has the same sizes and format. False on failure, with an error on the device. */
bool lom_renew_texture(lom_device *device, lom_texture **texture, const lom_texture_desc *desc);

#endif
