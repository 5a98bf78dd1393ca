/* The vertices of terrain row by row, and their heights alone, for callers that keep them in another form than a mesh. */
#ifndef LOM_GEOMETRY_TERRAIN_H
#define LOM_GEOMETRY_TERRAIN_H

#include <lom/geometry.h>

/* Row `row` of the map: map->width vertices as lom_make_terrain has them, valid during the call. */
typedef void lom_terrain_row(void *context, int row, const lom_mesh_vertex *vertices);

/* Calls visit for every row, from 0 on; false (and perhaps not every row) when lom_make_terrain would fail. */
bool lom_visit_terrain(const lom_image *map, double width, double length, double height, double base,
                       lom_terrain_row *visit, void *context, lom_error *error);

/* The same of rows first to end - 1 alone, for those who share them out; size: width and length. */
bool lom_visit_terrain_rows(const lom_image *map, const double size[2], double height, double base, int first, int end,
                            lom_terrain_row *visit, void *context, lom_error *error);

/* The heights over the base of map->width x map->height vertices, row by row: those that lom_visit_terrain visits with
 * the base 0. False when lom_make_terrain would fail. */
bool lom_read_terrain_heights(const lom_image *map, const double size[2], double height, float *heights,
                              lom_error *error);

#endif
