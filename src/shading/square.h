/* A square over what is drawn, and the blending of light that is multiplied by its alpha. */
#ifndef LOM_SHADING_SQUARE_H
#define LOM_SHADING_SQUARE_H

#include <lom/pipeline.h>

/* Light over what is there already, its colour multiplied by its alpha. */
extern const lom_blend lom_blend_over;
/* Draws the four vertices that a shader makes of their numbers, as a strip without a depth test. */
void lom_draw_square(lom_device *device, const lom_shader *shader, const void *uniforms, const lom_blend *blend);

#endif
