/* Lights insides as outsides. */
#include "student.h"

void student_shade(const struct uniforms *u, struct fragment *f)
{
    float n[3], e[3], power = 1;
    for (int i = 0; i < 3; i++) {
        n[i] = f->varying[NORMAL + i];
        e[i] = u->eye[i] - f->varying[WORLD + i];
    }
    normalize(n);
    normalize(e);
    float nl = dot(n, to_light), facing = dot(n, e), diffuse = greater(nl, 0), re = 0;
    for (int i = 0; i < 3; i++)
        re += (2 * nl * n[i] - to_light[i]) * e[i];
    for (int k = 0; k < u->shininess; k++)
        power *= re > 0 ? re : 0;
    for (int i = 0; i < 3; i++)
        f->color[i] = f->texel[i] * (ambient + lamp * diffuse) + (diffuse > 0 ? shine * power : 0);
    f->color[3] = u->opacity * f->texel[3];
}
