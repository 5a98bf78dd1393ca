/* lom/reference.h - what every cheaper model is measured against: rays traced through a scene, and light followed
 * through a volume, in double precision, plainly and slowly. It shares the scene's data with the renderer and no code
 * of any model.
 *
 * The same bytes on every machine and for every number of threads; a pixel depends on nothing but the scene, the time
 * and its place in the whole frame.
 */
#ifndef LOM_REFERENCE_H
#define LOM_REFERENCE_H

#include <lom/cloud.h>
#include <lom/pipeline.h>
#include <lom/scene.h>

LOM_API_BEGIN

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
    double roughness;       /* mean square slope of ripples that are finer than any pixel: each ray meets its own */
    double absorption[3];   /* 1/m for red, green and blue */
    double color[3];        /* radiance of endless depths, seen from straight above */
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
 * reflected by Fresnel's equations, refraction by Snell's law, absorption by Beer and Lambert; its waves
 * ([water.waves], [surf], [shallow]) as fine triangles, else its normal map. Sunlight reaches the bed through a level
 * surface, and there is no foam. Light and entities with key frames stand where they are at 0 s; lom_trace_scene places
 * them for its time. */
lom_reference *lom_create_reference(const lom_scene *scene, lom_error *error);
void lom_free_reference(lom_reference *reference); /* NULL is allowed */
/* What was passed over while loading, as lom_renderer_warning says. */
const lom_warnings *lom_reference_warnings(const lom_reference *reference);

/* The water of the scene's [water] table as the reference has it: to be changed and put back. */
lom_reference_water lom_get_reference_water(const lom_reference *reference);
/* Puts another surface in its place, which is then the only one. False (and nothing changed) for numbers that are not finite, an index or step that
 * is not above 0, or absorption below 0. */
bool lom_set_reference_water(lom_reference *reference, const lom_reference_water *water, lom_error *error);

/* How a ray sees the scene: the radiance (linear) that comes from `direction` (unit length) to `origin`, nothing nearer
 * than `near_distance`. depth: how many times a path may be divided or mirrored at water; after that water is not seen.
 * All waters of the scene are there. Without the waves of [water.waves] and the liquids of [[fluid]], which
 * lom_trace_scene makes for its camera and its time. */
lom_vec3 lom_trace_ray(const lom_reference *reference, lom_vec3 origin, lom_vec3 direction, double near_distance,
                       double time, int depth);

typedef struct lom_reference_frame {
    int width, height;             /* of the whole frame */
    lom_rect crop;                 /* the part that is traced and returned; width 0: all of it */
    double time;                   /* seconds */
    const lom_camera_view *camera; /* the eye, instead of the scene's at that time; NULL: the scene's */
    int samples; /* of a pixel, 1..65536: Hammersley points, turned by an amount that belongs to the pixel; 1: its
                          middle */
    int depth;   /* as in lom_trace_ray, 0..64 */
    int threads; /* 0: as many as the machine allows */
} lom_reference_frame;

/* The picture, linear RGB32F: every pixel the mean of its samples over its area. Rows are shared out to threads. NULL
 * on failure; freed with lom_free_image. */
lom_image *lom_trace_scene(const lom_reference *reference, const lom_reference_frame *frame, lom_error *error);

/* ---- a volume: Monte-Carlo path tracing ---- */

/* How an encounter turns light, as a density over the sphere (1/sr). */
typedef struct lom_reference_phase {
    lom_cloud_phase kind;
    double forward, backward,
        blend; /* mean cosines of the lobes, cut to +-0.999; LOM_PHASE_DUAL: share of the second */
} lom_reference_phase;

/* The density for the cosine of the angle by which light is turned (1: it goes straight on). Its integral over the
 * sphere is 1. Isotropic 1/4pi; Rayleigh 3/16pi (1 + c^2); L. Henyey, J. Greenstein, Astrophys. J. 93 (1941). */
double lom_phase_density(const lom_reference_phase *phase, double cosine);
/* A cosine drawn from it by two uniform numbers in [0, 1); the second chooses the lobe. */
double lom_phase_cosine(const lom_reference_phase *phase, double uniform, double choice);

