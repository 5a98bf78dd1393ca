/* A surface with waves as rays meet it: triangles around the eye, with normals from the waves themselves. */
#ifndef LOM_REFERENCE_WAVE_SURFACE_H
#define LOM_REFERENCE_WAVE_SURFACE_H

#include "reference/reference.h"
#include "scene/scene_water.h"

#include <lom/sea.h>

/* Where water is that rests at a place, less the place: names and signs of lom/sea.h. */
struct lom_wave_place {
    double dx, dy, dz;         /* displacement */
    double sx, sz, xx, xz, zz; /* derivatives of dy, and of (dx, dz), by x and z */
    bool overturns;            /* a wave plunges there: its upper side may look down */
};

struct lom_ray_wave {
    double kx, kz, phase;                 /* rad/m, radians at the time */
    double amplitude, across_x, across_z; /* metres */
};

struct lom_wave_surface {
    int count; /* of trochoids */
    struct lom_ray_wave wave[LOM_MAX_WAVES];
    lom_sea *sea; /* NULL: there is none */
    int cascade_count;
    lom_sea_cascade cascade[LOM_MAX_CASCADES];
    struct lom_surf_map surf; /* cells NULL: there is none */
    struct lom_surf_uniform surf_moment;
    struct lom_shallow_region shallow; /* first NULL: there is none */
    lom_shallow_view shallow_view;
    float (*shallow_texels)[4];
    double level, middle[2]; /* the waves' x and z count from there */
    double eye[2], fine;     /* the middle of the rings, and how far apart the first ones are */
    lom_vec3 *points;
    double (*rest)[2]; /* of each point: where its water is at rest */
    struct lom_ray_triangle *triangles;
    struct lom_ray_triangles above, below; /* the same, hit from there; nodes and order belong to `above` */
};

/* The trochoids or the sea, the surf and the shallow water of the scene at a time, and their surface in fine triangles:
 * rings around the place below the eye, a twelfth of the shortest wave apart or 0.006 of their radius, whichever is
 * more. Without triangles where the scene has no waves. False on failure; freed with lom_free_wave_surface. */
bool lom_make_wave_surface(struct lom_wave_surface *surface, const lom_reference *reference, lom_vec3 eye, double time,
                           lom_error *error);
void lom_free_wave_surface(struct lom_wave_surface *surface);

/* sea.c. Steps the sea of the scene's water to a time, or leaves the surface without one; the shortest wave in metres,
 * or 0. False on failure. */
bool lom_make_ray_sea(struct lom_wave_surface *surface, const lom_water_params *water, double time, double *shortest,
                      lom_error *error);
/* Adds the sea at the rest position (x, z) from the water's middle: its samples, linear between neighbours in double,
 * which is the surface that every model of water has. */
void lom_add_sea(struct lom_wave_place *place, const struct lom_wave_surface *surface, double x, double z);

/* shore.c. The surf and the shallow water of the scene at a time; the shortest wave gets no longer than theirs. False
 * on failure; what has been made is freed with lom_free_ray_shore, also then. */
bool lom_make_ray_shore(struct lom_wave_surface *surface, const lom_reference *reference, double time, double *shortest,
                        lom_error *error);
void lom_free_ray_shore(struct lom_wave_surface *surface);
/* Adds them at the rest position (x, z). */
void lom_add_shore(struct lom_wave_place *place, const struct lom_wave_surface *surface, double x, double z);

/* The crossing of a ray with the triangles, without a normal. */
bool lom_hit_wave_surface(const struct lom_wave_surface *surface, const struct lom_ray *ray, bool from_below,
                          double low, double high, struct lom_crossing *crossing);

/* The normal of the waves, upwards, by a part -0.5 .. 0.5 of the distance between rings further out than the place of a
 * crossing: there are waves between the rings that the triangles do not have. */
lom_vec3 lom_wave_surface_normal(const struct lom_wave_surface *surface, const double rest[2], double part);

/* The height of the surface over (x, z) itself: the rest position is found by iteration. */
double lom_wave_surface_height(const struct lom_wave_surface *surface, double x, double z);

#endif
