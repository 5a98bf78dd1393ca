/* The surface of water with waves: what its shaders and draws need. Three geometries share one light
 * (surface_radiance.h): two triangles, a mesh whose density follows the screen, and a ray for each pixel. */
#ifndef LOM_WATER_SURFACE_H
#define LOM_WATER_SURFACE_H

#include "shading/eye.h"
#include "shading/far_rows.h"
#include "shading/gradient.h"
#include "shading/sun_shadow.h"
#include "shading/near_blocks.h"
#include "waves/wave_lanes.h"

#include <lom/water.h>

#include <lom/geometry.h>

/* A picture of the scene with its depth: where an offset from the eye is in it, and what stands there. It need not show
 * what the frame does: the frame's pixel (x, y) is at (x scale[0] + shift[0], y scale[1] + shift[1]). */
struct lom_picture_uniform {
    struct lom_matrix_uniform clip_from_offset;
    float scale[2], shift[2];
    const lom_texture *color, *depth; /* NULL: there is nothing in it */
    struct lom_near_uniform near;     /* of a picture that a rough surface blurs */
    struct lom_far_uniform far;       /* of a picture through which rays go down */
    float rows_sum;                   /* of the matrix, the largest sum of a row's amounts: with near or far */
};

/* Blocks of a picture that is blurred, texels. */
enum { LOM_PICTURE_BLOCK = 64 };

/* Rows of a picture through which rays go down, texels. */
enum { LOM_PICTURE_ROW = 16 };

/* The coarsest level at which a reflection is looked up: a texel of it is 2^3 pixels. */
enum { LOM_BLUR_LEVELS = 3, LOM_BLUR_PLACES = 4, LOM_OPEN_TEXELS = 8 };

/* Water as a medium: 1/m of red, green and blue; the light that it sends back per metre and absorption, at the surface;
 * the length of the sun's refracted ray per metre of depth. */
struct lom_medium_uniform {
    float absorption[3], source[3], slant;
};

struct lom_sky_uniform {
    const lom_texture *box; /* NULL: one colour */
    float color[3];         /* factor on the box */
    float cosine, sine;     /* of its turn about y */
    float size;             /* texels a side */
    struct lom_gradient_uniform gradient;
};

struct lom_foam_uniform {
    const lom_texture *pattern; /* NULL: none */
    float amount, shore_depth, inverse_tile, move;
    float shift[2]; /* the pattern's coordinates at the eye, less whole repetitions */
};

/* The mesh: vertex (ring, column) is at apex + r (cosine[column], sine[column]), r = radius[ring] clamped to
 * nearest[column]..farthest[column], between which the column is in the quad. */
struct lom_polar_mesh_uniform {
    const float *radius, *spacing, *cosine, *sine; /* spacing: metres between neighbours, for the filter */
    const float *nearest, *farthest;
    int columns; /* vertices a ring */
    float apex[2];
};

/* Places are offsets from the eye. */
struct lom_surface_uniforms {
    struct lom_matrix_uniform clip_from_offset;
    struct lom_waves_uniform waves;
    struct lom_light_uniform light;
    struct lom_sun_shadow_uniform entity_shadow;
    struct lom_picture_uniform mirrored; /* what the surface reflects: the side of the eye, mirrored in the plane */
    struct lom_picture_uniform behind;   /* the other side, as the eye sees it */
    struct lom_medium_uniform medium;
    struct lom_sky_uniform sky;
    struct lom_foam_uniform foam;
    struct lom_polar_mesh_uniform mesh;
    float side;     /* 1: the eye is above the surface, -1: below */
    float pixel[2]; /* 1 / size of the whole frame */
    struct lom_eye_uniform eye;
    float ray[3][3]; /* rows of lom_view_rays */
    float eta;       /* index of the eye's side over that of the other */
    float range;     /* metres from the eye within which all of the scene is */
    float roughness, glitter, reach;
    float quad[4]; /* x and z of two corners */
    int fresnel;   /* lom_fresnel */
    int steps, surface_steps;
    bool bent, marched; /* refracted rays are followed; reflected ones too */
};

extern const lom_shader lom_surface_flat_shader, lom_surface_displaced_shader, lom_surface_marched_shader;
/* Attribute 0 is an offset from the eye, the colour 1: where the surface may be. */
extern const lom_shader lom_surface_bounds_shader;

/* What a polar mesh is made for. */
struct lom_polar_mesh_desc {
    lom_mat4 projection, view;
    double level, lowest, highest, reach; /* of the surface: y at rest less the eye's; metres */
    double quad[4];                       /* less the eye */
    double near_plane;                    /* metres */
    double cell, pixel_angle;             /* pixels between vertices, and radians a pixel; of parallel rays metres */
};

/* Rings about a point behind the eye, from below it to the far corner of the quad, in the sector that the view can see.
 * Along a ring vertices are `cell` pixels apart; from ring to ring as well, until waves are lower than a pixel, from
 * where rings may be further apart. Where rays are parallel, rings about the middle of what the picture shows of the
 * plane, vertices `cell` pixels apart everywhere. One connected mesh, whose outline is
 * that of the quad: there is no seam to stitch. */
struct lom_polar_mesh {
    int rings, columns;
    double apex[2];                          /* less the eye */
    float *radius, *spacing, *cosine, *sine; /* parts of one array */
    float *nearest, *farthest;               /* of it too */
    uint32_t *indices;
    size_t index_count;
    float *memory;
    size_t memory_capacity, index_capacity;
    int indexed_rings, indexed_columns;
};

/* Fills a mesh (zeros at first); memory is kept from frame to frame. */
bool lom_fill_polar_mesh(struct lom_polar_mesh *mesh, const struct lom_polar_mesh_desc *desc, lom_error *error);
/* No triangle between rings before this one can be seen, wherever within their bounds waves move it: those below and
 * behind the view, which are many where it looks far. The frustum is that of places less the eye. */
int lom_first_seen_ring(const struct lom_polar_mesh *mesh, const struct lom_polar_mesh_desc *desc,
                        const lom_frustum *frustum);
void lom_free_polar_mesh(struct lom_polar_mesh *mesh);

#endif
