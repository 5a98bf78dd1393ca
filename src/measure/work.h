/* Declared work: what a frame did, by fixed weights of about a nanosecond of one processor each, the same number on
 * every machine (docs/trade.md). `lom tune` weighs settings by it, `lom cost` the frames of a run. */
#ifndef LOM_MEASURE_WORK_H
#define LOM_MEASURE_WORK_H

#include <lom/render.h>

/* What is counted. */
typedef enum lom_work_kind {
    LOM_WORK_PIXELS, /* of the frame, in each pass */
    LOM_WORK_VERTICES,
    LOM_WORK_TRIANGLES, /* that may cover a pixel */
    LOM_WORK_FRAGMENTS,
    LOM_WORK_LOOKUPS,     /* of textures, in all fragments, as in those of the picture */
    LOM_WORK_STEPS,       /* of rays through clouds, likewise */
    LOM_WORK_SAMPLES,     /* beyond the first of each pixel */
    LOM_WORK_TRANSFORMED, /* N^2 log2 N of each Fourier transform of a square of N */
    LOM_WORK_SHALLOW,     /* cells of shallow water, in each of its steps */
    LOM_WORK_PARTICLES,   /* of liquids, in each of their steps: those that there are at the beginning */
    LOM_WORK_KINDS
} lom_work_kind;

typedef struct lom_declared_work {
    uint64_t count[LOM_WORK_KINDS];
} lom_declared_work;

/* A kind, for docs and tables: its name, what one of it weighs in tenths; NULL behind the last. */
const char *lom_describe_work(size_t kind, uint64_t *weight);

/* All of it by the weights: a model, not a measurement. Frames of one scene compare well, those of two scenes within a
 * factor of two. */
uint64_t lom_weigh_work(const lom_declared_work *work);

/* Where work is counted: one thread of 4 lanes. Vertices are counted in whole packets, of as many as there are lanes,
 * and clouds skip empty space by packets. */
lom_device_desc lom_counting_device(void);

/* The work of a frame. It is drawn twice, the second time to see what its fragments looked up; a scene that the
 * reference traces has no fragments and is drawn once. False on failure. */
bool lom_count_work(lom_renderer *renderer, const lom_scene *scene, const lom_frame_desc *desc, lom_declared_work *work,
                    lom_error *error);

#endif
