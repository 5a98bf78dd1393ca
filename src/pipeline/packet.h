/* What the raster, fragment and output stages of one width hand to one another: packets of LOM_LANES fragments. */
#ifndef LOM_PIPELINE_PACKET_H
#define LOM_PIPELINE_PACKET_H

#include "image/compare_lanes.h"
#include "image/convert_lanes.h"
#include "pipeline/variants.h"

/* Where the fragments of a packet lie in tile memory. */
struct lom_places {
    int32_t pixel[LOM_LANES];
    bool block; /* LOM_LANES pixels of a 4x4 window in memory order, from pixel[0] */
};

/* LOM_LANES fragments; lanes that are none repeat one that is, and are not covered. */
struct lom_packet {
    struct lom_places places;
    lom_float l[3], depth; /* depth only with draw->queues_depth */
    lom_int which;         /* a lane's triangle, a number below `triangles` */
    int triangles;
    int32_t
        triangle[LOM_LANES]; /* numbers in the chunk's triangles, `triangles` of them, each different from the last */
    lom_mask covered;
    /* Only with several samples (struct lom_sample_queue): bits, the place of shading, and rows of depths, one a sample. */
    lom_int samples, place;
    const float *sample_depth;
    size_t depth_pitch;
};

/* Fragments on their way to the queue: LOM_LANES of any triangles, in order. */
struct lom_fragments {
    lom_int pixel, triangle; /* place in tile memory; number in the chunk */
    lom_mask covered, taken; /* taken: covered, or a helper that goes with it */
    lom_float l[3], depth;
    lom_int samples, place; /* as in a packet */
    const lom_float *sample_depth;
};

/* Adds the lanes that are taken to the queue; shades it when it is full. */
void LOM_WIDE(lom_enqueue)(struct lom_tile *tile, const struct lom_fragments *fragments);
/* A part of a window of one triangle on to the fragment stage, or into the queue on the way there. `alone`: the queue
 * holds no fragment of an earlier triangle. */
void LOM_WIDE(lom_deliver)(struct lom_tile *tile, struct lom_fragments *fragments, bool alone);
/* Draws the triangles of the tile's list; unless `all` is asked for, the last fragments may stay in it (pack.wide.c). */
void LOM_WIDE(lom_drain_list)(struct lom_tile *tile, bool all);
/* The uniforms of primitive `number` of a chunk, which is none before those that were asked for (raster.wide.c). */
void LOM_WIDE(lom_turn_to_call)(struct lom_tile *tile, uint32_t number);
/* The fragment stage: shades a packet of tile->draw and tile->chunk, and writes it. */
void LOM_WIDE(lom_shade_packet)(struct lom_tile *tile, const struct lom_packet *packet);
/* The same for a packet of one triangle, whose values are found once for all of its packets that follow one another. */
void LOM_WIDE(lom_shade_facet)(struct lom_tile *tile, const struct lom_packet *packet);
/* lom_run_shader (run_shader.h) with draw->sampled (write_samples.wide.c). */
void LOM_WIDE(lom_run_sampled)(struct lom_tile *tile, const struct lom_packet *packet, lom_varyings *in);
/* What follows a shader there: the lanes of mask to their samples; of the packet all but weights and triangles. `apart`: no
 * two lanes are the same sample. */
void LOM_WIDE(lom_write_samples)(struct lom_tile *tile, const struct lom_packet *packet, const lom_mask *mask,
                                 bool apart, const lom_fragment *out);
/* Draws a list of sprites there (raster_sprites.wide.c). */
void LOM_WIDE(lom_raster_sprite_samples)(struct lom_tile *tile, const uint32_t *list, size_t count);
/* The lanes of mask, whose fragments are shaded, through the late depth test and the output stage, in lane order;
 * `apart`: they are different pixels. */
void LOM_WIDE(lom_write_in_order)(struct lom_tile *tile, const struct lom_places *places, const lom_mask *mask,
                                  bool apart, const lom_fragment *out);
/* Draws a list of lines (raster_lines.wide.c); of sprites (raster_sprites.wide.c). */
void LOM_WIDE(lom_raster_lines)(struct lom_tile *tile, const uint32_t *list, size_t count);
void LOM_WIDE(lom_raster_sprites)(struct lom_tile *tile, const uint32_t *list, size_t count);
/* The output stage: blends and stores the lanes of mask, which are different pixels (or, in lane order, opaque). */
void LOM_WIDE(lom_write_packet)(struct lom_tile *tile, const struct lom_places *places, lom_mask *mask,
                                const lom_float4 *color);

/* The same for colour attachment i alone. */
void LOM_WIDE(lom_write_color)(struct lom_tile *tile, const struct lom_places *places, const lom_mask *mask,
                               const lom_float4 *color, int i);

/* A paint that fills: to `count` windows side by side, of which the first begins at `base` in tile memory; to the lanes
 * of a part of a window; to a tile that is one colour, of which so many pixels are inside the attachments. */
void LOM_WIDE(lom_fill_windows)(struct lom_tile *tile, int base, int count);
void LOM_WIDE(lom_fill_part)(struct lom_tile *tile, int place, const lom_mask *covered);
void LOM_WIDE(lom_fill_tile)(struct lom_tile *tile, int pixels);

/* LOM_LANES values of a window in memory order: two runs of 8 pixels, the second two rows of blocks below. */
LOM_INLINE lom_int lom_load_block(const int32_t *memory, const struct lom_tile *tile)
{
    return LOM_LANES == 16 ? lom_load_halves(memory, memory + 2 * tile->edge) : lom_load_int(memory);
}

LOM_INLINE void lom_store_block(int32_t *memory, const struct lom_tile *tile, lom_int x)
{
    if (LOM_LANES == 16)
        lom_store_halves(memory, memory + 2 * tile->edge, x);
    else
        lom_store_int(memory, x);
}

