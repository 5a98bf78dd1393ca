/* Timing frames. In: a workload and a device; out: the median and the fastest frame. Invariant: the clock runs from
 * before the first call of a frame until its last pass is complete, and over nothing else. */
#include "workload.h"

#include <time.h>

static double now_ms(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e3 + (double)t.tv_nsec * 1e-6;
}

/* Insertion: the times of equal frames come nearly in any order, and there are few. */
static void sort(double *times, int count)
{
    for (int i = 1; i < count; i++) {
        double time = times[i];
        int j = i;
        for (; j > 0 && times[j - 1] > time; j--)
            times[j] = times[j - 1];
        times[j] = time;
    }
}

bool lom_time_workload(lom_workload *workload, lom_device *device, int warm_up, int frames, lom_timing *timing,
                       lom_error *error)
{
    if (warm_up < 0 || frames < 1 || frames > 10000)
        return lom_fail(error, LOM_ERROR_USAGE, "%d frames after %d are not within 1..10000 after 0 or more.", frames,
                        warm_up);
    double *times = lom_allocate((size_t)frames, sizeof *times, error);
    if (times == NULL)
        return false;
    bool drawn = true;
    for (int i = 0; i < warm_up && drawn; i++)
        drawn = lom_draw_workload(workload, device, error);
    for (int i = 0; i < frames && drawn; i++) {
        if (!lom_prepare_workload(workload, device, error)) {
            drawn = false;
            break;
        }
        double start = now_ms();
        drawn = lom_draw_prepared(workload, device, error);
        times[i] = now_ms() - start;
    }
    if (drawn) {
        sort(times, frames);
        double upper = times[frames / 2], lower = times[(frames - 1) / 2];
        *timing = (lom_timing){ .frames = frames, .median_ms = (lower + upper) / 2, .min_ms = times[0] };
    }
    lom_release(times);
    return drawn;
}
