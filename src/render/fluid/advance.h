/* A liquid of a frame. */
#ifndef LOM_RENDER_FLUID_ADVANCE_H
#define LOM_RENDER_FLUID_ADVANCE_H

#include "render/frame.h"

/* Runs the scene's liquid of this number to the frame's time and makes its surface. */
bool lom_advance_fluid(struct frame *f, size_t number, lom_error *error);

#endif
