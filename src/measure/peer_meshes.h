/* The peers' meshes and cameras (bench/peers/README.md, "Meshes", "Conventions"). */
#ifndef LOM_MEASURE_PEER_MESHES_H
#define LOM_MEASURE_PEER_MESHES_H

#include <lom/pipeline.h>

typedef struct lom_peer_vertex { /* 32 bytes, interleaved */
    float position[3], normal[3], uv[2];
} lom_peer_vertex;

typedef struct lom_peer_mesh {
    lom_peer_vertex *vertices;
    uint32_t *indices; /* triangles, counter-clockwise from outside (above) */
    size_t vertex_count, index_count;
    lom_clusters *clusters; /* of the terrain */
} lom_peer_mesh;

/* False when memory runs out; freed with lom_peer_free_mesh either way. */
bool lom_peer_torus(lom_peer_mesh *mesh, lom_error *error);   /* 200 000 triangles */
bool lom_peer_terrain(lom_peer_mesh *mesh, lom_error *error); /* 522 242 triangles, 100 m x 100 m */
bool lom_peer_cube(lom_peer_mesh *mesh, lom_error *error);    /* corners +-1 */
bool lom_peer_water(lom_peer_mesh *mesh, lom_error *error);   /* two triangles, 100 m x 100 m, y = 0 */
void lom_peer_free_mesh(lom_peer_mesh *mesh);
/* Of zeros, for the makers of meshes. */
bool lom_peer_allocate_mesh(lom_peer_mesh *mesh, size_t vertices, size_t indices, lom_error *error);
/* Metres above the lake, the terrain's. */
float lom_peer_terrain_height(float x, float z);

typedef struct lom_peer_matrix {
    float m[16]; /* m[column * 4 + row] */
} lom_peer_matrix;

/* Projection by `field_of_view` degrees (vertical) to clip space with z in -w..w, times the view from eye to target
 * with +y up. */
lom_peer_matrix lom_peer_view(const float eye[3], const float target[3], float field_of_view, float aspect,
                              float near_plane, float far_plane);
/* The same seen in the mirror y = 0. */
lom_peer_matrix lom_peer_mirror(const lom_peer_matrix *view);

#endif
