/* All primitives of a pass while they are told: what steps_triangles.c and steps_window.c share. */
#ifndef LOM_INSPECT_STEPS_TRIANGLES_H
#define LOM_INSPECT_STEPS_TRIANGLES_H

#include "inspect/steps_mesh.h"
#include "inspect/steps_tiles.h"

extern const struct ink lom_frame_ink, lom_kept_ink, lom_reach_inks[LOM_REACHES];

struct range {
    double low[2], high[2];
    bool any;
};

struct all_triangles {
    struct steps *steps;
    struct meshes meshes;
    bool draws; /* else measures */
    struct counted all, reach[LOM_REACHES], cut;
    uint64_t made, pieces, new_corners; /* made: by stages behind the vertices */
    double most_w, near;                /* of what is drawn; clip z, where it is the same everywhere */
    bool is_flat, has_near, any;        /* flat: w is 1 everywhere */
    int guard_width;    /* of the viewport in which something was last cut by the guard band; 0: nothing is */
    struct range range; /* of what is cut, in clip x and w */
    struct canvas clip_space, cut_canvas, window, fates, bins;
    struct tiles tiles;
};

/* Of 2 to 4 corners; where they lie near one another it is a haze. */
void lom_draw_outline(struct canvas *canvas, const double (*at)[2], int corners, struct ink ink, double least);

/* ---- steps_window.c ---- */
/* A place of the window in a picture of the whole window, or of the frame alone. */
void lom_place_window(const struct all_triangles *a, const float window[3], bool whole, double at[2]);
/* A piece of what is told, in the pictures of the window, of what was culled, of the tiles. */
void lom_draw_window(struct all_triangles *a, const lom_told_triangle *t, const lom_told_piece *piece);
void lom_add_window_pictures(struct all_triangles *a);

#endif
