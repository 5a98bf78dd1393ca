/* Key frames: numbers at times, and between them. */
#ifndef LOM_SCENE_KEY_FRAMES_H
#define LOM_SCENE_KEY_FRAMES_H

#include <lom/base.h>

enum { LOM_MAX_KEY_VALUES = 8 };

/* An array of structs that each hold a time, in seconds, and behind it `values` numbers; times rise. */
struct lom_key_frames {
    const void *keys;
    size_t size, count; /* of a struct; of structs, at least 1 */
    size_t time;        /* offset of the time */
    int values;         /* 1..LOM_MAX_KEY_VALUES */
    bool is_smooth;
};

/* The numbers at a time: before the first key the first's, after the last the last's; between, straight lines, or the
 * cubic Hermite curve whose slope at a key is that of the parabola through it and its two neighbours. */
void lom_follow_keys(const struct lom_key_frames *frames, double time, double *values);

#endif
