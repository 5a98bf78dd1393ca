/* Meshes of many small things and their textures (bench/peers/README.md, "Scattered meshes"): colours stand in the
 * normals' place. */
#ifndef LOM_MEASURE_PEER_SCATTER_H
#define LOM_MEASURE_PEER_SCATTER_H

#include "measure/peer_meshes.h"

#include <lom/image.h>

/* For a window of width x height pixels. False when memory runs out; freed with lom_peer_free_mesh either way. */
typedef bool lom_peer_scatter(lom_peer_mesh *mesh, int width, int height, lom_error *error);
lom_peer_scatter lom_peer_sprites;   /* 2000 quads of 64 pixels a side, in clip coordinates */
lom_peer_scatter lom_peer_cards;     /* 20 000 upright quads on the terrain, metres */
lom_peer_scatter lom_peer_gradients; /* three layers of triangles of some 200 pixels, in clip coordinates */

enum { LOM_PEER_BOXES = 5000 };
typedef struct lom_peer_box {
    float centre[3], size, color[3];
} lom_peer_box;
/* Where a cube of the workload "draws" stands. */
lom_peer_box lom_peer_box_at(int index);

/* RGBA8, freed with lom_free_image; NULL on failure. */
lom_image *lom_peer_blob(lom_error *error); /* 64 x 64, softly round */
lom_image *lom_peer_leaf(lom_error *error); /* 128 x 128, ragged */

#endif
