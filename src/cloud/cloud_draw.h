/* Clouds as the pipeline draws them: volumes loaded once, light that follows the sun, and a draw a cloud. */
#ifndef LOM_CLOUD_CLOUD_DRAW_H
#define LOM_CLOUD_CLOUD_DRAW_H

#include "cloud/detail_noise.h"
#include "shading/light.h"

#include <lom/cloud.h>

enum { LOM_BLUE_NOISE = 64 }; /* pixels a side of the table of jitter */

/* The dials of the scene's [quality] table. */
struct lom_cloud_quality {
    int model; /* lom_cloud_model */
    double error, stop, light_scale;
    int octaves;
    bool jitter;
    lom_filtering filtering, march; /* of the flat model's picture; of densities and light */
};

/* A density that several clouds of a scene may share. */
struct lom_cloud_density {
    const lom_cloud *source; /* the first cloud that asked for it */
    lom_image *image;
    lom_medium *medium;
};

/* A cloud in its place. */
struct lom_placed_cloud {
    const lom_cloud *cloud;
    const struct lom_cloud_density *density;
    lom_transfer_function transfer; /* of no points if it has none */
    lom_light_grid *light;
    lom_volume *original;              /* density lit in advance, of the original model */
    struct lom_cloud_sprites *sprites; /* of the models of billboards, or NULL */
    struct lom_cloud_sheet *sheet;     /* of the model of layers, or NULL */
    uint64_t lit_for;                  /* what `light` or `original` was made for, hashed; 0: nothing yet */
    lom_vec3 middle;                   /* of the box, in the world; the cloud's position, until wind moves it */
    double detail;                     /* how far the noise eats into it: the cloud's, unless shapes change */
    double axes[3][3];                 /* axes[i] is the box's axis i in the world, of unit length */
};

/* What keeps the sun off clouds beside clouds: a height over each place of the world up to which it is dark. */
struct lom_cloud_shade {
    double (*height)(const void *context, double x, double z);
    const void *context;
    double highest; /* none of them is higher */
};

/* What the light of a cloud is made from (cloud_light.c). */
struct lom_cloud_lighting {
    uint64_t hash;       /* of the way to the sun, and of the places of what shadows it */
    size_t shadow_count; /* clouds that may shadow it */
    bool shaded;         /* by what else stands there, whose shadow's edge is as high as */
    double edge;
    lom_error failed;
};

/* All clouds of a scene, and what they share. */
struct lom_cloud_set {
    const struct lom_cloud_shade *shade; /* NULL: nothing does; of a frame */
    size_t shaded;                       /* clouds on which it fell when they were lit for the frame */
    const lom_clouds *params;
    struct lom_cloud_quality quality;
    struct lom_cloud_density *densities;
    size_t density_count;
    struct lom_placed_cloud *clouds; /* in the order of the file; those that are not visible are left out */
    size_t count;
    size_t *order;                       /* room for the numbers of all of them: those in view (lom_order_clouds) */
    uint32_t *sorting;                   /* room for a key and two numbers of each, while they are put in order */
    struct lom_cloud_lighting *lighting; /* likewise: of each, while they are lit */
    lom_detail *detail;
    lom_image *fields[LOM_DETAIL_FIELDS]; /* of noise; only the first where shapes do not change */
    double phase;                         /* of the crossfade that `detail` is from */
    lom_texture *picture;                 /* of the flat models, or NULL */
    double mean_opacity;                  /* of it */
    lom_texture *fine;                    /* of the model of layers, which has its noise in `picture`, or NULL */
    double mean_fine;                     /* of it */
    lom_texture *gradient;                /* likewise */
    uint64_t gradient_of;                 /* what it was made for, hashed; 0: nothing yet */
    float *jitter;                        /* LOM_BLUE_NOISE^2 numbers in ]0, 1[ */
};

/* Makes or reads the volumes of the visible clouds, by all workers of the device (NULL: by the caller). *loaded is NULL when there are none, or the model is off. What the
 * set before (NULL: none), whose scene is still there and has the same filtering, holds of what is needed is shared with
 * it: until lom_part_cloud_sets neither may be drawn or freed. */
bool lom_load_cloud_set(const lom_cloud *clouds, size_t count, const lom_clouds *params,
                        const struct lom_cloud_quality *quality, const struct lom_cloud_set *before, lom_device *device,
                        struct lom_cloud_set **loaded, lom_error *error);
