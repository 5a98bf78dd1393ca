/* lom/geometry.h - meshes: Wavefront OBJ with its materials, normals, shapes, terrain; vectors and matrices. */
#ifndef LOM_GEOMETRY_H
#define LOM_GEOMETRY_H

#include <lom/image.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- vectors and matrices: right-handed, y up, column vectors ---- */

typedef struct lom_vec3 {
    double x, y, z;
} lom_vec3;
/* m[row][column]; a point p becomes M (p, 1). Held in double; shaders get it rounded once to float. */
typedef struct lom_mat4 {
    double m[4][4];
} lom_mat4;

lom_mat4 lom_identity(void);
lom_mat4 lom_multiply(const lom_mat4 *a, const lom_mat4 *b); /* a b: b is applied first */
lom_mat4 lom_translation(lom_vec3 offset);
lom_mat4 lom_scaling(lom_vec3 factor);
lom_mat4 lom_rotation(lom_vec3 radians);                          /* Rz Ry Rx */
lom_mat4 lom_look_at(lom_vec3 eye, lom_vec3 target, lom_vec3 up); /* world to view, looking along -z */
/* Reversed depth, 1 at near, 0 at an infinite far plane; 0 < field_of_view (vertical, radians) < pi. */
lom_mat4 lom_perspective(double field_of_view, double aspect, double near_plane);
/* Clip z in -w..w, -1 at near and 1 at far (OpenGL). */
lom_mat4 lom_perspective_gl(double field_of_view, double aspect, double near_plane, double far_plane);
/* Reversed depth, 1 at near, 0 at far. */
lom_mat4 lom_orthographic(double width, double height, double near_plane, double far_plane);
/* Mirror in the plane n.p = d, n of unit length. */
lom_mat4 lom_mirror(lom_vec3 normal, double distance);
/* False, and *inverse all zeros, when m is singular. */
bool lom_invert(const lom_mat4 *m, lom_mat4 *inverse);
/* The inverse transpose of the upper 3x3 of model, for normals; false and zeros when singular. */
bool lom_normal_matrix(const lom_mat4 *model, lom_mat4 *normal);

/* ---- meshes ---- */

typedef struct lom_mesh_vertex { /* 48 bytes, interleaved */
    float position[3];
    float normal[3];
    float uv[2];    /* origin top left: OBJ's v is flipped on loading */
    float color[4]; /* linear; 1,1,1,1 where the file has none */
} lom_mesh_vertex;

typedef struct lom_material {
    char name[64];
    float ambient[3], diffuse[3], specular[3]; /* linear, as the file has them */
    float shininess, opacity;
    char diffuse_map[256]; /* path relative to the material file's folder; empty when there is none */
} lom_material;

typedef struct lom_mesh_part { /* triangles of one material, in file order */
    uint32_t first_index, index_count;
    int material; /* index into materials, -1 for none */
} lom_mesh_part;

typedef struct lom_mesh {
    lom_mesh_vertex *vertices;
    uint32_t *indices; /* triangles, counter-clockwise from the front */
    lom_mesh_part *parts;
    lom_material *materials;
    size_t vertex_count, index_count, part_count, material_count;
    size_t source_triangles; /* n - 2 for every polygon of the source */
} lom_mesh;

void lom_free_mesh(lom_mesh *mesh);
/* Reads an OBJ file and the MTL files it names (relative to its folder). Missing normals are computed: the normalised
 * sum of the unit normals of the faces that share the position. NULL on failure, with "file:line: " in the error. */
lom_mesh *lom_read_obj(const char *path, lom_error *error);
/* The same from memory; read_material is called for every mtllib name (NULL: materials are ignored). */
lom_mesh *lom_decode_obj(const char *text, size_t size, const char *name, lom_error *error);
/* Writes positions, uv, normals and usemtl groups, numbers as lom_print_float; material_file (may be NULL) goes to
 * mtllib. */
lom_bytes lom_encode_obj(const lom_mesh *mesh, const char *material_file, lom_error *error);
lom_bytes lom_encode_mtl(const lom_mesh *mesh, lom_error *error);
/* A grid with a vertex for each pixel of a height map (8- or 16-bit gray, float, or 24-bit RGB taken as one number /
 * 2^24): x and z in [-width/2, width/2] and [-length/2, length/2], y = gray * height + base; uv 0..1 over the whole.
 * Normals by the sum of face normals. The map is at least 2x2. */
lom_mesh *lom_make_terrain(const lom_image *map, double width, double length, double height, double base,
                           lom_error *error);

/* ---- made: pictures of landscapes, by seed ---- */

typedef struct lom_height_map_desc {
    int size; /* 256, 512, 1024 or 2048 pixels a side; 0: 1024 */
    uint64_t seed;
} lom_height_map_desc;
/* A lake among mountains for a terrain of 1600 x 1600 x 400 m, 16-bit gray: the water's surface is at 1/16, black the
 * deepest bed, white the highest summit; the high range lies at the top (-z). */
lom_image *lom_make_height_map(const lom_height_map_desc *desc, lom_error *error);

#ifdef __cplusplus
}
#endif

#endif
