/* Composes back to front. */
#include "student.h"

void student_march(float depth, float light, float ray[2])
{
    float through = (float)lom_double_exp(-(double)depth), sent = light * (1 - through);
    ray[1] = sent + through * ray[1];
    ray[0] = ray[0] * through;
}
