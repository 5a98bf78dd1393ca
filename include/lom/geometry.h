/* lom/geometry.h - meshes: Wavefront OBJ with its materials, normals, shapes, terrain; vectors and matrices. */
#ifndef LOM_GEOMETRY_H
#define LOM_GEOMETRY_H

#include <lom/image.h>
#include <lom/lanes.h>

LOM_API_BEGIN

/* ---- vectors and matrices: right-handed, y up, column vectors ----
 * Pure functions of their arguments in double; they compute in the float state they are called in, which is expected
 * to be the default one. */

typedef struct lom_vec3 {
    double x, y, z;
} lom_vec3;
/* m[row][column]; a point p becomes M (p, 1). Held in double; shaders get it rounded once to float. */
typedef struct lom_mat4 {
    double m[4][4];
} lom_mat4;

lom_vec3 lom_vec3_add(lom_vec3 a, lom_vec3 b);
lom_vec3 lom_vec3_subtract(lom_vec3 a, lom_vec3 b);
lom_vec3 lom_vec3_scale(lom_vec3 a, double factor);
double lom_vec3_dot(lom_vec3 a, lom_vec3 b);
lom_vec3 lom_vec3_cross(lom_vec3 a, lom_vec3 b);
double lom_vec3_length(lom_vec3 a); /* no overflow or underflow on the way */
/* Unit length; (0, 0, 0) for the zero vector and for one that holds a NaN or an infinity. */
lom_vec3 lom_vec3_normalize(lom_vec3 a);

lom_mat4 lom_identity(void);
lom_mat4 lom_multiply(const lom_mat4 *a, const lom_mat4 *b); /* a b: b is applied first */
lom_mat4 lom_transpose(const lom_mat4 *m);
lom_mat4 lom_translation(lom_vec3 offset);
lom_mat4 lom_scaling(lom_vec3 factor);
lom_mat4 lom_rotation(lom_vec3 radians); /* Rz Ry Rx */
/* T Rz Ry Rx S: the model matrix of an entity. */
lom_mat4 lom_model_matrix(lom_vec3 offset, lom_vec3 radians, lom_vec3 factor);
/* World to view, looking along -z. An eye at its target looks along -z. An up that is zero or parallel to the line of
 * sight is replaced by -z when looking down and +z otherwise (the limit of tilting a camera that looked along -z), and
 * where that is parallel too, by +y. */
lom_mat4 lom_look_at(lom_vec3 eye, lom_vec3 target, lom_vec3 up);
/* The projections give all zeros (which puts w = 0 everywhere and draws nothing) for arguments that are not finite or
 * out of range: a field of view outside ]0, pi[, an aspect, size or near plane that is not above 0, far <= near.
 * lom_orthographic allows any near plane. */
/* Reversed depth, 1 at near, 0 at an infinite far plane; 0 < field_of_view (vertical, radians) < pi. */
lom_mat4 lom_perspective(double field_of_view, double aspect, double near_plane);
/* Clip z in -w..w, -1 at near and 1 at far (OpenGL). */
lom_mat4 lom_perspective_gl(double field_of_view, double aspect, double near_plane, double far_plane);
/* Parallel rays along -z. Reversed depth, 1 at near, 0 at far, linear between them. */
lom_mat4 lom_orthographic(double width, double height, double near_plane, double far_plane);
/* Parallel rays at a slant: what lies a metre farther along -z is shown right metres further right and up metres
 * further up, and the plane z = 0 where lom_orthographic shows it. With right = f cos a, up = f sin a the receding
 * lines have the angle a and are f times as long as they are: f = 1 is a cavalier, f = 1/2 a cabinet projection; any
 * pair is a shear. All zeros for a shear that is not finite. (J. Foley and others, Computer Graphics: Principles and
 * Practice, 2nd ed., 6.1.2.) */
lom_mat4 lom_oblique(double width, double height, double near_plane, double far_plane, double right, double up);
/* Mirror in the plane n.p = d, n of unit length. */
lom_mat4 lom_mirror(lom_vec3 normal, double distance);
/* False, and *inverse all zeros, when m is singular: a pivot within rounding of 0 after every row and column was
 * scaled to about 1, an entry that is not finite, or an inverse that does not fit a double. inverse may be m. */
