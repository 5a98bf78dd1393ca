/* A sky of many clouds, from what [clouds] says of them. */
#ifndef LOM_CLOUD_CLOUD_SKY_H
#define LOM_CLOUD_CLOUD_SKY_H

#include <lom/cloud.h>

/* Adds the clouds of [clouds] (count, oktas or metar) to the `*count` that `clouds` holds, which has room for
 * LOM_MAX_SKY more: copies of `pattern`, each of a kind, seed, size, place and turn of its own. Where they are follows
 * from the numbers of [clouds] alone. False when memory runs out or there would be more than LOM_MAX_SKY. */
bool lom_place_sky(const lom_clouds *sky, const lom_cloud *pattern, lom_cloud *clouds, size_t *count, lom_error *error);
/* Whether [clouds] asks for any. */
bool lom_has_sky(const lom_clouds *sky);

#endif
