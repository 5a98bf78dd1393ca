/* The surf of a site. In: the heights of its bed, the level. Out: maps over the bed. */
#include "waves/wave_site.h"

static double *find_depths(const struct lom_wave_site *site, lom_error *error)
{
    const struct lom_bed *bed = &site->bed;
    const size_t count = ((size_t)bed->columns + 1) * ((size_t)bed->rows + 1);
    double *depth = lom_allocate(count, sizeof *depth, error);
    for (size_t i = 0; depth != NULL && i < count; i++)
        depth[i] = site->level - bed->base - (double)bed->heights[i];
    return depth;
}

bool lom_make_site_surf(struct lom_surf_map *map, const struct lom_wave_site *site, lom_error *error)
{
    const struct lom_bed *bed = &site->bed;
    *map = (struct lom_surf_map){ .cells = NULL };
    if (!(site->surf->height > 0))
        return true;
    double *depth = find_depths(site, error);
    struct lom_surf_desc desc = { .width = bed->columns + 1,
                                  .height = bed->rows + 1,
                                  .spacing = { bed->size[0] / bed->columns, bed->size[1] / bed->rows },
                                  .depth = depth,
                                  .surf = *site->surf };
    bool done = depth != NULL && lom_make_surf_map(map, &desc, error);
    lom_release(depth);
    for (int i = 0; i < 2; i++)
        map->corner[i] = -bed->size[i] / 2;
    return done;
}
