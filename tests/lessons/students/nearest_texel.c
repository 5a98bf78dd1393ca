/* Takes one texel. */
#include "student.h"

void student_sample(const struct texture *texture, struct fragment *f)
{
    int k = lom_int_of(clamp(f->lod, 0, (float)(texture->levels - 1)));
    const struct level *l = &texture->level[k];
    float at[2] = { f->varying[S] - floorf(f->varying[S]), f->varying[T] - floorf(f->varying[T]) };
    int x = lom_int_of(at[0] * (float)l->width) % l->width, y = lom_int_of(at[1] * (float)l->height) % l->height;
    for (int c = 0; c < 4; c++)
        f->texel[c] = l->texel[y * l->width + x][c] / (c == 3 ? 255 : 1);
}
