/* A device's workers for what is no pass. */
#ifndef LOM_PIPELINE_SHARE_WORK_H
#define LOM_PIPELINE_SHARE_WORK_H

#include "base/threads.h"

#include <lom/pipeline.h>

/* Runs work(context, first, end) for ranges that make up 0 .. count - 1, `piece` at most in each, on the device's
 * workers, while none of its passes runs; one may be recorded. */
void lom_share_work(lom_device *device, size_t count, size_t piece, lom_range_work *work, void *context);

#endif
