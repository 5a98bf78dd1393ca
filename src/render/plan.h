/* The plan of a frame: a step for each pass that it runs or leaves out. */
#ifndef LOM_RENDER_PLAN_H
#define LOM_RENDER_PLAN_H

#include <lom/render.h>

struct frame;

/* Adds a step of a pass to the plan with its text, after the name of the water that is looked at where there are several; the caller sets the size of its target. A plan that is full keeps its last
 * step for all that follow. */
lom_step *lom_add_step(struct frame *f, const char *pass, bool runs, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* Tells whoever watches the frame what is drawn now, and the share that is done. Told to abandon it, the device draws
 * nothing more until the frame has ended. */
void lom_report_progress(struct frame *f, const char *pass);

#endif
