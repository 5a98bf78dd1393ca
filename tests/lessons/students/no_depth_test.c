/* Takes everything. */
#include "student.h"

bool student_is_nearer(float depth, float before)
{
    return depth >= 0 || before >= 0;
}
