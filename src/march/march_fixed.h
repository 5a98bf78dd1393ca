/* The march through a volume in fixed point (march_fixed.wide.c). */
#ifndef LOM_MARCH_MARCH_FIXED_H
#define LOM_MARCH_MARCH_FIXED_H

#include <lom/march.h>

/* lom_march_volume by LOM_FILTERING_FIXED. */
void LOM_WIDE(lom_march_fixed)(lom_float4 *out, const lom_march_rays *rays, const lom_march_desc *desc,
                               lom_march_count *count);

#endif
