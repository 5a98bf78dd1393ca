/* The rays of a picture as a uniform. In: a projection and a view in double. Out: floats. */
#include "shading/eye.h"

static void set3(float out[3], lom_vec3 v, double factor)
{
    out[0] = (float)(v.x * factor);
    out[1] = (float)(v.y * factor);
    out[2] = (float)(v.z * factor);
}

/* With clip z = p22 z + p23 and w = 1 depth d lies (p23 - d) / p22 along the view axis, where the reach is `longer`
 * times as much. */
struct lom_eye_uniform lom_find_eye(const lom_mat4 *projection, const lom_mat4 *view, double pixel)
{
    const double(*p)[4] = projection->m;
    const lom_view_rays rays = lom_find_view_rays(projection, view);
    struct lom_eye_uniform eye = { .parallel = rays.parallel, .pixel = (float)pixel, .near_plane = (float)p[2][3] };
    if (!rays.parallel)
        return eye;
    const double longer = lom_vec3_length(rays.along);
    eye.near_plane = (float)((p[2][3] - 1) / p[2][2]);
    eye.far_reach = (float)(p[2][3] / p[2][2] * longer);
    eye.depth_reach = (float)(longer / p[2][2]);
    set3(eye.along, rays.along, 1 / longer);
    set3(eye.plane, rays.ahead, longer);
    return eye;
}
