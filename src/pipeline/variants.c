/* The stages of each variant that is built: 4, 8 and 16 lanes, on x86-64 the 8 and 16 lowered to the baseline
 * instructions, and the 4 that record. */
#include "pipeline/stages.h"
#include "pipeline/variants.h"

#define STAGES(name, variant)                                                                                          \
    [LOM_SLOT_##variant] = { lom_find_extremes_##variant, lom_rebase_indices_##variant,  lom_shade_vertices_##variant, \
                             lom_set_up_##variant,        lom_raster_##variant,          lom_flush_##variant,          \
                             lom_find_paint_##variant,    lom_store_rectangle_##variant, lom_fill_rectangle_##variant, \
                             lom_fill_words_##variant,    lom_join_rows_##variant,       lom_find_means_##variant },

static const struct lom_stages stages[LOM_VARIANTS] = { LOM_EACH_VARIANT(STAGES, ) STAGES(, 4_recorded) };

const struct lom_stages *lom_stages_of(int variant)
{
    return variant >= 0 && variant < LOM_VARIANTS && stages[variant].raster != NULL ? &stages[variant] : NULL;
}
