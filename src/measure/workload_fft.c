/* Workloads that are transforms. In: N x N complex numbers of normal parts; out: their transform, and a picture of it.
 * Invariant: every frame transforms the same numbers, put in their places before the clock runs. */
#include "workload.h"

#include <string.h>

static size_t plane_size(const lom_workload *w)
{
    return lom_fft_rows(w->width) * lom_fft_pitch(w->width);
}

static bool make_fft(lom_workload *w, lom_error *error)
{
    for (int i = 0; i < 2; i++) {
        w->numbers[i] = lom_allocate(plane_size(w), sizeof(float), error);
        w->plane[i] = lom_allocate(plane_size(w), sizeof(float), error);
        if (w->numbers[i] == NULL || w->plane[i] == NULL)
            return false;
    }
    for (int y = 0; y < w->width; y++)
        for (int x = 0; x < w->width; x++) {
            double normal[2];
            lom_random_normal(1, (uint64_t)y * (uint64_t)w->width + (uint64_t)x, normal);
            for (int i = 0; i < 2; i++)
                w->numbers[i][(size_t)y * lom_fft_pitch(w->width) + (size_t)x] = (float)normal[i];
        }
    return true;
}

static bool prepare_fft(lom_workload *w, lom_device *device, lom_error *error)
{
    if (w->fft == NULL)
        w->fft = lom_create_fft(w->width, device, error);
    for (int i = 0; i < 2; i++)
        memcpy(w->plane[i], w->numbers[i], plane_size(w) * sizeof(float));
    return w->fft != NULL;
}

void lom_draw_fft(lom_workload *w, lom_device *device)
{
    lom_transform_square(w->fft, device, -1, w->plane[0], w->plane[1]);
}

/* Parts of the transform have the standard deviation N; 3.5 of them to both sides fill the range. */
static uint8_t shade_of(float part, int size)
{
    double x = 127.5 + (double)part * (127.5 / 3.5) / size;
    return (uint8_t)lom_count_of(x > 0 ? x < 255 ? x + 0.5 : 255 : 0, 255);
}

static lom_image *fft_picture(const lom_workload *w, lom_error *error)
{
    lom_image *picture = lom_create_image(w->width, w->height, 1, LOM_FORMAT_RGBA8, error);
    for (int y = 0; picture != NULL && y < w->height; y++)
        for (int x = 0; x < w->width; x++) {
            size_t i = (size_t)y * lom_fft_pitch(w->width) + (size_t)x;
            uint8_t *pixel = lom_image_pixel(picture, x, y, 0);
            pixel[0] = shade_of(w->plane[0][i], w->width);
            pixel[1] = 128;
            pixel[2] = shade_of(w->plane[1][i], w->width);
            pixel[3] = 255;
        }
    return picture;
}

const lom_workload_task lom_fft_task = { make_fft, prepare_fft, fft_picture };
