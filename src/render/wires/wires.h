/* The edges of what the camera sees, as lines (quality.wireframe). */
#ifndef LOM_RENDER_WIRES_WIRES_H
#define LOM_RENDER_WIRES_WIRES_H

#include <stdbool.h>

struct frame;

/* Draws them over the scene, which has been drawn; nothing where the dial is off. */
bool lom_draw_wires(struct frame *f);

#endif
