/* The shadow of a lamp (L. Williams, Casting Curved Shadows on Curved Surfaces, SIGGRAPH 1978): maps of how near to it
 * something stands, as it sees that, one for a cone or one for each axis of the world.
 *
 * Its edge is filtered over 3 x 3 texels with the quadratic B-spline, which reaches 1.5 texels along each axis. A flat
 * surface must not shade itself: with h the lamp's distance from its plane and n its unit normal in the map's axes, the
 * reciprocal of the depth w is n . (u, v, 1) / h over the tangents (u, v), so within the kernel it grows by at most
 * 1.5 d (|n.u| + |n.v|) / h, d being a texel's tangent. A place moved by b along n has a reciprocal that lies b / (h w) over the
 * plane's. So b = 1.5 d w (|n.u| + |n.v|) is enough at whatever slope. LOM_SHADOW_LEAN is 6 % more, since corners are
 * snapped to 1/256 of a texel; LOM_SHADOW_LIFT is for normals that are not the plane's: where light is smooth over a mesh
 * whose faces lean up to 16 degrees from their normals (1.5 sqrt(2) sin 16 = 0.58).
 *
 * Invariant: where no texel of the kernel is nearer, the share is what it was, bit for bit; where all are, it is 0. */
#ifndef LOM_SHADING_LAMP_SHADOW_H
#define LOM_SHADING_LAMP_SHADOW_H

#include <lom/texture.h>

#define LOM_SHADOW_LEAN 1.6 /* texels */
#define LOM_SHADOW_LIFT 0.6

struct lom_lamp_face_uniform {
    const lom_texture *map;    /* depth, 0 where there is nothing; NULL: nothing at all */
    const lom_texture *liquid; /* as of liquid_shadow.h; NULL: none */
    float right[3], up[3],
        forward[3]; /* of a place less the lamp: forward is the depth w, the others over it are -1..1 */
};

struct lom_lamp_shadow_uniform {
    struct lom_lamp_face_uniform face[6];
    int count;         /* 1, or 6 along the axes of the world */
    float place[3];    /* of the lamp, less the eye of the frame */
    bool has_liquid;   /* before a face */
    float size, texel; /* of each map: texels a side, and 1 / size */
    float scale;       /* texture coordinates are 1/2 + scale right / w, 1/2 - scale up / w */
    float from;        /* depth is from / w */
    float lift, lean;  /* a place is moved along its normal by w (lift + lean (|n . right| + |n . up|)) */
};

/* Multiplies the shares of a lamp's light at places less the eye of the frame by what its shadow leaves. normal: unit,
 * towards the side that is lit; 0 where nothing can shade itself. */
void LOM_WIDE(lom_shade_lamp)(const struct lom_lamp_shadow_uniform *shadow, const lom_float3 *place,
                              const lom_float3 *normal, lom_float *share);

#endif
