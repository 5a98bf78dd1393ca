/* Perlin-Worley shapes: bodies that are heaps of bubbles, and layers. In metres, from the lower left far corner of the
 * box. The formulas are in shape.wide.c, the numbers of each kind in make_body.c and make_layer.c. */
#ifndef LOM_CLOUD_SHAPE_H
#define LOM_CLOUD_SHAPE_H

#include <lom/lanes.h>

enum { LOM_MAX_BUBBLES = 160 };

struct lom_cloud_bubble {
    float x, y, z, radius;
    float flatness; /* how many times its height goes into its width */
};

/* The plate of ice that spreads from the head of a tower where the air stops rising, drawn out to one side by the wind
 * there: flat above, its lower side rising outwards. */
struct lom_cloud_anvil {
    float x, z, height;      /* of the middle of its upper side */
    float radius, thickness; /* radius 0: there is none */
    float drawn;             /* how many times it is longer along x than along z */
};

struct lom_cloud_body {
    int bubble_count;
    struct lom_cloud_bubble bubble[LOM_MAX_BUBBLES];
    float base, base_depth;    /* height of the flat base, and over which it fades in */
    float billow, billow_size; /* how far billows swell, and how far apart they are */
    float warp, warp_size;     /* displacement by slow noise */
    float softness;            /* depth below the surface at which the density is full */
    float thin;                /* density at the base, in parts of that at the top */
    struct lom_cloud_anvil anvil;
};

struct lom_cloud_layer {
    float coverage; /* share that is covered, about */
    float cell[3];  /* size of what it is made of, along x, y and z */
    float shear;    /* metres along x a metre of height */
    float warp, warp_size;
    float billow_share;      /* of cellular noise; the rest is gradient noise */
    float patch, patch_size; /* how much the cover varies over large distances */
    float contrast;          /* steepness of the edge of the cover */
    float rise, fall;        /* parts of the height over which it sets in above the base, and ends below the top */
    float streak;            /* 1: ridges of noise (fibres) instead of the noise */
};

struct lom_cloud_shape {
    int voxels[3];
    float size[3]; /* metres */
    uint32_t seed;
    const struct lom_cloud_body *body; /* or NULL */
    const struct lom_cloud_layer *layer;
};

/* One row of voxels. */
void LOM_WIDE(lom_shape_row)(uint16_t *row, const struct lom_cloud_shape *shape, int y, int z);
/* All rows, at the widest lanes this processor runs. */
void lom_fill_shape(uint16_t *voxels, const struct lom_cloud_shape *shape);

#endif