typedef struct lom_reference_volume_desc {
    const lom_image *density; /* R8, R16 or R32F with depth: unorm 0..1; x right, y up (row 0 is the lowest), z towards
                                 +z. Floats below 0 and NaN are 0. A voxel is the density at its centre, trilinear
                                 between, the edge's outside the first and last centre */
    lom_vec3 low, high;       /* its box, metres */
    double extinction;        /* 1/m where the density is 1 */
    const lom_image
        *detail; /* R8, a cube that repeats itself every detail_size metres from `low` on, a voxel at its low
                                 corner and trilinear between: n of 0..1 makes of a density d what is above 0 of (d - s n) / (1 - s
                                 n), s the detail_strength, below 1. NULL: none */
    double detail_strength, detail_size;
    double albedo[3]; /* share of what meets it that is scattered, 0..1 */
    lom_reference_phase phase;
    const lom_transfer_point *transfer; /* what each density looks like, as lom_make_transfer_function takes it; NULL:
                                           its extinction is itself, and it is white */
    size_t transfer_count;
    lom_volume_look look; /* of it: what is met scatters by the phase function, sends as a Lambert surface across the
                             gradient of the density does, or ends the path with its colour */
} lom_reference_volume_desc;

typedef struct lom_reference_volume lom_reference_volume;
/* Copies the density. NULL for a box without extent, a format that is none of these, negative or infinite extinction, an
 * albedo outside 0..1, or what is no transfer function. Freed with lom_free_reference_volume. */
lom_reference_volume *lom_create_reference_volume(const lom_reference_volume_desc *desc, lom_error *error);
void lom_free_reference_volume(lom_reference_volume *volume); /* NULL is allowed */

/* Integral of the extinction from origin + from d to origin + to d, d the unit vector along direction: exact but for
 * rounding, since between two planes of voxels the density is a cubic of the distance; with a transfer function the
 * density counts as even over each quarter of such a way, with detail as a cubic over each. 0 for a direction without length. */
double lom_volume_optical_depth(const lom_reference_volume *volume, lom_vec3 origin, lom_vec3 direction, double from,
                                double to);

/* The light around a volume. */
typedef struct lom_reference_light {
    lom_vec3 to_sun; /* unit length */
    double sun[3]; /* irradiance across the sun's beam, in units of radiance x sr: pi for a directional light that makes
                      a white diffuse surface facing it 1 */
    double (*sun_share)(const void *context,
                        lom_vec3 place); /* of the sun that comes to a place, 0..1, for all but what the
                                                                 volume keeps off; NULL: 1. Pure */
    const void *context;
    lom_vec3 (*surroundings)(const void *context, lom_vec3 direction); /* radiance from afar; NULL: black. Pure */
} lom_reference_light;

typedef struct lom_volume_rays {
    lom_vec3 origin, direction; /* of any length but 0 */
    double far;                 /* metres behind which nothing is seen; infinity is allowed */
    int paths;                  /* 1..2^24 */
    int events;                 /* scatterings of a path, 0..65536 */
    uint64_t key;               /* of its random numbers: the same key, the same result */
} lom_volume_rays;

typedef struct lom_volume_light {
    double scattered[3];  /* radiance that reaches the origin after at least one scattering, the mean of the paths */
    double error[3];      /* its standard error */
    double transmittance; /* of what lies behind: exact; what is seen is scattered + transmittance x background */
    bool cut;             /* a path was ended by `events`, or got lost in rounding: scattered lacks what followed */
} lom_volume_light;

/* Delta tracking (E. Woodcock and others, ANL-7050, 1965) from encounter to encounter, with the sun's light added at
 * each by its exact transmittance (next-event estimation), and Russian roulette for paths below a tenth. False for a
 * direction without length, an origin that is not finite, or counts out of range. */
bool lom_trace_volume(const lom_reference_volume *volume, const lom_reference_light *light, const lom_volume_rays *rays,
                      lom_volume_light *out, lom_error *error);

LOM_API_END

#endif
