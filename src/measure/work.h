/* Declared work: what the counters of a frame weigh, the same on every machine. */
#ifndef LOM_MEASURE_WORK_H
#define LOM_MEASURE_WORK_H

#include <lom/render.h>

/* One counter: its name, what one of it weighs in cycles, how many of it a frame has. */
typedef struct lom_work_item {
    const char *name;
    double cycles;
    double (*count)(const lom_frame *frame);
} lom_work_item;

/* The counters that weigh something, from 0 on; NULL behind the last. */
const lom_work_item *lom_describe_work(size_t index);

/* Cycles of a frame by its counters: the sum of count times weight. A model, not a measurement: frames of one scene compare
 * well, those of two scenes within a factor of a few, since fragments of unlike shaders count alike. Deterministic: the
 * counters depend on the scene and the frame alone. */
double lom_declared_work(const lom_frame *frame);

#endif
