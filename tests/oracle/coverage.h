/* The oracle of coverage: which pixels belong to a triangle. Scalar, in integers of 128 bits; it knows no tiles, lanes or
 * boxes. */
#ifndef LOM_TESTS_ORACLE_COVERAGE_H
#define LOM_TESTS_ORACLE_COVERAGE_H

#include <stdbool.h>
#include <stdint.h>

typedef struct snapped {
    int64_t x, y; /* 1/256 pixel from the viewport's corner, y down */
} snapped;

/* Round to the nearest whole number, ties to even, |x| < 2^30: in integers of x's own bits. */
static inline int64_t to_nearest_even(float x)
{
    int64_t whole = (int64_t)x;
    double rest = (double)x - (double)whole; /* exact, of x's sign */
    if (rest > 0.5 || (rest == 0.5 && (whole & 1) != 0))
        return whole + 1;
    if (rest < -0.5 || (rest == -0.5 && (whole & 1) != 0))
        return whole - 1;
    return whole;
}

/* The documented rule: x / w * half + half, each step rounded to float, then to the nearest whole unit. */
static inline snapped snap(const float position[4], int width, int height)
{
    float half_x = (float)width * 128.0f, half_y = (float)height * 128.0f;
    float x = position[0] / position[3], y = position[1] / position[3];
    x = x * half_x;
    y = y * -half_y;
    x = x + half_x;
    y = y + half_y;
    return (snapped){ to_nearest_even(x), to_nearest_even(y) };
}

/* Whether the centre of the viewport's pixel (px, py) belongs to the triangle: inside, or on an edge whose interior
 * lies to the right of it, or below it when it is horizontal. */
static inline bool covers(const snapped v[3], int px, int py)
{
    __int128 area = (__int128)(v[1].x - v[0].x) * (v[2].y - v[0].y) - (__int128)(v[1].y - v[0].y) * (v[2].x - v[0].x);
    int64_t x = 256 * (int64_t)px + 128, y = 256 * (int64_t)py + 128;
    if (area == 0)
        return false;
    for (int i = 0; i < 3; i++) {
        const snapped *p = &v[i], *q = &v[(i + 1) % 3];
        __int128 dx = q->x - p->x, dy = q->y - p->y;
        if (area < 0) {
            dx = -dx;
            dy = -dy;
        }
        __int128 e = dx * (y - p->y) - dy * (x - p->x);
        bool interior_right_or_below = dy < 0 || (dy == 0 && dx > 0);
        if (e < 0 || (e == 0 && !interior_right_or_below))
            return false;
    }
    return true;
}

#endif
