/* Drawing a frame again as if it were the first. */
#ifndef LOM_INSPECT_FORGET_H
#define LOM_INSPECT_FORGET_H

#include <lom/render.h>

/* Forgets what a frame keeps of the ones before: shadow maps, the plates of a run. */
void lom_forget_frames(lom_renderer *renderer);

#endif
