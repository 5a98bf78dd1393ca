/* Vectors as uniforms; matrices are in lom/lanes.h. */
#ifndef LOM_SHADING_MATRIX_H
#define LOM_SHADING_MATRIX_H

#include <lom/geometry.h>
#include <lom/lanes_mathematics.h>
#include <lom/pipeline.h>

LOM_INLINE lom_float3 lom_uniform3(const float v[3])
{
    return lom_splat3(v[0], v[1], v[2]);
}

#endif
