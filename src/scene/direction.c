/* Directions that a scene file gives, made unit vectors. Invariant: no square overflows or vanishes. */
#include "scene/direction.h"

bool lom_make_unit(lom_vec3 *v)
{
    double x = __builtin_fabs(v->x), y = __builtin_fabs(v->y), z = __builtin_fabs(v->z);
    double largest = x > y ? x : y;
    largest = largest > z ? largest : z;
    if (!(largest > 0 && largest - largest == 0))
        return false;
    lom_vec3 scaled = { v->x / largest, v->y / largest, v->z / largest };
    double length = lom_double_sqrt(scaled.x * scaled.x + scaled.y * scaled.y + scaled.z * scaled.z);
    *v = (lom_vec3){ scaled.x / length, scaled.y / length, scaled.z / length };
    return true;
}
