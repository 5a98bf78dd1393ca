/* Takes the depth for the share. */
#include "student.h"

void student_march(float depth, float light, float ray[2])
{
    float through = (float)lom_double_exp(-(double)depth), sent = depth;
    ray[1] = ray[1] + light * sent * ray[0];
    ray[0] = ray[0] * through;
}
