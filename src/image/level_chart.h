/* A texture whose mip levels have a colour each, so that a picture shows which level was sampled where. */
#ifndef LOM_IMAGE_LEVEL_CHART_H
#define LOM_IMAGE_LEVEL_CHART_H

#include <lom/base.h>

/* A DDS file of BC1 blocks, size x size texels and every smaller level: checks of 4 texels, dark and bright, in the hue
 * of the level (from 0 on: gray, red, orange, yellow, green, cyan, blue, purple; then again). size: a power of two from 4
 * to 4096. data is NULL on failure. */
lom_bytes lom_make_level_chart(int size, lom_error *error);

#endif
