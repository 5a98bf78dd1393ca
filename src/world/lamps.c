/* The lamps of a world at a moment. In: their tables, the entities where they are. Out: those that shine, where they are
 * in the world, and how far their light reaches. Invariant: renderers and the reference have these numbers from here. */
#include "base/reserve.h"
#include "world/world.h"

#include <lom/geometry.h>

/* Metres: no lamp reaches less. */
static const double least_reach = 1e-9;
/* No light that is darker than this, in parts of white, is looked for. */
static const double darkest = 1e-3;

static double brightest(const double color[3], double bound)
{
    for (int i = 0; i < 3; i++)
        bound = color[i] > bound ? color[i] : bound;
    return bound;
}

/* Where c + l d + q d^2 = needed: the root of a parabola that rises, in the form that does not cancel. */
static double find_reach(const double attenuation[3], double needed)
{
    const double c = attenuation[0] - needed, l = attenuation[1], q = attenuation[2];
    if (c >= 0)
        return 0;
    if (l == 0 && q == 0)
        return 1e300;
    return -2 * c / (l + lom_double_sqrt(l * l - 4 * q * c));
}

/* The place of the entity that a lamp follows: as drawn, without its scale. NULL: it is not drawn. */
static const struct lom_placement *find_followed(const struct lom_world *world, const struct lom_moment *moment,
                                                 const lom_lamp *lamp)
{
    for (size_t i = 0; i < world->entity_count; i++)
        if (world->entities[i].entity == &world->scene->entities[lamp->followed - 1])
            return &moment->placements[i];
    return NULL;
}

static bool follow(const struct lom_world *world, struct lom_moment *moment, struct lom_placed_lamp *placed)
{
    const struct lom_placement *at = find_followed(world, moment, placed->lamp);
    if (at == NULL)
        return false;
    const lom_entity *entity = &world->scene->entities[placed->lamp->followed - 1];
    lom_mat4 turn = lom_rotation(lom_scene_entity_at(entity, moment->time).rotation);
    placed->direction = lom_transform_direction(&turn, placed->direction);
    const lom_vec3 arm = lom_transform_direction(&turn, placed->position);
    placed->position = (lom_vec3){ at->world_from_model.m[0][3] + arm.x, at->world_from_model.m[1][3] + arm.y,
                                   at->world_from_model.m[2][3] + arm.z };
    return true;
}

/* False when nothing comes from it. */
static bool place(const struct lom_world *world, struct lom_moment *moment, const lom_lamp *lamp,
                  struct lom_placed_lamp *placed)
{
    const lom_lamp at = lom_scene_lamp_at(lamp, moment->time);
    *placed = (struct lom_placed_lamp){ .lamp = lamp, .position = at.position, .direction = at.direction };
    double bright = 0;
    for (int i = 0; i < 3; i++) {
        placed->ambient[i] = at.ambient[i] * at.intensity;
        placed->diffuse[i] = at.diffuse[i] * at.intensity;
        placed->specular[i] = at.specular[i] * at.intensity;
    }
    bright = brightest(placed->specular, brightest(placed->diffuse, brightest(placed->ambient, bright)));
    placed->reach = lamp->kind == LOM_LAMP_INFINITE ? 1e300
                    : at.reach > 0                  ? at.reach
                                                    : find_reach(at.attenuation, bright / darkest);
    return lamp->on && bright > 0 && placed->reach > least_reach &&
           (lamp->followed == 0 || follow(world, moment, placed));
}

bool lom_place_lamps(const struct lom_world *world, struct lom_moment *moment, lom_error *error)
{
    const lom_scene *scene = world->scene;
    moment->lamp_count = 0;
    if (!lom_reserve(&moment->lamps, &moment->lamp_capacity, scene->lamp_count, sizeof *moment->lamps, error))
        return false;
    for (size_t i = 0; i < scene->lamp_count; i++)
        moment->lamp_count += place(world, moment, &scene->lamps[i], &moment->lamps[moment->lamp_count]);
    return true;
}
