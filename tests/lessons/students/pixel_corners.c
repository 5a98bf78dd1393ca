/* Asks at the pixel's upper left corner. */
#include "student.h"

bool student_covers(const struct triangle *t, struct fragment *f)
{
    int64_t x = 256 * (int64_t)f->x + 0, y = 256 * (int64_t)f->y + 0;
    for (int i = 0; i < 3; i++) {
        const struct vertex *a = &t->v[i == 2 ? 0 : i + 1];
        int64_t e = (t->right[i] * (x - a->x) + t->down[i] * (y - a->y));
        bool owned = t->right[i] > 0 || (t->right[i] == 0 && t->down[i] > 0);
        if (e < 0 || (e == 0 && !owned))
            return false;
        f->l[i] = t->inverse_area * (float)e;
    }
    if (!t->crosses)
        return true;
    float side = f->l[0] * t->distance[0] + f->l[1] * t->distance[1] + f->l[2] * t->distance[2];
    return side > 0 || (side == 0 && t->keeps_zero);
}
