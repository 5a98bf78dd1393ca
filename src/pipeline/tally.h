/* Tallies: what passes do at each texel of one target, counted by the hooks that record watched pixels (record.h). A pass
 * with the target as an attachment has pass->tallier and is drawn in the variant 4_recorded; with `clock` it is drawn as
 * ever, and the time of each tile is taken.
 *
 * Invariant: a texel's tally is touched by the worker that owns its tile, and by the caller between passes. */
#ifndef LOM_PIPELINE_TALLY_H
#define LOM_PIPELINE_TALLY_H

#include "lanes/notes.h"
#include "pipeline/device.h"

#include <lom/record.h>

struct lom_packet;
struct lom_places;

/* What a worker has at hand: the lanes that clip distances left, then the four fragments that it shades, and what was
 * noted of them. */
struct tally_worker {
    struct lom_notes notes;
    const struct lom_packet *packet; /* NULL: they are of a sprite */
    int32_t pixel[4];                /* places in tile memory */
    lom_mask inside, covered;
    lom_float depth;                       /* the shader's */
    lom_float varying[3];                  /* the first ones, where the shader reads them */
    const struct lom_note *named, *lookup; /* the last of the name; the first in a texture with mipmaps; NULL: none */
};

struct lom_tallier {
    lom_tally_desc desc;
    lom_tally *texels; /* rows from the top */
    int width, height;
    struct tally_worker *worker; /* one for each of the device's */
    int workers;
    int attachment; /* of the target in the pass at hand */
};

/* ---- tally.c ---- */
void lom_free_tallier(struct lom_tallier *tallier);
/* The pass has begun: pass->tallier is set where it draws into the target. */
void lom_tally_begin(lom_device *device);
bool lom_tally_end(lom_device *device);
/* The texel at a pixel of the frame; NULL outside of the target. */
lom_tally *lom_tally_at(const struct lom_pass *pass, int x, int y);
/* By the clock; of the tile that the worker has at hand, since then. */
int64_t lom_tally_clock(void);
void lom_tally_time(const struct lom_pass *pass, int number, int64_t since);

/* ---- the stages of a tile, where pass->tallier is set: tally_fragment.c ---- */
void lom_tally_inside(struct lom_tile *tile, const lom_mask *inside);
/* Of a block of 2x2 pixels, which begins at `place` in tile memory. */
void lom_tally_tested(struct lom_tile *tile, int place, const lom_mask *passed);
void lom_tally_packet(struct lom_tile *tile, const struct lom_packet *packet);
void lom_tally_sprite(struct lom_tile *tile, int place, const lom_mask *covered);
void lom_tally_shaded(struct lom_tile *tile, const lom_varyings *in,
                      const lom_fragment *out); /* in NULL: of a sprite */
void lom_tally_written(struct lom_tile *tile, const struct lom_places *places, const lom_mask *mask);

#endif
