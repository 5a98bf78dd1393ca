/* Interpolates on the screen. */
#include "student.h"

void student_interpolate(const struct triangle *t, struct fragment *f)
{
    float share[3], sum = 0;
    for (int k = 0; k < 3; k++) {
        share[k] = f->l[k] * 1;
        sum += share[k];
    }
    f->w = 1 / sum;
    for (int i = 0; i < VARYINGS; i++)
        f->varying[i] = (share[0] * t->v[0].value[i] + share[1] * t->v[1].value[i] + share[2] * t->v[2].value[i]) / sum;
    for (int k = 0; k < 2; k++) {
        const int64_t *step = k == 0 ? t->right : t->down;
        float by[3], all = 0;
        for (int i = 0; i < 3; i++) {
            by[i] = (float)(step[i] * 256) * t->inverse_area * 1;
            all += by[i];
        }
        f->ds[k] = f->dt[k] = 0;
        for (int i = 0; i < 3; i++) {
            float slope = (by[i] - share[i] / sum * all) / sum;
            f->ds[k] += slope * t->v[i].value[S];
            f->dt[k] += slope * t->v[i].value[T];
        }
    }
}
