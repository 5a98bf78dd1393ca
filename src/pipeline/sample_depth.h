/* Depths of a tile whose pixels have several samples: those of a pixel lie side by side, in rows of four (with two samples,
 * the other half of the row is not used). */
#ifndef LOM_PIPELINE_SAMPLE_DEPTH_H
#define LOM_PIPELINE_SAMPLE_DEPTH_H

#include "pipeline/packet.h"

/* Early depth test of LOM_LANES different pixels: leaves of covered[s] the lanes that pass at sample s. Of draws that are
 * tested after their shader nothing is written. */
LOM_INLINE void lom_test_sample_depths(struct lom_tile *tile, lom_int pixel, lom_mask *covered, const lom_float *depth)
{
    const struct lom_draw *draw = tile->draw;
    const int pitch = tile->pass->sample_pitch, samples = tile->pass->samples;
    for (int first = 0; first < samples; first += 4) {
        lom_int at = pixel * pitch + first;
        lom_float4 rows = lom_gather_rows(tile->depth, at);
        lom_float stored[4] = { rows.x, rows.y, rows.z, rows.w };
        lom_mask any = { 0 };
        for (int k = 0; k < 4 && first + k < samples; k++) {
            lom_float units = lom_depth_units(tile->pass, depth[first + k]);
            lom_mask passed = covered[first + k] & lom_compare_depth(draw->compare, units, stored[k]);
            stored[k] = lom_select(passed, units, stored[k]);
            covered[first + k] = passed;
            any |= passed;
        }
        if (draw->depth_write && !draw->late_depth && lom_any(any))
            lom_scatter_rows(tile->depth, at, (lom_float4){ stored[0], stored[1], stored[2], stored[3] });
    }
}

#endif