bool lom_invert(const lom_mat4 *m, lom_mat4 *inverse);
/* The inverse transpose of the upper 3x3 of model, for normals, the rest as in the identity; false and zeros when
 * singular. normal may be model. */
bool lom_normal_matrix(const lom_mat4 *model, lom_mat4 *normal);
/* The upper three rows of m (p, 1): the last row is not looked at (affine). */
lom_vec3 lom_transform_point(const lom_mat4 *m, lom_vec3 p);
/* The upper three rows of m (v, 0). */
lom_vec3 lom_transform_direction(const lom_mat4 *m, lom_vec3 v);
/* m (p, 1), all four rows. */
void lom_transform_clip(const lom_mat4 *m, lom_vec3 p, double clip[4]);
/* Each element rounded once to float: what shaders multiply with. */
lom_matrix_uniform lom_round_matrix(const lom_mat4 *m);

/* ---- the rays of a view ---- */

/* The rays that a picture of projection * view sees by, in world directions; the one through (x, y) in normalised
 * device coordinates, with v = row (x, y, 1):
 * perspective: from the eye along v, whose length along the view axis is 1;
 * parallel: from eye + v, on the plane across the view axis through the eye, along `along`, whose length along the view
 * axis is 1. */
typedef struct lom_view_rays {
    bool parallel; /* the projection's last row is (0, 0, 0, 1) */
    double row[3][3];
    lom_vec3 along, ahead; /* ahead: the view axis, of unit length */
} lom_view_rays;
/* projection: one of the above, or one zoomed to a part of it; view: a rotation, or a mirrored one, and a shift. */
lom_view_rays lom_find_view_rays(const lom_mat4 *projection, const lom_mat4 *view);
/* One of them: where it starts and its direction. */
void lom_ray_through(const lom_mat4 *projection, const lom_mat4 *view, lom_vec3 eye, double x, double y,
                     lom_vec3 *origin, lom_vec3 *direction);

/* ---- boxes and the view frustum ---- */

typedef struct lom_box {
    lom_vec3 low, high; /* empty when low > high in any axis */
} lom_box;

/* The axis-aligned box of the transformed box (affine m); an empty box stays empty. */
lom_box lom_transform_box(const lom_mat4 *m, lom_box box);

typedef struct lom_frustum {
    int count;          /* of planes: 4 to 6; a far plane at infinity is left out */
    double plane[6][4]; /* inside where x p[0] + y p[1] + z p[2] + p[3] >= 0 */
    double reach[6][4]; /* the absolute values that were added up in plane: the scale of rounding in float */
} lom_frustum;

typedef enum lom_visibility { LOM_OUTSIDE = 0, LOM_CROSSING, LOM_INSIDE } lom_visibility;

/* The planes of -w <= x, y <= w and 0 <= z <= w (or, with gl_depth, -w <= z <= w) in the space view_projection takes
 * (Gribb and Hartmann 2001: sums and differences of the rows). */
lom_frustum lom_view_frustum(const lom_mat4 *view_projection, bool gl_depth);
/* LOM_OUTSIDE only when all of the box is outside one plane by more than the rounding of float transformations, so
 * that leaving the box out cannot change a pixel; an empty box is outside, one with a NaN crosses. */
lom_visibility lom_box_visibility(const lom_frustum *frustum, lom_box box);

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
    float emissive[3];     /* light of its own */
    float bump;            /* of a normal map that holds heights: white is bump / 64 of its width above black */
    char diffuse_map[256]; /* path relative to the OBJ file's folder; empty when there is none */
    char emissive_map[256], specular_map[256], gloss_map[256], normal_map[256]; /* likewise */
    char opacity_map[256]; /* likewise: map_d, which multiplies opacity */
} lom_material;

typedef struct lom_mesh_part { /* triangles (or lines, or points) of one material, in file order */
    uint32_t first_index, index_count;
    int material; /* index into materials, -1 for none */
} lom_mesh_part;

typedef struct lom_mesh {
    lom_mesh_vertex *vertices;
    uint32_t *indices;    /* triangles, counter-clockwise from the front; behind them lines, two each; then points */
    lom_mesh_part *parts; /* of the triangles, behind them those of the lines, then of the points */
    lom_material *materials;
    size_t vertex_count, index_count, part_count, material_count; /* indices, parts: of the triangles alone */
    size_t line_index_count, point_count;                         /* indices of lines, of points */
    size_t line_part_count, point_part_count;
    size_t source_triangles; /* n - 2 for every polygon of the source */
    lom_warnings warnings;   /* what a lenient reader passed over */
} lom_mesh;

