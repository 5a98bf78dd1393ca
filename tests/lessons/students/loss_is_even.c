/* Subtracts the depth. */
#include "student.h"

void student_march(float depth, float light, float ray[2])
{
    float through = depth < 1 ? 1 - depth : 0, sent = 1 - through;
    ray[1] = ray[1] + sent * light * ray[0];
    ray[0] = ray[0] * through;
}
