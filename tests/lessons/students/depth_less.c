/* Believes that less is nearer. */
#include "student.h"

bool student_is_nearer(float depth, float before)
{
    return depth < before;
}
