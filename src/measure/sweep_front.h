/* Which trials of a sweep are worth having, and which of them to combine. */
#ifndef LOM_MEASURE_SWEEP_FRONT_H
#define LOM_MEASURE_SWEEP_FRONT_H

#include "measure/sweep.h"

/* Of each reference: what no other trial beats in both, and what beats the default. */
void lom_mark_front(lom_sweep *sweep);

/* The settings of the best few dials, of which every combination is tried. */
enum { LOM_MIXED_DIALS = 4, LOM_MIXED_SETTINGS = 3 };
struct lom_mixture {
    int dials;
    struct lom_mixed_dial {
        int settings;
        lom_choice setting[LOM_MIXED_SETTINGS];
    } dial[LOM_MIXED_DIALS];
    size_t count; /* of combinations, the default and single dials among them */
};
/* At most `most` dials (up to LOM_MIXED_DIALS) whose settings, each alone, are on the front of single dials. */
struct lom_mixture lom_choose_mixture(const lom_sweep *sweep, int most);
/* Combination i; false behind the last. */
bool lom_mixed_choices(const struct lom_mixture *mixture, size_t i, lom_choices *choices);

#endif
