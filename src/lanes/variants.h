/* The ways lanes are built, and which of them this processor runs. Tables of functions that exist once a variant are
 * indexed by LOM_SLOT_*. */
#ifndef LOM_LANES_VARIANTS_H
#define LOM_LANES_VARIANTS_H

#include <lom/lanes.h>

struct lom_variant {
    int lanes;
    bool plain; /* instructions of the baseline only */
};
extern const struct lom_variant lom_variants[LOM_VARIANTS];

/* Whether it is built and this processor has its instructions. */
bool lom_runs_variant(int variant);
/* The variant of this many lanes that runs here, native before lowered; plain: lowered alone. -1: none. */
int lom_find_variant(int lanes, bool plain);
/* The one of the widest native vectors of this processor; plain: that of 4 lanes. */
int lom_widest_variant(bool plain);

#endif
