/* Lesson 16. The trade: trade OUT.png
 * In: a cloud and a dial, the steps that a ray takes through it. Out: a picture of the cloud at five settings and, below
 * each, two bars: light the work (samples of the density), red the error (FLIP against 512 steps; both on a scale where
 * each quarter of the height is ten times as much). */
#include <lom/cloud.h>
#include <lom/march.h>

#include <stdio.h>

enum { SIZE = 64, BARS = 80, SETTINGS = 5, FINEST = 512 };

static const int settings[SETTINGS] = { 4, 8, 16, 32, 64 };

/* The cloud seen straight from the front, by rays of `steps` samples; how many samples were taken is added to count. */
static lom_image *draw_cloud(const lom_medium *medium, int steps, uint64_t *count)
{
    lom_image *picture = lom_create_image(SIZE, SIZE, 1, LOM_FORMAT_RGB32F, NULL);
    for (int i = 0; i < SIZE * SIZE && picture != NULL; i++) {
        float x = ((float)(i % SIZE) + 0.5f) / SIZE, y = 1 - ((float)(i / SIZE) + 0.5f) / SIZE, through = 1, light = 0;
        for (int k = 0; k < steps && through > 0.001f; k++, ++*count) {
            float z = 1 - ((float)k + 0.5f) / (float)steps; /* the middle of the step, from the front */
            lom_volume_place place =
                lom_find_in_cells(medium->width, medium->height, medium->depth, lom_splat3(x, y, z));
            float depth = lom_sample_medium(medium, place)[0] * 20 / (float)steps,
                  passed = (float)lom_double_exp(-(double)depth);
            light += through * (1 - passed) * (0.35f + 0.6f * y); /* brighter above, as from a high sun */
            through *= passed;
        }
        const float sky[3] = { 0.12f, 0.28f, 0.6f };
        for (int c = 0; c < 3; c++)
            ((float *)lom_image_pixel(picture, i % SIZE, i / SIZE, 0))[c] = light + through * sky[c];
    }
    return picture;
}

/* A bar from below; value is a power of ten of 0.0001 (height 0) to 1 (full height). */
static void draw_bar(lom_image *picture, int left, double value, const float color[3])
{
    double height = value > 0 ? 1 + lom_double_log2(value) / lom_double_log2(10) / 4 : 0;
    for (int i = 0; i < 20 * BARS; i++) {
        int y = i / 20;
        bool is_bar = y < height * BARS;
        for (int c = 0; c < 3; c++)
            ((float *)lom_image_pixel(picture, left + i % 20, SIZE + BARS - 1 - y, 0))[c] = is_bar ? color[c] : 0.02f;
    }
}

static bool draw_settings(lom_image *picture, const lom_medium *medium)
{
    static const float work_color[3] = { 0.7f, 0.7f, 0.7f }, error_color[3] = { 0.7f, 0.08f, 0.04f };
    uint64_t most = 0;
    lom_image *reference = draw_cloud(medium, FINEST, &most);
    bool done = reference != NULL;
    for (int i = 0; i < SETTINGS && done; i++) {
        uint64_t work = 0;
        double flip, decibels = 0;
        lom_comparison comparison;
        lom_image *cloud = draw_cloud(medium, settings[i], &work);
        done = cloud != NULL && lom_compare_flip(cloud, reference, &flip, NULL) &&
               lom_compare_images(cloud, reference, &comparison, NULL);
        if (done) {
            decibels = comparison.psnr;
            printf("%2d steps: %.4f of the work, FLIP %.4f, PSNR %.1f dB\n", settings[i], (double)work / (double)most,
                   flip, decibels);
            for (int y = 0; y < SIZE; y++)
                memcpy(lom_image_pixel(picture, i * SIZE, y, 0), lom_image_pixel(cloud, 0, y, 0),
                       SIZE * 3 * sizeof(float));
            draw_bar(picture, i * SIZE + 8, (double)work / (double)most, work_color);
            draw_bar(picture, i * SIZE + 32, flip, error_color);
        }
        lom_free_image(cloud);
    }
    lom_free_image(reference);
    return done;
}

int main(int argc, char **argv)
{
    lom_image *volume = lom_make_cloud(
        &(lom_cloud_desc){ "cumulus_congestus", .width = 64, .height = 64, .depth = 64, .seed = 7 }, NULL);
    lom_medium *medium = volume == NULL ? NULL : lom_create_medium(volume, NULL);
    lom_image *picture = lom_create_image(SETTINGS * SIZE, SIZE + BARS, 1, LOM_FORMAT_RGB32F, NULL);
    bool drawn = medium != NULL && picture != NULL && draw_settings(picture, medium);
    lom_image *bytes = drawn ? lom_convert_image(picture, LOM_FORMAT_RGB8_SRGB, NULL) : NULL;
    bool done = argc == 2 && bytes != NULL && lom_write_image(argv[1], NULL, bytes, NULL);
    lom_free_image(volume);
    lom_free_medium(medium);
    lom_free_image(picture);
    lom_free_image(bytes);
    if (!done)
        fprintf(stderr, "trade: nothing was written; usage: trade OUT.png\n");
    return done ? 0 : 2;
}
