/* One depth for the whole triangle. */
#include "student.h"

float student_depth_at(const struct triangle *t, const float l[3])
{
    return t->v[0].depth + 0 * l[0];
}
