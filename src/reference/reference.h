/* A scene as the reference sees it: every triangle in the world, materials, pictures, light and water, in double. */
#ifndef LOM_REFERENCE_REFERENCE_H
#define LOM_REFERENCE_REFERENCE_H

#include "reference/textures.h"
#include "reference/triangles.h"
#include "reference/volume.h"
#include "world/world.h"

#include <lom/reference.h>

enum { LOM_NO_PICTURE = -1 };
#define LOM_TERRAIN_MATERIAL UINT32_MAX /* of the triangles of the ground */

struct lom_ray_material {
    lom_vec3 ambient, diffuse, specular, emissive;
    double shininess;
    int picture;                                           /* multiplies ambient and diffuse */
    int emissive_map, specular_map, gloss_map, normal_map; /* LOM_NO_PICTURE: none */
    double opacity;
    int opacity_map; /* multiplies it, by its alpha or its red */
    bool opacity_is_in_alpha, is_transparent;
    uint32_t back; /* of the material of its other side */
};

/* What a corner of a triangle has besides its place, interpolated linearly. */
struct lom_ray_corner {
    lom_vec3 normal; /* not normalised */
    lom_vec3 color;
    double u, v;
};

struct lom_ray_picture {
    struct lom_picture picture;
    const char *path; /* the scene's or the world's; empty: of the flow map that is made */
    bool color;
};

struct lom_ray_layer {
    int picture;
    double scale[2]; /* repetitions a metre along x and z */
    double below;    /* mean brightness of the picture below a layer with grain */
};

struct lom_wave_surface;
struct lom_ray_cloud;
struct lom_ray_liquids;

struct lom_crossing;

struct lom_ray_water {
    lom_reference_water at;
    int normal_map, flow_map;
};

struct lom_reference {
    struct lom_world *world;
    bool owns_world;
    bool own_water;           /* put in by lom_set_reference_water */
    struct lom_moment moment; /* of the time at which it was placed */
    const lom_scene *scene;   /* of the moment */
    struct lom_ray_triangles opaque;
    struct lom_ray_triangles transparent; /* both sides of them are seen; the triangles behind those of `opaque` */
    lom_vec3 *points;
    struct lom_ray_corner *corners; /* of each point */
    struct lom_ray_triangle *triangles;
    size_t point_count, triangle_count;

    struct lom_ray_material *materials;
    size_t material_count;
    struct lom_ray_picture *pictures;
    size_t picture_count, picture_capacity;

    int ground_columns, ground_rows; /* the first points are the terrain's samples, row by row */
    struct lom_ray_material ground;
    struct lom_ray_layer ground_texture, ground_detail, ground_normals, *layers;
    struct lom_picture sky;      /* no image: one colour */
    lom_image *sky_faces;        /* its image */
    double sky_sine, sky_cosine; /* of the angle that turns directions back into the box */
    lom_vec3 to_light, light, ambient, ground_light;
    double slant; /* metres that sunlight goes in the water for each metre down */

    lom_reference_water water; /* bounds empty (low > high): there is none */
    int normal_map, flow_map;

    struct lom_ray_cloud *clouds;
    size_t cloud_count;
    const struct lom_wave_surface *waves;  /* of a frame, or NULL: still water */
    const struct lom_ray_liquids *liquids; /* of a frame, or NULL: none */
    size_t number;                         /* of the water that water, maps, waves and slant are of */
    struct lom_ray_water other_waters[LOM_MAX_OTHER_WATERS];
    const struct lom_reference *others; /* the same with each of the other waters: a frame's, or its own */
    struct lom_reference *own_others;   /* made with it, without waves */
    size_t other_count;
};

/* The reference of a world (reference.c), which outlives it. NULL on failure. */
lom_reference *lom_create_reference_of(struct lom_world *world, lom_error *error);
/* The same scene, which it shares, with another of its waters in the place of the first (waters.c). */
void lom_set_other_water(lom_reference *other, const lom_reference *reference, size_t number);
/* Reference 0 is the one that is given, the others are those of its other waters. */
const lom_reference *lom_reference_with(const lom_reference *reference, size_t number);
/* That of the water over a place, else the first. */
const lom_reference *lom_reference_around(const lom_reference *reference, lom_vec3 place, double time);
/* lom_cross_water of all waters, or of one that the ray is in; the one that is met, NULL: none is. */
const lom_reference *lom_cross_waters(const lom_reference *reference, const struct lom_ray *ray, double time,
                                      const lom_reference *inside, double low, double high,
                                      struct lom_crossing *crossing);
/* place.c: the colour of its water and how its light comes down. */
void lom_light_reference(lom_reference *reference);
/* Loading (load.c): materials and pictures, what does not move. */
bool lom_load_reference(lom_reference *reference, lom_error *error);
/* Placing (place.c): the light and the triangles at a time. What was placed before is not freed. False on failure; what
 * has been made is freed with lom_free_placed, also then. */
bool lom_place_reference(lom_reference *reference, double time, lom_error *error);
void lom_free_placed(lom_reference *reference);

/* Shading (shade.c): the light that an opaque surface sends back along a ray. */
lom_vec3 lom_shade_hit(const lom_reference *reference, const struct lom_ray *ray, const struct lom_ray_hit *hit,
                       double time);
/* The same of a transparent one, of either side; *opacity: the share of what is behind it that it hides. `hit` has a number
 * of reference->transparent. */
lom_vec3 lom_shade_transparent(const lom_reference *reference, const struct lom_ray *ray, const struct lom_ray_hit *hit,
                               double time, double *opacity);
