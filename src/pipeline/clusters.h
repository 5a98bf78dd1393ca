/* Clusters of a mesh (lom/pipeline.h): runs of CLUSTER_TRIANGLES triangles, the last one shorter. */
#ifndef LOM_PIPELINE_CLUSTERS_H
#define LOM_PIPELINE_CLUSTERS_H

#include <lom/pipeline.h>

enum { CLUSTER_TRIANGLES = 128, CLUSTER_RANGES = 4 };

struct lom_cluster {
    float low[3], high[3];             /* the box around its vertices */
    uint32_t range[CLUSTER_RANGES][2]; /* that hold their numbers: first and last */
    int ranges;
};

struct lom_clusters {
    struct lom_cluster *cluster;
    size_t count, indices;
    uint32_t largest; /* index */
};

/* Clusters side by side that may be seen, and which chunk of their draw they go to. */
struct lom_run {
    uint32_t first, count; /* clusters */
    uint32_t chunk;
};

#endif
