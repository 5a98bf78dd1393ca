/* The plan of a frame, made while it is drawn. In: which passes run or are left out, and why. Out: the steps, each told to
 * whoever watches the frame when it begins. */
#include "pipeline/check_device.h"
#include "render/frame.h"

#include <stdarg.h>
#include <stdio.h>

void lom_report_progress(struct frame *f, const char *pass)
{
    if (f->desc->progress != NULL && !f->abandoned && !f->desc->progress(f->desc->progress_context, pass, f->done)) {
        f->abandoned = true;
        lom_abandon_passes(f->renderer->device);
    }
}

lom_step *lom_add_step(struct frame *f, const char *pass, bool runs, const char *format, ...)
{
    lom_plan *plan = f->plan;
    int last = plan->count < LOM_MAX_STEPS ? plan->count : LOM_MAX_STEPS - 1;
    lom_step *step = &plan->step[last];
    va_list arguments;
    plan->count = last + 1;
    *step = (lom_step){ .runs = runs, .view = f->shown != NULL ? 1 + (int)(f->shown - f->scene->views) : 0 };
    snprintf(step->name, sizeof step->name, "%s", pass);
    const char *name = f->scene->water.name;
    size_t length = 0;
    if (f->names_water && name != NULL)
        length = (size_t)snprintf(step->text, sizeof step->text, "%.60s: ", name);
    else if (f->names_water)
        length = (size_t)snprintf(step->text, sizeof step->text, "water %zu: ", f->turned);
    va_start(arguments, format);
    vsnprintf(step->text + length, sizeof step->text - length, format, arguments);
    va_end(arguments);
    if (runs)
        lom_report_progress(f, pass);
    return step;
}
