/* The surf of a scene. In: its terrain's heights, the water's level. Out: maps over the terrain. */
#include "scene/scene_water.h"

static double *find_depths(const lom_scene *scene, const struct lom_bed *bed, lom_error *error)
{
    const size_t count = ((size_t)bed->columns + 1) * ((size_t)bed->rows + 1);
    double *depth = lom_allocate(count, sizeof *depth, error);
    for (size_t i = 0; depth != NULL && i < count; i++)
        depth[i] = scene->water.level - (double)bed->heights[i];
    return depth;
}

bool lom_make_scene_surf(struct lom_surf_map *map, const lom_scene *scene, const struct lom_bed *bed, lom_error *error)
{
    *map = (struct lom_surf_map){ .cells = NULL };
    if (!(scene->surf.height > 0))
        return true;
    double *depth = find_depths(scene, bed, error);
    struct lom_surf_desc desc = { .width = bed->columns + 1,
                                  .height = bed->rows + 1,
                                  .spacing = { scene->terrain.size[0] / bed->columns,
                                               scene->terrain.size[1] / bed->rows },
                                  .depth = depth,
                                  .surf = scene->surf };
    bool done = depth != NULL && lom_make_surf_map(map, &desc, error);
    lom_release(depth);
    for (int i = 0; i < 2; i++)
        map->corner[i] = -scene->terrain.size[i] / 2;
    return done;
}
