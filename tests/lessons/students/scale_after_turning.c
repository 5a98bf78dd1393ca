/* T S R. */
#include "student.h"

lom_mat4 student_model_matrix(lom_vec3 offset, lom_vec3 turn, lom_vec3 factor)
{
    lom_mat4 m = lom_rotation(turn);
    for (int i = 0; i < 3; i++) {
        double by = i == 0 ? factor.x : i == 1 ? factor.y : factor.z;
        for (int k = 0; k < 3; k++)
            m.m[i][k] *= by;
        m.m[i][3] = i == 0 ? offset.x : i == 1 ? offset.y : offset.z;
    }
    return m;
}
