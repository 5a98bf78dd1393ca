/* What the maps of a lamp's shadow look at. In: a lamp at a moment. Out: the axes of their faces, and how far from the lamp
 * they begin. Invariant: renderers and the reference have these numbers from here. */
#include "base/numbers.h"
#include "world/world.h"

/* Up to here one face sees a whole cone; its texels are then no wider than 4 times (1 / cos^2 60) those of its middle. */
static const double widest = 60;

struct lom_lamp_faces lom_find_lamp_faces(const struct lom_placed_lamp *placed)
{
    const lom_lamp *lamp = placed->lamp;
    if (lamp->kind == LOM_LAMP_SPOT && lamp->cutoff <= widest * lom_radians_per_degree * (1 + 1e-12)) {
        const double sine = lom_double_sin(lamp->cutoff), cosine = lom_double_cos(lamp->cutoff);
        return (struct lom_lamp_faces){ 1, lom_larger(sine / cosine, 1e-3), { placed->direction } };
    }
    return (struct lom_lamp_faces){
        LOM_LAMP_FACES, 1, { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 }, { 0, 0, -1 } }
    };
}

double lom_lamp_clearance(const struct lom_placed_lamp *lamp, lom_vec3 away)
{
    const struct lom_lamp_faces faces = lom_find_lamp_faces(lamp);
    double cosine = 0;
    for (int i = 0; i < faces.count; i++)
        cosine = lom_larger(cosine, lom_vec3_dot(faces.axis[i], away));
    return cosine > 0 ? lamp->lamp->shadow_from / cosine : 0;
}
