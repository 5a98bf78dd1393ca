/* The files of a made sky. */
#ifndef LOM_CLI_MAKE_SKY_H
#define LOM_CLI_MAKE_SKY_H

#include <lom/sky.h>

/* A sky box: six pictures where the path's name has a %s, one cube where it ends in .dds. False with a sentence. */
bool lom_write_sky_box(const lom_sky_box_desc *desc, const char *path, lom_error *error);

#endif
