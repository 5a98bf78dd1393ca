/* Two drawings of small scenes, compared pixel by pixel. */
#ifndef LOM_TESTS_DRAWN_PAIRS_H
#define LOM_TESTS_DRAWN_PAIRS_H

#include "change_bases.h"
#include "check.h"
#include "scene_transforms.h"
#include "small_scene.h"

enum { PAIR_WIDTH = 96, PAIR_HEIGHT = 54, PAIR_TOLERANCE = 2 };

typedef void changing_scene(lom_scene *scene, const void *how);

/* The scene of the text, changed (NULL: as it is), at a time. */
static inline lom_image *draw_changed(const char *text, changing_scene *change, const void *how, double time,
                                      const lom_device_desc *device, lom_error *error)
{
    lom_frame frame = { .image = NULL };
    lom_scene *scene = lom_decode_scene(text, strlen(text), small_path("scene.toml"), NULL, 0, error);
    if (scene != NULL) {
        scene->output.width = PAIR_WIDTH, scene->output.height = PAIR_HEIGHT;
        scene->output.format = LOM_OUTPUT_RGB8;
        if (change != NULL)
            change(scene, how);
    }
    lom_renderer *renderer = scene != NULL ? lom_create_renderer(scene, device, error) : NULL;
    if (renderer != NULL)
        lom_render_frame(renderer, &(lom_frame_desc){ .has_time = true, .time = time }, &frame, error);
    lom_free_renderer(renderer);
    lom_free_scene(scene);
    return frame.image;
}

struct difference {
    int largest, pixels, beyond; /* of 255; pixels that differ at all, and by more than the tolerance */
    double mean;                 /* over samples, of 255 */
};

static inline struct difference find_difference(const lom_image *a, const lom_image *b)
{
    struct difference d = { 0, 0, 0, 0 };
    for (int i = 0; i < PAIR_WIDTH * PAIR_HEIGHT; i++) {
        int most = 0;
        for (int c = 0; c < 3; c++) {
            int delta = abs(a->pixels[3 * i + c] - b->pixels[3 * i + c]);
            most = delta > most ? delta : most;
            d.mean += delta / (3.0 * PAIR_WIDTH * PAIR_HEIGHT);
        }
        d.largest = most > d.largest ? most : d.largest;
        d.pixels += most > 0;
        d.beyond += most > PAIR_TOLERANCE;
    }
    return d;
}

#endif
