/* What the tuner weighs settings by: what a frame did, by fixed weights, about a nanosecond of one processor each.
 * The same number on every machine that draws with the same threads and lanes (docs/trade.md). Finer than the work
 * of `lom cost` (measure/work.h), which knows nothing of the steps, lookups and samples that dials change, and needs
 * one frame more. */
#ifndef LOM_MEASURE_DIAL_WORK_H
#define LOM_MEASURE_DIAL_WORK_H

#include "measure/trial.h"

/* What a frame did. */
typedef struct lom_dial_work {
    lom_counters counters;
    uint64_t lookups, steps; /* of textures and of rays through clouds, in all fragments, as in those of the picture */
    uint64_t pixels;         /* of the frame, in each pass */
    uint64_t samples;        /* beyond the first of each pixel */
    uint64_t transformed;    /* N^2 log2 N of each Fourier transform of a square of N */
    uint64_t work;           /* all of them by their weights */
} lom_dial_work;

/* The work of the frame after the subject's, which the drawer draws now. False on failure. */
bool lom_measure_dial_work(const lom_drawer *drawer, const lom_subject *subject, lom_dial_work *work, lom_error *error);

/* A kind of work, for docs and tables: its name, what one of it weighs in tenths; NULL behind the last. */
const char *lom_dial_work_kind(size_t i, uint64_t *weight);
/* How many of that kind there are in work. */
uint64_t lom_dial_work_count(const lom_dial_work *work, size_t i);

#endif
