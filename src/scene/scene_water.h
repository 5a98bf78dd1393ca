/* What the waves of a scene stand on, for every model that shows them. */
#ifndef LOM_SCENE_SCENE_WATER_H
#define LOM_SCENE_SCENE_WATER_H

#include "waves/wave_site.h"

#include <lom/scene.h>

/* Whether the scene's water has no waves of its own, so that its normal map is its surface. */
bool lom_is_still(const lom_scene *scene);

/* The site of the scene's waves over this bed; it points into the scene and the bed's heights. */
struct lom_wave_site lom_scene_wave_site(const lom_scene *scene, const struct lom_bed *bed);

#endif
