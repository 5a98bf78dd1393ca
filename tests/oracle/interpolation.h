/* The oracle of interpolation: values at three vertices, over a triangle on the screen, in double. In: the snapped places, w
 * of each; out: weights of the vertices, linear on the screen or in space, and how a value changes from pixel to pixel. */
#ifndef LOM_TESTS_ORACLE_INTERPOLATION_H
#define LOM_TESTS_ORACLE_INTERPOLATION_H

#include "oracle/coverage.h"

/* Twice the area of (p, q, (x, y)): the weight on the screen of the vertex opposite to p q, times that of the triangle. */
static inline double edge_value(const snapped *p, const snapped *q, double x, double y)
{
    return (double)(q->x - p->x) * (y - (double)p->y) - (double)(q->y - p->y) * (x - (double)p->x);
}

/* Weights at (x, y) in 1/256 pixel, their sum 1. w: of the clip positions; NULL: linear on the screen. */
static inline void weights_at(const snapped v[3], const double w[3], double x, double y, double weight[3])
{
    double sum = 0;
    for (int i = 0; i < 3; i++) {
        weight[i] = edge_value(&v[(i + 1) % 3], &v[(i + 2) % 3], x, y) / (w != NULL ? w[i] : 1);
        sum += weight[i];
    }
    for (int i = 0; i < 3; i++)
        weight[i] /= sum;
}

static inline double weighted(const double weight[3], const double value[3])
{
    return weight[0] * value[0] + weight[1] * value[1] + weight[2] * value[2];
}

/* The change of a value for a pixel to the right and for a pixel down, at (x, y). With weights e / w over their sum D, the
 * value is N / D, both linear on the screen: N' - value D' over D. */
static inline void change_at(const snapped v[3], const double w[3], const double value[3], double x, double y,
                             double change[2])
{
    double weight[3], sum = 0, slope[2] = { 0, 0 };
    weights_at(v, w, x, y, weight);
    const double here = weighted(weight, value);
    for (int i = 0; i < 3; i++) {
        const snapped *p = &v[(i + 1) % 3], *q = &v[(i + 2) % 3];
        sum += edge_value(p, q, x, y) / w[i];
        slope[0] -= 256 * (double)(q->y - p->y) / w[i] * (value[i] - here);
        slope[1] += 256 * (double)(q->x - p->x) / w[i] * (value[i] - here);
    }
    change[0] = slope[0] / sum;
    change[1] = slope[1] / sum;
}

#endif
