/* For tables of lane functions: what one lane gives is, bit for bit, what a packet of copies of it gives, and stays so
 * whatever is put into the other lanes. Numbers that are none are taken for the same. */
#ifndef LOM_TESTS_NEIGHBOURS_H
#define LOM_TESTS_NEIGHBOURS_H

#include "check.h"

#include <lom/base.h>
#include <lom/lanes.h>

enum { MOST_LANE_INPUTS = 16, MOST_LANE_OUTPUTS = 16 };

/* From the inputs to the outputs, each of a lom_float; `context` is what all lanes have in common. */
typedef void lane_function(const void *context, const lom_float *in, lom_float *out);

/* A function that is tried. */
struct lane_case {
    const char *name;
    lane_function *function;
    const void *context;
    int inputs, outputs;
};

/* What may be in a lane beside. */
static inline float poison(uint64_t key, uint64_t i)
{
    static const float special[] = { 0 / 0.0f,   1 / 0.0f,  -1 / 0.0f,   0,        -0.0f,   0x1p-149f,
                                     -0x1p-140f, 0x1p-126f, 3.4e38f,     -3.4e38f, 0x1p31f, -0x1p31f,
                                     0x1.8p23f,  1,         -1,          0.5f,     1e-20f,  1e20f,
                                     0x1p-24f,   2,         -2147483520, 16,       1e6f,    -1e6f };
    return special[lom_random_bits(key, i) % (sizeof special / sizeof *special)];
}

static inline bool is_same_lane(lom_float a, lom_float b, int i)
{
    const float x = a[i], y = b[i];
    return (x != x && y != y) || memcmp(&x, &y, sizeof x) == 0;
}

static inline void expect_same_lane(const struct lane_case *c, const lom_float *in, const lom_float *out,
                                    const lom_float *other, int i, const char *beside, uint64_t key)
{
    for (int k = 0; k < c->outputs; k++)
        CHECK(is_same_lane(out[k], other[k], i),
              "%s, key %llu: output %d of lane %d is %.9g, %.9g beside %s, of %.9g %.9g %.9g %.9g", c->name,
              (unsigned long long)key, k, i, (double)out[k][i], (double)other[k][i], beside, (double)in[0][i],
              (double)in[1 % c->inputs][i], (double)in[2 % c->inputs][i], (double)in[3 % c->inputs][i]);
}

/* One packet of inputs; what is put into the others follows from the key. */
static inline void expect_lanes_alone(const struct lane_case *c, const lom_float *in, uint64_t key)
{
    lom_float out[MOST_LANE_OUTPUTS], other[MOST_LANE_OUTPUTS], copies[MOST_LANE_INPUTS], beside[MOST_LANE_INPUTS];
    c->function(c->context, in, out);
    for (int i = 0; i < LOM_LANES; i++) {
        for (int k = 0; k < c->inputs; k++) {
            copies[k] = lom_splat(in[k][i]);
            beside[k] = copies[k];
            for (int j = 0; j < LOM_LANES; j++)
                if (j != i) {
                    const uint64_t place = (uint64_t)((i * LOM_LANES + j) * MOST_LANE_INPUTS + k);
                    beside[k][j] = lom_random_bits(key + 1, place) % 2 == 0 ? poison(key, place) : in[k][j];
                }
        }
        c->function(c->context, copies, other);
        expect_same_lane(c, in, out, other, i, "copies", key);
        c->function(c->context, beside, other);
        expect_same_lane(c, in, out, other, i, "poison", key);
    }
}

#endif
