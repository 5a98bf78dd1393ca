/* Key frames. In: keys and a time. Out: numbers. Invariant: the result depends on the time alone, so any frame can be
 * made without the ones before it. Compiled for speed: wakes follow bodies back through hundreds of moments. */
#include "scene/key_frames.h"

#include <string.h>

typedef struct sample {
    double v[LOM_MAX_KEY_VALUES];
} sample;

static double time_of(const struct lom_key_frames *f, size_t i)
{
    double time;
    memcpy(&time, (const char *)f->keys + i * f->size + f->time, sizeof time);
    return time;
}

static sample key_sample(const struct lom_key_frames *f, size_t i)
{
    sample s = { { 0 } };
    memcpy(s.v, (const char *)f->keys + i * f->size + f->time + sizeof(double), (size_t)f->values * sizeof(double));
    return s;
}

static double interval(const struct lom_key_frames *f, size_t i)
{
    return time_of(f, i + 1) - time_of(f, i);
}

/* Slope of the straight line from key i to the next. */
static sample chord(const struct lom_key_frames *f, size_t i)
{
    sample a = key_sample(f, i), b = key_sample(f, i + 1);
    for (int n = 0; n < f->values; n++)
        a.v[n] = (b.v[n] - a.v[n]) / interval(f, i);
    return a;
}

/* Slope at key i of the parabola through it and its neighbours: with intervals h0, h1 and chords d0, d1 on both sides
 * it is (h1 d0 + h0 d1) / (h0 + h1) in the middle (Newton's divided differences), and 2 d0 - that at an end. */
static sample slope(const struct lom_key_frames *f, size_t i)
{
    size_t last = f->count - 1;
    if (last == 1)
        return chord(f, 0);
    size_t middle = i == 0 ? 1 : i == last ? last - 1 : i;
    sample d0 = chord(f, middle - 1), d1 = chord(f, middle);
    double h0 = interval(f, middle - 1), h1 = interval(f, middle);
    for (int n = 0; n < f->values; n++) {
        double inner = (h1 * d0.v[n] + h0 * d1.v[n]) / (h0 + h1);
        double outer = i == 0 ? d0.v[n] : d1.v[n];
        d0.v[n] = i == middle ? inner : 2 * outer - inner;
    }
    return d0;
}

/* Cubic Hermite basis at s in 0..1 of an interval of length h. */
static sample smooth(const struct lom_key_frames *f, size_t i, double s)
{
    sample a = key_sample(f, i), b = key_sample(f, i + 1);
    sample da = slope(f, i), db = slope(f, i + 1);
    double h = interval(f, i), r = 1 - s;
    for (int n = 0; n < f->values; n++)
        a.v[n] = r * r * (1 + 2 * s) * a.v[n] + s * s * (3 - 2 * s) * b.v[n] +
                 h * (s * r * r * da.v[n] - s * s * r * db.v[n]);
    return a;
}

static sample linear(const struct lom_key_frames *f, size_t i, double s)
{
    sample a = key_sample(f, i), b = key_sample(f, i + 1);
    for (int n = 0; n < f->values; n++)
        a.v[n] = (1 - s) * a.v[n] + s * b.v[n];
    return a;
}

/* The last of the keys that are not after time, by bisection; time is not before the first. */
static size_t find_interval(const struct lom_key_frames *f, double time)
{
    size_t low = 0, high = f->count;
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        if (time_of(f, middle) <= time)
            low = middle;
        else
            high = middle;
    }
    return low;
}

static sample sample_at(const struct lom_key_frames *f, double time)
{
    size_t last = f->count - 1;
    if (!(time > time_of(f, 0)))
        return key_sample(f, 0);
    if (time >= time_of(f, last))
        return key_sample(f, last);
    size_t i = find_interval(f, time);
    double s = (time - time_of(f, i)) / interval(f, i);
    return f->is_smooth ? smooth(f, i, s) : linear(f, i, s);
}

void lom_follow_keys(const struct lom_key_frames *frames, double time, double *values)
{
    lom_float_state state;
    lom_enter_float_state(&state);
    sample at = sample_at(frames, time);
    lom_leave_float_state(&state);
    memcpy(values, at.v, (size_t)frames->values * sizeof *values);
}
