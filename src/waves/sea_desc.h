/* The sea that a scene's [water.waves] ask for. */
#ifndef LOM_WAVES_SEA_DESC_H
#define LOM_WAVES_SEA_DESC_H

#include <lom/sea.h>
#include <lom/waves.h>

/* Of waves of kind "sea", unresolved. A wind below 0.1 m/s and a factor on the heights below 1e-6 are a calm sea; a
 * choppiness below 1e-6 is none. */
lom_sea_desc lom_scene_sea(const lom_water_waves *waves);

#endif
