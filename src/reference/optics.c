/* Reflection and refraction at a smooth boundary. In: directions, normals, relative indices. Out: the reflected share,
 * mirrored and refracted directions. */
#include "base/numbers.h"
#include "reference/vectors.h"

#include <lom/reference.h>

static bool is_index(double index)
{
    return index > 0 && index < __builtin_inf();
}

/* The squared cosine behind the boundary, by Snell's law; negative under total internal reflection. */
static double squared_cosine_behind(double cosine, double index)
{
    double sine = (1 - cosine) * (1 + cosine) / index;
    return 1 - sine / index;
}

double lom_reference_fresnel(double cosine, double index)
{
    double in_front = unit_interval(cosine);
    if (!is_index(index) || index == 1)
        return 0;
    double squared = squared_cosine_behind(in_front, index);
    if (!(squared > 0) || in_front == 0)
        return 1;
    double behind = lom_double_sqrt(squared);
    double upright = (in_front - index * behind) / (in_front + index * behind);
    double along_plane = (index * in_front - behind) / (index * in_front + behind);
    return (upright * upright + along_plane * along_plane) / 2;
}

lom_vec3 lom_reference_mirror(lom_vec3 d, lom_vec3 n)
{
    return along(d, n, -2 * dot(d, n));
}

bool lom_reference_refract(lom_vec3 d, lom_vec3 n, double index, lom_vec3 *out)
{
    double in_front = lom_smaller(lom_larger(-dot(d, n), 0), 1);
    if (!is_index(index))
        return false;
    if (index == 1) {
        *out = d;
        return true;
    }
    double squared = squared_cosine_behind(in_front, index);
    if (!(squared > 0))
        return false;
    *out = unit(along(scaled(d, 1 / index), n, in_front / index - lom_double_sqrt(squared)));
    return true;
}
