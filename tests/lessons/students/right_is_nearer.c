/* Right: reversed depth. */
#include "student.h"

bool student_is_nearer(float depth, float before)
{
    return before < depth;
}
