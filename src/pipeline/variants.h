/* The stages as functions of each variant: what whoever runs them calls, and the wide files define. */
#ifndef LOM_PIPELINE_VARIANTS_H
#define LOM_PIPELINE_VARIANTS_H

#include "pipeline/stages.h"

/* The stages of one variant. */
struct lom_stages {
    /* The smallest and the largest of `count` >= 1 indices. */
    void (*find_extremes)(const uint32_t *index, size_t count, uint32_t *low, uint32_t *high);
    /* Writes index - base for each of them. */
    void (*rebase_indices)(const uint32_t *index, size_t count, uint32_t base, uint32_t *rebased);
    /* Shades the chunk's vertices, or takes them from its made_rows, and projects them unless kept_rows is where they go:
     * rows, clip positions and outcodes of vertex_count vertices. */
    void (*shade_vertices)(const struct lom_pass *pass, struct lom_chunk *chunk);
    /* Levels of a packet of patches from the first one on; the rows of a patch's pattern; what a packet of pieces emits,
     * and how many vertices each (expand.wide.c). */
    void (*control_patches)(const struct lom_chunk *chunk, size_t first, float (*levels)[LEVEL_WORDS]);
    void (*evaluate_patch)(const struct lom_chunk *chunk, size_t patch, const float levels[LEVEL_WORDS], float *rows);
    void (*emit_pieces)(const struct lom_chunk *chunk, int from, size_t first, int32_t *count);
    /* Sets up `count` triangles of unclipped vertices, in order; appends the visible ones. Corners less `base` are three
     * row numbers a triangle; the third is the provoking vertex. */
    void (*set_up)(const struct lom_pass *pass, struct lom_chunk *chunk, const uint32_t *corners, uint32_t base,
                   size_t count);
    /* Draws the chunk's triangles of one tile. */
    void (*raster)(struct lom_tile *tile, const struct lom_chunk *chunk, const uint32_t *list, size_t count);
    /* Shades what is left in the queue. */
    void (*flush)(struct lom_tile *tile);
    /* The paint of a constant draw. */
    void (*find_paint)(const struct lom_pass *pass, struct lom_draw *draw, const void *uniforms);
    /* A rectangle of a plane of tile memory, or one value, to an attachment. */
    void (*store_rectangle)(const struct lom_rectangle *rectangle, const uint32_t *memory);
    void (*fill_rectangle)(const struct lom_rectangle *rectangle, uint32_t value);
    /* A rectangle of four planes of floats, or one value, to an attachment of four floats a texel, whose format has so many
     * channels; and the reverse. */
    void (*store_texels)(const struct lom_rectangle *rectangle, int channels, const float *planes);
    void (*fill_texels)(const struct lom_rectangle *rectangle, const float texel[4]);
    void (*load_texels)(const struct lom_rectangle *rectangle, float *planes);
    /* `count` words of tile memory, a multiple of 16. */
    void (*fill_words)(uint32_t *to, uint32_t value, size_t count);
    /* Two rows of pixels as blocks of tile memory. */
    void (*join_rows)(const uint32_t *upper, const uint32_t *lower, size_t blocks, uint32_t *to);
    /* The means of the samples of colour attachment i of a tile, into its image, where flags are set. */
    void (*find_means)(const struct lom_pass *pass, const struct lom_tile *tile, int i);
    /* The first of each `pitch` words, `count` of them, a multiple of 16. */
    void (*take_first)(const uint32_t *from, int pitch, size_t count, uint32_t *to);
};

/* NULL where the variant is not built. */
const struct lom_stages *lom_stages_of(int variant);

#define LOM_DECLARE_STAGES(name, variant)                                                                              \
    void lom_find_extremes_##variant(const uint32_t *index, size_t count, uint32_t *low, uint32_t *high);              \
    void lom_rebase_indices_##variant(const uint32_t *index, size_t count, uint32_t base, uint32_t *rebased);          \
    void lom_shade_vertices_##variant(const struct lom_pass *pass, struct lom_chunk *chunk);                           \
    void lom_control_patches_##variant(const struct lom_chunk *chunk, size_t first, float(*levels)[LEVEL_WORDS]);      \
    void lom_evaluate_patch_##variant(const struct lom_chunk *chunk, size_t patch, const float levels[LEVEL_WORDS],    \
                                      float *rows);                                                                    \
    void lom_emit_pieces_##variant(const struct lom_chunk *chunk, int from, size_t first, int32_t *count);             \
    void lom_set_up_##variant(const struct lom_pass *pass, struct lom_chunk *chunk, const uint32_t *corners,           \
                              uint32_t base, size_t count);                                                            \
    void lom_raster_##variant(struct lom_tile *tile, const struct lom_chunk *chunk, const uint32_t *list,              \
                              size_t count);                                                                           \
    void lom_flush_##variant(struct lom_tile *tile);                                                                   \
    void lom_find_paint_##variant(const struct lom_pass *pass, struct lom_draw *draw, const void *uniforms);           \
    void lom_store_rectangle_##variant(const struct lom_rectangle *rectangle, const uint32_t *memory);                 \
    void lom_fill_rectangle_##variant(const struct lom_rectangle *rectangle, uint32_t value);                          \
    void lom_store_texels_##variant(const struct lom_rectangle *rectangle, int channels, const float *planes);         \
    void lom_fill_texels_##variant(const struct lom_rectangle *rectangle, const float texel[4]);                       \
    void lom_load_texels_##variant(const struct lom_rectangle *rectangle, float *planes);                              \
    void lom_fill_words_##variant(uint32_t *to, uint32_t value, size_t count);                                         \
    void lom_join_rows_##variant(const uint32_t *upper, const uint32_t *lower, size_t blocks, uint32_t *to);           \
    void lom_find_means_##variant(const struct lom_pass *pass, const struct lom_tile *tile, int i);                    \
    void lom_take_first_##variant(const uint32_t *from, int pitch, size_t count, uint32_t *to);
LOM_EACH_VARIANT(LOM_DECLARE_STAGES, )
LOM_DECLARE_STAGES(, 4_recorded)

#endif
