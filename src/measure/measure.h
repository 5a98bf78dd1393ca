/* Workloads to time, and timing them; the self-test.
 *
 * The workloads are those of bench/peers/README.md, drawn from its formulas by the pipeline; what its harness draws on
 * an implementation of OpenGL is the same picture. Setting up is not timed; a frame is.
 */
#ifndef LOM_MEASURE_MEASURE_H
#define LOM_MEASURE_MEASURE_H

#include <lom/pipeline.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- workloads ---- */

typedef struct lom_workload lom_workload;

int lom_workload_count(void);
/* "clear", "fill", "blend", "depth", "mesh", "terrain", "water", "cloud"; "water-skip" and "cloud-skip", which draw their
 * bytes with less work: no ground is shaded twice that is seen, empty space is skipped; "sprites", "foliage",
 * "gradients", "draws" and "textured"; "fft256", "fft512", "fft1024", complex Fourier transforms of squares of that size,
 * and "light-grid", the light of 128^3 voxels, whatever size is asked for. NULL outside 0 .. count - 1. */
const char *lom_workload_name(int index);
/* One line that says what is drawn. */
const char *lom_workload_summary(int index);

/* Sets up a workload at a size of 1..16384 pixels a side: meshes, textures, targets; `filtering` is that of textures,
 * `march` that of the cloud. NULL on failure; freed with
 * lom_free_workload. It belongs to no device: devices of any threads and lanes may draw it, one at a time. */
lom_workload *lom_create_workload(const char *name, int width, int height, lom_filtering filtering, lom_filtering march,
                                  lom_error *error);
void lom_free_workload(lom_workload *workload);
/* Its passes have so many samples a pixel from now on (lom_pass_desc.samples); 1 at first. */
void lom_set_workload_samples(lom_workload *workload, int samples);

/* Draws one frame, every time the same; complete when it returns. */
bool lom_draw_workload(lom_workload *workload, lom_device *device, lom_error *error);
/* The picture of the last frame, RGBA8; "depth" is shown by one more pass as 1 - (1 - z) * 4. Freed with
 * lom_free_image; NULL on failure. */
lom_image *lom_workload_picture(lom_workload *workload, lom_device *device, lom_error *error);

/* ---- timing ---- */

typedef struct lom_timing {
    int frames;
    double median_ms, min_ms; /* of a frame */
    double cold_ms;           /* of the first frame, warm-up or not: memory is touched for the first time */
    double read_ms;           /* median of a frame and reading its picture back, a quarter as many and one */
    lom_counters counters;    /* what one frame does; no counter depends on threads or tiles but `packets` */
} lom_timing;

/* Draws `warm_up` frames (0 or more), then `frames` (1..10000), each timed by the monotonic clock, then those that are
 * read back. */
bool lom_time_workload(lom_workload *workload, lom_device *device, int warm_up, int frames, lom_timing *timing,
                       lom_error *error);

/* ---- the self-test: the promise of the same bytes, checked on this machine ---- */

typedef struct lom_selftest_part {
    const char *name;
    uint64_t hash, expected; /* of this build on this machine; recorded for LOM_PICTURE_VERSION */
} lom_selftest_part;

enum { LOM_SELFTEST_PARTS = 9 };

typedef struct lom_selftest {
    uint64_t hash, expected; /* of all parts together */
    lom_selftest_part part[LOM_SELFTEST_PARTS];
    char difference[200]; /* empty, or one sentence that names the first part that differs, and where */
} lom_selftest;

/* Runs made-up content through numbers, codecs, double and lane mathematics and the whole pipeline, at every lane
 * variant that this processor runs, on 1, 2 and 3 threads with different tiles. Reads no file. False only when it could
 * not be done; a difference is a result. */
bool lom_run_selftest(lom_selftest *result, lom_error *error);
/* Rows of the matrix of builds (tests/house/matrix.sh, bench/results/matrix.md) that gave one hash of the self-test. */
extern const uint64_t lom_selftest_seen; /* that hash */
extern const char
    *const lom_selftest_rows[]; /* "gcc-3", "s390x-0": compiler or architecture, level, more; NULL at the end */
/* All pictures of the parts that draw, side by side in 8 bits: to look at where a part differs. Freed with
 * lom_free_image; NULL on failure. */
lom_image *lom_draw_selftest(lom_error *error);

#ifdef __cplusplus
}
#endif

#endif
