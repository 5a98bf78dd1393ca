/* Timing frames. In: a workload and a device; out: the median and the fastest frame. Invariant: the clock runs from
 * before the first call of a frame until its last pass is complete, and over nothing else. */
#include "median.h"
#include "workload.h"

#include <time.h>

static double now_ms(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e3 + (double)t.tv_nsec * 1e-6;
}

/* One frame; `read`: and its picture. */
static bool time_frame(lom_workload *workload, lom_device *device, bool read, double *ms, lom_error *error)
{
    if (!lom_prepare_workload(workload, device, error))
        return false;
    double start = now_ms();
    bool done = lom_draw_prepared(workload, device, error);
    if (done && read) {
        lom_image *picture = lom_workload_picture(workload, device, error);
        done = picture != NULL;
        *ms = now_ms() - start;
        lom_free_image(picture);
    } else
        *ms = now_ms() - start;
    return done;
}

static bool time_frames(lom_workload *workload, lom_device *device, int count, bool read, double *times,
                        lom_error *error)
{
    for (int i = 0; i < count; i++)
        if (!time_frame(workload, device, read, &times[i], error))
            return false;
    return true;
}

/* The difference of the counters around one frame. */
static bool count_frame(lom_workload *workload, lom_device *device, double *ms, lom_counters *counters,
                        lom_error *error)
{
    lom_counters before = lom_device_counters(device);
    if (!time_frame(workload, device, false, ms, error))
        return false;
    lom_counters after = lom_device_counters(device);
    *counters = (lom_counters){ .vertices = after.vertices - before.vertices,
                                .triangles = after.triangles - before.triangles,
                                .triangles_binned = after.triangles_binned - before.triangles_binned,
                                .fragments = after.fragments - before.fragments };
    return true;
}

static bool time_all(lom_workload *workload, lom_device *device, int warm_up, double *times, lom_timing *timing,
                     lom_error *error)
{
    int frames = timing->frames, reads = frames / 4 + 1;
    if (!count_frame(workload, device, times, &timing->counters, error))
        return false;
    timing->cold_ms = times[0];
    if (!time_frames(workload, device, warm_up + frames - 1, false, times + 1, error))
        return false;
    times += warm_up;
    timing->median_ms = lom_median(times, frames);
    timing->min_ms = times[0];
    if (!time_frames(workload, device, reads, true, times, error))
        return false;
    timing->read_ms = lom_median(times, reads);
    return true;
}

bool lom_time_workload(lom_workload *workload, lom_device *device, int warm_up, int frames, lom_timing *timing,
                       lom_error *error)
{
    if (warm_up < 0 || frames < 1 || frames > 10000 || warm_up > 10000)
        return lom_fail(error, LOM_ERROR_USAGE, "%d frames after %d are not within 1..10000 after 0..10000.", frames,
                        warm_up);
    double *times = lom_allocate((size_t)(frames + warm_up + 1), sizeof *times, error);
    if (times == NULL)
        return false;
    *timing = (lom_timing){ .frames = frames };
    bool drawn = time_all(workload, device, warm_up, times, timing, error);
    lom_release(times);
    return drawn;
}
