/* The share of one machine in a run of frames. */
#ifndef LOM_CLI_SHARD_H
#define LOM_CLI_SHARD_H

#include "part.h"
#include "progress.h"
#include "scene_options.h"

/* A run and this machine's share of it. */
struct lom_shard {
    const char *pattern; /* the part's file, with %d or %03d for the shard's number where there are several */
    bool resume;         /* a part of the same job that is whole is left as it is */
    bool quiet;
    int shard, shards, first, last;
    const struct lom_scene_options *options;
};

/* Whether a share of such a run can be drawn: asked before anything is loaded. */
bool lom_check_shard(const struct lom_shard *shard, const lom_scene *scene, lom_error *error);
/* Whether the share is drawn already: *done; false on failure. path: of the scene. */
bool lom_find_part(const struct lom_shard *shard, const lom_scene *scene, const char *path, bool *done,
                   lom_error *error);
/* Draws the pieces of the share into its part. */
bool lom_draw_shard(const struct lom_shard *shard, const lom_scene *scene, const char *path, lom_renderer *renderer,
                    lom_error *error);

#endif
