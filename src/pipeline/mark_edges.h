/* Where the triangles of a packet end: for draws that mark edges (mark_edges.wide.c). */
#ifndef LOM_PIPELINE_MARK_EDGES_H
#define LOM_PIPELINE_MARK_EDGES_H

#include "pipeline/packet.h"

/* Writes tile->reach for the packet's lanes, of which l, which and triangles count. step: what weights 1 and 2 change by a
 * pixel, x and y to the right and down of 1, z and w of 2. is_cut: clip distances may cut its triangles, whose numbers
 * count then, too. */
void LOM_WIDE(lom_mark_edges)(struct lom_tile *tile, const struct lom_packet *packet, const lom_float4 *step,
                              bool is_cut);
/* The same of what is no triangle. */
void LOM_WIDE(lom_mark_no_edges)(struct lom_tile *tile);

#endif