void lom_free_cloud_set(struct lom_cloud_set *set);
/* The points of a cloud's transfer function; how many. */
size_t lom_cloud_transfer_points(const lom_cloud *cloud, lom_transfer_point points[LOM_MAX_TRANSFER]);
/* What both have is from now on the first one's, and the other can only be freed. NULL is allowed. */
void lom_part_cloud_sets(const struct lom_cloud_set *owner, struct lom_cloud_set *other);

/* cloud_wind.c: how far the wind has taken a cloud at a time; puts all clouds there. */
lom_vec3 lom_cloud_way(const lom_clouds *params, const lom_cloud *cloud, double time);
void lom_move_clouds(struct lom_cloud_set *set, double time);

/* cloud_evolve.c: gives the clouds the shapes that they have at a time, by a crossfade from field to field of the noise
 * that eats into them; its phase at a time, in fields. */
bool lom_evolve_clouds(struct lom_cloud_set *set, double time, lom_error *error);
double lom_cloud_phase_at(const lom_clouds *params, double time);

/* cloud_light.c: makes every cloud's light that of a sun in this direction (towards it, unit length); what already is
 * stays. *swept counts the grids that were made again. By all workers of the device; NULL: by the caller. False when memory
 * runs out. */
bool lom_light_clouds(struct lom_cloud_set *set, const double to_light[3], lom_device *device, int *swept,
                      lom_error *error);
/* The same of one cloud; *swept is increased when it was made again. */
bool lom_light_cloud(struct lom_cloud_set *set, size_t index, const double to_light[3], int *swept, lom_error *error);
/* blue_noise.c: a table of size x size numbers (i + 1/2) / size^2, each once, whose neighbours differ: void and cluster
 * (Ulichney 1993). NULL on failure; freed with lom_release. */
float *lom_make_blue_noise(int size, uint64_t seed, lom_error *error);

/* How a pass looks at clouds. */
struct lom_cloud_view {
    lom_mat4 projection, view;
    lom_vec3 eye;
    double near_plane;
    bool mirrored;
    const lom_texture *depth; /* of what is drawn; reversed, infinite */
    int origin_x, origin_y;   /* the frame's pixel of the depth's pixel (0, 0) */
    double pixel_angle;       /* radians a pixel covers in the middle of the picture; of parallel rays metres */
    struct lom_light_uniform light;
    bool is_sliced; /* only what lies between two planes is drawn: metres along slice_axis, a unit vector, from the eye
                     */
    lom_vec3 slice_axis;
    double slice_from, slice_to;
};

/* What tells the nearer one of two places: the square of the distance; of parallel rays the distance along the view
 * axis. */
double lom_cloud_nearness(lom_vec3 place, const struct lom_cloud_view *view);
/* What octave k of scattering weighs in parts of the sun's colour; the first goes by the phase function, times 4 pi. */
double lom_octave_weight(double albedo, int octave);
/* The box of a cloud in the world. */
lom_box lom_cloud_bounds(const struct lom_placed_cloud *cloud);
/* Indices of the clouds that are seen (all of them unless cull is set), the farthest first (by the middle's distance;
 * of equals the later one in the file first); order has room for set->count. */
size_t lom_order_clouds(const struct lom_cloud_set *set, const struct lom_cloud_view *view, bool cull, size_t *order);
/* How many clouds have rays that would take more steps of the length that quality.cloud_error asks for than a ray takes
 * (*steps), so that theirs are longer and the bound is not kept. */
size_t lom_count_capped_clouds(const struct lom_cloud_set *set, int *steps);
/* The corners of its box less its middle: corner c is at (c & 1, c >> 1 & 1, c >> 2) along its axes. */
void lom_cloud_corners(const struct lom_placed_cloud *cloud, lom_vec3 corner[8]);
/* Draws one cloud into the pass that has begun (colour alone; it keeps what it holds). */
void lom_draw_placed_cloud(lom_device *device, const struct lom_cloud_set *set, const struct lom_placed_cloud *cloud,
                           const struct lom_cloud_view *view);

/* cloud_shadow.c: draws what a cloud lets through of the light to a horizontal plane, multiplied into a map of it: (s,
 * t) of the map is the place x = plane[0] + s plane[2], z = plane[1] + t plane[3] at the height y. Nothing where its
 * shadow misses the map. */
void lom_draw_cloud_shadow(lom_device *device, const struct lom_cloud_set *set, const struct lom_placed_cloud *cloud,
                           const double plane[4], double y, const double to_light[3]);
/* Where a box's shadow on a plane lies: low and high x, low and high z. The light comes from above. */
void lom_shadow_extent(lom_box box, double y, const double to_light[3], double extent[4]);

#endif
