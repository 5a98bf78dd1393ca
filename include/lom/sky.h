/* lom/sky.h - the sky: its parameters, as the scene file's [sky] table gives them. */
#ifndef LOM_SKY_H
#define LOM_SKY_H

#include <lom/base.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A box of six pictures when faces[0] is not NULL (then all six are set), else one colour. Strings belong to the
 * scene. */
typedef struct lom_sky_params {
    uint32_t given;       /* nonzero when the scene has a [sky] table */
    const char *faces[6]; /* paths: right +x, left -x, top +y, bottom -y, front +z, back -z */
    double rotation;      /* radians about +y, counter-clockwise seen from above */
    double intensity;     /* factor on the pictures and on color */
    double color[3];      /* linear */
    const char *pattern;  /* as in the file; the reader has resolved it into faces */
} lom_sky_params;

#ifdef __cplusplus
}
#endif

#endif