/* A mesh with zeroed arrays of these lengths, for callers that fill it themselves. At most 2^32 - 1 vertices and
 * indices, 2^31 - 1 parts and materials. */
lom_mesh *lom_create_mesh(size_t vertices, size_t indices, size_t parts, size_t materials, lom_error *error);
typedef struct lom_mesh_counts { /* lengths of a mesh's arrays, as lom_mesh has them */
    size_t vertices, indices, line_indices, points, parts, line_parts, point_parts, materials;
} lom_mesh_counts;

/* The same with lines and points; the limits are of the sums. */
lom_mesh *lom_create_mesh_of(const lom_mesh_counts *counts, lom_error *error);
/* The parts of all kinds: how many mesh->parts has. */
size_t lom_mesh_parts(const lom_mesh *mesh);
/* NULL is allowed. */
void lom_free_mesh(lom_mesh *mesh);
/* White diffuse, 0.2 ambient, no specular, no light of its own, shininess 1, opaque, bump 1, no map; name is cut to 63 bytes. */
lom_material lom_default_material(const char *name);

/* ---- Wavefront OBJ and MTL (Alias|Wavefront, Advanced Visualizer manual, appendices B1 and B2) ----
 *
 * v x y z [w] [r g b]: w weighs free-form curves and is ignored. vt u [v [w]]. vn as the file has it, not normalised.
 * f in its four forms, negative indices count back from the statement, positive ones may point forward. A polygon is
 * cut by ear clipping in the plane of its normal into n - 2 triangles, always. Corners with equal (v, vt, vn) become
 * one vertex; vertices are numbered by first use in triangles, then in lines, then in points. l joins each vertex to the one
 * before it, a segment each; p is a point a vertex; both have v, v/vt and, as faces do, v/vt/vn. A backslash at the end of a line continues it. '#' at
 * the start of a word begins a comment, but the names of materials and files go on to the end of their line ("Material
 * #25"); a comment behind one is told from it when what stands before '#' is a material or file that is there, or, for
 * a map, ends with an extension; and a material that is used and that no file defines is the one whose name it is before
 * a comment ("usemtl red", "newmtl red # warm"), when there is one such. Other statements (g, o, s) are passed over.
 * Missing normals: the normalised sum of the unit normals of all faces (polygons, not triangles) that share the v; the
 * first of these faces decides where the sum is 0, and (0, 1, 0) where all are degenerate or there is none.
 * mesh->warnings tells, once for each sort with its number: curves and surfaces, which are passed over; faces of
 * fewer than 3 corners and lines of fewer than 2, passed over; normals and texture coordinates that a face names and the file lacks, taken as not
 * named; a file without faces, lines and points, whose mesh has all its positions as vertices (normals 0, 1, 0) and nothing else;
 * materials that no file defines, which get lom_default_material; MTL files that cannot be opened; in MTL, newmtl
 * without a name, statements before the first newmtl, maps without a file. A material defined again replaces the first.
 * MTL: newmtl Ka Kd Ks Ke Ns d Tr map_Kd map_Ks map_Ke map_Ns map_Bump (bump, norm; with -bm), the rest passed
 * over. Errors begin with "name:line: "; a number that is not
 * finite, a vertex that is not there or a file without any vertex is one. Files are at most 1 GiB, polygons at most
 * 4096 corners. */

/* Reads an OBJ file and the MTL files it names (relative to its folder). NULL on failure. */
lom_mesh *lom_read_obj(const char *path, lom_error *error);
/* The same from memory; mtllib is passed over, so that every material is the default one with its name. */
lom_mesh *lom_decode_obj(const char *text, size_t size, const char *name, lom_error *error);
/* Gives the bytes of the material file called name (allocated by lom_allocate; an error code LOM_ERROR_FILE means that
 * there is none, which is no failure of the mesh). */
typedef lom_bytes (*lom_read_material)(void *context, const char *name, lom_error *error);
/* The same with material files from read_material; NULL passes them over. */
lom_mesh *lom_decode_obj_with(const char *text, size_t size, const char *name, lom_read_material read_material,
                              void *context, lom_error *error);
