/* Impostors: a cloud's picture on a plate, shown again while that is close enough. What is decided here follows from
 * places and sizes alone; the pictures are drawn by impostor_draw.c. Vectors are less the cloud's middle. */
#ifndef LOM_CLOUD_IMPOSTOR_H
#define LOM_CLOUD_IMPOSTOR_H

#include <lom/cloud.h>

/* How a picture of the whole frame looks at the clouds. */
struct lom_impostor_eye {
    lom_vec3 right, up, forward; /* unit vectors; right and up are those of the picture */
    double near_plane;
    double tangent[2]; /* of the picture's right and upper edge */
    double pixel;      /* tangent that a pixel covers in its middle */
    int height;        /* pixels */
};

/* Where a plate is and what it was made from. */
struct lom_plate {
    lom_vec3 eye, right, up, forward;
    double whole_low[2], whole_high[2]; /* tangents along right and up between which the box was seen */
    double low[2], high[2];             /* the window that the texels cover: what of that was in view, and a margin */
    double distance;                    /* along forward, of the plane that shows it */
    int width, height;                  /* texels */
    double extent;                      /* pixels of the frame: the longer side of what the cloud's box covers */
    double pitch;                       /* pixels a texel covered when it was made, in the middle of its plane */
};

/* The edge of a square plate by the reference work's rule: the next power of two of the smaller extent times 3 x 64 /
 * window height, at most `largest`. Extents in pixels. */
int lom_reference_plate_edge(double width, double height, int window_height, int largest);
/* By bit saturation; 0 and 1 give 1, above 2^31 gives 0. */
uint32_t lom_next_power_of_two(uint32_t n);

/* The window through which corners are seen from eye along the axes, and the nearest distance along forward; false
 * when one of them is not beyond the near plane. */
bool lom_find_window(const lom_vec3 corner[8], lom_vec3 eye, const lom_vec3 axes[3], double near_plane,
                     struct lom_plate *plate);
/* The reference work's plate: upright to the view, in the plane of the nearest corner. False: the cloud straddles the
 * near plane. */
bool lom_make_reference_plate(const lom_vec3 corner[8], lom_vec3 eye, const struct lom_impostor_eye *view, int largest,
                              struct lom_plate *plate);
/* Ours: facing the eye, through the middle, of the part of the box that a picture wider and taller by 0.15 would show.
 * `scale` texels a pixel, but none finer than `finest` metres at the middle, at most `largest` along an edge; a plate
 * of the whole box has a border of one empty texel. */
bool lom_make_facing_plate(const lom_vec3 corner[8], lom_vec3 eye, const struct lom_impostor_eye *view, double scale,
                           double finest, int largest, struct lom_plate *plate);
/* The bounds of what a picture from eye, its tangents times (1 + margin), shows of the whole box on the plate's plane.
 * False: nothing of it. */
bool lom_find_visible(const struct lom_plate *plate, lom_vec3 eye, const struct lom_impostor_eye *view, double margin,
                      double low[2], double high[2]);
/* The whole picture, drawn anew each frame: what a cloud around the eye gets. */
void lom_make_screen_plate(lom_vec3 eye, const struct lom_impostor_eye *view, double scale, int width, int height,
                           struct lom_plate *plate);

/* How far, in pixels, a corner of the cloud's box is at most from where the plate shows it: its place on the plate's
 * plane as seen from the old eye, and itself, both seen from the new one. An angle a in the direction d counts as a /
 * (pixel cos^2(d, forward)), the most that a perspective picture stretches it, with d no farther out than the picture's
 * corner. */
double lom_parallax_error(const struct lom_plate *plate, const lom_vec3 corner[8], lom_vec3 eye,
                          const struct lom_impostor_eye *view);
/* Pixels that a texel covers now. */
double lom_plate_pitch(const struct lom_plate *plate, lom_vec3 eye, const struct lom_impostor_eye *view);

/* Why a plate is made anew. */
enum lom_refresh {
    LOM_REFRESH_NONE = 0,
    LOM_REFRESH_FIRST, /* there is none */
    LOM_REFRESH_VIEW,
    LOM_REFRESH_SIZE,
    LOM_REFRESH_NEAR,
    LOM_REFRESH_SUN,
    LOM_REFRESH_SHAPE
};

/* The reference work's rule: cosine of the angle between the directions of view below 0.99999, or the eye nearer than
 * twice the cloud's longest side. */
enum lom_refresh lom_reference_refresh(const struct lom_plate *plate, lom_vec3 eye, const struct lom_impostor_eye *view,
                                       double longest);
/* Ours: the parallax above the bound, a texel that has grown by more than the bound or shrunk to less than half, or a
 * part of the box in view that the plate does not cover. */
enum lom_refresh lom_bounded_refresh(const struct lom_plate *plate, const lom_vec3 corner[8], lom_vec3 eye,
                                     const struct lom_impostor_eye *view, double bound);

/* A switch with hysteresis: on when value is below `on`, off when it is above `off` (off >= on), as it was between. */
bool lom_switch(bool was_on, double value, double on, double off);

/* The reference work's alpha misting: distance to the middle in parts of twice the longest side, within 0.8..1. */
double lom_misting(double distance, double longest);

#endif
