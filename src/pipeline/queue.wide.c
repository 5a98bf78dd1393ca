/* Between the stages 5 and 6: covered fragments wait in the tile's queue until they fill packets; those that fill one
 * by themselves, or need no shader, go straight on. */
#include "pipeline/window.h"

/* Which triangles the fragments have: those of one triangle follow one another. */
static void number_triangles(const int32_t *triangle, int count, struct lom_packet *packet)
{
    int32_t which[LOM_LANES] = { 0 };
    int last = 0;
    packet->triangle[0] = triangle[0];
    for (int i = 1; i < count && triangle[0] != triangle[count - 1]; i++) {
        last += triangle[i] != triangle[i - 1];
        packet->triangle[last] = triangle[i];
        which[i] = last;
    }
    packet->which = lom_load_int(which);
    packet->triangles = last + 1;
}

/* A packet of `count` entries of the queue from `first` on; the lanes past `count` repeat the first. */
static void take_packet(const struct lom_tile *tile, int first, int count, struct lom_packet *packet)
{
    const struct lom_queue *q = &tile->queue;
    lom_mask taken = lom_lane_index() < count;
    lom_int pixel = lom_load_int(q->pixel + first);
    for (int k = 0; k < 3; k++) {
        lom_float l = lom_load(q->l[k] + first);
        packet->l[k] = lom_select(taken, l, lom_splat(l[0]));
    }
    packet->depth = (lom_float){ 0 };
    if (tile->draw->queues_depth) {
        lom_float depth = lom_load(q->depth + first);
        packet->depth = lom_select(taken, depth, lom_splat(depth[0]));
    }
    number_triangles(q->triangle + first, count, packet);
    packet->covered = tile->draw->desc.shader->quads ? taken & lom_load_int(q->covered + first) : taken;
    packet->places.block = false;
    lom_store_int(packet->places.pixel, lom_select_int(taken, pixel, lom_splat_int(pixel[0])));
    if (tile->pass->samples > 1) {
        packet->samples = lom_load_int(tile->sampled->queue.samples + first);
        packet->place = lom_load_int(tile->sampled->queue.place + first);
        packet->sample_depth = tile->sampled->queue.depth[0] + first;
        packet->depth_pitch = QUEUE_ROOM;
    }
}

/* What the queue holds of samples, from an entry on, goes to its begin. */
static void move_samples(struct lom_tile *tile, int first)
{
    struct lom_sample_queue *q = &tile->sampled->queue;
    lom_store_int(q->samples, lom_load_int(q->samples + first));
    lom_store_int(q->place, lom_load_int(q->place + first));
    for (int s = 0; tile->draw->late_depth && s < tile->pass->samples; s++)
        lom_store(q->depth[s], lom_load(q->depth[s] + first));
}

static void enqueue_samples(struct lom_tile *tile, const struct lom_fragments *f, int first)
{
    struct lom_sample_queue *q = &tile->sampled->queue;
    lom_compress((float *)q->samples + first, f->taken, lom_as_float(f->samples));
    lom_compress((float *)q->place + first, f->taken, lom_as_float(f->place));
    for (int s = 0; tile->draw->late_depth && s < tile->pass->samples; s++)
        lom_compress(q->depth[s] + first, f->taken, f->sample_depth[s]);
}

/* Shades the packets that are full; what is left comes first then. */
static void shade_full_packets(struct lom_tile *tile)
{
    struct lom_queue *q = &tile->queue;
    struct lom_packet packet;
    int first = 0;
    for (; first + LOM_LANES <= q->count; first += LOM_LANES) {
        take_packet(tile, first, LOM_LANES, &packet);
        LOM_WIDE(lom_shade_packet)(tile, &packet);
    }
    q->count -= first;
    for (int k = 0; k < 3; k++)
        lom_store(q->l[k], lom_load(q->l[k] + first));
    lom_store(q->depth, lom_load(q->depth + first));
    lom_store_int(q->pixel, lom_load_int(q->pixel + first));
    lom_store_int(q->covered, lom_load_int(q->covered + first));
    lom_store_int(q->triangle, lom_load_int(q->triangle + first));
    if (tile->pass->samples > 1)
        move_samples(tile, first);
}