/* What the matter of a liquid sends back where light comes to its surface; *highlight: what that shows of the lights. */
lom_vec3 lom_shade_liquid(const lom_reference *reference, const struct lom_ray_material *material, lom_vec3 place,
                          lom_vec3 normal, lom_vec3 to_eye, double time, lom_vec3 *highlight);
/* Reflection (reflect.c): sun, ambient light and lamps at a place. */
struct lom_incident {
    lom_vec3 to_light, light; /* the sun's, as it comes there */
    lom_vec3 ambient, ground; /* on what faces up and down */
};
struct lom_facing {
    lom_vec3 place, normal, to_eye, albedo;
    double depth; /* metres of water above */
};
lom_vec3 lom_reflect_light(const lom_reference *reference, const struct lom_incident *in,
                           const struct lom_ray_material *m, const struct lom_facing *at);
/* Beer and Lambert: what is left behind a path of this length. */
lom_vec3 lom_transmitted(const double absorption[3], double path);
/* What of a lamp's colours comes to a place (lamps.c), the unit vector to it and how far it is (1e300: at infinity). */
double lom_lamp_share_at(const struct lom_placed_lamp *lamp, lom_vec3 place, lom_vec3 *to_lamp, double *distance);
/* Whether a lamp's shadow leaves a place its light, which comes along a unit vector from so far (shadow.c). */
bool lom_lamp_is_open(const lom_reference *reference, const struct lom_placed_lamp *lamp, lom_vec3 place,
                      lom_vec3 to_lamp, double distance);
/* Whether the sun's beam comes to a place under `depth` metres of water: along its bent way to the surface, then straight. */
bool lom_sun_is_open(const lom_reference *reference, lom_vec3 place, double depth, lom_vec3 to_light);
/* What liquids leave of each colour of light that comes straight to a place along a unit vector, from so far
 * (liquids.c). */
lom_vec3 lom_liquids_leave(const lom_reference *reference, lom_vec3 place, lom_vec3 direction, double far);
/* The share of the sun that terrain leaves to a place: 0 or 1; 1 where the sun is not above the horizon. */
double lom_ground_leaves_sun(const lom_reference *reference, lom_vec3 place);
/* What lies behind everything. */
lom_vec3 lom_sky_light(const lom_reference *reference, lom_vec3 direction);

/* Rays (trace.c): lom_trace_ray in the float state that the caller has set; inside: the reference of the water that the
 * ray starts in, or NULL. */
lom_vec3 lom_radiance_along(const lom_reference *reference, struct lom_ray ray, double near_distance, double time,
                            int depth, const lom_reference *inside);

/* Clouds (clouds.c). */
bool lom_load_ray_clouds(lom_reference *reference, lom_error *error);
void lom_free_ray_clouds(lom_reference *reference);
/* haze.c. Light that comes from `far` along a ray through the scene's haze; from no end (1e300) it is the sky's, in
 * which the haze already is. */
lom_vec3 lom_light_through_haze(const lom_reference *reference, const struct lom_ray *ray, double far, lom_vec3 light);
/* Light that comes from `far` along a ray, as it is before the clouds that stand nearer. */
lom_vec3 lom_light_through_clouds(const lom_reference *reference, const struct lom_ray *ray, double far, double time,
                                  lom_vec3 light);
/* The share of the sun's light that clouds let through to a place. */
double lom_cloud_shadow(const lom_reference *reference, lom_vec3 place, double time);

/* Variance of slopes along x and z, and their covariance. */
struct lom_slope_spread {
    double xx, xz, zz;
};
/* Water (surface.c). */
struct lom_crossing {
    double t;
    lom_vec3 place;
    double rest[2];                 /* where the water of it is at rest, if the surface has waves */
    lom_vec3 facet;                 /* the geometry's unit normal, upwards */
    lom_vec3 normal;                /* the one that mirrors and bends, upwards; it faces the ray, as the facet does */
    struct lom_slope_spread spread; /* of the normals that there are, about the facet */
    uint64_t key;                   /* of the random numbers of the place */
};
/* Where a ray first crosses the surface of the water at low < t < high, from above or from below; false when it does
 * not. */
bool lom_cross_water(const lom_reference *reference, const struct lom_ray *ray, double time, bool from_below,
                     double low, double high, struct lom_crossing *crossing);
/* The normal of water without waves, without ripples. */
lom_vec3 lom_level_water_normal(const lom_reference *reference, const struct lom_crossing *crossing, double time);
/* facets.c. Fills in which of the facets smaller than the geometry a ray meets first: the normal, spread and key. */
void lom_meet_first_facet(const lom_reference *reference, lom_vec3 direction, double time, bool from_below,
                          struct lom_crossing *crossing);
/* The way of light among them, back from the first. */
struct lom_facet_walk {
    const lom_reference *reference;
    const struct lom_crossing *crossing;
    double time, side;
    double height; /* the logarithm of the share of facets that lie lower than the last */
    uint64_t key;
    int met;
};
struct lom_facet_walk lom_enter_facets(const lom_reference *reference, const struct lom_crossing *crossing,
                                       lom_vec3 direction, double time, bool from_below);
/* Whether what the last facet mirrors to a unit direction meets another one, and its normal, upwards, which faces it. False:
 * it leaves them. */
bool lom_meet_facet(struct lom_facet_walk *walk, lom_vec3 direction, lom_vec3 *normal);
/* Whether a place is over or under the rectangle of the water. */
bool lom_is_over_water(const lom_reference *reference, lom_vec3 place);
/* Metres of water above a place, waves of a frame left out; 0 where there is none. */
double lom_water_above(const lom_reference *reference, lom_vec3 place, double time);

#endif
