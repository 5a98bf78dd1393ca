/* The small triangles of a tile that are drawn together, a slot each: what coverage and fragments need of them, found
 * for LOM_LANES triangles at a time, looked up for LOM_LANES fragments at a time. */
#ifndef LOM_PIPELINE_SLOTS_H
#define LOM_PIPELINE_SLOTS_H

#include "pipeline/window.h"

/* Words of a slot, in groups of four. Edge functions 1 and 2 begin at the tile's first pixel; what is biased has the -1
 * of the top-left rule in it. */
enum {
    SLOT_STEP1, /* the edge functions' steps a pixel right (low) and down (high), over 256: a pair of 16 bits each */
    SLOT_STEP2,
    SLOT_START1, /* the edge functions themselves */
    SLOT_START2,
    SLOT_AREA, /* twice the area, and one over it */
    SLOT_INVERSE,
    SLOT_DEPTH0, /* depths as in the record, and the range of the three */
    SLOT_LOW,
    SLOT_DEPTH1,
    SLOT_DEPTH2,
    SLOT_HIGH,
    SLOT_STATE,
    SLOT_COVER1, /* biased: the edge functions at the first part's first pixel, and what they and the third one add up to */
    SLOT_COVER2,
    SLOT_COVER,
    SLOT_PARTS, /* 8 bits each: x, y, columns, rows */
    /* With several samples, where the words for coverage are of the tile's first pixel and biased by all that a sample of a
     * strip adds to its first centre: the edge functions at the tile's corner, without bias, the biases of the top-left
     * rule, twice the area with that of the third, and the range of depths as the attachment clamps it. */
    SLOT_CORNER1,
    SLOT_CORNER2,
    SLOT_BIAS1,
    SLOT_BIAS2,
    SLOT_WHOLE,
    SLOT_LEAST,
    SLOT_MOST
};

/* Pixels of the parts in which several samples are covered, a lane two pixels or, of wide lanes, a block of four. */
enum { STRIPS_WIDTH = LOM_LANES > 8 ? 8 : 4, STRIPS_HEIGHT = LOM_LANES > 8 ? 8 : LOM_LANES / 2 };

/* Wide lanes read a word of neighbouring slots at once and permute it; narrow ones read four words of each slot. */
enum { SLOTS_BY_WORD = LOM_LANES > 4 };

LOM_INLINE int slot_word(int word, int slot)
{
    return SLOTS_BY_WORD ? word * SLOT_PITCH + slot : slot * SLOT_WORDS + word;
}

/* Four words, from `word` on, of LOM_LANES slots. */
LOM_INLINE void store_slots(float *slots, int word, int first, lom_float4 x)
{
    float *to = slots + slot_word(word, first);
    if (!SLOTS_BY_WORD) {
        lom_scatter_rows(to, lom_lane_index() * SLOT_WORDS, x);
        return;
    }
    lom_store(to, x.x);
    lom_store(to + SLOT_PITCH, x.y);
    lom_store(to + 2 * SLOT_PITCH, x.z);
    lom_store(to + 3 * SLOT_PITCH, x.w);
}

/* Four words, from `word` on, of slot first + which[i] in lane i; which[i] < LOM_LANES. */
LOM_INLINE lom_float4 load_slots(const float *slots, int word, int first, lom_int which)
{
    const float *from = slots + slot_word(word, first);
    if (!SLOTS_BY_WORD)
        return lom_gather_rows(from, which * SLOT_WORDS);
    return (lom_float4){ lom_permute(lom_load(from), which), lom_permute(lom_load(from + SLOT_PITCH), which),
                         lom_permute(lom_load(from + 2 * SLOT_PITCH), which),
                         lom_permute(lom_load(from + 3 * SLOT_PITCH), which) };
}

/* LOM_LANES entries of the list. */
struct packed {
    lom_int code, which; /* which: of the slots from `first` on */
    int first, triangles;
    int count; /* lanes that are entries; the others repeat the last one */
};

/* Codes of the pixels that the tile's slots from `from` on cover, in order, after those that the list holds; stops where
 * the list is full, or before a slot whose pixels are tested at once while others wait for their test, and returns the
 * slot that is next. */
int LOM_WIDE(lom_cover_slots)(struct lom_tile *tile, int from);
/* Fills the slots of the list's triangles; and, for slots by word, what the fragment stage needs of them. */
void LOM_WIDE(lom_fill_slots)(struct lom_tile *tile);
void LOM_WIDE(lom_fill_values)(struct lom_tile *tile);
/* lom_shade_packet from the slots, of ENTRY_PACKETS at most, of one with draw->sampled or marks_edges; of them: places, l,
 * depth, triangles and covered. */
void LOM_WIDE(lom_shade_slots)(struct lom_tile *tile, const struct packed *p, const struct lom_packet *packet,
                               int count);

#endif