void LOM_WIDE(lom_enqueue)(struct lom_tile *tile, const struct lom_fragments *f)
{
    struct lom_queue *q = &tile->queue;
    int first = q->count;
    for (int i = 0; i < 3; i++)
        lom_compress(q->l[i] + first, f->taken, f->l[i]);
    lom_compress((float *)q->pixel + first, f->taken, lom_as_float(f->pixel));
    lom_compress((float *)q->triangle + first, f->taken, lom_as_float(f->triangle));
    if (tile->draw->queues_depth)
        lom_compress(q->depth + first, f->taken, f->depth);
    if (tile->draw->desc.shader->quads)
        lom_compress((float *)q->covered + first, f->taken, lom_as_float(f->covered));
    if (tile->pass->samples > 1)
        enqueue_samples(tile, f, first);
    q->count += (int)lom_count(f->taken);
    if (q->count >= QUEUE_SIZE)
        shade_full_packets(tile);
}

/* A packet of one triangle in one window; of its places, depth, weights and samples the caller knows. */
LOM_INLINE void begin_part(struct lom_packet *packet, int32_t triangle, lom_mask covered)
{
    packet->which = lom_splat_int(0);
    packet->triangle[0] = triangle;
    packet->triangles = 1;
    packet->covered = covered;
    packet->places.block = true;
}

void LOM_WIDE(lom_shade_part)(struct lom_tile *tile, const struct part *at, const lom_float l[3],
                              const lom_float *depth)
{
    struct lom_packet packet;
    begin_part(&packet, at->number, lom_splat_int(-1));
    packet.depth = *depth;
    for (int k = 0; k < 3; k++)
        packet.l[k] = l[k];
    lom_store_int(packet.places.pixel, lom_load_int(tile->offset + at->part * LOM_LANES) + at->base);
    LOM_WIDE(lom_shade_packet)(tile, &packet);
}

/* The same of fragments, which may have several samples a pixel. */
static void shade_fragments(struct lom_tile *tile, const struct lom_fragments *f)
{
    struct lom_packet packet;
    begin_part(&packet, f->triangle[0], f->covered);
    packet.depth = f->depth;
    for (int k = 0; k < 3; k++)
        packet.l[k] = f->l[k];
    packet.samples = f->samples;
    packet.place = f->place;
    packet.sample_depth = (const float *)f->sample_depth;
    packet.depth_pitch = LOM_LANES;
    lom_store_int(packet.places.pixel, f->pixel);
    LOM_WIDE(lom_shade_packet)(tile, &packet);
}

/* A draw whose shader reads nothing has one colour: it goes straight to the output stage. */
static void write_constant(struct lom_tile *tile, const struct lom_fragments *f)
{
    const struct lom_paint *paint = &tile->draw->paint;
    struct lom_places places = { .block = true };
    lom_float4 color[LOM_MAX_COLORS];
    lom_mask covered = f->covered;
    lom_store_int(places.pixel, f->pixel);
    for (int i = 0; i < tile->pass->colors; i++)
        color[i] = (lom_float4){ lom_splat(paint->color[i][0]), lom_splat(paint->color[i][1]),
                                 lom_splat(paint->color[i][2]), lom_splat(paint->color[i][3]) };
    LOM_WIDE(lom_write_packet)(tile, &places, &covered, color);
}

void LOM_WIDE(lom_deliver)(struct lom_tile *tile, struct lom_fragments *f, bool alone)
{
    const struct lom_draw *draw = tile->draw;
    if (draw->constant) {
        write_constant(tile, f);
        return;
    }
    uint32_t bits = lom_bits(f->covered);
    f->taken = f->covered;
    if (draw->desc.shader->quads) {
        bits = (bits | bits >> 1 | bits >> 2 | bits >> 3) & 0x1111;
        bits *= 15;
        f->taken = lom_mask_of_bits(bits);
    }
    if (bits == (uint32_t)((UINT64_C(1) << LOM_LANES) - 1) && (alone || tile->queue.count == 0))
        shade_fragments(tile, f);
    else
        LOM_WIDE(lom_enqueue)(tile, f);
}

void LOM_WIDE(lom_flush)(struct lom_tile *tile)
{
    struct lom_packet packet;
    shade_full_packets(tile);
    if (tile->queue.count > 0) {
        take_packet(tile, 0, tile->queue.count, &packet);
        LOM_WIDE(lom_shade_packet)(tile, &packet);
    }
    tile->queue.count = 0;
}
