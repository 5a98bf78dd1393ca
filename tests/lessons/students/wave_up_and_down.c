/* A sine. */
#include "student.h"

void student_wave(const lom_trochoid *w, float x, float z, float time, float moved[3])
{
    double along = w->direction[0] * x + w->direction[1] * z;
    double t = w->number * along + 2 * 3.141592653589793 * w->phase - w->rate * time;
    double aside = 0 * lom_double_sin(t);
    moved[0] = (float)(aside * w->direction[0]);
    moved[1] = (float)(w->amplitude * lom_double_cos(t));
    moved[2] = (float)(aside * w->direction[1]);
}
