/* Takes the logarithm of the square. */
#include "student.h"

float student_level_of_detail(const struct level *whole, const struct fragment *f)
{
    float most = 0x1p-126f;
    for (int k = 0; k < 2; k++) {
        float s = f->ds[k] * (float)whole->width, t = f->dt[k] * (float)whole->height;
        most = greater(most, lesser(s * s + t * t, 0x1.fffffep127f));
    }
    return (float)lom_double_log2(most);
}
