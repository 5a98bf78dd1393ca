/* Passes of several samples a pixel: places, and the memory of their tiles (samples.c). */
#ifndef LOM_PIPELINE_SAMPLES_H
#define LOM_PIPELINE_SAMPLES_H

#include "pipeline/stages.h"

/* The positions of 1, 2, 4, 8 or 16 samples; NULL for other numbers. */
const struct lom_sample_offset *lom_sample_offsets(int samples);
/* Room in the pass's textures that keep samples, for a grid as the pass's; the bytes that its tiles need besides. */
bool lom_lay_samples(lom_device *device, struct lom_pass *pass);
/* Bytes of the largest image of an attachment: of a worker's scratch. */
size_t lom_scratch_bytes(const struct lom_pass *pass);
/* Where the tile's images are; its first samples; and, when the pass ends, its texels, from the samples if it was `touched`. */
void lom_place_samples(struct lom_pass *pass, struct lom_tile *tile, uint8_t *memory);
void lom_begin_samples(struct lom_pass *pass, struct lom_tile *tile);
void lom_end_samples(struct lom_pass *pass, struct lom_tile *tile, bool touched);
/* The texels of a texture are new: all its samples are they. Likewise of the attachments that a pass writes in which it has
 * another number of samples than they keep. */
void lom_forget_samples(lom_texture *texture);
void lom_forget_other_samples(const struct lom_pass *pass);

#endif
