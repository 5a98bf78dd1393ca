/* Has the y of the window upwards. */
#include "student.h"

void student_project(const struct picture *p, struct vertex *v)
{
    float w = v->value[CLIP + 3], x = v->value[CLIP] / w, y = v->value[CLIP + 1] / w;
    x = clamp(x, -p->band[0], p->band[0]) * 128 * (float)p->width + 128 * (float)p->width;
    y = clamp(y, -p->band[1], p->band[1]) * 128 * (float)p->height + 128 * (float)p->height;
    v->x = lom_int_of(rintf(x));
    v->y = lom_int_of(rintf(y));
    v->depth = clamp(v->value[CLIP + 2] / w, 0, 1);
    v->one_over_w = 1 / w;
}
