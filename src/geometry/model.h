/* Pieces of which things are built: boxes, tubes and blades of a material, with uv in metres. */
#ifndef LOM_GEOMETRY_MODEL_H
#define LOM_GEOMETRY_MODEL_H

#include "geometry/noise.h"

#include <lom/geometry.h>

/* The material of what follows; its colour texture is `name`.png, as lom_make_albedo paints it. */
void lom_model_material(lom_mesh_builder *builder, const char *name, double specular, double shininess);

/* How a texture lies on a piece: v along it, one repetition in `metres`, from v; u from u0 to u1 across. */
typedef struct lom_model_map {
    double u0, u1, v, metres;
} lom_model_map;

/* A box; the texture runs along its longest side. */
void lom_model_box(lom_mesh_builder *builder, lom_vec3 low, lom_vec3 high, lom_model_map map);

typedef struct lom_model_ring {
    lom_vec3 center;
    double radius;
} lom_model_ring;
/* A round tube through rings, closed at both ends. */
void lom_model_tube(lom_mesh_builder *builder, const lom_model_ring *rings, int count, int slices, lom_model_map map);
/* The same between two points. */
void lom_model_pole(lom_mesh_builder *builder, lom_vec3 from, lom_vec3 to, double radius0, double radius1, int slices,
                    lom_model_map map);

/* A leaf from `foot`, both sides: it starts along `along`, is wide across `side`, and bends down by `droop` of its
 * length; the texture's v runs from its foot (0) to its tip (1). All its normals are `normal`. */
typedef struct lom_model_leaf {
    lom_vec3 foot, along, side, normal;
    double length, width, droop, u;
    int segments;
} lom_model_leaf;
void lom_model_leaf_at(lom_mesh_builder *builder, const lom_model_leaf *leaf);

/* A stone: a sphere of radius 1, cut by random planes and roughened, then scaled and moved. */
typedef struct lom_model_stone {
    lom_vec3 center, radii;
    uint64_t seed;
    int detail; /* subdivisions of an icosahedron, 0..5 */
} lom_model_stone;
void lom_model_stone_at(lom_mesh_builder *builder, const lom_model_stone *stone);

/* A number in [low, high) that belongs to (seed, index). */
double lom_model_random(uint64_t seed, uint64_t index, double low, double high);

/* The things, by file. Each is made at the origin with y = 0 at the ground or at the water's surface. */
void lom_build_boat(lom_mesh_builder *builder, uint64_t seed);
void lom_build_aircraft(lom_mesh_builder *builder, uint64_t seed);
void lom_build_jetty(lom_mesh_builder *builder, uint64_t seed);
void lom_build_cabin(lom_mesh_builder *builder, uint64_t seed);
void lom_build_lit_cabin(lom_mesh_builder *builder, uint64_t seed);
void lom_build_lantern(lom_mesh_builder *builder, uint64_t seed);
void lom_build_lamp_post(lom_mesh_builder *builder, uint64_t seed);
void lom_build_fire(lom_mesh_builder *builder, uint64_t seed);
void lom_build_ball(lom_mesh_builder *builder, uint64_t seed);
void lom_build_bowl(lom_mesh_builder *builder, uint64_t seed);
void lom_build_slab(lom_mesh_builder *builder, uint64_t seed);
void lom_build_spruce(lom_mesh_builder *builder, uint64_t seed);
void lom_build_pine(lom_mesh_builder *builder, uint64_t seed);
void lom_build_boulder(lom_mesh_builder *builder, uint64_t seed);
void lom_build_stones(lom_mesh_builder *builder, uint64_t seed);
void lom_build_reeds(lom_mesh_builder *builder, uint64_t seed);
void lom_build_floats(lom_mesh_builder *builder, uint64_t seed);

#endif