LOM_INLINE lom_int lom_load_places(const int32_t *memory, const struct lom_tile *tile, const struct lom_places *places)
{
    return places->block ? lom_load_block(memory + places->pixel[0], tile)
                         : lom_gather_int(memory, lom_load_int(places->pixel));
}

/* Stores the lanes of mask, in lane order: the last of those at one place stays. */
LOM_INLINE void lom_store_places(int32_t *memory, const struct lom_tile *tile, const struct lom_places *places,
                                 lom_mask mask, lom_int x)
{
    if (places->block) {
        int32_t *to = memory + places->pixel[0];
        if (!lom_all(mask))
            x = lom_select_int(mask, x, lom_load_block(to, tile));
        lom_store_block(to, tile, x);
        return;
    }
    int32_t values[LOM_LANES];
    lom_store_int(values, x);
    if (lom_all(mask)) {
        for (int i = 0; i < LOM_LANES; i++)
            memory[places->pixel[i]] = values[i];
        return;
    }
    for (uint32_t bits = lom_bits(mask); bits != 0; bits &= bits - 1) {
        int i = __builtin_ctz(bits);
        memory[places->pixel[i]] = values[i];
    }
}

/* The lanes of pending that are the first at their pixel. */
LOM_INLINE lom_mask lom_first_at_pixels(struct lom_tile *tile, const int32_t *pixel, lom_mask pending)
{
    uint32_t bits = lom_bits(pending), first = 0;
    for (int i = LOM_LANES - 1; i >= 0; i--)
        if (bits >> i & 1)
            tile->owner[pixel[i]] = (uint8_t)i;
    for (int i = 0; i < LOM_LANES; i++)
        if ((bits >> i & 1) && tile->owner[pixel[i]] == i)
            first |= 1u << i;
    return lom_mask_of_bits(first);
}

/* The window position from the place in tile memory: blocks of 2x2, edge / 2 of them a row. */
LOM_INLINE void lom_find_position(const struct lom_tile *tile, const struct lom_places *places, lom_varyings *in)
{
    lom_int place = lom_load_int(places->pixel);
    int shift = __builtin_ctz((unsigned)tile->edge) - 1;
    lom_int block = place >> 2;
    lom_int bx = block & (tile->edge / 2 - 1), by = block >> shift;
    in->x = lom_to_float(bx * 2 + (place & 1) + tile->x) + 0.5f;
    in->y = lom_to_float(by * 2 + (place >> 1 & 1) + tile->y) + 0.5f;
}

/* Depth in units of an attachment with such a depth_scale: the float itself, or a whole number for DEPTH16 and DEPTH24. */
LOM_INLINE lom_float lom_scale_depth(float scale, lom_float z)
{
    return scale == 0 ? z : lom_to_float(lom_unorm_of_lanes(z, scale));
}

LOM_INLINE lom_float lom_depth_units(const struct lom_pass *pass, lom_float z)
{
    return lom_scale_depth((float)pass->depth_scale, z);
}

/* A stored depth as the attachment's texture reads it. */
LOM_INLINE lom_float lom_depth_of_units(const struct lom_pass *pass, lom_float units)
{
    return pass->depth_scale == 0 ? units : units / (float)pass->depth_scale;
}

/* Early depth test, and write unless a late one follows, of a part of a window, which begins at `place` in tile memory; the
 * lanes that pass. */
LOM_INLINE lom_mask lom_test_depth(struct lom_tile *tile, int place, lom_mask covered, lom_float z)
{
    const struct lom_draw *draw = tile->draw;
    int32_t *memory = (int32_t *)(void *)tile->depth + place;
    lom_float stored = lom_as_float(lom_load_block(memory, tile));
    lom_float units = lom_depth_units(tile->pass, z);
    lom_mask passed = covered & lom_compare_depth(draw->compare, units, stored);
    if (draw->depth_write && !draw->late_depth)
        lom_store_block(memory, tile, lom_as_int(lom_select(passed, units, stored)));
    return passed;
}

/* Finite, as textures want it. */
LOM_INLINE lom_float lom_make_finite(lom_float x)
{
    lom_float number = lom_select(x == x, x, (lom_float){ 0 }), bound = lom_splat(0x1p123f);
    return lom_clamp(number, -bound, bound);
}

/* What the output stage does for OUTPUT_FLOATS_MULTIPLIED. */
LOM_INLINE void lom_lay_over(struct lom_tile *tile, const struct lom_places *places, lom_mask mask,
                             const lom_float4 *color)
{
    const lom_float channels[4] = { color->x, color->y, color->z, color->w }, rest = 1.0f - color->w;
    int32_t *memory = tile->color[0];
    for (int c = 0; c < 4; c++, memory += tile->edge * tile->edge) {
        lom_int target = lom_load_places(memory, tile, places);
        lom_int result = lom_as_int(lom_make_finite(channels[c] + lom_as_float(target) * rest));
        if (places->block)
            lom_store_block(memory + places->pixel[0], tile, lom_select_int(mask, result, target));
        else
            lom_store_places(memory, tile, places, mask, result);
    }
}

_Static_assert(sizeof(lom_varyings) <= LARGEST_VARYINGS && sizeof(lom_fragment) <= LARGEST_FRAGMENT,
               "a tile holds them");

LOM_INLINE lom_varyings *varyings_in(unsigned char varyings[][LARGEST_VARYINGS], int packet)
{
    return (lom_varyings *)(void *)varyings[packet];
}

LOM_INLINE lom_fragment *fragment_in(struct lom_together *together, int packet)
{
    return (lom_fragment *)(void *)together->fragments[packet];
}

#endif
