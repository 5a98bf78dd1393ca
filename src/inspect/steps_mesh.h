/* The meshes of a pass as the vertex stage reads them: steps_mesh.c. */
#ifndef LOM_INSPECT_STEPS_MESH_H
#define LOM_INSPECT_STEPS_MESH_H

#include "inspect/steps.h"

enum { MOST_MESHES = 48, MOST_CELLS = 6, MESH_SAMPLES = 256 };

/* All draws of one label, or of one array of vertices. */
struct seen_mesh {
    const char *label;
    const void *data;
    double low[3], high[3];         /* of its places */
    double sample[3][MESH_SAMPLES]; /* places of some triangles, by axis */
    int samples;
    uint64_t triangles, skip; /* skip: triangles between samples */
    int cell;                 /* -1: none */
};

struct seen_draw { /* what a draw reads: the same again is not drawn again */
    const void *data, *indices;
    size_t first, count;
    int mesh; /* -1: one that has been seen */
};

struct meshes {
    struct seen_mesh mesh[MOST_MESHES];
    int count;
    struct seen_draw *draws; /* by their number in the pass */
    size_t draw_count, draw_capacity;
    struct canvas canvas;
    int columns, rows, cells;
    struct counted primitives; /* of all of them */
    bool failed;
};

/* Measures a triangle that is told; later draws it. */
void lom_measure_mesh(struct meshes *meshes, const lom_told_triangle *t);
bool lom_lay_cells(struct meshes *meshes, const struct canvas *like, lom_error *error);
void lom_draw_meshes(struct meshes *meshes, const lom_told_triangle *t);
void lom_picture_mesh(struct steps *s, struct meshes *meshes);
void lom_clear_meshes(struct meshes *meshes);

#endif
