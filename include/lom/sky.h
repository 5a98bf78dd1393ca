/* lom/sky.h - the sky: its parameters, as the scene file's [sky] table gives them. */
#ifndef LOM_SKY_H
#define LOM_SKY_H

#include <lom/image.h>

LOM_API_BEGIN

/* A box of six pictures when faces[0] is not NULL (then all six are set), else one colour. Strings belong to the
 * scene. */
typedef struct lom_sky_params {
    bool present;         /* the scene has a [sky] table */
    const char *faces[6]; /* paths: right +x, left -x, top +y, bottom -y, front +z, back -z */
    double rotation;      /* radians about +y, counter-clockwise seen from above */
    double intensity;     /* factor on the pictures and on color */
    double color[3];      /* linear */
    const char *pattern;  /* as in the file; the reader has resolved it into faces */
    const char *cube;     /* one file of all six faces, and what faces name then; NULL: a file each */
    bool gradient;        /* instead of color: from horizon to zenith, with haze low down and a glow around the sun */
    double zenith[3], horizon[3], haze[3], glow[3]; /* linear */
    double haze_height;                             /* sine of the elevation where the haze ends */
    bool sun;                                       /* its picture is drawn on a square that faces the eye */
    double sun_size;                                /* radians across that square */
    double sun_rays;                                /* 0..1, how strong its rays are */
} lom_sky_params;

/* The picture of the sun, R32F: 1 is the light's colour, 0 at the edge; rays 0..1. NULL on failure. */
lom_image *lom_make_sun_picture(int size, double rays, lom_error *error);

/* ---- made: a sky box ---- */

typedef struct lom_sky_box_desc {
    int size;                          /* pixels a side of a face, 8..4096; 0: 1024 */
    double sun_azimuth, sun_elevation; /* radians: 0 is north (-z), pi/2 east (+x); -pi/2..pi/2 above the horizon */
    double haziness;                   /* 0..100: 0 is clean air, 1 a fine day */
    double cloudiness;                 /* 0..1: 0 is a clear sky, 1 many clouds */
    uint64_t seed;
} lom_sky_box_desc;
/* Six pictures (RGB8 sRGB; right, left, top, bottom, front, back) that belong to the caller. On failure false, and all
 * are NULL. */
bool lom_make_sky_box(const lom_sky_box_desc *desc, lom_image *faces[6], lom_error *error);
/* The same as one picture, the cube of these faces, as a DDS file holds it; the caller's. NULL on failure. */
lom_image *lom_make_sky_cube(const lom_sky_box_desc *desc, lom_error *error);

LOM_API_END

#endif
