/* The stages of each variant that is built: 4, 8 and 16 lanes, on x86-64 the 8 and 16 lowered to the baseline
 * instructions, and the 4 that record. */
#include "pipeline/stages.h"
#include "pipeline/variants.h"

#define STAGES(name, variant)                                                                                          \
    [LOM_SLOT_##variant] = { .find_extremes = lom_find_extremes_##variant,                                             \
                             .rebase_indices = lom_rebase_indices_##variant,                                           \
                             .shade_vertices = lom_shade_vertices_##variant,                                           \
                             .control_patches = lom_control_patches_##variant,                                         \
                             .evaluate_patch = lom_evaluate_patch_##variant,                                           \
                             .emit_pieces = lom_emit_pieces_##variant,                                                 \
                             .set_up = lom_set_up_##variant,                                                           \
                             .raster = lom_raster_##variant,                                                           \
                             .flush = lom_flush_##variant,                                                             \
                             .find_paint = lom_find_paint_##variant,                                                   \
                             .store_rectangle = lom_store_rectangle_##variant,                                         \
                             .fill_rectangle = lom_fill_rectangle_##variant,                                           \
                             .store_texels = lom_store_texels_##variant,                                               \
                             .fill_texels = lom_fill_texels_##variant,                                                 \
                             .load_texels = lom_load_texels_##variant,                                                 \
                             .fill_words = lom_fill_words_##variant,                                                   \
                             .join_rows = lom_join_rows_##variant,                                                     \
                             .find_means = lom_find_means_##variant,                                                   \
                             .take_first = lom_take_first_##variant },

static const struct lom_stages stages[LOM_VARIANTS] = { LOM_EACH_VARIANT(STAGES, )
#ifdef LOM_HAS_RECORDED
                                                            STAGES(, 4_recorded)
#endif
};

const struct lom_stages *lom_stages_of(int variant)
{
    return variant >= 0 && variant < LOM_VARIANTS && stages[variant].raster != NULL ? &stages[variant] : NULL;
}