/* What a change of may change the mesh or its look: the paths of the MTL files that the OBJ file names, whether they
 * exist or not, and of the maps in them; one after the other, each ended by a zero byte (size 0: none). As far as the
 * files are well formed. Freed with lom_release. */
lom_bytes lom_list_obj_files(const char *path, lom_error *error);
/* Writes positions, uv, normals and usemtl groups (faces, then l, then p), numbers as lom_print_float; material_file (may be NULL) goes to
 * mtllib. Colours are written when any is not 1, 1, 1 (alpha never). Reading it back gives the same mesh when its
 * vertices are numbered by first use, but for uv below 2^-30. Fails for numbers that are not finite. */
lom_bytes lom_encode_obj(const lom_mesh *mesh, const char *material_file, lom_error *error);
lom_bytes lom_encode_mtl(const lom_mesh *mesh, lom_error *error);

/* ---- terrain ---- */

/* A grid with a vertex for each pixel of a height map (8- or 16-bit gray, float, or 24-bit RGB taken as one number /
 * 2^24): x and z in [-width/2, width/2] and [-length/2, length/2], y = gray * height + base; uv 0..1 over the whole.
 * Row 0 is at z = -length/2. Gray is value / 255 or value / 65535, a float as it is. With alpha (ignored) too.
 * A quad of a = (i, j), b = (i+1, j), c = (i, j+1), d = (i+1, j+1) is cut along b c into a,c,b and b,c,d, j outer loop.
 * Normals by the normalised sum of unit face normals. The map is at least 2x2 and at most 2^26 pixels; sizes > 0. */
lom_mesh *lom_make_terrain(const lom_image *map, double width, double length, double height, double base,
                           lom_error *error);
/* The height of that mesh's triangles (not of a smooth surface) at (x, z); outside the grid, of the nearest point of
 * its border. 0 for a map or size that lom_make_terrain refuses. */
double lom_terrain_height(const lom_image *map, double width, double length, double height, double base, double x,
                          double z);

/* ---- shapes: around the origin, counter-clockwise from outside, with normals and uv, one part without material ----
 */

/* 24 vertices, a face 0..1 in uv, upright on the four sides. */
lom_mesh *lom_make_box(lom_vec3 size, lom_error *error);
/* Two triangles facing +y; uv (0, 0) at (-width/2, -length/2). */
lom_mesh *lom_make_quad(double width, double length, lom_error *error);
/* (columns+1) x (rows+1) vertices facing +y, split like terrain; uv 0..1 over the whole. */
lom_mesh *lom_make_grid(double width, double length, int columns, int rows, lom_error *error);
/* u around y from +x towards -z, v from the north pole down; rows of slices + 1 vertices, at the poles slices (one for
 * each of the triangles there, none is degenerate); slices >= 3, stacks >= 2. */
lom_mesh *lom_make_sphere(double radius, int slices, int stacks, lom_error *error);
/* (columns+1) x (rows+1) vertices; column i at angle A = 2 pi i / columns from +x towards +z, row j at B = 2 pi j /
 * rows of the tube: ((major + minor cos B) cos A, minor sin B, (major + minor cos B) sin A); uv = (i / columns, j /
 * rows). */
lom_mesh *lom_make_torus(double major, double minor, int columns, int rows, lom_error *error);
/* Around y from y = 0 (radius bottom) to y = height (radius top; one of them may be 0: a cone), closed by flat caps; u
 * around like the sphere's, v from the top down. */
lom_mesh *lom_make_cylinder(double bottom, double top, double height, int slices, lom_error *error);

/* ---- working on meshes ---- */

/* The edges of its triangles, each once (vertices at equal positions count as one): two indices of vertices each, in the
 * order of first mention. *count: of indices. NULL on failure; freed with lom_release. */
uint32_t *lom_mesh_edges(const lom_mesh *mesh, size_t *count, lom_error *error);

/* Of all vertices; empty (low > high) when there are none. */
lom_box lom_mesh_bounds(const lom_mesh *mesh);
/* Positions by matrix (affine), normals by its normal matrix, normalised; a mirroring matrix also turns the triangles
 * round. False, and nothing changed, when the matrix is singular. */
bool lom_transform_mesh(lom_mesh *mesh, const lom_mat4 *matrix, lom_error *error);

/* Puts meshes together piece by piece. The first failure stays in the builder, so that only lom_finish_mesh needs to
 * be checked; every call on a NULL builder does nothing. */
