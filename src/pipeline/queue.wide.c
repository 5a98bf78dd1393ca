/* Between the stages 5 and 6: covered fragments of small triangles wait in the tile's queue until they fill a packet;
 * those that fill one by themselves, or need no shader, go straight on. */
#include "pipeline/packet.h"

/* A packet of the queue's first entries; the lanes past `count` repeat the first. */
static void take_packet(const struct lom_tile *tile, int count, struct lom_packet *packet)
{
    const struct lom_queue *q = &tile->queue;
    lom_mask taken = lom_lane_index() < count;
    lom_int pixel = lom_load_int(q->pixel), which = lom_load_int(q->which);
    for (int k = 0; k < 3; k++) {
        lom_float l = lom_load(q->l[k]);
        packet->l[k] = lom_select(taken, l, lom_splat(l[0]));
    }
    packet->depth = (lom_float){ 0 };
    if (tile->draw->queues_depth) {
        lom_float depth = lom_load(q->depth);
        packet->depth = lom_select(taken, depth, lom_splat(depth[0]));
    }
    packet->which = lom_select_int(taken, which, lom_splat_int(0));
    packet->triangles = q->which[count - 1] + 1;
    lom_store_int(packet->triangle, lom_load_int(q->triangle));
    packet->covered = tile->draw->desc.shader->quads ? taken & lom_load_int(q->covered) : taken;
    packet->places.block = false;
    lom_store_int(packet->places.pixel, lom_select_int(taken, pixel, lom_splat_int(pixel[0])));
}

/* Shades the queue's first `count` fragments (LOM_LANES at most) and drops them. */
static void shade_queue(struct lom_tile *tile, int count)
{
    struct lom_queue *q = &tile->queue;
    struct lom_packet packet;
    take_packet(tile, count, &packet);
    LOM_WIDE(lom_shade_packet)(tile, &packet);
    q->count -= count;
    if (q->count == 0) {
        q->triangles = 0;
        return;
    }
    q->triangle[0] = q->triangle[q->triangles - 1]; /* only the last triangle can have more than filled the packet */
    q->triangles = 1;
    for (int k = 0; k < 3; k++)
        lom_store(q->l[k], lom_load(q->l[k] + LOM_LANES));
    lom_store(q->depth, lom_load(q->depth + LOM_LANES));
    lom_store_int(q->pixel, lom_load_int(q->pixel + LOM_LANES));
    lom_store_int(q->covered, lom_load_int(q->covered + LOM_LANES));
    lom_store_int(q->which, lom_splat_int(0));
}

LOM_INLINE lom_int places_of(const struct lom_tile *tile, const struct lom_fragments *f)
{
    return lom_load_int(tile->offset + f->part * LOM_LANES) + f->base;
}

/* Adds the lanes of `taken` to the queue; shades a packet when it is full. */
static void enqueue(struct lom_tile *tile, const struct lom_fragments *f, lom_mask taken)
{
    struct lom_queue *q = &tile->queue;
    int first = q->count;
    for (int i = 0; i < 3; i++)
        lom_compress(q->l[i] + first, taken, f->l[i]);
    lom_compress((float *)q->pixel + first, taken, lom_as_float(places_of(tile, f)));
    if (tile->draw->queues_depth)
        lom_compress(q->depth + first, taken, f->depth);
    if (tile->draw->desc.shader->quads)
        lom_compress((float *)q->covered + first, taken, lom_as_float(f->covered));
    if (q->triangles == 0 || q->triangle[q->triangles - 1] != f->number)
        q->triangle[q->triangles++] = f->number;
    lom_store_int(q->which + first, lom_splat_int(q->triangles - 1));
    q->count += (int)lom_count(taken);
    if (q->count >= LOM_LANES)
        shade_queue(tile, LOM_LANES);
}

/* A part that is covered wholly is a packet by itself; nothing of an earlier triangle waits in the queue. */
static void shade_part(struct lom_tile *tile, const struct lom_fragments *f)
{
    struct lom_packet packet;
    packet.depth = f->depth;
    packet.which = lom_splat_int(0);
    packet.triangle[0] = f->number;
    packet.triangles = 1;
    packet.covered = f->covered;
    packet.places.block = true;
    for (int k = 0; k < 3; k++)
        packet.l[k] = f->l[k];
    lom_store_int(packet.places.pixel, places_of(tile, f));
    LOM_WIDE(lom_shade_packet)(tile, &packet);
}

/* A draw whose shader reads nothing has one colour: it goes straight to the output stage. */
static void write_constant(struct lom_tile *tile, const struct lom_fragments *f)
{
    const struct lom_paint *paint = &tile->draw->paint;
    struct lom_places places = { .block = true };
    lom_float4 color[LOM_MAX_COLORS];
    lom_mask covered = f->covered;
    lom_store_int(places.pixel, places_of(tile, f));
    for (int i = 0; i < tile->pass->colors; i++)
        color[i] = (lom_float4){ lom_splat(paint->color[i][0]), lom_splat(paint->color[i][1]),
                                 lom_splat(paint->color[i][2]), lom_splat(paint->color[i][3]) };
    LOM_WIDE(lom_write_packet)(tile, &places, &covered, color);
}

void LOM_WIDE(lom_deliver)(struct lom_tile *tile, const struct lom_fragments *f, bool alone)
{
    const struct lom_draw *draw = tile->draw;
    if (draw->constant) {
        write_constant(tile, f);
        return;
    }
    lom_mask taken = f->covered;
    uint32_t bits = lom_bits(taken);
    if (draw->desc.shader->quads) {
        bits = (bits | bits >> 1 | bits >> 2 | bits >> 3) & 0x1111;
        bits *= 15;
        taken = lom_mask_of_bits(bits);
    }
    if (bits == (uint32_t)((UINT64_C(1) << LOM_LANES) - 1) && (alone || tile->queue.count == 0))
        shade_part(tile, f);
    else
        enqueue(tile, f, taken);
}

void LOM_WIDE(lom_flush)(struct lom_tile *tile)
{
    if (tile->queue.count > 0)
        shade_queue(tile, tile->queue.count);
}
