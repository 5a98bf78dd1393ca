/* Terrain as it is drawn: square blocks of the height map's grid, each held at several levels of detail, and one
 * texture of what lights its vertices.
 *
 * Invariant: floats count heights from the terrain's base, wherever in the world it is. */
#ifndef LOM_RENDER_GROUND_GROUND_H
#define LOM_RENDER_GROUND_GROUND_H

#include "render/scene_view.h"

#include <lom/scene.h>

struct frame;

enum { LOM_MAX_TERRAIN_LAYERS = 8 };

enum {
    LOM_GROUND_BLOCK = 32, /* quads along an edge of a block, fewer at the far borders of the map */
    LOM_GROUND_LEVELS = 6, /* level n joins 2^n quads along each axis into one */
    LOM_BLOCK_SIZES = 4,   /* those before the far borders; in the last column; in the last row; in both */
    LOM_EDGE_SETS = 16,
    LOM_GROUND_PATTERNS = LOM_BLOCK_SIZES * LOM_GROUND_LEVELS * LOM_EDGE_SETS,
    LOM_GROUND_PATCH = 16 /* quads along an edge of a patch, and segments of it at most */
};

/* The edges of a block where the neighbour is one level coarser. */
enum { LOM_EDGE_LEFT = 1, LOM_EDGE_RIGHT = 2, LOM_EDGE_TOP = 4, LOM_EDGE_BOTTOM = 8 };

struct lom_ground_block {
    int columns, rows;               /* quads at level 0 */
    lom_box bounds;                  /* in the world */
    size_t first[LOM_GROUND_LEVELS]; /* its vertices at each level in lom_ground.position, row by row */
    float error[LOM_GROUND_LEVELS];  /* metres that the level's surface is off level 0 at most */
    size_t first_corner, corners;    /* of its patches in lom_ground.patch_corner, four a patch */
};

/* Triangles of a grid of columns x rows quads whose vertices are numbered row by row. */
struct lom_ground_pattern {
    int columns, rows, edges;
    size_t first, count; /* in lom_ground.indices */
    uint32_t *wires;     /* edges of the triangles, two indices each, by kind; NULL where the dial wireframe is off */
    size_t wire_count[3];
};

/* Kinds of a pattern's edges: inside, on the left and on the upper border; on the right border; on the lower one. */
enum { LOM_WIRES_OWN, LOM_WIRES_RIGHT, LOM_WIRES_BOTTOM, LOM_WIRES };

/* The scene's pictures of it; NULL: none. */
struct lom_ground_maps {
    const lom_texture *base, *detail, *normals, *layer[LOM_MAX_TERRAIN_LAYERS];
    float brightness_below[LOM_MAX_TERRAIN_LAYERS]; /* mean of the picture below a layer with grain, above 0 */
};

struct lom_ground {
    int across, down;  /* blocks */
    int columns, rows; /* quads of the whole grid */
    struct lom_ground_block *blocks;
    float (*position)[3]; /* from the middle of the base */
    size_t position_count;
    const float *heights; /* of all vertices over the base, (columns + 1) x (rows + 1): the world's */
    /* A texel a vertex: the unit normal and, as alpha, the visible share of the sky. */
    lom_texture *vertex_texture;
    lom_texture *shadow;    /* a texel a vertex: the height over the base up to which it keeps the sun off; or NULL */
    float *shadow_heights;  /* the same numbers, x first */
    lom_vec3 shadowed_from; /* the direction to the sun for which it was made */
    lom_texture *composed;  /* of the device: all layers from above; or NULL */
    struct lom_ground_pattern *patterns;
    size_t pattern_count;
    int pattern_of[LOM_BLOCK_SIZES][LOM_GROUND_LEVELS][LOM_EDGE_SETS]; /* which of them */
    uint32_t *indices;                                                 /* of all patterns */
    size_t index_count, index_capacity;
    /* With quality.tessellation: column, row, height over the base, metres that the patches around it are off. */
    float (*knot)[4];
    uint32_t *patch_corner;
    size_t knot_count, patch_corner_count;
    lom_box *groups; /* bounds of blocks side by side (seen.c) */
    bool *seen;      /* of each block: by the pass that looked last */

    /* What a frame has chosen, the same for all of its passes. */
    int *level;      /* of each block */
    int *pattern;    /* of each block: its triangles, without cracks to its neighbours */
    uint32_t *order; /* blocks from near to far */
    double *distance;
    lom_vec3 eye;          /* from which patches are cut, in the world */
    double errors_allowed; /* a metre's error at a metre's distance, in errors that are allowed */
    bool parallel;         /* at whatever distance */
};

bool lom_load_ground(lom_renderer *renderer, lom_error *error);
/* Chooses levels of detail and casts the shadow. */
bool lom_prepare_ground(struct frame *f, lom_error *error);
/* Draws what a pass sees of it. */
void lom_draw_ground(lom_renderer *renderer, const struct lom_scene_view *view, const struct lom_culler *culler,
                     const struct lom_view_uniform *uniform);