typedef struct lom_mesh_builder lom_mesh_builder;

lom_mesh_builder *lom_create_mesh_builder(lom_error *error);
void lom_free_mesh_builder(lom_mesh_builder *builder);
/* Finds the material by its name, or adds it; the triangles that follow have it. NULL: none. Returns its index or -1.
 */
int lom_builder_material(lom_mesh_builder *builder, const lom_material *material);
/* The colour of the vertices that follow; 1, 1, 1, 1 at first. Linear. */
void lom_builder_color(lom_mesh_builder *builder, double red, double green, double blue, double alpha);
/* The transformation of the vertices that follow, NULL: none. A mirroring matrix turns the triangles that follow round.
 * A singular one is an error. */
void lom_builder_transform(lom_mesh_builder *builder, const lom_mat4 *matrix);
/* A vertex whose normal is computed when the mesh is finished. Returns its index. */
uint32_t lom_builder_vertex(lom_mesh_builder *builder, lom_vec3 position, double u, double v);
/* A vertex with a normal that is kept. */
uint32_t lom_builder_vertex_normal(lom_mesh_builder *builder, lom_vec3 position, lom_vec3 normal, double u, double v);
/* Counter-clockwise from the front. */
void lom_builder_triangle(lom_mesh_builder *builder, uint32_t a, uint32_t b, uint32_t c);
/* a, b, c, d around the quad: triangles a,b,c and a,c,d. */
void lom_builder_quad(lom_mesh_builder *builder, uint32_t a, uint32_t b, uint32_t c, uint32_t d);
/* Appends a mesh, transformed by the current transformation, with its own normals, its colours times the current one,
 * its materials (by name); parts without one get the current material. */
void lom_builder_mesh(lom_mesh_builder *builder, const lom_mesh *mesh);
/* Makes the mesh and frees the builder, also on failure. A computed normal of a corner is the normalised sum of the
 * unit normals of the triangles at the same position (equal coordinates) whose normals are within crease radians of the
 * corner's own triangle: 0 gives flat faces, pi smooth ones. Vertices whose corners differ are split, and numbered by
 * first use; triangles are grouped by material, in order of first use. Vertices that no triangle uses are dropped. */
lom_mesh *lom_finish_mesh(lom_mesh_builder *builder, double crease, lom_error *error);

/* ---- made: pictures of landscapes, by seed ---- */

typedef struct lom_height_map_desc {
    int size; /* 256, 512, 1024 or 2048 pixels a side; 0: 1024 */
    uint64_t seed;
} lom_height_map_desc;
/* A lake among mountains for a terrain of 1600 x 1600 x 400 m, 16-bit gray: the water's surface is at 1/16, black the
 * deepest bed, white the highest summit; the high range lies at the top (-z). */
lom_image *lom_make_height_map(const lom_height_map_desc *desc, lom_error *error);

/* The height map of a coast, 16-bit gray, size (2..4096) pixels a side, for a terrain of 400 x 400 m and 64 m height
 * with its base at -20: "lagoon" (a bay behind a reef), "cove" (a beach between headlands), "river", "falls" (cliffs
 * around a plunge pool). The sea, or the river's water, stands at 0. Freed with lom_free_image. */
lom_image *lom_make_coast(const char *name, int size, uint64_t seed, lom_error *error);
/* The names of the coasts, from 0; NULL behind the last. */
const char *lom_coast_name(size_t index);

typedef struct lom_albedo_desc {
    const char *name; /* one that lom_albedo_name gives */
    int size;         /* pixels a side, 64..4096; 0: what suits the name */
    uint64_t seed;
} lom_albedo_desc;
/* A colour texture that repeats without a seam, RGB8 sRGB. */
lom_image *lom_make_albedo(const lom_albedo_desc *desc, lom_error *error);
/* The names of the textures, from 0; NULL behind the last. */
const char *lom_albedo_name(size_t index);

/* A thing that stands at a lake, in metres, y = 0 at the ground or the water's surface; its materials name textures
 * "NAME.png" of lom_make_albedo(NAME). Freed with lom_free_mesh. */
lom_mesh *lom_make_entity(const char *name, uint64_t seed, lom_error *error);
/* The names of the entities, from 0; NULL behind the last. */
const char *lom_entity_name(size_t index);

LOM_API_END

#endif
