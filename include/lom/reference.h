/* lom/reference.h - what every cheaper model is measured against: rays traced through a scene, and light followed
 * through a volume, in double precision, plainly and slowly. It shares the scene's data with the renderer and no code
 * of any model.
 *
 * The same bytes on every machine and for every number of threads; a pixel depends on nothing but the scene, the time
 * and its place in the whole frame.
 */
#ifndef LOM_REFERENCE_H
#define LOM_REFERENCE_H

#include <lom/pipeline.h>
#include <lom/scene.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- optics ---- */

/* The reflected share of unpolarised light at a smooth boundary, for the cosine of the angle of incidence (0..1,
 * clamped) and index = that of the medium behind / that of the medium in front (Fresnel's equations; M. Born, E. Wolf,
 * Principles of Optics, 1.5.2). 1 under total internal reflection and at grazing incidence; ((index - 1) / (index +
 * 1))^2 upright. An index that is not a finite number above 0 reflects nothing. */
double lom_reference_fresnel(double cosine, double index);

/* d mirrored at the plane with unit normal n. */
lom_vec3 lom_reference_mirror(lom_vec3 d, lom_vec3 n);

/* Snell's law: the unit direction d, coming from the side that the unit normal n points to (d.n <= 0), behind the
 * boundary. index as above. False, and *out untouched, under total internal reflection. index 1 gives d itself. */
bool lom_reference_refract(lom_vec3 d, lom_vec3 n, double index, lom_vec3 *out);

/* ---- water ---- */

/* A surface of water: y = height(x, z, time) over a rectangle. Both functions are pure. */
typedef struct lom_reference_water {
    double low[2], high[2]; /* x and z of the rectangle, metres; low > high: there is no water */
    double lowest, highest; /* the bounds of height; equal for a plane */
    double step;            /* metres along a ray in which it crosses the surface at most once; a plane needs none */
    double index;           /* of refraction, against air */
    double absorption[3];   /* 1/m for red, green and blue */
    double color[3];        /* radiance of endless depths */
    const void *context;    /* for the functions; outlives the reference */
    double (*height)(const void *context, double x, double z, double time); /* NULL: the plane y = lowest */
    void (*slope)(const void *context, double x, double z, double time, double slope[2]); /* dy/dx and dy/dz; NULL: that
                                         of the scene's normal map, or flat */
} lom_reference_water;

/* ---- a scene ---- */

typedef struct lom_reference lom_reference;

/* Loads everything that the scene names, and makes a hierarchy over all triangles. The scene is not copied: it outlives
 * the reference. NULL on failure; freed with lom_free_reference.
 *
 * The geometry is exactly what the renderer draws: the triangles of the terrain and of the visible entities, seen from
 * their front sides alone, their materials and textures under the scene's directional light and ambient light with
 * Phong's reflection for each sample, no shadows, and the sky behind. Dials of [quality] that make the renderer cheaper
 * are not looked at. Water is what the scene's [water] table describes, by what physics says of it: the share that is
 * reflected by Fresnel's equations, refraction by Snell's law, absorption by Beer and Lambert. */
lom_reference *lom_create_reference(const lom_scene *scene, lom_error *error);
void lom_free_reference(lom_reference *reference); /* NULL is allowed */

/* The water of the scene's [water] table as the reference has it: to be changed and put back. */
lom_reference_water lom_get_reference_water(const lom_reference *reference);
/* Puts another surface in its place. False (and nothing changed) for numbers that are not finite, an index or step that
 * is not above 0, or absorption below 0. */
bool lom_set_reference_water(lom_reference *reference, const lom_reference_water *water, lom_error *error);

/* How a ray sees the scene: the radiance (linear) that comes from `direction` (unit length) to `origin`, nothing nearer
 * than `near_distance`. depth: how many times a path may be divided or mirrored at water; after that water is not seen.
 */
lom_vec3 lom_trace_ray(const lom_reference *reference, lom_vec3 origin, lom_vec3 direction, double near_distance,
                       double time, int depth);

typedef struct lom_reference_frame {
    int width, height; /* of the whole frame */
    lom_rect crop;     /* the part that is traced and returned; width 0: all of it */
    double time;       /* seconds */
    int samples;       /* of a pixel, 1..65536: Hammersley points, turned by an amount that belongs to the pixel; 1: its
                          middle */
    int depth;         /* as in lom_trace_ray, 0..64 */
    int threads;       /* 0: as many as the machine allows */
} lom_reference_frame;

/* The picture, linear RGB32F: every pixel the mean of its samples over its area. Rows are shared out to threads. NULL
 * on failure; freed with lom_free_image. */
lom_image *lom_trace_scene(const lom_reference *reference, const lom_reference_frame *frame, lom_error *error);

#ifdef __cplusplus
}
#endif

#endif
