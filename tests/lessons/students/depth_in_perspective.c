/* Interpolates depth as if it were a varying. */
#include "student.h"

float student_depth_at(const struct triangle *t, const float l[3])
{
    float above = 0, below = 0;
    for (int k = 0; k < 3; k++) {
        above += l[k] * t->v[k].one_over_w * t->v[k].depth;
        below += l[k] * t->v[k].one_over_w;
    }
    return above / below;
}
