/* Numbers for eyes. In: floats. Out: the same from 0 to 1, or 16 bits of gray. What draws no frame takes no more than this. */
#include "inspect/eyes.h"

/* Distances reach over many powers of two. */
static void take_logarithm(lom_image *image)
{
    float *value = (float *)(void *)image->pixels;
    for (size_t i = 0; i < lom_image_size(image) / sizeof *value; i++)
        value[i] = value[i] > 0 ? (float)(1000 + lom_double_log((double)value[i])) : 0;
}

void lom_stretch_numbers(lom_image *image)
{
    float *value = (float *)(void *)image->pixels, low = 0, high = 0;
    size_t count = lom_image_size(image) / sizeof *value;
    bool any = false;
    for (size_t i = 0; i < count; i++) {
        if (value[i] == 0 || !__builtin_isfinite(value[i]))
            continue;
        low = !any || value[i] < low ? value[i] : low;
        high = !any || value[i] > high ? value[i] : high;
        any = true;
    }
    for (size_t i = 0; i < count; i++)
        value[i] = value[i] == 0 ? 0 : high > low ? (value[i] - low) / (high - low) : 1;
}

lom_image *lom_depth_to_eyes(lom_image *raw, lom_error *error)
{
    if (raw == NULL)
        return NULL;
    take_logarithm(raw);
    lom_stretch_numbers(raw);
    lom_image *shown = lom_convert_image(raw, LOM_FORMAT_R16, error);
    lom_free_image(raw);
    return shown;
}
