/* The generator of tessellation: what a patch of given levels is cut into (lom/stages.h). */
#ifndef LOM_PIPELINE_TESSELLATE_H
#define LOM_PIPELINE_TESSELLATE_H

#include <lom/stages.h>

/* Coordinates are whole numbers of 1 / DOMAIN_ONE: exact as float. */
enum { DOMAIN_ONE = 1 << 24 };

struct lom_pattern {
    uint32_t (*place)[2]; /* u, v; of triangles w = DOMAIN_ONE - u - v */
    uint32_t *corner;     /* numbers of places: three a triangle, two a line, one a point */
    size_t places, corners;
    size_t place_capacity, corner_capacity;
};

/* Whether a level rounded says anything else: patches whose keys are equal have equal patterns. */
struct lom_pattern_key {
    uint32_t level[6]; /* outer, inner: segments in 1 / 65536 after clamping; 0: the patch is discarded */
};

struct lom_pattern_key lom_pattern_key_of(const lom_tessellation *t, const float outer[4], const float inner[2]);
/* Renews the pattern; false without memory. No corners where the patch is discarded. */
bool lom_make_pattern(const lom_tessellation *t, const struct lom_pattern_key *key, struct lom_pattern *pattern);
/* Triangles, lines or points that a patch may become at most. */
size_t lom_most_pieces(const lom_tessellation *t);
/* Vertices of each. */
int lom_piece_vertices(const lom_tessellation *t);

#endif