/* The patches once more, as `how` says: the edges of their triangles in this colour, or, NULL, depth alone. */
void lom_draw_cut_wires(lom_renderer *renderer, const struct lom_scene_view *view, const struct lom_culler *culler,
                        const lom_draw_desc *how, const float color[3]);
void lom_free_ground(lom_renderer *renderer);
/* The scene's pictures of it. */
bool lom_load_ground_maps(lom_renderer *renderer, lom_error *error);
void lom_free_ground_maps(lom_renderer *renderer);
/* The shadow is cast, the layers are composed anew by the next frame. */
void lom_drop_ground_shadow(lom_renderer *renderer);
void lom_free_ground_shadow(struct lom_ground *ground);
void lom_drop_composed_ground(lom_renderer *renderer);
/* Composes the layers if quality.terrain_composite asks for it and they are not; the blocks' levels come after. */
bool lom_compose_ground(struct frame *f, lom_error *error);

/* Finds which blocks are seen: in view (culler NULL: all are), and nearer to its eye than `reach`; how many. */
#define LOM_EVERYWHERE 1e300
int lom_see_ground(const struct lom_ground *ground, const struct lom_culler *culler, double reach);
/* The blocks that the culler leaves (NULL: all), near ones first, each a draw of this description with its vertices. */
void lom_draw_ground_blocks(const lom_renderer *renderer, const struct lom_culler *culler, const lom_draw_desc *desc);
/* All triangles, as far as a draw says so: attribute 0 and indices. Those of the i-th block from near to far: which of them,
 * and the block's number; NULL where it is not seen. */
void lom_take_ground(const struct lom_ground *ground, lom_draw_desc *draw);
const struct lom_ground_pattern *lom_find_ground_draw(const struct lom_ground *ground, int i, lom_draw_desc *draw,
                                                      uint32_t *number);
/* Whether any of it would be drawn; which blocks are seen is to be found anew. */
bool lom_shows_ground(const struct lom_ground *ground, const struct lom_culler *culler);
/* The shadow that it throws, for places less the eye. */
void lom_set_ground_light(struct lom_light_uniform *light, const lom_renderer *renderer, lom_vec3 eye);

/* The terrain of a map whose vertices have these heights over the base, with the dials ambient_occlusion and mipmaps;
 * `vertex_texture` belongs to the device, heights to the caller. False on failure; freed by lom_free_ground_blocks. */
bool lom_make_ground_blocks(struct lom_ground *ground, const lom_terrain *terrain, const lom_image *map,
                            const float *heights, const lom_quality *quality, lom_device *device, lom_error *error);
/* Texture coordinates of the textures with a texel a vertex are (x, z) scale + shift for places less the eye. */
void lom_map_ground(const struct lom_ground *ground, const double size[2], lom_vec3 eye, float scale[2],
                    float shift[2]);
void lom_free_ground_blocks(struct lom_ground *ground);

/* Heights of a terrain's vertices: of a row, and metres between columns and between rows. */
struct lom_ground_grid {
    const float *heights;
    int width;
    double spacing[2];
};
/* The largest distance of a vertex of level 0 from the surface of a level of the block that begins at column x and row y. */
float lom_find_level_error(const struct lom_ground_grid *grid, int x, int y, const struct lom_ground_block *block,
                           int level);

/* The share of the sky (0..1, weighted by the cosine to the vertical) that each vertex sees over the heights around
 * it, from a grid of at most 256 x 256 of them. share: width x height numbers, `stride` floats apart. By all workers
 * of the device. */
bool lom_find_sky_visibility(lom_device *device, const float *heights, int width, int height, const double size[2],
                             float *share, size_t stride, lom_error *error);

/* For each vertex of width x height heights the height up to which terrain shadows a place there: the largest
 * h - d tan e of the heights h at a distance d > 0 towards the light, which stands at the elevation e. Below -1e29
 * where nothing does. */
void lom_find_ground_shadow(lom_device *device, const float *heights, int width, int height, const double size[2],
                            const double to_light[3], float *shadow);

/* Groups and patches of a terrain whose blocks are there. */
bool lom_group_ground_blocks(struct lom_ground *ground, lom_error *error);
bool lom_make_ground_patches(struct lom_ground *ground, lom_error *error);
/* Makes the triangles of every size of block, level and set of coarser neighbours; and their edges. */
bool lom_make_ground_patterns(struct lom_ground *ground, lom_error *error);
bool lom_make_ground_wires(struct lom_ground *ground, lom_error *error);
/* Chooses every block's level: the coarsest whose error is at most `pixels` on the screen, neighbours at most one level
 * apart, and sorts the blocks by distance. scale: pixels of 1 m at 1 m distance; pixels 0: full density. */
void lom_choose_ground(struct lom_ground *ground, lom_vec3 eye, double scale, double pixels, bool parallel);

#endif
