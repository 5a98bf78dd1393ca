/* The weights of declared work. In: the counters of a frame. Out: cycles. Invariant: one table; a counter that depends on
 * threads, lanes or tiles (packets, tiles) is not in it, so the sum is one number on every machine. The weights are the
 * least squares, none below 0, of relative errors of the processor time of 15 scenes at 320x180 on one thread of an AMD
 * EPYC with AVX2 at 8 lanes (bench/results/declared-work.md); vertices and binned triangles came to nothing beside
 * triangles, and are left out. */
#include "work.h"

static double count_pixels(const lom_frame *frame)
{
    return frame->image != NULL ? (double)frame->image->width * frame->image->height : 0;
}

static double count_triangles(const lom_frame *frame)
{
    return (double)frame->counters.triangles;
}

static double count_fragments(const lom_frame *frame)
{
    return (double)frame->counters.fragments;
}

static double count_transforms(const lom_frame *frame)
{
    return (double)frame->counters.transforms;
}

static double count_steps(const lom_frame *frame)
{
    return (double)frame->shallow_steps;
}

static const lom_work_item items[] = {
    { "pixels", 170, count_pixels },       { "triangles", 45, count_triangles },
    { "fragments", 330, count_fragments }, { "transforms", 3.6e6, count_transforms },
    { "shallow steps", 1e6, count_steps },
};

const lom_work_item *lom_describe_work(size_t index)
{
    return index < sizeof items / sizeof items[0] ? &items[index] : NULL;
}

double lom_declared_work(const lom_frame *frame)
{
    double cycles = 0;
    for (size_t i = 0; i < sizeof items / sizeof items[0]; i++)
        cycles += items[i].cycles * items[i].count(frame);
    return cycles;
}
