/* The stages of each variant: 4, 8 and 16 lanes, and on x86-64 the 8 and 16 lowered to the baseline instructions. */
#include "pipeline/stages.h"

#define STAGES(variant)                                                                                                \
    {                                                                                                                  \
        lom_find_extremes_##variant, lom_rebase_indices_##variant, lom_shade_vertices_##variant, lom_set_up_##variant, \
            lom_raster_##variant, lom_flush_##variant, lom_split_rows_##variant, lom_join_rows_##variant,              \
            lom_divide_row_##variant                                                                                   \
    }

static const struct lom_stages stages[] = {
    STAGES(4),       STAGES(8),        STAGES(16),
#if defined __x86_64__
    STAGES(8_plain), STAGES(16_plain),
#endif
};

const struct lom_stages *lom_stages_of(int variant)
{
    return variant >= 0 && variant < (int)(sizeof stages / sizeof stages[0]) ? &stages[variant] : NULL;
}
