/* What the waves of a scene stand on, for every model that shows them. */
#ifndef LOM_SCENE_SCENE_WATER_H
#define LOM_SCENE_SCENE_WATER_H

#include "waves/wave_site.h"

#include <lom/scene.h>

/* Water 0 is the first, and there are other_water_count behind it. */
const lom_water_params *lom_water_of(const lom_scene *scene, size_t number);
/* Whether any of them is drawn. */
bool lom_has_water(const lom_scene *scene);

/* The site of the waves of a water over this bed; it points into the scene and the bed's heights. */
struct lom_wave_site lom_scene_wave_site(const lom_scene *scene, size_t number, const struct lom_bed *bed);

#endif
