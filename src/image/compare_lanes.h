/* A comparison chosen while it runs, over lanes: the depth test, and samplers that compare. */
#ifndef LOM_IMAGE_COMPARE_LANES_H
#define LOM_IMAGE_COMPARE_LANES_H

#include <lom/texture.h>

LOM_INLINE lom_mask lom_compare_depth(lom_compare compare, lom_float z, lom_float stored)
{
    switch (compare) {
    case LOM_COMPARE_NEVER:
        return (lom_mask){ 0 };
    case LOM_COMPARE_LESS:
        return z < stored;
    case LOM_COMPARE_EQUAL:
        return z == stored;
    case LOM_COMPARE_LESS_EQUAL:
        return z <= stored;
    case LOM_COMPARE_NOT_EQUAL:
        return z != stored;
    case LOM_COMPARE_GREATER_EQUAL:
        return z >= stored;
    case LOM_COMPARE_ALWAYS:
        return lom_splat_int(-1);
    default:
        return z > stored;
    }
}

#endif
