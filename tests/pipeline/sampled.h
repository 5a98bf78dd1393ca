/* What the tests of several samples a pixel share: a heap of triangles that can be moved exactly, and the oracle. */
#ifndef LOM_TESTS_SAMPLED_H
#define LOM_TESTS_SAMPLED_H

#include "stage.h"

enum { SIZE = 128, TRIANGLES = 160 };

static const int counts[] = { 2, 4, 8, 16 };

/* The bits of a pixel's samples that a triangle covers. */
static inline unsigned samples_of(const snapped v[3], int samples, int px, int py)
{
    unsigned bits = 0;
    for (int i = 0; i < samples; i++) {
        snapped moved[3];
        int at[2];
        lom_sample_position(samples, i, at);
        for (int k = 0; k < 3; k++)
            moved[k] = (snapped){ v[k].x - 16 * at[0], v[k].y - 16 * at[1] };
        bits |= (unsigned)covers(moved, px, py) << i;
    }
    return bits;
}

static vertex heap[3 * TRIANGLES];

/* Heaps of triangles with corners on units; w is a power of two, so that a corner moves by sixteenths exactly. */
static inline void make_heap(void)
{
    for (size_t t = 0; t < TRIANGLES; t++) {
        int64_t reach = t % 40 == 0 ? 60000 : t % 7 == 0 ? 6000 : 1200;
        int64_t x = random_whole(0, 256 * SIZE), y = random_whole(0, 256 * SIZE);
        float z = (float)random_whole(1, 7) / 8;
        for (size_t k = 0; k < 3; k++) {
            vertex *v = &heap[3 * t + k];
            float w = (float)(1 << random_whole(0, 2)) * 0.5f;
            place_at(v, x + random_whole(-reach, reach), y + random_whole(-reach, reach), SIZE);
            v->position[2] = t % 3 == 0 ? random_float(0.1f, 0.9f) : z;
            for (int i = 0; i < 4; i++)
                v->position[i] *= w;
            for (int i = 0; i < 8; i++)
                v->value[i] = random_float(0, 1);
            v->distance[0] = t % 5 == 0 ? random_float(-1, 1) : 1;
        }
    }
}

#endif
