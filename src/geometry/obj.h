/* What an OBJ file says, between reading (obj_read.c) and making the mesh (obj_build.c). */
#ifndef LOM_GEOMETRY_OBJ_H
#define LOM_GEOMETRY_OBJ_H

#include "materials.h"

struct obj_position {
    float position[3], color[3];
};

struct obj_triple {
    float value[3];
};

struct obj_corner {
    int32_t v, vt, vn; /* from 0; vt and vn -1 when absent, INT32_MAX when the file lacks them */
};

struct obj_face {          /* or a line or a set of points */
    uint32_t first, count; /* corners; at least 3, 2, 1 */
    uint32_t line;
    int32_t material;
};

enum obj_kind { OBJ_FACES, OBJ_LINES, OBJ_POINTS, OBJ_KINDS };

struct obj_elements { /* of a kind, in file order */
    struct obj_face *items;
    size_t count, capacity;
    size_t indices; /* of all of them: 3 (n - 2), 2 (n - 1), n */
};

/* What is passed over with a warning, wherever it stands in the file. */
enum obj_passed { OBJ_NO_FACES, OBJ_CURVES, OBJ_FEW_CORNERS, OBJ_FEW_ENDS, OBJ_LACKING, OBJ_PASSED_COUNT };

struct lom_obj {
    struct lom_text text;
    lom_read_material read_material;
    void *context;
    struct obj_position *positions;
    struct obj_triple *texture; /* u, v flipped, unused */
    struct obj_triple *normals;
    struct obj_corner *corners;
    struct obj_elements elements[OBJ_KINDS];
    size_t position_count, texture_count, normal_count, corner_count;
    size_t position_capacity, texture_capacity, normal_capacity, corner_capacity;
    struct lom_materials materials;
    int material; /* of the elements that follow, -1 for none */
    struct {
        size_t count, line; /* how often, and where first */
    } passed[OBJ_PASSED_COUNT];
    lom_warnings warnings;
};

/* Counts one more of what is passed over. */
void lom_pass_over(struct lom_obj *obj, enum obj_passed what, size_t line);
/* The mesh of what was read; checks that every index is in range. NULL on failure. */
lom_mesh *lom_build_obj(struct lom_obj *obj);

/* How much of a path is its folder, with the slash. */
size_t lom_folder_length(const char *path, size_t length);
/* The path of a file that the file at `path` names: relative to its folder. Freed with lom_release. */
char *lom_path_beside(const char *path, const char *name, lom_error *error);
/* A lom_read_material; context points at the path of the OBJ file. */
lom_bytes lom_read_beside(void *context, const char *name, lom_error *error);

#endif
