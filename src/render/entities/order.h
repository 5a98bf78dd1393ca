/* What is transparent from back to front: things by their distance from where a view's rays come from. */
#ifndef LOM_RENDER_ENTITIES_ORDER_H
#define LOM_RENDER_ENTITIES_ORDER_H

#include "render/entities/entities.h"

/* Where a view's rays come from. */
struct lom_order lom_order_of(const struct lom_scene_view *view);
/* What grows with the distance: its square, or with parallel rays how far ahead of the eye a place is. */
double lom_distance_of(const struct lom_order *order, lom_vec3 place);
/* The farthest first, equally far ones as they stood, by all workers; `list` has room for as many once more. Returns where
 * they are. */
struct lom_distant *lom_sort_distant(lom_device *device, struct lom_distant *list, size_t count);
/* The transparent triangles of an entity in their order, and their indices; of the materials those of backs come after
 * those of fronts. What the pass before has ordered alike is not ordered again. */
const struct lom_distant *lom_order_triangles(lom_device *device, struct lom_drawn_entity *entity,
                                              const struct lom_order *order);

#endif
